/* batten measure: the hull, surface or mesh, and the drafts. */
#include "measure_job.h"

#include <math.h>
#include <string.h>
#include <strings.h>

bool measure_ends_in(const char *path, const char *ending)
{
	const size_t length = strlen(path), tail = strlen(ending);
	return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

static batten_status read_hull(measure_job *job, batten_context *context)
{
	const batten_status status = batten_hull_read(context, job->path, &job->hull);
	if (status != BATTEN_OK)
		return cli_failure("measure", context, status);
	job->name = batten_hull_name(job->hull);
	job->lowest_m = batten_hull_z_m(job->hull)[0];
	job->highest_m = batten_hull_z_m(job->hull)[batten_hull_waterline_count(job->hull) - 1];
	return BATTEN_OK;
}

static batten_status read_surface(measure_job *job, batten_context *context)
{
	const batten_status status = batten_surface_read(context, job->path, &job->surface);
	if (status != BATTEN_OK)
		return cli_failure("measure", context, status);
	const batten_surface_net net = batten_surface_describe(job->surface);
	job->name = net.name;
	job->lowest_m = job->aftmost_m = INFINITY;
	job->foremost_m = -INFINITY;
	for (size_t i = 0; i < net.count_u * net.count_v; i++) {
		job->lowest_m = fmin(job->lowest_m, net.poles_m[3 * i + 2]);
		job->aftmost_m = fmin(job->aftmost_m, net.poles_m[3 * i]);
		job->foremost_m = fmax(job->foremost_m, net.poles_m[3 * i]);
	}
	return BATTEN_OK;
}

static batten_status read_mesh(measure_job *job, batten_context *context)
{
	const batten_status status = batten_mesh_read(context, job->path, &job->mesh);
	if (status != BATTEN_OK)
		return cli_failure("measure", context, status);
	const batten_mesh_facts facts = batten_mesh_describe(job->mesh);
	job->name = job->path;
	job->lowest_m = facts.lowest_m;
	job->highest_m = facts.highest_m;
	job->aftmost_m = facts.aftmost_m;
	job->foremost_m = facts.foremost_m;
	return BATTEN_OK;
}

static batten_status read_form(measure_job *job, batten_context *context)
{
	job->highest_m = NAN;
	if (measure_ends_in(job->path, ".json"))
		return read_surface(job, context);
	if (measure_ends_in(job->path, ".stl") || measure_ends_in(job->path, ".obj"))
		return read_mesh(job, context);
	return read_hull(job, context);
}

static batten_status draft_at(measure_job *job, batten_context *context)
{
	if (job->hull)
		return batten_hull_draft_at(context, job->hull, &job->options, job->displacement_t,
		                            job->drafts_m);
	if (job->mesh)
		return batten_mesh_draft_at(context, job->mesh, &job->options, job->displacement_t,
		                            job->drafts_m);
	return batten_surface_draft_at(context, job->surface, &job->options, job->displacement_t,
	                               job->drafts_m);
}

static batten_status find_drafts(measure_job *job, batten_context *context)
{
	if (!isnan(job->displacement_t)) {
		job->draft_count = 1;
		const batten_status status = draft_at(job, context);
		return status == BATTEN_OK ? status : cli_failure("measure", context, status);
	}
	const bool all_heights = job->curves_of_form || job->bonjean;
	if (job->draft_count == 0 && !job->hull && !(all_heights && !isnan(job->highest_m)))
		return cli_usage("measure", "a %s has no draft of its own: --draft T was expected",
		                 job->mesh ? "mesh" : "surface");
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
	batten_mesh_destroy(job->mesh);
}

const char *measure_rule(const measure_job *job)
{
	return job->mesh ? "triangles" : job->hull ? job->quadrature : "gauss";
}

batten_status measure_hydrostatics(const measure_job *job, batten_context *context, size_t count,
                                   const double *drafts_m, batten_hydrostatics *out)
{
	batten_status status;
	if (job->hull)
		status = batten_hull_hydrostatics(context, job->hull, &job->options, count, drafts_m, out);
	else if (job->mesh)
		status = batten_mesh_hydrostatics(context, job->mesh, &job->options, count, drafts_m, out);
	else
		status = batten_surface_hydrostatics(context, job->surface, &job->options, count, drafts_m,
		                                     out);
	return status == BATTEN_OK ? status : cli_failure("measure", context, status);
}

batten_status measure_sections(const measure_job *job, batten_context *context, size_t count,
                               const double *x_m, size_t height_count, const double *heights_m,
                               double *areas_m2)
{
	batten_status status;
	if (job->hull)
		status = batten_hull_section_areas(context, job->hull, &job->options, height_count,
		                                   heights_m, areas_m2);
	else if (job->mesh)
		status = batten_mesh_section_areas(context, job->mesh, &job->options, count, x_m,
		                                   height_count, heights_m, areas_m2);
	else
		status = batten_surface_section_areas(context, job->surface, &job->options, count, x_m,
		                                      height_count, heights_m, areas_m2);
	return status == BATTEN_OK ? status : cli_failure("measure", context, status);
}
