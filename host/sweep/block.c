#include "sweep/block.h"

#include <stdio.h>
#include <string.h>

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
	sweep_block block = { .context = context,
		                  .plan = plan,
		                  .capacity = capacity,
		                  .nodes_each = hull_node_count(plan->parent) };
	const size_t y_size = block.nodes_each * sizeof(double);
	block.designs = batten_allocate(context, capacity, sizeof *block.designs);
	block.parameters = batten_allocate(context, capacity,
	                                   plan->sampling.parameter_count * sizeof(double));
	block.hydrostatics = batten_allocate(context, capacity,
	                                     plan->draft_count * sizeof *block.hydrostatics);
	block.nodes = batten_allocate(context, capacity, block.nodes_each);
	block.varied_y_m = batten_allocate(context, capacity, y_size);
	block.faired_y_m = plan->fairs ? batten_allocate(context, capacity, y_size) : NULL;
	if (!block.designs || !block.parameters || !block.hydrostatics || !block.nodes ||
	    !block.varied_y_m || (plan->fairs && !block.faired_y_m)) {
		sweep_block_destroy(&block);
		return BATTEN_MEMORY;
	}
	*out = block;
	return BATTEN_OK;
}

static void empty(sweep_block *block)
{
	for (size_t i = 0; i < block->count; i++) {
		batten_hull_destroy(block->designs[i].form);
		block->designs[i] = (sweep_design){ 0 };
	}
	block->count = 0;
}

void sweep_block_destroy(sweep_block *block)
{
	if (!block->context)
		return;
	if (block->designs)
		empty(block);
	batten_release(block->context, block->designs);
	batten_release(block->context, block->parameters);
	batten_release(block->context, block->hydrostatics);
	batten_release(block->context, block->nodes);
	batten_release(block->context, block->varied_y_m);
	batten_release(block->context, block->faired_y_m);
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

static batten_hull hull_with(const sweep_block *block, batten_context *context, size_t i,
                             double *y_m)
{
	const sweep_design *design = &block->designs[i];
	batten_hull hull = design->form ? *design->form : *block->plan->parent;
	hull.context = context;
	hull.y_m = y_m + i * block->nodes_each;
	hull.nodes = block->nodes + i * block->nodes_each;
	return hull;
}

batten_hull sweep_block_varied(const sweep_block *block, batten_context *context, size_t i)
{
	return hull_with(block, context, i, block->varied_y_m);
}

batten_hull sweep_block_final(const sweep_block *block, batten_context *context, size_t i)
{
	return hull_with(block, context, i, block->faired_y_m ? block->faired_y_m : block->varied_y_m);
}

static bool same_numbers(size_t count, const double *a, const double *b)
{
	return memcmp(a, b, count * sizeof *a) == 0;
}

/* Points off the grid and knuckles may move with the variant; where there are none, table and lengths
 * tell. */
static bool same_form(const batten_hull *a, const batten_hull *b)
{
	const size_t loose = a->end_count + a->profile_count + a->knuckle_count + b->end_count +
	                     b->profile_count + b->knuckle_count;
	return loose == 0 && a->lbp_m == b->lbp_m && a->draft_m == b->draft_m &&
	       same_numbers(a->station_count, a->x_m, b->x_m) &&
	       same_numbers(a->waterline_count, a->z_m, b->z_m);
}

void sweep_block_take(sweep_block *block, size_t i, batten_hull *variant)
{
	sweep_design *design = &block->designs[i];
	memcpy(block->varied_y_m + i * block->nodes_each, variant->y_m,
	       block->nodes_each * sizeof(double));
	memcpy(block->nodes + i * block->nodes_each, variant->nodes, block->nodes_each);
	batten_hull_destroy(design->form);
	design->form = same_form(variant, block->plan->parent) ? NULL : variant;
	if (!design->form)
		batten_hull_destroy(variant);
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
