/* batten_sweep_design: one design of a database as a hull. What the database does not keep is made
 * again: a design depends on the plan, the seed and its number alone. */
#include "sweep/stages.h"
#include "sweep/store.h"
#include "sweep/stored_plan.h"
#include "variation/variation.h"

#include <string.h>

/* The offsets of a design as they are kept; *found false where they are not. */
static batten_status take_kept(const sweep_database *database, sweep_block *block, bool *found)
{
	const batten_hull hull = sweep_block_final(block, database->context, 0);
	sqlite3_stmt *statement = NULL;
	batten_status status = database_prepare(
		database, &statement, "SELECT y_m FROM geometry WHERE id = %lld", (long long)block->first);
	if (status == BATTEN_OK)
		status = database_step(database, statement, found);
	if (status == BATTEN_OK && *found) {
		const size_t size = block->nodes_each * sizeof(double);
		const void *y = sqlite3_column_blob(statement, 0);
		if (y && (size_t)sqlite3_column_bytes(statement, 0) == size)
			memcpy(hull.y_m, y, size);
		else
			status = batten_fail(database->context, BATTEN_INPUT,
			                     "%s: the offsets of design %llu are damaged", database->path,
			                     (unsigned long long)block->first);
	}
	(void)sqlite3_finalize(statement);
	return status;
}

static batten_status make(const sweep_database *database, sweep_machine *machine,
                          sweep_block *block, uint64_t id, batten_hull **out)
{
	sweep_design *design = &block->designs[0];
	bool kept = false;
	sweep_block_begin(block, id, 1);
	batten_status status = sweep_stage_vary(machine, block);
	if (status == BATTEN_OK && sweep_design_lives(design))
		status = take_kept(database, block, &kept);
	if (status == BATTEN_OK && sweep_design_lives(design) && !kept && block->plan->fairs)
		status = sweep_stage_fair(machine, block);
	if (status == BATTEN_OK && !sweep_design_lives(design))
		status = batten_fail(database->context, BATTEN_INPUT, "%s: design %llu failed: %s",
		                     database->path, (unsigned long long)id, design->reason);
	const batten_hull hull = sweep_block_final(block, database->context, 0);
	if (status == BATTEN_OK)
		status = batten_hull_clone(database->context, &hull, out);
	/* A form of its own says so already. */
	if (status == BATTEN_OK && !design->form && block->plan->step_count > 0)
		status = variation_mark_source(*out);
	if (status != BATTEN_OK) {
		batten_hull_destroy(*out);
		*out = NULL;
	}
	return status;
}

batten_status batten_sweep_design(batten_context *context, const char *database_path, uint64_t id,
                                  batten_hull **out)
{
	*out = NULL;
	sweep_database database = { 0 };
	sweep_plan *plan = NULL;
	sweep_machine machine = { .context = context, .device = BATTEN_DEVICE_REFERENCE };
	sweep_block block = { 0 };
	batten_status status = database_open(context, database_path, DATABASE_READ, &database);
	if (status == BATTEN_OK)
		status = stored_plan_read(&database, &plan);
	if (status == BATTEN_OK && id >= plan->sampling.count)
		status = batten_fail(context, BATTEN_USAGE, "%s: found design %llu, expected 0 to %llu",
		                     database_path, (unsigned long long)id,
		                     (unsigned long long)(plan->sampling.count - 1));
	if (status == BATTEN_OK)
		status = sweep_crew_create(context, &machine.crew);
	if (status == BATTEN_OK)
		status = sweep_block_create(plan, 1, &block);
	if (status == BATTEN_OK)
		status = make(&database, &machine, &block, id, out);
	sweep_block_destroy(&block);
	sweep_machine_destroy(&machine);
	sweep_plan_destroy(plan);
	database_close(&database);
	return status;
}
