/* variation.lackenby: variants of the BSRA trawler by Lackenby's method, each corrected until its C_P and
 * LCB are what is asked for, with the hydrostatics at five drafts, on the device against the plain C
 * path; and the same written as CSV, a row for every variant and draft. Rows are checked first against
 * batten_hull_vary() and batten_hull_hydrostatics(), one by one. */
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { DRAFTS = 5, CHECKED = 16, PIECE = 4096 };

static const double drafts[DRAFTS] = { 2.515, 2.2, 1.9, 1.5085, 1.2 };

/* Half-breadths of the trawler as the thesis prints them, table B.4 (data/hulls/bsra_trawler.csv): stations
 * 0, 0.5, 1, 2 .. 8, 9, 9.5, 10. */
static const double stations[] = { 0,      1.524,  3.048,  6.096,  9.144,  12.192, 15.24,
	                               18.288, 21.336, 24.384, 27.432, 28.956, 30.48 };
static const double waterlines[] = { 0,      0.2515, 0.377,  0.503,  0.6285,
	                                 0.7545, 1.006,  1.5085, 2.0115, 2.515 };
enum { STATIONS = 13, WATERLINES = 10, NODES = STATIONS * WATERLINES };
static const double offsets[NODES] = {
	0,      0,      0,      0,      0,      0,      0,      0,      0,      0,      0,      0,
	0, /* keel */
	0,      0.0690, 0.1790, 0.5385, 1.0660, 1.6320, 2.0255, 1.7720, 1.1180, 0.5315, 0.1455, 0,
	0,      0,      0.0755, 0.2295, 0.7010, 1.3310, 1.9720, 2.3895, 2.1210, 1.3460, 0.6765, 0.2135,
	0.0195, 0,      0,      0.0870, 0.2790, 0.8415, 1.5505, 2.2170, 2.6065, 2.3490, 1.5390, 0.8065,
	0.2740, 0.0530, 0,      0,      0.0895, 0.3170, 0.9615, 1.7270, 2.3815, 2.7450, 2.4870, 1.6790,
	0.9065, 0.3270, 0.0870, 0,      0,      0.0950, 0.3525, 1.0740, 1.8695, 2.5135, 2.8385, 2.5915,
	1.8065, 1.0040, 0.3750, 0.1135, 0,      0,      0.1150, 0.4325, 1.2920, 2.1185, 2.6995, 2.9620,
	2.7270, 1.9995, 1.1715, 0.4645, 0.1755, 0,      0,      0.1790, 0.6735, 1.7560, 2.5110, 2.9130,
	3.0500, 2.8715, 2.2665, 1.4360, 0.6345, 0.2815, 0,      0,      0.5740, 1.2260, 2.2730, 2.8005,
	3.0120, 3.0500, 2.9470, 2.4550, 1.6745, 0.8020, 0.3915, 0,      0.9195, 1.5525, 2.0255, 2.6670,
	2.9590, 3.0500, 3.0500, 2.9940, 2.6190, 1.9140, 1.0030, 0.5300, 0.0675
};

typedef struct workload {
	size_t count;
	batten_hull *parent;
	batten_vary_options options;
	batten_vary_row *rows;
	batten_vary_result *results;
	batten_hydrostatics *out, *known;
} workload;

static void workload_release(workload *w)
{
	batten_hull_destroy(w->parent);
	free(w->rows);
	free(w->results);
	free(w->out);
	free(w->known);
}

static batten_status workload_create(const bench_settings *settings, workload *w)
{
	uint8_t nodes[NODES];
	*w = (workload){ .count = settings->full ? 100000 : 8192 };
	/* zeros beside a positive offset are the profile, the others empty */
	for (size_t n = 0; n < NODES; n++) {
		const bool beside = (n % STATIONS > 0 && offsets[n - 1] > 0) ||
		                    (n % STATIONS + 1 < STATIONS && offsets[n + 1] > 0) ||
		                    (n + STATIONS < NODES && offsets[n + STATIONS] > 0);
		nodes[n] = offsets[n] > 0 || beside ? BATTEN_NODE_GIVEN : BATTEN_NODE_OUTSIDE;
	}
	const batten_hull_table table = { "BSRA trawler", 30.48,      2.515,   STATIONS, WATERLINES,
		                              stations,       waterlines, offsets, nodes };
	batten_vary_options_default(&w->options);
	w->options.method = BATTEN_VARY_LACKENBY;
	w->rows = calloc(w->count, sizeof *w->rows);
	w->results = calloc(w->count, sizeof *w->results);
	w->out = calloc(w->count * DRAFTS, sizeof *w->out);
	w->known = calloc(w->count * DRAFTS, sizeof *w->known);
	if (!w->rows || !w->results || !w->out || !w->known)
		return BATTEN_MEMORY;
	uint32_t state = 1999;
	for (size_t i = 0; i < w->count; i++) {
		double numbers[2];
		for (size_t k = 0; k < 2; k++) {
			state = state * 1664525u + 1013904223u;
			numbers[k] = (double)(state >> 8) / (1u << 24) - 0.5;
		}
		w->rows[i] = (batten_vary_row){ .dcp_pct = 8 * numbers[0], .dlcb_pct = 3 * numbers[1] };
	}
	return batten_hull_create(settings->context, &table, &w->parent);
}

static batten_status run_batch(const bench_settings *settings, void *user, int device,
                               batten_precision precision, batten_run *run)
{
	workload *w = user;
	(void)precision;
	batten_batch_options batch;
	batten_batch_options_default(&batch);
	batch.device = device;
	const batten_variants variants = { .count = w->count,
		                               .rows = w->rows,
		                               .draft_count = DRAFTS,
		                               .drafts_m = drafts,
		                               .results = w->results,
		                               .out = device == BATTEN_DEVICE_REFERENCE ? w->known
		                                                                        : w->out };
	return batten_hull_vary_measure(settings->context, w->parent, &w->options, NULL, &batch,
	                                &variants, run);
}

static bool same_results(const void *user)
{
	const workload *w = user;
	return memcmp(w->out, w->known, w->count * DRAFTS * sizeof *w->out) == 0;
}

/* The first rows one by one: what the batch found, within 1e-9. */
static batten_status check(const bench_settings *settings, workload *w)
{
	batten_status status = run_batch(settings, w, BATTEN_DEVICE_REFERENCE, BATTEN_F64, NULL);
	for (size_t i = 0; i < CHECKED && status == BATTEN_OK; i++) {
		batten_vary_options one = w->options;
		batten_hull *variant = NULL;
		batten_hydrostatics alone[DRAFTS];
		one.dcp_pct = w->rows[i].dcp_pct;
		one.dlcb_pct = w->rows[i].dlcb_pct;
		status = batten_hull_vary(settings->context, w->parent, &one, &variant, NULL);
		if (status == BATTEN_OK)
			status = batten_hull_hydrostatics(settings->context, variant, NULL, DRAFTS, drafts,
			                                  alone);
		batten_hull_destroy(variant);
		const double *a = (const double *)alone;
		const double *b = (const double *)(w->known + i * DRAFTS);
		for (size_t n = 0; n < DRAFTS * BATTEN_HYDROSTATICS_COUNT && status == BATTEN_OK; n++)
			if (fabs(a[n] - b[n]) > 1e-9 * fmax(fabs(a[n]), 0.1) || isnan(a[n]) != isnan(b[n]))
				status = BATTEN_INTERNAL;
	}
	return status;
}

/* Computed and written, piece by piece, in CPU seconds. */
static batten_status write_pieces(const bench_settings *settings, workload *w, const char *path)
{
	const char *columns[BATTEN_HYDROSTATICS_COUNT];
	workload piece = *w;
	batten_table_file *file = NULL;
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < BATTEN_HYDROSTATICS_COUNT; i++)
		columns[i] = batten_hydrostatics_name(i);
	for (size_t first = 0; first < w->count && status == BATTEN_OK; first += PIECE) {
		piece.count = w->count - first < PIECE ? w->count - first : PIECE;
		piece.rows = w->rows + first;
		status = run_batch(settings, &piece, settings->device, BATTEN_F64, NULL);
		const batten_table table = { .name = "BSRA trawler",
			                         .quadrature = "spline",
			                         .column_count = BATTEN_HYDROSTATICS_COUNT,
			                         .row_count = piece.count * DRAFTS,
			                         .columns = columns,
			                         .values = (const double *)w->out };
		if (status == BATTEN_OK)
			status = file ? batten_table_add(file, &table)
			              : batten_table_open(settings->context, &table, path, &file);
	}
	if (status == BATTEN_OK)
		return batten_table_commit(file);
	batten_table_abandon(file);
	return status;
}

static batten_status time_written(const bench_settings *settings, workload *w, bench_row *row)
{
	const char *folder = getenv("TMPDIR");
	char path[4096];
	bench_pairs pairs;
	batten_status status = BATTEN_OK;
	(void)snprintf(path, sizeof path, "%s/batten_bench_%ld.csv", folder ? folder : "/tmp",
	               (long)getpid());
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		double begun = bench_cpu_seconds();
		status = write_pieces(settings, w, path);
		pairs.value[p] = bench_cpu_seconds() - begun;
		begun = bench_cpu_seconds();
		if (status == BATTEN_OK)
			status = run_batch(settings, w, settings->device, BATTEN_F64, NULL);
		pairs.reference[p] = bench_cpu_seconds() - begun;
	}
	(void)remove(path);
	if (status != BATTEN_OK)
		return status;
	(void)snprintf(row->case_name, sizeof row->case_name, "trawler, 5 drafts, as CSV");
	row->reference = "not written";
	bench_pairs_judge(&pairs, 1e6 / (double)w->count, row);
	settings->emit(row, settings->user);
	return BATTEN_OK;
}

batten_status bench_variation_lackenby(const bench_settings *settings)
{
	workload w;
	bench_row row = { .name = "variation.lackenby",
		              .case_name = "trawler, 5 drafts",
		              .precision = BATTEN_F64,
		              .unit = "us per variant" };
	batten_status status = workload_create(settings, &w);
	const bench_contest contest = {
		.workload = &w, .run = run_batch, .same = same_results, .scale = 1e6 / (double)w.count
	};
	if (status == BATTEN_OK)
		status = check(settings, &w);
	if (status == BATTEN_OK)
		status = bench_against_reference(settings, &contest, &row);
	if (status == BATTEN_OK && bench_is_cpu(settings))
		status = time_written(settings, &w, &row);
	workload_release(&w);
	return status;
}
