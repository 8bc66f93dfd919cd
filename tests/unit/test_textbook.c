/* The textbook search against a plain one written anew, and against its optimum. */
#include "support/search_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Figure 7.2 of the thesis on the oracle's objective: explore, pattern move, halve. */
typedef struct plain_search {
	const oracle_problem *problem;
	size_t nodes;
	double *base, *best, *point; /* b_old, b_new, the one explored about */
	unsigned sweeps, probes;
} plain_search;

static double value_of(plain_search *p, const double *y)
{
	return (double)oracle_objective(p->problem, y);
}

/* Tries node n of the point at y; true and the new value where that is a gain. */
static bool gains(plain_search *p, size_t n, double y, double *value)
{
	const double old = p->point[n];
	p->point[n] = fmin(fmax(y, p->problem->lower[n]), p->problem->upper[n]);
	p->probes++;
	const double found = value_of(p, p->point);
	if (found < *value - 1e-14 * *value) {
		*value = found;
		return true;
	}
	p->point[n] = old;
	return false;
}

static double explore(plain_search *p, double h)
{
	double value = value_of(p, p->point);
	for (size_t n = 0; n < p->nodes; n++) {
		const double y = p->point[n];
		if (p->problem->lower[n] < p->problem->upper[n] && !gains(p, n, y + h, &value))
			(void)gains(p, n, y - h, &value);
	}
	p->sweeps++;
	return value;
}

static double plain_run(plain_search *p, double h, double last)
{
	const size_t size = p->nodes * sizeof *p->best;
	double best = value_of(p, p->best);
	while (h > last) {
		memcpy(p->point, p->best, size);
		double found = explore(p, h);
		if (!(found < best - 1e-14 * best)) {
			h *= 0.5;
			continue;
		}
		while (found < best - 1e-14 * best) {
			best = found;
			memcpy(p->base, p->best, size);
			memcpy(p->best, p->point, size);
			for (size_t n = 0; n < p->nodes; n++)
				p->point[n] = fmin(fmax(2.0 * p->best[n] - p->base[n], p->problem->lower[n]),
				                   p->problem->upper[n]);
			p->probes++;
			found = explore(p, h);
		}
	}
	return best;
}

static batten_search_options textbook_options(double last_step)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.algorithm = BATTEN_ALGORITHM_TEXTBOOK;
	options.iteration_limit = 20000;
	options.last_step = last_step;
	return options;
}

static double *room_for(const search_case *c)
{
	double *numbers = calloc(c->nodes, sizeof *numbers);
	assert_non_null(numbers);
	return numbers;
}

/* Sweep by sweep and probe by probe: the counts are equal, and so is the end. */
static void test_course_is_the_figures(void **state)
{
	(void)state;
	search_case c = search_case_open("npl_parent", 0.01, true);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e5);
	const oracle_problem known = search_case_oracle(&c, 1.0, 1e5);
	const batten_search_options options = textbook_options(1e-3);
	plain_search plain = { .problem = &known,
		                   .nodes = c.nodes,
		                   .base = room_for(&c),
		                   .best = room_for(&c),
		                   .point = room_for(&c) };
	double *y = room_for(&c);
	batten_search_result result;
	memcpy(plain.best, problem.start_m, c.nodes * sizeof *y);
	const double best = plain_run(&plain, options.first_step * c.half_beam_m,
	                              options.last_step * c.half_beam_m);
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &result, NULL),
		BATTEN_OK);
	assert_int_equal(result.algorithm, BATTEN_ALGORITHM_TEXTBOOK);
	assert_int_equal(result.end, BATTEN_SEARCH_CONVERGED);
	assert_int_equal(result.iterations, plain.sweeps);
	assert_int_equal(result.probes, plain.probes);
	assert_true(fabs(result.objective_end - best) <= 1e-12 * best);
	for (size_t n = 0; n < c.nodes; n++)
		assert_true(fabs(y[n] - plain.best[n]) <= 1e-12 * c.half_beam_m);
	free(plain.base);
	free(plain.best);
	free(plain.point);
	free(y);
	search_case_close(&c);
}

/* It ends above the optimum that the multilevel search finds, a little where closeness is stiff. */
static void test_end_is_near_the_optimum(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 1.2, true);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 4e4);
	batten_search_options options = textbook_options(1e-5);
	double *y = room_for(&c);
	batten_search_result results[2];
	for (int run = 0; run < 2; run++) {
		assert_int_equal(
			batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &results[run], NULL),
			BATTEN_OK);
		options.algorithm = BATTEN_ALGORITHM_MULTILEVEL;
	}
	const double gap = results[0].objective_end / results[1].objective_end - 1.0;
	print_message("textbook: gap %.2e after %u sweeps, %llu probes\n", gap, results[0].iterations,
	              (unsigned long long)results[0].probes);
	assert_true(gap >= -1e-7 && gap <= 1e-5);
	assert_true(results[0].iterations > results[1].iterations);
	free(y);
	search_case_close(&c);
}

/* A search at its limit keeps the best point it found, and a start that is not finite is refused. */
static void test_limit_and_refusal(void **state)
{
	(void)state;
	search_case c = search_case_open("bsra_trawler", 0.01, true);
	batten_search_problem problems[2] = { search_case_problem(&c, 1.0, 1e4),
		                                  search_case_problem(&c, 1.0, 1e4) };
	batten_search_options options = textbook_options(0.0);
	double *start = room_for(&c);
	double *y = calloc(2 * c.nodes, sizeof *y);
	batten_search_result results[2];
	assert_non_null(y);
	for (size_t n = 0; n < c.nodes; n++)
		start[n] = INFINITY;
	problems[1].start_m = start;
	options.iteration_limit = 3;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 2, problems, &options, y, results, NULL),
		BATTEN_INCOMPLETE);
	assert_int_equal(results[0].end, BATTEN_SEARCH_LIMIT);
	assert_int_equal(results[0].iterations, 3);
	assert_true(results[0].objective_end < results[0].objective_start);
	const oracle_problem known = search_case_oracle(&c, 1.0, 1e4);
	const double end = (double)oracle_objective(&known, y);
	assert_true(fabs(results[0].objective_end - end) <= 1e-12 * end);
	assert_int_equal(results[1].end, BATTEN_SEARCH_REFUSED);
	free(start);
	free(y);
	search_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_course_is_the_figures),
		cmocka_unit_test(test_end_is_near_the_optimum),
		cmocka_unit_test(test_limit_and_refusal),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
