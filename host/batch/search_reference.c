#include "batch/search_reference.h"

#include "reference/multilevel.h"
#include "reference/textbook.h"

#include <string.h>

batten_status search_reference_create(const search_plan *plan, search_reference *out)
{
	const size_t size = search_scalar_size(plan);
	search_reference search = { .plan = plan };
	search.stencils = batten_allocate(plan->context, search_stencil_count(plan), size);
	search.arrays = batten_allocate(plan->context, plan->node_count, SEARCH_ARRAY_COUNT * size);
	search.scratch = batten_allocate(
		plan->context, SEARCH_STATE_NUMBERS(plan->node_count, plan->waterline_count, 1), size);
	if (!search.stencils || !search.arrays || !search.scratch) {
		search_reference_release(&search);
		return BATTEN_MEMORY;
	}
	search_pack_stencils(plan, search.stencils);
	*out = search;
	return BATTEN_OK;
}

void search_reference_release(search_reference *search)
{
	if (!search->plan)
		return;
	batten_release(search->plan->context, search->stencils);
	batten_release(search->plan->context, search->arrays);
	batten_release(search->plan->context, search->scratch);
	*search = (search_reference){ 0 };
}

void search_reference_run(search_reference *search, const batten_search_problem *problems,
                          size_t which, double *y_m, batten_search_result *result)
{
	const search_plan *plan = search->plan;
	const reference_multilevel shared = { .stations = (int)plan->station_count,
		                                  .waterlines = (int)plan->waterline_count,
		                                  .level_count = plan->level_count,
		                                  .iteration_limit = (int)plan->options.iteration_limit,
		                                  .fairness = plan->fairness,
		                                  .penalised = plan->penalties != NULL,
		                                  .levels = &plan->levels[0].width_x,
		                                  .centres = plan->centres };
	union {
		double f64[SEARCH_SETTING_COUNT];
		float f32[SEARCH_SETTING_COUNT];
	} settings;
	union {
		double f64[SEARCH_OUTCOME_COUNT];
		float f32[SEARCH_OUTCOME_COUNT];
	} outcome;
	memset(search->arrays, 0, plan->node_count * SEARCH_ARRAY_COUNT * search_scalar_size(plan));
	search_pack(plan, problems, which, 0, 1, search->arrays, &settings);
	const bool textbook = plan->options.algorithm == BATTEN_ALGORITHM_TEXTBOOK;
	const bool bending = plan->fairness == GRID_BENDING && !shared.penalised;
	if (plan->options.precision == BATTEN_F64)
		(textbook  ? reference_textbook_f64
		 : bending ? reference_multilevel_bending_f64
		           : reference_multilevel_f64)(&shared, search->stencils, search->arrays,
		                                       settings.f64, outcome.f64, search->scratch);
	else
		(textbook  ? reference_textbook_f32
		 : bending ? reference_multilevel_bending_f32
		           : reference_multilevel_f32)(&shared, search->stencils, search->arrays,
		                                       settings.f32, outcome.f32, search->scratch);
	search_unpack(plan, &problems[which], 0, 1, search->arrays, &outcome, y_m, result);
}
