/* Whole net searches in many shapes of the kernel, lanes and work-items, local and global state, both
 * precisions, every fairness, by both searches, equal the C path bit for bit. */
#include "support/kernel_compile.h"
#include "support/net_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COUNT = 9 };

typedef struct net_shape {
	batten_precision precision;
	unsigned lanes, work_group;
	batten_fairness fairness;
	batten_search_algorithm algorithm; /* both that know the fairness, one after the other */
} net_shape;

static void run(const net_case *c, const net_shape *shape, int device, double *y,
                batten_search_result *results)
{
	batten_net_problem problems[COUNT];
	batten_net_options options;
	batten_run told;
	batten_net_options_default(&options);
	options.fairness = shape->fairness;
	options.search.device = device;
	options.search.precision = shape->precision;
	options.search.lanes = shape->lanes;
	options.search.work_group = shape->work_group;
	options.search.iteration_limit = 8;
	options.search.algorithm = shape->algorithm;
	for (int p = 0; p < COUNT; p++)
		problems[p] = net_case_problem(c, 1.0, pow(10.0, 1.0 + 0.5 * p));
	memset(results, 0, COUNT * sizeof *results);
	const batten_status status = batten_net_search_batch(c->context, COUNT, problems, &options, y,
	                                                     results, &told);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		fail_msg("%s", batten_context_error(c->context));
	assert_true(told.strict);
}

static void check_one(const net_case *c, net_shape shape)
{
	batten_search_result found[COUNT];
	batten_search_result known[COUNT];
	double *y = calloc(COUNT * c->poles, sizeof *y);
	double *known_y = calloc(COUNT * c->poles, sizeof *known_y);
	assert_true(y && known_y);
	run(c, &shape, 0, y, found);
	run(c, &shape, BATTEN_DEVICE_REFERENCE, known_y, known);
	assert_memory_equal(y, known_y, COUNT * c->poles * sizeof *y);
	for (int p = 0; p < COUNT; p++) {
		assert_memory_equal(&found[p].objective_start, &known[p].objective_start, sizeof(double));
		assert_memory_equal(&found[p].objective_end, &known[p].objective_end, sizeof(double));
		assert_memory_equal(&found[p].last_step_m, &known[p].last_step_m, sizeof(double));
		assert_int_equal(found[p].iterations, known[p].iterations);
		assert_int_equal(found[p].probes, known[p].probes);
		assert_int_equal(found[p].end, known[p].end);
		assert_true(found[p].objective_end < found[p].objective_start);
	}
	free(y);
	free(known_y);
}

static void check(const net_case *c, net_shape shape)
{
	shape.algorithm = BATTEN_ALGORITHM_MULTILEVEL;
	check_one(c, shape);
	shape.algorithm = BATTEN_ALGORITHM_BLOCK;
	if (shape.fairness == BATTEN_FAIRNESS_BENDING || shape.fairness == BATTEN_FAIRNESS_MEAN)
		check_one(c, shape);
}

static void test_lanes(void **state)
{
	(void)state;
	net_case c = net_case_npl(0.1);
	check(&c, (net_shape){ BATTEN_F64, 1, 1, BATTEN_FAIRNESS_BENDING, 0 });
	check(&c, (net_shape){ BATTEN_F64, 8, 1, BATTEN_FAIRNESS_BENDING, 0 });
	check(&c, (net_shape){ BATTEN_F32, 16, 1, BATTEN_FAIRNESS_BENDING, 0 });
	net_case_close(&c);
}

static void test_work_groups(void **state)
{
	(void)state;
	kernels_unoptimised(true);
	net_case c = net_case_wigley(0.1);
	check(&c, (net_shape){ BATTEN_F64, 1, 7, BATTEN_FAIRNESS_BENDING, 0 });
	check(&c, (net_shape){ BATTEN_F64, 1, 64, BATTEN_FAIRNESS_BENDING, 0 });
	check(&c, (net_shape){ BATTEN_F32, 4, 4, BATTEN_FAIRNESS_BENDING, 0 });
	check(&c, (net_shape){ BATTEN_F64, 4, 12, BATTEN_FAIRNESS_BENDING, 0 });
	net_case_close(&c);
}

static void test_fairness(void **state)
{
	(void)state;
	kernels_unoptimised(false);
	net_case c = net_case_wigley(0.1);
	for (int f = BATTEN_FAIRNESS_MEAN; f <= BATTEN_FAIRNESS_VARIATION; f++) {
		check(&c, (net_shape){ BATTEN_F64, 0, 0, (batten_fairness)f, 0 });
		check(&c, (net_shape){ BATTEN_F32, 0, 0, (batten_fairness)f, 0 });
	}
	net_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_lanes),
		cmocka_unit_test(test_work_groups),
		cmocka_unit_test(test_fairness),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
