#include "batch/search_pack.h"

#include "batch/number.h"
#include "batch/search_result.h"
#include "core/runs.h"

#include <math.h>
#include <string.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/grid_energy.h"

size_t search_scalar_size(const search_plan *plan)
{
	return plan->options.precision == BATTEN_F64 ? sizeof(double) : sizeof(float);
}

size_t search_stencil_count(const search_plan *plan)
{
	const size_t third = plan->third_x ? STENCIL_THIRD : 0;
	return (plan->station_count + plan->waterline_count) * (STENCIL_SIZE + third);
}

/* Returns the place behind. */
static size_t put_all(const search_plan *plan, void *numbers, size_t at, const double *values,
                      size_t count)
{
	for (size_t n = 0; n < count; n++)
		number_put(plan->options.precision, numbers, at + n, values[n]);
	return at + count;
}

void search_pack_stencils(const search_plan *plan, void *stencils)
{
	const size_t stations = plan->station_count;
	const size_t waterlines = plan->waterline_count;
	size_t at = put_all(plan, stencils, 0, plan->stencil_x, stations * STENCIL_SIZE);
	at = put_all(plan, stencils, at, plan->stencil_z, waterlines * STENCIL_SIZE);
	if (!plan->third_x)
		return;
	at = put_all(plan, stencils, at, plan->third_x, stations * STENCIL_THIRD);
	(void)put_all(plan, stencils, at, plan->third_z, waterlines * STENCIL_THIRD);
}

static bool on_hull(const batten_search_problem *problem, size_t node)
{
	return !problem->nodes || problem->nodes[node] != BATTEN_NODE_OUTSIDE;
}

/* Whether the two lines on each side of a node are there, and it is on the hull two steps away. */
static bool has_third_term(const search_plan *plan, const batten_search_problem *problem, size_t i,
                           size_t k)
{
	const size_t stations = plan->station_count;
	const size_t node = k * stations + i;
	if (i < 2 || k < 2 || i + 2 >= stations || k + 2 >= plan->waterline_count)
		return false;
	return on_hull(problem, node - 2) && on_hull(problem, node + 2) &&
	       on_hull(problem, node - 2 * stations) && on_hull(problem, node + 2 * stations);
}

/* Whether the node and its eight neighbours, and for the variation of curvature the four beyond them, are
 * all on the hull: only there has the energy a term. */
static bool has_term(const search_plan *plan, const batten_search_problem *problem, size_t i,
                     size_t k)
{
	const size_t stations = plan->station_count;
	if (i == 0 || k == 0 || i + 1 == stations || k + 1 == plan->waterline_count)
		return false;
	if (plan->fairness == GRID_VARIATION && !has_third_term(plan, problem, i, k))
		return false;
	if (!problem->nodes)
		return true;
	for (size_t b = k - 1; b <= k + 1; b++)
		for (size_t a = i - 1; a <= i + 1; a++)
			if (!on_hull(problem, b * stations + a))
				return false;
	return true;
}

INLINED double clamp(double value, double lower, double upper)
{
	return value < lower ? lower : value > upper ? upper : value;
}

/* Where a search starts at a node: in its box. */
static double start_of(const batten_search_problem *problem, size_t node)
{
	return clamp(problem->start_m[node], problem->lower_m[node], problem->upper_m[node]);
}

bool search_box_inside(batten_precision precision, double *lower, double *upper)
{
	double middle = *lower + 0.5 * (*upper - *lower);
	if (precision == BATTEN_F32) {
		const float down = (float)*lower;
		const float up = (float)*upper;
		*lower = (double)((double)down < *lower ? nextafterf(down, INFINITY) : down);
		*upper = (double)((double)up > *upper ? nextafterf(up, -INFINITY) : up);
		middle = (double)(float)middle;
	}
	return middle > *lower && middle < *upper;
}

static void pack_node(const search_plan *plan, const batten_search_problem *problem, size_t i,
                      size_t k, size_t lane, size_t lanes, void *arrays)
{
	const size_t node = k * plan->station_count + i;
	const size_t place = (k + 1) * (plan->station_count + 2) + (i + 1);
	const size_t array = plan->node_count * lanes;
	const size_t at = place * lanes + lane;
	const double cell = plan->cell_x[i] * plan->cell_z[k];
	const double h2 = problem->half_beam_m * problem->half_beam_m;
	const double weight = problem->closeness_weight ? problem->closeness_weight[node] : 1.0;
	const double start = start_of(problem, node);
	double lower = problem->lower_m[node];
	double upper = problem->upper_m[node];
	if (plan->penalties && !search_box_inside(plan->options.precision, &lower, &upper))
		lower = upper = start;
	number_put(plan->options.precision, arrays, SEARCH_ARRAY_Y * array + at, start);
	number_put(plan->options.precision, arrays, SEARCH_ARRAY_LOWER * array + at, lower);
	number_put(plan->options.precision, arrays, SEARCH_ARRAY_UPPER * array + at, upper);
	number_put(plan->options.precision, arrays, SEARCH_ARRAY_TARGET * array + at,
	           problem->target_m[node]);
	number_put(plan->options.precision, arrays, SEARCH_ARRAY_CLOSE * array + at,
	           problem->w2 * weight * cell / (h2 * h2));
	if (has_term(plan, problem, i, k))
		number_put(plan->options.precision, arrays, SEARCH_ARRAY_BEND * array + at,
		           problem->w1 * cell * (plan->fairness == GRID_VARIATION ? h2 : 1.0));
}

void search_pack(const search_plan *plan, const batten_search_problem *problems, size_t which,
                 size_t lane, size_t lanes, void *arrays, void *settings)
{
	const batten_search_problem *problem = &problems[which];
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i++)
			if (on_hull(problem, k * plan->station_count + i))
				pack_node(plan, problem, i, k, lane, lanes, arrays);
	number_put(plan->options.precision, settings, SEARCH_SETTING_FIRST_STEP * lanes + lane,
	           plan->options.first_step * problem->half_beam_m);
	number_put(plan->options.precision, settings, SEARCH_SETTING_LAST_STEP * lanes + lane,
	           plan->options.last_step * problem->half_beam_m);
	const double h2 = problem->half_beam_m * problem->half_beam_m;
	const double blunt = GAUSS_ROUNDING / h2;
	number_put(plan->options.precision, settings, SEARCH_SETTING_ALONG * lanes + lane,
	           sqrt(plan->options.longitudinal_weight));
	number_put(plan->options.precision, settings, SEARCH_SETTING_ACROSS * lanes + lane,
	           sqrt(plan->options.transverse_weight));
	number_put(plan->options.precision, settings, SEARCH_SETTING_BLUNT * lanes + lane,
	           blunt * blunt);
	const int narrow = plan->level_count - search_plan_wide_levels(plan);
	number_put(plan->options.precision, settings, SEARCH_SETTING_WIDE_PROBES * lanes + lane,
	           2.0 * (double)search_problem_directions(plan, problem, narrow, plan->level_count));
	number_put(plan->options.precision, settings, SEARCH_SETTING_PENALTY * lanes + lane,
	           plan->penalties ? plan->penalties[which] : 0.0);
}

INLINED void end_each(size_t count, bool rounds, const double *restrict start_m,
                      const double *restrict lower_m, const double *restrict upper_m,
                      double *restrict y_m)
{
	for (size_t n = 0; n < count; n++) {
		const double lower = lower_m[n], upper = upper_m[n], found = y_m[n];
		const double start = clamp(start_m[n], lower, upper);
		const double end = clamp(found, lower, upper);
		const double moved = rounds ? found - (double)(float)start : 1.0;
		y_m[n] = moved == 0.0 ? start : end;
	}
}

RUNS_FUNCTION(end_nodes, end_each,
              (size_t count, bool rounds, const double *start_m, const double *lower_m,
               const double *upper_m, double *y_m),
              (count, rounds, start_m, lower_m, upper_m, y_m))

INLINED void restore_each(size_t count, const uint8_t *restrict nodes,
                          const double *restrict start_m, double *restrict y_m)
{
	for (size_t n = 0; n < count; n++) {
		const double start = start_m[n], end = y_m[n];
		y_m[n] = nodes[n] == BATTEN_NODE_OUTSIDE ? start : end;
	}
}

RUNS_FUNCTION(restore_outside, restore_each,
              (size_t count, const uint8_t *nodes, const double *start_m, double *y_m),
              (count, nodes, start_m, y_m))

void search_take_ends(const search_plan *plan, const batten_search_problem *problem, double *y_m)
{
	const size_t nodes = plan->station_count * plan->waterline_count;
	end_nodes(nodes, plan->options.precision == BATTEN_F32, problem->start_m, problem->lower_m,
	          problem->upper_m, y_m);
	if (problem->nodes)
		restore_outside(nodes, problem->nodes, problem->start_m, y_m);
}

void search_unpack(const search_plan *plan, const batten_search_problem *problem, size_t lane,
                   size_t lanes, const void *y, const void *outcome, double *y_m,
                   batten_search_result *result)
{
	for (size_t k = 0; k < plan->waterline_count; k++)
		for (size_t i = 0; i < plan->station_count; i++) {
			const size_t node = k * plan->station_count + i;
			const size_t place = (k + 1) * (plan->station_count + 2) + (i + 1);
			y_m[node] = number_get(plan->options.precision, y, place * lanes + lane);
		}
	search_take_ends(plan, problem, y_m);
	double values[SEARCH_OUTCOME_COUNT];
	for (size_t v = 0; v < SEARCH_OUTCOME_COUNT; v++)
		values[v] = number_get(plan->options.precision, outcome, v * lanes + lane);
	*result = search_result_of(&plan->options, problem->half_beam_m, values);
}
