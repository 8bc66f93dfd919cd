/* search.net: a batch of noisy Wigley hulls as bicubic nets of 16 x 10 poles, whole searches for the y
 * of the poles, on the device against the plain C path. L 16, B 1.6, D 1 m, noise of the poles 0.01 m,
 * 4 x 4 Gauss points a span, poles off the centreplane free in 0 .. B/2. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 16, ROWS = 10, POLES = COLUMNS * ROWS, DEGREE = 3, GAUSS = 4 };

/* Floating-point operations, the least known, root and division as one each, multiply-add as two. A sample of a
 * direction: y and five derivatives moved (12), the normal, of which one part never changes (6), its square (4), the
 * second form (15) and the first (6), Gauss and mean curvature (3, 8), a division and a root (2), the density of bending
 * (4), both weights and sums (5); three evaluations a visit: that at y is known, its terms are kept. What
 * is evaluated beside the moves counts nothing, nor do lanes whose search has ended. */
#define SAMPLE_OPERATIONS 65.0
#define EVALUATIONS 3.0

/* Samples that hats of a width see along one direction, summed over the hats with a pole between `low` and `high`,
 * those that may move. */
static double samples_along(int count, int width, int low, int high)
{
	int sum = 0;
	for (int centre = 0; centre < count - 1 + width; centre += width) {
		const int first = centre - width + 1 > 0 ? centre - width + 1 : 0;
		const int last = centre + width - 1 < count ? centre + width - 1 : count - 1;
		const int begin = first > DEGREE ? first - DEGREE : 0;
		const int end = last < count - DEGREE ? last + 1 : count - DEGREE;
		if (first <= high && last >= low)
			sum += GAUSS * (end - begin);
	}
	return sum;
}

/* Poles lie closer along v: hats are widened there first. */
static double iteration_operations(void)
{
	static const int widths[][2] = { { 1, 1 }, { 1, 2 }, { 1, 4 }, { 2, 4 }, { 4, 4 } };
	double samples = 0.0;
	for (size_t w = 0; w < sizeof widths / sizeof widths[0]; w++)
		samples += samples_along(COLUMNS, widths[w][0], 1, COLUMNS - 2) *
		           samples_along(ROWS, widths[w][1], 1, ROWS - 1);
	return EVALUATIONS * SAMPLE_OPERATIONS * samples;
}

typedef struct workload {
	size_t count;
	double lower[POLES], upper[POLES];
	batten_surface **surfaces;
	double *y, *known_y;
	batten_net_problem *problems;
	batten_search_result *results, *known;
} workload;

static void workload_release(workload *w)
{
	for (size_t h = 0; w->surfaces && h < w->count; h++)
		batten_surface_destroy(w->surfaces[h]);
	free(w->surfaces);
	free(w->y);
	free(w->known_y);
	free(w->problems);
	free(w->results);
	free(w->known);
}

/* The mean of a pole's inner knots, uniform over 0 .. 1 and clamped. */
static double place_of(int pole, int poles)
{
	double sum = 0.0;
	for (int d = 1; d <= 3; d++) {
		const double knot = (double)(pole + d - 3) / (double)(poles - 3);
		sum += knot < 0.0 ? 0.0 : knot > 1.0 ? 1.0 : knot;
	}
	return sum / 3.0;
}

static batten_status make_surface(const bench_settings *settings, uint32_t state, double *upper,
                                  batten_surface **out)
{
	double poles[3 * POLES];
	for (int n = 0; n < POLES; n++) {
		const double u = place_of(n % COLUMNS, COLUMNS);
		const double v = place_of(n / COLUMNS, ROWS);
		const double form = 0.8 * 4.0 * u * (1.0 - u) * v * (2.0 - v);
		const bool inside = n % COLUMNS > 0 && n % COLUMNS < COLUMNS - 1 && n >= COLUMNS;
		state = state * 1664525u + 1013904223u;
		const double y = form + 0.02 * ((double)(state >> 8) / (1u << 24) - 0.5);
		poles[3 * n] = 16.0 * u;
		poles[3 * n + 1] = !inside || y < 0.0 ? 0.0 : y > 0.8 ? 0.8 : y;
		poles[3 * n + 2] = v;
		upper[n] = inside ? 0.8 : 0.0;
	}
	const batten_surface_net net = {
		.order_u = 4, .order_v = 4, .count_u = COLUMNS, .count_v = ROWS, .poles_m = poles
	};
	return batten_surface_create(settings->context, &net, out);
}

static batten_status workload_create(const bench_settings *settings, size_t count, double w2,
                                     workload *w)
{
	batten_status status = BATTEN_OK;
	*w = (workload){ .count = count };
	w->surfaces = calloc(count, sizeof(batten_surface *));
	w->y = calloc(count * POLES, sizeof *w->y);
	w->known_y = calloc(count * POLES, sizeof *w->known_y);
	w->problems = calloc(count, sizeof *w->problems);
	w->results = calloc(count, sizeof *w->results);
	w->known = calloc(count, sizeof *w->known);
	if (!w->surfaces || !w->y || !w->known_y || !w->problems || !w->results || !w->known)
		return BATTEN_MEMORY;
	for (size_t h = 0; h < count && status == BATTEN_OK; h++) {
		status = make_surface(settings, 2654435761u * (uint32_t)(h + 1), w->upper, &w->surfaces[h]);
		w->problems[h] = (batten_net_problem){ .start = w->surfaces[h],
			                                   .lower_y_m = w->lower,
			                                   .upper_y_m = w->upper,
			                                   .w1 = 1.0,
			                                   .w2 = w2,
			                                   .half_beam_m = 0.8 };
	}
	return status;
}

/* One run: the batch, searched whole. */
static batten_status run_batch(const bench_settings *settings, void *user, int device,
                               batten_precision precision, batten_run *run)
{
	const workload *w = user;
	const bool known = device == BATTEN_DEVICE_REFERENCE;
	batten_net_options options;
	batten_net_options_default(&options);
	options.search.device = device;
	options.search.precision = precision;
	return batten_net_search_batch(settings->context, w->count, w->problems, &options,
	                               known ? w->known_y : w->y, known ? w->known : w->results, run);
}

static bool same_results(const void *user)
{
	const workload *w = user;
	return memcmp(w->y, w->known_y, w->count * POLES * sizeof *w->y) == 0;
}

/* What a run works, by the iterations that it takes. */
static batten_status count_operations(const bench_settings *settings, workload *w,
                                      batten_precision precision, double *operations)
{
	const batten_status status = run_batch(settings, w, settings->device, precision, NULL);
	double iterations = 0.0;
	for (size_t h = 0; h < w->count; h++)
		iterations += w->results[h].iterations;
	*operations = iterations * iteration_operations();
	return status;
}

static batten_status run_case(const bench_settings *settings, double w2, batten_precision precision)
{
	workload w;
	bench_row row = { .name = "search.net", .precision = precision, .unit = "us per hull" };
	batten_status status = workload_create(settings, settings->full ? 32 : 16, w2, &w);
	bench_contest contest = {
		.workload = &w, .run = run_batch, .same = same_results, .scale = 1e6 / (double)w.count
	};
	(void)snprintf(row.case_name, sizeof row.case_name, "16x10 w %g batch %zu", w2, w.count);
	if (status == BATTEN_OK)
		status = count_operations(settings, &w, precision, &contest.operations);
	if (status == BATTEN_OK)
		status = bench_against_reference(settings, &contest, &row);
	workload_release(&w);
	return status;
}

batten_status bench_search_net(const bench_settings *settings)
{
	static const double quick[] = { 1e3 };
	static const double full[] = { 10.0, 1e3, 1e5 };
	const double *weights = settings->full ? full : quick;
	const size_t count = settings->full ? 3 : 1;
	for (int precision = 0; precision < 2; precision++)
		for (size_t w = 0; w < count; w++) {
			const batten_status status = run_case(settings, weights[w],
			                                      precision ? BATTEN_F32 : BATTEN_F64);
			if (status != BATTEN_OK)
				return status;
		}
	return BATTEN_OK;
}
