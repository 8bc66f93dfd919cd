/* The database of a sweep (README.md has its tables): one writer, a row for every design. */
#ifndef BATTEN_SWEEP_STORE_H
#define BATTEN_SWEEP_STORE_H

#include "sweep/best.h"
#include "sweep/block.h"
#include "sweep/database.h"
#include "sweep/schema.h"

/* A part of a sweep: number `index` of count parts, from 1; its designs are first to end - 1. */
typedef struct sweep_shard {
	uint64_t index, count, first, end;
} sweep_shard;
sweep_shard sweep_shard_of(uint64_t design_count, uint64_t index, uint64_t count);

typedef struct sweep_store {
	sweep_database database;
	const sweep_plan *plan;
	sweep_shard shard;
	uint64_t next;   /* the first design that is not there yet */
	int64_t run;     /* row of runs */
	sweep_best best; /* kept offsets, when only the best are */
	sqlite3_stmt *design, *parameters, *measures, *hydrostatics, *geometry, *forget;
} sweep_store;

/* How a database is opened. */
typedef struct store_opening {
	bool resume;
	batten_sweep_journal journal;
} store_opening;

/* Makes the database, or goes on with one that this plan and shard began. It is locked until it is
 * closed. Errors: USAGE (it is there and resume is not asked for), INPUT (another plan, shard, version
 * or schema, no database), IO, MEMORY; then nothing has been made or changed. */
batten_status sweep_store_open(const sweep_plan *plan, const sweep_shard *shard, const char *path,
                               const store_opening *opening, sweep_store *out);

/* Makes an empty database for the whole plan at path, for shards to be put into. */
batten_status sweep_store_create(const sweep_plan *plan, const sweep_shard *shard, const char *path,
                                 sweep_store *out);

/* Puts a whole block in, or nothing of it. Errors: IO, INPUT, MEMORY. */
batten_status sweep_store_write(sweep_store *store, sweep_block *block);

/* When every design is there: the non-dominated ones are marked, and the database is complete. */
batten_status sweep_store_complete(sweep_store *store);

/* What is said of a run in its row. */
typedef struct store_run {
	const char *device, *exit;
	unsigned threads;
	double seconds;
	uint64_t designs_done;
} store_run;
batten_status sweep_store_end_run(sweep_store *store, const store_run *run);

void sweep_store_close(sweep_store *store);

/* ---- parts ---- */

/* Tables and meta rows of a new database, in a transaction that is open. */
batten_status store_make_schema(const sweep_store *store);
/* INPUT unless the database is one of this plan, shard, version and schema. */
batten_status store_check(const sweep_store *store);
/* Errors: INPUT (no database of a sweep of this schema version). */
batten_status store_check_kind(const sweep_database *database);
/* A value of meta as text, the caller's; *length may be NULL. INPUT where there is none. */
batten_status store_meta(const sweep_database *database, const char *key, char **out,
                         size_t *length);
/* Statements that write a block. */
batten_status store_prepare(sweep_store *store);
/* One file is left: the log, or the journal beside it, is gone if that can be. */
void store_drop_journal(const sweep_store *store);
/* pareto of every design. */
batten_status store_mark_front(const sweep_store *store);

#endif
