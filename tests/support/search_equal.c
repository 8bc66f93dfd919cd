#include "support/search_equal.h"

#include "support/kernel_compile.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

void search_equal_problems(const search_case *c, batten_search_problem problems[EQUAL_COUNT])
{
	for (int p = 0; p < EQUAL_COUNT; p++)
		problems[p] = search_case_problem(c, 1.0, pow(10.0, 1.0 + 0.3 * p));
}

void search_equal_compare(const search_case *c, const double *y,
                          const batten_search_result *results, const double *known_y,
                          const batten_search_result *known)
{
	for (size_t p = 0; p < EQUAL_COUNT; p++) {
		assert_memory_equal(&results[p].objective_start, &known[p].objective_start, sizeof(double));
		assert_memory_equal(&results[p].objective_end, &known[p].objective_end, sizeof(double));
		assert_memory_equal(&results[p].last_step_m, &known[p].last_step_m, sizeof(double));
		assert_int_equal(results[p].iterations, known[p].iterations);
		assert_int_equal(results[p].end, known[p].end);
	}
	assert_memory_equal(y, known_y, EQUAL_COUNT * c->nodes * sizeof *y);
}

/* The textbook search takes thousands of sweeps to its last step, the variation of curvature hundreds of
 * iterations: some will do. */
static void set_options(const search_shape *shape, batten_search_options *options)
{
	options->algorithm = shape->textbook ? BATTEN_ALGORITHM_TEXTBOOK : BATTEN_ALGORITHM_MULTILEVEL;
	if (shape->textbook)
		options->iteration_limit = 8;
	else if (shape->fairness == GRID_VARIATION)
		options->iteration_limit = 16;
	options->fairness = search_fairness_of(shape->fairness);
	if (shape->fairness != GRID_BENDING && shape->fairness != GRID_VARIATION)
		options->longitudinal_weight = 3.0;
}

static void run_engine(const search_case *c, const search_shape *shape,
                       const batten_search_problem *problems, double *y,
                       batten_search_result *results)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.precision = shape->precision;
	set_options(shape, &options);
	search_plan *plan = NULL;
	search_engine *engine = NULL;
	size_t which[EQUAL_COUNT];
	for (size_t p = 0; p < EQUAL_COUNT; p++)
		which[p] = p;
	assert_int_equal(
		search_plan_create(c->context, &c->grid, EQUAL_COUNT, problems, &options, &plan),
		BATTEN_OK);
	if (search_engine_open(c->context, shape, &engine, NULL) != BATTEN_OK ||
	    search_engine_run(engine, plan, problems, which, EQUAL_COUNT, y, results) != BATTEN_OK)
		fail_msg("%s", batten_context_error(c->context));
	assert_true(search_engine_is_strict(engine));
	search_plan_destroy(plan);
}

static double *room_for_all(const search_case *c)
{
	double *numbers = calloc(EQUAL_COUNT * c->nodes, sizeof *numbers);
	assert_non_null(numbers);
	return numbers;
}

void search_equal_check(const search_case *c, const search_shape *shape)
{
	kernels_unoptimised(shape->work_group > 1);
	batten_search_problem problems[EQUAL_COUNT];
	batten_search_result results[EQUAL_COUNT];
	batten_search_result known[EQUAL_COUNT];
	double *y = room_for_all(c);
	double *known_y = room_for_all(c);
	search_equal_problems(c, problems);
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.precision = shape->precision;
	set_options(shape, &options);
	const batten_status status = batten_search_batch(c->context, &c->grid, EQUAL_COUNT, problems,
	                                                 &options, known_y, known, NULL);
	assert_true(status == BATTEN_OK || status == BATTEN_INCOMPLETE);
	run_engine(c, shape, problems, y, results);
	search_equal_compare(c, y, results, known_y, known);
	free(y);
	free(known_y);
}

void search_equal_penalised(const search_case *c, batten_precision precision, unsigned lanes,
                            unsigned work_group)
{
	kernels_unoptimised(work_group > 1);
	batten_search_problem problems[EQUAL_COUNT];
	batten_search_result results[EQUAL_COUNT], known[EQUAL_COUNT];
	double *y = room_for_all(c);
	double *known_y = room_for_all(c);
	search_equal_problems(c, problems);
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.precision = precision;
	options.interior_penalty = true;
	assert_int_equal(batten_search_batch(c->context, &c->grid, EQUAL_COUNT, problems, &options,
	                                     known_y, known, NULL),
	                 BATTEN_OK);
	batten_run run;
	options.device = 0;
	options.lanes = lanes;
	options.work_group = work_group;
	assert_int_equal(batten_search_batch(c->context, &c->grid, EQUAL_COUNT, problems, &options, y,
	                                     results, &run),
	                 BATTEN_OK);
	assert_true(run.strict);
	for (size_t p = 0; p < EQUAL_COUNT; p++)
		assert_true(results[p].probes == known[p].probes);
	search_equal_compare(c, y, results, known_y, known);
	free(y);
	free(known_y);
}
