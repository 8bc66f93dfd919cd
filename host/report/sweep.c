#include "report/sweep.h"

#include "hull/hull.h"

#include <math.h>
#include <string.h>

enum { META_MOST = 64, TEXT_MOST = 64 << 20 };

static const report_column *column_named(const report_sweep *sweep, const char *name,
                                         bool is_parameter)
{
	for (size_t i = 0; i < sweep->column_count; i++)
		if (sweep->columns[i].is_parameter == is_parameter &&
		    strcmp(sweep->columns[i].name, name) == 0)
			return &sweep->columns[i];
	return NULL;
}

const report_column *report_measure(const report_sweep *sweep, const char *name)
{
	return column_named(sweep, name, false);
}

const char *report_meta_text(const report_sweep *sweep, const char *key)
{
	return json_string_value(json_object_get(sweep->meta, key));
}

/* ---- the table meta ---- */

/* jansson takes UTF-8 only; what is none is told by its key. */
static batten_status take_meta_row(report_sweep *sweep, sqlite3_stmt *row)
{
	const char *key = (const char *)sqlite3_column_text(row, 0);
	json_t *value = NULL;
	if (sqlite3_column_type(row, 1) == SQLITE_INTEGER)
		value = json_integer(sqlite3_column_int64(row, 1));
	else if (sqlite3_column_type(row, 1) == SQLITE_TEXT)
		value = json_stringn((const char *)sqlite3_column_text(row, 1),
		                     (size_t)sqlite3_column_bytes(row, 1));
	if (!key || !value || json_object_set_new(sweep->meta, key, value) != 0)
		return report_invalid(sweep->database,
		                      "meta: key '%.40s' has no readable value: text in UTF-8 or a whole "
		                      "number was expected",
		                      key ? key : "NULL");
	return BATTEN_OK;
}

static batten_status read_meta(report_sweep *sweep)
{
	sqlite3_stmt *statement = NULL;
	bool more = false;
	sweep->meta = json_object();
	if (!sweep->meta)
		return batten_fail_memory(sweep->database->context);
	batten_status status = report_query(
		sweep->database, &statement,
		"SELECT key, value FROM meta WHERE value IS NOT NULL AND length(value) <= %d LIMIT %d",
		TEXT_MOST, META_MOST);
	if (status == BATTEN_OK)
		status = report_next(sweep->database, statement, &more);
	while (status == BATTEN_OK && more) {
		status = take_meta_row(sweep, statement);
		if (status == BATTEN_OK)
			status = report_next(sweep->database, statement, &more);
	}
	sqlite3_finalize(statement);
	static const char *const wanted[] = { "batten_version", "name", "plan", "plan_hash" };
	for (size_t i = 0; status == BATTEN_OK && i < sizeof wanted / sizeof wanted[0]; i++)
		if (!report_meta_text(sweep, wanted[i]))
			status = report_invalid(sweep->database, "meta: has no text '%s'", wanted[i]);
	return status;
}

/* The JSON of a key; *out NULL where there is no such key. */
static batten_status parse_key(const report_sweep *sweep, const char *key, json_t **out)
{
	json_error_t error;
	const char *text = report_meta_text(sweep, key);
	*out = text ? json_loads(text, JSON_REJECT_DUPLICATES, &error) : NULL;
	if (text && !*out)
		return report_invalid(sweep->database, "meta: %s is no JSON: %s", key, error.text);
	return BATTEN_OK;
}

/* Ascending finite coordinates, as many as a hull may have. */
static batten_status read_coordinates(report_sweep *sweep, const char *key, double **values,
                                      size_t *count)
{
	json_t *array = NULL;
	batten_status status = parse_key(sweep, key, &array);
	if (status != BATTEN_OK)
		return status;
	*count = json_array_size(array);
	bool good = *count >= 2 && *count <= HULL_LINES_MOST;
	*values = good ? batten_allocate(sweep->database->context, *count, sizeof **values) : NULL;
	if (good && !*values)
		status = BATTEN_MEMORY;
	for (size_t i = 0; *values && i < *count; i++) {
		const json_t *number = json_array_get(array, i);
		(*values)[i] = json_number_value(number);
		good = good && json_is_number(number) && (i == 0 || (*values)[i] > (*values)[i - 1]);
	}
	json_decref(array);
	if (status == BATTEN_OK && !good)
		status = report_invalid(sweep->database,
		                        "meta: %s: expected a JSON array of 2 to %d ascending numbers", key,
		                        HULL_LINES_MOST);
	return status;
}

/* ---- the columns of parameters and measures ---- */

static batten_status add_columns(report_sweep *sweep, const char *table, bool is_parameter)
{
	sqlite3_stmt *statement = NULL;
	bool has_id = false;
	batten_status status = report_query(sweep->database, &statement, "SELECT * FROM \"%w\" LIMIT 0",
	                                    table);
	const int count = sqlite3_column_count(statement);
	for (int i = 0; status == BATTEN_OK && i < count; i++) {
		const char *name = sqlite3_column_name(statement, i);
		if (!name) {
			status = batten_fail_memory(sweep->database->context);
		} else if (strcmp(name, "id") == 0) {
			has_id = true;
		} else if (sweep->column_count == REPORT_COLUMN_MOST) {
			status = report_invalid(sweep->database, "%s: more than %d columns", table,
			                        REPORT_COLUMN_MOST);
		} else {
			report_column *column = &sweep->columns[sweep->column_count];
			*column = (report_column){ .is_parameter = is_parameter, .value = NAN };
			column->name = batten_copy_text(sweep->database->context, name);
			if (!column->name)
				status = BATTEN_MEMORY;
			else
				sweep->column_count++;
		}
	}
	sqlite3_finalize(statement);
	if (status == BATTEN_OK && !has_id)
		status = report_invalid(sweep->database, "%s: has no column 'id'", table);
	return status;
}

/* A column in which every design has the same number, or none has any, is told once. */
static batten_status find_constants(report_sweep *sweep, const char *table, bool is_parameter)
{
	sqlite3_str *list = sqlite3_str_new(sweep->database->connection);
	sqlite3_stmt *statement = NULL;
	bool more = false;
	for (size_t i = 0; i < sweep->column_count; i++)
		if (sweep->columns[i].is_parameter == is_parameter)
			sqlite3_str_appendf(list, ", count(\"%w\"), min(\"%w\"), max(\"%w\")",
			                    sweep->columns[i].name, sweep->columns[i].name,
			                    sweep->columns[i].name);
	char *text = sqlite3_str_finish(list);
	batten_status status = report_query(sweep->database, &statement, "SELECT 0%s FROM \"%w\"",
	                                    text ? text : "", table);
	sqlite3_free(text);
	if (status == BATTEN_OK)
		status = report_next(sweep->database, statement, &more);
	for (size_t i = 0, at = 1; status == BATTEN_OK && more && i < sweep->column_count; i++) {
		report_column *column = &sweep->columns[i];
		if (column->is_parameter != is_parameter)
			continue;
		const int place = (int)at;
		const size_t count = (size_t)sqlite3_column_int64(statement, place);
		double low = NAN, high = NAN;
		status = report_number(sweep->database, statement, place + 1, column->name, &low);
		if (status == BATTEN_OK)
			status = report_number(sweep->database, statement, place + 2, column->name, &high);
		column->is_constant = count == 0 || (count == sweep->design_count && low == high);
		column->value = low;
		at += 3;
	}
	sqlite3_finalize(statement);
	return status;
}

/* ---- the table designs ---- */

static batten_status count_designs(report_sweep *sweep)
{
	sqlite3_stmt *statement = NULL;
	bool more = false;
	batten_status status = report_query(
		sweep->database, &statement,
		"SELECT count(*), count(CASE WHEN pareto = 1 THEN 1 END), min(id), max(id) FROM designs");
	if (status == BATTEN_OK)
		status = report_next(sweep->database, statement, &more);
	if (status == BATTEN_OK && more) {
		sweep->design_count = (size_t)sqlite3_column_int64(statement, 0);
		sweep->front_count = (size_t)sqlite3_column_int64(statement, 1);
		sweep->first_id = sqlite3_column_int64(statement, 2);
		sweep->last_id = sqlite3_column_int64(statement, 3);
	}
	sqlite3_finalize(statement);
	if (status == BATTEN_OK && sweep->design_count == 0)
		status = report_invalid(sweep->database, "designs: is empty, there is nothing to report");
	if (status == BATTEN_OK && (sweep->first_id < 0 || sweep->last_id > (1LL << 52)))
		status = report_invalid(sweep->database,
		                        "designs: found ids %lld to %lld, expected 0 to 2^52",
		                        sweep->first_id, sweep->last_id);
	return status;
}

static batten_status list_statuses(report_sweep *sweep)
{
	sqlite3_stmt *statement = NULL;
	bool more = false;
	batten_status status = report_query(sweep->database, &statement,
	                                    "SELECT CAST(status AS TEXT), count(*) FROM designs "
	                                    "GROUP BY 1 ORDER BY 1 LIMIT %d",
	                                    REPORT_STATUS_MOST + 1);
	if (status == BATTEN_OK)
		status = report_next(sweep->database, statement, &more);
	while (status == BATTEN_OK && more) {
		const char *name = (const char *)sqlite3_column_text(statement, 0);
		if (sweep->status_count == REPORT_STATUS_MOST)
			status = report_invalid(sweep->database, "designs: more than %d different statuses",
			                        REPORT_STATUS_MOST);
		else if (!name)
			status = report_invalid(sweep->database, "designs: found a status of NULL");
		if (status != BATTEN_OK)
			break;
		report_status *entry = &sweep->statuses[sweep->status_count];
		entry->count = (size_t)sqlite3_column_int64(statement, 1);
		entry->name = batten_copy_text(sweep->database->context, name);
		status = entry->name ? BATTEN_OK : BATTEN_MEMORY;
		sweep->status_count += entry->name != NULL;
		if (status == BATTEN_OK)
			status = report_next(sweep->database, statement, &more);
	}
	sqlite3_finalize(statement);
	return status;
}

/* ---- all of it ---- */

/* What meta says beside the table: which numbers are better, and which geometry is best. */
static batten_status read_wishes(report_sweep *sweep)
{
	batten_status status = parse_key(sweep, "objectives", &sweep->objectives);
	if (status == BATTEN_OK)
		status = parse_key(sweep, "keep", &sweep->keep);
	if (status == BATTEN_OK && sweep->objectives && !json_is_array(sweep->objectives))
		status = report_invalid(sweep->database, "meta: objectives is no JSON array");
	for (size_t i = 0; status == BATTEN_OK && i < json_array_size(sweep->objectives); i++) {
		const json_t *objective = json_array_get(sweep->objectives, i);
		const char *name = json_string_value(json_object_get(objective, "measure"));
		if (!name || !json_is_string(json_object_get(objective, "goal")) ||
		    !report_measure(sweep, name))
			status = report_invalid(
				sweep->database, "meta: objectives[%zu]: expected the name of a measure and a goal",
				i);
	}
	return status;
}

batten_status report_sweep_read(const report_database *database, report_sweep *out)
{
	report_sweep sweep = { .database = database };
	sweep.columns = batten_allocate(database->context, REPORT_COLUMN_MOST, sizeof *sweep.columns);
	batten_status status = sweep.columns ? read_meta(&sweep) : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = read_coordinates(&sweep, "x_m", &sweep.x_m, &sweep.station_count);
	if (status == BATTEN_OK)
		status = read_coordinates(&sweep, "z_m", &sweep.z_m, &sweep.waterline_count);
	if (status == BATTEN_OK)
		status = count_designs(&sweep);
	if (status == BATTEN_OK)
		status = list_statuses(&sweep);
	if (status == BATTEN_OK)
		status = add_columns(&sweep, "parameters", true);
	if (status == BATTEN_OK)
		status = add_columns(&sweep, "measures", false);
	if (status == BATTEN_OK)
		status = find_constants(&sweep, "parameters", true);
	if (status == BATTEN_OK)
		status = find_constants(&sweep, "measures", false);
	if (status == BATTEN_OK)
		status = read_wishes(&sweep);
	if (status == BATTEN_OK)
		*out = sweep;
	else
		report_sweep_release(&sweep);
	return status;
}

void report_sweep_release(report_sweep *sweep)
{
	batten_context *context = sweep->database ? sweep->database->context : NULL;
	for (size_t i = 0; i < sweep->column_count; i++)
		batten_release(context, sweep->columns[i].name);
	for (size_t i = 0; i < sweep->status_count; i++)
		batten_release(context, sweep->statuses[i].name);
	batten_release(context, sweep->columns);
	batten_release(context, sweep->x_m);
	batten_release(context, sweep->z_m);
	json_decref(sweep->meta);
	json_decref(sweep->objectives);
	json_decref(sweep->keep);
	*sweep = (report_sweep){ 0 };
}
