/* The variation of curvature of offset tables: which nodes count, forms that differences hold
 * exactly, the order of convergence, and how it scales. The densities are the oracle's, which
 * differences the curvatures of surfaces. */
#include "unit/measures_fixture.h"

#include "core/difference.h"
#include "oracle/oracle_bspline.h"

static const double quadratic_u[] = { 0, 0, 0, 1, 1, 1 }, linear_v[] = { 0, 0, 1, 1 };

static double energy_of(batten_context *context, const batten_hull *hull)
{
	return measure_at(context, hull, BATTEN_QUADRATURE_TRAPEZOID, 0).energy_mvc_per_m2;
}

static batten_hull *hull_on(batten_context *context, form *surface, size_t nx, const double *x,
                            size_t nz, const double *z, const uint8_t *nodes)
{
	static double y[MOST * MOST];
	for (size_t n = 0; n < nx * nz; n++)
		y[n] = surface(x[n % nx], z[n / nx]);
	batten_hull_table table = {
		"test", x[nx - 1] - x[0], z[nz - 1] - z[0], nx, nz, x, z, y, nodes
	};
	batten_hull *hull = NULL;
	if (batten_hull_create(context, &table, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

/* ------------------------------------------------------------------------------------------------
 * Third differences
 * --------------------------------------------------------------------------------------------- */

/* Exact for polynomials of degree 4 at any spacing, and no longer for those of degree 5. */
static void third_differences(void **state)
{
	(void)state;
	static const double at[] = { -1, 0.25, 0.5, 2, 2.75 };
	for (int degree = 0; degree <= 5; degree++) {
		double y[15];
		for (int i = 0; i < 5; i++)
			y[3 * i] = pow(at[i], degree);
		const double right = degree < 3
		                         ? 0
		                         : degree * (degree - 1) * (degree - 2) * pow(at[2], degree - 3);
		const difference_quartic quartic = difference_quartic_of(at + 2);
		const double error = fabs(difference_third(&quartic, y + 6, 3) - right);
		assert_true(degree <= 4 ? error < 1e-13 : error > 1);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Forms that three-point differences hold exactly, at uneven places
 * --------------------------------------------------------------------------------------------- */

enum { NX = 8, NZ = 7 };
static const double at_x[NX] = { 0, 1, 3, 4.5, 5, 8, 9, 10 };
static const double at_z[NZ] = { 0, 0.4, 1, 1.6, 1.7, 2, 2.4 };

static double trough(double x, double z)
{
	(void)x;
	return 0.25 + 0.3 * z * z;
}

static double saddle(double x, double z)
{
	return 3 + 0.2 * (x - 5) * (z - 1);
}

static double plane(double x, double z)
{
	return 0.25 + 0.1 * x + 0.5 * z;
}

/* The saddle as a surface whose parameters are x / 10 and z / 2.5. */
static long double saddle_density(double x, double z)
{
	/* clang-format off */
	static const double poles[] = { 0, 4, 0, 10, 2, 0, 0, 1.5, 2.5, 10, 4.5, 2.5 };
	/* clang-format on */
	const oracle_surface surface = { 2, 2, 2, 2, linear_v, linear_v, poles, NULL };
	return oracle_surface_variation(&surface, x / 10.0L, z / 2.5L, 1e-9L);
}

static bool within(const uint8_t *nodes, size_t i, size_t j)
{
	if (i < 2 || j < 2 || i + 2 >= NX || j + 2 >= NZ)
		return false;
	static const int around[13][2] = { { 0, 0 },  { 1, 0 },  { 2, 0 },  { -1, 0 }, { -2, 0 },
		                               { 0, 1 },  { 0, 2 },  { 0, -1 }, { 0, -2 }, { 1, 1 },
		                               { 1, -1 }, { -1, 1 }, { -1, -1 } };
	for (size_t k = 0; nodes && k < 13; k++)
		if (nodes[((ptrdiff_t)j + around[k][1]) * NX + (ptrdiff_t)i + around[k][0]] ==
		    BATTEN_NODE_OUTSIDE)
			return false;
	return true;
}

/* [0] of the trough, [1] of the saddle. */
static void exact_sums(const uint8_t *nodes, double sum[2])
{
	sum[0] = sum[1] = 0;
	for (size_t j = 0; j < NZ; j++)
		for (size_t i = 0; i < NX; i++) {
			if (!within(nodes, i, j))
				continue;
			const double cell = (at_x[i + 1] - at_x[i - 1]) / 2 * (at_z[j + 1] - at_z[j - 1]) / 2;
			/* k = y'' / w^3, dk / ds = -3 y' y''^2 / w^6 */
			double w = sqrt(1 + pow(0.6 * at_z[j], 2));
			sum[0] += pow(-3 * 0.6 * at_z[j] * 0.36 / pow(w, 6), 2) * w * cell;
			w = sqrt(1 + pow(0.2 * (at_z[j] - 1), 2) + pow(0.2 * (at_x[i] - 5), 2));
			sum[1] += (double)saddle_density(at_x[i], at_z[j]) * w * cell;
		}
}

static void exact_forms(void **state)
{
	(void)state;
	form *const forms[2] = { trough, saddle };
	batten_context *context = make_context();
	double sum[2];
	exact_sums(NULL, sum);
	for (size_t k = 0; k < 2; k++) {
		batten_hull *hull = hull_on(context, forms[k], NX, at_x, NZ, at_z, NULL);
		assert_relative(energy_of(context, hull), sum[k], 1e-10);
		batten_hull_destroy(hull);
	}
	batten_hull *hull = hull_on(context, plane, NX, at_x, NZ, at_z, NULL);
	assert_true(energy_of(context, hull) < 1e-24);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

/* Cells cut out one by one: a node counts until one of its thirteen is gone, whatever lies there. */
static void which_nodes_count(void **state)
{
	(void)state;
	batten_context *context = make_context();
	uint8_t nodes[NX * NZ];
	for (size_t gone = 0; gone < NX * NZ; gone++) {
		double sum[2];
		memset(nodes, BATTEN_NODE_GIVEN, sizeof nodes);
		nodes[gone] = BATTEN_NODE_OUTSIDE;
		exact_sums(nodes, sum);
		batten_hull *hull = hull_on(context, trough, NX, at_x, NZ, at_z, nodes);
		assert_relative(energy_of(context, hull), sum[0], 1e-10);
		batten_hull_destroy(hull);
	}
	/* four waterlines or stations hold no stencil */
	batten_hull *hull = hull_on(context, trough, 4, at_x, NZ, at_z, NULL);
	assert_true(isnan(energy_of(context, hull)));
	batten_hull_destroy(hull);
	hull = hull_on(context, trough, NX, at_x, 4, at_z, NULL);
	assert_true(isnan(energy_of(context, hull)));
	batten_hull_destroy(hull);
	hull = hull_on(context, trough, 5, at_x, 5, at_z, NULL);
	assert_true(energy_of(context, hull) > 0);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Wigley's hull, L 100, B 10, T 6.25 (Letcher 4.1)
 * --------------------------------------------------------------------------------------------- */

static double wigley(double x, double z)
{
	const double s = x / 100, t = 1 - z / 6.25;
	return 20 * s * (1 - s) * (1 - t * t);
}

/* clang-format off */
static const double wigley_poles[27] = {
	0, 0, 0,      50, 0, 0,       100, 0, 0,
	0, 0, 3.125,  50, 10, 3.125,  100, 0, 3.125,
	0, 0, 6.25,   50, 10, 6.25,   100, 0, 6.25,
};
/* clang-format on */
static const oracle_surface wigley_surface = { 3,   3, 3, 3, quadratic_u, quadratic_u, wigley_poles,
	                                           NULL };

static long double wigley_density(const oracle_jet d, const oracle_forms *forms, const void *data)
{
	(void)forms, (void)data;
	const long double found = oracle_surface_variation(&wigley_surface, d[0][0][0] / 100,
	                                                   d[0][0][2] / 6.25L, 1e-12L);
	return isnan(found) ? 0 : found;
}

/* The oracle's densities summed over the nodes that count on a table of n x n intervals. */
static long double wigley_sum(size_t n)
{
	long double sum = 0;
	for (size_t j = 2; j + 2 <= n; j++)
		for (size_t i = 2; i + 2 <= n; i++) {
			oracle_jet jet;
			oracle_forms forms;
			assert_true(
				oracle_surface_at(&wigley_surface, (long double)i / n, (long double)j / n, jet));
			oracle_surface_forms(jet, &forms);
			/* dS by u and v */
			sum += wigley_density(jet, &forms, NULL) * forms.area / (long double)(n * n);
		}
	return sum;
}

/* Biquadratic, so that the differences are exact: what is missing of the whole are the edges, at the
 * first order. */
static void wigley_converges(void **state)
{
	(void)state;
	long double whole;
	double missing[3];
	assert_true(oracle_surface_integral(&wigley_surface, 32, wigley_density, NULL, &whole, NULL));
	size_t n = 40;
	for (size_t k = 0; k < 3; k++, n *= 2) {
		const double found = measure_form(wigley, 100, 6.25, n + 1, n + 1,
		                                  BATTEN_QUADRATURE_TRAPEZOID, 0)
		                         .energy_mvc_per_m2;
		if (n < 160) /* the oracle takes its time */
			assert_relative(found, (double)wigley_sum(n), 1e-9);
		missing[k] = (double)whole - found;
	}
	for (size_t k = 0; k < 2; k++) {
		const double order = log2(missing[k] / missing[k + 1]);
		if (!(fabs(order - 1) < 0.2))
			fail_msg("order %g (%g, %g of %Lg)", order, missing[k], missing[k + 1], whole);
	}
}

/* y = 2 + sin w, w = 1 + a x + b z: a curve drawn along a straight line. Along the curve's plane its
 * derivatives are r cos w, -r^2 sin w and -r^3 cos w, r^2 = a^2 + b^2. w stays between 0 and pi: where
 * the curve inflects the surface is flat, and its directions are what the differences make of them. */
static double wave_a, wave_b;

static double wave(double x, double z)
{
	return 2 + sin(1 + wave_a * x + wave_b * z);
}

static double wave_sum(size_t n, double size)
{
	const double r = hypot(wave_a, wave_b), h = size / (double)n;
	double sum = 0;
	for (size_t j = 2; j + 2 <= n; j++)
		for (size_t i = 2; i + 2 <= n; i++) {
			const double w = 1 + wave_a * h * (double)i + wave_b * h * (double)j;
			const double y1 = r * cos(w), y2 = -r * r * sin(w), y3 = -r * r * r * cos(w);
			const double q = 1 + y1 * y1, slope = (y3 * q - 3 * y1 * y2 * y2) / (q * q * q);
			sum += slope * slope * sqrt(q) * h * h;
		}
	return sum;
}

static void waves_converge_at_the_second_order(void **state)
{
	(void)state;
	static const double ways[][2] = { { 0.3, 0 }, { 0, 0.3 }, { 0.17, 0.17 }, { 0.3, -0.1 } };
	for (size_t way = 0; way < 4; way++) {
		double away[3];
		size_t n = 40;
		wave_a = ways[way][0];
		wave_b = ways[way][1];
		for (size_t k = 0; k < 3; k++, n *= 2)
			away[k] = fabs(measure_form(wave, 6, 6, n + 1, n + 1, BATTEN_QUADRATURE_TRAPEZOID, 0)
			                       .energy_mvc_per_m2 /
			                   wave_sum(n, 6) -
			               1);
		assert_true(away[2] < 1e-3);
		for (size_t k = 0; k < 2; k++) {
			const double order = log2(away[k] / away[k + 1]);
			if (!(fabs(order - 2) < 0.1))
				fail_msg("way %zu: order %g (%g, %g, %g)", way, order, away[0], away[1], away[2]);
		}
	}
}

/* ------------------------------------------------------------------------------------------------
 * Laws
 * --------------------------------------------------------------------------------------------- */

static double bumpy(double x, double z)
{
	return 2 + 0.3 * sin(0.7 * x) * cos(1.1 * z) + 0.1 * z * z;
}

static double bumpy_backwards(double x, double z)
{
	return bumpy(10 - x, z);
}

static double bumpy_upside_down(double x, double z)
{
	return bumpy(x, 2.4 - z);
}

static double bumpy_thrice(double x, double z)
{
	return 3 * bumpy(x / 3, z / 3);
}

static void reversed(size_t count, const double *at, double *out)
{
	for (size_t i = 0; i < count; i++)
		out[i] = at[count - 1] - at[count - 1 - i];
}

/* Bow for stern and top for bottom change nothing; s times the size gives 1 / s^2. */
static void mirrors_and_scale(void **state)
{
	(void)state;
	batten_context *context = make_context();
	double back_x[NX], back_z[NZ], large_x[NX], large_z[NZ];
	reversed(NX, at_x, back_x);
	reversed(NZ, at_z, back_z);
	for (size_t i = 0; i < NX; i++)
		large_x[i] = 3 * at_x[i];
	for (size_t j = 0; j < NZ; j++)
		large_z[j] = 3 * at_z[j];
	batten_hull *hulls[] = {
		hull_on(context, bumpy, NX, at_x, NZ, at_z, NULL),
		hull_on(context, bumpy_backwards, NX, back_x, NZ, at_z, NULL),
		hull_on(context, bumpy_upside_down, NX, at_x, NZ, back_z, NULL),
		hull_on(context, bumpy_thrice, NX, large_x, NZ, large_z, NULL),
	};
	const double first = energy_of(context, hulls[0]);
	static const double factor[] = { 1, 1, 1, 1.0 / 9 };
	for (size_t k = 0; k < 4; k++) {
		assert_relative(energy_of(context, hulls[k]), factor[k] * first, 1e-9);
		batten_hull_destroy(hulls[k]);
	}
	batten_context_destroy(context);
}

/* The lower half of a ball: all curvatures alike up to what differences make of them. On it they do
 * not change, so that the sum goes to 0 with the spacing. */
static double ball(double x, double z)
{
	return sqrt(100 - (x - 3) * (x - 3) - (z - 3) * (z - 3));
}

static void balls_go_to_nothing(void **state)
{
	(void)state;
	double before = INFINITY;
	for (size_t n = 20; n <= 80; n *= 2) {
		const double found = measure_form(ball, 6, 6, n + 1, n + 1, BATTEN_QUADRATURE_TRAPEZOID, 0)
		                         .energy_mvc_per_m2;
		if (!(found >= 0 && found < before / 8))
			fail_msg("%g after %g", found, before);
		before = found;
	}
	assert_true(before < 1e-6);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(third_differences),
		cmocka_unit_test(exact_forms),
		cmocka_unit_test(which_nodes_count),
		cmocka_unit_test(wigley_converges),
		cmocka_unit_test(waves_converge_at_the_second_order),
		cmocka_unit_test(mirrors_and_scale),
		cmocka_unit_test(balls_go_to_nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
