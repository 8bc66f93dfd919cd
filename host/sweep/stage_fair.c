/* Variants -> fair hulls, by the search over their offsets (thesis 7.1-7.2). */
#include "sweep/stages.h"

#include <stdio.h>
#include <string.h>

/* Boxes a thread makes at a time; and how many designs must share a table for one launch of theirs:
 * fewer are searched one by one by the plain C path, which gives the same numbers. */
enum { BOX_PIECE = 16, GROUP_LEAST = 4 };

/* The searches of a block. */
struct searches {
	sweep_block *block;
	size_t node_count;
	batten_search_options options;
	size_t *order;                   /* designs of a group one after the other */
	batten_search_problem *problems; /* in that order, as the two below */
	batten_search_result *results;
	double *y_m;
	size_t alone_count; /* at the end of the order: designs whose table no or few others have */
};

static batten_status prepare(batten_context *context, sweep_block *block, size_t i)
{
	const plan_fairing *fairing = &block->plan->fairing;
	sweep_design *design = &block->designs[i];
	design->fairing = fairing->fixed;
	plan_bind(&fairing->swept, block->parameters + i * block->plan->sampling.parameter_count,
	          &design->fairing);
	const double distance = design->fairing.max_distance_m >= 0.0
	                            ? design->fairing.max_distance_m
	                            : design->fairing.max_distance_part *
	                                  batten_hull_half_beam_m(design->varied);
	batten_fair_options options;
	batten_fair_options_default(&options);
	uint8_t *locked = NULL;
	batten_status status = batten_hull_clone(context, design->varied, &design->faired);
	if (status == BATTEN_OK)
		status = fairing_locks_create(context, design->varied, &options, &locked);
	if (status == BATTEN_OK)
		status = fairing_box_create(context, design->varied, &options, locked, distance,
		                            &design->box);
	batten_release(context, locked);
	if (status == BATTEN_MEMORY || status == BATTEN_OK)
		return status;
	sweep_design_fail(design, SWEEP_FAIR_FAILED, batten_context_error(context));
	return BATTEN_OK;
}

static batten_status prepare_piece(batten_context *context, void *user, size_t first, size_t count)
{
	sweep_block *block = user;
	batten_status status = BATTEN_OK;
	for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
		if (sweep_design_lives(&block->designs[i]))
			status = prepare(context, block, i);
	return status;
}

/* ---- groups of one table ---- */

static bool same_table(const batten_hull *a, const batten_hull *b)
{
	return a->station_count == b->station_count && a->waterline_count == b->waterline_count &&
	       memcmp(a->x_m, b->x_m, a->station_count * sizeof *a->x_m) == 0 &&
	       memcmp(a->z_m, b->z_m, a->waterline_count * sizeof *a->z_m) == 0;
}

/* Moves the designs of order[first..count) whose table is that of the first to the front; returns the
 * end of them. */
static size_t gather(const struct searches *searches, size_t first, size_t count)
{
	const sweep_design *designs = searches->block->designs;
	const batten_hull *model = designs[searches->order[first]].varied;
	size_t end = first + 1;
	for (size_t i = first + 1; i < count; i++) {
		const size_t design = searches->order[i];
		if (!same_table(model, designs[design].varied))
			continue;
		searches->order[i] = searches->order[end];
		searches->order[end++] = design;
	}
	return end;
}

static void set_problem(const struct searches *searches, size_t i)
{
	const sweep_design *design = &searches->block->designs[searches->order[i]];
	searches->problems[i] = (batten_search_problem){
		.nodes = design->varied->nodes,
		.start_m = design->varied->y_m,
		.target_m = design->varied->y_m,
		.lower_m = design->box.lower_m,
		.upper_m = design->box.upper_m,
		.closeness_weight = design->box.closeness_weight,
		.w1 = 1.0,
		.w2 = design->fairing.w2_over_w1,
		.half_beam_m = batten_hull_half_beam_m(design->varied),
	};
}

static batten_status search(batten_context *context, const struct searches *searches, int device,
                            size_t first, size_t count, batten_run *run)
{
	const batten_hull *hull = searches->block->designs[searches->order[first]].varied;
	const batten_grid grid = { hull->station_count, hull->waterline_count, hull->x_m, hull->z_m };
	batten_search_options options = searches->options;
	options.device = device;
	for (size_t i = first; i < first + count; i++)
		set_problem(searches, i);
	const batten_status status = batten_search_batch(
		context, &grid, count, searches->problems + first, &options,
		searches->y_m + first * searches->node_count, searches->results + first, run);
	return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
}

/* Designs that stand alone, one a thread at a time. */
static batten_status search_alone(batten_context *context, void *user, size_t first, size_t count)
{
	const struct searches *searches = user;
	batten_status status = BATTEN_OK;
	for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
		status = search(context, searches, BATTEN_DEVICE_REFERENCE, i, 1, NULL);
	return status;
}

/* Groups that are large enough first, in the order they are met; the others keep their places behind
 * them, are found again, and run one by one. */
static batten_status search_groups(sweep_machine *machine, struct searches *searches, size_t count)
{
	/* A device that was asked for by its number may differ from the C path. */
	const size_t least = machine->device >= 0 ? 1 : GROUP_LEAST;
	size_t first = 0;
	size_t alone = 0; /* at the end of the order */
	batten_status status = BATTEN_OK;
	while (first + alone < count && status == BATTEN_OK) {
		const size_t end = gather(searches, first, count - alone);
		const size_t size = end - first;
		if (size >= least) {
			status = search(machine->context, searches, machine->device, first, size,
			                &machine->run);
			first = end;
			continue;
		}
		for (size_t i = 0; i < size; i++) {
			const size_t from = end - 1 - i;
			const size_t to = count - 1 - alone;
			const size_t design = searches->order[from];
			searches->order[from] = searches->order[to];
			searches->order[to] = design;
			alone++;
		}
	}
	searches->alone_count = alone;
	return status;
}

static size_t list_living(const sweep_block *block, size_t *order)
{
	size_t count = 0;
	for (size_t i = 0; i < block->count; i++)
		if (sweep_design_lives(&block->designs[i]))
			order[count++] = i;
	return count;
}

/* ---- what came of it ---- */

static batten_status finish(const struct searches *searches, size_t i)
{
	sweep_design *design = &searches->block->designs[searches->order[i]];
	batten_hull *hull = design->faired;
	const double *y = searches->y_m + i * searches->node_count;
	design->search = searches->results[i];
	fairing_box_release(searches->block->context, &design->box);
	if (design->search.end == BATTEN_SEARCH_REFUSED) {
		sweep_design_fail(design, SWEEP_FAIR_FAILED, design->search.message);
		return BATTEN_OK;
	}
	for (size_t n = 0; n < searches->node_count; n++)
		if (hull->nodes[n] != BATTEN_NODE_OUTSIDE)
			hull->y_m[n] = y[n];
	if (design->search.end == BATTEN_SEARCH_LIMIT) {
		char reason[96];
		(void)snprintf(reason, sizeof reason, "the search met its limit of %u iterations",
		               design->search.iterations);
		sweep_design_fail(design, SWEEP_NOT_CONVERGED, reason);
	}
	size_t filled = 0;
	return hull_fill_unknown(hull, &filled);
}

static batten_status run_searches(sweep_machine *machine, struct searches *searches, size_t count)
{
	batten_status status = search_groups(machine, searches, count);
	if (status == BATTEN_OK && searches->alone_count > 0) {
		struct searches tail = *searches;
		const size_t first = count - searches->alone_count;
		tail.order += first;
		tail.problems += first;
		tail.results += first;
		tail.y_m += first * searches->node_count;
		status = sweep_crew_run(&machine->crew, searches->alone_count, 1, search_alone, &tail);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		status = finish(searches, i);
	return status;
}

batten_status sweep_stage_fair(sweep_machine *machine, sweep_block *block)
{
	batten_context *context = machine->context;
	batten_status status = sweep_crew_run(&machine->crew, block->count, BOX_PIECE, prepare_piece,
	                                      block);
	struct searches searches = { .block = block,
		                         .node_count = hull_node_count(block->plan->parent),
		                         .options = block->plan->fairing.search };
	searches.order = batten_allocate(context, block->count, sizeof *searches.order);
	searches.problems = batten_allocate(context, block->count, sizeof *searches.problems);
	searches.results = batten_allocate(context, block->count, sizeof *searches.results);
	searches.y_m = batten_allocate(context, block->count, searches.node_count * sizeof(double));
	if (!searches.order || !searches.problems || !searches.results || !searches.y_m)
		status = BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = run_searches(machine, &searches, list_living(block, searches.order));
	batten_release(context, searches.order);
	batten_release(context, searches.problems);
	batten_release(context, searches.results);
	batten_release(context, searches.y_m);
	return status;
}
