/* batten vary: a variant of a parent hull, what was asked of it, what it got and what else changed. */
#include "cli.h"

#include "json_out.h"
#include "vary_table.h"

#include <math.h>
#include <string.h>

/* What is shown of parent and variant. */
static const char *const shown[] = {
	"lbp_m",
	"beam_wl_m",
	"draft_m",
	"volume_m3",
	"cb",
	"cp",
	"cm",
	"cwp",
	"lcb_pct_lbp_fwd",
	"lcf_pct_lbp_fwd",
	"kb_m",
	"bmt_m",
	"wetted_surface_m2",
	"fn_per_m2",
};

/* A variation and all it stands on. */
struct job {
	vary_request request;
	batten_context *context;
	batten_hull *parent, *others[VARY_LIST_MOST], *variant;
	batten_lattice *lattice;
	batten_vary_outcome outcome;
	batten_measures before, after;
};

static double measure_named(const batten_measures *measures, const char *name)
{
	for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++)
		if (strcmp(batten_measure_name(i), name) == 0)
			return ((const double *)measures)[i];
	return NAN;
}

static const struct batten_vary_target *target_named(const batten_vary_outcome *outcome,
                                                     const char *name)
{
	for (size_t i = 0; i < outcome->target_count; i++)
		if (strcmp(outcome->targets[i].name, name) == 0)
			return &outcome->targets[i];
	return NULL;
}

static const char *method_name(const struct job *job)
{
	return job->request.solve ? "solve" : batten_vary_method_name(job->request.options.method);
}

static void print_table(const struct job *job)
{
	const batten_vary_outcome *outcome = &job->outcome;
	(void)printf("%s, %s: %u pass%s; metres, frame ap-fwd\n\n", batten_hull_name(job->parent),
	             method_name(job), outcome->passes, outcome->passes == 1 ? "" : "es");
	(void)printf("%-18s %13s %13s %13s %12s\n", "", "parent", "asked", "got", "changed");
	for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
		const struct batten_vary_target *target = target_named(outcome, shown[i]);
		const double before = measure_named(&job->before, shown[i]);
		const double after = measure_named(&job->after, shown[i]);
		char asked[32] = "";
		if (target)
			(void)snprintf(asked, sizeof asked, "%.6g", target->asked);
		(void)printf("%-18s %13.6g %13s %13.6g %+12.4g\n", shown[i], before, asked, after,
		             after - before);
	}
	for (size_t i = 0; i < outcome->parameter_count; i++)
		(void)printf("%s%s %.6g", i == 0 ? "\nparameters: " : ", ", outcome->parameters[i].name,
		             outcome->parameters[i].value);
	if (outcome->parameter_count > 0)
		(void)printf("\n");
}

static json_t *targets_json(const batten_vary_outcome *outcome)
{
	json_t *object = json_object();
	for (size_t i = 0; object && i < outcome->target_count; i++) {
		const struct batten_vary_target *target = &outcome->targets[i];
		(void)json_object_set_new(
			object, target->name,
			json_pack("{s:o, s:o, s:o}", "parent", cli_json_number(target->parent), "asked",
		              cli_json_number(target->asked), "got", cli_json_number(target->got)));
	}
	return object;
}

static json_t *measures_json(const batten_measures *measures)
{
	json_t *object = json_object();
	if (object)
		cli_json_measures(object, measures);
	return object;
}

static batten_status print_json(const struct job *job)
{
	const batten_vary_outcome *outcome = &job->outcome;
	json_t *parameters = json_object();
	for (size_t i = 0; parameters && i < outcome->parameter_count; i++)
		(void)json_object_set_new(parameters, outcome->parameters[i].name,
		                          cli_json_number(outcome->parameters[i].value));
	json_t *object = json_pack("{s:s, s:s, s:s, s:s, s:b, s:b, s:i, s:o, s:o, s:o, s:o, s:s}",
	                           "name", batten_hull_name(job->parent), "method", method_name(job),
	                           "unit", "m", "frame", "ap-fwd", "first_pass",
	                           job->request.first_pass, "thesis", job->request.thesis, "passes",
	                           (int)outcome->passes, "targets", targets_json(outcome), "parameters",
	                           parameters, "parent", measures_json(&job->before), "variant",
	                           measures_json(&job->after), "warning", outcome->warning);
	return cli_json_print("vary", object);
}

static batten_status read_hulls(struct job *job)
{
	vary_request *request = &job->request;
	batten_status status = batten_hull_read(job->context, request->hull_path, &job->parent);
	for (size_t i = 0; i < request->other_count && status == BATTEN_OK; i++)
		status = batten_hull_read(job->context, request->other_paths[i], &job->others[i]);
	if (status == BATTEN_OK)
		vary_request_place(request, job->parent);
	if (status == BATTEN_OK && request->lattice)
		status = batten_lattice_read(job->context, request->lattice, &job->lattice);
	request->options.lattice = job->lattice;
	request->options.others = (const batten_hull *const *)job->others;
	return status;
}

static batten_status make(struct job *job)
{
	batten_status status = read_hulls(job);
	if (status == BATTEN_OK && job->request.rows)
		return vary_table_make(job->context, &job->request, job->parent);
	if (status == BATTEN_OK)
		status = batten_hull_measure(job->context, job->parent, NULL, &job->before);
	const vary_request *request = &job->request;
	if (status == BATTEN_OK)
		status = request->solve
		             ? batten_hull_solve(job->context, job->parent, request->solve_count,
		                                 request->solve_targets, request->solve_parameters,
		                                 &job->variant, &job->outcome)
		             : batten_hull_vary(job->context, job->parent, &request->options, &job->variant,
		                                &job->outcome);
	if (status == BATTEN_OK)
		status = batten_hull_measure(job->context, job->variant, NULL, &job->after);
	if (status == BATTEN_OK)
		status = batten_hull_write(job->context, job->variant, job->request.out);
	if (status != BATTEN_OK)
		return cli_failure("vary", job->context, status);
	if (job->outcome.warning[0] && !job->request.common.quiet)
		(void)fprintf(stderr, "warning: %s\n", job->outcome.warning);
	if (job->request.common.json)
		return print_json(job);
	print_table(job);
	return BATTEN_OK;
}

batten_status cli_vary(int argc, char **argv)
{
	static const struct job none;
	struct job job = none;
	bool done = false;
	batten_status status = vary_request_read(argc, argv, &job.request, &done);
	if (status == BATTEN_OK && !done)
		status = cli_context_create("vary", &job.request.common, &job.context);
	if (status != BATTEN_OK || done)
		return status;
	status = make(&job);
	batten_hull_destroy(job.variant);
	batten_lattice_destroy(job.lattice);
	for (size_t i = 0; i < VARY_LIST_MOST; i++)
		batten_hull_destroy(job.others[i]);
	batten_hull_destroy(job.parent);
	batten_context_destroy(job.context);
	return status;
}
