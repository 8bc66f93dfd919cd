/* The block search over nets: ends at the minima that the multilevel search ends at, with bounds that hold poles and
 * without, poles that go with others, both fairnesses it knows; how searches end; on OpenCL, in lanes and in
 * work-groups, the bits of the C path, and whatever call fails. */
#include "support/cases.h"
#include "support/kernel_compile.h"
#include "support/net_case.h"

#include "device/device.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COUNT = 9 };

static batten_net_options options_of(batten_search_algorithm algorithm, batten_fairness fairness)
{
	batten_net_options options;
	batten_net_options_default(&options);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.search.algorithm = algorithm;
	options.fairness = fairness;
	return options;
}

static double *room_for(const net_case *c, size_t count)
{
	double *y = calloc(count * c->poles, sizeof *y);
	assert_non_null(y);
	return y;
}

static batten_search_result search(const net_case *c, const batten_net_problem *problem,
                                   const batten_net_options *options, double *y)
{
	batten_search_result result = { 0 };
	const batten_status status = batten_net_search_batch(c->context, 1, problem, options, y,
	                                                     &result, NULL);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		fail_msg("%s", batten_context_error(c->context));
	return result;
}

/* Both end at one minimum: within 1e-6 of each other, and of it by the certificate; every pole in its box. */
static void check_ends(const net_case *c, batten_net_options options, double w2)
{
	const batten_net_problem problem = net_case_problem(c, 1.0, w2);
	double *y = room_for(c, 1);
	batten_certificate found;
	batten_certificate known;
	options.search.algorithm = BATTEN_ALGORITHM_BLOCK;
	const batten_search_result result = search(c, &problem, &options, y);
	assert_int_equal(result.end, BATTEN_SEARCH_CONVERGED);
	assert_int_equal(result.algorithm, BATTEN_ALGORITHM_BLOCK);
	assert_int_equal(batten_net_certify_batch(c->context, 1, &problem, &options, y, &found),
	                 BATTEN_OK);
	for (size_t n = 0; n < c->poles; n++)
		assert_true(y[n] >= c->lower[n] && y[n] <= c->upper[n]);
	options.search.algorithm = BATTEN_ALGORITHM_MULTILEVEL;
	options.search.last_step = 2e-7;
	assert_int_equal(search(c, &problem, &options, y).algorithm, BATTEN_ALGORITHM_MULTILEVEL);
	assert_int_equal(batten_net_certify_batch(c->context, 1, &problem, &options, y, &known),
	                 BATTEN_OK);
	print_message("fairness %d w %g: %u iterations, gap %.1e, %.1e above the multilevel search\n",
	              (int)options.fairness, w2, result.iterations, found.gap_estimate,
	              found.objective / known.objective - 1.0);
	assert_true(fabs(result.objective_end / found.objective - 1.0) < 1e-11);
	assert_true(found.gap_estimate < 1e-8);
	assert_true(fabs(found.objective / known.objective - 1.0) < 1e-6);
}

static void test_ends(void **state)
{
	(void)state;
	for (int f = 0; f < CASES(2, 1); f++) {
		const batten_net_options options = options_of(BATTEN_ALGORITHM_BLOCK, (batten_fairness)f);
		net_case c = net_case_wigley(10.0);
		check_ends(&c, options, 10.0);
		check_ends(&c, options, 1e5);
		net_case_close(&c);
		c = net_case_wigley(0.01); /* bounds hold most poles */
		check_ends(&c, options, 10.0);
		check_ends(&c, options, 1e3);
		net_case_close(&c);
		c = net_case_npl(0.1);
		check_ends(&c, options, 100.0);
		net_case_close(&c);
	}
}

/* The deck goes with the row below it, one pole with one far from it. */
static void test_leaders(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	batten_net_options options = options_of(BATTEN_ALGORITHM_BLOCK, BATTEN_FAIRNESS_BENDING);
	const size_t columns = c.net.count_u;
	size_t *leader = calloc(c.poles, sizeof *leader);
	assert_non_null(leader);
	for (size_t n = 0; n < c.poles; n++)
		leader[n] = n >= c.poles - columns ? n - columns : n;
	leader[3 * columns + 2] = 6 * columns + 11;
	options.leader = leader;
	check_ends(&c, options, 100.0);
	free(leader);
	net_case_close(&c);
}

/* A net of more poles along v than along u: the same search with its directions turned. */
static void test_turned(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	const size_t columns = c.net.count_u, rows = c.net.count_v;
	double *poles = calloc(3 * c.poles, sizeof *poles);
	double *bounds = calloc(2 * c.poles, sizeof *bounds);
	double *y = room_for(&c, 2);
	batten_surface *turned = NULL;
	assert_true(poles && bounds);
	for (size_t n = 0; n < c.poles; n++) {
		const size_t to = n % columns * rows + n / columns;
		memcpy(poles + 3 * to, c.net.poles_m + 3 * n, 3 * sizeof *poles);
		bounds[to] = c.lower[n];
		bounds[c.poles + to] = c.upper[n];
	}
	const batten_surface_net net = { .order_u = c.net.order_v,
		                             .order_v = c.net.order_u,
		                             .count_u = rows,
		                             .count_v = columns,
		                             .poles_m = poles };
	assert_int_equal(batten_surface_create(c.context, &net, &turned), BATTEN_OK);
	const batten_net_options options = options_of(BATTEN_ALGORITHM_BLOCK, BATTEN_FAIRNESS_BENDING);
	batten_net_problem problem = net_case_problem(&c, 1.0, 100.0);
	const batten_search_result one = search(&c, &problem, &options, y);
	problem.start = turned;
	problem.lower_y_m = bounds;
	problem.upper_y_m = bounds + c.poles;
	const batten_search_result other = search(&c, &problem, &options, y + c.poles);
	assert_memory_equal(&one.objective_end, &other.objective_end, sizeof(double));
	for (size_t n = 0; n < c.poles; n++)
		assert_true(y[n] == y[c.poles + n % columns * rows + n / columns]);
	batten_surface_destroy(turned);
	free(poles);
	free(bounds);
	free(y);
	net_case_close(&c);
}

/* From its end a search goes nowhere; one iteration is a limit; w2 alone, or w1 alone, is a task too. */
static void test_how_it_ends(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	batten_net_options options = options_of(BATTEN_ALGORITHM_BLOCK, BATTEN_FAIRNESS_MEAN);
	batten_net_problem problem = net_case_problem(&c, 1.0, 100.0);
	double *y = room_for(&c, 1);
	options.search.iteration_limit = 1;
	assert_int_equal(search(&c, &problem, &options, y).end, BATTEN_SEARCH_LIMIT);
	options.search.iteration_limit = 400;
	problem.w1 = 0.0;
	const batten_search_result still = search(&c, &problem, &options, y);
	assert_int_equal(still.end, BATTEN_SEARCH_STATIONARY);
	assert_true(still.objective_end == 0.0);
	assert_memory_equal(y, c.target, c.poles * sizeof *y);
	problem.w1 = 1.0;
	problem.w2 = 0.0;
	const batten_search_result fair = search(&c, &problem, &options, y);
	assert_true(fair.objective_end < fair.objective_start);
	/* Nothing can move. */
	problem.lower_y_m = problem.upper_y_m = c.target;
	assert_int_equal(search(&c, &problem, &options, y).end, BATTEN_SEARCH_STATIONARY);
	assert_memory_equal(y, c.target, c.poles * sizeof *y);
	/* Not finite: refused, whatever is beside it. */
	batten_net_problem pair[2] = { net_case_problem(&c, 1.0, 100.0),
		                           net_case_problem(&c, NAN, 100.0) };
	batten_search_result results[2] = { 0 };
	double *both = room_for(&c, 2);
	assert_int_equal(batten_net_search_batch(c.context, 2, pair, &options, both, results, NULL),
	                 BATTEN_INCOMPLETE);
	assert_int_equal(results[0].end, BATTEN_SEARCH_CONVERGED);
	assert_int_equal(results[1].end, BATTEN_SEARCH_REFUSED);
	free(both);
	free(y);
	net_case_close(&c);
}

static void check_device(const net_case *c, batten_net_options options)
{
	batten_net_problem problems[COUNT];
	batten_search_result found[COUNT];
	batten_search_result known[COUNT];
	batten_run told;
	double *y = room_for(c, 2 * COUNT);
	double *known_y = y + COUNT * c->poles;
	for (int p = 0; p < COUNT; p++)
		problems[p] = net_case_problem(c, 1.0, pow(10.0, 1.0 + 0.5 * p));
	options.search.device = 0;
	if (batten_net_search_batch(c->context, COUNT, problems, &options, y, found, &told) !=
	    BATTEN_OK)
		fail_msg("%s", batten_context_error(c->context));
	assert_true(told.strict);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	assert_int_equal(
		batten_net_search_batch(c->context, COUNT, problems, &options, known_y, known, NULL),
		BATTEN_OK);
	assert_memory_equal(y, known_y, COUNT * c->poles * sizeof *y);
	for (int p = 0; p < COUNT; p++) {
		assert_memory_equal(&found[p].objective_start, &known[p].objective_start, sizeof(double));
		assert_memory_equal(&found[p].objective_end, &known[p].objective_end, sizeof(double));
		assert_memory_equal(&found[p].last_step_m, &known[p].last_step_m, sizeof(double));
		assert_int_equal(found[p].iterations, known[p].iterations);
		assert_int_equal(found[p].probes, known[p].probes);
		assert_int_equal(found[p].end, known[p].end);
	}
	free(y);
}

/* Weights from 10 to 1e5 in one batch, whole searches: lanes take one after the other. */
static void test_device(void **state)
{
	(void)state;
	static const struct {
		batten_precision precision;
		unsigned lanes, work_group;
		batten_fairness fairness;
	} shapes[] = { { BATTEN_F64, 8, 1, BATTEN_FAIRNESS_BENDING },
		           { BATTEN_F32, 2, 1, BATTEN_FAIRNESS_BENDING },
		           { BATTEN_F64, 1, 64, BATTEN_FAIRNESS_BENDING },
		           { BATTEN_F32, 64, 64, BATTEN_FAIRNESS_BENDING },
		           { BATTEN_F64, 4, 1, BATTEN_FAIRNESS_MEAN } };
	net_case c = net_case_wigley(0.05);
	size_t *leader = calloc(c.poles, sizeof *leader);
	assert_non_null(leader);
	for (size_t n = 0; n < c.poles; n++)
		leader[n] = n % c.net.count_u == 1 ? n + 1 : n;
	for (size_t s = 0; s < sizeof shapes / sizeof shapes[0]; s++) {
		batten_net_options options = options_of(BATTEN_ALGORITHM_BLOCK, shapes[s].fairness);
		options.search.precision = shapes[s].precision;
		options.search.lanes = shapes[s].lanes;
		options.search.work_group = shapes[s].work_group;
		options.leader = s % 2 ? NULL : leader;
		kernels_unoptimised(shapes[s].work_group > 1);
		check_device(&c, options);
	}
	kernels_unoptimised(false);
	free(leader);
	net_case_close(&c);
}

/* Whichever call of OpenCL fails, the searches are all done, with a warning where the device was given up; asked
 * for by its number, it fails with a name. */
static void test_failing_calls(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.05);
	batten_net_options options = options_of(BATTEN_ALGORITHM_BLOCK, BATTEN_FAIRNESS_BENDING);
	batten_net_problem problems[COUNT];
	batten_search_result results[COUNT];
	batten_run told;
	double *y = room_for(&c, 2 * COUNT);
	double *known_y = y + COUNT * c.poles;
	for (int p = 0; p < COUNT; p++)
		problems[p] = net_case_problem(&c, 1.0, pow(10.0, 1.0 + 0.5 * p));
	assert_int_equal(
		batten_net_search_batch(c.context, COUNT, problems, &options, known_y, results, NULL),
		BATTEN_OK);
	options.search.device = 0;
	assert_int_equal(
		batten_net_search_batch(c.context, COUNT, problems, &options, y, results, &told),
		BATTEN_OK);
	options.search.device = BATTEN_DEVICE_AUTO;
	int warned = 0;
	for (unsigned long k = 1; k <= 40; k++) {
		memset(y, 0, COUNT * c.poles * sizeof *y);
		(void)device_fail_call(k);
		const batten_status status = batten_net_search_batch(c.context, COUNT, problems, &options,
		                                                     y, results, &told);
		(void)device_fail_call(0);
		assert_int_equal(status, BATTEN_OK);
		assert_memory_equal(y, known_y, COUNT * c.poles * sizeof *y);
		warned += told.warning[0] != '\0';
	}
	assert_true(warned >= 20);
	options.search.device = 0;
	(void)device_fail_call(1);
	assert_int_equal(
		batten_net_search_batch(c.context, COUNT, problems, &options, y, results, &told),
		BATTEN_DEVICE);
	(void)device_fail_call(0);
	assert_true(batten_context_error(c.context)[0] != '\0');
	free(y);
	net_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_ends),   cmocka_unit_test(test_leaders),
		cmocka_unit_test(test_turned), cmocka_unit_test(test_how_it_ends),
		cmocka_unit_test(test_device), cmocka_unit_test(test_failing_calls),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
