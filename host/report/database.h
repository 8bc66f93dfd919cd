/* A sweep's database, read only. Nothing in it is trusted: whatever is not as host/sweep writes it is
 * an error that names table, design and column. */
#ifndef BATTEN_REPORT_DATABASE_H
#define BATTEN_REPORT_DATABASE_H

#include "core/context.h"

#include <sqlite3.h>

typedef struct report_database {
	batten_context *context;
	const char *path; /* in messages */
	sqlite3 *connection;
} report_database;

/* Opens the file, one state of it for as long as it is open, and sees that its tables are there.
 * Errors: IO (no such file, locked), INPUT (no database, a table missing, another schema), MEMORY. */
batten_status report_database_open(batten_context *context, const char *path, report_database *out);
void report_database_close(report_database *database);

/* One statement. The text is SQLite's printf's ('%w' in double quotes for a name). */
batten_status report_query(const report_database *database, sqlite3_stmt **out, const char *format,
                           ...);
/* Its next row; *more false after the last. Errors as of opening. */
batten_status report_next(const report_database *database, sqlite3_stmt *statement, bool *more);

/* An INPUT error, its text preceded by the path. */
batten_status report_invalid(const report_database *database, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

/* A finite number, or NaN for NULL. what and id name the place in the message. */
batten_status report_number(const report_database *database, sqlite3_stmt *statement, int column,
                            const char *what, double *out);

#endif
