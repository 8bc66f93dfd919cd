#include "sweep/block.h"

#include <stdio.h>

const char *sweep_status_word(sweep_status status)
{
	static const char *const words[] = {
#define SWEEP_STATUS_WORD(name, word) word,
		SWEEP_STATUS_LIST(SWEEP_STATUS_WORD)
#undef SWEEP_STATUS_WORD
	};
	return words[status];
}

batten_status sweep_block_create(const sweep_plan *plan, size_t capacity, sweep_block *out)
{
	batten_context *context = plan->context;
	sweep_block block = { .context = context, .plan = plan, .capacity = capacity };
	block.designs = batten_allocate(context, capacity, sizeof *block.designs);
	block.parameters = batten_allocate(context, capacity,
	                                   plan->sampling.parameter_count * sizeof(double));
	block.hydrostatics = batten_allocate(context, capacity,
	                                     plan->draft_count * sizeof *block.hydrostatics);
	if (!block.designs || !block.parameters || !block.hydrostatics) {
		sweep_block_destroy(&block);
		return BATTEN_MEMORY;
	}
	*out = block;
	return BATTEN_OK;
}

static void empty(sweep_block *block)
{
	for (size_t i = 0; i < block->count; i++) {
		sweep_design *design = &block->designs[i];
		batten_hull_destroy(design->varied);
		batten_hull_destroy(design->faired);
		fairing_box_release(block->context, &design->box);
		*design = (sweep_design){ 0 };
	}
	block->count = 0;
}

void sweep_block_destroy(sweep_block *block)
{
	if (!block->context)
		return;
	empty(block);
	batten_release(block->context, block->designs);
	batten_release(block->context, block->parameters);
	batten_release(block->context, block->hydrostatics);
	*block = (sweep_block){ 0 };
}

void sweep_block_begin(sweep_block *block, uint64_t first, size_t count)
{
	const size_t parameters = block->plan->sampling.parameter_count;
	empty(block);
	block->first = first;
	block->count = count;
	for (size_t i = 0; i < count; i++)
		sampling_values(&block->plan->sampling, first + i, block->parameters + i * parameters);
}

const batten_hull *sweep_design_hull(const sweep_design *design)
{
	return design->faired ? design->faired : design->varied;
}

void sweep_design_fail(sweep_design *design, sweep_status status, const char *reason)
{
	design->status = status;
	(void)snprintf(design->reason, sizeof design->reason, "%s", reason);
}

bool sweep_design_lives(const sweep_design *design)
{
	return design->status == SWEEP_DONE || design->status == SWEEP_NOT_CONVERGED;
}
