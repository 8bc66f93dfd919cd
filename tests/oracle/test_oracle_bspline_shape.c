/* The oracle's curvatures of B-spline surfaces and its integrals over them, against closed forms.
 * Control points and weights are small whole numbers and binary fractions, so that no rounding to
 * double stands between them and the forms. */
#include "oracle_bspline.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static bool near(long double a, long double b, long double tolerance)
{
	return fabsl(a - b) <= tolerance * fmaxl(1, fabsl(b));
}

/* splitmix64 */
static uint64_t draw(uint64_t *seed)
{
	uint64_t z = *seed += 0x9e3779b97f4a7c15U;
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
	return z ^ (z >> 31);
}

/* The first quadrant of the unit circle, with whole weights. */
static const double quadrant_knots[] = { 0, 0, 0, 1, 1, 1 };
static const double quadrant[3][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 } };
static const double quadrant_weights[] = { 1, 1, 2 };

/* An octant of the ellipsoid with half-axes a: u round the z axis, v up from the equator. */
static void octant(const double a[3], double poles[27], double weights[9])
{
	for (size_t j = 0; j < 3; j++) {
		for (size_t i = 0; i < 3; i++) {
			double *pole = &poles[(j * 3 + i) * 3];
			pole[0] = a[0] * quadrant[i][0] * quadrant[j][0];
			pole[1] = a[1] * quadrant[i][1] * quadrant[j][0];
			pole[2] = a[2] * quadrant[j][1];
			weights[j * 3 + i] = quadrant_weights[i] * quadrant_weights[j];
		}
	}
}

static void test_ellipsoid(void **state)
{
	(void)state;
	static const double axes[][3] = { { 2, 2, 2 }, { 4, 1, 0.5 }, { 0.25, 3, 1 } };
	for (size_t which = 0; which < 3; which++) {
		const double *a = axes[which];
		double poles[27], weights[9];
		octant(a, poles, weights);
		oracle_surface surface = { 3, 3, 3, 3, quadrant_knots, quadrant_knots, poles, weights };
		for (size_t i = 0; i < 49; i++) {
			oracle_jet jet;
			oracle_forms forms;
			assert_true(oracle_surface_at(&surface, (long double)(i % 7) / 6,
			                              (long double)(i / 7) / 7, jet));
			oracle_surface_forms(jet, &forms);
			assert_true(forms.regular);
			long double on = 0, slope = 0, trace = 0, product = 1;
			for (size_t c = 0; c < 3; c++) {
				long double axis2 = (long double)a[c] * a[c], x = jet[0][0][c];
				on += x * x / axis2;
				slope += x * x / (axis2 * axis2);
				trace += axis2 - x * x;
				product *= axis2;
			}
			/* normals: n is parallel to (x / a^2, ..), outward; convex is negative */
			assert_true(near(on, 1, 2e-18L));
			assert_true(near(forms.gauss, 1 / (product * slope * slope), 1e-15L));
			assert_true(near(forms.mean, -trace / (2 * product * slope * sqrtl(slope)), 1e-15L));
			for (size_t c = 0; c < 3; c++)
				assert_true(near(forms.normal[c],
				                 jet[0][0][c] / ((long double)a[c] * a[c] * sqrtl(slope)), 1e-16L));
		}
	}
}

static void test_sphere_and_its_pole(void **state)
{
	(void)state;
	static const double axes[] = { 2, 2, 2 };
	double poles[27], weights[9];
	octant(axes, poles, weights);
	oracle_surface sphere = { 3, 3, 3, 3, quadrant_knots, quadrant_knots, poles, weights };
	oracle_energies energies;
	const long double pi = acosl(-1);
	assert_true(oracle_surface_energy(&sphere, 24, 0, &energies));
	assert_int_equal(energies.terms, 24 * 24);
	assert_true(near(energies.area, 2 * pi, 1e-16L));
	assert_true(near(energies.bending, pi, 1e-14L));
	assert_true(near(energies.mean, pi / 2, 1e-14L));
	assert_true(near(energies.gauss, pi / 2, 1e-14L));
	assert_true(oracle_surface_energy(&sphere, 24, 0.75, &energies));
	assert_true(near(energies.gauss, 2 * pi * sqrtl(0.625L), 1e-14L));
	assert_true(isnan(oracle_surface_variation(&sphere, 0.5L, 0.5L, 1e-9L)));
	oracle_jet jet;
	oracle_forms forms;
	assert_true(oracle_surface_at(&sphere, 0.5L, 1, jet));
	oracle_surface_forms(jet, &forms);
	assert_false(forms.regular);
	assert_true(forms.gauss == 0 && forms.mean == 0 && forms.k[0] == 0 && forms.normal[2] == 0);
}

/* z as a polynomial of x and y over [-1, 1]^2, from its values at the control points of x^a y^b. */
static void graph(const double z[9], double poles[27])
{
	for (size_t i = 0; i < 9; i++) {
		poles[3 * i] = (double)(i % 3) - 1;
		poles[3 * i + 1] = (double)(i / 3) - 1;
		poles[3 * i + 2] = z[i];
	}
}

static const double square_knots[] = { -1, -1, -1, 1, 1, 1 };

static void test_graphs(void **state)
{
	(void)state;
	static const double bowl[] = { 2, 0, 2, 0, -2, 0, 2, 0, 2 };
	static const double saddle[] = { 1, 0, -1, 0, 0, 0, -1, 0, 1 };
	static const double gutter[] = { 1, -1, 1, 1, -1, 1, 1, -1, 1 };
	double poles[3][27];
	graph(bowl, poles[0]);
	graph(saddle, poles[1]);
	graph(gutter, poles[2]);
	for (size_t i = 0; i < 81; i++) {
		long double x = (long double)(i % 9) / 4 - 1, y = (long double)(i / 9) / 4 - 1;
		long double r2 = x * x + y * y, q = 1 + 4 * x * x;
		oracle_forms forms[3];
		for (size_t which = 0; which < 3; which++) {
			oracle_surface surface = { 3, 3, 3, 3, square_knots, square_knots, poles[which], NULL };
			oracle_jet jet;
			assert_true(oracle_surface_at(&surface, x, y, jet));
			assert_true(jet[0][0][0] == x && jet[0][0][1] == y);
			oracle_surface_forms(jet, &forms[which]);
		}
		assert_true(near(forms[0].gauss, 4 / powl(1 + 4 * r2, 2), 1e-17L));
		assert_true(near(forms[0].mean, 2 * (1 + 2 * r2) / powl(1 + 4 * r2, 1.5L), 1e-17L));
		assert_true(near(forms[1].gauss, -1 / powl(1 + r2, 2), 1e-17L));
		assert_true(near(forms[1].mean, -x * y / powl(1 + r2, 1.5L), 1e-17L));
		assert_true(fabsl(forms[2].gauss) < 1e-18L);
		assert_true(near(forms[2].mean, 1 / powl(q, 1.5L), 1e-17L));
		assert_true(near(forms[2].k[1], 2 / powl(q, 1.5L), 1e-17L));
		/* the rulings run along y, the other direction along the parabola */
		assert_true(near(fabsl(forms[2].direction[0][1]), 1, 1e-17L));
		assert_true(near(fabsl(forms[2].direction[1][0]), 1 / sqrtl(q), 1e-17L));
	}
	oracle_surface surface = { 3, 3, 3, 3, square_knots, square_knots, poles[2], NULL };
	for (int i = -3; i <= 3; i++) {
		long double x = i / 4.0L, slope = 24 * x / powl(1 + 4 * x * x, 3);
		assert_true(
			near(oracle_surface_variation(&surface, x, 0.25L, 1e-9L), slope * slope, 1e-13L));
	}
}

/* The gutter z = x^2 again, its parameters at a slant: x = u + v, y = v. */
static void test_variation_under_a_slant(void **state)
{
	(void)state;
	static const double square[] = { 1, -1, 1 };
	double poles[27];
	for (int i = 0; i < 9; i++) {
		int u = i % 3 - 1, v = i / 3 - 1;
		poles[3 * i] = u + v;
		poles[3 * i + 1] = v;
		poles[3 * i + 2] = square[u + 1] + 2 * u * v + square[v + 1];
	}
	oracle_surface surface = { 3, 3, 3, 3, square_knots, square_knots, poles, NULL };
	for (int i = -3; i <= 3; i++) {
		long double u = i / 4.0L, v = 0.25L, x = u + v, slope = 24 * x / powl(1 + 4 * x * x, 3);
		long double variation = oracle_surface_variation(&surface, u, v, 1e-9L);
		assert_true(near(variation, slope * slope, 1e-13L));
	}
}

static long double density_square(const oracle_jet d, const oracle_forms *forms, const void *data)
{
	(void)forms, (void)data;
	return d[0][0][0] * d[0][0][0] * d[0][0][1];
}

/* The rectangle [0, 3] x [0, 4] in uneven spans, an empty one among them. */
static void test_integral_over_uneven_spans(void **state)
{
	(void)state;
	static const double knots_u[] = { 0, 0, 0, 1, 1, 3, 3, 3 }, knots_v[] = { 0, 0, 0.5, 4, 4 };
	static const double at_u[] = { 0, 0.5, 1, 2, 3 }, at_v[] = { 0, 0.5, 4 };
	double poles[45] = { 0 };
	for (size_t i = 0; i < 15; i++) {
		poles[3 * i] = at_u[i % 5];
		poles[3 * i + 1] = at_v[i / 5];
	}
	oracle_surface surface = { 3, 2, 5, 3, knots_u, knots_v, poles, NULL };
	oracle_energies energies;
	long double sum;
	size_t singular;
	assert_true(oracle_surface_integral(&surface, 2, density_square, NULL, &sum, &singular));
	assert_true(near(sum, 72, 1e-17L) && singular == 0);
	assert_true(oracle_surface_energy(&surface, 2, 0.5, &energies));
	assert_int_equal(energies.terms, 16);
	assert_true(near(energies.area, 12, 1e-17L) && energies.bending == 0);
	assert_true(near(energies.gauss, 6, 1e-17L)); /* all of it the rounding */
}

/* Normal curvature in any direction of the tangent plane, by the quotient of the two forms, is
 * Euler's: k1 cos^2 + k2 sin^2. */
static void test_directions_by_euler(void **state)
{
	(void)state;
	uint64_t seed = 5;
	for (size_t round = 0; round < 200; round++) {
		double poles[27], weights[9];
		for (size_t i = 0; i < 27; i++)
			poles[i] = (double)(draw(&seed) % 64) + (i % 3 == 0 ? (double)(i / 3 % 3) * 200 : 0) +
			           (i % 3 == 1 ? (double)(i / 9) * 200 : 0);
		for (size_t i = 0; i < 9; i++)
			weights[i] = 1 + (double)(draw(&seed) % 4);
		oracle_surface surface = { 3, 3, 3, 3, square_knots, square_knots, poles, weights };
		oracle_jet jet;
		oracle_forms f;
		assert_true(oracle_surface_at(&surface, 0.25L, -0.375L, jet));
		oracle_surface_forms(jet, &f);
		assert_true(f.regular && f.k[0] <= f.k[1]);
		for (int i = 0; i < 8; i++) {
			long double a = cosl(i), b = sinl(i), along[3], cosine = 0, norm = 0;
			for (size_t c = 0; c < 3; c++) {
				along[c] = a * jet[1][0][c] + b * jet[0][1][c];
				cosine += along[c] * f.direction[0][c];
				norm += along[c] * along[c];
			}
			long double normal = (f.second[0] * a * a + 2 * f.second[1] * a * b +
			                      f.second[2] * b * b) /
			                     norm;
			long double cosine2 = cosine * cosine / norm;
			long double euler = f.k[0] * cosine2 + f.k[1] * (1 - cosine2);
			assert_true(fabsl(normal - euler) <= 1e-16L * fmaxl(fabsl(f.k[0]), fabsl(f.k[1])));
		}
	}
}

/* ---- Wigley's hull: length 100, beam 10, depth 6.25, parabolas both ways -------------------- */

/* clang-format off */
static const double wigley[27] = {
	0, 0, -6.25,   50, 0, -6.25,    100, 0, -6.25,
	0, 0, -3.125,  50, 10, -3.125,  100, 0, -3.125,
	0, 0, 0,       50, 10, 0,       100, 0, 0,
};
/* clang-format on */
static const oracle_surface wigley_hull = {
	3, 3, 3, 3, quadrant_knots, quadrant_knots, wigley, NULL
};

static void wigley_at(long double x, long double z, oracle_jet jet, oracle_forms *forms)
{
	assert_true(oracle_surface_at(&wigley_hull, x / 100, 1 + z / 6.25L, jet));
	oracle_surface_forms(jet, forms);
}

/* u runs along, v upwards: x_u x x_v points into the hull, so that convex is positive. */
static void test_wigley_curvatures(void **state)
{
	(void)state;
	static const struct {
		long double x, z, gauss, mean, normal[3];
	} table[] = {
		{ 50, 0, 1.024e-3L, -0.13L, { 0, 1, 0 } },
		{ 50, -3.125L, 2.85544318858e-4L, -0.0621171615122L, { 0, 0.7808688094L, -0.6246950476L } },
		{ 25, 0, 7.52867365945e-4L, -0.0974939409338L, { -0.09950371902L, 0.9950371902L, 0 } },
		{ 25,
		  -3.125L,
		  1.71588058795e-4L,
		  -0.062223159651L,
		  { -0.06417938248L, 0.8557250997L, -0.5134350598L } },
		{ 75,
		  -3.125L,
		  1.71588058795e-4L,
		  -0.062223159651L,
		  { 0.06417938248L, 0.8557250997L, -0.5134350598L } },
		{ 0, 0, 0, -0.00188573206864L, { -0.1961161351L, 0.9805806757L, 0 } },
		{ 10,
		  -5,
		  -1.0454695287e-3L,
		  -0.0359557313411L,
		  { -0.05224171436L, 0.9069742076L, -0.4179337149L } },
	};
	oracle_jet jet;
	oracle_forms forms;
	for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
		wigley_at(table[i].x, table[i].z, jet, &forms);
		long double tolerance = fmaxl(1e-11L * fabsl(table[i].gauss), 1e-19L);
		assert_true(fabsl(forms.gauss - table[i].gauss) <= tolerance);
		assert_true(fabsl(forms.mean + table[i].mean) <= 1e-11L * fabsl(table[i].mean));
		for (size_t c = 0; c < 3; c++)
			assert_true(near(-forms.normal[c], table[i].normal[c], 1e-10L));
	}
	wigley_at(50, 0, jet, &forms);
	assert_true(near(forms.k[0], 0.004L, 1e-18L) && near(forms.k[1], 0.256L, 1e-18L));
	/* K = 0 where q = (1 - s^2) / (1 + 3 s^2); positive nearer the waterline */
	for (int i = -8; i <= 8; i++) {
		long double s = i / 9.0L, q = (1 - s * s) / (1 + 3 * s * s), x = 50 * (1 - s);
		wigley_at(x, -6.25L * sqrtl(q), jet, &forms);
		assert_true(fabsl(forms.gauss) < 1e-18L);
		wigley_at(x, -6.25L * sqrtl(q) * 0.99L, jet, &forms);
		assert_true(forms.gauss > 1e-9L);
		if (i != 0) {
			wigley_at(x, -6.25L * fminl(1, sqrtl(q) * 1.01L), jet, &forms);
			assert_true(forms.gauss < -1e-9L);
		}
	}
}

/* coordinate[0] of the place times coordinate[1] of the normal into the hull */
static long double density_flux(const oracle_jet d, const oracle_forms *forms, const void *data)
{
	const size_t *coordinate = data;
	return d[0][0][coordinate[0]] * -forms->normal[coordinate[1]];
}

static void test_wigley_integrals(void **state)
{
	(void)state;
	static const size_t pairs[][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 2, 0 } };
	/* the order raised to 4, nine times as large to stay in whole numbers */
	static const double along[] = { 0, 60, 60, 0 }, upwards[] = { 0, 2, 3, 3 };
	static const double raised_knots[] = { 0, 0, 0, 0, 3, 3, 3, 3 };
	double raised[48];
	for (size_t i = 0; i < 16; i++) {
		raised[3 * i] = 300 * (double)(i % 4);
		raised[3 * i + 1] = along[i % 4] * upwards[i / 4] / 3;
		raised[3 * i + 2] = 18.75 * ((double)(i / 4) - 3);
	}
	oracle_surface surfaces[] = {
		wigley_hull,
		{ 4, 4, 4, 4, raised_knots, raised_knots, raised, NULL },
	};
	for (size_t which = 0; which < 2; which++) {
		long double scale = which ? 9 : 1, flux;
		size_t singular;
		for (size_t i = 0; i < 4; i++) {
			assert_true(oracle_surface_integral(&surfaces[which], which ? 3 : 2, density_flux,
			                                    pairs[i], &flux, &singular));
			/* both sides: 4/9 L B T each way, and 0 for z N_x */
			long double volume = i < 3 ? 4 / 9.0L : 0;
			assert_true(near(2 * flux / (scale * scale * scale * 6250), volume, 1e-17L));
			assert_int_equal(singular, 0);
		}
		oracle_energies energies;
		assert_true(oracle_surface_energy(&surfaces[which], 40, 0, &energies));
		assert_true(near(2 * energies.area / (scale * scale), 1487.9063104958L, 1e-13L));
	}
}

static void test_degenerate_surface_is_left_out(void **state)
{
	(void)state;
	double poles[27];
	for (size_t i = 0; i < 27; i++)
		poles[i] = (double)(i / 3 % 3) + (double)(i / 9);
	oracle_surface line = { 3, 3, 3, 3, quadrant_knots, quadrant_knots, poles, NULL };
	oracle_energies energies;
	size_t singular;
	long double area;
	assert_true(oracle_surface_energy(&line, 4, 1e-9, &energies));
	assert_true(energies.terms == 0 && energies.bending == 0 && energies.gauss == 0);
	size_t coordinate[2] = { 0, 0 };
	assert_true(oracle_surface_integral(&line, 4, density_flux, coordinate, &area, &singular));
	assert_true(area == 0 && singular == 16);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_ellipsoid),
		cmocka_unit_test(test_sphere_and_its_pole),
		cmocka_unit_test(test_graphs),
		cmocka_unit_test(test_variation_under_a_slant),
		cmocka_unit_test(test_integral_over_uneven_spans),
		cmocka_unit_test(test_directions_by_euler),
		cmocka_unit_test(test_wigley_curvatures),
		cmocka_unit_test(test_wigley_integrals),
		cmocka_unit_test(test_degenerate_surface_is_left_out),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
