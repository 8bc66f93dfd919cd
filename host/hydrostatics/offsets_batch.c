/* The hydrostatics of many half-breadths on one table. */
#include "hydrostatics/offsets_batch.h"

#include "batch/variants_batch.h"
#include "hydrostatics/offsets_tables.h"

#include <math.h>
#include <string.h>

/* Hulls of one piece of a batch, whose outcomes are held at once. */
enum { PIECE = 4096 };

struct offsets_batch {
	batten_context *context;
	const batten_hull *table;
	batten_hydrostatics_options chosen;
	size_t draft_count;
	double *drafts_m;
	variants_plan plan; /* empty where hulls on this table go one by one */
};

/* Hulls at work. */
struct task {
	offsets_batch *batch;
	const double *y_m;
	const uint8_t *nodes;
	batten_hydrostatics *out;
	size_t singly; /* hulls the kernel could not take */
};

static size_t node_count(const struct task *task)
{
	return hull_node_count(task->batch->table);
}

static const uint8_t *nodes_of(const struct task *task, size_t which)
{
	return task->nodes ? task->nodes + which * node_count(task) : task->batch->table->nodes;
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
				return batten_fail(task->batch->context, BATTEN_USAGE,
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
	batten_status status = batten_hull_clone(task->batch->context, task->batch->table, &hull);
	if (status != BATTEN_OK)
		return status;
	if (task->nodes)
		memcpy(hull->nodes, task->nodes + which * nodes, nodes);
	for (size_t n = 0; n < nodes; n++)
		hull->y_m[n] = hull->nodes[n] == BATTEN_NODE_OUTSIDE ? 0 : task->y_m[which * nodes + n];
	status = batten_hull_hydrostatics(task->batch->context, hull, &task->batch->chosen,
	                                  task->batch->draft_count, task->batch->drafts_m,
	                                  task->out + which * task->batch->draft_count);
	batten_hull_destroy(hull);
	return status;
}

/* As batten_hull_half_beam_m(): points off the grid count too. */
static double half_beam_of(const struct task *task, size_t which)
{
	const size_t nodes = node_count(task);
	double most = hull_widest_node_m(nodes, nodes_of(task, which), task->y_m + which * nodes);
	for (size_t i = 0; i < task->batch->table->end_count; i++)
		most = fmax(most, task->batch->table->ends[i].y_m);
	return most;
}

/* Hulls first .. first + count - 1 through the plan; those it cannot take one by one. */
static batten_status run_piece(struct task *task, size_t first, size_t count, batten_run *run)
{
	variants_plan *plan = &task->batch->plan;
	const size_t nodes = node_count(task), numbers = variants_plan_outcome(plan);
	batten_run told = { .strict = true };
	plan->count = count;
	plan->y_m = task->y_m + first * nodes;
	plan->nodes = task->nodes ? task->nodes + first * nodes : task->batch->table->nodes;
	plan->nodes_alike = !task->nodes;
	batten_status status = variants_batch_run(plan, &told);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		double *outcome = plan->out + i * numbers;
		outcome[VARIANTS_OUT_HALF_BEAM] = half_beam_of(task, first + i);
		if (outcome[VARIANTS_OUT_END] == VARIANTS_END_GOOD)
			offsets_tables_take(task->batch->table, &task->batch->chosen, task->batch->draft_count,
			                    task->batch->drafts_m, outcome,
			                    task->out + (first + i) * task->batch->draft_count);
		else
			status = measure_one(task, first + i);
	}
	told.seconds += run->seconds;
	*run = told;
	return status;
}

static batten_status run_pieces(struct task *task, size_t count, batten_run *run)
{
	variants_plan *plan = &task->batch->plan;
	const size_t piece = count < PIECE ? count : PIECE;
	batten_status status = BATTEN_OK;
	plan->out = batten_allocate(task->batch->context, piece,
	                            variants_plan_outcome(plan) * sizeof *plan->out);
	if (!plan->out)
		return BATTEN_MEMORY;
	for (size_t first = 0; first < count && status == BATTEN_OK; first += piece)
		status = run_piece(task, first, count - first < piece ? count - first : piece, run);
	batten_release(task->batch->context, plan->out);
	return status;
}

static batten_status make_plan(offsets_batch *batch, const batten_batch_options *chosen)
{
	const batten_hull *table = batch->table;
	const batten_status status = variants_plan_create(batch->context, table->station_count,
	                                                  table->waterline_count, batch->draft_count,
	                                                  &batch->plan);
	batch->plan.device = chosen->device;
	batch->plan.lanes = chosen->lanes;
	batch->plan.work_group = chosen->work_group;
	return status == BATTEN_OK ? offsets_tables_fill(table, batch->drafts_m, NAN, &batch->plan)
	                           : status;
}

batten_status offsets_batch_create(batten_context *context, const batten_hull *table,
                                   const batten_hydrostatics_options *options,
                                   const batten_batch_options *batch, size_t draft_count,
                                   const double *drafts_m, offsets_batch **out)
{
	const double low = table->z_m[0], high = table->z_m[table->waterline_count - 1];
	offsets_batch made = { .context = context, .table = table, .draft_count = draft_count };
	batten_batch_options chosen;
	batten_status status = quantities_options(context, options, &made.chosen);
	if (status == BATTEN_OK)
		status = variants_options(context, batch, &chosen);
	for (size_t d = 0; d < draft_count && status == BATTEN_OK; d++)
		status = quantities_check_draft(context, low, high, drafts_m[d]);
	if (status != BATTEN_OK)
		return status;
	offsets_batch *kept = batten_allocate(context, 1, sizeof *kept);
	made.drafts_m = batten_allocate(context, draft_count, sizeof *made.drafts_m);
	if (!kept || !made.drafts_m) {
		batten_release(context, made.drafts_m);
		batten_release(context, kept);
		return BATTEN_MEMORY;
	}
	if (draft_count > 0)
		memcpy(made.drafts_m, drafts_m, draft_count * sizeof *drafts_m);
	if (draft_count > 0 && offsets_tables_fit(table, made.chosen.quadrature, draft_count))
		status = make_plan(&made, &chosen);
	*kept = made;
	if (status == BATTEN_OK)
		*out = kept;
	else
		offsets_batch_destroy(kept);
	return status;
}

void offsets_batch_destroy(offsets_batch *batch)
{
	if (!batch)
		return;
	variants_plan_destroy(&batch->plan);
	batten_release(batch->context, batch->drafts_m);
	batten_release(batch->context, batch);
}

batten_status offsets_batch_run(offsets_batch *batch, size_t count, const double *y_m,
                                const uint8_t *nodes, batten_hydrostatics *out, batten_run *run)
{
	struct task task = { .batch = batch, .y_m = y_m, .nodes = nodes, .out = out };
	batten_run told = { .strict = true };
	batten_status status = check_offsets(&task, count);
	if (batch->plan.context && count > 0 && status == BATTEN_OK)
		status = run_pieces(&task, count, &told);
	const size_t alone = batch->plan.context || batch->draft_count == 0 ? 0 : count;
	for (size_t i = 0; i < alone && status == BATTEN_OK; i++)
		status = measure_one(&task, i);
	variants_tell_singly(&told, task.singly, count);
	if (status == BATTEN_OK && run)
		*run = told;
	return status;
}

batten_status batten_hull_hydrostatics_batch(batten_context *context, const batten_hull *table,
                                             const batten_hydrostatics_options *options,
                                             const batten_batch_options *batch, size_t count,
                                             const double *y_m, const uint8_t *nodes,
                                             size_t draft_count, const double *drafts_m,
                                             batten_hydrostatics *out, batten_run *run)
{
	offsets_batch *made = NULL;
	batten_status status = offsets_batch_create(context, table, options, batch, draft_count,
	                                            drafts_m, &made);
	if (status == BATTEN_OK)
		status = offsets_batch_run(made, count, y_m, nodes, out, run);
	offsets_batch_destroy(made);
	return status;
}
