/* A block of designs into the tables, in one transaction; and at the end which of all are not
 * dominated. */
#include "sweep/front.h"
#include "sweep/store.h"

#include <math.h>
#include <string.h>

/* A blob of doubles is little-endian whatever the machine; all that batten runs on are. */
_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "blobs are little-endian");

/* "INSERT INTO table VALUES (?, ?, ...)" with so many values. */
static batten_status prepare_insert(const sweep_store *store, const char *table, size_t count,
                                    sqlite3_stmt **out)
{
	batten_context *context = store->database.context;
	char *marks = batten_allocate(context, 2 * count, 1);
	if (!marks)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < count; i++) {
		marks[2 * i] = '?';
		marks[2 * i + 1] = i + 1 < count ? ',' : '\0';
	}
	const batten_status status = database_prepare(&store->database, out,
	                                              "INSERT INTO %s VALUES (%s)", table, marks);
	batten_release(context, marks);
	return status;
}

batten_status store_prepare(sweep_store *store)
{
	const size_t parameters = store->plan->sampling.parameter_count;
	batten_status status = prepare_insert(store, "designs", 4, &store->design);
	if (status == BATTEN_OK)
		status = prepare_insert(store, "parameters", 1 + parameters, &store->parameters);
	if (status == BATTEN_OK)
		status = prepare_insert(store, "measures", 1 + SWEEP_MEASURE_COUNT, &store->measures);
	/* draft_m is one of its quantities. */
	if (status == BATTEN_OK)
		status = prepare_insert(store, "hydrostatics", 1 + BATTEN_HYDROSTATICS_COUNT,
		                        &store->hydrostatics);
	if (status == BATTEN_OK)
		status = prepare_insert(store, "geometry", 8, &store->geometry);
	if (status == BATTEN_OK)
		status = database_prepare(&store->database, &store->forget,
		                          "DELETE FROM geometry WHERE id = ?1");
	return status;
}

/* ---- which offsets stay ---- */

static batten_status forget(const sweep_store *store, uint64_t id)
{
	(void)sqlite3_bind_int64(store->forget, 1, (sqlite3_int64)id);
	return database_do(&store->database, store->forget);
}

static batten_status offer(sweep_store *store, sweep_block *block, size_t i)
{
	const plan_objective *by = &store->plan->keep_by;
	sweep_design *design = &block->designs[i];
	if (!sweep_design_lives(design))
		return BATTEN_OK;
	const double value = design->measures[by->measure];
	uint64_t dropped = UINT64_MAX;
	design->kept = sweep_best_offer(
		&store->best, (best_entry){ by->greatest ? -value : value, block->first + i }, &dropped);
	if (dropped == UINT64_MAX)
		return BATTEN_OK;
	if (dropped < block->first)
		return forget(store, dropped);
	block->designs[dropped - block->first].kept = false;
	return BATTEN_OK;
}

static batten_status choose_kept(sweep_store *store, sweep_block *block)
{
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < block->count && status == BATTEN_OK; i++) {
		block->designs[i].kept = store->plan->keep == PLAN_KEEP_ALL && block->designs[i].measured;
		if (store->plan->keep == PLAN_KEEP_BEST)
			status = offer(store, block, i);
	}
	return status;
}

/* ---- rows ---- */

/* The number of the design, then values from column 2 on; NaN becomes NULL. */
static batten_status write_numbers(const sweep_store *store, sqlite3_stmt *statement, uint64_t id,
                                   const double *values, size_t count)
{
	(void)sqlite3_bind_int64(statement, 1, (sqlite3_int64)id);
	for (size_t i = 0; i < count; i++)
		(void)sqlite3_bind_double(statement, (int)i + 2, values[i]);
	return database_do(&store->database, statement);
}

static void bind_numbers(sqlite3_stmt *statement, int column, const double *values, size_t count)
{
	(void)sqlite3_bind_blob64(statement, column, values, count * sizeof *values, SQLITE_STATIC);
}

/* Coordinates stand in meta, unless the design has its own. */
static void bind_coordinates(sqlite3_stmt *statement, int column, const double *own,
                             const double *parent, size_t count)
{
	if (memcmp(own, parent, count * sizeof *own) == 0)
		(void)sqlite3_bind_null(statement, column);
	else
		bind_numbers(statement, column, own, count);
}

static batten_status write_geometry(const sweep_store *store, const sweep_block *block, size_t i)
{
	sqlite3_stmt *statement = store->geometry;
	const batten_hull *parent = store->plan->parent;
	const batten_hull hull = sweep_block_final(block, store->database.context, i);
	const size_t nodes = block->nodes_each;
	(void)sqlite3_bind_int64(statement, 1, (sqlite3_int64)block->first + (sqlite3_int64)i);
	(void)sqlite3_bind_double(statement, 2, hull.lbp_m);
	(void)sqlite3_bind_double(statement, 3, hull.draft_m);
	bind_coordinates(statement, 4, hull.x_m, parent->x_m, hull.station_count);
	bind_coordinates(statement, 5, hull.z_m, parent->z_m, hull.waterline_count);
	bind_numbers(statement, 6, hull.y_m, nodes);
	if (store->plan->fairs)
		bind_numbers(statement, 7, block->varied_y_m + i * nodes, nodes);
	else
		(void)sqlite3_bind_null(statement, 7);
	(void)sqlite3_bind_blob64(statement, 8, hull.nodes, nodes, SQLITE_STATIC);
	return database_do(&store->database, statement);
}

/* Whether every objective of a design has a value. */
static bool takes_part(const sweep_plan *plan, const sweep_design *design)
{
	bool part = plan->objective_count > 0 && sweep_design_lives(design);
	for (size_t o = 0; part && o < plan->objective_count; o++)
		part = !isnan(design->measures[plan->objectives[o].measure]);
	return part;
}

static batten_status write_status(const sweep_store *store, uint64_t id, const sweep_design *design)
{
	sqlite3_stmt *statement = store->design;
	(void)sqlite3_bind_int64(statement, 1, (sqlite3_int64)id);
	(void)sqlite3_bind_text(statement, 2, sweep_status_word(design->status), -1, SQLITE_STATIC);
	(void)sqlite3_bind_text(statement, 3, design->reason, -1, SQLITE_STATIC);
	if (takes_part(store->plan, design))
		(void)sqlite3_bind_int(statement, 4, 0);
	else
		(void)sqlite3_bind_null(statement, 4);
	return database_do(&store->database, statement);
}

static batten_status write_design(const sweep_store *store, const sweep_block *block, size_t i)
{
	const sweep_plan *plan = store->plan;
	const sweep_design *design = &block->designs[i];
	const uint64_t id = block->first + i;
	const size_t parameters = plan->sampling.parameter_count;
	batten_status status = write_status(store, id, design);
	if (status == BATTEN_OK)
		status = write_numbers(store, store->parameters, id, block->parameters + i * parameters,
		                       parameters);
	if (status == BATTEN_OK && design->measured)
		status = write_numbers(store, store->measures, id, design->measures, SWEEP_MEASURE_COUNT);
	for (size_t d = 0; d < plan->draft_count && design->measured && status == BATTEN_OK; d++) {
		const batten_hydrostatics *row = &block->hydrostatics[i * plan->draft_count + d];
		status = write_numbers(store, store->hydrostatics, id, (const double *)row,
		                       BATTEN_HYDROSTATICS_COUNT);
	}
	return status == BATTEN_OK && design->kept ? write_geometry(store, block, i) : status;
}

batten_status sweep_store_write(sweep_store *store, sweep_block *block)
{
	const sweep_database *database = &store->database;
	batten_status status = database_run(database, "BEGIN");
	if (status != BATTEN_OK)
		return status;
	status = choose_kept(store, block);
	for (size_t i = 0; i < block->count && status == BATTEN_OK; i++)
		status = write_design(store, block, i);
	if (status == BATTEN_OK)
		status = database_run(database, "COMMIT");
	if (status != BATTEN_OK) {
		(void)sqlite3_exec(database->handle, "ROLLBACK", NULL, NULL, NULL);
		return status;
	}
	store->next = block->first + block->count;
	return BATTEN_OK;
}

/* ---- the front ---- */

/* The designs that take part, and their objectives. */
struct candidates {
	size_t count;
	int64_t *ids;
	double *values; /* [count][objectives], less is better */
	uint8_t *on_front;
};

static const char *objective_name(size_t i, void *user)
{
	return sweep_measure_name(((const sweep_plan *)user)->objectives[i].measure);
}

static batten_status load(const sweep_store *store, struct candidates *candidates)
{
	const sweep_plan *plan = store->plan;
	const size_t objectives = plan->objective_count;
	sqlite3_stmt *statement = NULL;
	bool row = true;
	char *columns = database_join(plan->context, objectives, objective_name, (void *)plan, ", \"",
	                              "\"");
	batten_status status = columns ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = database_prepare(&store->database, &statement,
		                          "SELECT id%s FROM designs JOIN measures USING (id) "
		                          "WHERE pareto IS NOT NULL ORDER BY id",
		                          columns);
	for (size_t i = 0; status == BATTEN_OK; i++) {
		status = database_step(&store->database, statement, &row);
		if (status != BATTEN_OK || !row || i == candidates->count)
			break;
		candidates->ids[i] = sqlite3_column_int64(statement, 0);
		for (size_t o = 0; o < objectives; o++) {
			const double value = sqlite3_column_double(statement, (int)o + 1);
			candidates->values[i * objectives + o] = plan->objectives[o].greatest ? -value : value;
		}
	}
	(void)sqlite3_finalize(statement);
	batten_release(plan->context, columns);
	return status;
}

static batten_status mark(const sweep_store *store, const struct candidates *candidates)
{
	sqlite3_stmt *statement = NULL;
	batten_status status = database_prepare(&store->database, &statement,
	                                        "UPDATE designs SET pareto = 1 WHERE id = ?1");
	for (size_t i = 0; i < candidates->count && status == BATTEN_OK; i++) {
		if (!candidates->on_front[i])
			continue;
		(void)sqlite3_bind_int64(statement, 1, candidates->ids[i]);
		status = database_do(&store->database, statement);
	}
	(void)sqlite3_finalize(statement);
	return status;
}

batten_status store_mark_front(const sweep_store *store)
{
	batten_context *context = store->plan->context;
	const size_t objectives = store->plan->objective_count;
	int64_t count = 0;
	batten_status status = database_whole(
		&store->database, "SELECT count(*) FROM designs WHERE pareto IS NOT NULL", &count);
	if (status != BATTEN_OK || count == 0 || objectives == 0)
		return status;
	struct candidates candidates = { .count = (size_t)count };
	candidates.ids = batten_allocate(context, candidates.count, sizeof *candidates.ids);
	candidates.values = batten_allocate(context, candidates.count, objectives * sizeof(double));
	candidates.on_front = batten_allocate(context, candidates.count, 1);
	if (!candidates.ids || !candidates.values || !candidates.on_front)
		status = BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = load(store, &candidates);
	if (status == BATTEN_OK)
		status = sweep_front_find(context, candidates.count, objectives, candidates.values,
		                          candidates.on_front);
	if (status == BATTEN_OK)
		status = mark(store, &candidates);
	batten_release(context, candidates.ids);
	batten_release(context, candidates.values);
	batten_release(context, candidates.on_front);
	return status;
}
