/* The public hydrostatics of many half-breadths on one table. */
#include "batch/variants_batch.h"
#include "hydrostatics/offsets_tables.h"

#include <math.h>
#include <string.h>

/* Hulls of one piece of a batch, whose outcomes are held at once. */
enum { PIECE = 4096 };

/* A batch and what it stands on. */
struct task {
	batten_context *context;
	const batten_hull *table;
	batten_hydrostatics_options chosen;
	size_t draft_count;
	const double *drafts_m;
	const double *y_m;
	const uint8_t *nodes;
	batten_hydrostatics *out;
	size_t singly; /* hulls the kernel could not take */
};

static size_t node_count(const struct task *task)
{
	return hull_node_count(task->table);
}

static const uint8_t *nodes_of(const struct task *task, size_t which)
{
	return task->nodes ? task->nodes + which * node_count(task) : task->table->nodes;
}

static bool is_half_breadth(double y)
{
	return (y >= 0) & (y <= HULL_LARGEST_M);
}

static batten_status check_offsets(const struct task *task, size_t count)
{
	const size_t all = node_count(task);
	for (size_t i = 0; i < count; i++) {
		const uint8_t *nodes = nodes_of(task, i);
		const double *y = task->y_m + i * all;
		size_t sound = 0;
		for (size_t n = 0; n < all; n++)
			sound += (nodes[n] == BATTEN_NODE_OUTSIDE) | is_half_breadth(y[n]);
		for (size_t n = 0; n < all && sound < all; n++)
			if (nodes[n] != BATTEN_NODE_OUTSIDE && !is_half_breadth(y[n]))
				return batten_fail(task->context, BATTEN_USAGE,
				                   "hull %zu: half-breadth %g m of node %zu, expected 0 to %g", i,
				                   y[n], n, HULL_LARGEST_M);
	}
	return BATTEN_OK;
}

/* One hull by itself. */
static batten_status measure_one(struct task *task, size_t which)
{
	task->singly++;
	const size_t nodes = node_count(task);
	batten_hull *hull = NULL;
	batten_status status = batten_hull_clone(task->context, task->table, &hull);
	if (status != BATTEN_OK)
		return status;
	if (task->nodes)
		memcpy(hull->nodes, task->nodes + which * nodes, nodes);
	for (size_t n = 0; n < nodes; n++)
		hull->y_m[n] = hull->nodes[n] == BATTEN_NODE_OUTSIDE ? 0 : task->y_m[which * nodes + n];
	status = batten_hull_hydrostatics(task->context, hull, &task->chosen, task->draft_count,
	                                  task->drafts_m, task->out + which * task->draft_count);
	batten_hull_destroy(hull);
	return status;
}

/* As batten_hull_half_beam_m(): points off the grid count too. */
static double half_beam_of(const struct task *task, size_t which)
{
	const size_t nodes = node_count(task);
	double most = hull_widest_node_m(nodes, nodes_of(task, which), task->y_m + which * nodes);
	for (size_t i = 0; i < task->table->end_count; i++)
		most = fmax(most, task->table->ends[i].y_m);
	return most;
}

/* Hulls first .. first + count - 1 through the plan; those it cannot take one by one. */
static batten_status run_piece(struct task *task, variants_plan *plan, size_t first, size_t count,
                               batten_run *run)
{
	const size_t nodes = node_count(task), numbers = variants_plan_outcome(plan);
	batten_run told = { .strict = true };
	plan->count = count;
	plan->y_m = task->y_m + first * nodes;
	plan->nodes = task->nodes ? task->nodes + first * nodes : task->table->nodes;
	plan->nodes_alike = !task->nodes;
	batten_status status = variants_batch_run(plan, &told);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		double *outcome = plan->out + i * numbers;
		outcome[VARIANTS_OUT_HALF_BEAM] = half_beam_of(task, first + i);
		if (outcome[VARIANTS_OUT_END] == VARIANTS_END_GOOD)
			offsets_tables_take(task->table, &task->chosen, task->draft_count, task->drafts_m,
			                    outcome, task->out + (first + i) * task->draft_count);
		else
			status = measure_one(task, first + i);
	}
	told.seconds += run->seconds;
	*run = told;
	return status;
}

static batten_status run_pieces(struct task *task, variants_plan *plan, size_t count,
                                batten_run *run)
{
	const size_t piece = count < PIECE ? count : PIECE;
	batten_status status = offsets_tables_fill(task->table, task->drafts_m, NAN, plan);
	plan->out = batten_allocate(task->context, piece,
	                            variants_plan_outcome(plan) * sizeof *plan->out);
	if (!plan->out && status == BATTEN_OK)
		status = BATTEN_MEMORY;
	for (size_t first = 0; first < count && status == BATTEN_OK; first += piece)
		status = run_piece(task, plan, first, count - first < piece ? count - first : piece, run);
	batten_release(task->context, plan->out);
	return status;
}

batten_status batten_hull_hydrostatics_batch(batten_context *context, const batten_hull *table,
                                             const batten_hydrostatics_options *options,
                                             const batten_batch_options *batch, size_t count,
                                             const double *y_m, const uint8_t *nodes,
                                             size_t draft_count, const double *drafts_m,
                                             batten_hydrostatics *out, batten_run *run)
{
	struct task task = { context, table, { 0 }, draft_count, drafts_m, y_m, nodes, out, 0 };
	batten_run told = { .strict = true };
	const double low = table->z_m[0], high = table->z_m[table->waterline_count - 1];
	batten_batch_options chosen;
	batten_status status = quantities_options(context, options, &task.chosen);
	if (status == BATTEN_OK)
		status = variants_options(context, batch, &chosen);
	for (size_t d = 0; d < draft_count && status == BATTEN_OK; d++)
		status = quantities_check_draft(context, low, high, drafts_m[d]);
	if (status == BATTEN_OK)
		status = check_offsets(&task, count);
	if (status != BATTEN_OK)
		return status;
	if (!offsets_tables_fit(table, task.chosen.quadrature, draft_count)) {
		for (size_t i = 0; i < count && status == BATTEN_OK; i++)
			status = measure_one(&task, i);
	} else if (count > 0 && draft_count > 0) {
		variants_plan plan = { 0 };
		status = variants_plan_create(context, table->station_count, table->waterline_count,
		                              draft_count, &plan);
		plan.device = chosen.device;
		plan.lanes = chosen.lanes;
		plan.work_group = chosen.work_group;
		if (status == BATTEN_OK)
			status = run_pieces(&task, &plan, count, &told);
		variants_plan_destroy(&plan);
	}
	variants_tell_singly(&told, task.singly, count);
	if (status == BATTEN_OK && run)
		*run = told;
	return status;
}
