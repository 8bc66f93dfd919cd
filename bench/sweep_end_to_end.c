/* sweep.end_to_end: a whole sweep, from the plan to the database, on all cores: 21 x 20 offsets of a
 * noisy Wigley hull, Lackenby variants, the search at w2/w1 1e3, measures, hydrostatics at 3 drafts,
 * measures kept. The reference is the slowest stage alone, timed within the same run: the ratio is the
 * part of its rate that is left when everything runs. Wall time. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STATIONS = 21, WATERLINES = 20, NODES = STATIONS * WATERLINES, PATH_MOST = 256 };

/* The files of a run, in a folder of its own. */
struct files {
	char folder[PATH_MOST], hull[PATH_MOST + 16], plan[PATH_MOST + 16], database[PATH_MOST + 16];
};

static batten_status write_hull(batten_context *context, const char *path)
{
	double x[STATIONS];
	double z[WATERLINES];
	double y[NODES];
	uint32_t state = 2654435761u;
	for (int i = 0; i < STATIONS; i++)
		x[i] = 0.8 * i;
	for (int k = 0; k < WATERLINES; k++)
		z[k] = k / 19.0;
	for (int n = 0; n < NODES; n++) {
		const double u = (x[n % STATIONS] - 8.0) / 8.0;
		const double v = 1.0 - z[n / STATIONS];
		const double exact = 0.8 * (1.0 - u * u) * (1.0 - v * v);
		state = state * 1664525u + 1013904223u;
		const double noisy = exact + 0.02 * ((double)(state >> 8) / (1u << 24) - 0.5);
		y[n] = exact > 0.0 && noisy > 0.0 ? noisy : 0.0;
	}
	const batten_hull_table table = { .name = "noisy Wigley hull",
		                              .lbp_m = 16.0,
		                              .draft_m = 1.0,
		                              .station_count = STATIONS,
		                              .waterline_count = WATERLINES,
		                              .x_m = x,
		                              .z_m = z,
		                              .y_m = y };
	batten_hull *hull = NULL;
	batten_status status = batten_hull_create(context, &table, &hull);
	if (status == BATTEN_OK)
		status = batten_hull_write(context, hull, path);
	batten_hull_destroy(hull);
	return status;
}

static batten_status write_plan(const char *path, batten_precision precision, unsigned count)
{
	FILE *stream = fopen(path, "w");
	if (!stream)
		return BATTEN_IO;
	(void)fprintf(
		stream,
		"{\"batten_plan\":1,\"name\":\"bench\",\"parent\":{\"hull\":\"hull.csv\"},"
		"\"parameters\":{\"dcp\":{\"from\":-3,\"to\":3},\"dlcb\":{\"from\":-1,\"to\":1}},"
		"\"sampling\":{\"method\":\"sobol\",\"count\":%u},\"vary\":{\"method\":\"lackenby\","
		"\"dcp_pct\":\"dcp\",\"dlcb_pct\":\"dlcb\"},\"fair\":{\"w2_over_w1\":1000,"
		"\"precision\":\"%s\"},\"measure\":{\"drafts_m\":[0.6,0.8,1.0]}}\n",
		count, precision == BATTEN_F64 ? "f64" : "f32");
	return fclose(stream) == 0 ? BATTEN_OK : BATTEN_IO;
}

static batten_status make_files(batten_context *context, struct files *files)
{
	const char *folder = getenv("TMPDIR");
	(void)snprintf(files->folder, sizeof files->folder, "%.200s/batten-bench.XXXXXX",
	               folder ? folder : "/tmp");
	if (!mkdtemp(files->folder))
		return BATTEN_IO;
	(void)snprintf(files->hull, sizeof files->hull, "%s/hull.csv", files->folder);
	(void)snprintf(files->plan, sizeof files->plan, "%s/plan.json", files->folder);
	(void)snprintf(files->database, sizeof files->database, "%s/sweep.db", files->folder);
	return write_hull(context, files->hull);
}

static void remove_files(const struct files *files)
{
	(void)unlink(files->database);
	(void)unlink(files->plan);
	(void)unlink(files->hull);
	(void)rmdir(files->folder);
}

static const char *slowest(const batten_sweep_progress *progress, double *seconds)
{
	const struct {
		const char *name;
		double seconds;
	} stages[] = { { "vary", progress->vary_s },
		           { "fair", progress->fair_s },
		           { "measure", progress->measure_s },
		           { "store", progress->store_s } };
	size_t most = 0;
	for (size_t s = 1; s < sizeof stages / sizeof stages[0]; s++)
		most = stages[s].seconds > stages[most].seconds ? s : most;
	*seconds = stages[most].seconds;
	return stages[most].name;
}

static batten_status run(const bench_settings *settings, const struct files *files,
                         batten_precision precision, unsigned count)
{
	bench_row row = { .name = "sweep.end_to_end", .precision = precision, .unit = "us/hull" };
	bench_pairs pairs;
	batten_sweep_options options;
	batten_sweep_options_default(&options);
	options.device = settings->device;
	batten_status status = write_plan(files->plan, precision, count);
	/* The first one builds the kernels. */
	for (int p = -1; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		batten_sweep_progress progress = { 0 };
		status = batten_sweep_run(settings->context, files->plan, files->database, &options,
		                          &progress);
		if (status == BATTEN_INCOMPLETE)
			status = BATTEN_OK;
		(void)unlink(files->database);
		if (p < 0)
			continue;
		pairs.value[p] = progress.seconds;
		row.reference = slowest(&progress, &pairs.reference[p]);
		(void)snprintf(row.device, sizeof row.device, "%s", progress.device);
	}
	if (status != BATTEN_OK)
		return status;
	(void)snprintf(row.case_name, sizeof row.case_name, "21x20 w 1e3, %u designs", count);
	bench_pairs_judge(&pairs, 1e6 / count, &row);
	settings->emit(&row, settings->user);
	return BATTEN_OK;
}

batten_status bench_sweep_end_to_end(const bench_settings *settings)
{
	struct files files;
	const unsigned count = settings->full ? 10000 : 256;
	batten_status status = make_files(settings->context, &files);
	if (status == BATTEN_OK)
		status = run(settings, &files, BATTEN_F64, count);
	if (status == BATTEN_OK)
		status = run(settings, &files, BATTEN_F32, count);
	remove_files(&files);
	return status;
}
