/* How far the search ends above the minimum that gradient methods find from the same start: below
 * 1e-6 of it in f64, 3e-4 in f32. */
#include "support/search_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* The minimum two other methods agree on: projected Newton in long double, and NLopt's L-BFGS. */
static double known_minimum(const search_case *c, double w2, size_t *at_bound)
{
	const oracle_problem problem = search_case_oracle(c, 1.0, w2);
	oracle_minimum newton;
	oracle_minimum lbfgs;
	double *y = calloc(c->nodes, sizeof *y);
	assert_non_null(y);
	assert_true(oracle_minimise(&problem, y, &newton));
	assert_true(newton.converged);
	assert_true(oracle_minimise_lbfgs(&problem, y, &lbfgs));
	free(y);
	assert_true(fabs((double)(newton.objective - lbfgs.objective)) <=
	            1e-9 * (double)newton.objective);
	*at_bound = newton.at_bound;
	return (double)newton.objective;
}

static double searched_minimum(const search_case *c, double w2, batten_precision precision,
                               batten_search_algorithm algorithm, unsigned *iterations)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.precision = precision;
	options.algorithm = algorithm;
	const batten_search_problem problem = search_case_problem(c, 1.0, w2);
	batten_search_result result;
	double *y = calloc(c->nodes, sizeof *y);
	assert_non_null(y);
	assert_int_equal(
		batten_search_batch(c->context, &c->grid, 1, &problem, &options, y, &result, NULL),
		BATTEN_OK);
	*iterations = result.iterations;
	const oracle_problem known = search_case_oracle(c, 1.0, w2);
	/* The oracle's own value of the offsets the search ended with. */
	const double objective = (double)oracle_objective(&known, y);
	free(y);
	return objective;
}

static void check(const char *name, double part, double w2)
{
	search_case c = search_case_open(name, part, true);
	size_t at_bound = 0;
	const double minimum = known_minimum(&c, w2, &at_bound);
	static const double bounds[2] = { 1e-6, 3e-4 };
	for (int run = 0; run < 4; run++) {
		const int p = run % 2;
		const batten_search_algorithm algorithm = run < 2 ? BATTEN_ALGORITHM_MULTILEVEL
		                                                  : BATTEN_ALGORITHM_BLOCK;
		unsigned iterations = 0;
		const double found = searched_minimum(&c, w2, p ? BATTEN_F32 : BATTEN_F64, algorithm,
		                                      &iterations);
		const double gap = found / minimum - 1.0;
		print_message("%s w2/w1 %g %s %s: gap %.2e, %u iterations, %zu of the offsets at a bound\n",
		              name, w2, batten_search_algorithm_text(algorithm), p ? "f32" : "f64", gap,
		              iterations, at_bound);
		assert_true(gap <= bounds[p]);
		/* Two methods agree on the minimum: nothing ends below it. */
		assert_true(gap >= -1e-9);
		assert_true(p == 1 || iterations <= 100);
	}
	search_case_close(&c);
}

static void test_wigley_with_noise(void **state)
{
	(void)state;
	check("wigley_noisy", 1.2, 4.0);
	check("wigley_noisy", 1.2, 400.0);
	check("wigley_noisy", 1.2, 4e4);
}

static void test_wigley_with_noise_and_limit(void **state)
{
	(void)state;
	check("wigley_noisy", 0.01, 400.0);
	check("wigley_noisy", 0.01, 4e4);
}

/* With its distance limit up to a third of NPL's offsets end at a bound. */
static void test_npl_with_limit(void **state)
{
	(void)state;
	check("npl_parent", 0.01, 4.0);
	check("npl_parent", 0.01, 400.0);
	check("npl_parent", 0.01, 1e4);
	check("npl_parent", 0.01, 1e6);
}

static void test_other_hulls_with_limit(void **state)
{
	(void)state;
	check("bsra_trawler", 0.01, 1e4);
	check("highspeed_craft", 0.01, 1e4);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_wigley_with_noise),
		cmocka_unit_test(test_wigley_with_noise_and_limit),
		cmocka_unit_test(test_npl_with_limit),
		cmocka_unit_test(test_other_hulls_with_limit),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
