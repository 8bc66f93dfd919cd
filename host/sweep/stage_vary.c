/* Parameters -> variants. */
#include "sweep/stages.h"

/* Variants a thread makes at a time: the parent is prepared once for all of them. */
enum { VARY_PIECE = 32 };

/* What one thread needs for its piece. */
struct vary_piece {
	plan_variation bound[VARY_PIECE];
	batten_vary_options options[VARY_PIECE];
	batten_hull *variants[VARY_PIECE];
	batten_vary_outcome outcomes[VARY_PIECE];
};

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

/* What the variation of one design came to. */
static batten_status take(sweep_design *design, batten_hull *variant,
                          const batten_vary_outcome *outcome)
{
	batten_hull_destroy(design->varied);
	design->varied = variant;
	if (outcome->status == BATTEN_MEMORY || outcome->status == BATTEN_INTERNAL)
		return outcome->status;
	if (outcome->status != BATTEN_OK)
		sweep_design_fail(design, SWEEP_VARY_FAILED, outcome->reason);
	return BATTEN_OK;
}

/* The first step: all from the parent, in one call. */
static batten_status vary_parent(batten_context *context, const sweep_block *block,
                                 struct vary_piece *piece, size_t first, size_t count)
{
	const sweep_plan *plan = block->plan;
	const size_t parameters = plan->sampling.parameter_count;
	for (size_t i = 0; i < count; i++)
		bind(&plan->steps[0], block->parameters + (first + i) * parameters, &piece->bound[i],
		     &piece->options[i]);
	batten_status status = batten_hull_vary_batch(context, plan->parent, count, piece->options,
	                                              piece->variants, piece->outcomes);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		return status;
	status = BATTEN_OK;
	for (size_t i = 0; i < count; i++) {
		const batten_status taken = take(&block->designs[first + i], piece->variants[i],
		                                 &piece->outcomes[i]);
		status = status == BATTEN_OK ? taken : status;
	}
	return status;
}

/* A later step: each design from what the step before made of it. */
static batten_status vary_again(batten_context *context, const sweep_block *block,
                                const plan_step *step, size_t i, struct vary_piece *piece)
{
	sweep_design *design = &block->designs[i];
	if (!sweep_design_lives(design))
		return BATTEN_OK;
	bind(step, block->parameters + i * block->plan->sampling.parameter_count, &piece->bound[0],
	     &piece->options[0]);
	batten_hull *variant = NULL;
	(void)batten_hull_vary(context, design->varied, &piece->options[0], &variant,
	                       &piece->outcomes[0]);
	return take(design, variant, &piece->outcomes[0]);
}

static batten_status clone_parent(batten_context *context, const sweep_block *block, size_t first,
                                  size_t count)
{
	batten_status status = BATTEN_OK;
	for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
		status = batten_hull_clone(context, block->plan->parent, &block->designs[i].varied);
	return status;
}

static batten_status vary_piece(batten_context *context, void *user, size_t first, size_t count)
{
	const sweep_block *block = user;
	const sweep_plan *plan = block->plan;
	if (plan->step_count == 0)
		return clone_parent(context, block, first, count);
	struct vary_piece *piece = batten_allocate(context, 1, sizeof *piece);
	if (!piece)
		return BATTEN_MEMORY;
	batten_status status = vary_parent(context, block, piece, first, count);
	for (size_t s = 1; s < plan->step_count; s++)
		for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
			status = vary_again(context, block, &plan->steps[s], i, piece);
	batten_release(context, piece);
	return status;
}

batten_status sweep_stage_vary(sweep_machine *machine, sweep_block *block)
{
	return sweep_crew_run(&machine->crew, block->count, VARY_PIECE, vary_piece, block);
}
