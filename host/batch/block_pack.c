#include "batch/block_pack.h"

#include "batch/block_hats.h"
#include "batch/search_pack.h"
#include "batch/search_result.h"

#include <math.h>
#include <string.h>

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

/* Values to every `step`th number from `at` on. */
static void put_apart(const search_plan *plan, void *numbers, size_t at, size_t step,
                      const double *values, size_t count)
{
	if (plan->options.precision == BATTEN_F64)
		for (size_t n = 0; n < count; n++)
			((double *)numbers)[at + n * step] = values[n];
	else
		for (size_t n = 0; n < count; n++)
			((float *)numbers)[at + n * step] = (float)values[n];
}

size_t block_stencil_count(const search_plan *plan)
{
	return (plan->station_count + plan->waterline_count) * STENCIL_SIZE +
	       block_lines_of(plan).length * BLOCK_HAT_SIZE;
}

batten_status block_pack_stencils(const search_plan *plan, void *stencils)
{
	const block_lines_shape shape = block_lines_of(plan);
	const bool along_x = shape.along_x;
	double *hats = batten_allocate(plan->context, shape.length, BLOCK_HAT_SIZE * sizeof *hats);
	if (!hats)
		return BATTEN_MEMORY;
	const size_t x = plan->station_count * STENCIL_SIZE;
	const size_t z = plan->waterline_count * STENCIL_SIZE;
	put_apart(plan, stencils, along_x ? z : 0, 1, plan->stencil_x, x);
	put_apart(plan, stencils, along_x ? 0 : x, 1, plan->stencil_z, z);
	block_hat_values(plan, hats);
	put_apart(plan, stencils, x + z, 1, hats, shape.length * BLOCK_HAT_SIZE);
	batten_release(plan->context, hats);
	return BATTEN_OK;
}

/* Numbers of neighbouring nodes of a waterline, in the order of BLOCK_INPUT_; so many at a time. */
enum { TILE = 64 };
typedef double block_tile[BLOCK_INPUT_COUNT][TILE];

/* Whether nodes i to i + count of waterline k and their eight neighbours are all on the hull, as 1 or 0: only
 * there has the energy a term. */
static void mark_terms(const search_plan *plan, const batten_search_problem *problem, size_t i,
                       size_t k, size_t count, uint8_t *restrict has)
{
	const size_t row = plan->station_count;
	memset(has, 0, count);
	if (k == 0 || k + 1 == plan->waterline_count)
		return;
	const size_t first = i == 0 ? 1 : i;
	const size_t end = i + count == row ? row - 1 : i + count;
	memset(has + (first - i), 1, end - first);
	if (!problem->nodes)
		return;
	for (size_t b = k - 1; b <= k + 1; b++) {
		const uint8_t *node = problem->nodes + b * row;
		for (size_t c = first; c < end; c++)
			has[c - i] &= (uint8_t)((node[c - 1] != BATTEN_NODE_OUTSIDE) &
			                        (node[c] != BATTEN_NODE_OUTSIDE) &
			                        (node[c + 1] != BATTEN_NODE_OUTSIDE));
	}
}

/* Those of nodes i to i + count of waterline k; nodes outside the hull are all 0. */
static void fill_tile(const search_plan *plan, const batten_search_problem *problem, size_t i,
                      size_t k, size_t count, block_tile tile)
{
	const double h2 = problem->half_beam_m * problem->half_beam_m;
	const size_t at = k * plan->station_count + i;
	const double *lower = problem->lower_m + at;
	const double *upper = problem->upper_m + at;
	const double *start = problem->start_m + at;
	double weight[TILE];
	uint8_t has[TILE];
	mark_terms(plan, problem, i, k, count, has);
	for (size_t j = 0; j < count; j++)
		weight[j] = problem->closeness_weight ? problem->closeness_weight[at + j] : 1.0;
	memcpy(tile[BLOCK_INPUT_LOWER], lower, count * sizeof *lower);
	memcpy(tile[BLOCK_INPUT_UPPER], upper, count * sizeof *upper);
	memcpy(tile[BLOCK_INPUT_TARGET], problem->target_m + at, count * sizeof(double));
	for (size_t j = 0; j < count; j++) {
		const double cell = plan->cell_x[i + j] * plan->cell_z[k];
		const double least = start[j] < lower[j] ? lower[j] : start[j];
		tile[BLOCK_INPUT_START][j] = least > upper[j] ? upper[j] : least;
		tile[BLOCK_INPUT_BEND][j] = has[j] ? problem->w1 * cell : 0.0;
		tile[BLOCK_INPUT_CLOSE][j] = problem->w2 * weight[j] * cell / (h2 * h2);
	}
	for (size_t j = 0; problem->nodes && j < count; j++)
		if (problem->nodes[at + j] == BATTEN_NODE_OUTSIDE)
			for (size_t a = 0; a < BLOCK_INPUT_COUNT; a++)
				tile[a][j] = 0.0;
}

/* Where node i of waterline k lies, the next node of the waterline `step` further on. */
static size_t place_of(block_lines_shape shape, size_t i, size_t k, size_t *step)
{
	*step = shape.along_x ? 1 : shape.length;
	return shape.along_x ? k * shape.length + i : i * shape.length + k;
}

void block_pack(const search_plan *plan, const batten_search_problem *problem, void *input,
                void *settings)
{
	const block_lines_shape shape = block_lines_of(plan);
	const size_t nodes = shape.lines * shape.length;
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i += TILE) {
			const size_t left = plan->station_count - i;
			const size_t count = left < TILE ? left : TILE;
			block_tile tile;
			size_t step = 0;
			const size_t place = place_of(shape, i, k, &step);
			fill_tile(plan, problem, i, k, count, tile);
			for (size_t a = 0; a < BLOCK_INPUT_COUNT; a++)
				put_apart(plan, input, a * nodes + place, step, tile[a], count);
		}
	const double chosen[BLOCK_SETTING_COUNT] = {
		[BLOCK_SETTING_LONGEST] = 4.0 * plan->options.first_step * problem->half_beam_m,
		[BLOCK_SETTING_LAST_STEP] = plan->options.last_step * problem->half_beam_m,
		[BLOCK_SETTING_CURVATURE] = 1.0 / problem->half_beam_m,
	};
	put_apart(plan, settings, 0, 1, chosen, BLOCK_SETTING_COUNT);
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
	if (!problem->nodes)
		return (plan->station_count - 2) * (plan->waterline_count - 2);
	size_t terms = 0;
	uint8_t has[TILE];
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i += TILE) {
			const size_t left = plan->station_count - i;
			const size_t count = left < TILE ? left : TILE;
			mark_terms(plan, problem, i, k, count, has);
			for (size_t j = 0; j < count; j++)
				terms += has[j];
		}
	return terms;
}

void block_unpack(const search_plan *plan, const batten_search_problem *problem, const void *input,
                  const void *outcome, double *y_m, batten_search_result *result)
{
	const block_lines_shape shape = block_lines_of(plan);
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i++) {
			const size_t node = k * plan->station_count + i;
			size_t step = 0;
			const size_t place = BLOCK_INPUT_START * shape.lines * shape.length +
			                     place_of(shape, i, k, &step);
			y_m[node] = search_end_of_node(plan, problem, node, get(plan, input, place));
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
