/* SQLite as the sweep uses it: one connection, errors as statuses with one line that names the file. */
#ifndef BATTEN_SWEEP_DATABASE_H
#define BATTEN_SWEEP_DATABASE_H

#include "core/context.h"

#include <sqlite3.h>

typedef struct sweep_database {
	batten_context *context;
	sqlite3 *handle;
	char *path;
} sweep_database;

typedef enum database_access {
	DATABASE_READ,
	DATABASE_WRITE,  /* must be there */
	DATABASE_CREATE, /* is made where it is not there */
} database_access;

/* Errors: IO, INPUT (no database), MEMORY. */
batten_status database_open(batten_context *context, const char *path, database_access access,
                            sweep_database *out);
void database_close(sweep_database *database);

/* Runs statements without results. */
batten_status database_run(const sweep_database *database, const char *sql);

/* Makes a statement of a text that is built as by printf; values are bound, never printed into it. */
batten_status database_prepare(const sweep_database *database, sqlite3_stmt **out,
                               const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The next row: *row false behind the last. Resets the statement behind the last and on error. */
batten_status database_step(const sweep_database *database, sqlite3_stmt *statement, bool *row);

/* Runs a statement that gives no row, and makes it ready for the next time. */
batten_status database_do(const sweep_database *database, sqlite3_stmt *statement);

/* The first column of the only row of a query; INPUT where there is none. */
batten_status database_whole(const sweep_database *database, const char *sql, int64_t *out);

/* Text that grows, for statements with many columns. A NULL text: memory ran out. */
char *database_join(batten_context *context, size_t count, const char *(*name)(size_t, void *),
                    void *user, const char *before, const char *after);

#endif
