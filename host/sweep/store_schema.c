/* Tables of the database and what stands in meta. README.md describes them. */
#include "sweep/store.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *parameter_name(size_t i, void *user)
{
	return ((const sweep_plan *)user)->sampling.parameters[i].name;
}

static const char *measure_name(size_t i, void *user)
{
	(void)user;
	return sweep_measure_name(i);
}

static const char *hydrostatics_name(size_t i, void *user)
{
	(void)user;
	return batten_hydrostatics_name(i);
}

/* ---- tables ---- */

static batten_status make_table(const sweep_store *store, const char *table, size_t count,
                                const char *(*name)(size_t, void *), const char *key,
                                const char *ending)
{
	batten_context *context = store->database.context;
	char *columns = database_join(context, count, name, (void *)store->plan, ", \"", "\" REAL");
	if (!columns)
		return BATTEN_MEMORY;
	sqlite3_stmt *statement = NULL;
	batten_status status = database_prepare(&store->database, &statement, "CREATE TABLE %s (%s%s%s",
	                                        table, key, columns, ending);
	if (status == BATTEN_OK)
		status = database_do(&store->database, statement);
	(void)sqlite3_finalize(statement);
	batten_release(context, columns);
	return status;
}

static batten_status make_tables(const sweep_store *store)
{
	batten_status status = database_run(
		&store->database,
		"PRAGMA application_id=0x6274656e; PRAGMA user_version=1;"
		"CREATE TABLE meta (key TEXT PRIMARY KEY, value) WITHOUT ROWID;"
		"CREATE TABLE designs (id INTEGER PRIMARY KEY, status TEXT NOT NULL,"
		" reason TEXT NOT NULL DEFAULT '', pareto INTEGER);"
		"CREATE TABLE geometry (id INTEGER PRIMARY KEY, lbp_m REAL, draft_m REAL, x_m BLOB, z_m BLOB,"
		" y_m BLOB, varied_y_m BLOB, nodes BLOB);"
		"CREATE TABLE runs (run INTEGER PRIMARY KEY, started TEXT, ended TEXT, device TEXT,"
		" threads INTEGER, seconds REAL, designs_done INTEGER, exit TEXT)");
	if (status == BATTEN_OK)
		status = make_table(store, "parameters", store->plan->sampling.parameter_count,
		                    parameter_name, "id INTEGER PRIMARY KEY", ")");
	if (status == BATTEN_OK)
		status = make_table(store, "measures", SWEEP_MEASURE_COUNT, measure_name,
		                    "id INTEGER PRIMARY KEY", ")");
	if (status == BATTEN_OK)
		status = make_table(store, "hydrostatics", BATTEN_HYDROSTATICS_COUNT, hydrostatics_name,
		                    "id INTEGER", ", PRIMARY KEY (id, draft_m)) WITHOUT ROWID");
	return status;
}

/* ---- meta ---- */

/* A row of meta: text, or a whole number where text is NULL. */
static batten_status put(const sweep_store *store, const char *key, const char *text, size_t length,
                         uint64_t number)
{
	sqlite3_stmt *statement = NULL;
	batten_status status = database_prepare(&store->database, &statement,
	                                        "INSERT INTO meta (key, value) VALUES (?1, ?2)");
	if (status == BATTEN_OK) {
		(void)sqlite3_bind_text(statement, 1, key, -1, SQLITE_STATIC);
		if (text)
			(void)sqlite3_bind_text64(statement, 2, text, length, SQLITE_STATIC, SQLITE_UTF8);
		else
			(void)sqlite3_bind_int64(statement, 2, (sqlite3_int64)number);
		status = database_do(&store->database, statement);
	}
	(void)sqlite3_finalize(statement);
	return status;
}

static batten_status put_text(const sweep_store *store, const char *key, const char *text)
{
	return put(store, key, text, strlen(text), 0);
}

/* Takes the reference. */
static batten_status put_json(const sweep_store *store, const char *key, json_t *json)
{
	char *text = json ? json_dumps(json, JSON_COMPACT | JSON_REAL_PRECISION(17)) : NULL;
	json_decref(json);
	const batten_status status = text ? put_text(store, key, text)
	                                  : batten_fail_memory(store->database.context);
	free(text);
	return status;
}

static json_t *numbers_json(size_t count, const double *values)
{
	json_t *array = json_array();
	for (size_t i = 0; array && i < count; i++)
		(void)json_array_append_new(array, json_real(values[i]));
	return array;
}

static json_t *names_json(const sweep_plan *plan, size_t count, const char *(*name)(size_t, void *))
{
	json_t *array = json_array();
	for (size_t i = 0; array && i < count; i++)
		(void)json_array_append_new(array, json_string(name(i, (void *)plan)));
	return array;
}

static json_t *objective_json(const plan_objective *objective)
{
	return json_pack("{s:s, s:s}", "measure", sweep_measure_name(objective->measure), "goal",
	                 objective->greatest ? "max" : "min");
}

static json_t *keep_json(const sweep_plan *plan)
{
	static const char *const words[] = {
		[PLAN_KEEP_NONE] = "none", [PLAN_KEEP_BEST] = "best", [PLAN_KEEP_ALL] = "all"
	};
	json_t *object = json_pack("{s:s}", "offsets", words[plan->keep]);
	if (object && plan->keep == PLAN_KEEP_BEST) {
		(void)json_object_set_new(object, "count", json_integer((json_int_t)plan->keep_count));
		(void)json_object_set_new(object, "by",
		                          json_string(sweep_measure_name(plan->keep_by.measure)));
		(void)json_object_set_new(object, "goal",
		                          json_string(plan->keep_by.greatest ? "max" : "min"));
	}
	return object;
}

static batten_status put_plan(const sweep_store *store)
{
	const sweep_plan *plan = store->plan;
	batten_status status = put_text(store, "batten_version", batten_version());
	if (status == BATTEN_OK)
		status = put_text(store, "name", plan->name);
	if (status == BATTEN_OK)
		status = put_text(store, "plan", plan->text);
	if (status == BATTEN_OK)
		status = put_text(store, "plan_hash", plan->hash);
	for (size_t f = 0; f < plan->file_count && status == BATTEN_OK; f++)
		status = put(store, plan->files[f].role, plan->files[f].text, plan->files[f].length, 0);
	return status;
}

static batten_status put_numbers(const sweep_store *store)
{
	const struct {
		const char *key;
		uint64_t value;
	} numbers[] = {
		{ "schema_version", SWEEP_SCHEMA_VERSION },
		{ "seed", store->plan->sampling.seed },
		{ "design_count", store->plan->sampling.count },
		{ "shard", store->shard.index },
		{ "shards", store->shard.count },
		{ "complete", 0 },
	};
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < sizeof numbers / sizeof numbers[0] && status == BATTEN_OK; i++)
		status = put(store, numbers[i].key, NULL, 0, numbers[i].value);
	return status;
}

static batten_status put_lists(const sweep_store *store)
{
	const sweep_plan *plan = store->plan;
	const batten_hull *parent = plan->parent;
	json_t *objectives = json_array();
	for (size_t i = 0; i < plan->objective_count; i++)
		(void)json_array_append_new(objectives, objective_json(&plan->objectives[i]));
	batten_status status = put_json(store, "objectives", objectives);
	if (status == BATTEN_OK)
		status = put_json(store, "x_m", numbers_json(parent->station_count, parent->x_m));
	if (status == BATTEN_OK)
		status = put_json(store, "z_m", numbers_json(parent->waterline_count, parent->z_m));
	if (status == BATTEN_OK)
		status = put_json(store, "drafts_m", numbers_json(plan->draft_count, plan->drafts_m));
	if (status == BATTEN_OK)
		status = put_json(store, "parameters",
		                  names_json(plan, plan->sampling.parameter_count, parameter_name));
	if (status == BATTEN_OK)
		status = put_json(store, "measures", names_json(plan, SWEEP_MEASURE_COUNT, measure_name));
	return status == BATTEN_OK ? put_json(store, "keep", keep_json(plan)) : status;
}

batten_status store_make_schema(const sweep_store *store)
{
	batten_status status = make_tables(store);
	if (status == BATTEN_OK)
		status = put_numbers(store);
	if (status == BATTEN_OK)
		status = put_plan(store);
	return status == BATTEN_OK ? put_lists(store) : status;
}

batten_status store_meta(const sweep_database *database, const char *key, char **out,
                         size_t *length)
{
	sqlite3_stmt *statement = NULL;
	bool row = false;
	batten_status status = database_prepare(database, &statement,
	                                        "SELECT value FROM meta WHERE key = ?1");
	if (status == BATTEN_OK) {
		(void)sqlite3_bind_text(statement, 1, key, -1, SQLITE_STATIC);
		status = database_step(database, statement, &row);
	}
	if (status == BATTEN_OK && !row)
		status = batten_fail(database->context, BATTEN_INPUT,
		                     "%s: is no database of a sweep: meta has no %s", database->path, key);
	if (status == BATTEN_OK) {
		const char *text = (const char *)sqlite3_column_text(statement, 0);
		const size_t size = (size_t)sqlite3_column_bytes(statement, 0);
		*out = batten_allocate(database->context, size + 1, 1);
		status = *out ? BATTEN_OK : BATTEN_MEMORY;
		if (*out && size > 0)
			memcpy(*out, text, size);
		if (length)
			*length = size;
	}
	(void)sqlite3_finalize(statement);
	return status;
}

batten_status store_check_kind(const sweep_database *database)
{
	int64_t application = 0;
	int64_t version = 0;
	batten_status status = database_whole(database, "PRAGMA application_id", &application);
	if (status == BATTEN_OK)
		status = database_whole(database, "PRAGMA user_version", &version);
	if (status != BATTEN_OK)
		return status;
	if (application != SWEEP_SCHEMA_APPLICATION)
		return batten_fail(database->context, BATTEN_INPUT, "%s: is no database of a sweep",
		                   database->path);
	if (version != SWEEP_SCHEMA_VERSION)
		return batten_fail(
			database->context, BATTEN_INPUT,
			"%s: found a database of schema version %lld, expected version %d: batten "
			"%s reads no other",
			database->path, (long long)version, SWEEP_SCHEMA_VERSION, batten_version());
	return BATTEN_OK;
}

/* One value of meta against what it must be. */
static batten_status check_value(const sweep_store *store, const char *key, const char *expected,
                                 const char *what)
{
	char *found = NULL;
	batten_status status = store_meta(&store->database, key, &found, NULL);
	if (status == BATTEN_OK && strcmp(found, expected) != 0)
		status = batten_fail(store->database.context, BATTEN_INPUT,
		                     "%s: belongs to %s: found %s %.40s, expected %.40s",
		                     store->database.path, what, key, found, expected);
	batten_release(store->database.context, found);
	return status;
}

batten_status store_check(const sweep_store *store)
{
	char index[24];
	char count[24];
	(void)snprintf(index, sizeof index, "%llu", (unsigned long long)store->shard.index);
	(void)snprintf(count, sizeof count, "%llu", (unsigned long long)store->shard.count);
	batten_status status = store_check_kind(&store->database);
	if (status == BATTEN_OK)
		status = check_value(store, "plan_hash", store->plan->hash, "another plan");
	if (status == BATTEN_OK)
		status = check_value(store, "shard", index, "another shard");
	if (status == BATTEN_OK)
		status = check_value(store, "shards", count, "another number of shards");
	if (status == BATTEN_OK)
		status = check_value(store, "batten_version", batten_version(),
		                     "another version of batten");
	return status;
}
