#include "batch/block_pack.h"

#include "batch/block_hats.h"
#include "batch/number.h"
#include "batch/search_pack.h"
#include "batch/search_result.h"
#include "core/runs.h"

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

static void get_apart(const search_plan *plan, const void *numbers, size_t at, size_t step,
                      double *values, size_t count)
{
	if (plan->options.precision == BATTEN_F64)
		for (size_t n = 0; n < count; n++)
			values[n] = ((const double *)numbers)[at + n * step];
	else
		for (size_t n = 0; n < count; n++)
			values[n] = (double)((const float *)numbers)[at + n * step];
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

/* Numbers of neighbouring nodes, in the order of BLOCK_INPUT_; so many at a time. */
enum { CHUNK = 512 };
typedef double block_chunk[BLOCK_INPUT_COUNT][CHUNK];

/* Whether nodes first to first + count and their eight neighbours are all on the hull, as 1 or 0: only there
 * has the energy a term. The table is taken as one long row, then the ends of the waterlines are cleared. */
static void mark_terms(const search_plan *plan, const batten_search_problem *problem, size_t first,
                       size_t count, uint8_t *restrict has)
{
	const size_t row = plan->station_count, last = row * (plan->waterline_count - 1) - 1;
	const size_t begin = first > row + 1 ? first : row + 1;
	const size_t end = first + count < last ? first + count : last;
	memset(has, 0, count);
	if (begin >= end)
		return;
	memset(has + (begin - first), 1, end - begin);
	for (size_t b = 0; b < 3 && problem->nodes; b++) {
		const uint8_t *aft = problem->nodes + (begin - row + b * row - 1);
		for (size_t c = 0; c < end - begin; c++)
			has[begin - first + c] &= (uint8_t)((aft[c] != BATTEN_NODE_OUTSIDE) &
			                                    (aft[c + 1] != BATTEN_NODE_OUTSIDE) &
			                                    (aft[c + 2] != BATTEN_NODE_OUTSIDE));
	}
	for (size_t n = begin / row * row; n < end; n += row) {
		if (n >= first)
			has[n - first] = 0;
		if (n + row - 1 < first + count)
			has[n + row - 1 - first] = 0;
	}
}

INLINED void begin_each(size_t count, const double *restrict from, const double *restrict lower,
                        const double *restrict upper, double *restrict start)
{
	for (size_t n = 0; n < count; n++) {
		const double least = from[n] < lower[n] ? lower[n] : from[n];
		start[n] = least > upper[n] ? upper[n] : least;
	}
}

RUNS_FUNCTION(begin_nodes, begin_each,
              (size_t count, const double *from, const double *lower, const double *upper,
               double *start),
              (count, from, lower, upper, start))

/* weight may be NULL. */
INLINED void weigh_each(size_t count, const double *restrict cell, const uint8_t *restrict has,
                        const double *restrict weight, double w1, double w2, double h4,
                        double *restrict bend, double *restrict close)
{
	for (size_t n = 0; n < count; n++) {
		const double bends = w1 * cell[n];
		bend[n] = has[n] != 0 ? bends : 0.0;
	}
	for (size_t n = 0; n < count && !weight; n++)
		close[n] = w2 * cell[n] / h4;
	for (size_t n = 0; n < count && weight; n++)
		close[n] = w2 * weight[n] * cell[n] / h4;
}

RUNS_FUNCTION(weigh_nodes, weigh_each,
              (size_t count, const double *cell, const uint8_t *has, const double *weight,
               double w1, double w2, double h4, double *bend, double *close),
              (count, cell, has, weight, w1, w2, h4, bend, close))

INLINED void clear_each(size_t count, const uint8_t *restrict nodes, double *restrict values)
{
	for (size_t n = 0; n < count; n++) {
		const double value = values[n];
		values[n] = nodes[n] == BATTEN_NODE_OUTSIDE ? 0.0 : value;
	}
}

RUNS_FUNCTION(clear_outside, clear_each, (size_t count, const uint8_t *nodes, double *values),
              (count, nodes, values))

/* Those of nodes first to first + count; nodes outside the hull are all 0. */
static void fill_chunk(const search_plan *plan, const batten_search_problem *problem, size_t first,
                       size_t count, block_chunk chunk)
{
	const double h2 = problem->half_beam_m * problem->half_beam_m;
	const double *weight = problem->closeness_weight ? problem->closeness_weight + first : NULL;
	double cell[CHUNK];
	uint8_t has[CHUNK];
	mark_terms(plan, problem, first, count, has);
	for (size_t n = 0, i = first % plan->station_count, k = first / plan->station_count; n < count;
	     n++) {
		cell[n] = plan->cell_x[i] * plan->cell_z[k];
		i = i + 1 < plan->station_count ? i + 1 : 0;
		k += i == 0;
	}
	memcpy(chunk[BLOCK_INPUT_LOWER], problem->lower_m + first, count * sizeof(double));
	memcpy(chunk[BLOCK_INPUT_UPPER], problem->upper_m + first, count * sizeof(double));
	memcpy(chunk[BLOCK_INPUT_TARGET], problem->target_m + first, count * sizeof(double));
	begin_nodes(count, problem->start_m + first, problem->lower_m + first, problem->upper_m + first,
	            chunk[BLOCK_INPUT_START]);
	weigh_nodes(count, cell, has, weight, problem->w1, problem->w2, h2 * h2,
	            chunk[BLOCK_INPUT_BEND], chunk[BLOCK_INPUT_CLOSE]);
	for (size_t a = 0; a < BLOCK_INPUT_COUNT && problem->nodes; a++)
		clear_outside(count, problem->nodes + first, chunk[a]);
}

/* Where node i of waterline k lies, the next node of the waterline `step` further on. */
static size_t place_of(block_lines_shape shape, size_t i, size_t k, size_t *step)
{
	*step = shape.along_x ? 1 : shape.length;
	return shape.along_x ? k * shape.length + i : i * shape.length + k;
}

static size_t lesser(size_t a, size_t b)
{
	return a < b ? a : b;
}

/* Waterline by waterline. */
static void put_chunk(const search_plan *plan, size_t first, size_t count, block_chunk chunk,
                      void *input)
{
	const block_lines_shape shape = block_lines_of(plan);
	const size_t row = plan->station_count;
	for (size_t n = first, here = 0; n < first + count; n += here) {
		size_t step = 0;
		const size_t place = place_of(shape, n % row, n / row, &step);
		here = lesser(row - n % row, first + count - n);
		for (size_t a = 0; a < BLOCK_INPUT_COUNT; a++)
			put_apart(plan, input, a * shape.lines * shape.length + place, step,
			          chunk[a] + (n - first), here);
	}
}

void block_pack(const search_plan *plan, const batten_search_problem *problem, void *input,
                void *settings)
{
	const size_t nodes = plan->station_count * plan->waterline_count;
	for (size_t first = 0; first < nodes; first += CHUNK) {
		const size_t count = lesser(nodes - first, CHUNK);
		block_chunk chunk;
		fill_chunk(plan, problem, first, count, chunk);
		put_chunk(plan, first, count, chunk, input);
	}
	const double chosen[BLOCK_SETTING_COUNT] = {
		[BLOCK_SETTING_LONGEST] = 4.0 * plan->options.first_step * problem->half_beam_m,
		[BLOCK_SETTING_LAST_STEP] = plan->options.last_step * problem->half_beam_m,
		[BLOCK_SETTING_CURVATURE] = 1.0 / problem->half_beam_m,
	};
	put_apart(plan, settings, 0, 1, chosen, BLOCK_SETTING_COUNT);
}

static size_t count_terms(const search_plan *plan, const batten_search_problem *problem)
{
	if (!problem->nodes)
		return (plan->station_count - 2) * (plan->waterline_count - 2);
	const size_t nodes = plan->station_count * plan->waterline_count;
	size_t terms = 0;
	uint8_t has[CHUNK];
	for (size_t first = 0; first < nodes; first += CHUNK) {
		const size_t count = lesser(nodes - first, CHUNK);
		mark_terms(plan, problem, first, count, has);
		for (size_t n = 0; n < count; n++)
			terms += has[n];
	}
	return terms;
}

void block_unpack(const search_plan *plan, const batten_search_problem *problem, const void *input,
                  const void *outcome, double *y_m, batten_search_result *result)
{
	const block_lines_shape shape = block_lines_of(plan);
	const size_t row = plan->station_count;
	for (size_t k = 0; k < plan->waterline_count; k++) {
		size_t step = 0;
		const size_t place = BLOCK_INPUT_START * shape.lines * shape.length +
		                     place_of(shape, 0, k, &step);
		get_apart(plan, input, place, step, y_m + k * row, row);
	}
	search_take_ends(plan, problem, y_m);
	double values[BLOCK_OUTCOME_COUNT];
	for (size_t v = 0; v < BLOCK_OUTCOME_COUNT; v++)
		values[v] = number_get(plan->options.precision, outcome, v);
	*result = search_result_of_block(values, BLOCK_PROBES_A_NODE, count_terms(plan, problem));
}
