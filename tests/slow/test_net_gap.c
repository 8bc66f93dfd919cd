/* How far the net search ends above the minimum that Newton's method finds from the same start: below
 * 1e-6 of it within 100 iterations in f64 where bending is to be low. */
#include "support/net_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* One comparison: which fairness, how many iterations, how far above the minimum at most. */
typedef struct gap_limit {
	oracle_fairness fairness;
	unsigned iterations;
	double most;
	batten_precision precision;
	/* Far from the start the objective has several minima: the one the search found is what Newton's
	 * method finds from the search's end. */
	bool nearest;
	batten_search_algorithm algorithm; /* filled by check() */
} gap_limit;

static unsigned search(const net_case *c, const gap_limit *limit, double w2, double *y)
{
	const batten_net_problem problem = net_case_problem(c, 1.0, w2);
	batten_net_options options;
	batten_search_result result;
	batten_net_options_default(&options);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.search.precision = limit->precision;
	options.search.iteration_limit = limit->iterations;
	options.fairness = (batten_fairness)limit->fairness;
	options.search.algorithm = limit->algorithm;
	(void)batten_net_search_batch(c->context, 1, &problem, &options, y, &result, NULL);
	assert_int_not_equal(result.end, BATTEN_SEARCH_REFUSED);
	return result.iterations;
}

/* The minimum from the start, or from y. */
static oracle_minimum known_minimum(const net_case *c, const gap_limit *limit, double w2,
                                    const double *y)
{
	oracle_net_problem problem = net_case_oracle(c, limit->fairness, 1.0, w2);
	oracle_surface moved = c->exact;
	oracle_minimum minimum;
	double *poles = calloc(3 * c->poles, sizeof *poles);
	double *best = calloc(c->poles, sizeof *best);
	assert_true(poles && best);
	for (size_t n = 0; n < 3 * c->poles; n++)
		poles[n] = limit->nearest && n % 3 == 1 ? y[n / 3] : c->net.poles_m[n];
	moved.poles = poles;
	problem.surface = &moved;
	assert_true(oracle_net_minimise(&problem, best, &minimum));
	assert_true(minimum.converged);
	free(poles);
	free(best);
	return minimum;
}

/* known: the minimum from the start. */
static void check_one(const char *name, const net_case *c, double w2, gap_limit limit,
                      const oracle_minimum *known)
{
	static const char *const names[] = { "bending", "mean", "gauss" };
	const oracle_net_problem problem = net_case_oracle(c, limit.fairness, 1.0, w2);
	double *y = calloc(c->poles, sizeof *y);
	assert_non_null(y);
	const unsigned iterations = search(c, &limit, w2, y);
	const oracle_minimum minimum = limit.nearest ? known_minimum(c, &limit, w2, y) : *known;
	/* The oracle's own value of the net the search ended with. */
	const double found = (double)oracle_net_objective(&problem, y);
	const double gap = found / (double)minimum.objective - 1.0;
	print_message("%s %s %s %s w2/w1 %g: gap %.2e, %u iterations, %zu of %zu poles at a bound\n",
	              name, batten_search_algorithm_text(limit.algorithm), names[limit.fairness],
	              limit.precision == BATTEN_F64 ? "f64" : "f32", w2, gap, iterations,
	              minimum.at_bound, minimum.variables);
	free(y);
	assert_true(gap <= limit.most);
	assert_true(gap >= -1e-9);
}

/* By both searches, where both know the fairness. */
static void check(const char *name, const net_case *c, double w2, gap_limit limit)
{
	oracle_minimum known = { 0 };
	if (!limit.nearest)
		known = known_minimum(c, &limit, w2, NULL);
	limit.algorithm = BATTEN_ALGORITHM_MULTILEVEL;
	check_one(name, c, w2, limit, &known);
	/* Its iterations cost a hundredth of the other's. */
	limit.algorithm = BATTEN_ALGORITHM_BLOCK;
	limit.iterations *= 2;
	if (limit.fairness != ORACLE_FAIRNESS_GAUSS)
		check_one(name, c, w2, limit, &known);
}

static const double ratios[] = { 10.0, 1e3, 1e5 };

static void check_ratios(const char *name, net_case c, gap_limit limit)
{
	for (int r = 0; r < 3; r++)
		check(name, &c, ratios[r], limit);
	net_case_close(&c);
}

static const gap_limit bending = { ORACLE_FAIRNESS_BENDING, 100, 1e-6, BATTEN_F64, false,
	                               BATTEN_ALGORITHM_AUTO };

static void test_wigley(void **state)
{
	(void)state;
	check_ratios("wigley", net_case_wigley(10.0), bending);
	check_ratios("wigley within 0.01 h", net_case_wigley(0.01), bending);
}

static void test_npl_with_limit(void **state)
{
	(void)state;
	check_ratios("npl within 0.1 h", net_case_npl(0.1), bending);
	check_ratios("npl within 0.01 h", net_case_npl(0.01), bending);
}

/* At w2/w1 = 10 poles move by more than the half-beam. */
static void test_npl(void **state)
{
	(void)state;
	gap_limit nearest = bending;
	nearest.nearest = true;
	net_case c = net_case_npl(10.0);
	check("npl", &c, 10.0, nearest);
	check("npl", &c, 1e3, bending);
	check("npl", &c, 1e5, bending);
	net_case_close(&c);
}

static void test_f32(void **state)
{
	(void)state;
	const gap_limit limit = { ORACLE_FAIRNESS_BENDING, 100, 5e-5, BATTEN_F32, false,
		                      BATTEN_ALGORITHM_AUTO };
	check_ratios("wigley", net_case_wigley(10.0), limit);
}

static void test_mean(void **state)
{
	(void)state;
	const gap_limit limit = { ORACLE_FAIRNESS_MEAN, 100,   1e-6,
		                      BATTEN_F64,           false, BATTEN_ALGORITHM_AUTO };
	check_ratios("wigley", net_case_wigley(10.0), limit);
	check_ratios("npl within 0.1 h", net_case_npl(0.1), limit);
}

static void test_gauss(void **state)
{
	(void)state;
	const gap_limit limit = { ORACLE_FAIRNESS_GAUSS, 100, 1e-6, BATTEN_F64, true,
		                      BATTEN_ALGORITHM_AUTO };
	check_ratios("wigley", net_case_wigley(10.0), limit);
}

/* The block search over seeds, noises and boxes, by its certificate. */
static void test_noises(void **state)
{
	(void)state;
	static const double noises[] = { 0.005, 0.02 };
	static const double parts[] = { 10.0, 0.02 };
	double worst = 0.0;
	unsigned longest = 0;
	for (uint32_t n = 0; n < 8 * 2 * 2; n++) {
		net_case c = net_case_noisy(1000u + n / 4, noises[n % 2], parts[n / 2 % 2]);
		double *y = calloc(c.poles, sizeof *y);
		assert_non_null(y);
		for (int run = 0; run < 6; run++) {
			const gap_limit limit = { (oracle_fairness)(run % 2), 60, 0.0, BATTEN_F64, false,
				                      BATTEN_ALGORITHM_BLOCK };
			const batten_net_problem problem = net_case_problem(&c, 1.0, ratios[run / 2]);
			batten_net_options options;
			batten_certificate end;
			const unsigned iterations = search(&c, &limit, ratios[run / 2], y);
			batten_net_options_default(&options);
			options.fairness = (batten_fairness)(run % 2);
			assert_int_equal(batten_net_certify_batch(c.context, 1, &problem, &options, y, &end),
			                 BATTEN_OK);
			assert_true(end.gap_estimate < 1e-8);
			assert_true(iterations < limit.iterations);
			worst = fmax(worst, end.gap_estimate);
			longest = iterations > longest ? iterations : longest;
		}
		free(y);
		net_case_close(&c);
	}
	print_message("block over noises: gap %.2e, %u iterations at most\n", worst, longest);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_wigley), cmocka_unit_test(test_npl_with_limit),
		cmocka_unit_test(test_npl),    cmocka_unit_test(test_f32),
		cmocka_unit_test(test_mean),   cmocka_unit_test(test_gauss),
		cmocka_unit_test(test_noises),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
