/* What the benchmarks share: rows of results, and pairs of timings. May use batten.h. */
#ifndef BATTEN_BENCH_BENCH_H
#define BATTEN_BENCH_BENCH_H

#include "batten.h"

/* One figure: value and the reference's in the same unit, both medians; ratio: the median over pairs
 * of how many times faster than the reference, with its 95 % interval. */
typedef struct bench_row {
	char name[48], case_name[48], device[128];
	batten_precision precision;
	const char *unit, *reference;
	double value, reference_value;
	double ratio, ratio_low, ratio_high;
	/* Of one core's multiply-adds, or of what memory gives one core, whichever it uses more of; measured
	 * in the same run; 0: not known. bound: which of the two, or NULL; peak: operations or bytes a
	 * second. */
	double percent_of_peak, peak;
	const char *bound;
} bench_row;

typedef struct bench_settings {
	batten_context *context;
	bool full;  /* the tables of bench/README.md instead of a quick look */
	int device; /* as in batten_search_options */
	/* Called with each row as it is made. */
	void (*emit)(const bench_row *row, void *user);
	void *user;
} bench_settings;

/* Every benchmark; NULL name ends the list. */
typedef struct bench_entry {
	const char *name, *summary;
	batten_status (*run)(const bench_settings *settings);
} bench_entry;
extern const bench_entry bench_entries[];

batten_status bench_search_multilevel(const bench_settings *settings);
batten_status bench_search_block(const bench_settings *settings);
batten_status bench_search_batch(const bench_settings *settings);
batten_status bench_search_lanes(const bench_settings *settings);
batten_status bench_search_textbook(const bench_settings *settings);
batten_status bench_sweep_end_to_end(const bench_settings *settings);
batten_status bench_sweep_merge(const bench_settings *settings);
batten_status bench_search_net(const bench_settings *settings);
batten_status bench_surface_curvature_grid(const bench_settings *settings);
batten_status bench_fairing_pass(const bench_settings *settings);
batten_status bench_surface_energy(const bench_settings *settings);
batten_status bench_surface_hydrostatics(const bench_settings *settings);
batten_status bench_surface_c_vectors(const bench_settings *settings);
batten_status bench_surface_opencascade(const bench_settings *settings);
batten_status bench_variation_lackenby(const bench_settings *settings);

/* Noisy Wigley hull of this number as a bicubic surface of 24 x 12 poles. */
batten_status bench_surface_hull(batten_context *context, uint32_t number, batten_surface **out);

/* ---- pairs ---- */
enum { BENCH_PAIRS = 7 };

/* Timings of interleaved pairs A, B, A, B ... */
typedef struct bench_pairs {
	double value[BENCH_PAIRS], reference[BENCH_PAIRS];
} bench_pairs;

double bench_median(const double values[BENCH_PAIRS]);

/* Fills value, reference_value, ratio and its interval from pairs of seconds times scale. */
void bench_pairs_judge(const bench_pairs *pairs, double scale, bench_row *row);

/* Whether times are those of processors, in CPU seconds, or of another device, in wall seconds. */
bool bench_is_cpu(const bench_settings *settings);

/* ---- the device against the plain C path ---- */

/* What a workload gives; both sides do the same work, each into arrays of its own. */
typedef struct bench_contest {
	void *workload;
	/* One run of one side, into its arrays: the reference's where device is
	 * BATTEN_DEVICE_REFERENCE. run may be NULL. */
	batten_status (*run)(const bench_settings *settings, void *workload, int device,
	                     batten_precision precision, batten_run *run);
	bool (*same)(const void *workload); /* whether both sides' results are equal bit for bit */
	double scale;                       /* from seconds of one run to the row's unit */
	double operations; /* floating-point, of one run, for percent_of_peak; 0: leave that unknown */
	double bytes;      /* read and written, likewise */
} bench_contest;

/* Runs the contest as bench/README.md says and emits row, which has name, case, precision and unit
 * before. CPU seconds where the device is a CPU, wall seconds elsewhere, for both sides. Errors:
 * those of the runs; INTERNAL: the device is strict and the results differ. */
batten_status bench_against_reference(const bench_settings *settings, const bench_contest *contest,
                                      bench_row *row);

/* Floating-point operations a second of one core, multiply-adds in its widest vectors counted as two;
 * 0 where they are not known to be had. Takes milliseconds: measure it beside what it judges. */
double bench_peak(batten_precision precision);

/* Bytes a second that memory gives one core; 0 where memory is out. Takes 20 milliseconds. */
double bench_stream(void);

/* Memory for free(), on large pages where the system has them: of small ones some systems take back what
 * was not touched for a while, and then the journeys to memory that are timed are those of the system.
 * NULL when there is none. */
void *bench_allocate_large(size_t size);

/* Numbers of a benchmark, doubles or, in f32, floats. */
typedef struct bench_numbers {
	const void *list;
	batten_precision precision;
} bench_numbers;

/* Whether every number of `parts` runs of `size` is within 1e-12 (f32: 1e-4) of the known one, relative to
 * the largest that is known of its run. */
bool bench_numbers_agree(bench_numbers values, bench_numbers known, size_t parts, size_t size);

/* CPU seconds of the whole process; wall seconds. */
double bench_cpu_seconds(void);
double bench_wall_seconds(void);
/* Those by which this device is judged. */
double bench_seconds(const bench_settings *settings);

/* A function of a rival that is a module NAME.so of its own, beside the program or where
 * BATTEN_MODULE_PATH says; NULL: it is not there. */
typedef void (*bench_function)(void);
bench_function bench_open_peer(const char *name, const char *function);

#endif
