#include "sweep/database.h"

#include <stdio.h>
#include <string.h>

/* The last error of the connection as a status: IO (in use by another program, the disk full, not to be
 * written), INPUT (no database, damaged), MEMORY. */
static batten_status failed(const sweep_database *database)
{
	batten_context *context = database->context;
	const char *path = database->path;
	const int code = sqlite3_errcode(database->handle);
	switch (code & 0xff) {
	case SQLITE_NOMEM:
		return batten_fail_memory(context);
	case SQLITE_BUSY:
	case SQLITE_LOCKED:
		return batten_fail(context, BATTEN_IO, "%s: is in use by another program", path);
	case SQLITE_FULL:
		return batten_fail(context, BATTEN_IO, "%s: the disk is full", path);
	case SQLITE_READONLY:
	case SQLITE_CANTOPEN:
	case SQLITE_PERM:
		return batten_fail(
			context, BATTEN_IO,
			"%s: cannot be opened or written: the file or its folder is not there, or "
			"is read-only (%s)",
			path, sqlite3_errmsg(database->handle));
	case SQLITE_NOTADB:
		return batten_fail(context, BATTEN_INPUT, "%s: is no SQLite database", path);
	case SQLITE_CORRUPT:
		return batten_fail(context, BATTEN_INPUT, "%s: the database is damaged", path);
	default:
		return batten_fail(context, BATTEN_IO, "%s: %s", path, sqlite3_errmsg(database->handle));
	}
}

batten_status database_open(batten_context *context, const char *path, database_access access,
                            sweep_database *out)
{
	static const int flags[] = { [DATABASE_READ] = SQLITE_OPEN_READONLY,
		                         [DATABASE_WRITE] = SQLITE_OPEN_READWRITE,
		                         [DATABASE_CREATE] = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE };
	sweep_database database = { .context = context, .path = batten_copy_text(context, path) };
	if (!database.path)
		return BATTEN_MEMORY;
	/* Used by one thread at a time: computing and writing hand it over. */
	const int code = sqlite3_open_v2(path, &database.handle, flags[access] | SQLITE_OPEN_NOMUTEX,
	                                 NULL);
	if (code != SQLITE_OK) {
		const batten_status status = database.handle ? failed(&database)
		                                             : batten_fail_memory(context);
		database_close(&database);
		return status;
	}
	*out = database;
	return BATTEN_OK;
}

void database_close(sweep_database *database)
{
	if (!database->path)
		return;
	(void)sqlite3_close(database->handle);
	batten_release(database->context, database->path);
	*database = (sweep_database){ 0 };
}

batten_status database_run(const sweep_database *database, const char *sql)
{
	return sqlite3_exec(database->handle, sql, NULL, NULL, NULL) == SQLITE_OK ? BATTEN_OK
	                                                                          : failed(database);
}

batten_status database_prepare(const sweep_database *database, sqlite3_stmt **out,
                               const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	char *sql = sqlite3_vmprintf(format, arguments);
	va_end(arguments);
	if (!sql)
		return batten_fail_memory(database->context);
	const int code = sqlite3_prepare_v2(database->handle, sql, -1, out, NULL);
	sqlite3_free(sql);
	return code == SQLITE_OK ? BATTEN_OK : failed(database);
}

batten_status database_step(const sweep_database *database, sqlite3_stmt *statement, bool *row)
{
	const int code = sqlite3_step(statement);
	*row = code == SQLITE_ROW;
	if (code == SQLITE_ROW)
		return BATTEN_OK;
	/* The error is that of the connection until the reset. */
	const batten_status status = code == SQLITE_DONE ? BATTEN_OK : failed(database);
	(void)sqlite3_reset(statement);
	return status;
}

batten_status database_do(const sweep_database *database, sqlite3_stmt *statement)
{
	bool row = false;
	const batten_status status = database_step(database, statement, &row);
	if (row)
		(void)sqlite3_reset(statement);
	return status;
}

batten_status database_whole(const sweep_database *database, const char *sql, int64_t *out)
{
	sqlite3_stmt *statement = NULL;
	bool row = false;
	batten_status status = database_prepare(database, &statement, "%s", sql);
	if (status == BATTEN_OK)
		status = database_step(database, statement, &row);
	if (status == BATTEN_OK && !row)
		status = batten_fail(database->context, BATTEN_INPUT,
		                     "%s: is no database of a sweep: a row is missing", database->path);
	if (status == BATTEN_OK)
		*out = sqlite3_column_int64(statement, 0);
	(void)sqlite3_finalize(statement);
	return status;
}

char *database_join(batten_context *context, size_t count, const char *(*name)(size_t, void *),
                    void *user, const char *before, const char *after)
{
	size_t size = 1;
	for (size_t i = 0; i < count; i++)
		size += strlen(before) + strlen(name(i, user)) + strlen(after);
	char *text = batten_allocate(context, size, 1);
	size_t used = 0;
	for (size_t i = 0; text && i < count; i++)
		used += (size_t)snprintf(text + used, size - used, "%s%s%s", before, name(i, user), after);
	return text;
}
