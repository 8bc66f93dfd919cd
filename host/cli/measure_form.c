/* batten measure: the hull or surface, and the drafts. */
#include "measure_job.h"

#include <math.h>
#include <string.h>

static bool is_surface(const char *path)
{
	const size_t length = strlen(path);
	return length > 5 && strcmp(path + length - 5, ".json") == 0;
}

static batten_status read_form(measure_job *job, batten_context *context)
{
	job->highest_m = NAN;
	if (!is_surface(job->path)) {
		const batten_status status = batten_hull_read(context, job->path, &job->hull);
		if (status != BATTEN_OK)
			return cli_failure("measure", context, status);
		job->name = batten_hull_name(job->hull);
		job->lowest_m = batten_hull_z_m(job->hull)[0];
		job->highest_m = batten_hull_z_m(job->hull)[batten_hull_waterline_count(job->hull) - 1];
		return BATTEN_OK;
	}
	const batten_status status = batten_surface_read(context, job->path, &job->surface);
	if (status != BATTEN_OK)
		return cli_failure("measure", context, status);
	const batten_surface_net net = batten_surface_describe(job->surface);
	job->name = net.name;
	job->lowest_m = INFINITY;
	for (size_t i = 0; i < net.count_u * net.count_v; i++)
		job->lowest_m = fmin(job->lowest_m, net.poles_m[3 * i + 2]);
	return BATTEN_OK;
}

static batten_status find_drafts(measure_job *job, batten_context *context)
{
	if (!isnan(job->displacement_t)) {
		job->draft_count = 1;
		const batten_status status = job->hull
		                                 ? batten_hull_draft_at(context, job->hull, &job->options,
		                                                        job->displacement_t, job->drafts_m)
		                                 : batten_surface_draft_at(
											   context, job->surface, &job->options,
											   job->displacement_t, job->drafts_m);
		return status == BATTEN_OK ? status : cli_failure("measure", context, status);
	}
	if (job->draft_count == 0 && job->surface)
		return cli_usage("measure", "a surface has no draft of its own: --draft T was expected");
	return BATTEN_OK;
}

batten_status measure_open(measure_job *job, batten_context *context)
{
	const batten_status status = read_form(job, context);
	return status == BATTEN_OK ? find_drafts(job, context) : status;
}

void measure_close(measure_job *job)
{
	batten_hull_destroy(job->hull);
	batten_surface_destroy(job->surface);
}

const char *measure_rule(const measure_job *job)
{
	return job->surface ? "gauss" : job->quadrature;
}

batten_status measure_hydrostatics(const measure_job *job, batten_context *context, size_t count,
                                   const double *drafts_m, batten_hydrostatics *out)
{
	const batten_status status = job->hull
	                                 ? batten_hull_hydrostatics(context, job->hull, &job->options,
	                                                            count, drafts_m, out)
	                                 : batten_surface_hydrostatics(context, job->surface,
	                                                               &job->options, count, drafts_m,
	                                                               out);
	return status == BATTEN_OK ? status : cli_failure("measure", context, status);
}
