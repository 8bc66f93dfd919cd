#include "report/hulls.h"

#include "core/number.h"
#include "report/hull_block.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HULLS_DEFAULT = 1000 };

/* The columns of the query below. */
enum { ID, LBP, DRAFT, X, Z, Y, VARIED, NODES };

/* ---- which ---- */

/* The measure that orders hulls from the best on, and its goal: the plan's own, else its first
 * objective; NULL: there is none. */
static const char *order_of(const report_sweep *sweep, bool *descending)
{
	const json_t *by = sweep->keep;
	const char *name = json_string_value(json_object_get(by, "by"));
	if (!name) {
		by = json_array_get(sweep->objectives, 0);
		name = json_string_value(json_object_get(by, "measure"));
	}
	const char *goal = json_string_value(json_object_get(by, "goal"));
	*descending = goal && strcmp(goal, "max") == 0;
	return name;
}

batten_status report_choice_make(const report_sweep *sweep, size_t most, report_choice *out)
{
	bool descending = false;
	const char *name = order_of(sweep, &descending);
	const json_int_t wanted = json_integer_value(json_object_get(sweep->keep, "count"));
	if (name && !report_measure(sweep, name))
		return report_invalid(sweep->database,
		                      "meta: keep: found by '%.60s', expected a column of measures", name);
	report_choice choice = { .most = most };
	if (most == 0)
		choice.most = wanted > 0 && wanted <= BATTEN_REPORT_HULLS_MOST ? (size_t)wanted
		                                                               : HULLS_DEFAULT;
	static const char join[] = "SELECT g.id FROM geometry g JOIN designs e ON e.id = g.id "
							   "LEFT JOIN measures n ON n.id = g.id ORDER BY";
	if (name)
		choice.ids = sqlite3_mprintf("%s n.\"%w\" IS NULL, n.\"%w\" %s, g.id LIMIT %lld", join,
		                             name, name, descending ? "DESC" : "ASC",
		                             (long long)choice.most);
	else
		choice.ids = sqlite3_mprintf("%s e.pareto IS NOT 1, g.id LIMIT %lld", join,
		                             (long long)choice.most);
	if (!choice.ids)
		return batten_fail_memory(sweep->database->context);
	*out = choice;
	return BATTEN_OK;
}

void report_choice_release(report_choice *choice)
{
	sqlite3_free(choice->ids);
	choice->ids = NULL;
}

/* ---- out of the database ---- */

/* Little-endian f64, whatever the machine is. NaN marks a blob that is absent. */
static batten_status read_blob(const report_sweep *sweep, sqlite3_stmt *row, int column,
                               size_t count, double *values, bool *found)
{
	const unsigned char *bytes = sqlite3_column_blob(row, column);
	const size_t length = (size_t)sqlite3_column_bytes(row, column);
	*found = sqlite3_column_type(row, column) != SQLITE_NULL;
	if (!*found)
		return BATTEN_OK;
	if (length != count * sizeof *values)
		return report_invalid(sweep->database,
		                      "geometry: design %lld: %s holds %zu bytes, expected %zu",
		                      (long long)sqlite3_column_int64(row, ID),
		                      sqlite3_column_name(row, column), length, count * sizeof *values);
	for (size_t i = 0; i < count; i++) {
		uint64_t bits = 0;
		for (size_t k = sizeof bits; k-- > 0;)
			bits = bits << 8 | bytes[i * sizeof bits + k];
		memcpy(&values[i], &bits, sizeof bits);
	}
	return BATTEN_OK;
}

/* One row's arrays, allocated once for all rows. */
typedef struct row_room {
	double *x_m, *z_m, *y_m, *varied_y_m;
	bool has_x, has_z, has_varied;
} row_room;

static batten_status read_arrays(const report_sweep *sweep, sqlite3_stmt *row, row_room *room)
{
	const size_t count = sweep->station_count * sweep->waterline_count;
	bool has_y = false;
	batten_status status = read_blob(sweep, row, X, sweep->station_count, room->x_m, &room->has_x);
	if (status == BATTEN_OK)
		status = read_blob(sweep, row, Z, sweep->waterline_count, room->z_m, &room->has_z);
	if (status == BATTEN_OK)
		status = read_blob(sweep, row, Y, count, room->y_m, &has_y);
	if (status == BATTEN_OK)
		status = read_blob(sweep, row, VARIED, count, room->varied_y_m, &room->has_varied);
	if (status == BATTEN_OK && !has_y)
		status = report_invalid(sweep->database, "geometry: design %lld: has no y_m",
		                        (long long)sqlite3_column_int64(row, ID));
	if (status == BATTEN_OK && sqlite3_column_type(row, NODES) != SQLITE_NULL &&
	    (size_t)sqlite3_column_bytes(row, NODES) != count)
		status = report_invalid(
			sweep->database, "geometry: design %lld: nodes holds %d bytes, expected %zu",
			(long long)sqlite3_column_int64(row, ID), sqlite3_column_bytes(row, NODES), count);
	return status;
}

static batten_status write_hull(const report_sweep *sweep, sqlite3_stmt *row, row_room *room,
                                FILE *stream, double *scale_per_m)
{
	char name[32];
	batten_status status = read_arrays(sweep, row, room);
	if (status != BATTEN_OK)
		return status;
	const long long id = sqlite3_column_int64(row, ID);
	(void)snprintf(name, sizeof name, "%lld", id);
	const batten_hull_table table = {
		.name = name,
		.lbp_m = sqlite3_column_double(row, LBP),
		.draft_m = sqlite3_column_double(row, DRAFT),
		.station_count = sweep->station_count,
		.waterline_count = sweep->waterline_count,
		.x_m = room->has_x ? room->x_m : sweep->x_m,
		.z_m = room->has_z ? room->z_m : sweep->z_m,
		.y_m = room->y_m,
		.nodes = sqlite3_column_blob(row, NODES),
	};
	batten_context *context = sweep->database->context;
	batten_hull *hull = NULL;
	status = batten_hull_create(context, &table, &hull);
	if (status == BATTEN_USAGE || status == BATTEN_INPUT)
		return report_invalid(sweep->database, "geometry: design %lld: %s", id,
		                      batten_context_error(context));
	if (status == BATTEN_OK)
		status = hull_block_write(sweep, hull, room->has_varied ? room->varied_y_m : NULL, name,
		                          stream, scale_per_m);
	batten_hull_destroy(hull);
	return status;
}

static void release_room(batten_context *context, row_room *room)
{
	batten_release(context, room->x_m);
	batten_release(context, room->z_m);
	batten_release(context, room->y_m);
	batten_release(context, room->varied_y_m);
}

static batten_status write_each(const report_sweep *sweep, sqlite3_stmt *statement, FILE *stream,
                                double *scales, size_t capacity, size_t *count)
{
	batten_context *context = sweep->database->context;
	const size_t nodes = sweep->station_count * sweep->waterline_count;
	row_room room = {
		.x_m = batten_allocate(context, sweep->station_count, sizeof(double)),
		.z_m = batten_allocate(context, sweep->waterline_count, sizeof(double)),
		.y_m = batten_allocate(context, nodes, sizeof(double)),
		.varied_y_m = batten_allocate(context, nodes, sizeof(double)),
	};
	bool more = false;
	batten_status status = BATTEN_MEMORY;
	if (room.x_m && room.z_m && room.y_m && room.varied_y_m)
		status = report_next(sweep->database, statement, &more);
	while (status == BATTEN_OK && more && *count < capacity) {
		status = write_hull(sweep, statement, &room, stream, &scales[*count]);
		++*count;
		if (status == BATTEN_OK)
			status = report_next(sweep->database, statement, &more);
	}
	release_room(context, &room);
	return status;
}

/* ---- all of them ---- */

static batten_status write_parent(const report_sweep *sweep, FILE *stream, double *scale_per_m)
{
	const char *text = report_meta_text(sweep, "parent");
	batten_hull *hull = NULL;
	if (!text)
		return BATTEN_OK;
	batten_context *context = sweep->database->context;
	batten_status status = batten_hull_parse(context, "parent", text, strlen(text), &hull);
	if (status == BATTEN_INPUT)
		return report_invalid(sweep->database, "meta: %s", batten_context_error(context));
	if (status == BATTEN_OK)
		status = hull_block_write(sweep, hull, NULL, "parent", stream, scale_per_m);
	batten_hull_destroy(hull);
	return status;
}

/* The middle one, so that neither the fairest nor a wild hull sets the colours of all. */
static double middle(double *scales, size_t count)
{
	qsort(scales, count, sizeof *scales, batten_number_compare);
	return scales[count / 2];
}

batten_status report_hulls_write(const report_sweep *sweep, const report_choice *choice,
                                 FILE *stream, report_hulls *out)
{
	sqlite3_stmt *statement = NULL;
	report_hulls hulls = { .scale_per_m = 1.0 };
	double *scales = batten_allocate(sweep->database->context, choice->most, sizeof *scales);
	batten_status status = scales ? write_parent(sweep, stream, &hulls.scale_per_m) : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = report_query(sweep->database, &statement,
		                      "SELECT id, lbp_m, draft_m, x_m, z_m, y_m, varied_y_m, nodes "
		                      "FROM geometry WHERE id IN (%s) ORDER BY id",
		                      choice->ids);
	if (status == BATTEN_OK)
		status = write_each(sweep, statement, stream, scales, choice->most, &hulls.count);
	sqlite3_finalize(statement);
	if (status == BATTEN_OK) {
		if (hulls.count > 0)
			hulls.scale_per_m = middle(scales, hulls.count);
		*out = hulls;
	}
	batten_release(sweep->database->context, scales);
	return status;
}
