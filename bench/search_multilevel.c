/* search.multilevel: a batch of noisy Wigley hulls, whole searches, on the device against the plain C
 * path on one core's worth of CPU time. The case is the one of the literature notes in bench/README.md:
 * 21 x 20 offsets, L 16, B 1.6, D 1 m, noise 0.01 m, every offset free in 0 .. B/2. */
#include "wigley_case.h"

#include <stdio.h>
#include <string.h>

/* One run: the batch, searched whole. */
static batten_status run_batch(const bench_settings *settings, void *user, int device,
                               batten_precision precision, batten_run *run)
{
	const wigley_case *w = user;
	const bool known = device == BATTEN_DEVICE_REFERENCE;
	const batten_grid grid = { WIGLEY_STATIONS, WIGLEY_WATERLINES, w->x, w->z };
	batten_search_options options;
	batten_search_options_default(&options);
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

static batten_status run_case(const bench_settings *settings, double raw_w2,
                              batten_precision precision)
{
	wigley_case w;
	bench_row row = { .name = "search.multilevel", .precision = precision, .unit = "us per hull" };
	const bool made = wigley_case_create(settings->full ? 64 : 16, raw_w2, &w);
	batten_status status = made ? BATTEN_OK : BATTEN_MEMORY;
	const bench_contest contest = {
		.workload = &w, .run = run_batch, .same = same_results, .scale = 1e6 / (double)w.count
	};
	(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w %g batch %zu", raw_w2, w.count);
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
