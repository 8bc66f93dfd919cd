/* Certificates of searches against the oracle's gradient and minimum. */
#include "support/search_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *const hulls[] = { "npl_parent", "bsra_trawler", "highspeed_craft", "wigley",
	                                 "wigley_noisy" };
enum { HULL_COUNT = 5 };

static batten_search_options reference_options(void)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	return options;
}

/* Objective and norm of the gradient over the free offsets are the oracle's, away from the minimum. */
static void test_gradient_is_the_oracles(void **state)
{
	(void)state;
	for (size_t h = 0; h < HULL_COUNT; h++) {
		search_case c = search_case_open(hulls[h], 0.01, false);
		const batten_search_problem problem = search_case_problem(&c, 1.0, 1e3);
		const oracle_problem known = search_case_oracle(&c, 1.0, 1e3);
		batten_search_options options = reference_options();
		double *y = search_case_room(&c);
		long double *gradient = calloc(c.nodes, sizeof *gradient);
		assert_non_null(gradient);
		options.iteration_limit = 2;
		(void)search_case_run(&c, &problem, &options, y);
		const batten_certificate found = search_case_certify(&c, &problem, &options, y);
		assert_true(oracle_gradient(&known, y, gradient));
		long double square = 0.0L;
		size_t count = 0;
		for (size_t n = 0; n < c.nodes; n++) {
			const bool held = (y[n] <= c.lower_m[n] && gradient[n] >= 0.0L) ||
			                  (y[n] >= c.upper_m[n] && gradient[n] <= 0.0L);
			if (problem.nodes[n] == BATTEN_NODE_OUTSIDE || c.lower_m[n] >= c.upper_m[n] || held)
				continue;
			square += gradient[n] * gradient[n];
			count++;
		}
		const double norm = (double)sqrtl(square);
		const double objective = (double)oracle_objective(&known, y);
		assert_int_equal(found.free_count, count);
		assert_true(fabs(found.objective - objective) <= 1e-12 * objective);
		assert_true(fabs(found.gradient_per_m - norm) <= 1e-9 * norm);
		oracle_energies energies;
		assert_true(oracle_energy(known.nx, known.nz, known.x, known.z, y, known.nodes, &energies));
		assert_true(fabs(found.fairness - (double)energies.bending) <=
		            1e-12 * (double)energies.bending);
		const double h2 = c.half_beam_m * c.half_beam_m;
		const oracle_problem close = search_case_oracle(&c, 0.0, h2 * h2);
		const double closeness = (double)oracle_objective(&close, y);
		assert_true(closeness > 0.0 && fabs(found.closeness_m4 - closeness) <= 1e-12 * closeness);
		free(gradient);
		free(y);
		search_case_close(&c);
	}
}

/* The estimate is the gap to the oracle's minimum: of searches ended early, and of whole ones of both
 * algorithms, in f32 and f64. */
static void check_gap(const search_case *c, const char *name, double w2)
{
	const batten_search_problem problem = search_case_problem(c, 1.0, w2);
	const oracle_problem known = search_case_oracle(c, 1.0, w2);
	oracle_minimum minimum;
	double *y = search_case_room(c);
	assert_true(oracle_minimise(&known, y, &minimum));
	batten_search_options whole = reference_options();
	whole.algorithm = BATTEN_ALGORITHM_MULTILEVEL; /* its steps end searches early as asked */
	const batten_certificate best = search_case_certify(c, &problem, &whole, y);
	assert_true(fabs(best.gap_estimate) < 1e-14);
	for (int run = 0; run < 6; run++) {
		batten_search_options options = whole;
		const bool early = run < 2;
		if (early)
			options.last_step = run ? 2e-5 : 1e-4;
		else
			options.precision = run % 2 ? BATTEN_F64 : BATTEN_F32;
		if (run > 3)
			options.algorithm = BATTEN_ALGORITHM_BLOCK;
		(void)search_case_run(c, &problem, &options, y);
		const batten_certificate found = search_case_certify(c, &problem, &options, y);
		const long double gap = oracle_objective(&known, y) / minimum.objective - 1.0L;
		print_message("%s w2/w1 %g run %d: gap %.3Le, estimate %.3e, gradient %.3e /m\n", name, w2,
		              run, gap, found.gap_estimate, found.gradient_per_m);
		assert_true(found.gap_estimate >= (early ? 0.5L : 0.9L) * gap - 1e-15L);
		/* Bounds are left aside: where offsets are still on their way to one the estimate is high. */
		assert_true(found.gap_estimate <= (early ? 10.0L : 1.1L) * gap + 1e-15L);
	}
	free(y);
}

static void test_estimate_is_the_gap(void **state)
{
	(void)state;
	for (size_t h = 0; h < HULL_COUNT; h++) {
		search_case c = search_case_open(hulls[h], 0.01, true);
		check_gap(&c, hulls[h], 1e3);
		check_gap(&c, hulls[h], 1e5);
		search_case_close(&c);
	}
}

/* Every fairness: what a search ended early still gains is what its certificate promised. */
static void test_estimate_of_every_fairness(void **state)
{
	(void)state;
	search_case c = search_case_open("npl_parent", 0.01, true);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	double *y = search_case_room(&c);
	for (int kind = 0; kind < 4; kind++) {
		batten_search_options options = reference_options();
		options.fairness = (batten_fairness)(kind % 3);
		options.longitudinal_weight = kind > 0 ? 4.0 : 1.0;
		options.last_step = 1e-9;
		(void)search_case_run(&c, &problem, &options, y);
		const batten_certificate end = search_case_certify(&c, &problem, &options, y);
		options.last_step = kind == 2 ? 1e-5 : 2e-4;
		(void)search_case_run(&c, &problem, &options, y);
		const batten_certificate early = search_case_certify(&c, &problem, &options, y);
		const double gap = early.objective / end.objective - 1.0;
		print_message("kind %d: gap %.3e, estimate %.3e; at the end %.3e\n", kind, gap,
		              early.gap_estimate, end.gap_estimate);
		assert_true(end.gap_estimate < 1e-10);
		assert_true(early.gap_estimate > 0.5 * gap && early.gap_estimate < 2.0 * gap);
	}
	free(y);
	search_case_close(&c);
}

/* Without closeness raw noise is no place near a minimum; a plane is one. */
static void test_where_there_is_none(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 1.2, false);
	batten_search_problem problem = search_case_problem(&c, 1.0, 0.0);
	const batten_search_options options = reference_options();
	batten_certificate found = search_case_certify(&c, &problem, &options, problem.start_m);
	assert_true(isnan(found.gap_estimate) && isnan(found.closeness_m4));
	assert_true(found.gradient_per_m > 0.0);
	assert_non_null(strstr(found.message, "positive definite"));
	problem.lower_m = problem.upper_m = problem.start_m;
	found = search_case_certify(&c, &problem, &options, problem.start_m);
	assert_int_equal(found.free_count, 0);
	assert_true(found.gap_estimate == 0.0 && found.gradient_per_m == 0.0);
	search_case_close(&c);
}

/* An invalid problem spoils no other; nor does the number of threads matter. */
static void test_batch(void **state)
{
	(void)state;
	enum { COUNT = 6 };
	search_case c = search_case_open("bsra_trawler", 0.01, false);
	batten_search_problem problems[COUNT];
	batten_certificate certificates[COUNT];
	const batten_search_options options = reference_options();
	batten_context_options chosen;
	batten_context_options_default(&chosen);
	chosen.threads = 3;
	batten_context *three = NULL;
	assert_int_equal(batten_context_create(&chosen, &three), BATTEN_OK);
	double *y = calloc(COUNT * c.nodes, sizeof *y);
	assert_non_null(y);
	for (size_t p = 0; p < COUNT; p++) {
		problems[p] = search_case_problem(&c, 1.0, pow(10.0, (double)p));
		for (size_t n = 0; n < c.nodes; n++)
			y[p * c.nodes + n] = batten_hull_y_m(c.hull)[n];
	}
	problems[2].half_beam_m = -1.0;
	for (size_t n = 0; n < c.nodes; n++)
		if (batten_hull_nodes(c.hull)[n] != BATTEN_NODE_OUTSIDE)
			y[4 * c.nodes + n] = NAN;
	assert_int_equal(
		batten_search_certify_batch(three, &c.grid, COUNT, problems, &options, y, certificates),
		BATTEN_INCOMPLETE);
	for (size_t p = 0; p < COUNT; p++) {
		if (p == 2 || p == 4) {
			assert_true(isnan(certificates[p].objective));
			assert_true(certificates[p].message[0] != '\0');
			continue;
		}
		const batten_certificate alone = search_case_certify(&c, &problems[p], &options,
		                                                     y + p * c.nodes);
		assert_memory_equal(&alone.objective, &certificates[p].objective, sizeof(double));
		assert_memory_equal(&alone.gap_estimate, &certificates[p].gap_estimate, sizeof(double));
	}
	free(y);
	batten_context_destroy(three);
	search_case_close(&c);
}

/* Polishing: from f32's end, from where a few iterations leave a search, and from the start, where there is no
 * estimate, to the oracle's minimum, in the box; a batch of threads as one by one. */
static void test_polish(void **state)
{
	(void)state;
	enum { COUNT = 5 };
	for (size_t h = 0; h < HULL_COUNT; h += 2) {
		search_case c = search_case_open(hulls[h], 0.01, true);
		batten_search_problem problems[COUNT];
		batten_certificate found[COUNT], alone;
		double *y = calloc((COUNT + 1) * c.nodes, sizeof *y);
		assert_non_null(y);
		batten_search_options options = reference_options();
		options.precision = BATTEN_F32;
		for (size_t p = 0; p < COUNT; p++) {
			problems[p] = search_case_problem(&c, 1.0, p == 4 ? 10.0 : p % 2 ? 1e5 : 1e3);
			options.iteration_limit = p < 2 ? 400 : 4;
			(void)search_case_run(&c, &problems[p], &options, y + p * c.nodes);
			if (p == 4)
				memcpy(y + p * c.nodes, problems[p].start_m, c.nodes * sizeof *y);
			const batten_certificate before = search_case_certify(&c, &problems[p], &options,
			                                                      y + p * c.nodes);
			assert_true(p == 4 ? isnan(before.gap_estimate) : before.gap_estimate > 1e-12);
		}
		memcpy(y + COUNT * c.nodes, y + 3 * c.nodes, c.nodes * sizeof *y);
		assert_int_equal(batten_search_polish_batch(c.context, &c.grid, COUNT, problems, &options,
		                                            1e-12, y, found),
		                 BATTEN_OK);
		assert_int_equal(batten_search_polish_batch(c.context, &c.grid, 1, &problems[3], &options,
		                                            1e-12, y + COUNT * c.nodes, &alone),
		                 BATTEN_OK);
		assert_memory_equal(y + COUNT * c.nodes, y + 3 * c.nodes, c.nodes * sizeof *y);
		assert_int_equal(alone.steps, found[3].steps);
		for (size_t p = 0; p < COUNT; p++) {
			const oracle_problem known = search_case_oracle(&c, 1.0, problems[p].w2);
			oracle_minimum minimum;
			assert_true(oracle_minimise(&known, y + COUNT * c.nodes, &minimum));
			const long double gap = oracle_objective(&known, y + p * c.nodes) / minimum.objective -
			                        1.0L;
			assert_true(found[p].steps > 0 && found[p].gap_estimate <= 1e-12);
			assert_true(fabsl(gap) <= 1e-11L);
			for (size_t n = 0; n < c.nodes; n++)
				if (batten_hull_nodes(c.hull)[n] != BATTEN_NODE_OUTSIDE)
					assert_true(y[p * c.nodes + n] >= problems[p].lower_m[n] &&
					            y[p * c.nodes + n] <= problems[p].upper_m[n]);
		}
		assert_int_equal(
			batten_search_polish_batch(c.context, &c.grid, 1, problems, &options, 0.0, y, found),
			BATTEN_USAGE);
		free(y);
		search_case_close(&c);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_gradient_is_the_oracles),
		cmocka_unit_test(test_estimate_is_the_gap),
		cmocka_unit_test(test_estimate_of_every_fairness),
		cmocka_unit_test(test_where_there_is_none),
		cmocka_unit_test(test_batch),
		cmocka_unit_test(test_polish),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
