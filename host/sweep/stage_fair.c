/* Variants -> fair hulls, by the search over their offsets (thesis 7.1-7.2). */
#include "fairing/box.h"
#include "sweep/stages.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Boxes a thread makes at a time; and how many designs must share a table for one launch of theirs:
 * fewer are searched one by one by the plain C path, which gives the same numbers. */
enum { BOX_PIECE = 16, GROUP_LEAST = 4 };

/* The searches of a block, designs of one table one after the other. */
struct searches {
	sweep_block *block;
	size_t *order;
	batten_search_problem *problems; /* in that order, as what follows */
	batten_search_result *results;
	double *y_m, *lower_m, *upper_m, *closeness_weight;
	size_t alone_count; /* at the end of the order: designs whose table no or few others have */
};

/* ---- groups of one table ---- */

static const batten_hull *form_of(const sweep_block *block, size_t i)
{
	const sweep_design *design = &block->designs[i];
	return design->form ? design->form : block->plan->parent;
}

/* Whether one launch takes both: the same table and settings of the search. */
static bool go_together(const sweep_block *block, size_t i, size_t j)
{
	const plan_fairing_numbers *a = &block->designs[i].fairing;
	const plan_fairing_numbers *b = &block->designs[j].fairing;
	return a->first_step == b->first_step && a->last_step == b->last_step &&
	       a->iteration_limit == b->iteration_limit && a->longitudinal == b->longitudinal &&
	       a->transverse == b->transverse && hull_same_table(form_of(block, i), form_of(block, j));
}

/* Moves the designs of order[first..count) that go with the first to the front; returns the
 * end of them. */
static size_t gather(const struct searches *searches, size_t first, size_t count)
{
	const size_t model = searches->order[first];
	size_t end = first + 1;
	for (size_t i = first + 1; i < count; i++) {
		const size_t design = searches->order[i];
		if (!go_together(searches->block, model, design))
			continue;
		searches->order[i] = searches->order[end];
		searches->order[end++] = design;
	}
	return end;
}

/* ---- searches ---- */

/* Box and problem of one design, in its place. */
static batten_status prepare(batten_context *context, const struct searches *searches, size_t place)
{
	const sweep_block *block = searches->block;
	const plan_fairing *fairing = &block->plan->fairing;
	const size_t i = searches->order[place];
	sweep_design *design = &block->designs[i];
	const batten_hull hull = sweep_block_varied(block, context, i);
	const double half_beam = batten_hull_half_beam_m(&hull);
	const double distance = design->fairing.max_distance_m >= 0.0
	                            ? design->fairing.max_distance_m
	                            : design->fairing.max_distance_part * half_beam;
	const size_t at = place * block->nodes_each;
	fairing_box box = { .lower_m = searches->lower_m + at,
		                .upper_m = searches->upper_m + at,
		                .closeness_weight = searches->closeness_weight + at,
		                .half_beam_m = half_beam };
	const batten_fair_options options = plan_fairing_options(fairing, &design->fairing);
	uint8_t *locked = NULL;
	batten_status status = BATTEN_OK;
	if (options.lock_count > 0)
		status = fairing_locks_create(context, &hull, &options, &locked);
	if (status == BATTEN_OK)
		status = fairing_box_fill(context, &hull, &options, locked, distance, &box);
	batten_release(context, locked);
	searches->problems[place] = fairing_problem(&hull, &box, options.w1, options.w2);
	if (status == BATTEN_OK || status == BATTEN_MEMORY)
		return status;
	/* Bounds that exclude each other: the search refuses what is no hull. */
	sweep_design_fail(design, SWEEP_FAIR_FAILED, batten_context_error(context));
	searches->problems[place].half_beam_m = NAN;
	return BATTEN_OK;
}

static batten_status prepare_piece(batten_context *context, void *user, size_t first, size_t count)
{
	const struct searches *searches = user;
	batten_status status = BATTEN_OK;
	for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
		status = prepare(context, searches, i);
	return status;
}

static batten_status search(batten_context *context, const struct searches *searches, int device,
                            size_t first, size_t count, batten_run *run)
{
	const batten_hull *form = form_of(searches->block, searches->order[first]);
	const batten_grid grid = { form->station_count, form->waterline_count, form->x_m, form->z_m };
	const sweep_block *block = searches->block;
	const sweep_design *model = &block->designs[searches->order[first]];
	batten_search_options options =
		plan_fairing_options(&block->plan->fairing, &model->fairing).search;
	options.device = device;
	const batten_status status = batten_search_batch(
		context, &grid, count, searches->problems + first, &options,
		searches->y_m + first * searches->block->nodes_each, searches->results + first, run);
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

/* Puts designs of one table one after the other, groups that are large enough first, in the order they
 * are met; the others behind them, one by one. */
static void gather_groups(struct searches *searches, size_t count, size_t least)
{
	size_t first = 0;
	size_t alone = 0; /* at the end of the order */
	while (first + alone < count) {
		const size_t end = gather(searches, first, count - alone);
		const size_t size = end - first;
		if (size >= least) {
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
}

static batten_status run_groups(sweep_machine *machine, const struct searches *searches,
                                size_t count)
{
	const size_t gathered = count - searches->alone_count;
	batten_status status = BATTEN_OK;
	for (size_t first = 0, end = 0; first < gathered && status == BATTEN_OK; first = end) {
		for (end = first + 1; end < gathered; end++)
			if (!go_together(searches->block, searches->order[first], searches->order[end]))
				break;
		status = search(machine->context, searches, machine->device, first, end - first,
		                &machine->run);
	}
	return status;
}

/* The numbers of a design's fairing, a step that ends before it begins among them. */
static void bind(sweep_block *block, size_t i)
{
	const sweep_plan *plan = block->plan;
	sweep_design *design = &block->designs[i];
	plan_fairing_numbers *numbers = &design->fairing;
	*numbers = plan->fairing.fixed;
	plan_bind(&plan->fairing.swept, block->parameters + i * plan->sampling.parameter_count,
	          numbers);
	if (numbers->last_step < numbers->first_step)
		return;
	char reason[96];
	(void)snprintf(reason, sizeof reason, "last_step is %.6g, expected less than first_step, %.6g",
	               numbers->last_step, numbers->first_step);
	sweep_design_fail(design, SWEEP_FAIR_FAILED, reason);
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

static void judge(sweep_design *design)
{
	if (design->search.end != BATTEN_SEARCH_LIMIT)
		return;
	char reason[96];
	(void)snprintf(reason, sizeof reason, "the search met its limit of %u iterations",
	               design->search.iterations);
	sweep_design_fail(design, SWEEP_NOT_CONVERGED, reason);
}

static batten_status finish(batten_context *context, const struct searches *searches, size_t place)
{
	const sweep_block *block = searches->block;
	const size_t i = searches->order[place];
	sweep_design *design = &block->designs[i];
	const double *y = searches->y_m + place * block->nodes_each;
	design->search = searches->results[place];
	if (!sweep_design_lives(design))
		return BATTEN_OK;
	if (design->search.end == BATTEN_SEARCH_REFUSED) {
		sweep_design_fail(design, SWEEP_FAIR_FAILED, design->search.message);
		return BATTEN_OK;
	}
	batten_hull hull = sweep_block_final(block, context, i);
	bool unknown = false;
	for (size_t n = 0; n < block->nodes_each; n++) {
		hull.y_m[n] = hull.nodes[n] == BATTEN_NODE_OUTSIDE ? 0.0 : y[n];
		unknown = unknown || hull.nodes[n] == BATTEN_NODE_UNKNOWN;
	}
	judge(design);
	size_t filled = 0;
	return unknown ? hull_fill_unknown(&hull, &filled) : BATTEN_OK;
}

static batten_status run_searches(sweep_machine *machine, struct searches *searches, size_t count)
{
	batten_status status = sweep_crew_run(&machine->crew, count, BOX_PIECE, prepare_piece,
	                                      searches);
	if (status == BATTEN_OK)
		status = run_groups(machine, searches, count);
	if (status == BATTEN_OK && searches->alone_count > 0) {
		struct searches tail = *searches;
		const size_t first = count - searches->alone_count;
		tail.order += first;
		tail.problems += first;
		tail.results += first;
		tail.y_m += first * searches->block->nodes_each;
		status = sweep_crew_run(&machine->crew, searches->alone_count, 1, search_alone, &tail);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		status = finish(machine->context, searches, i);
	return status;
}

/* ---- one by one ---- */

/* What batten_hull_fair() does with a hull. */
static void take(sweep_block *block, size_t i, const batten_fairing *fairing)
{
	sweep_design *design = &block->designs[i];
	const batten_fairing_facts facts = batten_fairing_describe(fairing);
	const size_t rows = batten_fairing_row_count(fairing);
	memcpy(block->faired_y_m + i * block->nodes_each,
	       batten_hull_y_m(batten_fairing_faired(fairing)), block->nodes_each * sizeof(double));
	if (block->plan->fairing.options.method == BATTEN_METHOD_SEARCH) {
		design->search = *batten_fairing_result(fairing);
		design->fairing.w2_over_w1 = facts.w2 / facts.w1;
		judge(design);
		return;
	}
	design->search = (batten_search_result){ .iterations = rows > 0 ? (unsigned)rows - 1 : 0,
		                                     .objective_start = NAN,
		                                     .objective_end = NAN };
}

static batten_status fair_one(batten_context *context, sweep_block *block, size_t i)
{
	sweep_design *design = &block->designs[i];
	const batten_hull hull = sweep_block_varied(block, context, i);
	batten_fair_options options = plan_fairing_options(&block->plan->fairing, &design->fairing);
	batten_fairing *fairing = NULL;
	/* Each thread has a hull: none of them needs a device, and every one gives these bits. */
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.pass.device = BATTEN_DEVICE_REFERENCE;
	const batten_status status = batten_hull_fair(context, &hull, &options, &fairing);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE)
		take(block, i, fairing);
	batten_fairing_destroy(fairing);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE || status == BATTEN_MEMORY ||
	    status == BATTEN_INTERNAL)
		return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
	sweep_design_fail(design, SWEEP_FAIR_FAILED, batten_context_error(context));
	return BATTEN_OK;
}

static batten_status fair_piece(batten_context *context, void *user, size_t first, size_t count)
{
	sweep_block *block = user;
	batten_status status = BATTEN_OK;
	for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
		if (sweep_design_lives(&block->designs[i]))
			status = fair_one(context, block, i);
	return status;
}

/* Searches over offsets with known weights go to the device together; all else is fairing's own. */
static bool fits_batch(const plan_fairing *fairing)
{
	return fairing->options.method == BATTEN_METHOD_SEARCH && !fairing->options.smooth &&
	       fairing->options.variables == BATTEN_VARIABLES_OFFSETS && !fairing->weight_by_noise;
}

/* Arrays of numbers a node that the searches of a block take. */
enum { ROOM_ARRAYS = 4 };

static batten_status fair_batch(sweep_machine *machine, sweep_block *block)
{
	batten_context *context = machine->context;
	const size_t array = block->capacity * block->nodes_each;
	double *room = sweep_machine_room(machine, block, ROOM_ARRAYS);
	if (!room)
		return BATTEN_MEMORY;
	struct searches searches = { .block = block,
		                         .y_m = room,
		                         .lower_m = room + array,
		                         .upper_m = room + 2 * array,
		                         .closeness_weight = room + 3 * array };
	batten_status status = BATTEN_MEMORY;
	searches.order = batten_allocate(context, block->count, sizeof *searches.order);
	searches.problems = batten_allocate(context, block->count, sizeof *searches.problems);
	searches.results = batten_allocate(context, block->count, sizeof *searches.results);
	if (searches.order && searches.problems && searches.results) {
		const size_t count = list_living(block, searches.order);
		gather_groups(&searches, count, machine->device >= 0 ? 1 : GROUP_LEAST);
		status = run_searches(machine, &searches, count);
	}
	batten_release(context, searches.order);
	batten_release(context, searches.problems);
	batten_release(context, searches.results);
	return status;
}

batten_status sweep_stage_fair(sweep_machine *machine, sweep_block *block)
{
	for (size_t i = 0; i < block->count; i++)
		if (sweep_design_lives(&block->designs[i]))
			bind(block, i);
	return fits_batch(&block->plan->fairing)
	           ? fair_batch(machine, block)
	           : sweep_crew_run(&machine->crew, block->count, 1, fair_piece, block);
}
