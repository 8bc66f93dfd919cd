/* The parts of a fit: banded systems and nearest points, against what is known. */
#include "core/band.h"
#include "geometry/fit.h"
#include "unit/fit_fixture.h"

/* A banded matrix times a vector, and back. */
static void test_band(void **state)
{
	(void)state;
	enum { COUNT = 30, WIDTH = 4, STRIDE = WIDTH + 1 };
	double a[COUNT * STRIDE], x[COUNT], b[COUNT];
	for (size_t row = 0; row < COUNT; row++)
		for (size_t k = 0; k < STRIDE; k++)
			a[row * STRIDE + k] = k == WIDTH        ? 10.0 + 0.1 * (double)row
			                      : row + k < WIDTH ? 0.0
			                                        : sin((double)(row * 7 + k * 3));
	for (size_t row = 0; row < COUNT; row++)
		x[row] = cos((double)row);
	for (size_t row = 0; row < COUNT; row++) {
		b[row] = 0.0;
		for (size_t column = 0; column < COUNT; column++) {
			const size_t low = row > column ? column : row;
			const size_t high = row > column ? row : column;
			if (high - low <= WIDTH)
				b[row] += a[high * STRIDE + WIDTH - (high - low)] * x[column];
		}
	}
	assert_int_equal(band_factor(COUNT, WIDTH, a), COUNT);
	band_solve(COUNT, WIDTH, a, b);
	for (size_t row = 0; row < COUNT; row++)
		assert_near(b[row], x[row], 1e-13, "solution");
}

/* Not positive definite: a zero, a dependent row, a number that is none. */
static void test_band_refusals(void **state)
{
	(void)state;
	double zero[4] = { 0, 1, 0, 0 };
	double dependent[4] = { 0, 1, 1, 1 };
	double none[4] = { 0, 1, NAN, 1 };
	double sound[4] = { 0, 1, 0.5, 1 };
	assert_int_equal(band_factor(2, 1, zero), 1);
	assert_int_equal(band_factor(2, 1, dependent), 1);
	assert_int_equal(band_factor(2, 1, none), 1);
	assert_int_equal(band_factor(2, 1, sound), 2);
}

/* The plane y = 1 over x 0..2, z 0..1, its knots not evenly spread. */
static void test_nearest(void **state)
{
	const double knots_u[] = { 0, 0, 0.3, 1, 1 };
	const double knots_v[] = { 0, 0, 1, 1 };
	const double poles[] = { 0, 1, 0, 0.6, 1, 0, 2, 1, 0, 0, 1, 1, 0.6, 1, 1, 2, 1, 1 };
	const batten_surface_net plane = { .order_u = 2,
		                               .order_v = 2,
		                               .count_u = 3,
		                               .count_v = 2,
		                               .knots_u = knots_u,
		                               .knots_v = knots_v,
		                               .poles_m = poles };
	batten_surface *surface = NULL;
	assert_int_equal(batten_surface_create(*state, &plane, &surface), BATTEN_OK);
	double u = 0.5;
	double v = 0.5;
	assert_near(fit_nearest(surface, (const double[]){ 1.5, 3, 0.25 }, false, false, &u, &v), 2.0,
	            1e-14, "distance");
	assert_near(u, 0.75, 1e-12, "u");
	assert_near(v, 0.25, 1e-12, "v");
	/* Beyond a corner the corner is nearest; a parameter that is held stays. */
	assert_near(fit_nearest(surface, (const double[]){ 5, 1, -4 }, false, false, &u, &v), 5.0,
	            1e-14, "distance from the corner");
	assert_true(u == 1.0 && v == 0.0);
	u = 0.2;
	v = 0.5;
	assert_near(fit_nearest(surface, (const double[]){ 1.4, 1, 0.5 }, true, false, &u, &v), 1.0,
	            1e-14, "distance along a held line");
	assert_true(u == 0.2);
	batten_surface_destroy(surface);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_nearest, make_context, end_context),
		cmocka_unit_test(test_band),
		cmocka_unit_test(test_band_refusals),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
