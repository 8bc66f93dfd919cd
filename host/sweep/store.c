/* Opening, locking, completing and closing the database. */
#include "sweep/store.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

sweep_shard sweep_shard_of(uint64_t design_count, uint64_t index, uint64_t count)
{
	/* Without a product that could overflow: the first `rest` shards have one design more. */
	const uint64_t size = design_count / count;
	const uint64_t rest = design_count % count;
	const uint64_t before = index - 1;
	const uint64_t first = before * size + (before < rest ? before : rest);
	return (sweep_shard){ index, count, first, first + size + (before < rest) };
}

/* ---- journal and lock ---- */

/* File systems of more than one machine: a log that is shared through memory has no place there. What
 * statfs() calls them is in no header. */
static bool is_shared_between_machines(const char *path)
{
	static const unsigned long kinds[] = {
		0x6969,     /* NFS */
		0x0bd00bd0, /* Lustre */
		0x47504653, /* GPFS */
		0x19830326, /* BeeGFS */
		0xff534d42, /* CIFS */
		0xfe534d42, /* SMB2 */
		0x517b,     /* SMB */
		0x5346414f, /* AFS */
		0x00c36400, /* Ceph */
		0x01021997, /* 9p */
	};
	struct statfs facts;
	if (statfs(path, &facts) != 0)
		return true;
	for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
		if (((unsigned long)facts.f_type & 0xffffffff) == kinds[i])
			return true;
	return false;
}

/* Rows of a design fill a kilobyte and come in order: large pages are fewer calls of the system, fewer pages
 * to be split. A log of 8 MB between two syncs. */
static batten_status choose_pages(const sweep_database *database)
{
	return database_run(database, "PRAGMA page_size=16384; PRAGMA wal_autocheckpoint=128");
}

static batten_status choose_journal(const sweep_store *store, batten_sweep_journal journal)
{
	const sweep_database *database = &store->database;
	const bool rollback = journal == BATTEN_SWEEP_JOURNAL_ROLLBACK ||
	                      (journal == BATTEN_SWEEP_JOURNAL_AUTO &&
	                       is_shared_between_machines(database->path));
	sqlite3_stmt *statement = NULL;
	bool row = false;
	batten_status status = database_prepare(database, &statement, "PRAGMA journal_mode=%s",
	                                        rollback ? "TRUNCATE" : "WAL");
	if (status == BATTEN_OK)
		status = database_step(database, statement, &row);
	const char *chosen = row ? (const char *)sqlite3_column_text(statement, 0) : NULL;
	const bool is_log = chosen && strcmp(chosen, "wal") == 0;
	(void)sqlite3_finalize(statement);
	/* The log loses nothing when the program is killed, only what a power cut takes of its end. */
	if (status == BATTEN_OK)
		status = database_run(database,
		                      is_log ? "PRAGMA synchronous=NORMAL" : "PRAGMA synchronous=FULL");
	return status;
}

/* ---- opening ---- */

static batten_status begin_run(sweep_store *store)
{
	const batten_status status = database_run(
		&store->database,
		"INSERT INTO runs (started, designs_done) VALUES (strftime('%Y-%m-%dT%H:%M:%SZ'), 0)");
	store->run = sqlite3_last_insert_rowid(store->database.handle);
	return status;
}

/* Where a run left off: designs are stored in their order, whole blocks at a time. */
static batten_status find_next(sweep_store *store)
{
	int64_t count = 0;
	int64_t last = 0;
	batten_status status = database_whole(&store->database, "SELECT count(*) FROM designs", &count);
	if (status == BATTEN_OK)
		status = database_whole(&store->database, "SELECT ifnull(max(id), -1) FROM designs", &last);
	store->next = store->shard.first + (uint64_t)count;
	if (status == BATTEN_OK && count > 0 && (uint64_t)last + 1 != store->next)
		return batten_fail(store->database.context, BATTEN_INPUT,
		                   "%s: has %lld designs but ends with number %lld: it is damaged",
		                   store->database.path, (long long)count, (long long)last);
	return status;
}

static batten_status load_best(sweep_store *store)
{
	const sweep_plan *plan = store->plan;
	if (plan->keep != PLAN_KEEP_BEST)
		return BATTEN_OK;
	sqlite3_stmt *statement = NULL;
	bool row = true;
	batten_status status = sweep_best_create(store->database.context, plan->keep_count,
	                                         &store->best);
	if (status == BATTEN_OK)
		status = database_prepare(&store->database, &statement,
		                          "SELECT id, \"%s\" FROM geometry JOIN measures USING (id)",
		                          sweep_measure_name(plan->keep_by.measure));
	while (status == BATTEN_OK) {
		status = database_step(&store->database, statement, &row);
		if (status != BATTEN_OK || !row)
			break;
		const double value = sqlite3_column_double(statement, 1);
		uint64_t dropped = 0;
		(void)sweep_best_offer(&store->best,
		                       (best_entry){ plan->keep_by.greatest ? -value : value,
		                                     (uint64_t)sqlite3_column_int64(statement, 0) },
		                       &dropped);
	}
	(void)sqlite3_finalize(statement);
	return status;
}

/* The tables are made, or checked, in one transaction together with the row of the run. */
static batten_status enter(sweep_store *store)
{
	const sweep_database *database = &store->database;
	int64_t tables = 0;
	batten_status status = database_run(database, "BEGIN EXCLUSIVE");
	if (status != BATTEN_OK)
		return status;
	status = database_whole(database, "SELECT count(*) FROM sqlite_master", &tables);
	/* A run that was killed before its first commit leaves an empty file. */
	if (status == BATTEN_OK)
		status = tables == 0 ? store_make_schema(store) : store_check(store);
	if (status == BATTEN_OK)
		status = begin_run(store);
	if (status == BATTEN_OK)
		status = database_run(database, "COMMIT");
	if (status != BATTEN_OK)
		(void)sqlite3_exec(database->handle, "ROLLBACK", NULL, NULL, NULL);
	if (status == BATTEN_OK)
		status = find_next(store);
	if (status == BATTEN_OK)
		status = load_best(store);
	return status == BATTEN_OK ? store_prepare(store) : status;
}

static batten_status open_at(const sweep_plan *plan, const sweep_shard *shard, const char *path,
                             batten_sweep_journal journal, bool is_new, sweep_store *out)
{
	sweep_store store = { .plan = plan, .shard = *shard };
	batten_status status = database_open(plan->context, path, DATABASE_CREATE, &store.database);
	/* A locked file keeps the index of its log in this process's memory. */
	if (status == BATTEN_OK)
		status = database_run(&store.database, "PRAGMA locking_mode=EXCLUSIVE");
	/* What is there is looked at before the journal is chosen, which writes to it. */
	int64_t tables = 0;
	if (status == BATTEN_OK)
		status = database_whole(&store.database, "SELECT count(*) FROM sqlite_master", &tables);
	if (status == BATTEN_OK && tables > 0)
		status = store_check(&store);
	if (status == BATTEN_OK)
		status = choose_pages(&store.database);
	if (status == BATTEN_OK)
		status = choose_journal(&store, journal);
	if (status == BATTEN_OK)
		status = enter(&store);
	if (status != BATTEN_OK) {
		sweep_store_close(&store);
		if (is_new)
			(void)unlink(path);
		return status;
	}
	*out = store;
	return BATTEN_OK;
}

batten_status sweep_store_open(const sweep_plan *plan, const sweep_shard *shard, const char *path,
                               const store_opening *opening, sweep_store *out)
{
	struct stat facts;
	const int file = open(path, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
	const bool is_there = file < 0 && errno == EEXIST;
	if (file < 0 && !is_there)
		return batten_fail(plan->context, BATTEN_IO, "%s: cannot be made: %s", path,
		                   strerror(errno));
	if (file >= 0)
		(void)close(file);
	if (is_there && (stat(path, &facts) != 0 || !S_ISREG(facts.st_mode)))
		return batten_fail(plan->context, BATTEN_IO,
		                   "%s: is no plain file, a database was expected", path);
	if (is_there && !opening->resume)
		return batten_fail(plan->context, BATTEN_USAGE,
		                   "%s: is there already: to go on with it, ask for --resume", path);
	return open_at(plan, shard, path, opening->journal, !is_there, out);
}

batten_status sweep_store_create(const sweep_plan *plan, const sweep_shard *shard, const char *path,
                                 sweep_store *out)
{
	return open_at(plan, shard, path, BATTEN_SWEEP_JOURNAL_ROLLBACK, true, out);
}

/* ---- the end ---- */

batten_status sweep_store_complete(sweep_store *store)
{
	const sweep_database *database = &store->database;
	batten_status status = database_run(database, "BEGIN");
	if (status != BATTEN_OK)
		return status;
	status = store_mark_front(store);
	if (status == BATTEN_OK)
		status = database_run(database, "UPDATE meta SET value = 1 WHERE key = 'complete'");
	if (status == BATTEN_OK)
		status = database_run(database, "COMMIT");
	if (status != BATTEN_OK)
		(void)sqlite3_exec(database->handle, "ROLLBACK", NULL, NULL, NULL);
	return status;
}

batten_status sweep_store_end_run(sweep_store *store, const store_run *run)
{
	sqlite3_stmt *statement = NULL;
	batten_status status = database_prepare(
		&store->database, &statement,
		"UPDATE runs SET ended = strftime('%%Y-%%m-%%dT%%H:%%M:%%SZ'), device = ?1, threads = ?2, "
		"seconds = ?3, designs_done = ?4, exit = ?5 WHERE run = ?6");
	if (status == BATTEN_OK) {
		(void)sqlite3_bind_text(statement, 1, run->device, -1, SQLITE_STATIC);
		(void)sqlite3_bind_int64(statement, 2, run->threads);
		(void)sqlite3_bind_double(statement, 3, run->seconds);
		(void)sqlite3_bind_int64(statement, 4, (sqlite3_int64)run->designs_done);
		(void)sqlite3_bind_text(statement, 5, run->exit, -1, SQLITE_STATIC);
		(void)sqlite3_bind_int64(statement, 6, store->run);
		status = database_do(&store->database, statement);
	}
	(void)sqlite3_finalize(statement);
	/* One file, which a reader may open from anywhere; a database that is not finished keeps its
	 * log if this fails. */
	if (status == BATTEN_OK)
		store_drop_journal(store);
	return status;
}

/* A locked database would keep its rollback journal, emptied; the lock goes with the next read. */
void store_drop_journal(const sweep_store *store)
{
	(void)sqlite3_exec(store->database.handle,
	                   "PRAGMA locking_mode=NORMAL; SELECT count(*) FROM meta;"
	                   "PRAGMA journal_mode=DELETE",
	                   NULL, NULL, NULL);
}

void sweep_store_close(sweep_store *store)
{
	sqlite3_stmt *const statements[] = { store->design,       store->parameters, store->measures,
		                                 store->hydrostatics, store->geometry,   store->forget };
	for (size_t i = 0; i < sizeof statements / sizeof statements[0]; i++)
		(void)sqlite3_finalize(statements[i]);
	sweep_best_release(&store->best);
	database_close(&store->database);
	*store = (sweep_store){ 0 };
}
