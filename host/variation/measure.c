/* The public call that varies a parent and measures every variant, many rows at once. */
#include "variation/measure.h"

#include "batch/variants_batch.h"
#include "core/runs.h"
#include "hydrostatics/offsets_tables.h"
#include "variation/targets.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Rows of one piece of a batch, whose outcomes are held at once. */
enum { PIECE = 4096 };

/* A batch on its way through a device. */
struct batch {
	measure_task task;
	const variation_parent *ready;
	variants_plan plan;
	double *asked, *y, *outcomes; /* of a piece; y: the caller's memory, or the room */
	double *room;
	size_t *singly; /* rows of a piece that the kernel leaves to the host */
	size_t singly_count, singly_total;
	size_t *far; /* rows of a piece that are out of reach, by their numbers in it */
	size_t far_count;
};

/* ------------------------------------------------------------------------------------------------
 * Rows
 * --------------------------------------------------------------------------------------------- */

INLINED void take_nodes(size_t count, double *restrict y, const uint8_t *restrict parent,
                        uint8_t *restrict nodes)
{
	for (size_t n = 0; n < count && nodes; n++) {
		const uint8_t inside = parent[n] == BATTEN_NODE_UNKNOWN ? BATTEN_NODE_UNKNOWN
		                                                        : BATTEN_NODE_GIVEN;
		nodes[n] = y[n] < 0 ? BATTEN_NODE_OUTSIDE : inside;
	}
	for (size_t n = 0; n < count; n++)
		y[n] = y[n] > 0 ? y[n] : 0;
}

RUNS_FUNCTION(take_all, take_nodes,
              (size_t count, double *y, const uint8_t *parent, uint8_t *nodes),
              (count, y, parent, nodes))

/* Half-breadths of the device, below 0 outside, become those of a hull in their place. nodes may be NULL. */
static void take_offsets(const batten_hull *parent, double *y, uint8_t *nodes)
{
	take_all(hull_node_count(parent), y, parent->nodes, nodes);
}

/* The variant as a hull: what devices take keeps the parent's table and has no points off it. */
static batten_status make_hull(const measure_task *task, const double *found, batten_hull **out)
{
	batten_hull *hull = NULL;
	batten_status status = batten_hull_clone(task->context, task->parent, &hull);
	if (status == BATTEN_OK) {
		memcpy(hull->y_m, found, task->nodes * sizeof *found);
		take_offsets(task->parent, hull->y_m, hull->nodes);
		status = variation_mark_source(hull);
	}
	if (status == BATTEN_OK)
		*out = hull;
	else
		batten_hull_destroy(hull);
	return status;
}

static batten_status keep(struct batch *b, size_t which, size_t i)
{
	const batten_variants *v = b->task.v;
	const double *outcome = b->outcomes + i * variants_plan_outcome(&b->plan);
	/* There are none where neither offsets nor hulls are asked for. */
	double *found = b->y ? b->y + i * b->task.nodes : NULL;
	if (v->out)
		offsets_tables_take(b->task.parent, &b->task.hydrostatics, b->task.draft_count,
		                    v->drafts_m ? v->drafts_m : &b->task.parent->draft_m, outcome,
		                    measure_forms_of(&b->task, which));
	const batten_status status = found && v->hulls ? make_hull(&b->task, found, &v->hulls[which])
	                                               : BATTEN_OK;
	if (found)
		take_offsets(b->task.parent, found, v->nodes ? v->nodes + which * b->task.nodes : NULL);
	return status;
}

/* What batten_hull_vary() would tell of a row. */
static void tell(const struct batch *b, const batten_vary_options *options,
                 const batten_vary_result *result, batten_vary_outcome *out)
{
	variation_target targets[BATTEN_VARY_TARGETS_MOST];
	*out = (batten_vary_outcome){ .status = result->status, .passes = result->passes };
	(void)snprintf(out->reason, sizeof out->reason, "%s", result->reason);
	variation_warn_of_size(options, out);
	if (result->status != BATTEN_OK)
		return;
	batten_measures got = b->ready->measures;
	got.cp = result->cp;
	got.lcb_pct_lbp_fwd = result->lcb_pct_lbp_fwd;
	out->target_count = variation_targets(options, &b->ready->measures, targets);
	for (size_t i = 0; i < out->target_count; i++)
		out->targets[i] = variation_target_tell(&targets[i], &b->ready->measures, targets[i].asked,
		                                        variation_target_value(&targets[i], &got));
}

/* Takes what the device found for item i of a piece, row which of the batch. */
static batten_status take_row(struct batch *b, size_t which, size_t i)
{
	const double *outcome = b->outcomes + i * variants_plan_outcome(&b->plan);
	const batten_vary_options options = measure_row_options(&b->task, which);
	batten_vary_result *result = &b->task.v->results[which];
	*result = (batten_vary_result){ .passes = (unsigned)outcome[VARIANTS_OUT_TURNS],
		                            .cp = outcome[VARIANTS_OUT_CP],
		                            .lcb_pct_lbp_fwd = outcome[VARIANTS_OUT_LCB] };
	batten_status status = variation_check_options(b->task.context, &options);
	if (status != BATTEN_OK) {
		result->passes = 0;
		(void)snprintf(result->reason, sizeof result->reason, "%.119s",
		               batten_context_error(b->task.context));
		measure_leave_empty(&b->task, which, status);
	} else if (outcome[VARIANTS_OUT_END] == VARIANTS_END_IRREGULAR) {
		b->singly[b->singly_count++] = which;
		return BATTEN_OK;
	} else if (outcome[VARIANTS_OUT_END] != VARIANTS_END_GOOD) {
		if (outcome[VARIANTS_OUT_END] == VARIANTS_END_FOLDED)
			(void)snprintf(result->reason, sizeof result->reason,
			               "sections would run into each other");
		else
			(void)snprintf(result->reason, sizeof result->reason,
			               "after %u passes still off by %.3g", result->passes,
			               outcome[VARIANTS_OUT_OFF]);
		b->far[b->far_count++] = i;
		measure_leave_empty(&b->task, which, BATTEN_INPUT);
	} else {
		status = keep(b, which, i);
		if (status != BATTEN_OK)
			return status;
	}
	if (b->task.v->outcomes)
		tell(b, &options, result, &b->task.v->outcomes[which]);
	return BATTEN_OK;
}

/* Puts the range that can be reached into the reason of row which. */
static void explain(struct batch *b, size_t which, const double parts[2])
{
	const batten_vary_options options = measure_row_options(&b->task, which);
	const batten_variants *v = b->task.v;
	batten_vary_result *result = &v->results[which];
	variation_target targets[BATTEN_VARY_TARGETS_MOST];
	double asked[BATTEN_VARY_TARGETS_MOST];
	char text[384];
	const size_t count = variation_targets(&options, &b->ready->measures, targets);
	for (size_t i = 0; i < count; i++)
		asked[i] = targets[i].asked;
	if (isnan(parts[0]))
		(void)snprintf(text, sizeof text, "%s: %s", batten_vary_method_name((size_t)options.method),
		               result->reason);
	else
		variation_tell_reach(text, sizeof text, options.method, result->reason, count, targets,
		                     asked, &b->ready->measures, parts[0], parts[1]);
	(void)snprintf(result->reason, sizeof result->reason, "%.119s", text);
	if (v->outcomes)
		(void)snprintf(v->outcomes[which].reason, sizeof v->outcomes[which].reason, "%.383s", text);
}

/* The rows of a piece that are out of reach, all together. */
static batten_status explain_far(struct batch *b, size_t first)
{
	if (b->far_count == 0)
		return BATTEN_OK;
	double *parts = batten_allocate(b->task.context, b->far_count, 2 * sizeof *parts);
	if (!parts)
		return BATTEN_MEMORY;
	for (size_t k = 0; k < b->far_count; k++)
		memmove(b->asked + k * VARIANTS_ASK_COUNT, b->asked + b->far[k] * VARIANTS_ASK_COUNT,
		        VARIANTS_ASK_COUNT * sizeof *b->asked);
	/* one pass of the formulas reaches what it reaches */
	batten_status status = BATTEN_OK;
	for (size_t k = 0; k < 2 * b->far_count; k++)
		parts[k] = NAN;
	if (!b->task.options.first_pass)
		status = measure_reach(&b->plan, b->far_count, b->asked, parts);
	for (size_t k = 0; k < b->far_count && status == BATTEN_OK; k++)
		explain(b, first + b->far[k], parts + 2 * k);
	batten_release(b->task.context, parts);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * A piece of the batch on the device
 * --------------------------------------------------------------------------------------------- */

static void ask(struct batch *b, size_t which, double *asked)
{
	const batten_vary_options options = measure_row_options(&b->task, which);
	const bool good = variation_check_options(b->task.context, &options) == BATTEN_OK;
	asked[VARIANTS_ASK_FULLNESS] = good ? options.dcp_pct : 0;
	asked[VARIANTS_ASK_CENTRE] = good ? options.dlcb_pct : 0;
	asked[VARIANTS_ASK_BODY_AFT] = good ? options.dp_aft_pct / 100 : 0;
	asked[VARIANTS_ASK_BODY_FORE] = good ? options.dp_fore_pct / 100 : 0;
}

static batten_status run_piece(struct batch *b, size_t first, size_t count, batten_run *run)
{
	batten_run told = { .strict = true };
	for (size_t i = 0; i < count; i++)
		ask(b, first + i, b->asked + i * VARIANTS_ASK_COUNT);
	b->plan.count = count;
	b->plan.asked = b->asked;
	b->y = b->task.v->y_m ? b->task.v->y_m + first * b->task.nodes : b->room;
	b->plan.found_y_m = b->y;
	b->plan.out = b->outcomes;
	b->singly_count = b->far_count = 0;
	batten_status status = variants_batch_run(&b->plan, &told);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		status = take_row(b, first + i, i);
	if (status == BATTEN_OK)
		status = explain_far(b, first);
	if (status == BATTEN_OK)
		status = measure_on_host(&b->task, b->singly_count, b->singly);
	b->singly_total += b->singly_count;
	told.seconds += run->seconds;
	*run = told;
	return status;
}

static batten_status make_plan(struct batch *b, size_t piece)
{
	const measure_task *task = &b->task;
	const batten_variants *v = task->v;
	const double *drafts = v->drafts_m ? v->drafts_m : &task->parent->draft_m;
	batten_status status = variants_plan_create(task->context, task->parent->station_count,
	                                            task->parent->waterline_count, task->draft_count,
	                                            &b->plan);
	if (status == BATTEN_OK)
		status = offsets_tables_fill(task->parent, drafts, task->parent->draft_m, &b->plan);
	if (status == BATTEN_OK)
		status = variation_tables_fill(b->ready, &task->options, &b->plan);
	if (status != BATTEN_OK)
		return status;
	b->plan.device = task->batch.device;
	b->plan.lanes = task->batch.lanes;
	b->plan.work_group = task->batch.work_group;
	const bool apart = !v->y_m && (v->nodes || v->hulls);
	const size_t outcome = variants_plan_outcome(&b->plan) * sizeof(double);
	b->asked = batten_allocate(task->context, piece, VARIANTS_ASK_COUNT * sizeof(double));
	b->outcomes = batten_allocate(task->context, piece, outcome);
	b->singly = batten_allocate(task->context, piece, sizeof *b->singly);
	b->far = batten_allocate(task->context, piece, sizeof *b->far);
	b->room = apart ? batten_allocate(task->context, piece, task->nodes * sizeof(double)) : NULL;
	return b->asked && b->outcomes && b->singly && b->far && (!apart || b->room) ? BATTEN_OK
	                                                                             : BATTEN_MEMORY;
}

/* The whole batch on the device, piece by piece. *singly gets the rows that the host took. */
static batten_status run_on_device(const measure_task *task, const variation_parent *ready,
                                   size_t *singly, batten_run *run)
{
	struct batch b = { .task = *task, .ready = ready };
	const size_t rows = task->v->count, piece = rows < PIECE ? rows : PIECE;
	batten_status status = make_plan(&b, piece);
	for (size_t first = 0; first < rows && status == BATTEN_OK; first += piece)
		status = run_piece(&b, first, rows - first < piece ? rows - first : piece, run);
	batten_release(task->context, b.asked);
	batten_release(task->context, b.outcomes);
	batten_release(task->context, b.singly);
	batten_release(task->context, b.far);
	batten_release(task->context, b.room);
	variants_plan_destroy(&b.plan);
	*singly = b.singly_total;
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * The whole
 * --------------------------------------------------------------------------------------------- */

/* Methods whose variants stand on the parent's table. */
static bool keeps_table(batten_vary_method method)
{
	return (int)method >= BATTEN_VARY_SWING && method <= BATTEN_VARY_MOOR;
}

static batten_status check_options(measure_task *task, const batten_vary_options *options)
{
	const batten_variants *v = task->v;
	if (v->row_options) {
		for (size_t i = 0; i < v->count && (v->y_m || v->nodes); i++)
			if (!keeps_table(v->row_options[i].method))
				return batten_fail(task->context, BATTEN_USAGE,
				                   "row %zu: half-breadths on the parent's table are asked of a "
				                   "method that changes it",
				                   i);
		if (v->count > 0)
			task->options = v->row_options[0];
		return BATTEN_OK;
	}
	if (!options || options->struct_size != sizeof *options)
		return batten_fail(task->context, BATTEN_USAGE,
		                   "vary options: not filled by batten_vary_options_default()");
	if (!keeps_table(options->method))
		return batten_fail(task->context, BATTEN_USAGE,
		                   "method %d: swing, one-minus-prismatic, lackenby or moor is expected of "
		                   "rows of numbers",
		                   (int)options->method);
	if (fabs(options->lcb_used_pct) > 50)
		return batten_fail(task->context, BATTEN_USAGE, "lcb_used is %g, expected -50 to 50",
		                   options->lcb_used_pct);
	task->options = *options;
	return BATTEN_OK;
}

static batten_status check(measure_task *task, const batten_vary_options *options,
                           const batten_hydrostatics_options *forms,
                           const batten_batch_options *batch)
{
	const batten_hull *parent = task->parent;
	const double low = parent->z_m[0], high = parent->z_m[parent->waterline_count - 1];
	batten_status status = check_options(task, options);
	if (status == BATTEN_OK)
		status = quantities_options(task->context, forms, &task->hydrostatics);
	if (status == BATTEN_OK)
		status = variants_options(task->context, batch, &task->batch);
	if (!task->v->drafts_m && task->v->draft_count > 1 && status == BATTEN_OK)
		status = batten_fail(task->context, BATTEN_USAGE,
		                     "%zu drafts without a list, expected 1 at most", task->v->draft_count);
	/* of methods that change the table each variant has its own */
	for (size_t d = 0; d < task->draft_count && task->v->drafts_m && status == BATTEN_OK; d++)
		if (keeps_table(task->options.method))
			status = quantities_check_draft(task->context, low, high, task->v->drafts_m[d]);
	return status;
}

static bool alike(double a, double b)
{
	return a == b || (isnan(a) && isnan(b));
}

/* Whether one set of tables serves all rows. */
static bool rows_share_tables(const measure_task *task)
{
	const batten_vary_options *rows = task->v->row_options, *first = &task->options;
	for (size_t i = 0; i < task->v->count && rows; i++)
		if (rows[i].method != first->method || rows[i].first_pass != first->first_pass ||
		    rows[i].thesis != first->thesis || !alike(rows[i].lcb_used_pct, first->lcb_used_pct))
			return false;
	return true;
}

static batten_status run_all_on_host(const measure_task *task)
{
	const size_t count = task->v->count;
	size_t *which = batten_allocate(task->context, count, sizeof *which);
	if (!which)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < count; i++)
		which[i] = i;
	const batten_status status = measure_on_host(task, count, which);
	batten_release(task->context, which);
	return status;
}

static batten_status run_all(const measure_task *task, size_t *singly, batten_run *run)
{
	const batten_variants *v = task->v;
	variation_parent ready = { 0 };
	batten_status status = BATTEN_OK;
	*singly = v->count;
	if (keeps_table(task->options.method)) {
		status = variation_parent_create(task->context, task->parent, &ready);
		if (status == BATTEN_OK)
			status = variation_parent_sections(&ready, task->options.thesis);
	}
	if (status == BATTEN_OK)
		status = variation_tables_fit(task->parent, &task->options) && rows_share_tables(task) &&
		                 offsets_tables_fit(task->parent, task->hydrostatics.quadrature,
		                                    task->draft_count)
		             ? run_on_device(task, &ready, singly, run)
		             : run_all_on_host(task);
	variation_parent_destroy(&ready);
	return status;
}

batten_status batten_hull_vary_measure(batten_context *context, const batten_hull *parent,
                                       const batten_vary_options *options,
                                       const batten_hydrostatics_options *forms,
                                       const batten_batch_options *batch,
                                       const batten_variants *variants, batten_run *run)
{
	measure_task task = { .context = context,
		                  .parent = parent,
		                  .v = variants,
		                  .nodes = hull_node_count(parent),
		                  .draft_count = variants->draft_count };
	batten_run told = { .strict = true };
	size_t singly = 0, failed = 0;
	for (size_t i = 0; i < variants->count && variants->hulls; i++)
		variants->hulls[i] = NULL;
	batten_status status = check(&task, options, forms, batch);
	if (status == BATTEN_OK)
		status = run_all(&task, &singly, &told);
	for (size_t i = 0; i < variants->count && variants->hulls && status != BATTEN_OK; i++) {
		batten_hull_destroy(variants->hulls[i]);
		variants->hulls[i] = NULL;
	}
	if (status != BATTEN_OK)
		return status;
	variants_tell_singly(&told, singly, variants->count);
	if (run)
		*run = told;
	for (size_t i = 0; i < variants->count; i++)
		failed += variants->results[i].status != BATTEN_OK;
	return failed == 0 ? BATTEN_OK
	                   : batten_fail(context, BATTEN_INCOMPLETE, "%zu of %zu variants failed",
	                                 failed, variants->count);
}
