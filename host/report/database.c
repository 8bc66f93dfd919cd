#include "report/database.h"

#include "sweep/schema.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { MESSAGE_SIZE = 700, LOCK_WAIT_MS = 2000 };

batten_status report_invalid(const report_database *database, const char *format, ...)
{
	char text[MESSAGE_SIZE];
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(text, sizeof text, format, arguments);
	va_end(arguments);
	return batten_fail(database->context, BATTEN_INPUT, "%s: %s", database->path, text);
}

/* What SQLite's last failure means to the user. */
static batten_status failed(const report_database *database, int code)
{
	switch (code & 0xFF) {
	case SQLITE_NOMEM:
		return batten_fail_memory(database->context);
	case SQLITE_BUSY:
	case SQLITE_LOCKED:
		return batten_fail(
			database->context, BATTEN_IO,
			"%s: is being written by another process; report when the sweep has ended",
			database->path);
	case SQLITE_NOTADB:
		return report_invalid(database,
		                      "is no SQLite database; the result of a sweep was expected");
	case SQLITE_CANTOPEN:
	case SQLITE_IOERR:
	case SQLITE_READONLY:
		return batten_fail(database->context, BATTEN_IO, "%s: cannot be read: %s", database->path,
		                   sqlite3_errmsg(database->connection));
	default:
		return report_invalid(database, "cannot be read as the result of a sweep: %s",
		                      sqlite3_errmsg(database->connection));
	}
}

batten_status report_query(const report_database *database, sqlite3_stmt **out, const char *format,
                           ...)
{
	va_list arguments;
	va_start(arguments, format);
	char *text = sqlite3_vmprintf(format, arguments);
	va_end(arguments);
	if (!text)
		return batten_fail_memory(database->context);
	const int code = sqlite3_prepare_v2(database->connection, text, -1, out, NULL);
	sqlite3_free(text);
	return code == SQLITE_OK ? BATTEN_OK : failed(database, code);
}

batten_status report_next(const report_database *database, sqlite3_stmt *statement, bool *more)
{
	const int code = sqlite3_step(statement);
	*more = code == SQLITE_ROW;
	return code == SQLITE_ROW || code == SQLITE_DONE ? BATTEN_OK : failed(database, code);
}

batten_status report_number(const report_database *database, sqlite3_stmt *statement, int column,
                            const char *what, double *out)
{
	const int type = sqlite3_column_type(statement, column);
	*out = NAN;
	if (type == SQLITE_INTEGER || type == SQLITE_FLOAT)
		*out = sqlite3_column_double(statement, column);
	else if (type != SQLITE_NULL)
		return report_invalid(database, "%s: found %s, expected a number", what,
		                      type == SQLITE_TEXT ? "text" : "a blob");
	return BATTEN_OK;
}

/* Plain tables only: a view could run any query, also one without an end. */
static batten_status check_tables(const report_database *database)
{
	static const char *const names[] = { "meta",     "designs",      "parameters",
		                                 "measures", "hydrostatics", "geometry" };
	for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
		sqlite3_stmt *statement = NULL;
		bool found = false;
		bool good = false;
		batten_status status = report_query(
			database, &statement,
			"SELECT type = 'table' AND sql NOT LIKE 'CREATE VIRTUAL%%' FROM sqlite_schema "
			"WHERE lower(name) = %Q",
			names[i]);
		if (status == BATTEN_OK)
			status = report_next(database, statement, &found);
		if (found)
			good = sqlite3_column_int(statement, 0) != 0;
		sqlite3_finalize(statement);
		if (status == BATTEN_OK && !good)
			status = report_invalid(database, "%s table '%s'; the result of a sweep was expected",
			                        found ? "has no plain" : "has no", names[i]);
		if (status != BATTEN_OK)
			return status;
	}
	return BATTEN_OK;
}

static batten_status check_version(const report_database *database)
{
	sqlite3_stmt *statement = NULL;
	bool found = false;
	batten_status status = report_query(database, &statement,
	                                    "SELECT value FROM meta WHERE key = 'schema_version'");
	if (status == BATTEN_OK)
		status = report_next(database, statement, &found);
	if (status == BATTEN_OK && !found)
		status = report_invalid(database, "meta: has no schema_version");
	else if (status == BATTEN_OK && sqlite3_column_int64(statement, 0) != SWEEP_SCHEMA_VERSION)
		status = report_invalid(database, "meta: found schema_version %lld, expected %d",
		                        (long long)sqlite3_column_int64(statement, 0),
		                        SWEEP_SCHEMA_VERSION);
	sqlite3_finalize(statement);
	return status;
}

static batten_status begin(const report_database *database)
{
	/* A hostile file's triggers and functions stay off, and every page is checked as it is read. One
	 * transaction: a file that is being added to is read as it was at the first query. */
	(void)sqlite3_db_config(database->connection, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
	(void)sqlite3_db_config(database->connection, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
	(void)sqlite3_busy_timeout(database->connection, LOCK_WAIT_MS);
	const int code = sqlite3_exec(database->connection, "PRAGMA cell_size_check = ON; BEGIN", NULL,
	                              NULL, NULL);
	return code == SQLITE_OK ? BATTEN_OK : failed(database, code);
}

batten_status report_database_open(batten_context *context, const char *path, report_database *out)
{
	report_database database = { .context = context, .path = path };
	/* SQLite's own word for whatever it cannot open is the same one. */
	if (access(path, R_OK) != 0)
		return batten_fail(context, BATTEN_IO, "%s: cannot be read: %s", path, strerror(errno));
	const int code = sqlite3_open_v2(path, &database.connection,
	                                 SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX, NULL);
	batten_status status = code == SQLITE_OK ? BATTEN_OK : failed(&database, code);
	if (status == BATTEN_OK)
		status = begin(&database);
	if (status == BATTEN_OK)
		status = check_tables(&database);
	if (status == BATTEN_OK)
		status = check_version(&database);
	if (status == BATTEN_OK)
		*out = database;
	else
		report_database_close(&database);
	return status;
}

void report_database_close(report_database *database)
{
	(void)sqlite3_close_v2(database->connection);
	database->connection = NULL;
}
