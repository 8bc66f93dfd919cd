/* batten_net_search_batch: its objective against the oracle, fixed poles, leaders, independence of the
 * batch, by both searches. What it refuses: test_net_refusals.c; its directions: test_net_directions.c. */
#include "support/net_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Of the algorithm that a test runs with. */
static batten_net_options reference_options(void *const *state, unsigned iterations)
{
	batten_net_options options;
	batten_net_options_default(&options);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.search.iteration_limit = iterations;
	options.search.algorithm = *(const batten_search_algorithm *)*state;
	return options;
}

/* How many of the fairnesses, in their order, the algorithm knows: at most so many. */
static int known_fairness(void *const *state, int most)
{
	return *(const batten_search_algorithm *)*state == BATTEN_ALGORITHM_BLOCK ? 2 : most;
}

static void search(const net_case *c, size_t count, const batten_net_problem *problems,
                   const batten_net_options *options, double *y, batten_search_result *results)
{
	const batten_status status = batten_net_search_batch(c->context, count, problems, options, y,
	                                                     results, NULL);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE)
		fail_msg("%s", batten_context_error(c->context));
}

/* At the start and at the end, for every fairness that has a closed density. */
static void check_objective(void *const *state, const net_case *c)
{
	double *y = calloc(c->poles, sizeof *y);
	assert_non_null(y);
	for (int f = 0; f < known_fairness(state, 3); f++) {
		const oracle_net_problem known = net_case_oracle(c, (oracle_fairness)f, 1.0, 100.0);
		const batten_net_problem problem = net_case_problem(c, 1.0, 100.0);
		batten_net_options options = reference_options(state, 2);
		batten_search_result result = { 0 };
		options.fairness = (batten_fairness)f;
		const double start = (double)oracle_net_objective(&known, c->target);
		search(c, 1, &problem, &options, y, &result);
		const double end = (double)oracle_net_objective(&known, y);
		assert_true(fabs(result.objective_start / start - 1.0) < 1e-11);
		assert_true(fabs(result.objective_end / end - 1.0) < 1e-11);
		assert_true(end < start);
	}
	free(y);
}

static void test_objective(void **state)
{
	net_case c = net_case_wigley(0.1);
	check_objective(state, &c);
	net_case_close(&c);
	c = net_case_npl(0.1);
	check_objective(state, &c);
	net_case_close(&c);
}

/* w2 0: h^2 times the integral of the variation of curvature, by the oracle's differences. */
static void test_variation(void **state)
{
	net_case c = net_case_wigley(0.1);
	const batten_net_problem problem = net_case_problem(&c, 1.0, 0.0);
	batten_net_options options = reference_options(state, 1);
	batten_search_result result = { 0 };
	double *y = calloc(c.poles, sizeof *y);
	long double at[4];
	long double weight[4];
	long double sum = 0;
	assert_non_null(y);
	options.fairness = BATTEN_FAIRNESS_VARIATION;
	search(&c, 1, &problem, &options, y, &result);
	oracle_gauss(4, at, weight);
	for (int n = 0; n < 13 * 4 * 7 * 4; n++) {
		const int i = n / 28;
		const int k = n % 28;
		const int span[2] = { i / 4, k / 4 };
		const long double u = (span[0] + (1 + at[i % 4]) / 2) / 13;
		const long double v = (span[1] + (1 + at[k % 4]) / 2) / 7;
		oracle_jet jet;
		oracle_forms forms;
		assert_true(oracle_surface_at(&c.exact, u, v, jet));
		oracle_surface_forms(jet, &forms);
		sum += weight[i % 4] / 26 * weight[k % 4] / 14 * forms.area *
		       oracle_surface_variation(&c.exact, u, v, 0);
	}
	const double known = (double)sum * c.half_beam_m * c.half_beam_m;
	assert_true(fabs(result.objective_start / known - 1.0) < 1e-9);
	free(y);
	net_case_close(&c);
}

/* Fixed poles keep every bit, the others stay in their boxes and one of them moves. */
static void test_fixed_poles(void **state)
{
	net_case c = net_case_npl(0.01);
	const batten_net_problem problem = net_case_problem(&c, 1.0, 10.0);
	double *y = calloc(c.poles, sizeof *y);
	assert_non_null(y);
	for (size_t n = 0; n < c.poles; n += 3)
		c.lower[n] = c.upper[n] = c.target[n];
	for (int precision = 0; precision < 2; precision++) {
		batten_net_options options = reference_options(state, 5);
		batten_search_result result = { 0 };
		size_t moved = 0;
		options.search.precision = (batten_precision)precision;
		search(&c, 1, &problem, &options, y, &result);
		for (size_t n = 0; n < c.poles; n++) {
			assert_true(y[n] >= c.lower[n] && y[n] <= c.upper[n]);
			if (n % 3 == 0)
				assert_memory_equal(&y[n], &c.target[n], sizeof y[n]);
			moved += y[n] != c.target[n];
		}
		assert_true(moved > c.poles / 3);
	}
	free(y);
	net_case_close(&c);
}

/* What follows goes as far as its leader, and both stop where the first of them meets its bound. */
static void test_leaders(void **state)
{
	net_case c = net_case_wigley(0.05);
	const size_t columns = c.net.count_u;
	const batten_net_problem problem = net_case_problem(&c, 1.0, 10.0);
	batten_net_options options = reference_options(state, 30);
	batten_search_result result = { 0 };
	size_t *leader = calloc(c.poles, sizeof *leader);
	double *y = calloc(c.poles, sizeof *y);
	size_t moved = 0;
	assert_true(leader && y);
	for (size_t n = 0; n < c.poles; n++)
		leader[n] = n >= c.poles - columns ? n - columns : n; /* the deck row */
	leader[3] = c.poles / 2; /* far apart, and fixed at the keel: neither may move */
	options.leader = leader;
	search(&c, 1, &problem, &options, y, &result);
	for (size_t n = 0; n < c.poles; n++) {
		const double way = y[n] - c.target[n];
		const double led = y[leader[n]] - c.target[leader[n]];
		assert_true(fabs(way - led) < 1e-15);
		assert_true(y[n] >= c.lower[n] && y[n] <= c.upper[n]);
		moved += leader[n] != n && way != 0.0;
	}
	assert_true(y[c.poles / 2] == c.target[c.poles / 2]);
	assert_true(moved > columns / 2);
	assert_true(result.objective_end < result.objective_start);
	free(leader);
	free(y);
	net_case_close(&c);
}

/* A search alone, in a batch, and in the batch the other way round: the same bits. */
static void test_batch_independence(void **state)
{
	enum { COUNT = 5 };
	net_case c = net_case_wigley(0.1);
	batten_surface *wide = NULL;
	batten_net_problem problems[COUNT];
	batten_search_result results[COUNT] = { 0 };
	const batten_net_options options = reference_options(state, 6);
	double *y = calloc(2 * COUNT * c.poles, sizeof *y);
	assert_non_null(y);
	/* A hull eight times as long takes other levels of hats. */
	const double matrix[9] = { 8.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
	const double shift[3] = { 0.0, 0.0, 0.0 };
	assert_int_equal(batten_surface_clone(c.context, c.surface, &wide), BATTEN_OK);
	assert_int_equal(batten_surface_map(wide, matrix, shift), BATTEN_OK);
	double *fixed = calloc(c.poles, sizeof *fixed);
	assert_non_null(fixed);
	for (size_t n = 0; n < c.poles; n++)
		fixed[n] = n % 2 ? c.upper[n] : c.target[n];
	for (int p = 0; p < COUNT; p++) {
		problems[p] = net_case_problem(&c, 1.0, pow(10.0, p));
		if (p % 2)
			problems[p].start = wide;
	}
	problems[2].upper_y_m = problems[2].lower_y_m = c.target; /* nothing moves */
	problems[4].upper_y_m = fixed;
	search(&c, COUNT, problems, &options, y, results);
	assert_int_equal(results[2].iterations > 0, 1);
	for (int p = 0; p < COUNT; p++) {
		batten_search_result alone = { 0 };
		double *other = y + COUNT * c.poles;
		search(&c, 1, &problems[p], &options, other, &alone);
		assert_memory_equal(other, y + (size_t)p * c.poles, c.poles * sizeof *y);
		assert_memory_equal(&alone.objective_end, &results[p].objective_end, sizeof(double));
		assert_int_equal(alone.probes, results[p].probes);
	}
	batten_net_problem turned[COUNT];
	batten_search_result turned_results[COUNT] = { 0 };
	for (int p = 0; p < COUNT; p++)
		turned[p] = problems[COUNT - 1 - p];
	search(&c, COUNT, turned, &options, y + COUNT * c.poles, turned_results);
	for (int p = 0; p < COUNT; p++)
		assert_memory_equal(y + (size_t)(2 * COUNT - 1 - p) * c.poles, y + (size_t)p * c.poles,
		                    c.poles * sizeof *y);
	free(fixed);
	free(y);
	batten_surface_destroy(wide);
	net_case_close(&c);
}

/* The dimensions of the hull do not matter: four times as large, the same search. */
static void test_scale(void **state)
{
	net_case c = net_case_wigley(0.1);
	for (int f = 0; f < known_fairness(state, 4); f++) {
		batten_surface *large = NULL;
		const double matrix[9] = { 4.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 4.0 };
		const double shift[3] = { 0.0, 0.0, 0.0 };
		batten_net_options options = reference_options(state, 4);
		batten_search_result results[2] = { 0 };
		double *y = calloc(2 * c.poles, sizeof *y);
		double *bounds = calloc(2 * c.poles, sizeof *bounds);
		assert_non_null(y);
		assert_non_null(bounds);
		options.fairness = (batten_fairness)f;
		assert_int_equal(batten_surface_clone(c.context, c.surface, &large), BATTEN_OK);
		assert_int_equal(batten_surface_map(large, matrix, shift), BATTEN_OK);
		for (size_t n = 0; n < c.poles; n++) {
			bounds[n] = 4.0 * c.lower[n];
			bounds[c.poles + n] = 4.0 * c.upper[n];
		}
		batten_net_problem problems[2] = { net_case_problem(&c, 1.0, 50.0),
			                               net_case_problem(&c, 1.0, 50.0) };
		problems[1].start = large;
		problems[1].lower_y_m = bounds;
		problems[1].upper_y_m = bounds + c.poles;
		problems[1].half_beam_m *= 4.0;
		search(&c, 2, problems, &options, y, results);
		assert_true(fabs(results[1].objective_start / results[0].objective_start - 1.0) < 1e-12);
		for (size_t n = 0; n < c.poles; n++)
			assert_true(fabs(y[c.poles + n] - 4.0 * y[n]) < 1e-7);
		free(y);
		free(bounds);
		batten_surface_destroy(large);
	}
	net_case_close(&c);
}

#define BY(algorithm, test)                                                                        \
	{                                                                                              \
#test " by " #algorithm, test, NULL, NULL, &algorithm                                      \
	}

int main(void)
{
	static batten_search_algorithm multilevel = BATTEN_ALGORITHM_MULTILEVEL;
	static batten_search_algorithm block = BATTEN_ALGORITHM_BLOCK;
	const struct CMUnitTest tests[] = {
		BY(multilevel, test_objective),
		BY(block, test_objective),
		BY(multilevel, test_variation),
		BY(multilevel, test_fixed_poles),
		BY(block, test_fixed_poles),
		BY(multilevel, test_leaders),
		BY(block, test_leaders),
		BY(multilevel, test_batch_independence),
		BY(block, test_batch_independence),
		BY(multilevel, test_scale),
		BY(block, test_scale),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
