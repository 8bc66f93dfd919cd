#include "batch/search_selftest.h"

#include "batch/search_reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STATIONS = 9, WATERLINES = 13, NODES = STATIONS * WATERLINES };

/* A small hull with all that a real one has: uneven spacing, a rising keel, a raked stem, offsets on
 * their bounds, noise. No library function takes part, so every machine gets the same numbers. */
typedef struct test_hull {
	double x[STATIONS], z[WATERLINES];
	double y[NODES], lower[NODES], upper[NODES];
	uint8_t nodes[NODES];
} test_hull;

static double noise_of(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (double)(*state >> 8) / (double)(1u << 24) - 0.5;
}

static void make_hull(test_hull *hull)
{
	uint32_t state = 20011u;
	for (int i = 0; i < STATIONS; i++)
		hull->x[i] = i < 3 ? 0.5 * i : i - 1.0;
	for (int k = 0; k < WATERLINES; k++)
		hull->z[k] = k < 5 ? 0.0625 * k : 0.25 + 0.125 * (k - 4);
	for (int k = 0; k < WATERLINES; k++)
		for (int i = 0; i < STATIONS; i++) {
			const int n = k * STATIONS + i;
			const double u = hull->x[i] / 7.0;
			const double v = hull->z[k] / 1.25;
			const bool outside = k + i < 3 || i > STATIONS - 3 + k / 4;
			const double form = 0.25 + 2.0 * u * (1.0 - u) * v * (2.0 - v);
			hull->nodes[n] = outside ? BATTEN_NODE_OUTSIDE : BATTEN_NODE_GIVEN;
			hull->y[n] = outside ? 0.0 : form + 0.02 * noise_of(&state);
			const double room = outside || n % 17 == 0 ? 0.0 : 0.015;
			hull->lower[n] = hull->y[n] - room;
			hull->upper[n] = hull->y[n] + room;
		}
}

static bool equal_bits(double a, double b)
{
	return memcmp(&a, &b, sizeof a) == 0;
}

/* Counts the numbers of one search that differ from the C path's, and how far the objective is off. */
static void compare(const double *y, const batten_search_result *found, const double *known_y,
                    const batten_search_result *known, batten_selftest *result, double *worst)
{
	for (int n = 0; n < NODES; n++)
		result->different += !equal_bits(y[n], known_y[n]);
	result->different += !equal_bits(found->objective_start, known->objective_start);
	result->different += !equal_bits(found->objective_end, known->objective_end);
	result->different += !equal_bits(found->last_step_m, known->last_step_m);
	result->different += found->iterations != known->iterations;
	result->different += found->probes != known->probes;
	result->compared += NODES + 5;
	const double off = fabs(found->objective_end - known->objective_end) / known->objective_end;
	if (!(off <= *worst))
		*worst = off;
}

static batten_status run_both(const search_selftest_sides *sides, const search_plan *plan,
                              const batten_search_problem *problems, size_t count, double *y,
                              batten_selftest *result)
{
	size_t which[BATCH_TEST_MOST];
	batten_search_result found[BATCH_TEST_MOST] = { 0 };
	for (size_t p = 0; p < count; p++)
		which[p] = p;
	const double begun = batten_wall_seconds();
	batten_status status = sides->run(sides->engine, plan, problems, which, count, y, found);
	result->run_s = batten_wall_seconds() - begun;
	double worst = 0.0;
	for (size_t p = 0; p < count && status == BATTEN_OK; p++) {
		double known_y[NODES];
		batten_search_result known = { 0 };
		status = sides->run_known(plan, problems, p, known_y, &known);
		if (status == BATTEN_OK)
			compare(y + p * NODES, &found[p], known_y, &known, result, &worst);
	}
	if (status == BATTEN_OK)
		batch_engine_compare(result, worst, result->precision == BATTEN_F64 ? 1e-6 : 1e-3,
		                     "the objective");
	return status;
}

batten_status search_selftest_compare(batten_context *context, const search_selftest_sides *sides,
                                      const batten_search_options *options, unsigned lanes,
                                      batten_selftest *result)
{
	test_hull hull;
	make_hull(&hull);
	const size_t count = batch_engine_test_count(lanes);
	/* The block search gives hats to the first of the weights. */
	batten_search_problem problems[BATCH_TEST_MOST];
	double penalties[BATCH_TEST_MOST];
	for (size_t p = 0; p < count; p++) {
		penalties[p] = ldexp(1.0, -(int)p % 8 - 6);
		problems[p] = (batten_search_problem){ .nodes = hull.nodes,
			                                   .start_m = hull.y,
			                                   .target_m = hull.y,
			                                   .lower_m = hull.lower,
			                                   .upper_m = hull.upper,
			                                   .w1 = 1.0,
			                                   .w2 = ldexp(1.0, (int)p % 20 - 3),
			                                   .half_beam_m = 0.75 };
	}
	const batten_grid grid = { STATIONS, WATERLINES, hull.x, hull.z };
	search_plan *plan = NULL;
	batten_status status = search_plan_create(context, &grid, count, problems, options, &plan);
	double *y = batten_allocate(context, count, NODES * sizeof *y);
	if (status == BATTEN_OK && !y)
		status = BATTEN_MEMORY;
	if (status == BATTEN_OK && options->interior_penalty)
		plan->penalties = penalties;
	if (status == BATTEN_OK)
		status = run_both(sides, plan, problems, count, y, result);
	search_plan_destroy(plan);
	batten_release(context, y);
	return status;
}

static batten_status run_multilevel(void *engine, const search_plan *plan,
                                    const batten_search_problem *problems, const size_t *which,
                                    size_t count, double *y_m, batten_search_result *results)
{
	return search_engine_run(engine, plan, problems, which, count, y_m, results);
}

static batten_status run_known(const search_plan *plan, const batten_search_problem *problems,
                               size_t which, double *y_m, batten_search_result *result)
{
	search_reference reference = { 0 };
	const batten_status status = search_reference_create(plan, &reference);
	if (status == BATTEN_OK)
		search_reference_run(&reference, problems, which, y_m, result);
	search_reference_release(&reference);
	return status;
}

batten_status search_selftest_run(search_engine *engine, batten_selftest *result)
{
	const search_shape *shape = search_engine_shape(engine);
	const search_selftest_sides sides = { engine, run_multilevel, run_known };
	batten_search_options options;
	batten_search_options_default(&options);
	options.precision = shape->precision;
	options.fairness = search_fairness_of(shape->fairness);
	options.algorithm = shape->textbook ? BATTEN_ALGORITHM_TEXTBOOK : BATTEN_ALGORITHM_MULTILEVEL;
	/* These take hundreds of sweeps to what the others end with. */
	if (shape->textbook || shape->fairness == GRID_VARIATION)
		options.last_step = shape->textbook && shape->fairness == GRID_VARIATION ? 5e-3 : 1e-3;
	options.interior_penalty = shape->penalised;
	if (shape->fairness != GRID_BENDING && shape->fairness != GRID_VARIATION)
		options.longitudinal_weight = 2.0;
	return search_selftest_compare(search_engine_base(engine)->context, &sides, &options,
	                               shape->lanes, result);
}
