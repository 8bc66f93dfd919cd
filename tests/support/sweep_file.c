#include "support/sweep_file.h"

#include <assert.h>
#include <math.h>
#include <sqlite3.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXTRA_COUNT = 5 };
static const char *const extra[EXTRA_COUNT] = { "cn_pct", "cn_max_m", "cn_rms_m", "closeness_m4",
	                                            "w2_over_w1" };

static void run(sqlite3 *database, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	char *text = sqlite3_vmprintf(format, arguments);
	va_end(arguments);
	assert(text);
	const int code = sqlite3_exec(database, text, NULL, NULL, NULL);
	if (code != SQLITE_OK)
		(void)fprintf(stderr, "%s: %s\n", text, sqlite3_errmsg(database));
	assert(code == SQLITE_OK);
	sqlite3_free(text);
}

void sweep_file_change(const char *path, const char *sql)
{
	sqlite3 *database = NULL;
	assert(sqlite3_open(path, &database) == SQLITE_OK);
	run(database, "%s", sql);
	assert(sqlite3_close(database) == SQLITE_OK);
}

static char *read_text(const char *path)
{
	FILE *stream = fopen(path, "rb");
	assert(stream);
	char *text = calloc(1, 1 << 20);
	assert(text && fread(text, 1, (1 << 20) - 1, stream) > 0);
	assert(fclose(stream) == 0);
	return text;
}

static char *json_of(const double *values, size_t count)
{
	char *text = calloc(count + 1, 32);
	size_t length = 0;
	assert(text);
	for (size_t i = 0; i < count; i++)
		length += (size_t)sprintf(text + length, "%s%.17g", i > 0 ? "," : "[", values[i]);
	(void)sprintf(text + length, "]");
	return text;
}

static void make_tables(sqlite3 *database)
{
	sqlite3_str *measures = sqlite3_str_new(database);
	sqlite3_str *form = sqlite3_str_new(database);
	for (size_t i = 0; batten_measure_name(i); i++)
		sqlite3_str_appendf(measures, ", \"%w\" REAL", batten_measure_name(i));
	for (size_t i = 0; i < EXTRA_COUNT; i++)
		sqlite3_str_appendf(measures, ", \"%w\" REAL", extra[i]);
	for (size_t i = 0; batten_hydrostatics_name(i); i++)
		if (strcmp(batten_hydrostatics_name(i), "draft_m") != 0)
			sqlite3_str_appendf(form, ", \"%w\" REAL", batten_hydrostatics_name(i));
	char *measure_columns = sqlite3_str_finish(measures);
	char *form_columns = sqlite3_str_finish(form);
	run(database,
	    "CREATE TABLE meta(key TEXT PRIMARY KEY, value) WITHOUT ROWID;"
	    "CREATE TABLE designs(id INTEGER PRIMARY KEY, status TEXT NOT NULL, "
	    "reason TEXT NOT NULL DEFAULT '', pareto INTEGER);"
	    "CREATE TABLE parameters(id INTEGER PRIMARY KEY, \"dcp\" REAL, \"dlcb\" REAL, \"seed\" REAL);"
	    "CREATE TABLE measures(id INTEGER PRIMARY KEY%s);"
	    "CREATE TABLE hydrostatics(id INTEGER, draft_m REAL%s, PRIMARY KEY(id, draft_m)) "
	    "WITHOUT ROWID;"
	    "CREATE TABLE geometry(id INTEGER PRIMARY KEY, lbp_m REAL, draft_m REAL, x_m BLOB, z_m BLOB, "
	    "y_m BLOB, varied_y_m BLOB, nodes BLOB);",
	    measure_columns, form_columns);
	sqlite3_free(measure_columns);
	sqlite3_free(form_columns);
}

static void make_meta(sqlite3 *database, const sweep_file *file, const batten_hull *parent)
{
	char *text = read_text(file->hull);
	char *x = json_of(batten_hull_x_m(parent), batten_hull_station_count(parent));
	char *z = json_of(batten_hull_z_m(parent), batten_hull_waterline_count(parent));
	run(database,
	    "INSERT INTO meta VALUES ('schema_version', 1), ('batten_version', %Q), ('name', %Q), "
	    "('plan', '{\"parent\": \"hull.csv\"}'), ('plan_hash', '0123456789abcdef'), ('seed', 7), "
	    "('design_count', %lld), ('shard', 1), ('shards', 1), ('parent', %Q), ('x_m', %Q), "
	    "('z_m', %Q), ('objectives', '[{\"measure\": \"energy_bending\", \"goal\": \"min\"}, "
	    "{\"measure\": \"volume_m3\", \"goal\": \"max\"}]'), "
	    "('keep', '{\"offsets\": \"best\", \"count\": %lld, \"by\": \"energy_bending\", "
	    "\"goal\": \"min\"}'), ('complete', 1)",
	    batten_version(), file->name, (long long)file->count, text, x, z, (long long)file->kept);
	free(text);
	free(x);
	free(z);
}

/* Where design i lies between 0 and 1 along direction k: evenly spread (the golden section's and the
 * root of 2's multiples). */
static double spread(size_t i, unsigned k)
{
	const double steps[2] = { 0.61803398874989484820, 0.41421356237309504880 };
	const double place = (double)(i + 1) * steps[k];
	return place - floor(place);
}

/* Wider or finer, and fuller forward or aft; with a ripple that fairing takes away. */
static void shape(const batten_hull *parent, size_t i, double *y, double *varied)
{
	const double lbp = batten_hull_lbp_m(parent);
	const size_t stations = batten_hull_station_count(parent);
	const size_t nodes = stations * batten_hull_waterline_count(parent);
	for (size_t n = 0; n < nodes; n++) {
		const double x = batten_hull_x_m(parent)[n % stations] / lbp - 0.5;
		const double wide = 0.9 + 0.2 * spread(i, 0) + 0.3 * (spread(i, 1) - 0.5) * x;
		y[n] = batten_hull_y_m(parent)[n] * wide;
		varied[n] = y[n] * (1.0 + (n % 3 == 0 ? 2e-3 : -1e-3));
	}
}

static void put(sqlite3 *database, sqlite3_stmt *statement)
{
	if (sqlite3_step(statement) != SQLITE_DONE)
		(void)fprintf(stderr, "%s\n", sqlite3_errmsg(database));
	assert(sqlite3_reset(statement) == SQLITE_OK && sqlite3_clear_bindings(statement) == SQLITE_OK);
}

typedef struct writer {
	sqlite3 *database;
	sqlite3_stmt *design, *parameters, *measures, *geometry;
} writer;

static sqlite3_stmt *prepare(sqlite3 *database, const char *table, int count)
{
	sqlite3_str *text = sqlite3_str_new(database);
	sqlite3_stmt *statement = NULL;
	sqlite3_str_appendf(text, "INSERT INTO %s VALUES (?", table);
	for (int i = 1; i < count; i++)
		sqlite3_str_appendall(text, ",?");
	sqlite3_str_appendall(text, ")");
	char *sql = sqlite3_str_finish(text);
	assert(sqlite3_prepare_v2(database, sql, -1, &statement, NULL) == SQLITE_OK);
	sqlite3_free(sql);
	return statement;
}

static void put_measures(const writer *w, batten_context *context, size_t i,
                         const batten_hull *hull)
{
	batten_measures measures;
	assert(batten_hull_measure(context, hull, NULL, &measures) == BATTEN_OK);
	double values[BATTEN_MEASURE_COUNT];
	memcpy(values, &measures, sizeof values);
	sqlite3_bind_int64(w->measures, 1, (sqlite3_int64)i);
	for (int k = 0; k < BATTEN_MEASURE_COUNT; k++)
		if (isfinite(values[k]))
			sqlite3_bind_double(w->measures, 2 + k, values[k]);
	sqlite3_bind_double(w->measures, 2 + BATTEN_MEASURE_COUNT, 0.1 + spread(i, 1));
	sqlite3_bind_double(w->measures, 3 + BATTEN_MEASURE_COUNT, 1e-3 * spread(i, 0));
	sqlite3_bind_double(w->measures, 6 + BATTEN_MEASURE_COUNT, 1000.0);
	put(w->database, w->measures);
}

/* The machines of the tests are little-endian, as the blobs are. */
static void put_geometry(const writer *w, size_t i, const batten_hull *hull, const double *varied)
{
	const int nodes = (int)(batten_hull_station_count(hull) * batten_hull_waterline_count(hull));
	sqlite3_bind_int64(w->geometry, 1, (sqlite3_int64)i);
	sqlite3_bind_double(w->geometry, 2, batten_hull_lbp_m(hull));
	sqlite3_bind_double(w->geometry, 3, batten_hull_draft_m(hull));
	sqlite3_bind_blob(w->geometry, 6, batten_hull_y_m(hull), nodes * 8, SQLITE_STATIC);
	sqlite3_bind_blob(w->geometry, 7, varied, nodes * 8, SQLITE_STATIC);
	sqlite3_bind_blob(w->geometry, 8, batten_hull_nodes(hull), nodes, SQLITE_STATIC);
	put(w->database, w->geometry);
}

static void put_design(const writer *w, batten_context *context, const sweep_file *file,
                       const batten_hull *parent, size_t i, double *y)
{
	const size_t nodes = batten_hull_station_count(parent) * batten_hull_waterline_count(parent);
	const bool is_failed = i % 97 == 96;
	sqlite3_bind_int64(w->design, 1, (sqlite3_int64)i);
	sqlite3_bind_text(w->design, 2, is_failed ? "vary_failed" : "done", -1, SQLITE_STATIC);
	sqlite3_bind_text(w->design, 3, is_failed ? "dcp: no such form" : "", -1, SQLITE_STATIC);
	put(w->database, w->design);
	sqlite3_bind_int64(w->parameters, 1, (sqlite3_int64)i);
	sqlite3_bind_double(w->parameters, 2, spread(i, 0));
	sqlite3_bind_double(w->parameters, 3, spread(i, 1));
	sqlite3_bind_double(w->parameters, 4, 7.0);
	put(w->database, w->parameters);
	if (is_failed)
		return;
	batten_hull *hull = NULL;
	shape(parent, i, y, y + nodes);
	assert(batten_hull_clone(context, parent, &hull) == BATTEN_OK);
	assert(batten_hull_set_y(context, hull, y) == BATTEN_OK);
	put_measures(w, context, i, hull);
	if (i < file->kept)
		put_geometry(w, i, hull, y + nodes);
	batten_hull_destroy(hull);
}

void sweep_file_make(batten_context *context, const sweep_file *file)
{
	writer w = { 0 };
	batten_hull *parent = NULL;
	assert(batten_hull_read(context, file->hull, &parent) == BATTEN_OK);
	assert(sqlite3_open(file->path, &w.database) == SQLITE_OK);
	run(w.database, "PRAGMA synchronous = OFF; BEGIN");
	make_tables(w.database);
	make_meta(w.database, file, parent);
	w.design = prepare(w.database, "designs", 4);
	w.parameters = prepare(w.database, "parameters", 4);
	w.measures = prepare(w.database, "measures", 1 + BATTEN_MEASURE_COUNT + EXTRA_COUNT);
	w.geometry = prepare(w.database, "geometry", 8);
	double *y = calloc(2 * batten_hull_station_count(parent) * batten_hull_waterline_count(parent),
	                   sizeof *y);
	assert(y);
	for (size_t i = 0; i < file->count; i++)
		put_design(&w, context, file, parent, i, y);
	free(y);
	sqlite3_finalize(w.design);
	sqlite3_finalize(w.parameters);
	sqlite3_finalize(w.measures);
	sqlite3_finalize(w.geometry);
	run(w.database,
	    "INSERT INTO hydrostatics(id, draft_m, volume_m3) SELECT g.id, g.draft_m * 0.5, "
	    "m.volume_m3 * 0.4 FROM geometry g JOIN measures m ON m.id = g.id;"
	    "INSERT INTO hydrostatics(id, draft_m, volume_m3) SELECT g.id, g.draft_m, m.volume_m3 "
	    "FROM geometry g JOIN measures m ON m.id = g.id;"
	    "UPDATE designs SET pareto = 0 WHERE status = 'done';"
	    "WITH best AS (SELECT id, energy_bending, max(volume_m3) OVER (ORDER BY energy_bending "
	    "ROWS BETWEEN UNBOUNDED PRECEDING AND 1 PRECEDING) AS before, volume_m3 FROM measures) "
	    "UPDATE designs SET pareto = 1 WHERE id IN "
	    "(SELECT id FROM best WHERE before IS NULL OR volume_m3 > before);"
	    "COMMIT");
	assert(sqlite3_close(w.database) == SQLITE_OK);
	batten_hull_destroy(parent);
}
