/* batten_sweep_merge: the shards of a sweep as one database. */
#include "sweep/store.h"
#include "sweep/stored_plan.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The shards, each at its place. */
struct merge {
	batten_context *context;
	const sweep_plan *plan;
	size_t count;
	const char **paths; /* [count], by shard number - 1; NULL: not met yet */
};

static batten_status meta_whole(const sweep_database *database, const char *key, uint64_t *out)
{
	char *text = NULL;
	const batten_status status = store_meta(database, key, &text, NULL);
	if (status == BATTEN_OK)
		*out = strtoull(text, NULL, 10);
	batten_release(database->context, text);
	return status;
}

static batten_status check_hash(const sweep_database *database, const sweep_plan *plan)
{
	char *hash = NULL;
	batten_status status = store_meta(database, "plan_hash", &hash, NULL);
	if (status == BATTEN_OK && strcmp(hash, plan->hash) != 0)
		status = batten_fail(database->context, BATTEN_INPUT,
		                     "%s: belongs to another plan: found hash %.40s, expected %s",
		                     database->path, hash, plan->hash);
	batten_release(database->context, hash);
	return status;
}

/* Puts a database at its place among the shards. */
static batten_status place(struct merge *merge, const sweep_database *database, const char *path)
{
	uint64_t shard = 0;
	uint64_t shards = 0;
	uint64_t complete = 0;
	batten_status status = store_check_kind(database);
	if (status == BATTEN_OK)
		status = check_hash(database, merge->plan);
	if (status == BATTEN_OK)
		status = meta_whole(database, "shard", &shard);
	if (status == BATTEN_OK)
		status = meta_whole(database, "shards", &shards);
	if (status == BATTEN_OK)
		status = meta_whole(database, "complete", &complete);
	if (status != BATTEN_OK)
		return status;
	if (shards != merge->count || shard < 1 || shard > shards)
		return batten_fail(merge->context, BATTEN_INPUT,
		                   "%s: is shard %llu of %llu, but %zu databases were given", path,
		                   (unsigned long long)shard, (unsigned long long)shards, merge->count);
	if (!complete)
		return batten_fail(merge->context, BATTEN_INPUT,
		                   "%s: shard %llu is not complete: let its sweep go on by --resume", path,
		                   (unsigned long long)shard);
	if (merge->paths[shard - 1])
		return batten_fail(merge->context, BATTEN_INPUT, "%s and %s: both are shard %llu of %llu",
		                   merge->paths[shard - 1], path, (unsigned long long)shard,
		                   (unsigned long long)shards);
	merge->paths[shard - 1] = path;
	return BATTEN_OK;
}

static batten_status sort_shards(struct merge *merge, const char *const *paths)
{
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < merge->count && status == BATTEN_OK; i++) {
		sweep_database database = { 0 };
		status = database_open(merge->context, paths[i], DATABASE_READ, &database);
		if (status == BATTEN_OK)
			status = place(merge, &database, paths[i]);
		database_close(&database);
	}
	return status;
}

/* ---- copying ---- */

/* Marks of the front are made anew; runs get new numbers. */
static const char copy_rows[] =
	"BEGIN;"
	"INSERT INTO designs SELECT id, status, reason, pareto * 0 FROM shard.designs ORDER BY id;"
	"INSERT INTO parameters SELECT * FROM shard.parameters ORDER BY id;"
	"INSERT INTO measures SELECT * FROM shard.measures ORDER BY id;"
	"INSERT INTO hydrostatics SELECT * FROM shard.hydrostatics ORDER BY id, draft_m;"
	"INSERT INTO geometry SELECT * FROM shard.geometry ORDER BY id;"
	"INSERT INTO runs (started, ended, device, threads, seconds, designs_done, exit)"
	" SELECT started, ended, device, threads, seconds, designs_done, exit FROM shard.runs"
	" ORDER BY run;"
	"COMMIT;"
	"DETACH shard";

static batten_status copy_shard(const sweep_store *store, const char *path)
{
	sqlite3_stmt *statement = NULL;
	batten_status status = database_prepare(&store->database, &statement, "ATTACH ?1 AS shard");
	if (status == BATTEN_OK) {
		(void)sqlite3_bind_text(statement, 1, path, -1, SQLITE_STATIC);
		status = database_do(&store->database, statement);
	}
	(void)sqlite3_finalize(statement);
	return status == BATTEN_OK ? database_run(&store->database, copy_rows) : status;
}

/* The best of every shard are more than the best of all. */
static batten_status keep_best(const sweep_store *store)
{
	const sweep_plan *plan = store->plan;
	if (plan->keep != PLAN_KEEP_BEST)
		return BATTEN_OK;
	sqlite3_stmt *statement = NULL;
	batten_status status = database_prepare(
		&store->database, &statement,
		"DELETE FROM geometry WHERE id NOT IN (SELECT id FROM geometry JOIN measures USING (id) "
		"ORDER BY \"%s\" %s, id LIMIT %llu)",
		sweep_measure_name(plan->keep_by.measure), plan->keep_by.greatest ? "DESC" : "ASC",
		(unsigned long long)plan->keep_count);
	if (status == BATTEN_OK)
		status = database_do(&store->database, statement);
	(void)sqlite3_finalize(statement);
	return status;
}

static batten_status copy_all(const struct merge *merge, sweep_store *store)
{
	/* The file is new, and thrown away if anything fails. */
	store_drop_journal(store);
	batten_status status = database_run(&store->database, "PRAGMA journal_mode=OFF;"
	                                                      "PRAGMA synchronous=OFF;"
	                                                      "DELETE FROM runs");
	for (size_t s = 0; s < merge->count && status == BATTEN_OK; s++)
		status = copy_shard(store, merge->paths[s]);
	int64_t designs = 0;
	if (status == BATTEN_OK)
		status = database_whole(&store->database, "SELECT count(*) FROM designs", &designs);
	if (status == BATTEN_OK && (uint64_t)designs != merge->plan->sampling.count)
		status = batten_fail(merge->context, BATTEN_INPUT,
		                     "the shards have %lld designs, %llu were expected: one is damaged",
		                     (long long)designs, (unsigned long long)merge->plan->sampling.count);
	if (status == BATTEN_OK)
		status = keep_best(store);
	return status == BATTEN_OK ? sweep_store_complete(store) : status;
}

/* ---- the file ---- */

static batten_status sync_and_rename(batten_context *context, const char *from, const char *to)
{
	const int file = open(from, O_RDONLY | O_CLOEXEC);
	const bool synced = file >= 0 && fsync(file) == 0;
	if (file >= 0)
		(void)close(file);
	if (synced && chmod(from, 0644) == 0 && rename(from, to) == 0)
		return BATTEN_OK;
	return batten_fail(context, BATTEN_IO, "%s: cannot be written", to);
}

static batten_status write_merged(const struct merge *merge, const char *path)
{
	batten_context *context = merge->context;
	const size_t size = strlen(path) + sizeof ".XXXXXX";
	char *temporary = batten_allocate(context, size, 1);
	if (!temporary)
		return BATTEN_MEMORY;
	(void)snprintf(temporary, size, "%s.XXXXXX", path);
	const int file = mkstemp(temporary);
	sweep_store store = { 0 };
	const sweep_shard whole = sweep_shard_of(merge->plan->sampling.count, 1, 1);
	batten_status status = file >= 0 ? BATTEN_OK
	                                 : batten_fail(context, BATTEN_IO, "%s: cannot be made", path);
	if (file >= 0)
		(void)close(file);
	if (status == BATTEN_OK)
		status = sweep_store_create(merge->plan, &whole, temporary, &store);
	if (status == BATTEN_OK)
		status = copy_all(merge, &store);
	sweep_store_close(&store);
	if (status == BATTEN_OK)
		status = sync_and_rename(context, temporary, path);
	if (status != BATTEN_OK && file >= 0)
		(void)unlink(temporary);
	batten_release(context, temporary);
	return status;
}

static bool is_same_file(const char *a, const char *b)
{
	struct stat first;
	struct stat second;
	return stat(a, &first) == 0 && stat(b, &second) == 0 && first.st_dev == second.st_dev &&
	       first.st_ino == second.st_ino;
}

static batten_status check_paths(batten_context *context, const char *out_path, size_t count,
                                 const char *const *paths)
{
	if (count < 1)
		return batten_fail(context, BATTEN_USAGE, "databases of shards were expected");
	for (size_t i = 0; i < count; i++)
		if (is_same_file(out_path, paths[i]))
			return batten_fail(context, BATTEN_USAGE,
			                   "%s: is one of the shards, another file was expected", out_path);
	return BATTEN_OK;
}

batten_status batten_sweep_merge(batten_context *context, const char *out_path, size_t count,
                                 const char *const *paths, uint64_t *designs)
{
	batten_status status = check_paths(context, out_path, count, paths);
	if (status != BATTEN_OK)
		return status;
	sweep_database first = { 0 };
	sweep_plan *plan = NULL;
	struct merge merge = { .context = context, .count = count };
	merge.paths = batten_allocate(context, count, sizeof *merge.paths);
	status = merge.paths ? database_open(context, paths[0], DATABASE_READ, &first) : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = stored_plan_read(&first, &plan);
	database_close(&first);
	merge.plan = plan;
	if (status == BATTEN_OK)
		status = sort_shards(&merge, paths);
	if (status == BATTEN_OK)
		status = write_merged(&merge, out_path);
	if (status == BATTEN_OK && designs)
		*designs = plan->sampling.count;
	sweep_plan_destroy(plan);
	batten_release(context, merge.paths);
	return status;
}
