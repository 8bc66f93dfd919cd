/* Bounds kept by an interior penalty: the same minimum as the box's, from inside; starts on bounds, boxes
 * without room; OpenCL against the C path; what is refused. */
#include "support/cases.h"
#include "support/failing_heap.h"
#include "support/search_equal.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COUNT = 3 };
static const double weights[COUNT] = { 10.0, 1e3, 1e5 };

static batten_search_options penalty_options(batten_precision precision)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.precision = precision;
	options.interior_penalty = true;
	return options;
}

static double *room_for(size_t count)
{
	double *room = calloc(count, sizeof *room);
	assert_non_null(room);
	return room;
}

/* All that can move inside its box, all else where it was; how many lie within a millionth of a bound. */
static size_t check_inside(const search_case *c, const double *y)
{
	size_t near = 0;
	for (size_t n = 0; n < c->nodes; n++) {
		const double width = c->upper_m[n] - c->lower_m[n];
		if (batten_hull_nodes(c->hull)[n] == BATTEN_NODE_OUTSIDE || width == 0.0) {
			assert_true(y[n] == batten_hull_y_m(c->hull)[n]);
			continue;
		}
		assert_true(y[n] > c->lower_m[n] && y[n] < c->upper_m[n]);
		near += fmin(y[n] - c->lower_m[n], c->upper_m[n] - y[n]) < 1e-6 * width;
	}
	return near;
}

/* The oracle's minimum in the box with every weight, which all precisions are judged by. */
static void find_minima(const search_case *c, long double minima[COUNT])
{
	double *y = room_for(c->nodes);
	for (size_t p = 0; p < COUNT; p++) {
		const oracle_problem known = search_case_oracle(c, 1.0, weights[p]);
		oracle_minimum minimum;
		assert_true(oracle_minimise(&known, y, &minimum));
		minima[p] = minimum.objective;
	}
	free(y);
}

/* Searches with every weight: at most `gap` above these minima, by estimates that tell how much. Returns how
 * many offsets bounds hold. */
static size_t check_minimum(const search_case *c, const long double minima[COUNT],
                            batten_precision precision, double gap)
{
	const batten_search_options options = penalty_options(precision);
	double *y = room_for(COUNT * c->nodes);
	batten_search_problem problems[COUNT];
	batten_search_result results[COUNT];
	batten_certificate found[COUNT];
	size_t held = 0;
	for (size_t p = 0; p < COUNT; p++)
		problems[p] = search_case_problem(c, 1.0, weights[p]);
	assert_int_equal(
		batten_search_batch(c->context, &c->grid, COUNT, problems, &options, y, results, NULL),
		BATTEN_OK);
	assert_int_equal(
		batten_search_certify_batch(c->context, &c->grid, COUNT, problems, &options, y, found),
		BATTEN_OK);
	for (size_t p = 0; p < COUNT; p++) {
		const oracle_problem known = search_case_oracle(c, 1.0, weights[p]);
		const long double above = oracle_objective(&known, y + p * c->nodes) / minima[p] - 1.0L;
		assert_int_equal(results[p].end, BATTEN_SEARCH_CONVERGED);
		assert_int_equal(results[p].algorithm, BATTEN_ALGORITHM_MULTILEVEL);
		assert_true(results[p].objective_end == found[p].objective);
		assert_true(above >= -1e-12L && above <= (long double)gap);
		assert_true(fabsl((long double)found[p].gap_estimate - above) <= 0.05L * above + 1e-12L);
		held += check_inside(c, y + p * c->nodes);
	}
	free(y);
	return held;
}

static void test_minimum_is_the_boxes(void **state)
{
	(void)state;
	static const struct {
		const char *hull;
		double part;
	} cases[] = { { "wigley_noisy", 0.01 },
		          { "wigley_noisy", 0.1 },
		          { "npl_parent", 0.01 },
		          { "bsra_trawler", 0.05 } };
	long double minima[COUNT];
	size_t held = 0;
	for (size_t i = 0; i < CASES(sizeof cases / sizeof cases[0], 1); i++) {
		search_case c = search_case_open(cases[i].hull, cases[i].part, true);
		find_minima(&c, minima);
		held += check_minimum(&c, minima, BATTEN_F64, 4e-9);
		(void)check_minimum(&c, minima, BATTEN_F32, 5e-5);
		search_case_close(&c);
	}
	assert_true(held > CASES(200, 0));
	/* Bounds so far away that none holds anything. */
	search_case c = search_case_open("wigley_noisy", 0.1, true);
	for (size_t n = 0; n < c.nodes; n++)
		if (c.lower_m[n] < c.upper_m[n]) {
			c.lower_m[n] = -2.0 * c.half_beam_m;
			c.upper_m[n] = 3.0 * c.half_beam_m;
		}
	find_minima(&c, minima);
	assert_int_equal(check_minimum(&c, minima, BATTEN_F64, 4e-9), 0);
	search_case_close(&c);
}

/* Starts on either bound; two stations held, one with no number of f32 between its bounds. */
static void test_starts_on_bounds_and_no_room(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 0.05, true);
	const double *y = batten_hull_y_m(c.hull);
	for (size_t n = 0; n < c.nodes; n++) {
		const size_t station = n % c.grid.station_count;
		if (!(y[n] > 0.0))
			continue;
		if (n % 3 == 0)
			c.lower_m[n] = y[n];
		else if (n % 3 == 1)
			c.upper_m[n] = y[n];
		if (station == 4 || station == 5)
			c.lower_m[n] = c.upper_m[n] = y[n];
	}
	long double minima[COUNT];
	find_minima(&c, minima);
	(void)check_minimum(&c, minima, BATTEN_F64, 4e-9);
	(void)check_minimum(&c, minima, BATTEN_F32, 5e-5);
	for (size_t n = 5; n < c.nodes; n += c.grid.station_count)
		c.upper_m[n] = nextafter(y[n], INFINITY);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e3);
	double *end = room_for(c.nodes);
	for (int p = 0; p < 2; p++) {
		const batten_search_options options = penalty_options(p ? BATTEN_F32 : BATTEN_F64);
		batten_search_result result;
		assert_int_equal(
			batten_search_batch(c.context, &c.grid, 1, &problem, &options, end, &result, NULL),
			BATTEN_OK);
		for (size_t n = 5; n < c.nodes; n += c.grid.station_count)
			assert_true(end[n] == y[n]);
	}
	/* No room at all: stationary, whatever the start. */
	memcpy(c.lower_m, y, c.nodes * sizeof *y);
	memcpy(c.upper_m, y, c.nodes * sizeof *y);
	const batten_search_options options = penalty_options(BATTEN_F64);
	batten_search_result result;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, &options, end, &result, NULL),
		BATTEN_OK);
	assert_int_equal(result.end, BATTEN_SEARCH_STATIONARY);
	assert_memory_equal(end, y, c.nodes * sizeof *y);
	free(end);
	search_case_close(&c);
}

/* In the shapes of CPUs; tests/slow has those of GPUs. */
static void test_opencl_equals_the_c_path(void **state)
{
	(void)state;
	search_case c = search_case_open("npl_parent", 0.01, true);
	search_equal_penalised(&c, BATTEN_F64, 8, 1);
	search_equal_penalised(&c, BATTEN_F32, 16, 1);
	search_case_close(&c);
}

/* The others of a batch, and one that is refused, change nothing; neither is its y written. */
static void test_batch_and_limit(void **state)
{
	(void)state;
	search_case c = search_case_open("bsra_trawler", 0.01, false);
	batten_search_options options = penalty_options(BATTEN_F64);
	double *y = room_for((COUNT + 1) * c.nodes);
	batten_search_problem problems[COUNT];
	batten_search_result results[COUNT], alone;
	for (size_t p = 0; p < COUNT; p++)
		problems[p] = search_case_problem(&c, 1.0, weights[p]);
	problems[1].half_beam_m = NAN;
	y[c.nodes] = 12345.0;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, COUNT, problems, &options, y, results, NULL),
		BATTEN_INCOMPLETE);
	assert_int_equal(results[1].end, BATTEN_SEARCH_REFUSED);
	assert_non_null(strstr(results[1].message, "half-beam"));
	assert_true(y[c.nodes] == 12345.0);
	for (size_t p = 0; p < COUNT; p += 2) {
		assert_int_equal(batten_search_batch(c.context, &c.grid, 1, &problems[p], &options,
		                                     y + COUNT * c.nodes, &alone, NULL),
		                 BATTEN_OK);
		assert_memory_equal(y + p * c.nodes, y + COUNT * c.nodes, c.nodes * sizeof *y);
		assert_true(alone.iterations == results[p].iterations && alone.probes == results[p].probes);
	}
	options.iteration_limit = 1;
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, problems, &options, y, results, NULL),
		BATTEN_INCOMPLETE);
	assert_int_equal(results[0].end, BATTEN_SEARCH_LIMIT);
	free(y);
	search_case_close(&c);
}

static void expect_usage(batten_context *context, batten_status status, const char *text)
{
	assert_int_equal(status, BATTEN_USAGE);
	if (!strstr(batten_context_error(context), text))
		fail_msg("found: %s", batten_context_error(context));
}

static void test_who_takes_it(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 0.01, false);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e3);
	batten_search_options options = penalty_options(BATTEN_F64);
	batten_search_result result;
	batten_certificate certificate;
	double *y = room_for(c.nodes);
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	expect_usage(c.context,
	             batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &result, NULL),
	             "the block search");
	options.algorithm = BATTEN_ALGORITHM_TEXTBOOK;
	expect_usage(c.context,
	             batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &result, NULL),
	             "the textbook search");
	options.algorithm = BATTEN_ALGORITHM_AUTO;
	expect_usage(c.context,
	             batten_search_polish_batch(c.context, &c.grid, 1, &problem, &options, 1e-9, y,
	                                        &certificate),
	             "none is polished");
	batten_fairing *fairing = NULL;
	batten_fair_options fair;
	batten_fair_options_default(&fair);
	fair.search.interior_penalty = true;
	fair.polish_gap = 1e-9;
	expect_usage(c.context, batten_hull_fair(c.context, c.hull, &fair, &fairing), "polished");
	fair.polish_gap = 0.0;
	fair.variables = BATTEN_VARIABLES_NET;
	expect_usage(c.context, batten_hull_fair(c.context, c.hull, &fair, &fairing), "nets");
	assert_null(fairing);
	free(y);
	search_case_close(&c);
}

static batten_status search_once(batten_context *context, void *user)
{
	const search_case *c = user;
	const batten_search_problem problem = search_case_problem(c, 1.0, 1e4);
	batten_search_options options = penalty_options(BATTEN_F64);
	options.iteration_limit = 1;
	double *y = room_for(c->nodes);
	batten_search_result result;
	const batten_status status = batten_search_batch(context, &c->grid, 1, &problem, &options, y,
	                                                 &result, NULL);
	free(y);
	return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
}

static void test_failing_memory(void **state)
{
	(void)state;
	search_case c = search_case_open("bsra_trawler", 0.01, false);
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	assert_true(failing_heap_each(&heap, context, search_once, &c) > 20);
	failing_heap_close(&heap, context);
	search_case_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_minimum_is_the_boxes),
		cmocka_unit_test(test_starts_on_bounds_and_no_room),
		cmocka_unit_test(test_opencl_equals_the_c_path),
		cmocka_unit_test(test_batch_and_limit),
		cmocka_unit_test(test_who_takes_it),
		cmocka_unit_test(test_failing_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
