/* forward.pass: one iteration of forward and inverse fairing over many noisy Wigley hulls of 21 x 20,
 * on the device against the plain C path. A hull's half-breadths are read once and written once, 16
 * bytes each; its products are two operations each. A fitted line takes 54 operations a point and 29 a
 * vertex at order 3, roots and divisions, which take longest, counted as one each. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STATIONS = 21, WATERLINES = 20, NODES = STATIONS * WATERLINES };

typedef struct workload {
	size_t count;
	batten_pass *passes[2]; /* of the device, of the C path */
	double *y, *found, *known;
} workload;

static void workload_release(workload *w)
{
	batten_pass_destroy(w->passes[0]);
	batten_pass_destroy(w->passes[1]);
	free(w->y);
	free(w->found);
	free(w->known);
}

static batten_status make_hull(batten_context *context, size_t stations, const double *x,
                               batten_hull **out)
{
	double z[WATERLINES], y[NODES];
	for (int k = 0; k < WATERLINES; k++)
		z[k] = k / (WATERLINES - 1.0);
	for (size_t n = 0; n < stations * WATERLINES; n++) {
		const double s = x[n % stations] / 8.0 - 1.0;
		const double t = 1.0 - z[n / stations];
		y[n] = 0.8 * (1.0 - s * s) * (1.0 - t * t);
	}
	const batten_hull_table table = { "wigley", 16.0, 1.0, stations, WATERLINES, x, z, y, NULL };
	return batten_hull_create(context, &table, out);
}

/* Hulls that differ by noise. */
static void fill(workload *w, const batten_hull *hull)
{
	uint32_t state = 2654435761u;
	for (size_t n = 0; n < w->count * NODES; n++) {
		const double y = batten_hull_y_m(hull)[n % NODES];
		state = state * 1664525u + 1013904223u;
		w->y[n] = y > 0.0 ? y + 0.002 * (double)(state >> 8) / (1u << 24) : 0.0;
	}
}

static batten_status workload_create(const bench_settings *settings, batten_fair_method method,
                                     batten_precision precision, size_t count, workload *w)
{
	batten_hull *hull = NULL;
	*w = (workload){ .count = count };
	w->y = bench_allocate_large(count * NODES * sizeof *w->y);
	w->found = bench_allocate_large(count * NODES * sizeof *w->found);
	w->known = bench_allocate_large(count * NODES * sizeof *w->known);
	double x[STATIONS];
	for (int i = 0; i < STATIONS; i++)
		x[i] = 16.0 * i / (STATIONS - 1.0);
	batten_status status = w->y && w->found && w->known
	                           ? make_hull(settings->context, STATIONS, x, &hull)
	                           : BATTEN_MEMORY;
	for (int side = 0; side < 2 && status == BATTEN_OK; side++) {
		batten_pass_options options;
		batten_pass_options_default(&options);
		options.method = method;
		options.precision = precision;
		options.device = side == 0 ? settings->device : BATTEN_DEVICE_REFERENCE;
		status = batten_pass_create(settings->context, hull, &options, &w->passes[side]);
	}
	if (status == BATTEN_OK)
		fill(w, hull);
	batten_hull_destroy(hull);
	return status;
}

static batten_status run(const bench_settings *settings, void *workload_of, int device,
                         batten_precision precision, batten_run *out)
{
	const workload *w = workload_of;
	const bool known = device == BATTEN_DEVICE_REFERENCE;
	(void)precision;
	return batten_pass_batch(settings->context, w->passes[known], w->count, 1, w->y,
	                         known ? w->known : w->found, out);
}

static bool same(const void *workload_of)
{
	const workload *w = workload_of;
	return memcmp(w->found, w->known, w->count * NODES * sizeof *w->found) == 0;
}

static batten_status contest(const bench_settings *settings, batten_fair_method method,
                             batten_precision precision, size_t count)
{
	workload w;
	bench_row row = { .precision = precision, .unit = "us per hull" };
	batten_status status = workload_create(settings, method, precision, count, &w);
	if (status == BATTEN_OK) {
		const batten_pass_facts facts = batten_pass_describe(w.passes[0]);
		const bool fits = method == BATTEN_METHOD_FORWARD_FIT;
		const double fit = fits ? WATERLINES * (54.0 * STATIONS + 29.0 * facts.vertices) : 0.0;
		const bench_contest c = { .workload = &w,
			                      .run = run,
			                      .same = same,
			                      .scale = 1e6 / (double)count,
			                      .operations = (2.0 * (double)facts.term_count + fit) *
			                                    (double)count,
			                      .bytes = 16.0 * NODES * (double)count };
		(void)snprintf(row.name, sizeof row.name, "forward.pass");
		(void)snprintf(row.case_name, sizeof row.case_name, "%s, %zu of 21x20",
		               batten_fair_method_text((size_t)method), count);
		status = bench_against_reference(settings, &c, &row);
	}
	workload_release(&w);
	return status;
}

/* The series of thesis table 5.1 on a hull of its stations, a row an iteration. */
typedef struct series {
	batten_hull *hull;
	batten_fairing *fairings[2]; /* of the device, of the C path */
} series;

static batten_status run_series(const bench_settings *settings, void *series_of, int device,
                                batten_precision precision, batten_run *out)
{
	series *s = series_of;
	batten_fairing **fairing = &s->fairings[device == BATTEN_DEVICE_REFERENCE];
	batten_fair_options options;
	batten_fair_options_default(&options);
	options.method = BATTEN_METHOD_FORWARD_APPROXIMATION;
	options.smooth = false;
	options.search.device = device;
	options.search.precision = precision;
	batten_fairing_destroy(*fairing);
	*fairing = NULL;
	const batten_status status = batten_hull_fair(settings->context, s->hull, &options, fairing);
	if (status == BATTEN_OK && out)
		*out = *batten_fairing_run(*fairing);
	return status;
}

static bool same_series(const void *series_of)
{
	const series *s = series_of;
	const batten_hull *found = batten_fairing_faired(s->fairings[0]);
	const batten_hull *known = batten_fairing_faired(s->fairings[1]);
	const size_t size = batten_hull_station_count(s->hull) * WATERLINES * sizeof(double);
	return memcmp(batten_hull_y_m(found), batten_hull_y_m(known), size) == 0;
}

static batten_status contest_series(const bench_settings *settings)
{
	enum { COUNT = 13 };
	const double x[COUNT] = { 0, 0.8, 1.6, 3.2, 4.8, 6.4, 8, 9.6, 11.2, 12.8, 14.4, 15.2, 16 };
	series s = { 0 };
	bench_row row = { .precision = BATTEN_F64, .unit = "ms per series" };
	(void)snprintf(row.name, sizeof row.name, "forward.pass");
	(void)snprintf(row.case_name, sizeof row.case_name, "table 5.1, 1 of 13x20");
	batten_status status = make_hull(settings->context, COUNT, x, &s.hull);
	const bench_contest c = {
		.workload = &s, .run = run_series, .same = same_series, .scale = 1e3
	};
	if (status == BATTEN_OK)
		status = bench_against_reference(settings, &c, &row);
	batten_fairing_destroy(s.fairings[0]);
	batten_fairing_destroy(s.fairings[1]);
	batten_hull_destroy(s.hull);
	return status;
}

batten_status bench_fairing_pass(const bench_settings *settings)
{
	batten_status status = contest(settings, BATTEN_METHOD_FORWARD_APPROXIMATION, BATTEN_F64,
	                               10000);
	if (status == BATTEN_OK)
		status = contest(settings, BATTEN_METHOD_INVERSE, BATTEN_F64, 10000);
	if (status == BATTEN_OK)
		status = contest(settings, BATTEN_METHOD_FORWARD_FIT, BATTEN_F64, 10000);
	if (status == BATTEN_OK && settings->full)
		status = contest(settings, BATTEN_METHOD_FORWARD_APPROXIMATION, BATTEN_F32, 10000);
	if (status == BATTEN_OK)
		status = contest_series(settings);
	return status;
}
