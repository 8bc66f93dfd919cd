/* sweep.end_to_end: a whole sweep, from the plan to the database, on all cores: 21 x 20 offsets of a
 * noisy Wigley hull, Lackenby variants, the search at w2/w1 1e3, measures, hydrostatics at 3 drafts,
 * measures kept. Wall time, interleaved with sweeps whose stages take turns. References: the slowest stage
 * alone, the ratio being the part of its rate that is left when everything runs; all stages one after the
 * other, the ratio being what their overlap gains; and the CPU time spread over all cores, the ratio being
 * the part of the cores in use: where the device is a processor no overlap can pass it. */
#include "sweep_files.h"

#include <stdio.h>
#include <unistd.h>

enum { STATIONS = 21, WATERLINES = 20 };

/* The files of a run. */
struct files {
	sweep_files made;
	char database[SWEEP_PATH_MOST];
};

static batten_status write_plan(const sweep_files *files, batten_precision precision,
                                unsigned count)
{
	return sweep_files_write_plan(
		files,
		"{\"batten_plan\":1,\"name\":\"bench\",\"parent\":{\"hull\":\"hull.csv\"},"
		"\"parameters\":{\"dcp\":{\"from\":-3,\"to\":3},\"dlcb\":{\"from\":-1,\"to\":1}},"
		"\"sampling\":{\"method\":\"sobol\",\"count\":%u},\"vary\":{\"method\":\"lackenby\","
		"\"dcp_pct\":\"dcp\",\"dlcb_pct\":\"dlcb\"},\"fair\":{\"w2_over_w1\":1000,"
		"\"precision\":\"%s\"},\"measure\":{\"drafts_m\":[0.6,0.8,1.0]}}\n",
		count, precision == BATTEN_F64 ? "f64" : "f32");
}

static batten_status make_files(batten_context *context, struct files *files)
{
	const batten_status status = sweep_files_create(context, STATIONS, WATERLINES, 0.02,
	                                                &files->made);
	(void)snprintf(files->database, sizeof files->database, "%s/sweep.db", files->made.folder);
	return status;
}

static void remove_files(const struct files *files)
{
	(void)unlink(files->database);
	sweep_files_remove(&files->made);
}

/* What is timed of a sweep: itself, and what it is held against. */
struct timings {
	bench_pairs slowest, turns, cores;
	const char *slowest_name;
	batten_sweep_progress progress;
};

static double slowest(const batten_sweep_progress *progress, const char **name)
{
	const struct {
		const char *name;
		double seconds;
	} stages[] = { { "vary alone", progress->vary_s },
		           { "fair alone", progress->fair_s },
		           { "measure alone", progress->measure_s },
		           { "store alone", progress->store_s } };
	size_t most = 0;
	for (size_t s = 1; s < sizeof stages / sizeof stages[0]; s++)
		most = stages[s].seconds > stages[most].seconds ? s : most;
	*name = stages[most].name;
	return stages[most].seconds;
}

static batten_status sweep(const bench_settings *settings, const struct files *files,
                           bool stages_take_turns, batten_sweep_progress *progress)
{
	batten_sweep_options options;
	batten_sweep_options_default(&options);
	options.device = settings->device;
	options.stages_take_turns = stages_take_turns;
	const batten_status status = batten_sweep_run(settings->context, files->made.plan,
	                                              files->database, &options, progress);
	(void)unlink(files->database);
	return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
}

static batten_status time_pair(const bench_settings *settings, const struct files *files, int p,
                               struct timings *timings)
{
	const double cores = (double)sysconf(_SC_NPROCESSORS_ONLN);
	batten_sweep_progress turns = { 0 };
	const double begun = bench_cpu_seconds();
	batten_status status = sweep(settings, files, false, &timings->progress);
	const double spent = bench_cpu_seconds() - begun;
	if (status == BATTEN_OK)
		status = sweep(settings, files, true, &turns);
	const double whole = timings->progress.seconds;
	timings->slowest.value[p] = timings->turns.value[p] = timings->cores.value[p] = whole;
	timings->slowest.reference[p] = slowest(&turns, &timings->slowest_name);
	timings->turns.reference[p] = turns.seconds;
	timings->cores.reference[p] = spent / cores;
	return status;
}

static void emit(const bench_settings *settings, const bench_pairs *pairs, const char *reference,
                 double scale, bench_row *row)
{
	row->reference = reference;
	bench_pairs_judge(pairs, scale, row);
	settings->emit(row, settings->user);
}

static batten_status run(const bench_settings *settings, const struct files *files,
                         batten_precision precision, unsigned count)
{
	bench_row row = { .name = "sweep.end_to_end", .precision = precision, .unit = "us/hull" };
	struct timings timings = { .slowest_name = "" };
	batten_status status = write_plan(&files->made, precision, count);
	/* The first one builds the kernels. */
	if (status == BATTEN_OK)
		status = sweep(settings, files, false, &timings.progress);
	for (int p = 0; p < BENCH_PAIRS && status == BATTEN_OK; p++)
		status = time_pair(settings, files, p, &timings);
	if (status != BATTEN_OK)
		return status;
	(void)snprintf(row.device, sizeof row.device, "%s", timings.progress.device);
	(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w 1e3, %u designs", count);
	emit(settings, &timings.slowest, timings.slowest_name, 1e6 / count, &row);
	emit(settings, &timings.turns, "stages in turn", 1e6 / count, &row);
	emit(settings, &timings.cores, "all cores busy", 1e6 / count, &row);
	return BATTEN_OK;
}

batten_status bench_sweep_end_to_end(const bench_settings *settings)
{
	struct files files;
	const unsigned count = settings->full ? 20000 : 8192;
	batten_status status = make_files(settings->context, &files);
	if (status == BATTEN_OK)
		status = run(settings, &files, BATTEN_F64, count);
	if (status == BATTEN_OK)
		status = run(settings, &files, BATTEN_F32, count);
	remove_files(&files);
	return status;
}
