/* The fairness-closeness front of a hull. */
#include "batten.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { COUNT = 7 };

typedef struct fixture {
	batten_context *context;
	batten_hull *hull;
	batten_fair_options options;
} fixture;

static int set_up(void **state)
{
	static fixture f;
	assert_int_equal(batten_context_create(NULL, &f.context), BATTEN_OK);
	assert_int_equal(
		batten_hull_read(f.context, BATTEN_DATA_DIR "/hulls/highspeed_craft.csv", &f.hull),
		BATTEN_OK);
	batten_fair_options_default(&f.options);
	f.options.search.device = BATTEN_DEVICE_REFERENCE;
	*state = &f;
	return 0;
}

static int tear_down(void **state)
{
	fixture *f = *state;
	batten_hull_destroy(f->hull);
	batten_context_destroy(f->context);
	return 0;
}

/* As w2/w1 grows fairness rises and closeness falls, no point is dominated, each is at its
 * minimum, and a point is what a fairing with its weights comes to. */
static void test_front(void **state)
{
	fixture *f = *state;
	batten_front_point points[COUNT];
	batten_run run;
	assert_int_equal(
		batten_hull_front(f->context, f->hull, &f->options, 10.0, 1e7, COUNT, points, &run),
		BATTEN_OK);
	assert_true(run.device[0] && run.strict && run.warning[0] == 0);
	for (int p = 0; p < COUNT; p++) {
		assert_true(fabs(points[p].ratio - pow(10.0, p + 1)) <= 1e-12 * points[p].ratio);
		assert_false(points[p].dominated);
		assert_int_equal(points[p].result.end, BATTEN_SEARCH_CONVERGED);
		assert_true(points[p].gap_estimate >= 0.0 && points[p].gap_estimate <= 1e-8);
		if (p == 0)
			continue;
		assert_true(points[p].fairness > points[p - 1].fairness);
		assert_true(points[p].closeness.closeness_m4 < points[p - 1].closeness.closeness_m4);
	}
	batten_fairing *fairing = NULL;
	batten_measures measures;
	batten_closeness closeness;
	f->options.weights_given = true;
	f->options.w1 = 1.0;
	f->options.w2 = points[3].ratio;
	assert_int_equal(batten_hull_fair(f->context, f->hull, &f->options, &fairing), BATTEN_OK);
	f->options.weights_given = false;
	assert_int_equal(
		batten_hull_measure(f->context, batten_fairing_faired(fairing), NULL, &measures),
		BATTEN_OK);
	assert_int_equal(batten_hull_closeness(f->context, batten_fairing_faired(fairing),
	                                       batten_fairing_smoothed(fairing), &closeness),
	                 BATTEN_OK);
	assert_true(fabs(measures.energy_bending - points[3].fairness) <=
	            1e-12 * measures.energy_bending);
	assert_true(fabs(closeness.cn_rms_m - points[3].closeness.cn_rms_m) <=
	            1e-9 * closeness.cn_rms_m);
	batten_fairing_destroy(fairing);
}

/* Searches that end early leave the front: what is worse in both is dominated. */
static void test_dominated(void **state)
{
	fixture *f = *state;
	batten_front_point points[COUNT];
	f->options.search.iteration_limit = 1;
	assert_int_equal(
		batten_hull_front(f->context, f->hull, &f->options, 1e-3, 1e3, COUNT, points, NULL),
		BATTEN_INCOMPLETE);
	f->options.search.iteration_limit = 400;
	for (int a = 0; a < COUNT; a++) {
		bool dominated = false;
		for (int b = 0; b < COUNT; b++)
			dominated = dominated ||
			            (points[b].fairness <= points[a].fairness &&
			             points[b].closeness.closeness_m4 <= points[a].closeness.closeness_m4 &&
			             (points[b].fairness < points[a].fairness ||
			              points[b].closeness.closeness_m4 < points[a].closeness.closeness_m4));
		assert_int_equal(points[a].dominated, dominated);
		assert_int_equal(points[a].result.end, BATTEN_SEARCH_LIMIT);
	}
}

static void test_refusals(void **state)
{
	fixture *f = *state;
	batten_front_point points[COUNT];
	const struct {
		double low, high;
		size_t count;
	} ranges[] = { { 0.0, 1.0, 3 },      { -1.0, 1.0, 3 },  { 2.0, 1.0, 3 }, { 1.0, 1.0, 3 },
		           { 1.0, INFINITY, 3 }, { NAN, 1.0, 3 },   { 1.0, NAN, 3 }, { 1.0, 2.0, 1 },
		           { 1.0, 2.0, 0 },      { 1.0, 2.0, 5000 } };
	for (size_t r = 0; r < sizeof ranges / sizeof ranges[0]; r++)
		assert_int_equal(batten_hull_front(f->context, f->hull, &f->options, ranges[r].low,
		                                   ranges[r].high, ranges[r].count, points, NULL),
		                 BATTEN_USAGE);
	batten_fair_options options = f->options;
	options.weights_given = true;
	options.w1 = options.w2 = 1.0;
	assert_int_equal(
		batten_hull_front(f->context, f->hull, &options, 1.0, 2.0, COUNT, points, NULL),
		BATTEN_USAGE);
	options = f->options;
	options.method = BATTEN_METHOD_SMOOTH;
	assert_int_equal(
		batten_hull_front(f->context, f->hull, &options, 1.0, 2.0, COUNT, points, NULL),
		BATTEN_USAGE);
	assert_int_equal(batten_picture_front(f->context, "none", 1, points, "none.svg"), BATTEN_USAGE);
}

/* Each point keeps what a fairing with its weights keeps, at the same objective; a measure that bounds forbid is
 * named. */
static void test_front_keeps_measures(void **state)
{
	fixture *f = *state;
	enum { FEW = 4 };
	size_t volume = 0;
	while (strcmp(batten_hydrostatics_name(volume), "volume_m3") != 0)
		volume++;
	const batten_keep keep = { volume, 1e-5, true };
	batten_fair_options options = f->options;
	batten_front_point points[FEW], free_points[FEW];
	unsigned held = 0;
	assert_int_equal(
		batten_hull_front(f->context, f->hull, &options, 1e3, 1e6, FEW, free_points, NULL),
		BATTEN_OK);
	options.keep = &keep;
	options.keep_count = 1;
	assert_int_equal(batten_hull_front(f->context, f->hull, &options, 1e3, 1e6, FEW, points, NULL),
	                 BATTEN_OK);
	options.weights_given = true;
	options.w1 = 1.0;
	for (int p = 0; p < FEW; p++) {
		batten_fairing *fairing = NULL;
		size_t count = 0;
		options.w2 = points[p].ratio;
		assert_int_equal(batten_hull_fair(f->context, f->hull, &options, &fairing), BATTEN_OK);
		const batten_kept *kept = batten_fairing_kept(fairing, &count, NULL);
		assert_int_equal(points[p].kept[0].quantity, volume);
		assert_true(points[p].kept[0].value == kept->value);
		assert_true(fabs(points[p].kept[0].value - kept->wanted) <= kept->tolerance);
		assert_true(points[p].result.objective_end ==
		            batten_fairing_result(fairing)->objective_end);
		assert_true(points[p].gap_estimate <= 1e-6);
		if (kept->multiplier != 0.0) {
			held++;
			assert_true(points[p].result.objective_end > free_points[p].result.objective_end);
		}
		batten_fairing_destroy(fairing);
	}
	assert_true(held > 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_front),
		cmocka_unit_test(test_front_keeps_measures),
		cmocka_unit_test(test_dominated),
		cmocka_unit_test(test_refusals),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
