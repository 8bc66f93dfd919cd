#include "bench.h"

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

const bench_entry bench_entries[] = {
	{ "search.multilevel", "whole pattern searches, OpenCL against the plain C path",
	  bench_search_multilevel },
	{ "search.textbook", "the multilevel search against the thesis's pattern search",
	  bench_search_textbook },
	{ "search.block", "the block search against the multilevel search, and NLopt where it is there",
	  bench_search_block },
	{ "search.lanes", "many block searches: lanes of use, time, memory; iterations of other tables",
	  bench_search_lanes },
	{ "search.batch", "searches in batches of one to many, against the plain C path on one core",
	  bench_search_batch },
	{ "search.net", "searches over control nets, OpenCL against the plain C path",
	  bench_search_net },
	{ "forward.pass", "forward and inverse fairing of many hulls, OpenCL against the plain C path",
	  bench_fairing_pass },
	{ "surface.curvature_grid",
	  "K and H of B-spline surfaces on a grid, OpenCL against the plain C path",
	  bench_surface_curvature_grid },
	{ "surface.energy", "fairness integrals of B-spline surfaces, OpenCL against the plain C path",
	  bench_surface_energy },
	{ "surface.hydrostatics",
	  "B-spline surfaces afloat at five drafts, OpenCL against the plain C path",
	  bench_surface_hydrostatics },
	{ "surface.opencascade", "the same grid against OpenCASCADE, where that is installed",
	  bench_surface_opencascade },
	{ "surface.c_vectors", "curvature grids against the same source compiled as C",
	  bench_surface_c_vectors },
	{ "variation.lackenby",
	  "variants of a trawler and their hydrostatics, against the plain C path",
	  bench_variation_lackenby },
	{ "sweep.end_to_end", "a sweep on all cores, against the slowest of its stages",
	  bench_sweep_end_to_end },
	{ "sweep.merge", "shards of a sweep into one database, against copying their bytes",
	  bench_sweep_merge },
	{ NULL, NULL, NULL },
};

static double seconds_of(clockid_t clock)
{
	struct timespec now = { 0 };
	(void)clock_gettime(clock, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double number_at(bench_numbers numbers, size_t n)
{
	return numbers.precision == BATTEN_F32 ? (double)((const float *)numbers.list)[n]
	                                       : ((const double *)numbers.list)[n];
}

bool bench_numbers_agree(bench_numbers values, bench_numbers known, size_t parts, size_t size)
{
	const double tolerance = values.precision == BATTEN_F64 ? 1e-12 : 1e-4;
	for (size_t part = 0; part < parts * size; part += size) {
		double largest = 0.0;
		for (size_t n = part; n < part + size; n++)
			largest = fmax(largest, fabs(number_at(known, n)));
		for (size_t n = part; n < part + size; n++)
			if (!(fabs(number_at(values, n) - number_at(known, n)) <= tolerance * largest))
				return false;
	}
	return true;
}

double bench_cpu_seconds(void)
{
	return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

double bench_wall_seconds(void)
{
	return seconds_of(CLOCK_MONOTONIC);
}

static int compare(const void *a, const void *b)
{
	const double left = *(const double *)a;
	const double right = *(const double *)b;
	return (left > right) - (left < right);
}

double bench_median(const double values[BENCH_PAIRS])
{
	double sorted[BENCH_PAIRS];
	memcpy(sorted, values, sizeof sorted);
	qsort(sorted, BENCH_PAIRS, sizeof *sorted, compare);
	return sorted[BENCH_PAIRS / 2];
}

void bench_pairs_judge(const bench_pairs *pairs, double scale, bench_row *row)
{
	double ratios[BENCH_PAIRS];
	for (int p = 0; p < BENCH_PAIRS; p++)
		ratios[p] = pairs->reference[p] / pairs->value[p];
	qsort(ratios, BENCH_PAIRS, sizeof *ratios, compare);
	row->value = scale * bench_median(pairs->value);
	row->reference_value = scale * bench_median(pairs->reference);
	row->ratio = ratios[BENCH_PAIRS / 2];
	/* The median lies between the least and the greatest of seven with 98.4 %, between the second
	 * and the sixth with 87.5 %: the wider interval is the one that holds 95 %. */
	row->ratio_low = ratios[0];
	row->ratio_high = ratios[BENCH_PAIRS - 1];
}

bool bench_is_cpu(const bench_settings *settings)
{
	batten_device device;
	const size_t index = settings->device >= 0 ? (size_t)settings->device : 0;
	return batten_device_count(settings->context, NULL) == 0 ||
	       batten_device_describe(settings->context, index, &device) != BATTEN_OK || device.is_cpu;
}

double bench_seconds(const bench_settings *settings)
{
	return bench_is_cpu(settings) ? bench_cpu_seconds() : bench_wall_seconds();
}

bench_function bench_open_peer(const char *name, const char *function)
{
	char path[4096] = "";
	const char *given = getenv("BATTEN_MODULE_PATH");
	char *program = given ? NULL : realpath("/proc/self/exe", NULL);
	char *slash = program ? strrchr(program, '/') : NULL;
	if (slash)
		*slash = '\0';
	if (given || slash)
		(void)snprintf(path, sizeof path, "%s/%s.so", given ? given : program, name);
	free(program);
	void *module = path[0] ? dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE) : NULL;
	void *symbol = module ? dlsym(module, function) : NULL;
	bench_function found = NULL;
	memcpy(&found, &symbol, sizeof found); /* POSIX: the bytes are the same */
	return found;
}

static batten_status timed(const bench_settings *settings, const bench_contest *contest, int device,
                           batten_precision precision, double *seconds)
{
	const double begun = bench_seconds(settings);
	const batten_status status = contest->run(settings, contest->workload, device, precision, NULL);
	*seconds = bench_seconds(settings) - begun;
	return status;
}

/* Warm-up, and the proof that both do the same. */
static batten_status prove_same(const bench_settings *settings, const bench_contest *contest,
                                bench_row *row)
{
	batten_run run = { .strict = true };
	batten_status status = contest->run(settings, contest->workload, settings->device,
	                                    row->precision, &run);
	(void)snprintf(row->device, sizeof row->device, "%s", run.device);
	if (status == BATTEN_OK)
		status = contest->run(settings, contest->workload, BATTEN_DEVICE_REFERENCE, row->precision,
		                      NULL);
	if (status == BATTEN_OK && run.strict && !contest->same(contest->workload))
		status = BATTEN_INTERNAL;
	return status;
}

/* What one core can do, measured beside each pair: the clock changes with its neighbours' load. */
typedef struct limits {
	double operations[BENCH_PAIRS], bytes[BENCH_PAIRS]; /* a second; 0: not measured */
} limits;

static void measure_limits(const bench_contest *contest, batten_precision precision, int pair,
                           limits *l)
{
	l->operations[pair] = contest->operations > 0.0 ? bench_peak(precision) : 0.0;
	l->bytes[pair] = contest->bytes > 0.0 ? bench_stream() : 0.0;
}

static double share_of(double amount, const double *seconds, const double *limit)
{
	double share[BENCH_PAIRS];
	for (int p = 0; p < BENCH_PAIRS; p++)
		share[p] = limit[p] > 0.0 ? 100.0 * amount / seconds[p] / limit[p] : 0.0;
	return bench_median(share);
}

static void judge_limits(const bench_contest *contest, const bench_pairs *pairs, const limits *l,
                         bench_row *row)
{
	const double computed = share_of(contest->operations, pairs->value, l->operations);
	const double moved = share_of(contest->bytes, pairs->value, l->bytes);
	const bool memory = moved > computed;
	row->percent_of_peak = memory ? moved : computed;
	row->peak = bench_median(memory ? l->bytes : l->operations);
	if (row->percent_of_peak > 0.0)
		row->bound = memory ? "memory" : "multiply-adds";
}

batten_status bench_against_reference(const bench_settings *settings, const bench_contest *contest,
                                      bench_row *row)
{
	bench_pairs pairs;
	limits peaks = { { 0.0 }, { 0.0 } };
	batten_status status = prove_same(settings, contest, row);
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		status = timed(settings, contest, settings->device, row->precision, &pairs.value[p]);
		if (status == BATTEN_OK)
			status = timed(settings, contest, BATTEN_DEVICE_REFERENCE, row->precision,
			               &pairs.reference[p]);
		if (bench_is_cpu(settings))
			measure_limits(contest, row->precision, p, &peaks);
	}
	if (status != BATTEN_OK)
		return status;
	row->reference = "reference";
	bench_pairs_judge(&pairs, contest->scale, row);
	judge_limits(contest, &pairs, &peaks, row);
	settings->emit(row, settings->user);
	return BATTEN_OK;
}
