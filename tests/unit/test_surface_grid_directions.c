/* Principal directions, curvatures along and across x, and isophotes of patches known in closed form,
 * and lights that are refused. */
#include "support/surface_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COUNT = BATTEN_SURFACE_VALUE_COUNT, SIDE = 5, POINTS = SIDE * SIDE };
static const double places[SIDE] = { 0.125, 0.25, 0.5, 0.625, 0.875 };

static int open_context(void **state)
{
	return batten_context_create(NULL, (batten_context **)state) == BATTEN_OK ? 0 : 1;
}

static int close_context(void **state)
{
	batten_context_destroy(*state);
	return 0;
}

static batten_status run(batten_context *context, const double *poles, const double *weights,
                         const double *light, batten_precision precision,
                         double values[COUNT][POINTS], uint8_t *singular)
{
	const batten_surface_net net = {
		.order_u = 3, .order_v = 3, .count_u = 3, .count_v = 3, .poles_m = poles, .weights = weights
	};
	const batten_surface_samples samples = { SIDE, SIDE, places, places };
	batten_surface_batch_options options = surface_case_options(BATTEN_DEVICE_REFERENCE, precision,
	                                                            BATTEN_SURFACE_EVERYTHING);
	for (size_t c = 0; light && c < 3; c++)
		options.light[c] = light[c];
	batten_surface *surface = NULL;
	assert_int_equal(batten_surface_create(context, &net, &surface), BATTEN_OK);
	const batten_surface *surfaces[] = { surface };
	const batten_status status = batten_surface_grid_batch(context, 1, surfaces, &samples, &options,
	                                                       &values[0][0], singular, NULL);
	batten_surface_destroy(surface);
	return status;
}

/* The height a s^2 + b t^2 + c s t over s, t in -1..1, along coordinate `up`; s and t run along the
 * other two in their order. */
static void make_patch(double a, double b, double c, size_t up, double poles[27])
{
	for (size_t n = 0; n < 9; n++) {
		const double s = (double)(n % 3) - 1.0;
		const double t = (double)(n / 3) - 1.0;
		double *pole = poles + 3 * n;
		pole[(up + 1) % 3] = up == 1 ? t : s;
		pole[(up + 2) % 3] = up == 1 ? s : t;
		pole[up] = a * (s == 0.0 ? -1.0 : 1.0) + b * (t == 0.0 ? -1.0 : 1.0) + c * s * t;
	}
}

static void assert_near(double found, double wanted, double tolerance)
{
	if (!(fabs(found - wanted) <= tolerance))
		fail_msg("found %.17g, expected %.17g", found, wanted);
}

static void assert_no_directions(double values[COUNT][POINTS], size_t p)
{
	for (size_t v = BATTEN_SURFACE_VALUE_direction1_x; v < BATTEN_SURFACE_VALUE_along_x; v++)
		assert_true(values[v][p] == 0.0);
}

/* A sphere is all umbilics; its isophotes are circles in planes across the light. */
static void test_sphere(void **state)
{
	static const double across[] = { 1, 1, 0 }, along[] = { 0, 1, 1 }, light[] = { 2, -3, 6 };
	const double arc[] = { 1.0, sqrt(0.5), 1.0 };
	double poles[27], weights[9], values[COUNT][POINTS];
	uint8_t singular[POINTS];
	for (size_t n = 0; n < 9; n++) {
		poles[3 * n] = 5.0 * across[n / 3] * across[n % 3];
		poles[3 * n + 1] = 5.0 * across[n / 3] * along[n % 3];
		poles[3 * n + 2] = 5.0 * along[n / 3];
		weights[n] = arc[n % 3] * arc[n / 3];
	}
	for (int f32 = 0; f32 < 2; f32++) {
		const double tolerance = f32 ? 1e-5 : 1e-13;
		assert_int_equal(
			run(*state, poles, weights, light, f32 ? BATTEN_F32 : BATTEN_F64, values, singular),
			BATTEN_OK);
		for (size_t p = 0; p < POINTS; p++) {
			assert_no_directions(values, p);
			const double mean = values[BATTEN_SURFACE_VALUE_mean][p];
			assert_near(fabs(mean), 0.2, tolerance);
			assert_near(values[BATTEN_SURFACE_VALUE_along_x][p], mean, tolerance);
			assert_near(values[BATTEN_SURFACE_VALUE_across_x][p], mean, tolerance);
			const double height = (2 * values[0][p] - 3 * values[1][p] + 6 * values[2][p]) / 7;
			assert_near(values[BATTEN_SURFACE_VALUE_isophote][p],
			            (mean < 0.0 ? 1.0 : -1.0) * height / 5.0, tolerance);
		}
	}
}

/* z = x^2: one direction is straight, the other bends by 2 / (1 + 4
 * x^2)^1.5. */
static void test_cylinder_along_y(void **state)
{
	double poles[27], values[COUNT][POINTS];
	uint8_t singular[POINTS];
	make_patch(1.0, 0.0, 0.0, 2, poles);
	assert_int_equal(run(*state, poles, NULL, NULL, BATTEN_F64, values, singular), BATTEN_OK);
	for (size_t p = 0; p < POINTS; p++) {
		const double x = values[0][p];
		const double mean = values[BATTEN_SURFACE_VALUE_mean][p];
		const size_t straight = mean < 0.0 ? BATTEN_SURFACE_VALUE_direction1_x
		                                   : BATTEN_SURFACE_VALUE_direction2_x;
		assert_near(fabs(values[straight + 1][p]), 1.0, 1e-14);
		assert_near(fabs(values[BATTEN_SURFACE_VALUE_along_x][p]), 2.0 * pow(1 + 4 * x * x, -1.5),
		            1e-13);
		assert_near(values[BATTEN_SURFACE_VALUE_across_x][p], 0.0, 1e-13);
	}
}

/* z = x y bends at its middle by 1 along one diagonal, by -1 along the other, not along x. */
static void test_saddle(void **state)
{
	double poles[27], values[COUNT][POINTS];
	uint8_t singular[POINTS];
	make_patch(0.0, 0.0, 1.0, 2, poles);
	assert_int_equal(run(*state, poles, NULL, NULL, BATTEN_F64, values, singular), BATTEN_OK);
	const size_t middle = POINTS / 2;
	const double up = values[BATTEN_SURFACE_VALUE_normal_z][middle];
	const double *first[] = { values[BATTEN_SURFACE_VALUE_direction1_x],
		                      values[BATTEN_SURFACE_VALUE_direction1_y] };
	assert_near(first[0][middle] * first[1][middle], 0.5 * up, 1e-15);
	assert_near(values[BATTEN_SURFACE_VALUE_along_x][middle], 0.0, 1e-15);
	assert_near(values[BATTEN_SURFACE_VALUE_across_x][middle], 0.0, 1e-15);
}

/* A flat bottom has no directions and no curvature, and the light from port does not reach it; a bent
 * transom has directions, but none along x where it lies square to x. */
static void test_flat_bottom_and_transom(void **state)
{
	double poles[27], values[COUNT][POINTS];
	uint8_t singular[POINTS];
	make_patch(0.0, 0.0, 0.0, 2, poles);
	assert_int_equal(run(*state, poles, NULL, NULL, BATTEN_F64, values, singular), BATTEN_OK);
	for (size_t p = 0; p < POINTS; p++) {
		assert_int_equal(singular[p], 0);
		assert_no_directions(values, p);
		for (size_t v = BATTEN_SURFACE_VALUE_along_x; v < COUNT; v++)
			assert_true(values[v][p] == 0.0);
	}
	make_patch(1.0, 0.25, 0.0, 0, poles);
	assert_int_equal(run(*state, poles, NULL, NULL, BATTEN_F64, values, singular), BATTEN_OK);
	for (size_t p = 0; p < POINTS; p++) {
		const bool square = p == POINTS / 2;
		const double sum = values[BATTEN_SURFACE_VALUE_along_x][p] +
		                   values[BATTEN_SURFACE_VALUE_across_x][p];
		assert_int_equal(singular[p], 0);
		assert_near(sum, square ? 0.0 : 2.0 * values[BATTEN_SURFACE_VALUE_mean][p], 1e-13);
		assert_true(values[BATTEN_SURFACE_VALUE_direction1_y][p] != 0.0 ||
		            values[BATTEN_SURFACE_VALUE_direction1_z][p] != 0.0);
	}
}

static void test_lights_refused(void **state)
{
	static const double lights[][3] = { { 0, 0, 0 }, { NAN, 1, 0 }, { 0, 1, INFINITY } };
	double poles[27], values[COUNT][POINTS];
	uint8_t singular[POINTS];
	make_patch(1.0, 1.0, 0.0, 2, poles);
	for (size_t n = 0; n < sizeof lights / sizeof lights[0]; n++) {
		assert_int_equal(run(*state, poles, NULL, lights[n], BATTEN_F64, values, singular),
		                 BATTEN_USAGE);
		assert_non_null(strstr(batten_context_error(*state), "light from ("));
	}
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, open_context, close_context)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(test_sphere),         TEST(test_cylinder_along_y),
		TEST(test_saddle),         TEST(test_flat_bottom_and_transom),
		TEST(test_lights_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
