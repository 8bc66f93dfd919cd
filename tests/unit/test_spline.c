/* Cubic splines against closed forms (Letcher 3.5) and against sums over many small steps. */
#include "core/spline.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

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

/* Integral of the cubic, and of x and x^2 times it, from 0. */
static double cubic_integral(double x)
{
	return 2 * x - 1.5 * x * x + x * x * x / 6 + x * x * x * x / 16;
}

static double cubic_moment(double x)
{
	return x * x - x * x * x + x * x * x * x / 8 + x * x * x * x * x / 20;
}

static double cubic_second_moment(double x)
{
	double x3 = x * x * x;
	return 2 * x3 / 3 - 0.75 * x3 * x + 0.1 * x3 * x * x + x3 * x3 / 24;
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
	assert_close(spline_integral(&spline, 0, 2), 1.25, 1e-15);
	/* Straight beyond its ends. */
	assert_close(spline_value(&spline, -1), -1.5, 1e-15);
	assert_close(spline_value(&spline, 4), -3, 1e-15);
	assert_close(spline_second(&spline, 4), 0, 0);
	assert_close(spline_integral(&spline, -2, 0), -3, 1e-15);
	assert_close(spline_integral(&spline, 2, 4), -3, 1e-15);
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
	assert_close(spline_integral(spline, a, b), cubic_integral(b) - cubic_integral(a), 1e-13);
	assert_close(spline_moment(spline, a, b), cubic_moment(b) - cubic_moment(a), 1e-13);
	assert_close(spline_second_moment(spline, a, b),
	             cubic_second_moment(b) - cubic_second_moment(a), 1e-13);
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
		assert_int_equal(spline_create_clamped(*state, count, uneven, y, cubic_slope(uneven[0]),
		                                       cubic_slope(uneven[count - 1]), &spline),
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
		assert_int_equal(spline_create(*state, 2, x, y, (enum spline_ends)ends, &spline),
		                 BATTEN_OK);
		assert_close(spline_value(&spline, 1.25), 2.5, 1e-15);
		assert_close(spline_value(&spline, 3), -1, 1e-15);
		assert_close(spline_integral(&spline, 1, 2), 2, 1e-15);
		assert_close(spline_cube(&spline, 1, 2), 10, 1e-14);
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

/* A spline of no special kind: continuity, end conditions, and integrals against fine sums. */
static void check_general(const struct spline *spline, const double *y)
{
	for (size_t i = 0; i < POINTS; i++)
		assert_true(spline_value(spline, uneven[i]) == y[i]);
	for (size_t i = 1; i + 1 < POINTS; i++) {
		double before = nextafter(uneven[i], -10);
		assert_close(spline_slope(spline, before), spline_slope(spline, uneven[i]), 1e-12);
		assert_close(spline_second(spline, before), spline_second(spline, uneven[i]), 1e-11);
	}
	enum { STEPS = 200000 };
	double a = -0.85;
	double b = 2.9;
	double step = (b - a) / STEPS;
	double sums[5] = { 0 };
	for (int i = 0; i < STEPS; i++) {
		double x = a + (i + 0.5) * step;
		double value = spline_value(spline, x);
		sums[0] += value * step;
		sums[1] += x * value * step;
		sums[2] += x * x * value * step;
		sums[3] += value * value * step;
		sums[4] += value * value * value * step;
	}
	assert_close(spline_integral(spline, a, b), sums[0], 1e-8);
	assert_close(spline_moment(spline, a, b), sums[1], 1e-8);
	assert_close(spline_second_moment(spline, a, b), sums[2], 1e-8);
	assert_close(spline_square(spline, a, b), sums[3], 1e-8);
	assert_close(spline_cube(spline, a, b), sums[4], 1e-8);
	assert_true(spline_cube(spline, b, a) == -spline_cube(spline, a, b));
	assert_true(spline_cube(spline, a, a) == 0);
	assert_close(spline_cube(spline, a, 0.4) + spline_cube(spline, 0.4, b),
	             spline_cube(spline, a, b), 1e-13);
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
	assert_int_equal(spline_create_clamped(*state, POINTS, uneven, y, 2.5, -1.25, &spline),
	                 BATTEN_OK);
	check_general(&spline, y);
	assert_close(spline_slope(&spline, uneven[0]), 2.5, 1e-14);
	assert_close(spline_slope(&spline, uneven[POINTS - 1]), -1.25, 1e-14);
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
	assert_int_equal(spline_create_clamped(*state, 3, (double[]){ 0, 1, 2 }, y, NAN, 0, &spline),
	                 BATTEN_USAGE);
	assert_null(spline.x);
	spline_destroy(&spline);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(natural_through_three_points, make_context, end_context),
		cmocka_unit_test_setup_teardown(cubic_comes_back, make_context, end_context),
		cmocka_unit_test_setup_teardown(few_points, make_context, end_context),
		cmocka_unit_test_setup_teardown(general, make_context, end_context),
		cmocka_unit_test_setup_teardown(wrong_arguments, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
