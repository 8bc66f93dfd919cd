/* batten fair --method all: every method on one hull, side by side (thesis 8, table 8.2). */
#include "fair_job.h"

#include "json_out.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* In the order of the thesis's chapters. */
static const batten_fair_method methods[] = { BATTEN_METHOD_SMOOTH,
	                                          BATTEN_METHOD_FORWARD_APPROXIMATION,
	                                          BATTEN_METHOD_FORWARD_FIT, BATTEN_METHOD_INVERSE,
	                                          BATTEN_METHOD_SEARCH };
enum { METHOD_COUNT = sizeof methods / sizeof methods[0], COLUMNS_MOST = METHOD_COUNT + 1 };

/* One method: what it was asked and what came of it. */
typedef struct attempt {
	fair_request request;
	fair_job *job;
	batten_status status;
} attempt;

/* A row of the comparison. */
typedef struct row {
	const char *name;
	double cells[COLUMNS_MOST];
} row;

enum { ROWS_MOST = 24 };
typedef struct comparison {
	size_t columns;
	const char *labels[COLUMNS_MOST];
	const fair_job *jobs[COLUMNS_MOST]; /* the first column is the first job's input */
	size_t row_count;
	row rows[ROWS_MOST];
} comparison;

/* The request of one method: options that it does not know are left to those that do. All start from
 * the smoothed hull. */
static fair_request request_of(const fair_request *all, batten_fair_method method)
{
	fair_request one = *all;
	const bool is_pass = (int)method >= BATTEN_METHOD_FORWARD_APPROXIMATION;
	const bool net = strcmp(all->variables, "net") == 0;
	one.method = batten_fair_method_text((size_t)method);
	one.common.quiet = true;
	one.common.json = false;
	one.smooth_first = is_pass && !all->no_smooth;
	if (method != BATTEN_METHOD_SEARCH) {
		one.variables = "offsets";
		one.fairness = "bending";
		one.net = one.tangents = one.rounded = one.lock = one.max_distance = NULL;
		one.lower_path = one.upper_path = one.keep = NULL;
		one.interior_penalty = false;
		one.w1 = one.w2 = one.longitudinal = one.transverse = one.polish = NAN;
		if (net)
			one.order = NULL;
	}
	if (!is_pass) {
		one.order_sections = one.vertices = UINT_MAX;
		one.max_cn = one.least_gain = NAN;
		one.restore = NULL;
		one.iterations = UINT_MAX;
		if (!net)
			one.order = NULL;
	}
	if (method != BATTEN_METHOD_FORWARD_FIT)
		one.vertices = UINT_MAX;
	if (method == BATTEN_METHOD_SMOOTH)
		one.no_smooth = false;
	return one;
}

static batten_status attempt_run(attempt *a, const char *folder)
{
	char path[PATH_MAX];
	if (snprintf(path, sizeof path, "%s/%s", folder, a->request.method) >= (int)sizeof path)
		return cli_usage("fair", "--out: the path is too long");
	a->job = calloc(1, sizeof *a->job);
	if (!a->job)
		return BATTEN_MEMORY;
	a->job->request = &a->request;
	batten_status status = cli_context_create("fair", &a->request.common, &a->job->context);
	if (status == BATTEN_OK)
		status = fair_job_run(a->job, path);
	return status;
}

static row *add_row(comparison *c, const char *name)
{
	row *r = &c->rows[c->row_count++];
	r->name = name;
	for (size_t h = 0; h < COLUMNS_MOST; h++)
		r->cells[h] = NAN;
	return r;
}

static const batten_measures *measures_of(const comparison *c, size_t h)
{
	return h == 0 ? &c->jobs[0]->before.measures : &c->jobs[h]->after.measures;
}

/* What of table 8.2 can be measured: fairness, closeness, form, time. */
static void fill_rows(comparison *c)
{
	static const char *const names[] = { "fn_per_m2",
		                                 "fn_sections_per_m2",
		                                 "energy_bending",
		                                 "energy_mean",
		                                 "energy_gauss",
		                                 "energy_mvc_per_m2",
		                                 "inflections",
		                                 "noise_m",
		                                 "volume_m3",
		                                 "cb",
		                                 "cp",
		                                 "cm",
		                                 "cwp",
		                                 "lcb_pct_lbp_fwd" };
	for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
		row *r = add_row(c, names[n]);
		for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++)
			for (size_t h = 0; h < c->columns && strcmp(batten_measure_name(i), names[n]) == 0; h++)
				r->cells[h] = ((const double *)measures_of(c, h))[i];
	}
	row *volume = add_row(c, "volume_change_pct");
	row *lcb = add_row(c, "lcb_change_pct_lbp");
	row *to_input = add_row(c, "cn_pct");
	row *to_smoothed = add_row(c, "cn_search_pct");
	row *rms = add_row(c, "cn_rms_m");
	row *seconds = add_row(c, "cpu_s");
	const batten_measures *before = measures_of(c, 0);
	for (size_t h = 1; h < c->columns; h++) {
		const batten_measures *after = measures_of(c, h);
		volume->cells[h] = 100.0 * (after->volume_m3 - before->volume_m3) / before->volume_m3;
		lcb->cells[h] = after->lcb_pct_lbp_fwd - before->lcb_pct_lbp_fwd;
		to_input->cells[h] = c->jobs[h]->after.to_input.cn_pct;
		to_smoothed->cells[h] = c->jobs[h]->after.to_smoothed.cn_pct;
		rms->cells[h] = c->jobs[h]->after.to_input.cn_rms_m;
		seconds->cells[h] = c->jobs[h]->cpu_seconds;
	}
}

static void gather(const attempt *attempts, comparison *c)
{
	*c = (comparison){ 0 };
	for (size_t m = 0; m < METHOD_COUNT; m++) {
		if (attempts[m].status != BATTEN_OK && attempts[m].status != BATTEN_INCOMPLETE)
			continue;
		if (c->columns == 0) {
			c->labels[0] = "input";
			c->jobs[c->columns++] = attempts[m].job;
		}
		c->labels[c->columns] = attempts[m].request.method;
		c->jobs[c->columns++] = attempts[m].job;
	}
	if (c->columns > 0)
		fill_rows(c);
}

static void print_table(const comparison *c, const batten_hull *hull)
{
	(void)printf("%s: %zu stations, %zu waterlines; metres, frame ap-fwd\n\n%-20s",
	             batten_hull_name(hull), batten_hull_station_count(hull),
	             batten_hull_waterline_count(hull), "");
	for (size_t h = 0; h < c->columns; h++)
		(void)printf(" %*s", (int)(strlen(c->labels[h]) > 11 ? strlen(c->labels[h]) : 11),
		             c->labels[h]);
	for (size_t r = 0; r < c->row_count; r++) {
		(void)printf("\n%-20s", c->rows[r].name);
		for (size_t h = 0; h < c->columns; h++) {
			const int width = (int)(strlen(c->labels[h]) > 11 ? strlen(c->labels[h]) : 11);
			if (isnan(c->rows[r].cells[h]))
				(void)printf(" %*s", width, "-");
			else
				(void)printf(" %*.5g", width, c->rows[r].cells[h]);
		}
	}
	(void)printf("\n");
}

static json_t *comparison_json(const comparison *c, const attempt *attempts)
{
	json_t *object = json_object();
	json_t *list = json_array();
	json_t *skipped = json_array();
	for (size_t h = 0; h < c->columns; h++) {
		json_t *one = json_object();
		(void)json_object_set_new(one, "method", json_string(c->labels[h]));
		for (size_t r = 0; r < c->row_count; r++)
			(void)json_object_set_new(one, c->rows[r].name, cli_json_number(c->rows[r].cells[h]));
		(void)json_array_append_new(list, one);
	}
	for (size_t m = 0; m < METHOD_COUNT; m++)
		if (attempts[m].status != BATTEN_OK && attempts[m].status != BATTEN_INCOMPLETE)
			(void)json_array_append_new(skipped, json_string(attempts[m].request.method));
	(void)json_object_set_new(object, "batten", json_string(batten_version()));
	(void)json_object_set_new(object, "hull", json_string(batten_hull_name(c->jobs[0]->hull)));
	(void)json_object_set_new(object, "frame", json_string("ap-fwd"));
	(void)json_object_set_new(object, "columns", list);
	(void)json_object_set_new(object, "not_applicable", skipped);
	return object;
}

static batten_status write_json(const comparison *c, const attempt *attempts, const char *folder)
{
	char path[PATH_MAX];
	if (snprintf(path, sizeof path, "%s/compare.json", folder) >= (int)sizeof path)
		return cli_usage("fair", "--out: the path is too long");
	return cli_json_save("fair", comparison_json(c, attempts), path);
}

static batten_status write_sheet(const comparison *c, const char *folder)
{
	char path[PATH_MAX], title[256];
	const batten_hull *hulls[COLUMNS_MOST];
	const char *names[ROWS_MOST];
	double values[ROWS_MOST * COLUMNS_MOST];
	if (snprintf(path, sizeof path, "%s/compare.svg", folder) >= (int)sizeof path)
		return cli_usage("fair", "--out: the path is too long");
	for (size_t h = 0; h < c->columns; h++)
		hulls[h] = h == 0 ? c->jobs[0]->before.hull : c->jobs[h]->after.hull;
	for (size_t r = 0; r < c->row_count; r++) {
		names[r] = c->rows[r].name;
		for (size_t h = 0; h < c->columns; h++)
			values[r * c->columns + h] = c->rows[r].cells[h];
	}
	(void)snprintf(title, sizeof title, "%s: methods of fairing compared",
	               batten_hull_name(c->jobs[0]->hull));
	const batten_comparison shown = { .title = title,
		                              .hull_count = c->columns,
		                              .hulls = hulls,
		                              .labels = c->labels,
		                              .row_count = c->row_count,
		                              .row_names = names,
		                              .values = values };
	batten_context *context = c->jobs[0]->context;
	const batten_status status = batten_picture_comparison(context, &shown, path);
	return status == BATTEN_OK ? status : cli_failure("fair", context, status);
}

/* A method that the hull or the options do not suit is left out; anything else ends it all. */
static bool may_go_on(batten_status status)
{
	return status == BATTEN_OK || status == BATTEN_INCOMPLETE || status == BATTEN_USAGE ||
	       status == BATTEN_INPUT;
}

static batten_status run_all(const fair_request *request, const char *folder, attempt *attempts)
{
	batten_status worst = BATTEN_OK;
	for (size_t m = 0; m < METHOD_COUNT; m++) {
		attempts[m].request = request_of(request, methods[m]);
		attempts[m].status = attempt_run(&attempts[m], folder);
		if (!may_go_on(attempts[m].status))
			return attempts[m].status;
		if (attempts[m].status != BATTEN_OK)
			worst = BATTEN_INCOMPLETE;
	}
	comparison c;
	gather(attempts, &c);
	if (c.columns == 0)
		return attempts[0].status;
	batten_status status = write_sheet(&c, folder);
	if (status == BATTEN_OK)
		status = write_json(&c, attempts, folder);
	if (status == BATTEN_OK && request->common.json)
		status = cli_json_print("fair", comparison_json(&c, attempts));
	else if (status == BATTEN_OK && !request->common.quiet) {
		print_table(&c, c.jobs[0]->hull);
		(void)printf("\nwritten to %s: compare.svg, compare.json, and a folder for each method\n",
		             folder);
	}
	return status == BATTEN_OK ? worst : status;
}

batten_status fair_all(const fair_request *request, const char *folder)
{
	if (request->front)
		return cli_usage("fair", "--front is about the search, found it with --method all");
	/* The methods would each refuse it, when others have written already. */
	if (request->iterations == 0 ||
	    (request->iterations != UINT_MAX && request->iterations > BATTEN_ITERATIONS_MOST))
		return cli_usage("fair", "--iterations: found %u, expected 1 to %d", request->iterations,
		                 BATTEN_ITERATIONS_MOST);
	attempt *attempts = calloc(METHOD_COUNT, sizeof *attempts);
	if (!attempts) {
		(void)fprintf(stderr, "batten fair: %s\n", batten_status_text(BATTEN_MEMORY));
		return BATTEN_MEMORY;
	}
	const batten_status status = run_all(request, folder, attempts);
	for (size_t m = 0; m < METHOD_COUNT; m++)
		fair_job_destroy(attempts[m].job);
	free(attempts);
	return status;
}
