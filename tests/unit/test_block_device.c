/* The block search on OpenCL against the C path, bit for bit: lanes, work-groups, both precisions, local
 * and global state, slopes probed and by formula, lines alone and coupled by hats; a batch of mixed
 * weights keeps its lanes busy. */
#include "support/kernel_compile.h"
#include "support/search_equal.h"

#include "batch/block_engine.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static void check_problems(const search_case *c, const batten_search_problem *problems,
                           batten_search_options options)
{
	batten_search_result results[EQUAL_COUNT], known[EQUAL_COUNT];
	double *y = calloc(2 * EQUAL_COUNT * c->nodes, sizeof *y);
	assert_non_null(y);
	double *known_y = y + EQUAL_COUNT * c->nodes;
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	batten_run run;
	if (batten_search_batch(c->context, &c->grid, EQUAL_COUNT, problems, &options, y, results,
	                        &run) != BATTEN_OK)
		fail_msg("%s", batten_context_error(c->context));
	assert_true(run.strict);
	options.device = BATTEN_DEVICE_REFERENCE;
	assert_int_equal(batten_search_batch(c->context, &c->grid, EQUAL_COUNT, problems, &options,
	                                     known_y, known, NULL),
	                 BATTEN_OK);
	search_equal_compare(c, y, results, known_y, known);
	free(y);
}

/* Cells of other sides, lengths in half-beams: hats couple the lines of the first weights, and lines that are
 * coupled less take rounds, as do hats where cells are nearly square or weights between. */
static void check_cells(search_case c, double apart, batten_search_options options)
{
	double x[64], z[64];
	batten_search_problem problems[EQUAL_COUNT];
	assert_true(c.grid.station_count <= 64 && c.grid.waterline_count <= 64);
	for (size_t i = 0; i < 64; i++) {
		x[i] = apart * c.half_beam_m * (double)i;
		z[i] = (0.09 * (double)i + 0.001 * (double)(i * i)) * c.half_beam_m;
	}
	c.grid.x_m = x;
	c.grid.z_m = z;
	for (int p = 0; p < EQUAL_COUNT; p++)
		problems[p] = search_case_problem(&c, 1.0, pow(10.0, 0.4 * p));
	check_problems(&c, problems, options);
}

static void check_shape(const search_case *c, batten_search_options options)
{
	batten_search_problem problems[EQUAL_COUNT];
	search_equal_problems(c, problems);
	check_problems(c, problems, options);
	check_cells(*c, 0.12, options);
	check_cells(*c, 0.36, options);
}

static void test_shapes_equal_the_c_path(void **state)
{
	(void)state;
	static const struct {
		batten_precision precision;
		unsigned lanes, work_group;
		bool analytic;
	} shapes[] = { { BATTEN_F64, 8, 1, false },  { BATTEN_F32, 16, 1, false },
		           { BATTEN_F64, 1, 64, false }, { BATTEN_F64, 4, 4, false },
		           { BATTEN_F32, 8, 24, false }, { BATTEN_F32, 2, 1, true } };
	search_case c = search_case_open("npl_parent", 0.01, true);
	for (size_t s = 0; s < sizeof shapes / sizeof shapes[0]; s++) {
		batten_search_options options;
		batten_search_options_default(&options);
		options.device = 0;
		options.precision = shapes[s].precision;
		options.lanes = shapes[s].lanes;
		options.work_group = shapes[s].work_group;
		options.analytic_slopes = shapes[s].analytic;
		kernels_unoptimised(shapes[s].work_group > 1);
		check_shape(&c, options);
	}
	kernels_unoptimised(false);
	search_case_close(&c);
}

/* A device that has memory of its own gets copies and gives copies back: the same ends. */
static void test_copies_equal_the_c_path(void **state)
{
	(void)state;
	search_case c = search_case_open("npl_parent", 0.01, true);
	batten_search_problem problems[EQUAL_COUNT];
	batten_search_result results[EQUAL_COUNT], known[EQUAL_COUNT];
	double *y = calloc(2 * EQUAL_COUNT * c.nodes, sizeof *y);
	assert_non_null(y);
	double *known_y = y + EQUAL_COUNT * c.nodes;
	size_t which[EQUAL_COUNT];
	for (size_t p = 0; p < EQUAL_COUNT; p++)
		which[p] = EQUAL_COUNT - 1 - p;
	search_equal_problems(&c, problems);
	batten_search_options options;
	batten_search_options_default(&options);
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	options.device = BATTEN_DEVICE_REFERENCE;
	options.lanes = 8;
	options.work_group = 1;
	assert_int_equal(batten_search_batch(c.context, &c.grid, EQUAL_COUNT, problems, &options,
	                                     known_y, known, NULL),
	                 BATTEN_OK);
	search_plan *plan = NULL;
	batch_engine *engine = NULL;
	batten_device device;
	assert_int_equal(search_plan_create(c.context, &c.grid, EQUAL_COUNT, problems, &options, &plan),
	                 BATTEN_OK);
	assert_int_equal(batten_device_describe(c.context, 0, &device), BATTEN_OK);
	if (block_engine_open(plan, 0, &device, &engine, NULL) != BATTEN_OK)
		fail_msg("%s", batten_context_error(c.context));
	engine->copies = true;
	assert_int_equal(block_engine_run(engine, plan, problems, which, EQUAL_COUNT, y, results, NULL),
	                 BATTEN_OK);
	engine->copies = false;
	search_equal_compare(&c, y, results, known_y, known);
	search_plan_destroy(plan);
	free(y);
	search_case_close(&c);
}

static void test_lanes_stay_busy(void **state)
{
	(void)state;
	enum { COUNT = 512 };
	search_case c = search_case_open("bsra_trawler", 0.01, true);
	batten_search_problem *problems = calloc(COUNT, sizeof *problems);
	batten_search_result *results = calloc(COUNT, sizeof *results);
	double *y = calloc(COUNT * c.nodes, sizeof *y);
	assert_true(problems && results && y);
	for (size_t p = 0; p < COUNT; p++)
		problems[p] = search_case_problem(&c, 1.0, pow(10.0, (double)(p * 7 % 50) / 10.0));
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = 0;
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	batten_run run;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, COUNT, problems, &options, y, results, &run),
		BATTEN_OK);
	assert_true(run.lane_use >= 0.9 && run.lane_use <= 1.0);
	free(problems);
	free(results);
	free(y);
	search_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_shapes_equal_the_c_path),
		cmocka_unit_test(test_copies_equal_the_c_path),
		cmocka_unit_test(test_lanes_stay_busy),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
