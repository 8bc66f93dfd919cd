/* The public call that varies a parent and measures every variant, many rows at once. */
#include "variation/measure.h"

#include "batch/variants_batch.h"
#include "hydrostatics/offsets_tables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Rows of one piece of a batch, whose outcomes are held at once. */
enum { PIECE = 4096 };

/* A batch and what it stands on. */
struct task {
	batten_context *context;
	const batten_hull *parent;
	batten_vary_options options;
	batten_hydrostatics_options hydrostatics;
	batten_batch_options batch;
	const batten_variants *v;
	size_t nodes, singly, failed;
	/* of a piece */
	double *asked, *y, *outcomes;
};

/* ------------------------------------------------------------------------------------------------
 * Rows
 * --------------------------------------------------------------------------------------------- */

/* What is asked of one row, or what is wrong with it. */
static const char *wrong_number(const struct task *task, const batten_vary_row *row, double *value)
{
	const bool swing = task->options.method == BATTEN_VARY_SWING;
	const struct {
		const char *name;
		double value, most;
	} numbers[] = {
		{ "dcp", swing ? 0 : row->dcp_pct, 1000 },
		{ "dlcb", row->dlcb_pct, 100 },
		{ "dp_fore", row->dp_fore_pct, 100 },
		{ "dp_aft", row->dp_aft_pct, 100 },
	};
	for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
		*value = numbers[i].value;
		if (!(*value >= -100 && *value <= numbers[i].most))
			return numbers[i].name;
	}
	return NULL;
}

static batten_hydrostatics *forms_of(const struct task *task, size_t which)
{
	return task->v->out ? task->v->out + which * task->v->draft_count : NULL;
}

/* A row without a variant. */
static void leave_empty(struct task *task, size_t which, batten_status status)
{
	const batten_variants *v = task->v;
	batten_vary_result *result = &v->results[which];
	result->status = status;
	result->cp = result->lcb_pct_lbp_fwd = NAN;
	task->failed++;
	for (size_t n = 0; n < task->nodes && v->y_m; n++)
		v->y_m[which * task->nodes + n] = NAN;
	if (v->nodes)
		memset(v->nodes + which * task->nodes, BATTEN_NODE_OUTSIDE, task->nodes);
	double *form = (double *)forms_of(task, which);
	for (size_t i = 0; form && i < v->draft_count * BATTEN_HYDROSTATICS_COUNT; i++)
		form[i] = NAN;
}

/* The variant of one row, made and measured on the host. Failing rows are no error. */
static batten_status work_singly(struct task *task, size_t which)
{
	const batten_variants *v = task->v;
	batten_vary_result *result = &v->results[which];
	batten_vary_outcome outcome;
	batten_measures measures;
	batten_hull *variant = NULL;
	batten_vary_options options = task->options;
	options.dcp_pct = v->rows[which].dcp_pct;
	options.dlcb_pct = v->rows[which].dlcb_pct;
	options.dp_fore_pct = v->rows[which].dp_fore_pct;
	options.dp_aft_pct = v->rows[which].dp_aft_pct;
	task->singly++;
	batten_status status = batten_hull_vary(task->context, task->parent, &options, &variant,
	                                        &outcome);
	result->passes = outcome.passes;
	if (status == BATTEN_OK)
		status = variation_measure(task->context, variant, &measures);
	if (status == BATTEN_OK && v->out)
		status = batten_hull_hydrostatics(task->context, variant, &task->hydrostatics,
		                                  v->draft_count, v->drafts_m, forms_of(task, which));
	if (status != BATTEN_OK) {
		batten_hull_destroy(variant);
		(void)snprintf(result->reason, sizeof result->reason, "%.119s",
		               batten_context_error(task->context));
		leave_empty(task, which, status);
		return status == BATTEN_MEMORY ? status : BATTEN_OK;
	}
	result->cp = measures.cp;
	result->lcb_pct_lbp_fwd = measures.lcb_pct_lbp_fwd;
	if (v->y_m)
		memcpy(v->y_m + which * task->nodes, variant->y_m, task->nodes * sizeof *v->y_m);
	if (v->nodes)
		memcpy(v->nodes + which * task->nodes, variant->nodes, task->nodes);
	batten_hull_destroy(variant);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * A piece of the batch on the device
 * --------------------------------------------------------------------------------------------- */

static void take_offsets(const struct task *task, size_t which, const double *y)
{
	const batten_variants *v = task->v;
	for (size_t n = 0; n < task->nodes && v->y_m; n++)
		v->y_m[which * task->nodes + n] = y[n] > 0 ? y[n] : 0;
	for (size_t n = 0; n < task->nodes && v->nodes; n++)
		v->nodes[which * task->nodes + n] = y[n] < 0 ? BATTEN_NODE_OUTSIDE
		                                    : task->parent->nodes[n] == BATTEN_NODE_UNKNOWN
		                                        ? BATTEN_NODE_UNKNOWN
		                                        : BATTEN_NODE_GIVEN;
}

static batten_status take_row(struct task *task, const variants_plan *plan, size_t which, size_t i)
{
	const double *outcome = task->outcomes + i * variants_plan_outcome(plan);
	batten_vary_result *result = &task->v->results[which];
	const char *method = batten_vary_method_name((size_t)task->options.method);
	double value = 0;
	const char *wrong = wrong_number(task, &task->v->rows[which], &value);
	*result = (batten_vary_result){ .status = BATTEN_OK,
		                            .passes = (unsigned)outcome[VARIANTS_OUT_TURNS],
		                            .cp = outcome[VARIANTS_OUT_CP],
		                            .lcb_pct_lbp_fwd = outcome[VARIANTS_OUT_LCB] };
	if (wrong) {
		(void)snprintf(result->reason, sizeof result->reason, "%s is %g percent, out of its range",
		               wrong, value);
		leave_empty(task, which, BATTEN_USAGE);
	} else if (outcome[VARIANTS_OUT_END] == VARIANTS_END_IRREGULAR) {
		return work_singly(task, which);
	} else if (outcome[VARIANTS_OUT_END] != VARIANTS_END_GOOD) {
		const bool folded = outcome[VARIANTS_OUT_END] == VARIANTS_END_FOLDED;
		(void)snprintf(result->reason, sizeof result->reason,
		               folded ? "%s: out of reach, sections would run into each other"
		                      : "%s: out of reach, still off by %.3g after %u passes",
		               method, outcome[VARIANTS_OUT_OFF], result->passes);
		leave_empty(task, which, BATTEN_INPUT);
	} else {
		if (task->y)
			take_offsets(task, which, task->y + i * task->nodes);
		if (task->v->out)
			offsets_tables_take(task->parent, &task->hydrostatics, task->v->draft_count,
			                    task->v->drafts_m, outcome, forms_of(task, which));
	}
	return BATTEN_OK;
}

static batten_status run_piece(struct task *task, variants_plan *plan, size_t first, size_t count,
                               batten_run *run)
{
	batten_run told = { .strict = true };
	for (size_t i = 0; i < count; i++) {
		const batten_vary_row *row = &task->v->rows[first + i];
		double *asked = task->asked + i * VARIANTS_ASK_COUNT, value = 0;
		const bool good = !wrong_number(task, row, &value);
		asked[VARIANTS_ASK_FULLNESS] = good ? row->dcp_pct : 0;
		asked[VARIANTS_ASK_CENTRE] = good ? row->dlcb_pct : 0;
		asked[VARIANTS_ASK_BODY_AFT] = good ? row->dp_aft_pct / 100 : 0;
		asked[VARIANTS_ASK_BODY_FORE] = good ? row->dp_fore_pct / 100 : 0;
	}
	plan->count = count;
	plan->asked = task->asked;
	plan->found_y_m = task->y;
	plan->out = task->outcomes;
	batten_status status = variants_batch_run(plan, &told);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		status = take_row(task, plan, first + i, i);
	told.seconds += run->seconds;
	*run = told;
	return status;
}

static batten_status run_pieces(struct task *task, const variation_parent *ready, batten_run *run)
{
	const batten_variants *v = task->v;
	const size_t piece = v->count < PIECE ? v->count : PIECE;
	variants_plan plan = { 0 };
	batten_status status = variants_plan_create(task->context, task->parent->station_count,
	                                            task->parent->waterline_count, v->draft_count,
	                                            &plan);
	if (status == BATTEN_OK)
		status = offsets_tables_fill(task->parent, v->drafts_m, task->parent->draft_m, &plan);
	if (status == BATTEN_OK)
		status = variation_tables_fill(ready, &task->options, &plan);
	plan.device = task->batch.device;
	plan.lanes = task->batch.lanes;
	plan.work_group = task->batch.work_group;
	if (status == BATTEN_OK) {
		const bool kept = v->y_m || v->nodes;
		const size_t outcome = variants_plan_outcome(&plan) * sizeof(double);
		task->asked = batten_allocate(task->context, piece, VARIANTS_ASK_COUNT * sizeof(double));
		task->outcomes = batten_allocate(task->context, piece, outcome);
		task->y = kept ? batten_allocate(task->context, piece, task->nodes * sizeof(double)) : NULL;
		if (!task->asked || !task->outcomes || (kept && !task->y))
			status = BATTEN_MEMORY;
	}
	for (size_t first = 0; first < v->count && status == BATTEN_OK; first += piece)
		status = run_piece(task, &plan, first, v->count - first < piece ? v->count - first : piece,
		                   run);
	batten_release(task->context, task->asked);
	batten_release(task->context, task->outcomes);
	batten_release(task->context, task->y);
	variants_plan_destroy(&plan);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * The whole
 * --------------------------------------------------------------------------------------------- */

static batten_status check(struct task *task, const batten_vary_options *options,
                           const batten_hydrostatics_options *forms,
                           const batten_batch_options *batch)
{
	const batten_hull *parent = task->parent;
	const double low = parent->z_m[0], high = parent->z_m[parent->waterline_count - 1];
	batten_status status = BATTEN_OK;
	if (options->struct_size != sizeof *options)
		return batten_fail(task->context, BATTEN_USAGE,
		                   "vary options: not filled by batten_vary_options_default()");
	if ((int)options->method < BATTEN_VARY_SWING || options->method > BATTEN_VARY_MOOR)
		return batten_fail(task->context, BATTEN_USAGE,
		                   "method %d: swing, one-minus-prismatic, lackenby or moor is expected of "
		                   "rows",
		                   (int)options->method);
	if (fabs(options->lcb_used_pct) > 50)
		return batten_fail(task->context, BATTEN_USAGE, "lcb_used is %g, expected -50 to 50",
		                   options->lcb_used_pct);
	task->options = *options;
	status = quantities_options(task->context, forms, &task->hydrostatics);
	if (status == BATTEN_OK)
		status = variants_options(task->context, batch, &task->batch);
	for (size_t d = 0; d < task->v->draft_count && status == BATTEN_OK; d++)
		status = quantities_check_draft(task->context, low, high, task->v->drafts_m[d]);
	return status;
}

batten_status batten_hull_vary_measure(batten_context *context, const batten_hull *parent,
                                       const batten_vary_options *options,
                                       const batten_hydrostatics_options *forms,
                                       const batten_batch_options *batch,
                                       const batten_variants *variants, batten_run *run)
{
	struct task task = {
		.context = context, .parent = parent, .v = variants, .nodes = hull_node_count(parent)
	};
	batten_run told = { .strict = true };
	variation_parent ready = { 0 };
	batten_status status = check(&task, options, forms, batch);
	if (status != BATTEN_OK)
		return status;
	status = variation_parent_create(context, parent, &ready);
	if (status == BATTEN_OK)
		status = variation_parent_sections(&ready, options->thesis);
	if (status == BATTEN_OK && variation_tables_fit(parent, options) &&
	    offsets_tables_fit(parent, task.hydrostatics.quadrature, variants->draft_count)) {
		status = run_pieces(&task, &ready, &told);
	} else {
		for (size_t i = 0; i < variants->count && status == BATTEN_OK; i++) {
			variants->results[i] = (batten_vary_result){ .status = BATTEN_OK };
			status = work_singly(&task, i);
		}
	}
	variation_parent_destroy(&ready);
	variants_tell_singly(&told, task.singly, variants->count);
	if (status == BATTEN_OK && run)
		*run = told;
	if (status == BATTEN_OK && task.failed > 0)
		status = batten_fail(context, BATTEN_INCOMPLETE, "%zu of %zu variants failed", task.failed,
		                     variants->count);
	return status;
}
