/* sweep.merge: the shards of a sweep put together as one database, all its rows: designs, parameters,
 * measures, and hydrostatics at a draft. The shards are made here, of a small hull that is not faired, so
 * that they are made soon; a row weighs the same. The reference copies the same bytes to one file and
 * brings them to the disk. CPU time of one thread. */
#include "bench.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SIDE = 5, PATH_MOST = 256, NAME_MOST = 32, SHARDS_MOST = 100, TABLES = 4, BUFFER = 1 << 20 };

struct shards {
	char folder[PATH_MOST], hull[PATH_MOST + 16], plan[PATH_MOST + 16], merged[PATH_MOST + 16];
	size_t count, designs; /* of each */
	char names[SHARDS_MOST][PATH_MOST + NAME_MOST];
	const char *paths[SHARDS_MOST];
};

static batten_status write_hull(batten_context *context, const char *path)
{
	double x[SIDE];
	double z[SIDE];
	double y[SIDE * SIDE];
	for (int i = 0; i < SIDE; i++) {
		x[i] = 4.0 * i;
		z[i] = 0.25 * i;
	}
	for (int n = 0; n < SIDE * SIDE; n++) {
		const double u = (x[n % SIDE] - 8.0) / 8.0;
		const double v = 1.0 - z[n / SIDE];
		y[n] = 0.8 * (1.0 - u * u) * (1.0 - v * v);
	}
	const batten_hull_table table = { .name = "small Wigley hull",
		                              .lbp_m = 16.0,
		                              .draft_m = 1.0,
		                              .station_count = SIDE,
		                              .waterline_count = SIDE,
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

static batten_status write_plan(const struct shards *shards)
{
	FILE *stream = fopen(shards->plan, "w");
	if (!stream)
		return BATTEN_IO;
	(void)fprintf(stream,
	              "{\"batten_plan\":1,\"name\":\"bench\",\"parent\":{\"hull\":\"hull.csv\"},"
	              "\"parameters\":{\"dcp\":{\"from\":-3,\"to\":3}},"
	              "\"sampling\":{\"method\":\"sobol\",\"count\":%zu},\"vary\":{\"method\":"
	              "\"lackenby\",\"dcp_pct\":\"dcp\"},\"measure\":{\"drafts_m\":[0.8]}}\n",
	              shards->count * shards->designs);
	return fclose(stream) == 0 ? BATTEN_OK : BATTEN_IO;
}

static batten_status make_shards(const bench_settings *settings, struct shards *shards)
{
	batten_sweep_options options;
	batten_sweep_options_default(&options);
	options.device = settings->device;
	options.shard_count = shards->count;
	batten_status status = write_hull(settings->context, shards->hull);
	if (status == BATTEN_OK)
		status = write_plan(shards);
	for (size_t s = 0; s < shards->count && status == BATTEN_OK; s++) {
		options.shard = s + 1;
		(void)snprintf(shards->names[s], sizeof shards->names[s], "%s/%zu.db", shards->folder,
		               s + 1);
		shards->paths[s] = shards->names[s];
		status = batten_sweep_run(settings->context, shards->plan, shards->paths[s], &options,
		                          NULL);
		status = status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
	}
	return status;
}

static bool copy_into(int to, const char *path, char *buffer)
{
	const int from = open(path, O_RDONLY | O_CLOEXEC);
	ssize_t size = from < 0 ? -1 : 1;
	while (size > 0) {
		size = read(from, buffer, BUFFER);
		if (size > 0 && write(to, buffer, (size_t)size) != size)
			size = -1;
	}
	if (from >= 0)
		(void)close(from);
	return size == 0;
}

static batten_status copy_all(const struct shards *shards)
{
	char *buffer = malloc(BUFFER);
	const int to = open(shards->merged, O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0644);
	bool good = buffer && to >= 0;
	for (size_t s = 0; s < shards->count && good; s++)
		good = copy_into(to, shards->paths[s], buffer);
	good = good && fsync(to) == 0;
	if (to >= 0)
		(void)close(to);
	free(buffer);
	return good ? BATTEN_OK : BATTEN_IO;
}

static batten_status time_pairs(const bench_settings *settings, const struct shards *shards,
                                bench_row *row)
{
	bench_pairs pairs;
	batten_status status = BATTEN_OK;
	for (int p = -1; p < BENCH_PAIRS && status == BATTEN_OK; p++) {
		uint64_t designs = 0;
		const double begun = bench_cpu_seconds();
		status = batten_sweep_merge(settings->context, shards->merged, shards->count, shards->paths,
		                            &designs);
		const double merged = bench_cpu_seconds();
		if (status == BATTEN_OK && designs != shards->count * shards->designs)
			status = BATTEN_INTERNAL;
		(void)unlink(shards->merged);
		if (status == BATTEN_OK)
			status = copy_all(shards);
		(void)unlink(shards->merged);
		if (p < 0)
			continue;
		pairs.value[p] = merged - begun;
		pairs.reference[p] = bench_cpu_seconds() - merged;
	}
	if (status != BATTEN_OK)
		return status;
	bench_pairs_judge(&pairs, 1e6 / (double)(TABLES * shards->count * shards->designs), row);
	settings->emit(row, settings->user);
	return BATTEN_OK;
}

static void remove_shards(const struct shards *shards)
{
	for (size_t s = 0; s < shards->count; s++)
		if (shards->paths[s])
			(void)unlink(shards->paths[s]);
	(void)unlink(shards->plan);
	(void)unlink(shards->hull);
	(void)rmdir(shards->folder);
}

batten_status bench_sweep_merge(const bench_settings *settings)
{
	const char *folder = getenv("TMPDIR");
	bench_row row = { .name = "sweep.merge",
		              .precision = BATTEN_F64,
		              .unit = "us per row",
		              .reference = "bytes copied" };
	struct shards *shards = calloc(1, sizeof *shards);
	if (!shards)
		return BATTEN_MEMORY;
	shards->count = settings->full ? SHARDS_MOST : 10;
	shards->designs = settings->full ? 10000 : 500;
	(void)snprintf(shards->folder, sizeof shards->folder, "%.200s/batten-bench.XXXXXX",
	               folder ? folder : "/tmp");
	batten_status status = mkdtemp(shards->folder) ? BATTEN_OK : BATTEN_IO;
	(void)snprintf(shards->hull, sizeof shards->hull, "%s/hull.csv", shards->folder);
	(void)snprintf(shards->plan, sizeof shards->plan, "%s/plan.json", shards->folder);
	(void)snprintf(shards->merged, sizeof shards->merged, "%s/merged.db", shards->folder);
	(void)snprintf(row.case_name, sizeof row.case_name, "%zu shards of %zu designs", shards->count,
	               shards->designs);
	if (status == BATTEN_OK)
		status = make_shards(settings, shards);
	if (status == BATTEN_OK)
		status = time_pairs(settings, shards, &row);
	remove_shards(shards);
	free(shards);
	return status;
}
