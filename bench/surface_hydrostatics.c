/* surface.hydrostatics: a batch of bicubic hulls of 24 x 12 poles afloat at five drafts, on the device
 * against the plain C path; and against batten_surface_hydrostatics(), one hull after another. */
#include "bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SURFACES = 32, DRAFTS = 5, CHECKED = 1, POINTS = 12, SPANS_U = 21, SPANS_V = 9 };

static const double drafts[DRAFTS] = { 1.0, 0.8, 0.6, 0.4, 0.2 };

/* Multiplications and additions of a Gauss point: six polynomials and three slopes 48, the normal 9 and
 * its weight 3, its size and all sums 40. Searches, roots, rows and sections are not counted. */
static const double operations_a_point = 100;

typedef struct workload {
	size_t count;
	batten_surface **surfaces;
	batten_hydrostatics *out, *known;
} workload;

static void workload_release(workload *w)
{
	for (size_t s = 0; w->surfaces && s < w->count; s++)
		batten_surface_destroy(w->surfaces[s]);
	free(w->surfaces);
	free(w->out);
	free(w->known);
}

static batten_status workload_create(const bench_settings *settings, workload *w)
{
	w->count = settings->full ? 8 * SURFACES : SURFACES;
	w->surfaces = calloc(w->count, sizeof *w->surfaces);
	w->out = calloc(w->count * DRAFTS, sizeof *w->out);
	w->known = calloc(w->count * DRAFTS, sizeof *w->known);
	batten_status status = w->surfaces && w->out && w->known ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t s = 0; s < w->count && status == BATTEN_OK; s++)
		status = bench_surface_hull(settings->context, (uint32_t)s, &w->surfaces[s]);
	return status;
}

static batten_status run_batch(const bench_settings *settings, void *user, int device,
                               batten_precision precision, batten_run *run)
{
	const workload *w = user;
	(void)precision;
	batten_batch_options batch;
	batten_batch_options_default(&batch);
	batch.device = device;
	return batten_surface_hydrostatics_batch(
		settings->context, w->count, (const batten_surface *const *)w->surfaces, NULL, &batch,
		DRAFTS, drafts, device == BATTEN_DEVICE_REFERENCE ? w->known : w->out, NULL, run);
}

static bool same_results(const void *user)
{
	const workload *w = user;
	return memcmp(w->out, w->known, w->count * DRAFTS * sizeof *w->out) == 0;
}

/* The first surfaces one by one, within 1e-9 of what the batch found, in the pairs' seconds. */
static batten_status run_one_by_one(const bench_settings *settings, const workload *w)
{
	batten_status status = BATTEN_OK;
	for (size_t s = 0; s < CHECKED && status == BATTEN_OK; s++) {
		batten_hydrostatics alone[DRAFTS];
		status = batten_surface_hydrostatics(settings->context, w->surfaces[s], NULL, DRAFTS,
		                                     drafts, alone);
		const double *a = (const double *)alone, *b = (const double *)(w->known + s * DRAFTS);
		for (size_t n = 0; n < DRAFTS * BATTEN_HYDROSTATICS_COUNT && status == BATTEN_OK; n++)
			if (fabs(a[n] - b[n]) > 1e-9 * fmax(fabs(a[n]), 1) || isnan(a[n]) != isnan(b[n]))
				status = BATTEN_INTERNAL;
	}
	return status;
}

static batten_status time_one_by_one(const bench_settings *settings, workload *w, bench_row *row)
{
	bench_pairs pairs;
	batten_status status = BATTEN_OK;
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		double begun = bench_seconds(settings);
		status = run_batch(settings, w, settings->device, BATTEN_F64, NULL);
		pairs.value[p] = (bench_seconds(settings) - begun) / (double)w->count;
		begun = bench_seconds(settings);
		if (status == BATTEN_OK)
			status = run_one_by_one(settings, w);
		pairs.reference[p] = (bench_seconds(settings) - begun) / CHECKED;
	}
	if (status != BATTEN_OK)
		return status;
	row->reference = "one by one";
	row->percent_of_peak = 0;
	row->bound = NULL;
	bench_pairs_judge(&pairs, 1e6, row);
	settings->emit(row, settings->user);
	return BATTEN_OK;
}

batten_status bench_surface_hydrostatics(const bench_settings *settings)
{
	workload w = { .count = 0 };
	bench_row row = { .name = "surface.hydrostatics",
		              .case_name = "24x12 bicubic, 5 drafts",
		              .precision = BATTEN_F64,
		              .unit = "us per surface" };
	batten_status status = workload_create(settings, &w);
	double wet = 0;
	for (size_t d = 0; d < DRAFTS; d++)
		wet += drafts[d] * SPANS_U * SPANS_V * POINTS * POINTS;
	const bench_contest contest = { .workload = &w,
		                            .run = run_batch,
		                            .same = same_results,
		                            .scale = 1e6 / (double)w.count,
		                            .operations = operations_a_point * wet * (double)w.count };
	if (status == BATTEN_OK)
		status = bench_against_reference(settings, &contest, &row);
	if (status == BATTEN_OK)
		status = time_one_by_one(settings, &w, &row);
	workload_release(&w);
	return status;
}
