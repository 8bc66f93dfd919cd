/* search.multilevel: a batch of noisy Wigley hulls, whole searches, on the device against the plain C
 * path on one core's worth of CPU time. The case is the one of the literature notes in bench/README.md:
 * 21 x 20 offsets, L 16, B 1.6, D 1 m, noise 0.01 m, every offset free in 0 .. B/2. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STATIONS = 21, WATERLINES = 20, NODES = STATIONS * WATERLINES };

typedef struct workload {
	size_t count;
	double x[STATIONS], z[WATERLINES], lower[NODES], upper[NODES];
	double *start, *y, *known_y;
	batten_search_problem *problems;
	batten_search_result *results, *known;
} workload;

static void workload_release(workload *w)
{
	free(w->start);
	free(w->y);
	free(w->known_y);
	free(w->problems);
	free(w->results);
	free(w->known);
}

static bool workload_create(size_t count, double w2, workload *w)
{
	*w = (workload){ .count = count };
	w->start = calloc(count * NODES, sizeof *w->start);
	w->y = calloc(count * NODES, sizeof *w->y);
	w->known_y = calloc(count * NODES, sizeof *w->known_y);
	w->problems = calloc(count, sizeof *w->problems);
	w->results = calloc(count, sizeof *w->results);
	w->known = calloc(count, sizeof *w->known);
	if (!w->start || !w->y || !w->known_y || !w->problems || !w->results || !w->known)
		return false;
	for (int i = 0; i < STATIONS; i++)
		w->x[i] = 0.8 * i;
	for (int k = 0; k < WATERLINES; k++)
		w->z[k] = k / 19.0;
	for (size_t h = 0; h < count; h++) {
		uint32_t state = 2654435761u * (uint32_t)(h + 1);
		for (int n = 0; n < NODES; n++) {
			state = state * 1664525u + 1013904223u;
			const double u = (w->x[n % STATIONS] - 8.0) / 8.0;
			const double v = 1.0 - w->z[n / STATIONS];
			const double y = 0.8 * (1.0 - u * u) * (1.0 - v * v) +
			                 0.02 * ((double)(state >> 8) / (1u << 24) - 0.5);
			w->start[h * NODES + (size_t)n] = y < 0.0 ? 0.0 : y > 0.8 ? 0.8 : y;
			w->upper[n] = 0.8;
		}
		w->problems[h] = (batten_search_problem){ .start_m = w->start + h * NODES,
			                                      .target_m = w->start + h * NODES,
			                                      .lower_m = w->lower,
			                                      .upper_m = w->upper,
			                                      .w1 = 1.0,
			                                      .w2 = w2,
			                                      .half_beam_m = 0.8 };
	}
	return true;
}

/* One run: the batch, searched whole. */
static batten_status run_batch(const bench_settings *settings, void *user, int device,
                               batten_precision precision, batten_run *run)
{
	const workload *w = user;
	const bool known = device == BATTEN_DEVICE_REFERENCE;
	const batten_grid grid = { STATIONS, WATERLINES, w->x, w->z };
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = device;
	options.precision = precision;
	return batten_search_batch(settings->context, &grid, w->count, w->problems, &options,
	                           known ? w->known_y : w->y, known ? w->known : w->results, run);
}

static bool same_results(const void *user)
{
	const workload *w = user;
	return memcmp(w->y, w->known_y, w->count * NODES * sizeof *w->y) == 0;
}

static batten_status run_case(const bench_settings *settings, double raw_w2,
                              batten_precision precision)
{
	workload w;
	bench_row row = { .name = "search.multilevel", .precision = precision, .unit = "us per hull" };
	/* Literature quotes w2 in raw metres; dimensionless it is h^4 = 0.4096 times that. */
	const bool made = workload_create(settings->full ? 64 : 16, raw_w2 * 0.4096, &w);
	batten_status status = made ? BATTEN_OK : BATTEN_MEMORY;
	const bench_contest contest = {
		.workload = &w, .run = run_batch, .same = same_results, .scale = 1e6 / (double)w.count
	};
	(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w %g batch %zu", raw_w2, w.count);
	if (status == BATTEN_OK)
		status = bench_against_reference(settings, &contest, &row);
	workload_release(&w);
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
