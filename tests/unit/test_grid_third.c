/* The variation of curvature as the fairness of a search over offsets: its objective against the measure of
 * the hull, its ends against Newton's method, C against the device. What it sums: test_grid_variation.c. */
#include "support/cases.h"
#include "support/search_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static batten_search_options options_of(unsigned iterations)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.fairness = BATTEN_FAIRNESS_VARIATION;
	options.iteration_limit = iterations;
	return options;
}

static const char *const hulls[] = { "npl_parent", "bsra_trawler", "wigley", "highspeed_craft" };
enum { HULL_COUNT = 4, SMOOTH_COUNT = 3 };

/* h^2 times what batten_hull_measure() finds, by sums of its own. */
static void test_objective_is_the_measure(void **state)
{
	(void)state;
	for (size_t h = 0; h < HULL_COUNT; h++) {
		search_case c = search_case_open(hulls[h], 0.01, false);
		const batten_search_problem problem = search_case_problem(&c, 1.0, 0.0);
		const batten_search_options options = options_of(1);
		batten_measure_options how;
		batten_measures measures;
		double *y = search_case_room(&c);
		batten_measure_options_default(&how);
		how.quadrature = BATTEN_QUADRATURE_TRAPEZOID;
		assert_int_equal(batten_hull_measure(c.context, c.hull, &how, &measures), BATTEN_OK);
		const double known = measures.energy_mvc_per_m2 * c.half_beam_m * c.half_beam_m;
		const batten_search_result result = search_case_run(&c, &problem, &options, y);
		assert_true(fabs(result.objective_start / known - 1.0) < 1e-11);
		const batten_certificate found = search_case_certify(&c, &problem, &options,
		                                                     problem.start_m);
		assert_true(fabs(found.objective / known - 1.0) < 1e-11);
		assert_true(fabs(found.fairness / measures.energy_mvc_per_m2 - 1.0) < 1e-11);
		free(y);
		search_case_close(&c);
	}
}

/* What a whole search leaves, Newton's method gains, and the certificate has promised; not on the hull with
 * a chine, where the Hessian of what is found is not positive definite. */
static void test_gap(void **state)
{
	(void)state;
	for (size_t h = 0; h < SMOOTH_COUNT; h++) {
		search_case c = search_case_open(hulls[h], 0.01, true);
		const batten_search_problem problem = search_case_problem(&c, 1.0, 1e6);
		double *y = search_case_room(&c);
		for (int precision = 0; precision < 2; precision++) {
			batten_search_options options = options_of(400);
			batten_certificate end;
			options.precision = precision ? BATTEN_F32 : BATTEN_F64;
			const batten_search_result result = search_case_run(&c, &problem, &options, y);
			const batten_certificate before = search_case_certify(&c, &problem, &options, y);
			assert_int_equal(batten_search_polish_batch(c.context, &c.grid, 1, &problem, &options,
			                                            1e-12, y, &end),
			                 BATTEN_OK);
			const double gain = before.objective / end.objective - 1.0;
			print_message("%s %s: %u iterations, promised %.2e, gained %.2e in %u steps\n",
			              hulls[h], precision ? "f32" : "f64", result.iterations,
			              before.gap_estimate, gain, end.steps);
			assert_int_equal(result.end, BATTEN_SEARCH_CONVERGED);
			assert_true(fabs(result.objective_end / before.objective - 1.0) <
			            (precision ? 1e-3 : 1e-11));
			assert_true(before.gap_estimate < (precision ? 3e-4 : 1e-6));
			assert_true(gain >= 0.0 && fabs(gain - before.gap_estimate) <= 0.1 * gain + 1e-12);
		}
		free(y);
		search_case_close(&c);
	}
}

/* The same from the device, in both precisions, and by the textbook search. */
static void test_device(void **state)
{
	(void)state;
	search_case c = search_case_open("npl_parent", 0.01, true);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e5);
	double *known = search_case_room(&c);
	double *found = search_case_room(&c);
	for (int run = 0; run < 3; run++) {
		batten_search_options options = options_of(run == 2 ? CASES(3, 1) : CASES(12, 3));
		options.precision = run == 1 ? BATTEN_F32 : BATTEN_F64;
		options.algorithm = run == 2 ? BATTEN_ALGORITHM_TEXTBOOK : BATTEN_ALGORITHM_AUTO;
		const batten_search_result a = search_case_run(&c, &problem, &options, known);
		options.device = 0;
		const batten_search_result b = search_case_run(&c, &problem, &options, found);
		assert_memory_equal(known, found, c.nodes * sizeof *known);
		assert_true(a.objective_end == b.objective_end && a.probes == b.probes);
		assert_int_equal(a.algorithm,
		                 run == 2 ? BATTEN_ALGORITHM_TEXTBOOK : BATTEN_ALGORITHM_MULTILEVEL);
	}
	free(found);
	free(known);
	search_case_close(&c);
}

/* Both directions count alike, and lines go with bending alone. */
static void test_refusals(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley", 0.01, false);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e5);
	double *y = search_case_room(&c);
	batten_search_result result;
	batten_search_options options = options_of(1);
	options.longitudinal_weight = 4.0;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &result, NULL),
		BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(c.context), "principal directions"));
	options = options_of(1);
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &result, NULL),
		BATTEN_USAGE);
	free(y);
	search_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_objective_is_the_measure),
		cmocka_unit_test(test_gap),
		cmocka_unit_test(test_device),
		cmocka_unit_test(test_refusals),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
