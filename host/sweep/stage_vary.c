/* Parameters -> variants. */
#include "hydrostatics/offsets_tables.h"
#include "sweep/stages.h"
#include "variation/measure.h"

#include <stddef.h>
#include <string.h>

/* Variants a thread makes at a time: the parent is prepared once for all of them. */
enum { VARY_PIECE = 32 };

/* What one thread needs for its piece. */
struct vary_piece {
	plan_variation bound[VARY_PIECE];
	batten_vary_options options[VARY_PIECE];
	batten_hull *variants[VARY_PIECE];
	batten_vary_outcome outcomes[VARY_PIECE];
};

static const double *parameters_of(const sweep_block *block, size_t i)
{
	return block->parameters + i * block->plan->sampling.parameter_count;
}

/* The options of one step for one design, all numbers in their places. */
static void bind(const plan_step *step, const double *parameters, plan_variation *bound,
                 batten_vary_options *options)
{
	*bound = step->fixed;
	plan_bind(&step->swept, parameters, bound);
	*options = bound->options;
	options->others = (const batten_hull *const *)step->others;
	options->weights = bound->weights;
	options->from_part = bound->from;
	options->to_part = bound->to;
}

/* ---- the first step, one by one ---- */

/* What the variation of one design came to. */
static batten_status take(sweep_block *block, size_t i, batten_hull *variant,
                          const batten_vary_outcome *outcome)
{
	if (variant)
		sweep_block_take(block, i, variant);
	if (outcome->status == BATTEN_MEMORY || outcome->status == BATTEN_INTERNAL)
		return outcome->status;
	if (outcome->status != BATTEN_OK)
		sweep_design_fail(&block->designs[i], SWEEP_VARY_FAILED, outcome->reason);
	return BATTEN_OK;
}

/* All from the parent, in one call. */
static batten_status vary_parent(batten_context *context, sweep_block *block,
                                 struct vary_piece *piece, size_t first, size_t count)
{
	const sweep_plan *plan = block->plan;
	for (size_t i = 0; i < count; i++)
		bind(&plan->steps[0], parameters_of(block, first + i), &piece->bound[i],
		     &piece->options[i]);
	batten_status status = batten_hull_vary_batch(context, plan->parent, count, piece->options,
	                                              piece->variants, piece->outcomes);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		return status;
	status = BATTEN_OK;
	for (size_t i = 0; i < count; i++) {
		const batten_status taken = take(block, first + i, piece->variants[i], &piece->outcomes[i]);
		status = status == BATTEN_OK ? taken : status;
	}
	return status;
}

static batten_status vary_piece(batten_context *context, void *user, size_t first, size_t count)
{
	struct vary_piece *piece = batten_allocate(context, 1, sizeof *piece);
	if (!piece)
		return BATTEN_MEMORY;
	const batten_status status = vary_parent(context, user, piece, first, count);
	batten_release(context, piece);
	return status;
}

/* ---- the first step, all in one batch ---- */

/* Whether only what differs from row to row of a batch is swept. */
static bool sweeps_rows(const plan_step *step)
{
	static const size_t rows[] = { offsetof(plan_variation, options.dcp_pct),
		                           offsetof(plan_variation, options.dlcb_pct),
		                           offsetof(plan_variation, options.dp_fore_pct),
		                           offsetof(plan_variation, options.dp_aft_pct) };
	size_t known = 0;
	for (size_t b = 0; b < step->swept.count; b++)
		for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++)
			known += step->swept.list[b].offset == rows[r];
	return known == step->swept.count;
}

/* Whether a batch knows method and parent. That depends on the plan alone: the two ways agree within
 * rounding, not bit for bit. */
static bool fits_batch(const sweep_plan *plan)
{
	const batten_vary_options *options = &plan->steps[0].fixed.options;
	return sweeps_rows(&plan->steps[0]) && variation_tables_fit(plan->parent, options) &&
	       offsets_tables_fit(plan->parent, BATTEN_QUADRATURE_SPLINE, 0);
}

static batten_status vary_batch(sweep_machine *machine, sweep_block *block, batten_vary_row *rows,
                                batten_vary_result *results)
{
	const plan_step *step = &block->plan->steps[0];
	for (size_t i = 0; i < block->count; i++) {
		plan_variation bound;
		batten_vary_options options;
		bind(step, parameters_of(block, i), &bound, &options);
		rows[i] = (batten_vary_row){ options.dcp_pct, options.dlcb_pct, options.dp_fore_pct,
			                         options.dp_aft_pct };
	}
	batten_batch_options batch;
	batten_batch_options_default(&batch);
	batch.device = sweep_machine_device_f64(machine);
	const batten_variants variants = { .count = block->count,
		                               .rows = rows,
		                               .results = results,
		                               .y_m = block->varied_y_m,
		                               .nodes = block->nodes };
	batten_status status = batten_hull_vary_measure(
		machine->context, block->plan->parent, &step->fixed.options, NULL, &batch, &variants, NULL);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		return status;
	for (size_t i = 0; i < block->count; i++)
		if (results[i].status != BATTEN_OK)
			sweep_design_fail(&block->designs[i], SWEEP_VARY_FAILED, results[i].reason);
	return BATTEN_OK;
}

static batten_status vary_rows(sweep_machine *machine, sweep_block *block)
{
	batten_context *context = machine->context;
	batten_vary_row *rows = batten_allocate(context, block->count, sizeof *rows);
	batten_vary_result *results = batten_allocate(context, block->count, sizeof *results);
	const batten_status status = rows && results ? vary_batch(machine, block, rows, results)
	                                             : BATTEN_MEMORY;
	batten_release(context, rows);
	batten_release(context, results);
	return status;
}

/* ---- later steps ---- */

/* Each design from what the step before made of it. */
static batten_status vary_again(batten_context *context, sweep_block *block, const plan_step *step,
                                size_t i)
{
	plan_variation bound;
	batten_vary_options options;
	batten_vary_outcome outcome;
	batten_hull *variant = NULL;
	const batten_hull before = sweep_block_varied(block, context, i);
	bind(step, parameters_of(block, i), &bound, &options);
	(void)batten_hull_vary(context, &before, &options, &variant, &outcome);
	return take(block, i, variant, &outcome);
}

static batten_status vary_further(batten_context *context, void *user, size_t first, size_t count)
{
	sweep_block *block = user;
	batten_status status = BATTEN_OK;
	for (size_t s = 1; s < block->plan->step_count; s++)
		for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
			if (sweep_design_lives(&block->designs[i]))
				status = vary_again(context, block, &block->plan->steps[s], i);
	return status;
}

static void copy_parent(sweep_block *block)
{
	const batten_hull *parent = block->plan->parent;
	for (size_t i = 0; i < block->count; i++) {
		memcpy(block->varied_y_m + i * block->nodes_each, parent->y_m,
		       block->nodes_each * sizeof(double));
		memcpy(block->nodes + i * block->nodes_each, parent->nodes, block->nodes_each);
	}
}

batten_status sweep_stage_vary(sweep_machine *machine, sweep_block *block)
{
	const sweep_plan *plan = block->plan;
	if (plan->step_count == 0) {
		copy_parent(block);
		return BATTEN_OK;
	}
	const batten_status status = fits_batch(plan) ? vary_rows(machine, block)
	                                              : sweep_crew_run(&machine->crew, block->count,
	                                                               VARY_PIECE, vary_piece, block);
	if (status != BATTEN_OK || plan->step_count == 1)
		return status;
	return sweep_crew_run(&machine->crew, block->count, VARY_PIECE, vary_further, block);
}
