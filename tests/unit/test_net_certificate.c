/* Certificates of searches over control nets: against the oracle's objective and minimum, for every
 * fairness, with poles that move together, and the polish. */
#include "support/cases.h"
#include "support/failing_heap.h"
#include "support/net_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static batten_net_options options_of(batten_fairness fairness, unsigned iterations)
{
	batten_net_options options;
	batten_net_options_default(&options);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.search.iteration_limit = iterations;
	options.fairness = fairness;
	return options;
}

static double *room_for(const net_case *c)
{
	double *numbers = calloc(c->poles, sizeof *numbers);
	assert_non_null(numbers);
	return numbers;
}

static batten_search_result search(const net_case *c, const batten_net_problem *problem,
                                   const batten_net_options *options, double *y)
{
	batten_search_result result;
	(void)batten_net_search_batch(c->context, 1, problem, options, y, &result, NULL);
	assert_int_not_equal(result.end, BATTEN_SEARCH_REFUSED);
	return result;
}

static batten_certificate certify(const net_case *c, const batten_net_problem *problem,
                                  const batten_net_options *options, const double *y)
{
	batten_certificate found;
	if (batten_net_certify_batch(c->context, 1, problem, options, y, &found) != BATTEN_OK)
		fail_msg("%s", batten_context_error(c->context));
	return found;
}

/* Is a pole free at y: with room, and not held by the slope? */
static bool is_free(const net_case *c, const double *y, const double *slope, size_t n)
{
	const double near = 1e-13;
	return c->lower[n] < c->upper[n] && !(y[n] <= c->lower[n] + near && slope[n] >= 0.0) &&
	       !(y[n] >= c->upper[n] - near && slope[n] <= 0.0);
}

/* Objective and norm of the gradient, away from the minimum; slopes by the oracle's differences. */
static void check_gradient(const net_case *c, int first, int last)
{
	double *y = room_for(c);
	double *slope = room_for(c);
	for (int f = first; f <= last; f++) {
		const batten_net_problem problem = net_case_problem(c, 1.0, 100.0);
		const oracle_net_problem known = net_case_oracle(c, (oracle_fairness)f, 1.0, 100.0);
		const batten_net_options options = options_of((batten_fairness)f, 2);
		const double end = search(c, &problem, &options, y).objective_end;
		const batten_certificate found = certify(c, &problem, &options, y);
		const long double objective = oracle_net_objective(&known, y);
		long double square = 0.0L;
		size_t count = 0;
		assert_true(oracle_net_slopes(&known, y, 1e-7, slope));
		for (size_t n = 0; n < c->poles; n++)
			if (is_free(c, y, slope, n)) {
				square += (long double)slope[n] * slope[n];
				count++;
			}
		assert_int_equal(found.free_count, count);
		assert_true(fabsl(found.objective / objective - 1.0L) < 1e-12L);
		assert_true(fabs(found.objective / end - 1.0) < 1e-12);
		const double h2 = problem.half_beam_m * problem.half_beam_m;
		const oracle_net_problem fair = net_case_oracle(c, (oracle_fairness)f, 1.0, 0.0);
		const oracle_net_problem close = net_case_oracle(c, (oracle_fairness)f, 0.0, h2 * h2);
		assert_true(fabsl(found.fairness / oracle_net_objective(&fair, y) - 1.0L) < 1e-12L);
		assert_true(fabsl(found.closeness_m4 / oracle_net_objective(&close, y) - 1.0L) < 1e-12L);
		assert_true(fabsl(found.gradient_per_m / sqrtl(square) - 1.0L) < 1e-6L);
	}
	free(slope);
	free(y);
}

static void test_gradient(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	check_gradient(&c, ORACLE_FAIRNESS_BENDING, ORACLE_FAIRNESS_GAUSS);
	net_case_close(&c);
	c = net_case_npl(0.1);
	check_gradient(&c, ORACLE_FAIRNESS_BENDING, ORACLE_FAIRNESS_BENDING);
	net_case_close(&c);
}

/* The estimate is the gap to the oracle's minimum, of searches ended early and of whole ones. */
static void test_estimate_is_the_gap(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	double *y = room_for(&c);
	double *best = room_for(&c);
	for (int run = 0; run < CASES(6, 2); run++) {
		const int f = run / 2;
		const double w2 = f == 2 ? 1e4 : 100.0;
		const batten_net_problem problem = net_case_problem(&c, 1.0, w2);
		const oracle_net_problem known = net_case_oracle(&c, (oracle_fairness)f, 1.0, w2);
		batten_net_options options = options_of((batten_fairness)f, 400);
		oracle_minimum minimum;
		if (run % 2 == 0)
			options.search.last_step = 1e-5;
		(void)search(&c, &problem, &options, y);
		assert_true(oracle_net_minimise(&known, best, &minimum) && minimum.converged);
		const long double gap = oracle_net_objective(&known, y) / minimum.objective - 1.0L;
		const batten_certificate found = certify(&c, &problem, &options, y);
		print_message("fairness %d run %d: gap %.3Le, estimate %.3e\n", f, run, gap,
		              found.gap_estimate);
		assert_true(found.gap_estimate >= 0.8L * gap - 1e-13L);
		assert_true(found.gap_estimate <= 1.25L * gap + 1e-13L);
		const batten_certificate there = certify(&c, &problem, &options, best);
		assert_true(fabs(there.gap_estimate) < 1e-13);
	}
	free(best);
	free(y);
	net_case_close(&c);
}

/* Every fairness, the variation of curvature too, in f32 and f64: what is promised is what a polish
 * gains, and it ends where nothing is promised. */
static void test_polish(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	const batten_net_problem problem = net_case_problem(&c, 1.0, 1e4);
	double *y = room_for(&c);
	for (int run = 0; run < CASES(8, 2); run++) {
		if (run == 3 || run == 5)
			continue; /* f32 once with each order of derivatives */
		batten_net_options options = options_of((batten_fairness)(run / 2), 60);
		batten_certificate end;
		options.search.precision = run % 2 ? BATTEN_F32 : BATTEN_F64;
		const double found = search(&c, &problem, &options, y).objective_end;
		const batten_certificate before = certify(&c, &problem, &options, y);
		assert_true(fabs(found / before.objective - 1.0) < (run % 2 ? 1e-4 : 1e-11));
		assert_int_equal(batten_net_polish_batch(c.context, 1, &problem, &options, 1e-13, y, &end),
		                 BATTEN_OK);
		const double gain = before.objective / end.objective - 1.0;
		print_message("fairness %d %s: promised %.3e, gained %.3e in %u steps to %.1e\n", run / 2,
		              run % 2 ? "f32" : "f64", before.gap_estimate, gain, end.steps,
		              end.gap_estimate);
		assert_true(end.gap_estimate <= 1e-13);
		assert_true(gain >= 0.0);
		assert_true(fabs(gain - before.gap_estimate) <= 0.25 * gain + 1e-12);
		for (size_t n = 0; n < c.poles; n++)
			assert_true(y[n] >= c.lower[n] && y[n] <= c.upper[n]);
	}
	free(y);
	net_case_close(&c);
}

/* Where the Hessian is not positive definite there is no estimate, and a polish goes on all the same: from the
 * start to where the search ends. */
static void test_polish_from_no_estimate(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	const batten_net_problem problem = net_case_problem(&c, 1.0, 10.0);
	double *y = room_for(&c);
	for (int f = 0; f < CASES(2, 1); f++) { /* bending, mean */
		const batten_net_options options = options_of((batten_fairness)f, 400);
		batten_certificate end;
		const double known = search(&c, &problem, &options, y).objective_end;
		memcpy(y, c.target, c.poles * sizeof *y);
		const batten_certificate before = certify(&c, &problem, &options, y);
		assert_true(isnan(before.gap_estimate));
		assert_non_null(strstr(before.message, "not positive definite"));
		assert_int_equal(batten_net_polish_batch(c.context, 1, &problem, &options, 1e-13, y, &end),
		                 BATTEN_OK);
		assert_true(end.gap_estimate <= 1e-13 && end.message[0] == '\0');
		assert_true(end.steps > 1 && end.steps < 40);
		assert_true(fabs(end.objective / known - 1.0) < 1e-6);
		for (size_t n = 0; n < c.poles; n++)
			assert_true(y[n] >= c.lower[n] && y[n] <= c.upper[n]);
	}
	free(y);
	net_case_close(&c);
}

/* Each fixed pole of the keel is followed: a row that goes with the one beside it is one unknown a pole,
 * and a polish moves both alike. */
static void test_poles_that_move_together(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	const size_t columns = 16;
	const size_t rows = 10;
	size_t leader[160];
	double *y = room_for(&c);
	batten_net_options options = options_of(BATTEN_FAIRNESS_BENDING, 4);
	const batten_net_problem problem = net_case_problem(&c, 1.0, 100.0);
	batten_certificate end;
	assert_int_equal(c.poles, columns * rows);
	for (size_t n = 0; n < c.poles; n++)
		leader[n] = n / columns == rows - 1 ? n - columns : n;
	const batten_certificate alone = (search(&c, &problem, &options, y),
	                                  certify(&c, &problem, &options, y));
	options.leader = leader;
	(void)search(&c, &problem, &options, y);
	const batten_certificate led = certify(&c, &problem, &options, y);
	assert_true(led.free_count < alone.free_count);
	assert_int_equal(batten_net_polish_batch(c.context, 1, &problem, &options, 1e-13, y, &end),
	                 BATTEN_OK);
	const double gain = led.objective / end.objective - 1.0;
	assert_true(gain > 0.0 && fabs(gain - led.gap_estimate) <= 0.25 * gain);
	for (size_t n = 0; n < c.poles; n++)
		assert_true(fabs((y[n] - c.target[n]) - (y[leader[n]] - c.target[leader[n]])) < 1e-15);
	free(y);
	net_case_close(&c);
}

static void test_what_cannot_be_judged(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	batten_net_problem problems[2];
	batten_certificate found[2];
	double *y = calloc(2 * c.poles, sizeof *y);
	assert_non_null(y);
	const batten_net_options options = options_of(BATTEN_FAIRNESS_BENDING, 1);
	for (size_t n = 0; n < 2 * c.poles; n++)
		y[n] = c.target[n % c.poles];
	problems[0] = problems[1] = net_case_problem(&c, 1.0, 100.0);
	y[c.poles + 7] = NAN;
	assert_int_equal(batten_net_certify_batch(c.context, 2, problems, &options, y, found),
	                 BATTEN_INCOMPLETE);
	assert_string_equal(found[0].message, "");
	assert_true(found[0].gradient_per_m > 0.0);
	assert_string_equal(found[1].message, "a pole is not finite");
	assert_true(isnan(found[1].gap_estimate));
	y[c.poles + 7] = 0.1;
	problems[1].w1 = -1.0;
	assert_int_equal(batten_net_certify_batch(c.context, 2, problems, &options, y, found),
	                 BATTEN_INCOMPLETE);
	assert_true(strstr(found[1].message, "weight") != NULL);
	assert_int_equal(batten_net_polish_batch(c.context, 2, problems, &options, 0.0, y, found),
	                 BATTEN_USAGE);
	free(y);
	net_case_close(&c);
}

typedef struct once {
	const net_case *c;
	double *y;
} once;

static batten_status polish_once(batten_context *context, void *user)
{
	const once *o = user;
	const batten_net_problem problem = net_case_problem(o->c, 1.0, 100.0);
	const batten_net_options options = options_of(BATTEN_FAIRNESS_BENDING, 1);
	batten_certificate found;
	memcpy(o->y, o->c->target, o->c->poles * sizeof *o->y);
	return batten_net_polish_batch(context, 1, &problem, &options, 1e9, o->y, &found);
}

/* Every allocation fails once. */
static void test_memory(void **state)
{
	(void)state;
	net_case c = net_case_wigley(0.1);
	once o = { &c, room_for(&c) };
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	assert_true(failing_heap_each(&heap, context, polish_once, &o) > 15);
	failing_heap_close(&heap, context);
	free(o.y);
	net_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_gradient),
		cmocka_unit_test(test_estimate_is_the_gap),
		cmocka_unit_test(test_polish),
		cmocka_unit_test(test_polish_from_no_estimate),
		cmocka_unit_test(test_poles_that_move_together),
		cmocka_unit_test(test_what_cannot_be_judged),
		cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
