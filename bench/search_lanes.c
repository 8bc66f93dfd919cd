/* search.lanes: what many block searches cost beside few: lanes that are of use in a batch of mixed
 * weights, time a hull, memory beyond the caller's arrays, of batches and of a stream; and how many
 * iterations finer tables and square cells take. */
#include "wigley_case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MIXED = 1024, FEW = 256, KNOWN = 4096, TURNS = 16, HULLS = 16 };

static batten_search_options block_options(const bench_settings *settings)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	options.device = settings->device;
	return options;
}

static void emit(const bench_settings *settings, bench_row *row, const batten_run *ran)
{
	(void)snprintf(row->name, sizeof row->name, "search.lanes");
	(void)snprintf(row->device, sizeof row->device, "%s", ran->device);
	settings->emit(row, settings->user);
}

/* A figure that is no time, beside another. */
static void emit_figures(const bench_settings *settings, bench_row *row, const batten_run *ran)
{
	row->ratio = row->reference_value / row->value;
	row->ratio_low = row->ratio_high = row->ratio;
	emit(settings, row, ran);
}

static batten_status search(const bench_settings *settings, const wigley_case *w, size_t count,
                            batten_run *ran)
{
	const batten_grid grid = { WIGLEY_STATIONS, WIGLEY_WATERLINES, w->x, w->z };
	const batten_search_options options = block_options(settings);
	return batten_search_batch(settings->context, &grid, count, w->problems, &options, w->y,
	                           w->results, ran);
}

/* Percent of the lanes' turns that were of use: weights from 10 to 1e5, and one weight. */
static batten_status lanes(const bench_settings *settings)
{
	wigley_case w;
	batten_run mixed = { .strict = true }, same = mixed;
	batten_status status = wigley_case_create(MIXED, 1e3, &w) ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = search(settings, &w, MIXED, &same);
	for (size_t h = 0; h < MIXED && status == BATTEN_OK; h++)
		w.problems[h].w2 = 0.4096 * pow(10.0, 1.0 + 4.0 * (double)(h * 37 % MIXED) / MIXED);
	if (status == BATTEN_OK)
		status = search(settings, &w, MIXED, &mixed);
	if (status == BATTEN_OK) {
		bench_row row = { .case_name = "21x20 w 10..1e5 mixed",
			              .unit = "% of turns",
			              .reference = "w 1e3",
			              .value = 100.0 * mixed.lane_use,
			              .reference_value = 100.0 * same.lane_use };
		emit_figures(settings, &row, &mixed);
	}
	wigley_case_release(&w);
	return status;
}

static batten_status times(const bench_settings *settings, size_t many)
{
	wigley_case w;
	bench_pairs pairs;
	batten_run ran = { .strict = true };
	batten_status status = wigley_case_create(many, 1e3, &w) ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = search(settings, &w, many, &ran);
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		double begun = bench_seconds(settings);
		status = search(settings, &w, many, &ran);
		pairs.value[p] = (bench_seconds(settings) - begun) / (double)many;
		begun = bench_seconds(settings);
		for (int turn = 0; turn < TURNS && status == BATTEN_OK; turn++)
			status = search(settings, &w, FEW, &ran);
		pairs.reference[p] = (bench_seconds(settings) - begun) / (FEW * TURNS);
	}
	if (status == BATTEN_OK) {
		bench_row row = { .unit = "us per hull", .reference = "batch 256" };
		(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w 1e3 batch %zu", many);
		bench_pairs_judge(&pairs, 1e6, &row);
		emit(settings, &row, &ran);
	}
	wigley_case_release(&w);
	return status;
}

/* ---- memory ---- */

/* Most MiB of the process since begin_peak(); 0: not known. */
static double most_memory(void)
{
	static const char name[] = "VmHWM:";
	char line[256];
	double found = 0.0;
	FILE *file = fopen("/proc/self/status", "r");
	while (file && fgets(line, sizeof line, file))
		if (strncmp(line, name, strlen(name)) == 0)
			found = strtod(line + strlen(name), NULL) / 1024.0;
	if (file)
		(void)fclose(file);
	return found;
}

static void begin_peak(void)
{
	FILE *file = fopen("/proc/self/clear_refs", "w");
	if (!file)
		return;
	(void)fputs("5", file);
	(void)fclose(file);
}

/* What a stream takes and leaves. */
typedef struct stream_ends {
	const wigley_case *w;
	size_t count;
	bool converged;
} stream_ends;

static batten_status next_search(void *user, size_t index, batten_search_problem *problem)
{
	const stream_ends *ends = user;
	if (index < ends->count)
		*problem = ends->w->problems[index % ends->w->count];
	return BATTEN_OK;
}

static batten_status take_end(void *user, size_t index, const batten_search_result *result,
                              const double *y_m)
{
	stream_ends *ends = user;
	(void)index;
	(void)y_m;
	ends->converged = ends->converged && result->end == BATTEN_SEARCH_CONVERGED;
	return BATTEN_OK;
}

/* Most MiB of the process, less the caller's arrays, while a batch is searched, or a stream of
 * `streamed`. */
static batten_status peak(const bench_settings *settings, size_t batch, size_t streamed,
                          double *most, batten_run *ran)
{
	wigley_case w;
	batten_status status = wigley_case_create(batch, 1e3, &w) ? BATTEN_OK : BATTEN_MEMORY;
	if (status != BATTEN_OK) {
		wigley_case_release(&w);
		return status;
	}
	/* Of the case's arrays these are written to. */
	const double own = (double)batch * (double)(2 * WIGLEY_NODES * sizeof(double) +
	                                            sizeof *w.problems + sizeof *w.results);
	stream_ends ends = { &w, streamed, true };
	const batten_grid grid = { WIGLEY_STATIONS, WIGLEY_WATERLINES, w.x, w.z };
	const batten_search_options options = block_options(settings);
	begin_peak();
	status = streamed > 0 ? batten_fair_stream(settings->context, &grid, next_search, take_end,
	                                           &ends, &options, NULL, ran)
	                      : search(settings, &w, batch, ran);
	*most = most_memory() - own / (1024.0 * 1024.0);
	wigley_case_release(&w);
	return status == BATTEN_OK && !ends.converged ? BATTEN_INTERNAL : status;
}

static batten_status memory(const bench_settings *settings)
{
	const size_t many = settings->full ? 65536 : 8192;
	const size_t streamed = settings->full ? 1000000 : 8192;
	batten_run ran = { .strict = true };
	double known = 0.0, of_many = 0.0, of_stream = 0.0;
	batten_status status = peak(settings, KNOWN, 0, &known, &ran);
	if (status == BATTEN_OK)
		status = peak(settings, many, 0, &of_many, &ran);
	if (status == BATTEN_OK)
		status = peak(settings, 64, streamed, &of_stream, &ran);
	for (int s = 0; s < 2 && status == BATTEN_OK; s++) {
		bench_row row = { .unit = "MiB",
			              .reference = "batch 4096",
			              .value = s ? of_stream : of_many,
			              .reference_value = known };
		(void)snprintf(row.case_name, sizeof row.case_name, "21x20 %s %zu", s ? "stream" : "batch",
		               s ? streamed : many);
		emit_figures(settings, &row, &ran);
	}
	return status;
}

/* ---- iterations ---- */

typedef struct table {
	const char *name;
	size_t stations, waterlines;
	double length; /* the depth is 1 m */
} table;

/* Noisy Wigley hulls over a table, as those of the case. */
static void fill_hull(const table *t, uint32_t number, double *y)
{
	uint32_t state = 2654435761u * (number + 1);
	for (size_t n = 0; n < t->stations * t->waterlines; n++) {
		state = state * 1664525u + 1013904223u;
		const double u = 2.0 * (double)(n % t->stations) / (double)(t->stations - 1) - 1.0;
		const size_t k = n / t->stations;
		const double v = 1.0 - (double)k / (double)(t->waterlines - 1);
		const double form = 0.8 * (1.0 - u * u) * (1.0 - v * v) +
		                    0.02 * ((double)(state >> 8) / (1u << 24) - 0.5);
		y[n] = fmin(fmax(form, 0.0), 0.8);
	}
}

/* Mean iterations of HULLS searches in a batch. numbers: 2 * HULLS + 2 hulls of the table. */
static batten_status iterations_of(const bench_settings *settings, const table *t, double raw_w2,
                                   double *numbers, double *mean, batten_run *ran)
{
	const size_t nodes = t->stations * t->waterlines;
	double *lower = numbers + 2 * HULLS * nodes, *upper = lower + nodes;
	double x[256], z[256];
	batten_search_problem problems[HULLS];
	batten_search_result results[HULLS];
	const batten_search_options options = block_options(settings);
	for (size_t i = 0; i < t->stations; i++)
		x[i] = t->length * (double)i / (double)(t->stations - 1);
	for (size_t k = 0; k < t->waterlines; k++)
		z[k] = (double)k / (double)(t->waterlines - 1);
	for (size_t n = 0; n < nodes; n++) {
		lower[n] = 0.0;
		upper[n] = 0.8;
	}
	for (size_t h = 0; h < HULLS; h++) {
		double *start = numbers + h * nodes;
		fill_hull(t, (uint32_t)h, start);
		problems[h] = (batten_search_problem){ .start_m = start,
			                                   .target_m = start,
			                                   .lower_m = lower,
			                                   .upper_m = upper,
			                                   .w1 = 1.0,
			                                   .w2 = 0.4096 * raw_w2,
			                                   .half_beam_m = 0.8 };
	}
	const batten_grid grid = { t->stations, t->waterlines, x, z };
	const batten_status status = batten_search_batch(
		settings->context, &grid, HULLS, problems, &options, numbers + HULLS * nodes, results, ran);
	*mean = 0.0;
	for (size_t h = 0; h < HULLS; h++)
		*mean += (double)results[h].iterations / HULLS;
	return status;
}

static batten_status iterations(const bench_settings *settings, double raw_w2)
{
	static const table tables[] = { { "21x20", 21, 20, 16.0 },
		                            { "21x20 square cells", 21, 20, 20.0 / 19.0 },
		                            { "61x31", 61, 31, 16.0 },
		                            { "121x61", 121, 61, 16.0 } };
	const size_t count = settings->full ? 4 : 3;
	double known = 0.0;
	batten_run ran = { .strict = true };
	double *numbers = malloc((2 * HULLS + 2) * (size_t)(121 * 61) * sizeof *numbers);
	batten_status status = numbers ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t t = 0; t < count && status == BATTEN_OK; t++) {
		double mean = 0.0;
		status = iterations_of(settings, &tables[t], raw_w2, numbers, &mean, &ran);
		if (t == 0)
			known = mean;
		bench_row row = {
			.unit = "iterations", .reference = "21x20", .value = mean, .reference_value = known
		};
		(void)snprintf(row.case_name, sizeof row.case_name, "%s w %g", tables[t].name, raw_w2);
		if (t > 0 && status == BATTEN_OK)
			emit_figures(settings, &row, &ran);
	}
	free(numbers);
	return status;
}

batten_status bench_search_lanes(const bench_settings *settings)
{
	static const double weights[] = { 1e3, 10.0, 1e2, 1e4, 1e5 };
	const size_t count = settings->full ? sizeof weights / sizeof weights[0] : 1;
	batten_status status = lanes(settings);
	if (status == BATTEN_OK)
		status = times(settings, settings->full ? 65536 : KNOWN);
	if (status == BATTEN_OK)
		status = memory(settings);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		status = iterations(settings, weights[i]);
	return status;
}
