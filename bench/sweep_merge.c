/* sweep.merge: the shards of a sweep put together as one database, all its rows: designs, parameters,
 * measures, and hydrostatics at a draft. The shards are made here, of a small hull that is not faired, so
 * that they are made soon; a row weighs the same. The reference copies the same bytes to one file and
 * brings them to the disk. CPU time of one thread. */
#include "sweep_files.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SIDE = 5, SHARDS_MOST = 100, TABLES = 4, BUFFER = 1 << 20 };

struct shards {
	sweep_files files;
	char merged[SWEEP_PATH_MOST];
	size_t count, designs; /* of each */
	char names[SHARDS_MOST][SWEEP_PATH_MOST];
	const char *paths[SHARDS_MOST];
};

static batten_status write_plan(const struct shards *shards)
{
	return sweep_files_write_plan(
		&shards->files,
		"{\"batten_plan\":1,\"name\":\"bench\",\"parent\":{\"hull\":\"hull.csv\"},"
		"\"parameters\":{\"dcp\":{\"from\":-3,\"to\":3}},"
		"\"sampling\":{\"method\":\"sobol\",\"count\":%zu},\"vary\":{\"method\":"
		"\"lackenby\",\"dcp_pct\":\"dcp\"},\"measure\":{\"drafts_m\":[0.8]}}\n",
		shards->count * shards->designs);
}

static batten_status make_shards(const bench_settings *settings, struct shards *shards)
{
	batten_sweep_options options;
	batten_sweep_options_default(&options);
	options.device = settings->device;
	options.shard_count = shards->count;
	batten_status status = write_plan(shards);
	for (size_t s = 0; s < shards->count && status == BATTEN_OK; s++) {
		options.shard = s + 1;
		(void)snprintf(shards->names[s], sizeof shards->names[s], "%s/%zu.db", shards->files.folder,
		               s + 1);
		shards->paths[s] = shards->names[s];
		status = batten_sweep_run(settings->context, shards->files.plan, shards->paths[s], &options,
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
	sweep_files_remove(&shards->files);
}

batten_status bench_sweep_merge(const bench_settings *settings)
{
	bench_row row = { .name = "sweep.merge",
		              .precision = BATTEN_F64,
		              .unit = "us per row",
		              .reference = "bytes copied" };
	struct shards *shards = calloc(1, sizeof *shards);
	if (!shards)
		return BATTEN_MEMORY;
	shards->count = settings->full ? SHARDS_MOST : 10;
	shards->designs = settings->full ? 10000 : 500;
	batten_status status = sweep_files_create(settings->context, SIDE, SIDE, 0.0, &shards->files);
	(void)snprintf(shards->merged, sizeof shards->merged, "%s/merged.db", shards->files.folder);
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
