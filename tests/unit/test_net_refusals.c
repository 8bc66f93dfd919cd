/* What batten_net_search_batch refuses, one by one, and that it releases all when memory is short. */
#include "support/failing_heap.h"
#include "support/net_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct refusal {
	net_case c;
	batten_net_problem problem;
	batten_net_options options;
	double *y;
} refusal;

static refusal open_refusal(void)
{
	refusal r = { .c = net_case_wigley(0.1) };
	r.problem = net_case_problem(&r.c, 1.0, 10.0);
	batten_net_options_default(&r.options);
	r.options.search.device = BATTEN_DEVICE_REFERENCE;
	r.options.search.iteration_limit = 1;
	r.y = calloc(2 * r.c.poles, sizeof *r.y);
	assert_non_null(r.y);
	return r;
}

static void close_refusal(refusal *r)
{
	free(r->y);
	net_case_close(&r->c);
}

/* The other search of the batch runs all the same; y of the refused one is left alone. */
static void expect_refused(refusal *r, const char *message)
{
	batten_search_result results[2] = { 0 };
	net_case good = net_case_wigley(0.1);
	const batten_net_problem both[2] = { r->problem, net_case_problem(&good, 1.0, 10.0) };
	r->y[0] = 12345.0;
	assert_int_equal(
		batten_net_search_batch(r->c.context, 2, both, &r->options, r->y, results, NULL),
		BATTEN_INCOMPLETE);
	assert_int_equal(results[0].end, BATTEN_SEARCH_REFUSED);
	assert_non_null(strstr(results[0].message, message));
	assert_true(r->y[0] == 12345.0);
	assert_int_equal(results[1].end, BATTEN_SEARCH_LIMIT);
	assert_true(results[1].objective_end < results[1].objective_start);
	net_case_close(&good);
}

static void test_refused_problems(void **state)
{
	(void)state;
	refusal r = open_refusal();
	const batten_net_problem sound = r.problem;
	r.problem.w1 = NAN;
	expect_refused(&r, "weights");
	r.problem.w1 = r.problem.w2 = 0.0;
	expect_refused(&r, "weights");
	r.problem = sound;
	r.problem.half_beam_m = 0.0;
	expect_refused(&r, "half-beam");
	r.problem = sound;
	r.problem.lower_y_m = NULL;
	expect_refused(&r, "no bounds");
	r.problem = sound;
	r.c.lower[17] = INFINITY;
	expect_refused(&r, "a lower bound");
	r.c.lower[17] = r.c.upper[17] + 1e-9;
	expect_refused(&r, "a lower bound");
	r.c.lower[17] = -1e10;
	expect_refused(&r, "a lower bound");
	r.c.lower[17] = r.c.target[17];
	r.c.upper[18] = NAN;
	expect_refused(&r, "a lower bound");
	r.c.upper[18] = r.c.target[18];
	r.problem.target_y_m = r.c.target;
	r.c.target[5] = NAN;
	expect_refused(&r, "a target");
	close_refusal(&r);
}

static void expect_usage(refusal *r, size_t count, const batten_net_problem *problems,
                         const char *message)
{
	batten_search_result results[2] = { 0 };
	assert_int_equal(
		batten_net_search_batch(r->c.context, count, problems, &r->options, r->y, results, NULL),
		BATTEN_USAGE);
	if (!strstr(batten_context_error(r->c.context), message))
		fail_msg("%s", batten_context_error(r->c.context));
}

static void test_options(void **state)
{
	(void)state;
	refusal r = open_refusal();
	const batten_net_options sound = r.options;
	r.options.struct_size--;
	expect_usage(&r, 1, &r.problem, "another version");
	r.options = sound;
	r.options.search.struct_size--;
	expect_usage(&r, 1, &r.problem, "another version");
	r.options = sound;
	r.options.fairness = (batten_fairness)4;
	expect_usage(&r, 1, &r.problem, "fairness 4");
	r.options = sound;
	r.options.gauss_points = 17;
	expect_usage(&r, 1, &r.problem, "17 Gauss points");
	r.options = sound;
	r.options.search.lanes = 3;
	expect_usage(&r, 1, &r.problem, "3 lanes");
	r.options = sound;
	r.options.search.algorithm = BATTEN_ALGORITHM_TEXTBOOK;
	expect_usage(&r, 1, &r.problem, "search algorithm textbook");
	r.options.search.algorithm = BATTEN_ALGORITHM_BLOCK;
	r.options.fairness = BATTEN_FAIRNESS_GAUSS;
	expect_usage(&r, 1, &r.problem, "not gauss on 16 x 10 poles");
	close_refusal(&r);
}

static void test_leaders(void **state)
{
	(void)state;
	refusal r = open_refusal();
	size_t *leader = calloc(r.c.poles, sizeof *leader);
	assert_non_null(leader);
	for (size_t n = 0; n < r.c.poles; n++)
		leader[n] = n;
	r.options.leader = leader;
	leader[20] = r.c.poles;
	expect_usage(&r, 1, &r.problem, "pole 20 follows pole 160 of 160, which does not exist");
	leader[20] = 21;
	leader[21] = 22;
	expect_usage(&r, 1, &r.problem, "pole 20 follows pole 21 of 160, which follows another");
	free(leader);
	close_refusal(&r);
}

static void test_topology(void **state)
{
	(void)state;
	refusal r = open_refusal();
	batten_surface *other = NULL;
	batten_net_problem problems[2] = { r.problem, r.problem };
	problems[1].start = NULL;
	expect_usage(&r, 2, problems, "surface 1 of 2 is NULL");
	assert_int_equal(batten_surface_clone(r.c.context, r.c.surface, &other), BATTEN_OK);
	assert_int_equal(batten_surface_insert_knot(other, BATTEN_DIRECTION_U, 0.5, 1), BATTEN_OK);
	problems[1].start = other;
	expect_usage(&r, 2, problems, "another number of poles");
	batten_surface_destroy(other);
	double *weights = calloc(r.c.poles, sizeof *weights);
	assert_non_null(weights);
	for (size_t n = 0; n < r.c.poles; n++)
		weights[n] = 1.0;
	batten_surface_net net = r.c.net;
	net.weights = weights;
	assert_int_equal(batten_surface_create(r.c.context, &net, &other), BATTEN_OK);
	problems[0].start = other;
	expect_usage(&r, 1, problems, "weights");
	batten_surface_destroy(other);
	free(weights);
	/* Nothing to do is done. */
	assert_int_equal(batten_net_search_batch(r.c.context, 0, NULL, &r.options, NULL, NULL, NULL),
	                 BATTEN_OK);
	close_refusal(&r);
}

/* A table that would be too large is not begun. */
static void test_large_net(void **state)
{
	(void)state;
	enum { SIDE = 70 };
	refusal r = open_refusal();
	double *poles = calloc((size_t)SIDE * SIDE, 3 * sizeof *poles);
	double *bounds = calloc((size_t)SIDE * SIDE, sizeof *bounds);
	batten_surface *large = NULL;
	assert_true(poles && bounds);
	for (int n = 0; n < SIDE * SIDE; n++) {
		poles[3 * n] = n % SIDE;
		poles[3 * n + 1] = bounds[n] = 1.0;
		poles[3 * n + 2] = n / SIDE;
	}
	const batten_surface_net net = {
		.order_u = 4, .order_v = 4, .count_u = SIDE, .count_v = SIDE, .poles_m = poles
	};
	assert_int_equal(batten_surface_create(r.c.context, &net, &large), BATTEN_OK);
	r.problem.start = large;
	r.problem.lower_y_m = r.problem.upper_y_m = bounds;
	r.options.search.algorithm = BATTEN_ALGORITHM_BLOCK;
	expect_usage(&r, 1, &r.problem, "on 70 x 70 poles");
	batten_surface_destroy(large);
	free(poles);
	free(bounds);
	close_refusal(&r);
}

/* A search that ends at its limit is a success here. */
static batten_status search_once(batten_context *context, void *user)
{
	refusal *r = user;
	batten_search_result result = { 0 };
	const batten_status status = batten_net_search_batch(context, 1, &r->problem, &r->options, r->y,
	                                                     &result, NULL);
	assert_int_not_equal(status, BATTEN_OK);
	return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
}

/* Every allocation fails once. */
static void test_memory(void **state)
{
	(void)state;
	refusal r = open_refusal();
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	r.options.search.algorithm = BATTEN_ALGORITHM_MULTILEVEL;
	assert_true(failing_heap_each(&heap, context, search_once, &r) > 20);
	r.options.search.algorithm = BATTEN_ALGORITHM_BLOCK;
	assert_true(failing_heap_each(&heap, context, search_once, &r) > 15);
	failing_heap_close(&heap, context);
	close_refusal(&r);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_refused_problems), cmocka_unit_test(test_options),
		cmocka_unit_test(test_leaders),          cmocka_unit_test(test_topology),
		cmocka_unit_test(test_large_net),        cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
