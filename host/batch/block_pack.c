#include "batch/block_pack.h"

#include "batch/search_pack.h"
#include "batch/search_result.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/block_probes.h"
#include "shared/dialect.h"

block_lines_shape block_lines_of(const search_plan *plan)
{
	block_lines_shape shape = { .along_x = plan->spacing_x < plan->spacing_z };
	shape.lines = shape.along_x ? plan->waterline_count : plan->station_count;
	shape.length = shape.along_x ? plan->station_count : plan->waterline_count;
	return shape;
}

static void put_all(const search_plan *plan, void *numbers, size_t at, const double *values,
                    size_t count)
{
	for (size_t n = 0; n < count; n++)
		if (plan->options.precision == BATTEN_F64)
			((double *)numbers)[at + n] = values[n];
		else
			((float *)numbers)[at + n] = (float)values[n];
}

size_t block_stencil_count(const search_plan *plan)
{
	return (plan->station_count + plan->waterline_count) * STENCIL_SIZE;
}

void block_pack_stencils(const search_plan *plan, void *stencils)
{
	const bool along_x = block_lines_of(plan).along_x;
	const size_t x = plan->station_count * STENCIL_SIZE;
	const size_t z = plan->waterline_count * STENCIL_SIZE;
	put_all(plan, stencils, along_x ? z : 0, plan->stencil_x, x);
	put_all(plan, stencils, along_x ? 0 : x, plan->stencil_z, z);
}

static bool on_hull(const batten_search_problem *problem, size_t node)
{
	return !problem->nodes || problem->nodes[node] != BATTEN_NODE_OUTSIDE;
}

/* One node's numbers, in the order of BLOCK_INPUT_. */
static void node_numbers(const search_plan *plan, const batten_search_problem *problem, size_t i,
                         size_t k, double numbers[BLOCK_INPUT_COUNT])
{
	const size_t node = k * plan->station_count + i;
	const double cell = plan->cell_x[i] * plan->cell_z[k];
	const double h2 = problem->half_beam_m * problem->half_beam_m;
	const double weight = problem->closeness_weight ? problem->closeness_weight[node] : 1.0;
	numbers[BLOCK_INPUT_LOWER] = problem->lower_m[node];
	numbers[BLOCK_INPUT_UPPER] = problem->upper_m[node];
	numbers[BLOCK_INPUT_START] = search_start_of(problem, node);
	numbers[BLOCK_INPUT_TARGET] = problem->target_m[node];
	numbers[BLOCK_INPUT_BEND] = search_has_term(plan, problem, i, k) ? problem->w1 * cell : 0.0;
	numbers[BLOCK_INPUT_CLOSE] = problem->w2 * weight * cell / (h2 * h2);
}

void block_pack(const search_plan *plan, const batten_search_problem *problem, void *input,
                void *settings)
{
	const block_lines_shape shape = block_lines_of(plan);
	const size_t nodes = shape.lines * shape.length;
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i++) {
			const size_t place = shape.along_x ? k * shape.length + i : i * shape.length + k;
			double numbers[BLOCK_INPUT_COUNT] = { 0.0 };
			if (on_hull(problem, k * plan->station_count + i))
				node_numbers(plan, problem, i, k, numbers);
			for (size_t a = 0; a < BLOCK_INPUT_COUNT; a++)
				put_all(plan, input, a * nodes + place, &numbers[a], 1);
		}
	const double chosen[BLOCK_SETTING_COUNT] = {
		[BLOCK_SETTING_LONGEST] = 4.0 * plan->options.first_step * problem->half_beam_m,
		[BLOCK_SETTING_LAST_STEP] = plan->options.last_step * problem->half_beam_m,
		[BLOCK_SETTING_CURVATURE] = 1.0 / problem->half_beam_m,
	};
	put_all(plan, settings, 0, chosen, BLOCK_SETTING_COUNT);
}

static double get(const search_plan *plan, const void *numbers, size_t at)
{
	if (plan->options.precision == BATTEN_F64)
		return ((const double *)numbers)[at];
	return (double)((const float *)numbers)[at];
}

static batten_search_end end_of(const double values[BLOCK_OUTCOME_COUNT])
{
	if (values[BLOCK_OUTCOME_CONVERGED] == 0.0)
		return BATTEN_SEARCH_LIMIT;
	return values[BLOCK_OUTCOME_MOVES] == 0.0 ? BATTEN_SEARCH_STATIONARY : BATTEN_SEARCH_CONVERGED;
}

static size_t count_terms(const search_plan *plan, const batten_search_problem *problem)
{
	size_t terms = 0;
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i++)
			terms += search_has_term(plan, problem, i, k);
	return terms;
}

void block_unpack(const search_plan *plan, const batten_search_problem *problem, const void *y,
                  const void *outcome, double *y_m, batten_search_result *result)
{
	const block_lines_shape shape = block_lines_of(plan);
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i++) {
			const size_t node = k * plan->station_count + i;
			const size_t place = shape.along_x ? k * shape.length + i : i * shape.length + k;
			y_m[node] = search_end_of_node(plan, problem, node, get(plan, y, place));
		}
	double values[BLOCK_OUTCOME_COUNT];
	for (size_t v = 0; v < BLOCK_OUTCOME_COUNT; v++)
		values[v] = get(plan, outcome, v);
	const double probes = values[BLOCK_OUTCOME_ITERATIONS] * BLOCK_PROBES_A_NODE +
	                      values[BLOCK_OUTCOME_TRIALS];
	*result = (batten_search_result){
		.end = end_of(values),
		.iterations = (unsigned)values[BLOCK_OUTCOME_ITERATIONS],
		.probes = (uint64_t)probes * count_terms(plan, problem),
		.objective_start = values[BLOCK_OUTCOME_START],
		.objective_end = values[BLOCK_OUTCOME_END],
		.last_step_m = values[BLOCK_OUTCOME_STEP],
	};
	if (!isfinite(result->objective_start) || !isfinite(result->objective_end))
		*result = search_result_refused("the objective is not finite");
}
