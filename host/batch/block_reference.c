#include "batch/block_reference.h"

#include "batch/block_hats.h"
#include "batch/search_pack.h"
#include "reference/block_search.h"

batten_status block_reference_create(const search_plan *plan, block_reference *out)
{
	const size_t size = search_scalar_size(plan);
	const block_lines_shape shape = block_lines_of(plan);
	const size_t nodes = shape.lines * shape.length;
	block_reference search = { .plan = plan };
	search.stencils = batten_allocate(plan->context, block_stencil_count(plan), size);
	search.input = batten_allocate(plan->context, nodes, BLOCK_INPUT_COUNT * size);
	search.scratch = batten_allocate(
		plan->context, REFERENCE_BLOCK_SCRATCH(shape.lines, shape.length, block_hat_count(plan)),
		size);
	batten_status status = search.stencils && search.input && search.scratch
	                           ? block_pack_stencils(plan, search.stencils)
	                           : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		*out = search;
	else
		block_reference_release(&search);
	return status;
}

void block_reference_release(block_reference *search)
{
	if (!search->plan)
		return;
	void *memory[] = { search->stencils, search->input, search->scratch };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(search->plan->context, memory[i]);
	*search = (block_reference){ 0 };
}

void block_reference_run(block_reference *search, const batten_search_problem *problem, double *y_m,
                         batten_search_result *result)
{
	const search_plan *plan = search->plan;
	const block_lines_shape shape = block_lines_of(plan);
	const block_course course = block_course_of(plan, problem);
	const reference_block_search shared = {
		.lines = (int)shape.lines,
		.length = (int)shape.length,
		.hats = (int)course.hats,
		.rounds = (int)course.rounds,
		.iteration_limit = (int)plan->options.iteration_limit,
		.analytic = plan->options.analytic_slopes,
	};
	union {
		double f64[BLOCK_SETTING_COUNT];
		float f32[BLOCK_SETTING_COUNT];
	} settings;
	union {
		double f64[BLOCK_OUTCOME_COUNT];
		float f32[BLOCK_OUTCOME_COUNT];
	} outcome;
	block_pack(plan, problem, search->input, &settings);
	if (plan->options.precision == BATTEN_F64)
		reference_block_search_f64(&shared, search->stencils, search->input, settings.f64,
		                           outcome.f64, search->scratch);
	else
		reference_block_search_f32(&shared, search->stencils, search->input, settings.f32,
		                           outcome.f32, search->scratch);
	block_unpack(plan, problem, search->input, &outcome, y_m, result);
}
