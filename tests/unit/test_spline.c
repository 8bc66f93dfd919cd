/* Cubic splines against closed forms (Letcher 3.5) and hand-computed cases of mixed ends. */
#include "core/spline.h"
#include "oracle/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define CLAMPED(slope) ((struct spline_condition){ SPLINE_CLAMPED, slope })

enum { POINTS = 7 };
static const double uneven[POINTS] = { -1, -0.7, 0.1, 0.4, 1.6, 1.7, 3 };

static int make_context(void **state)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	*state = context;
	return 0;
}

static int end_context(void **state)
{
	batten_context_destroy(*state);
	return 0;
}

static void assert_close(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.17g, expected %.17g within %g", found, expected, tolerance);
}

static double cubic(double x)
{
	return 2 - 3 * x + 0.5 * x * x + 0.25 * x * x * x;
}

static double cubic_slope(double x)
{
	return -3 + x + 0.75 * x * x;
}

static void natural_through_three_points(void **state)
{
	struct spline spline;
	assert_int_equal(spline_create(*state, 3, (double[]){ 0, 1, 2 }, (double[]){ 0, 1, 0 },
	                               SPLINE_NATURAL, &spline),
	                 BATTEN_OK);
	assert_close(spline_second(&spline, 1), -3, 1e-15);
	assert_close(spline_second(&spline, 0), 0, 0);
	assert_close(spline_second(&spline, 2), 0, 0);
	assert_close(spline_value(&spline, 0.5), 0.6875, 1e-15);
	assert_close(spline_value(&spline, 1.5), 0.6875, 1e-15);
	assert_close(spline_slope(&spline, 1), 0, 1e-15);
	assert_close(spline_slope(&spline, 0), 1.5, 1e-15);
	/* Straight beyond its ends. */
	assert_close(spline_value(&spline, -1), -1.5, 1e-15);
	assert_close(spline_value(&spline, 4), -3, 1e-15);
	assert_close(spline_second(&spline, 4), 0, 0);
	spline_destroy(&spline);
}

/* From a little before the first point to a little beyond the last. */
static void check_cubic(const struct spline *spline)
{
	double a = spline->x[0] - 0.25;
	double b = spline->x[spline->count - 1] + 0.25;
	for (int i = 0; i <= 100; i++) {
		double x = a + (b - a) * i / 100;
		assert_close(spline_value(spline, x), cubic(x), 3e-14);
		assert_close(spline_slope(spline, x), cubic_slope(x), 1e-13);
		assert_close(spline_second(spline, x), 1 + 1.5 * x, 5e-13);
	}
}

static void cubic_comes_back(void **state)
{
	double y[POINTS];
	for (size_t i = 0; i < POINTS; i++)
		y[i] = cubic(uneven[i]);
	struct spline spline;
	for (size_t count = 4; count <= POINTS; count++) {
		assert_int_equal(spline_create(*state, count, uneven, y, SPLINE_NOT_A_KNOT, &spline),
		                 BATTEN_OK);
		check_cubic(&spline);
		spline_destroy(&spline);
	}
	for (size_t count = 2; count <= POINTS; count++) {
		assert_int_equal(spline_create_mixed(*state, count, uneven, y,
		                                     CLAMPED(cubic_slope(uneven[0])),
		                                     CLAMPED(cubic_slope(uneven[count - 1])), &spline),
		                 BATTEN_OK);
		check_cubic(&spline);
		spline_destroy(&spline);
	}
}

static void few_points(void **state)
{
	const double x[] = { 1, 2, 4 };
	const double y[] = { 3, 1, 7 };
	struct spline spline;
	for (int ends = SPLINE_NATURAL; ends <= SPLINE_NOT_A_KNOT; ends++) {
		assert_int_equal(spline_create(*state, 2, x, y, (enum spline_end)ends, &spline), BATTEN_OK);
		assert_close(spline_value(&spline, 1.25), 2.5, 1e-15);
		assert_close(spline_value(&spline, 3), -1, 1e-15);
		spline_destroy(&spline);
	}
	/* The parabola 3 - 2 (x-1) + 5/3 (x-1)(x-2). */
	assert_int_equal(spline_create(*state, 3, x, y, SPLINE_NOT_A_KNOT, &spline), BATTEN_OK);
	for (int i = 0; i < 20; i++) {
		double at = i * 0.25;
		assert_close(spline_value(&spline, at), 3 - 2 * (at - 1) + (at - 1) * (at - 2) * 5 / 3,
		             1e-14);
	}
	spline_destroy(&spline);
}

/* A spline of no special kind: continuity and end conditions. */
static void check_general(const struct spline *spline, const double *y)
{
	for (size_t i = 0; i < POINTS; i++)
		assert_true(spline_value(spline, uneven[i]) == y[i]);
	for (size_t i = 1; i + 1 < POINTS; i++) {
		double before = nextafter(uneven[i], -10);
		assert_close(spline_slope(spline, before), spline_slope(spline, uneven[i]), 1e-12);
		assert_close(spline_second(spline, before), spline_second(spline, uneven[i]), 1e-11);
	}
}

static void general(void **state)
{
	const double y[POINTS] = { 0.2, 1, -0.3, 0.5, 1.1, 0.9, -0.4 };
	struct spline spline;
	assert_int_equal(spline_create(*state, POINTS, uneven, y, SPLINE_NATURAL, &spline), BATTEN_OK);
	check_general(&spline, y);
	assert_close(spline_second(&spline, uneven[0]), 0, 0);
	assert_close(spline_second(&spline, uneven[POINTS - 1]), 0, 0);
	spline_destroy(&spline);
	assert_int_equal(spline_create(*state, POINTS, uneven, y, SPLINE_NOT_A_KNOT, &spline),
	                 BATTEN_OK);
	check_general(&spline, y);
	/* One third derivative on the first two and on the last two intervals. */
	const double *m = spline.second;
	assert_close((m[1] - m[0]) / (uneven[1] - uneven[0]), (m[2] - m[1]) / (uneven[2] - uneven[1]),
	             1e-12);
	assert_close((m[6] - m[5]) / (uneven[6] - uneven[5]), (m[5] - m[4]) / (uneven[5] - uneven[4]),
	             1e-12);
	spline_destroy(&spline);
	assert_int_equal(
		spline_create_mixed(*state, POINTS, uneven, y, CLAMPED(2.5), CLAMPED(-1.25), &spline),
		BATTEN_OK);
	check_general(&spline, y);
	assert_close(spline_slope(&spline, uneven[0]), 2.5, 1e-14);
	assert_close(spline_slope(&spline, uneven[POINTS - 1]), -1.25, 1e-14);
	spline_destroy(&spline);
}

/* Second derivatives at the points (0,0), (1,1), (2,0) by hand: 2 M0 + M1 = 6 (1 - slope) where the
 * first end is clamped, M0 + 4 M1 + M2 = -12, M1 = (M0 + M2) / 2 where an end is not-a-knot. */
static void mixed_ends_by_hand(void **state)
{
	static const struct {
		struct spline_condition first, last;
		double second[3];
	} cases[] = {
		{ { SPLINE_CLAMPED, 0 }, { SPLINE_NATURAL, 0 }, { 36.0 / 7, -30.0 / 7, 0 } },
		{ { SPLINE_NATURAL, 0 }, { SPLINE_CLAMPED, 0 }, { 0, -30.0 / 7, 36.0 / 7 } },
		{ { SPLINE_BENT, 2 }, { SPLINE_NOT_A_KNOT, 0 }, { 2, -2, -6 } },
		{ { SPLINE_NOT_A_KNOT, 0 }, { SPLINE_BENT, 2 }, { -6, -2, 2 } },
		{ { SPLINE_NATURAL, 0 }, { SPLINE_NOT_A_KNOT, 0 }, { 0, -2, -4 } },
		{ { SPLINE_CLAMPED, 0 }, { SPLINE_NOT_A_KNOT, 0 }, { 4, -2, -8 } },
		{ { SPLINE_BENT, 4 }, { SPLINE_BENT, -4 }, { 4, -3, -4 } },
		{ { SPLINE_CLAMPED, 1 }, { SPLINE_BENT, 0 }, { 12.0 / 7, -24.0 / 7, 0 } },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		struct spline spline;
		assert_int_equal(spline_create_mixed(*state, 3, (double[]){ 0, 1, 2 },
		                                     (double[]){ 0, 1, 0 }, cases[i].first, cases[i].last,
		                                     &spline),
		                 BATTEN_OK);
		for (size_t k = 0; k < 3; k++)
			assert_close(spline.second[k], cases[i].second[k], 1e-14);
		double found[SPLINE_DERIVATIVES];
		spline_derivatives(&spline, 0.5, found);
		assert_close(found[3], cases[i].second[1] - cases[i].second[0], 1e-14);
		spline_destroy(&spline);
	}
}

/* The chord (0,0), (2,2): where a not-a-knot end has no neighbour the spline is a parabola. */
static void mixed_ends_of_two_points(void **state)
{
	static const struct {
		struct spline_condition first, last;
		double second[2];
	} cases[] = {
		{ { SPLINE_CLAMPED, 0 }, { SPLINE_NOT_A_KNOT, 0 }, { 1, 1 } },
		{ { SPLINE_NOT_A_KNOT, 0 }, { SPLINE_CLAMPED, 2 }, { 1, 1 } },
		{ { SPLINE_NATURAL, 0 }, { SPLINE_CLAMPED, 4 }, { 0, 4.5 } },
		{ { SPLINE_BENT, 3 }, { SPLINE_NOT_A_KNOT, 0 }, { 3, 3 } },
		{ { SPLINE_NATURAL, 0 }, { SPLINE_NOT_A_KNOT, 0 }, { 0, 0 } },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		struct spline spline;
		assert_int_equal(spline_create_mixed(*state, 2, (double[]){ 0, 2 }, (double[]){ 0, 2 },
		                                     cases[i].first, cases[i].last, &spline),
		                 BATTEN_OK);
		for (size_t k = 0; k < 2; k++)
			assert_close(spline.second[k], cases[i].second[k], 1e-14);
		spline_destroy(&spline);
	}
}

/* Only a natural end goes on straight. */
static void beyond_mixed_ends(void **state)
{
	struct spline spline;
	assert_int_equal(spline_create_mixed(*state, 3, (double[]){ 0, 1, 2 }, (double[]){ 0, 1, 0 },
	                                     (struct spline_condition){ SPLINE_NATURAL, 0 },
	                                     (struct spline_condition){ SPLINE_NOT_A_KNOT, 0 },
	                                     &spline),
	                 BATTEN_OK);
	/* y = 4/3 x - x^3 / 3 all along. */
	assert_close(spline_value(&spline, 3), 4 - 9, 1e-14);
	assert_close(spline_value(&spline, -3), -4, 1e-14);
	assert_close(spline_second(&spline, 3), -6, 1e-14);
	assert_close(spline_second(&spline, -3), 0, 0);
	spline_destroy(&spline);
}

static void wrong_arguments(void **state)
{
	const double y[] = { 0, 0, 0 };
	struct spline spline;
	assert_int_equal(spline_create(*state, 1, y, y, SPLINE_NATURAL, &spline), BATTEN_USAGE);
	assert_int_equal(spline_create(*state, 3, (double[]){ 0, 1, 1 }, y, SPLINE_NATURAL, &spline),
	                 BATTEN_USAGE);
	assert_int_equal(spline_create(*state, 3, (double[]){ 0, 1, NAN }, y, SPLINE_NATURAL, &spline),
	                 BATTEN_USAGE);
	assert_int_equal(spline_create(*state, 3, (double[]){ 0, 1, 2 }, (double[]){ 0, INFINITY, 0 },
	                               SPLINE_NATURAL, &spline),
	                 BATTEN_USAGE);
	assert_int_equal(spline_create(*state, 3, (double[]){ 0, 1, 2 }, y, SPLINE_CLAMPED, &spline),
	                 BATTEN_USAGE);
	assert_int_equal(
		spline_create_mixed(*state, 3, (double[]){ 0, 1, 2 }, y, CLAMPED(NAN), CLAMPED(0), &spline),
		BATTEN_USAGE);
	assert_null(spline.x);
	spline_destroy(&spline);
}

/* Every pair of conditions against the oracle, which solves for all coefficients at once: values,
 * slopes and second derivatives within the points, from two points on, at uneven spacing. */
static void every_pair_of_ends_is_the_oracles(void **state)
{
	static const struct {
		struct spline_condition given;
		oracle_condition known;
	} ends[] = {
		{ { SPLINE_NATURAL, 0 }, { ORACLE_FREE, 0 } },
		{ { SPLINE_NOT_A_KNOT, 0 }, { ORACLE_JOINED, 0 } },
		{ { SPLINE_CLAMPED, -1.75 }, { ORACLE_SLOPE, -1.75 } },
		{ { SPLINE_BENT, 3.5 }, { ORACLE_BEND, 3.5 } },
	};
	enum { ENDS = sizeof ends / sizeof ends[0] };
	static const double y[POINTS] = { 0.3, -0.2, 1.1, 0.9, -2, -1.4, 0.5 };
	for (size_t count = 2; count <= POINTS; count++)
		for (size_t pair = 0; pair < (size_t)ENDS * ENDS; pair++) {
			const size_t a = pair / ENDS, b = pair % ENDS;
			struct spline spline;
			assert_int_equal(spline_create_mixed(*state, count, uneven, y, ends[a].given,
			                                     ends[b].given, &spline),
			                 BATTEN_OK);
			for (int k = 0; k <= 40; k++) {
				const double at = uneven[0] + k / 40.0 * (uneven[count - 1] - uneven[0]);
				long double known[3];
				assert_true(
					oracle_spline_mixed(count, uneven, y, ends[a].known, ends[b].known, at, known));
				/* The second derivatives reach 60 where spacings are 0.1. */
				assert_close(spline_value(&spline, at), (double)known[0], 1e-13);
				assert_close(spline_slope(&spline, at), (double)known[1], 1e-12);
				assert_close(spline_second(&spline, at), (double)known[2], 1e-11);
			}
			spline_destroy(&spline);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(natural_through_three_points, make_context, end_context),
		cmocka_unit_test_setup_teardown(cubic_comes_back, make_context, end_context),
		cmocka_unit_test_setup_teardown(few_points, make_context, end_context),
		cmocka_unit_test_setup_teardown(general, make_context, end_context),
		cmocka_unit_test_setup_teardown(mixed_ends_by_hand, make_context, end_context),
		cmocka_unit_test_setup_teardown(mixed_ends_of_two_points, make_context, end_context),
		cmocka_unit_test_setup_teardown(beyond_mixed_ends, make_context, end_context),
		cmocka_unit_test_setup_teardown(wrong_arguments, make_context, end_context),
		cmocka_unit_test_setup_teardown(every_pair_of_ends_is_the_oracles, make_context,
		                                end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
