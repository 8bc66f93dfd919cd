/* The oracle's B-spline points and derivatives against closed forms. Control points and weights are
 * small whole numbers, so that no rounding to double stands between them and the forms. */
#include "oracle_bspline.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 24 };

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

/* Whole knots with repetitions inside (up to order - 1 times), clamped or free at the ends. */
static size_t draw_knots(uint64_t *seed, size_t order, double *knots)
{
	size_t count = order + draw(seed) % 6, again = 0;
	bool clamped = draw(seed) % 2;
	double at = clamped ? 0 : -3;
	for (size_t i = 0; i < count + order; i++) {
		bool inside = i >= order && i <= count;
		bool step = clamped ? inside : i > 0 && (i == order || draw(seed) % 3 > 0);
		if (!clamped && again + 1 == order)
			step = true;
		if (clamped && inside && i != order && i != count && again + 2 < order)
			step = draw(seed) % 3 > 0;
		at += step ? 1 : 0;
		again = step ? 0 : again + 1;
		knots[i] = at;
	}
	return count;
}

static long double binomial(size_t n, size_t m)
{
	return m == 0 ? 1 : binomial(n, m - 1) * (long double)(n - m + 1) / (long double)m;
}

/* Sum of the products of m of the numbers: what makes the control points of
 * binomial(order - 1, m) t^m (Marsden). */
static double symmetric(const double *number, size_t count, size_t m)
{
	if (m == 0)
		return 1;
	if (count < m)
		return 0;
	return symmetric(number + 1, count - 1, m) +
	       number[0] * symmetric(number + 1, count - 1, m - 1);
}

/* The same power, d times differentiated. */
static long double power(size_t degree, size_t m, size_t d, long double t)
{
	long double value = binomial(degree, m);
	for (size_t i = 0; i < d; i++)
		value *= (long double)m - (long double)i;
	for (size_t i = d; i < m; i++)
		value *= t;
	return value;
}

static void test_powers_come_out_on_any_knots(void **state)
{
	(void)state;
	uint64_t seed = 1;
	double knots[2 * MOST], poles[MOST];
	for (size_t order = 2; order <= ORACLE_ORDER_MOST; order++) {
		for (size_t round = 0; round < 40; round++) {
			size_t count = draw_knots(&seed, order, knots), m = draw(&seed) % order;
			for (size_t i = 0; i < count; i++)
				poles[i] = symmetric(&knots[i + 1], order - 1, m);
			oracle_curve curve = { order, count, 1, knots, poles, NULL };
			long double width = (long double)knots[count] - knots[order - 1], most = 0;
			for (size_t i = 0; i < count; i++)
				most = fmaxl(most, fabsl(poles[i]));
			for (size_t i = 0; i <= 16; i++) {
				long double t = knots[order - 1] + width * (long double)i / 16, scale = most;
				long double out[ORACLE_ORDERS][3];
				assert_true(oracle_curve_at(&curve, t, out));
				for (size_t d = 0; d < ORACLE_ORDERS; d++) {
					assert_true(fabsl(out[d][0] - power(order - 1, m, d, t)) <= 1e-18L * scale);
					assert_true(out[d][1] == 0 && out[d][2] == 0);
					scale *= 2 * (long double)order;
				}
			}
		}
	}
}

/* Products of powers: every mixed derivative, rows and columns in their places. */
static void test_products_of_powers(void **state)
{
	(void)state;
	uint64_t seed = 2;
	double knots[2][2 * MOST], poles[MOST * MOST * 3];
	for (size_t round = 0; round < 200; round++) {
		size_t order_u = 2 + draw(&seed) % 7, order_v = 2 + draw(&seed) % 7;
		size_t count_u = draw_knots(&seed, order_u, knots[0]);
		size_t count_v = draw_knots(&seed, order_v, knots[1]);
		size_t m[3], n[3];
		for (size_t c = 0; c < 3; c++) {
			m[c] = draw(&seed) % order_u;
			n[c] = draw(&seed) % order_v;
			for (size_t j = 0; j < count_v; j++)
				for (size_t i = 0; i < count_u; i++)
					poles[(j * count_u + i) * 3 + c] = symmetric(&knots[0][i + 1], order_u - 1,
					                                             m[c]) *
					                                   symmetric(&knots[1][j + 1], order_v - 1,
					                                             n[c]);
		}
		oracle_surface surface = { order_u,  order_v,  count_u, count_v,
			                       knots[0], knots[1], poles,   NULL };
		for (size_t i = 0; i < 8; i++) {
			long double u = knots[0][order_u - 1], v = knots[1][order_v - 1];
			u += (knots[0][count_u] - u) * (long double)(draw(&seed) % 17) / 16;
			v += (knots[1][count_v] - v) * (long double)(draw(&seed) % 17) / 16;
			oracle_jet jet, magnitude;
			assert_true(oracle_surface_at(&surface, u, v, jet));
			assert_true(oracle_surface_magnitude(&surface, u, v, magnitude));
			for (size_t a = 0; a < ORACLE_ORDERS; a++) {
				for (size_t b = 0; b < ORACLE_ORDERS; b++) {
					for (size_t c = 0; c < 3; c++) {
						long double exact = power(order_u - 1, m[c], a, u) *
						                    power(order_v - 1, n[c], b, v);
						if (a + b >= ORACLE_ORDERS)
							exact = 0;
						assert_true(fabsl(jet[a][b][c] - exact) <= 5e-18L * magnitude[a][b][c]);
						assert_true(magnitude[a][b][c] >= fabsl(exact) * (1 - 1e-15L));
					}
				}
			}
		}
	}
}

/* Basis functions of order 4 over 0, 1, 2, 3 (Letcher's figure 7), as curves of one unit point. */
static void test_basis_values(void **state)
{
	(void)state;
	static const double knots[] = { 0, 0, 0, 0, 1, 2, 3, 3, 3, 3 };
	static const long double at[] = { 0, 0.5L, 1, 1.5L, 2, 3 };
	static const long double table[6][6] = {
		{ 1, 0, 0, 0, 0, 0 },
		{ 1 / 8.0L, 19 / 32.0L, 25 / 96.0L, 1 / 48.0L, 0, 0 },
		{ 0, 1 / 4.0L, 7 / 12.0L, 1 / 6.0L, 0, 0 },
		{ 0, 1 / 32.0L, 15 / 32.0L, 15 / 32.0L, 1 / 32.0L, 0 },
		{ 0, 0, 1 / 6.0L, 7 / 12.0L, 1 / 4.0L, 0 },
		{ 0, 0, 0, 0, 0, 1 },
	};
	for (size_t pole = 0; pole < 6; pole++) {
		double poles[6] = { 0 };
		poles[pole] = 1;
		oracle_curve curve = { 4, 6, 1, knots, poles, NULL };
		for (size_t i = 0; i < 6; i++) {
			long double out[ORACLE_ORDERS][3];
			assert_true(oracle_curve_at(&curve, at[i], out));
			assert_true(near(out[0][0], table[i][pole], 1e-18L));
		}
		/* speed at the beginning: (k - 1) / t_{k+1} times the first leg */
		long double out[ORACLE_ORDERS][3];
		assert_true(oracle_curve_at(&curve, 0, out));
		assert_true(near(out[1][0], pole == 0 ? -3 : pole == 1 ? 3 : 0, 1e-18L));
	}
}

/* At an inner knot of multiplicity m, order - 1 - m derivatives go on and the next one jumps. */
static void test_continuity_at_knots(void **state)
{
	(void)state;
	static const double knots[] = { 0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 4, 4, 4, 4 };
	static const double flat[] = { 0, 0, 1, 1 };
	static const size_t before[] = { 3, 4, 6 }, after[] = { 4, 6, 9 };
	static const size_t smooth[] = { 2, 1, 0 };
	double poles[60];
	uint64_t seed = 3;
	for (size_t i = 0; i < 60; i++)
		poles[i] = (double)(draw(&seed) % 64);
	oracle_surface surface = { 4, 2, 10, 2, knots, flat, poles, NULL };
	for (size_t i = 0; i < 3; i++) {
		long double at = (long double)i + 1;
		size_t span[2];
		oracle_jet left, right;
		assert_true(oracle_surface_spans(&surface, at, 0.5L, span));
		assert_int_equal(span[0], after[i]);
		assert_int_equal(span[1], 1);
		assert_true(oracle_surface_in_span(&surface, span, at, 0.5L, right));
		span[0] = before[i];
		assert_true(oracle_surface_in_span(&surface, span, at, 0.5L, left));
		for (size_t a = 0; a <= smooth[i]; a++)
			for (size_t c = 0; c < 3; c++)
				assert_true(near(left[a][0][c], right[a][0][c], 1e-16L));
		assert_true(fabsl(left[smooth[i] + 1][0][0] - right[smooth[i] + 1][0][0]) > 1);
	}
}

/* The first quadrant of the unit circle, with whole weights. */
static const double quadrant_knots[] = { 0, 0, 0, 1, 1, 1 };
static const double quadrant[3][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 } };
static const double quadrant_weights[] = { 1, 1, 2 };

static void test_conic(void **state)
{
	(void)state;
	oracle_curve circle = { 3, 3, 2, quadrant_knots, &quadrant[0][0], quadrant_weights };
	for (size_t i = 0; i <= 20; i++) {
		long double t = (long double)i / 20, q = 1 + t * t, out[ORACLE_ORDERS][3];
		assert_true(oracle_curve_at(&circle, t, out));
		assert_true(near(out[0][0], (1 - t * t) / q, 1e-18L));
		assert_true(near(out[0][1], 2 * t / q, 1e-18L));
		assert_true(near(out[1][0], -4 * t / (q * q), 3e-18L));
		assert_true(near(out[1][1], 2 * (1 - t * t) / (q * q), 3e-18L));
		assert_true(near(out[2][0], (12 * t * t - 4) / (q * q * q), 1e-17L));
		assert_true(near(out[2][1], 4 * t * (t * t - 3) / (q * q * q), 1e-17L));
		assert_true(near(out[3][0], 48 * t * (1 - t * t) / (q * q * q * q), 1e-16L));
		assert_true(
			near(out[3][1], -12 * (1 - 6 * t * t + t * t * t * t) / (q * q * q * q), 1e-16L));
	}
}

static long double curvature(const long double d[ORACLE_ORDERS][3], long double *torsion)
{
	long double c[3], across = 0, speed = 0, triple = 0;
	for (size_t i = 0; i < 3; i++) {
		size_t j = (i + 1) % 3, k = (i + 2) % 3;
		c[i] = d[1][j] * d[2][k] - d[1][k] * d[2][j];
		across += c[i] * c[i];
		speed += d[1][i] * d[1][i];
		triple += c[i] * d[3][i];
	}
	*torsion = triple / across;
	return sqrtl(across) / (speed * sqrtl(speed));
}

/* The parabola y = x^2 and the twisted cubic (t, t^2, t^3). */
static void test_curves_of_bezier(void **state)
{
	(void)state;
	static const double knots[] = { 0, 0, 0, 0, 3, 3, 3, 3 };
	static const double twisted[] = { 0, 0, 0, 1, 0, 0, 2, 3, 0, 3, 9, 27 };
	static const double parabola_knots[] = { -1, -1, -1, 1, 1, 1 };
	static const double parabola[] = { -1, 1, 0, -1, 1, 1 };
	long double d[ORACLE_ORDERS][3], torsion, node[40], weight[40], length[2] = { 0, 0 };
	oracle_curve curves[] = { { 3, 3, 2, parabola_knots, parabola, NULL },
		                      { 4, 4, 3, knots, twisted, NULL } };
	for (int i = -4; i <= 4; i++) {
		long double x = i / 4.0L;
		assert_true(oracle_curve_at(&curves[0], x, d));
		assert_true(near(curvature(d, &torsion), 2 / powl(1 + 4 * x * x, 1.5L), 1e-17L));
		assert_true(torsion == 0);
	}
	for (int i = 0; i <= 4; i++) {
		long double t = i / 4.0L, q = 1 + 9 * t * t + 9 * powl(t, 4);
		assert_true(oracle_curve_at(&curves[1], t, d));
		assert_true(near(curvature(d, &torsion),
		                 2 * sqrtl(q) / powl(1 + 4 * t * t + 9 * powl(t, 4), 1.5L), 1e-17L));
		assert_true(near(torsion, 3 / q, 1e-17L));
	}
	oracle_gauss(40, node, weight);
	for (size_t which = 0; which < 2; which++) {
		for (size_t i = 0; i < 40; i++) {
			assert_true(oracle_curve_at(&curves[which], (1 + node[i]) / 2, d));
			length[which] += weight[i] / 2 * hypotl(hypotl(d[1][0], d[1][1]), d[1][2]);
		}
	}
	assert_true(near(length[0], 1.478942857544597L, 1e-15L));
	assert_true(near(length[1], 1.863022982513L, 1e-12L));
}

static void test_gauss_is_exact_on_powers(void **state)
{
	(void)state;
	long double node[64], weight[64];
	for (size_t count = 1; count <= 64; count++) {
		oracle_gauss(count, node, weight);
		for (size_t n = 0; n < 2 * count; n++) {
			long double sum = 0;
			for (size_t i = 0; i < count; i++)
				sum += weight[i] * powl(node[i], (long double)n);
			assert_true(near(sum, n % 2 ? 0 : 2 / (long double)(n + 1), 1e-17L));
		}
		for (size_t i = 1; i < count; i++)
			assert_true(node[i] > node[i - 1]);
	}
}

static void test_what_is_no_surface(void **state)
{
	(void)state;
	static const double falling[] = { 0, 0, 0, 1, 0.5, 1 };
	static const double empty[] = { 0, 0, 1, 1, 1, 2 };
	static const double infinite[] = { 0, 0, 0, 1, 1, INFINITY };
	static const double weightless[9] = { 0 }, flat[27] = { 0 };
	const oracle_surface good = { 3, 3, 3, 3, quadrant_knots, quadrant_knots, flat, NULL };
	oracle_surface bad[7] = { good, good, good, good, good, good, good };
	oracle_jet jet;
	bad[0].order_u = 1;
	bad[1].order_v = 9;
	bad[2].count_u = 2;
	bad[3].knots_u = falling;
	bad[4].knots_v = empty;
	bad[5].knots_u = infinite;
	bad[6].weights = weightless;
	assert_true(oracle_surface_at(&good, 0.5L, 0.5L, jet));
	for (size_t i = 0; i < 7; i++)
		assert_false(oracle_surface_at(&bad[i], 0.5L, 0.5L, jet));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_powers_come_out_on_any_knots),
		cmocka_unit_test(test_products_of_powers),
		cmocka_unit_test(test_basis_values),
		cmocka_unit_test(test_continuity_at_knots),
		cmocka_unit_test(test_conic),
		cmocka_unit_test(test_curves_of_bezier),
		cmocka_unit_test(test_gauss_is_exact_on_powers),
		cmocka_unit_test(test_what_is_no_surface),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
