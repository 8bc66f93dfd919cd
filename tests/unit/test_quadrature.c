/* The quadrature rules on one line, against closed forms (Letcher 9: conditions of Simpson's
 * rule). */
#include "hydrostatics/curve.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_POINTS = 161 };
static const double pi = 3.14159265358979323846;

typedef double line(double s);

static batten_context *make_context(void)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	return context;
}

/* Integral of a line over [0, 1] on intervals equal steps. */
static double integral(line *value, size_t intervals, batten_quadrature rule)
{
	double at[MOST_POINTS], v[MOST_POINTS];
	for (size_t i = 0; i <= intervals; i++) {
		at[i] = (double)i / (double)intervals;
		v[i] = value(at[i]);
	}
	batten_context *context = make_context();
	curve made;
	curve_nodes nodes;
	assert_int_equal(curve_create(context, intervals + 1, at, v, NULL, SPLINE_NOT_A_KNOT, &made),
	                 BATTEN_OK);
	assert_int_equal(curve_quadrature(&made, rule, 0, 1, "line", 0, &nodes), BATTEN_OK);
	double sum = curve_nodes_moment(&nodes, 0);
	curve_nodes_release(context, &nodes);
	curve_destroy(&made);
	batten_context_destroy(context);
	return sum;
}

static double error(line *value, size_t intervals, batten_quadrature rule, double exact)
{
	return integral(value, intervals, rule) / exact - 1;
}

static void assert_near(double value, double expected, double tolerance)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%.17g where %.17g is expected", value, expected);
}

static double parabola(double s)
{
	return 4 * s * (1 - s);
}

static double cubic(double s)
{
	return 1 + s * (2 - s * (3 - 5 * s));
}

static double fourth_power(double s)
{
	return s * s * s * s;
}

static double sine(double s)
{
	return sin(pi * s);
}

static double tent(double s)
{
	return 1 - fabs(2 * s - 1);
}

static double step(double s)
{
	return s < 0.5 - 1e-9 ? 1 : 2;
}

/* Parallel middle body between parabolic ends; the integral is 0.7. */
static double middle_body(double s)
{
	double u = s / 0.4, w = (s - 0.5) / 0.5;
	return s < 0.4 ? 2 * u - u * u : s < 0.5 ? 1 : 1 - w * w;
}

static const batten_quadrature spline = BATTEN_QUADRATURE_SPLINE,
							   simpson = BATTEN_QUADRATURE_SIMPSON,
							   trapezoid = BATTEN_QUADRATURE_TRAPEZOID;

static void polynomials(void **state)
{
	(void)state;
	for (size_t n = 10; n <= 40; n *= 2) {
		double m = (double)n;
		assert_near(error(parabola, n, trapezoid, 2.0 / 3), -1 / (m * m), 1e-13);
		assert_near(error(parabola, n, simpson, 2.0 / 3), 0, 1e-13);
		assert_near(error(parabola, n, spline, 2.0 / 3), 0, 1e-13);
		assert_near(error(cubic, n, simpson, 2.25), 0, 1e-13);
		assert_near(error(cubic, n, spline, 2.25), 0, 1e-13);
	}
	assert_near(error(parabola, 2, simpson, 2.0 / 3), 0, 1e-13);
	assert_near(error(fourth_power, 2, simpson, 0.2), 4.1667e-2, 5e-7);
	assert_near(error(fourth_power, 10, simpson, 0.2), 6.667e-5, 5e-9);
	assert_near(error(fourth_power, 20, simpson, 0.2), 4.167e-6, 5e-10);
}

static void sine_line(void **state)
{
	(void)state;
	static const double traps[] = { -8.238e-3, -2.057e-3, -5.141e-4 };
	static const double simpsons[] = { 5.476e-5, 3.392e-6, 2.115e-7 };
	size_t n = 10;
	for (size_t k = 0; k < 3; k++, n *= 2) {
		assert_near(error(sine, n, trapezoid, 2 / pi), traps[k], 5.1e-4 * fabs(traps[k]));
		assert_near(error(sine, n, simpson, 2 / pi), simpsons[k], 5.1e-4 * simpsons[k]);
	}
	/* the spline is of the fourth order */
	double coarse = error(sine, 40, spline, 2 / pi), fine = error(sine, 80, spline, 2 / pi);
	double finest = error(sine, 160, spline, 2 / pi);
	assert_true(fabs(log2(coarse / fine) - 4) < 0.1 && fabs(log2(fine / finest) - 4) < 0.05);
}

/* Where the conditions of Simpson's rule are broken it is worse than trapezoids. */
static void jumps_of_slope_and_value(void **state)
{
	(void)state;
	assert_near(error(tent, 2, simpson, 0.5), 1.0 / 3, 1e-12);
	assert_near(error(tent, 6, simpson, 0.5), 0.0370, 5e-5);
	assert_near(error(tent, 10, simpson, 0.5), 0.0133, 5e-5);
	assert_near(error(tent, 4, simpson, 0.5), 0, 1e-12);
	assert_near(error(tent, 20, simpson, 0.5), 0, 1e-12);
	for (size_t n = 2; n <= 20; n += 2)
		assert_near(error(tent, n, trapezoid, 0.5), 0, 1e-12);
	assert_near(error(step, 10, trapezoid, 1.5), 0.0333, 5e-5);
	assert_near(error(step, 20, trapezoid, 1.5), 0.0167, 5e-5);
	assert_near(error(step, 10, simpson, 1.5), 0.0444, 5e-5);
	assert_near(error(step, 20, simpson, 1.5), 0.0111, 5e-5);
	assert_near(error(middle_body, 10, trapezoid, 0.7), -0.010714, 5e-7);
	assert_near(error(middle_body, 20, trapezoid, 0.7), -0.0026786, 5e-8);
	for (size_t n = 10; n <= 40; n *= 2)
		assert_near(error(middle_body, n, simpson, 0.7), 0, 1e-12);
}

/* A knuckle makes the spline exact on the tent, whether it is a point or lies between two. */
static void breaks(void **state)
{
	(void)state;
	batten_context *context = make_context();
	double at[] = { 0, 0.25, 0.5, 0.75, 1 }, v[5];
	unsigned char marks[5] = { 0, 0, CURVE_BREAK_AT, 0, 0 };
	for (size_t i = 0; i < 5; i++)
		v[i] = tent(at[i]);
	curve made;
	curve_nodes nodes;
	assert_int_equal(curve_create(context, 5, at, v, marks, SPLINE_NOT_A_KNOT, &made), BATTEN_OK);
	assert_int_equal(made.piece_count, 2);
	assert_int_equal(curve_quadrature(&made, spline, 0, 1, "line", 0, &nodes), BATTEN_OK);
	assert_near(curve_nodes_moment(&nodes, 0), 0.5, 1e-15);
	assert_near(curve_nodes_moment(&nodes, 1), 0.25, 1e-15);
	assert_near(curve_nodes_cube(&nodes), 0.25, 1e-15);
	curve_nodes_release(context, &nodes);
	assert_near(curve_slope(&made, 0.3), 2, 1e-14);
	assert_near(curve_slope(&made, 0.7), -2, 1e-14);
	curve_destroy(&made);
	/* straight between points 1 and 2 only */
	marks[2] = 0;
	marks[1] = CURVE_BREAK_AFTER;
	v[2] = 3;
	assert_int_equal(curve_create(context, 5, at, v, marks, SPLINE_NOT_A_KNOT, &made), BATTEN_OK);
	assert_int_equal(made.piece_count, 3);
	assert_near(curve_value(&made, 0.375), 1.75, 1e-15);
	curve_destroy(&made);
	batten_context_destroy(context);
}

static void part_of_a_line(void **state)
{
	(void)state;
	batten_context *context = make_context();
	double at[] = { 0, 0.3, 0.5, 0.6, 1 }, v[5];
	for (size_t i = 0; i < 5; i++)
		v[i] = cubic(at[i]);
	curve made;
	curve_nodes nodes;
	assert_int_equal(curve_create(context, 5, at, v, NULL, SPLINE_NOT_A_KNOT, &made), BATTEN_OK);
	assert_int_equal(curve_quadrature(&made, spline, 0.1, 0.7, "line", 0, &nodes), BATTEN_OK);
	double exact = 0.6 + (0.49 - 0.01) - (0.343 - 0.001) + 1.25 * (0.2401 - 0.0001);
	assert_near(curve_nodes_moment(&nodes, 0), exact, 1e-14);
	curve_nodes_release(context, &nodes);
	/* the polygon, cut between two points */
	assert_int_equal(curve_quadrature(&made, trapezoid, 0, 0.4, "line", 0, &nodes), BATTEN_OK);
	double cut = 0.5 * (v[1] + v[2]);
	assert_near(curve_nodes_moment(&nodes, 0), 0.15 * (v[0] + v[1]) + 0.05 * (v[1] + cut), 1e-15);
	curve_nodes_release(context, &nodes);
	curve_destroy(&made);
	batten_context_destroy(context);
}

static void simpson_says_what_is_wrong(void **state)
{
	(void)state;
	batten_context *context = make_context();
	double at[] = { 0, 1, 2, 3, 4.5 }, v[] = { 1, 2, 3, 4, 5 };
	curve made;
	curve_nodes nodes;
	assert_int_equal(curve_create(context, 5, at, v, NULL, SPLINE_NATURAL, &made), BATTEN_OK);
	assert_int_equal(curve_quadrature(&made, simpson, 0, 4.5, "station at x =", 7, &nodes),
	                 BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(context), "station at x = 7 m"));
	assert_non_null(strstr(batten_context_error(context), "equal intervals"));
	assert_int_equal(curve_quadrature(&made, simpson, 0, 3, "line", 0, &nodes), BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(context), "even number of intervals, found 3"));
	assert_int_equal(curve_quadrature(&made, simpson, 0, 2.5, "line", 0, &nodes), BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(context), "a point at each end"));
	assert_int_equal(curve_quadrature(&made, simpson, 1, 3, "line", 0, &nodes), BATTEN_OK);
	assert_near(curve_nodes_moment(&nodes, 0), 6, 1e-15);
	curve_nodes_release(context, &nodes);
	curve_destroy(&made);
	batten_context_destroy(context);
}

/* The third condition: no jump of the slope but between two parabolas. */
static void simpson_and_knuckles(void **state)
{
	(void)state;
	batten_context *context = make_context();
	const double at[] = { 0, 1, 2, 3, 4, 5, 6 }, v[] = { 0, 1, 2, 3, 2, 1, 0 };
	for (size_t knuckle = 1; knuckle <= 5; knuckle++) {
		for (int after = 0; after < 2; after++) {
			unsigned char marks[7] = { 0 };
			marks[knuckle] = after ? CURVE_BREAK_AFTER : CURVE_BREAK_AT;
			curve made;
			curve_nodes nodes = { 0 };
			assert_int_equal(curve_create(context, 7, at, v, marks, SPLINE_NATURAL, &made),
			                 BATTEN_OK);
			const batten_status status = curve_quadrature(&made, simpson, 0, 6, "line", 0, &nodes);
			const bool good = !after && knuckle % 2 == 0;
			assert_int_equal(status, good ? BATTEN_OK : BATTEN_INPUT);
			if (!good)
				assert_non_null(strstr(batten_context_error(context), "before the knuckle at"));
			/* counted from where the part begins */
			if (good)
				curve_nodes_release(context, &nodes);
			if (!after && knuckle == 3) {
				assert_int_equal(curve_quadrature(&made, simpson, 1, 5, "line", 0, &nodes),
				                 BATTEN_OK);
				assert_near(curve_nodes_moment(&nodes, 0), 8, 1e-14);
				curve_nodes_release(context, &nodes);
			}
			curve_destroy(&made);
		}
	}
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(polynomials),
		cmocka_unit_test(sine_line),
		cmocka_unit_test(jumps_of_slope_and_value),
		cmocka_unit_test(breaks),
		cmocka_unit_test(part_of_a_line),
		cmocka_unit_test(simpson_says_what_is_wrong),
		cmocka_unit_test(simpson_and_knuckles),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
