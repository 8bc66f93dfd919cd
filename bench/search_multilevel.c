/* search.multilevel: a batch of noisy Wigley hulls, whole searches, on the device against the plain C
 * path on one core's worth of CPU time. The case is the one of the literature notes in bench/README.md:
 * 21 x 20 offsets, L 16, B 1.6, D 1 m, noise 0.01 m, every offset free in 0 .. B/2. */
#include "wigley_case.h"

#include <stdio.h>
#include <string.h>

/* Floating-point operations, the least known, root and division as one each. A single offset: slopes' part of
 * four corners (36), then four evaluations: the step (2), corners (18 each), nodes beside (31 each), the node
 * itself (35), closeness (4); derivatives moved (42). Hats: a term 37, of an evaluation, and three of these, the
 * fourth being known. Levels that wait for their turn, and what is evaluated beside the moves, count
 * nothing. */
#define SINGLE_OPERATIONS (36.0 + 4.0 * (2.0 + 4.0 * 18.0 + 4.0 * 31.0 + 35.0 + 4.0) + 42.0)
#define TERM_OPERATIONS 37.0
#define HAT_EVALUATIONS 3.0

/* Nodes whose terms hats of a width change along one direction, summed over the hats. */
static double terms_along(int count, int width)
{
	int sum = 0;
	for (int centre = 0; centre < count - 1 + width; centre += width) {
		const int first = centre > width ? centre - width : 0;
		const int last = centre + width < count ? centre + width : count - 1;
		sum += last - first + 1;
	}
	return sum;
}

static double iteration_operations(int stations, int waterlines)
{
	double operations = SINGLE_OPERATIONS * stations * waterlines;
	for (int width = 2; width <= (waterlines - 1) / 2; width *= 2)
		operations += HAT_EVALUATIONS * TERM_OPERATIONS * terms_along(stations, 1) *
		              terms_along(waterlines, width);
	return operations;
}

/* One run: the batch, searched whole. */
static batten_status run_batch(const bench_settings *settings, void *user, int device,
                               batten_precision precision, batten_run *run)
{
	const wigley_case *w = user;
	const bool known = device == BATTEN_DEVICE_REFERENCE;
	const batten_grid grid = { WIGLEY_STATIONS, WIGLEY_WATERLINES, w->x, w->z };
	batten_search_options options;
	batten_search_options_default(&options);
	options.algorithm = BATTEN_ALGORITHM_MULTILEVEL;
	options.device = device;
	options.precision = precision;
	return batten_search_batch(settings->context, &grid, w->count, w->problems, &options,
	                           known ? w->known_y : w->y, known ? w->known : w->results, run);
}

static bool same_results(const void *user)
{
	const wigley_case *w = user;
	return memcmp(w->y, w->known_y, w->count * WIGLEY_NODES * sizeof *w->y) == 0;
}

/* What a run works, by the iterations that it takes. */
static batten_status count_operations(const bench_settings *settings, wigley_case *w,
                                      batten_precision precision, double *operations)
{
	const batten_status status = run_batch(settings, w, settings->device, precision, NULL);
	double iterations = 0.0;
	for (size_t h = 0; h < w->count; h++)
		iterations += w->results[h].iterations;
	*operations = iterations * iteration_operations(WIGLEY_STATIONS, WIGLEY_WATERLINES);
	return status;
}

static batten_status run_case(const bench_settings *settings, double raw_w2,
                              batten_precision precision)
{
	wigley_case w;
	bench_row row = { .name = "search.multilevel", .precision = precision, .unit = "us per hull" };
	const bool made = wigley_case_create(settings->full ? 64 : 16, raw_w2, &w);
	batten_status status = made ? BATTEN_OK : BATTEN_MEMORY;
	bench_contest contest = {
		.workload = &w, .run = run_batch, .same = same_results, .scale = 1e6 / (double)w.count
	};
	(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w %g batch %zu", raw_w2, w.count);
	if (status == BATTEN_OK)
		status = count_operations(settings, &w, precision, &contest.operations);
	if (status == BATTEN_OK)
		status = bench_against_reference(settings, &contest, &row);
	wigley_case_release(&w);
	return status;
}

batten_status bench_search_multilevel(const bench_settings *settings)
{
	static const double quick[] = { 1e3 };
	static const double full[] = { 10.0, 1e2, 1e3, 1e4, 1e5 };
	const double *weights = settings->full ? full : quick;
	const size_t count = settings->full ? 5 : 1;
	for (int precision = 0; precision < 2; precision++)
		for (size_t w = 0; w < count; w++) {
			const batten_status status = run_case(settings, weights[w],
			                                      precision ? BATTEN_F32 : BATTEN_F64);
			if (status != BATTEN_OK)
				return status;
		}
	return BATTEN_OK;
}
