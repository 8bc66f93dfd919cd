#include "report/rows.h"

#include "report/out.h"

#include <math.h>
#include <string.h>

enum { REASON_MOST = 240, FIRST_VALUE = 3 };

/* "WHERE ..." of the designs that are shown. */
static char *shown(const report_sweep *sweep, const report_choice *choice)
{
	const size_t step = 1 + (sweep->design_count - 1) / REPORT_DESIGNS_MOST;
	if (step == 1)
		return sqlite3_mprintf("");
	return sqlite3_mprintf("WHERE d.id %% %lld = 0 OR d.pareto = 1 OR d.id IN (%s)",
	                       (long long)step, choice->ids);
}

static batten_status select_rows(const report_sweep *sweep, const char *condition,
                                 sqlite3_stmt **out)
{
	sqlite3_str *list = sqlite3_str_new(sweep->database->connection);
	for (size_t i = 0; i < sweep->column_count; i++)
		if (!sweep->columns[i].is_constant)
			sqlite3_str_appendf(list, ", %s.\"%w\"", sweep->columns[i].is_parameter ? "p" : "m",
			                    sweep->columns[i].name);
	char *columns = sqlite3_str_finish(list);
	const batten_status status = report_query(
		sweep->database, out,
		"SELECT d.id, CAST(d.status AS TEXT), d.pareto%s FROM designs d "
		"LEFT JOIN parameters p ON p.id = d.id LEFT JOIN measures m ON m.id = d.id "
		"%s ORDER BY d.id",
		columns ? columns : "", condition);
	sqlite3_free(columns);
	return status;
}

static double status_number(const report_sweep *sweep, const char *name)
{
	for (size_t i = 0; name && i < sweep->status_count; i++)
		if (strcmp(sweep->statuses[i].name, name) == 0)
			return (double)i;
	return NAN;
}

static batten_status put_row(const report_sweep *sweep, sqlite3_stmt *row, report_base64 *out)
{
	batten_status status = BATTEN_OK;
	const int count = sqlite3_column_count(row);
	report_base64_f64(out, sqlite3_column_double(row, 0));
	report_base64_f64(out, status_number(sweep, (const char *)sqlite3_column_text(row, 1)));
	report_base64_f64(out, sqlite3_column_type(row, 2) == SQLITE_NULL
	                           ? -1.0
	                           : (double)(sqlite3_column_int(row, 2) == 1));
	for (int i = FIRST_VALUE; status == BATTEN_OK && i < count; i++) {
		char place[160];
		double value = NAN;
		(void)snprintf(place, sizeof place, "design %lld: %.100s",
		               (long long)sqlite3_column_int64(row, 0), sqlite3_column_name(row, i));
		status = report_number(sweep->database, row, i, place, &value);
		report_base64_f64(out, value);
	}
	return status;
}

static batten_status put_rows(const report_sweep *sweep, const char *condition, FILE *stream,
                              size_t *written)
{
	report_base64 out = { .stream = stream };
	sqlite3_stmt *statement = NULL;
	bool more = false;
	batten_status status = select_rows(sweep, condition, &statement);
	if (status == BATTEN_OK)
		status = report_next(sweep->database, statement, &more);
	while (status == BATTEN_OK && more) {
		status = put_row(sweep, statement, &out);
		++*written;
		if (status == BATTEN_OK)
			status = report_next(sweep->database, statement, &more);
	}
	sqlite3_finalize(statement);
	report_base64_end(&out);
	return status;
}

static batten_status put_reasons(const report_sweep *sweep, const char *condition, FILE *stream)
{
	sqlite3_stmt *statement = NULL;
	bool more = false;
	size_t count = 0;
	batten_status status = report_query(
		sweep->database, &statement,
		"SELECT d.id, substr(CAST(d.reason AS TEXT), 1, %d) FROM designs d %s %s "
		"length(d.reason) > 0 ORDER BY d.id",
		REASON_MOST, condition, *condition ? "AND" : "WHERE");
	if (status == BATTEN_OK)
		status = report_next(sweep->database, statement, &more);
	while (status == BATTEN_OK && more) {
		const char *text = (const char *)sqlite3_column_text(statement, 1);
		(void)fprintf(stream, "%s\"%lld\":", count++ > 0 ? "," : "",
		              (long long)sqlite3_column_int64(statement, 0));
		report_put_text(stream, text ? text : "", (size_t)sqlite3_column_bytes(statement, 1));
		status = report_next(sweep->database, statement, &more);
	}
	sqlite3_finalize(statement);
	return status;
}

batten_status report_rows_write(const report_sweep *sweep, const report_choice *choice,
                                FILE *stream, size_t *written)
{
	*written = 0;
	char *condition = shown(sweep, choice);
	if (!condition)
		return batten_fail_memory(sweep->database->context);
	(void)fputs("<script type=\"text/plain\" id=\"batten-rows\">", stream);
	batten_status status = put_rows(sweep, condition, stream, written);
	(void)fputs("</script>\n<script type=\"application/json\" id=\"batten-reasons\">{", stream);
	if (status == BATTEN_OK)
		status = put_reasons(sweep, condition, stream);
	(void)fputs("}</script>\n", stream);
	sqlite3_free(condition);
	return status;
}
