/* The oracle against closed forms: surfaces, lines and derivatives. */
#include "oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { SIDE = 41, NODES = SIDE * SIDE };

typedef struct table {
	size_t nx, nz;
	double x[SIDE], z[SIDE], y[NODES];
} table;

static bool near(long double a, long double b, long double tolerance)
{
	return fabsl(a - b) <= tolerance * fmaxl(1, fabsl(b));
}

/* count coordinates from first to last in equal steps. */
static void spread(double *at, size_t count, double first, double last)
{
	for (size_t i = 0; i < count; i++)
		at[i] = first + (last - first) * (double)i / (double)(count - 1);
}

/* Uneven but dyadic, so that polynomial tables hold their values without rounding. */
static void spread_unevenly(double *at, size_t count)
{
	static const double steps[] = { 0.5, 0.25, 1, 0.75, 0.125, 0.5, 2 };
	at[0] = -1.5;
	for (size_t i = 1; i < count; i++)
		at[i] = at[i - 1] + steps[i % 7];
}

static void fill(table *t, double (*surface)(double x, double z))
{
	for (size_t j = 0; j < t->nz; j++)
		for (size_t i = 0; i < t->nx; i++)
			t->y[j * t->nx + i] = surface(t->x[i], t->z[j]);
}

static double plane(double x, double z)
{
	return 3 + 0.5 * x - 0.25 * z;
}

static void test_plane_has_no_energy(void **state)
{
	(void)state;
	table t = { .nx = 9, .nz = 7 };
	oracle_energies energies;
	spread(t.x, t.nx, 0, 2);
	spread(t.z, t.nz, 0, 3);
	fill(&t, plane);
	assert_true(oracle_energy(t.nx, t.nz, t.x, t.z, t.y, NULL, &energies));
	assert_true(energies.bending == 0 && energies.mean == 0 && energies.gauss == 0);
	assert_int_equal(energies.terms, 7 * 5);
	assert_true(near(energies.area, 1.75L * 2.5L * sqrtl(1 + 0.25L + 0.0625L), 1e-17L));
	spread_unevenly(t.x, t.nx);
	spread_unevenly(t.z, t.nz);
	fill(&t, plane);
	assert_true(oracle_energy(t.nx, t.nz, t.x, t.z, t.y, NULL, &energies));
	assert_true(energies.bending < 1e-30L && energies.gauss < 1e-30L);
}

static double any_biquadratic(double x, double z)
{
	return 1 + 2 * x - z + 0.5 * x * x + 0.75 * x * z - 0.25 * z * z + 0.125 * x * x * z -
	       0.5 * x * z * z + 0.25 * x * x * z * z;
}

/* A biquadratic is its own interpolant: its derivatives come out exactly on any table. */
static void test_biquadratic_derivatives_are_exact(void **state)
{
	(void)state;
	table t = { .nx = 9, .nz = 8 };
	spread_unevenly(t.x, t.nx);
	spread_unevenly(t.z, t.nz);
	fill(&t, any_biquadratic);
	for (size_t j = 1; j + 1 < t.nz; j++) {
		for (size_t i = 1; i + 1 < t.nx; i++) {
			oracle_shape shape;
			long double x = t.x[i], z = t.z[j];
			assert_true(oracle_shape_at(t.nx, t.nz, t.x, t.z, t.y, i, j, &shape));
			assert_true(near(shape.y_x,
			                 2 + x + 0.75L * z + 0.25L * x * z - 0.5L * z * z + 0.5L * x * z * z,
			                 2e-16L));
			assert_true(near(shape.y_z,
			                 -1 + 0.75L * x - 0.5L * z + 0.125L * x * x - x * z + 0.5L * x * x * z,
			                 2e-16L));
			assert_true(near(shape.y_xx, 1 + 0.25L * z + 0.5L * z * z, 2e-16L));
			assert_true(near(shape.y_xz, 0.75L + 0.25L * x - z + x * z, 2e-16L));
			assert_true(near(shape.y_zz, -0.5L - x + 0.5L * x * x, 2e-16L));
		}
	}
}

static double saddle(double x, double z)
{
	return 0.5 * x * z;
}

/* y = a x z: K = -a^2 / W^4, 2H = -2 a^3 x z / W^3. */
static void test_saddle(void **state)
{
	(void)state;
	table t = { .nx = 8, .nz = 8 };
	spread_unevenly(t.x, t.nx);
	spread_unevenly(t.z, t.nz);
	fill(&t, saddle);
	for (size_t j = 1; j + 1 < t.nz; j++) {
		for (size_t i = 1; i + 1 < t.nx; i++) {
			oracle_shape shape;
			long double x = t.x[i], z = t.z[j], w2 = 1 + (x * x + z * z) / 4;
			assert_true(oracle_shape_at(t.nx, t.nz, t.x, t.z, t.y, i, j, &shape));
			assert_true(near(shape.k1 * shape.k2, -0.25L / (w2 * w2), 1e-17L));
			assert_true(near(shape.k1 + shape.k2, -0.25L * x * z / powl(w2, 1.5L), 1e-17L));
		}
	}
}

static double wigley_100(double x, double z)
{
	return 5 * 4 * (x / 100) * (1 - x / 100) * (1 - (z / 6.25) * (z / 6.25));
}

/* Wigley's hull, L 100, B 10, T 6.25, z from the waterline; curvatures from its closed form. */
static void test_wigley_curvatures(void **state)
{
	(void)state;
	static const struct {
		double x, z;
		long double gauss, mean;
	} points[] = {
		{ 50, 0, 1.024e-3L, -0.13L },
		{ 50, -3.125, 2.85544318858e-4L, -0.0621171615122L },
		{ 25, 0, 7.52867365945e-4L, -0.0974939409338L },
		{ 25, -3.125, 1.71588058795e-4L, -0.062223159651L },
		{ 0, 0, 0, -0.00188573206864L },
		{ 10, -5, -1.0454695287e-3L, -0.0359557313411L },
	};
	for (size_t k = 0; k < sizeof points / sizeof points[0]; k++) {
		table t = { .nx = 3, .nz = 3 };
		oracle_shape shape;
		const double x[3] = { points[k].x - 7, points[k].x, points[k].x + 4 };
		const double z[3] = { points[k].z - 0.5, points[k].z, points[k].z + 0.75 };
		for (size_t i = 0; i < 3; i++) {
			t.x[i] = x[i];
			t.z[i] = z[i];
		}
		fill(&t, wigley_100);
		assert_true(oracle_shape_at(3, 3, t.x, t.z, t.y, 1, 1, &shape));
		assert_true(fabsl(shape.k1 * shape.k2 - points[k].gauss) < 1e-14L);
		assert_true(fabsl((shape.k1 + shape.k2) / 2 - points[k].mean) < 1e-13L);
	}
}

static double cylinder(double x, double z)
{
	(void)x;
	return sqrt(4 - z * z);
}

static double sphere(double x, double z)
{
	return sqrt(4 - x * x - z * z);
}

/* Observed order between the errors of two grids, the second twice as fine. */
static long double order_of(long double coarse, long double fine)
{
	return log2l(fabsl(coarse) / fabsl(fine));
}

/* Radius 2: energy of the strip between the outermost half-sum limits is its area / 4. */
static void test_cylinder_second_order(void **state)
{
	(void)state;
	long double error[3], local[3];
	for (size_t grid = 0; grid < 3; grid++) {
		table t = { .nx = 5, .nz = ((size_t)10 << grid) + 1 };
		oracle_energies energies;
		oracle_shape shape;
		spread(t.x, t.nx, 0, 2);
		spread(t.z, t.nz, -1.25, 1.25);
		fill(&t, cylinder);
		assert_true(oracle_energy(t.nx, t.nz, t.x, t.z, t.y, NULL, &energies));
		long double end = 1.25L - 1.25L / (long double)(t.nz - 1);
		error[grid] = energies.bending - 1.5L * 4 * asinl(end / 2) / 4;
		assert_true(energies.gauss < 1e-12L);
		assert_true(near(4 * energies.mean, energies.bending, 1e-14L));
		assert_true(oracle_shape_at(t.nx, t.nz, t.x, t.z, t.y, 2, (t.nz - 1) * 4 / 5, &shape));
		local[grid] = shape.k1 + 0.5L;
	}
	assert_true(fabsl(error[2]) < 2e-3L && fabsl(local[2]) < 1e-3L);
	assert_true(near(order_of(error[0], error[1]), 2, 0.1L));
	assert_true(near(order_of(error[1], error[2]), 2, 0.03L));
	assert_true(near(order_of(local[0], local[1]), 2, 0.1L));
	assert_true(near(order_of(local[1], local[2]), 2, 0.03L));
}

/* Area of the sphere of radius 2 over 0..x, 0..z. */
static long double sphere_area(long double x, long double z)
{
	long double s = sqrtl(4 - x * x - z * z);
	return 2 * (x * asinl(z / sqrtl(4 - x * x)) + z * asinl(x / sqrtl(4 - z * z)) -
	            2 * atanl(x * z / (2 * s)));
}

static void test_sphere_second_order(void **state)
{
	(void)state;
	long double error[3][3];
	for (size_t grid = 0; grid < 3; grid++) {
		table t = { .nx = ((size_t)10 << grid) + 1, .nz = ((size_t)8 << grid) + 1 };
		oracle_energies energies;
		spread(t.x, t.nx, -1, 1);
		spread(t.z, t.nz, -0.875, 0.875);
		fill(&t, sphere);
		assert_true(oracle_energy(t.nx, t.nz, t.x, t.z, t.y, NULL, &energies));
		long double area = 4 * sphere_area(1 - 1 / (long double)(t.nx - 1),
		                                   0.875L - 0.875L / (long double)(t.nz - 1));
		error[0][grid] = energies.bending - area * 2 / 4;
		error[1][grid] = energies.mean - area / 4;
		error[2][grid] = energies.gauss - area / 4;
		assert_true(fabsl(energies.area - area) < 0.05L / (long double)(1 << 2 * grid));
	}
	for (size_t k = 0; k < 3; k++) {
		assert_true(fabsl(error[k][2]) < 1e-2L);
		assert_true(near(order_of(error[k][0], error[k][1]), 2, 0.1L));
		assert_true(near(order_of(error[k][1], error[k][2]), 2, 0.03L));
	}
}

static void test_mask_and_widths(void **state)
{
	(void)state;
	const double x[4] = { 0, 1, 3, 4 }, z[3] = { 0, 2, 3 };
	const double target[12] = { 0 };
	double y[12], weight[12];
	uint8_t nodes[12];
	oracle_energies energies;
	for (size_t k = 0; k < 12; k++) {
		y[k] = 1;
		weight[k] = k == 5 ? 2 : 1;
		nodes[k] = (uint8_t)(1 + k % 2);
	}
	/* widths along x .5 1.5 1.5 .5, along z 1 1.5 .5: in all 4 x 3 */
	assert_true(near(oracle_closeness(4, 3, x, z, y, target, NULL, nodes), 12, 1e-18L));
	assert_true(near(oracle_closeness(4, 3, x, z, y, target, weight, NULL), 14.25L, 1e-18L));
	nodes[0] = 0;
	y[0] = NAN; /* a node outside is not read, and changes no other node's width */
	assert_true(near(oracle_closeness(4, 3, x, z, y, target, weight, nodes), 13.75L, 1e-18L));
	assert_true(oracle_energy(4, 3, x, z, y, nodes, &energies));
	assert_int_equal(energies.terms, 1);
	assert_true(near(energies.area, 1.5L * 1.5L, 1e-18L));
	assert_true(isnan(oracle_closeness(2, 3, x, z, y, target, NULL, NULL)));
	assert_true(
		isnan(oracle_closeness(3, 4, z, (const double[4]){ 0, 2, 2, 3 }, y, target, NULL, NULL)));
}

/* A bump e on the middle of a flat 3 x 3 table, spacings a and b: y_xx = -2e/a^2, y_zz = -2e/b^2,
 * no slope, so that E = 4 e^2 (1/a^4 + 1/b^4) a b and, by the neighbours along x, -4e/a^4 a b;
 * a slope enters squared, a corner by y_xz = 0 alone. */
static void test_gradient_of_a_bump(void **state)
{
	(void)state;
	const double x[3] = { 0, 0.5, 1 }, z[3] = { 0, 0.25, 0.5 };
	const double y[9] = { 0, 0, 0, 0, 0.0625, 0, 0, 0, 0 };
	const double target[9] = { 0, 0, 0, 0, 0.03125, 0, 0, 0, 0 };
	const long double e = 0.0625L, ab = 0.125L, a4 = 0.0625L, b4 = 1 / 256.0L;
	oracle_problem problem = {
		.nx = 3, .nz = 3, .x = x, .z = z, .target = target, .w1 = 3, .w2 = 5, .h = 2
	};
	long double gradient[9];
	for (int way = 0; way < 2; way++) {
		assert_true(way ? oracle_gradient_by_hand(&problem, y, gradient)
		                : oracle_gradient(&problem, y, gradient));
		long double close = 5 * 2 * 0.03125L * ab / 16;
		assert_true(near(gradient[4], 3 * 8 * e * (1 / a4 + 1 / b4) * ab + close, 1e-15L));
		assert_true(near(gradient[3], -3 * 4 * e / a4 * ab, 1e-15L));
		assert_true(near(gradient[7], -3 * 4 * e / b4 * ab, 1e-15L));
		assert_true(fabsl(gradient[0]) < 1e-15L && fabsl(gradient[8]) < 1e-15L);
	}
}

/* The middle node alone is free: F = w1 C y^2 + w2 a b (y - t)^2 / h^4. */
static void test_minimum_of_a_bump(void **state)
{
	(void)state;
	const double x[3] = { 0, 0.5, 1 }, z[3] = { 0, 0.25, 0.5 };
	const double zero[9] = { 0 }, target[9] = { 0, 0, 0, 0, 0.5, 0, 0, 0, 0 };
	double upper[9] = { 0, 0, 0, 0, 1, 0, 0, 0, 0 };
	oracle_problem problem = { .nx = 3,
		                       .nz = 3,
		                       .x = x,
		                       .z = z,
		                       .start = target,
		                       .target = target,
		                       .lower = zero,
		                       .upper = upper,
		                       .w1 = 3,
		                       .w2 = 5000,
		                       .h = 2 };
	const long double c = 3 * 4 * (16 + 256) * 0.125L, d = 5000 * 0.125L / 16;
	for (int way = 0; way < 2; way++) {
		double y[9];
		oracle_minimum m;
		upper[4] = 1;
		assert_true(way ? oracle_minimise_lbfgs(&problem, y, &m)
		                : oracle_minimise(&problem, y, &m));
		assert_true(m.converged && m.variables == 1 && m.at_bound == 0);
		assert_true(near(y[4], 0.5L * d / (c + d), way ? 1e-9L : 1e-16L));
		assert_true(near(m.objective, 0.25L * c * d / (c + d), 1e-15L));
		upper[4] = 0.03125;
		assert_true(way ? oracle_minimise_lbfgs(&problem, y, &m)
		                : oracle_minimise(&problem, y, &m));
		assert_true(m.converged && m.at_bound == 1 && m.residual == 0 && y[4] == 0.03125);
	}
}

static void test_line_fairness(void **state)
{
	(void)state;
	const double x[6] = { 0, 1, 2, 3, 4, 5 }, y[6] = { 0, 1, 3, 9, 16, 25 };
	const double uneven[5] = { 0, 0.5, 2, 2.25, 4 }, square[5] = { 0, 0.25, 4, 5.0625, 16 };
	long double second[5];
	assert_true(near(oracle_line_fairness(6, x, y), 1 + 16 + 1 + 4, 1e-17L));
	assert_true(oracle_line_fairness(2, x, y) == 0);
	assert_true(oracle_line_second_differences(5, uneven, square, second));
	for (size_t i = 1; i < 4; i++)
		assert_true(near(second[i], 2, 1e-17L));
}

static double cubic(double x)
{
	return 1 - 2 * x + 0.5 * x * x + 0.25 * x * x * x;
}

static void test_splines(void **state)
{
	(void)state;
	const double three[3] = { 0, 1, 2 }, hat[3] = { 0, 1, 0 };
	const double x[6] = { 0, 0.5, 1.5, 1.75, 3, 4 };
	double y[6];
	long double out[3];
	/* natural through (0,0) (1,1) (2,0): S''(1) = -3, S = 1.5 x - 0.5 x^3 up to 1 */
	assert_true(oracle_spline(3, three, hat, ORACLE_NATURAL, 1, out));
	assert_true(near(out[0], 1, 1e-18L) && near(out[2], -3, 1e-18L));
	assert_true(oracle_spline(3, three, hat, ORACLE_NATURAL, 0.5, out));
	assert_true(near(out[0], 0.6875L, 1e-18L) && near(out[1], 1.125L, 1e-18L));
	assert_true(near(oracle_spline_integral(3, three, hat, ORACLE_NATURAL, 0, 2), 1.25L, 1e-18L));
	/* not-a-knot gives a cubic, and the parabola through three points, back */
	for (size_t i = 0; i < 6; i++)
		y[i] = cubic(x[i]);
	for (int step = 0; step <= 32; step++) {
		double at = step / 8.0;
		assert_true(oracle_spline(6, x, y, ORACLE_NOT_A_KNOT, at, out));
		assert_true(near(out[0], cubic(at), 1e-16L));
		assert_true(near(out[1], -2 + at + 0.75 * at * at, 1e-16L));
		assert_true(near(out[2], 1 + 1.5 * at, 1e-16L));
	}
	long double whole = oracle_spline_integral(6, x, y, ORACLE_NOT_A_KNOT, 0, 4);
	assert_true(near(whole, 4 - 16 + 32 / 3.0L + 16, 1e-17L));
	assert_true(oracle_spline(3, three, hat, ORACLE_NOT_A_KNOT, 0.5, out));
	assert_true(near(out[0], 0.75L, 1e-18L) && near(out[2], -2, 1e-18L));
	assert_true(oracle_spline(2, three, hat, ORACLE_NOT_A_KNOT, 0.25, out));
	assert_true(near(out[0], 0.25L, 1e-18L));
	assert_false(oracle_spline(1, three, hat, ORACLE_NATURAL, 0, out));
	assert_true(isnan(oracle_spline_integral(3, three, hat, ORACLE_NATURAL, 0, 3)));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_plane_has_no_energy),
		cmocka_unit_test(test_biquadratic_derivatives_are_exact),
		cmocka_unit_test(test_saddle),
		cmocka_unit_test(test_wigley_curvatures),
		cmocka_unit_test(test_cylinder_second_order),
		cmocka_unit_test(test_sphere_second_order),
		cmocka_unit_test(test_mask_and_widths),
		cmocka_unit_test(test_gradient_of_a_bump),
		cmocka_unit_test(test_minimum_of_a_bump),
		cmocka_unit_test(test_line_fairness),
		cmocka_unit_test(test_splines),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
