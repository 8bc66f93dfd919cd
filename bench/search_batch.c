/* search.batch: what a hull costs in batches of one to many, block and multilevel searches, against the plain C
 * path on one core. */
#include "wigley_case.h"

#include <stdio.h>
#include <string.h>

enum { KNOWN_HULLS = 8, FEW = 4096, MANY = 65536 };

typedef struct batch_case {
	batten_search_algorithm algorithm;
	batten_precision precision;
	size_t count;
} batch_case;

static batten_status search(const bench_settings *settings, const wigley_case *w,
                            const batch_case *c, int device, size_t first, size_t count,
                            batten_run *ran)
{
	const batten_grid grid = { WIGLEY_STATIONS, WIGLEY_WATERLINES, w->x, w->z };
	batten_search_options options;
	batten_search_options_default(&options);
	options.algorithm = c->algorithm;
	options.precision = c->precision;
	options.device = device;
	return batten_search_batch(settings->context, &grid, count, w->problems + first, &options,
	                           w->y + first * WIGLEY_NODES, w->results + first, ran);
}

/* The first hulls on the C path, one after the other, into the arrays of the last. */
static batten_status search_known(const bench_settings *settings, const wigley_case *known,
                                  const batch_case *c, size_t count)
{
	batten_status status = BATTEN_OK;
	for (size_t h = 0; h < count && status == BATTEN_OK; h++)
		status = search(settings, known, c, BATTEN_DEVICE_REFERENCE, h, 1, NULL);
	return status;
}

/* Ends of the first hulls, bit for bit where the device is strict. */
static batten_status compare(const bench_settings *settings, const wigley_case *w,
                             const wigley_case *known, const batch_case *c, size_t count,
                             batten_run *ran)
{
	batten_status status = search_known(settings, known, c, count);
	if (status == BATTEN_OK)
		status = search(settings, w, c, settings->device, 0, c->count, ran);
	const bool same = memcmp(w->y, known->y, count * WIGLEY_NODES * sizeof(double)) == 0;
	return status == BATTEN_OK && ran->strict && !same ? BATTEN_INTERNAL : status;
}

static batten_status run_case(const bench_settings *settings, const wigley_case *w,
                              const wigley_case *known, const batch_case *c)
{
	const size_t count = c->count < KNOWN_HULLS ? c->count : KNOWN_HULLS;
	bench_pairs pairs;
	batten_run ran = { .strict = true };
	batten_status status = compare(settings, w, known, c, count, &ran);
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		double begun = bench_seconds(settings);
		status = search(settings, w, c, settings->device, 0, c->count, &ran);
		pairs.value[p] = (bench_seconds(settings) - begun) / (double)c->count;
		begun = bench_seconds(settings);
		if (status == BATTEN_OK)
			status = search_known(settings, known, c, count);
		pairs.reference[p] = (bench_seconds(settings) - begun) / (double)count;
	}
	if (status != BATTEN_OK)
		return status;
	bench_row row = { .precision = c->precision, .unit = "us per hull", .reference = "reference" };
	(void)snprintf(row.name, sizeof row.name, "search.batch");
	(void)snprintf(row.case_name, sizeof row.case_name, "%s w 1e3 batch %zu",
	               batten_search_algorithm_text(c->algorithm), c->count);
	(void)snprintf(row.device, sizeof row.device, "%s", ran.device);
	bench_pairs_judge(&pairs, 1e6, &row);
	settings->emit(&row, settings->user);
	return BATTEN_OK;
}

batten_status bench_search_batch(const bench_settings *settings)
{
	static const size_t counts[] = { 1, 16, 256, FEW, MANY };
	wigley_case w = { 0 }, known = { 0 };
	batten_status status = wigley_case_create(settings->full ? MANY : FEW, 1e3, &w) &&
	                               wigley_case_create(KNOWN_HULLS, 1e3, &known)
	                           ? BATTEN_OK
	                           : BATTEN_MEMORY;
	for (int a = 0; a < 2; a++)
		for (int p = 0; p < 2; p++)
			for (size_t n = 0; n < sizeof counts / sizeof counts[0] && status == BATTEN_OK; n++) {
				const batch_case c = { a ? BATTEN_ALGORITHM_MULTILEVEL : BATTEN_ALGORITHM_BLOCK,
					                   p ? BATTEN_F32 : BATTEN_F64, counts[n] };
				/* A multilevel search takes forty times as long, and is as one of 4096. */
				if (c.count <= FEW || (settings->full && a == 0))
					status = run_case(settings, &w, &known, &c);
			}
	wigley_case_release(&w);
	wigley_case_release(&known);
	return status;
}
