/* Surfaces as the library evaluates and changes them against the oracle. The bounds are small
 * multiples of the rounding unit times what the oracle calls the magnitude of the terms. */
#include "surface_fixture.h"

#include "geometry/bspline.h"

enum { ORDER_PAIRS = 49 };

#define UNIT (0x1p-53L) /* the rounding unit of double */

/* The largest |a - b| / magnitude. */
static long double furthest(const double a[4][4][3], const oracle_jet b, const oracle_jet magnitude)
{
	long double worst = 0;
	for (size_t i = 0; i < 4; i++) {
		for (size_t j = 0; j < 4; j++) {
			for (size_t c = 0; c < 3; c++) {
				long double away = fabsl(a[i][j][c] - b[i][j][c]);
				if (!(away <= worst * magnitude[i][j][c])) /* a NaN is far away */
					worst = away > 0 && magnitude[i][j][c] > 0 ? away / magnitude[i][j][c]
					                                           : (long double)INFINITY;
			}
		}
	}
	return worst;
}

static void test_derivatives(void **state)
{
	(void)state;
	uint64_t seed = 1;
	batten_context *context = open_context();
	drawn d;
	for (size_t round = 0; round < 4 * ORDER_PAIRS; round++) {
		draw_net(&seed, 2 + round % 7, 2 + round / 7 % 7, round >= 2 * ORDER_PAIRS, &d);
		batten_surface *surface = NULL;
		assert_int_equal(batten_surface_create(context, &d.net, &surface), BATTEN_OK);
		oracle_surface exact = as_oracle(&d.net);
		for (size_t i = 0; i < 40; i++) {
			double u = draw_place(&seed, d.net.order_u, d.net.count_u, d.knots_u);
			double v = draw_place(&seed, d.net.order_v, d.net.count_v, d.knots_v);
			if (i == 0 && !d.net.weights) /* a little beyond the range */
				v = d.knots_v[d.net.count_v] + 0.1;
			batten_surface_point point;
			oracle_jet jet, magnitude;
			assert_int_equal(batten_surface_evaluate(surface, u, v, &point), BATTEN_OK);
			assert_true(oracle_surface_at(&exact, u, v, jet));
			assert_true(oracle_surface_magnitude(&exact, u, v, magnitude));
			assert_true(furthest(point.derivative, jet, magnitude) <= 32 * UNIT);
		}
		batten_surface_destroy(surface);
	}
	batten_context_destroy(context);
}

/* A curve is what all rows of a surface have in common. */
static void test_curves(void **state)
{
	(void)state;
	uint64_t seed = 2;
	batten_context *context = open_context();
	for (size_t round = 0; round < 7 * 3 * 2 * 4; round++) {
		drawn d;
		double poles[POLES_MOST * 3];
		const double flat[] = { 0, 0, 1, 1 };
		size_t dimension = 1 + round / 7 % 3;
		draw_net(&seed, 2 + round % 7, 2, round / 21 % 2, &d);
		for (size_t i = 0; i < d.net.count_u; i++) {
			for (size_t c = 0; c < 3; c++) {
				double value = c < dimension ? d.poles[3 * i + c] : 0;
				d.poles[3 * i + c] = d.poles[3 * (d.net.count_u + i) + c] = value;
				if (c < dimension)
					poles[i * dimension + c] = value;
			}
			d.weights[d.net.count_u + i] = d.weights[i];
		}
		oracle_surface rows = as_oracle(&d.net);
		oracle_curve exact = {
			rows.order_u, rows.count_u, dimension, d.knots_u, poles, rows.weights
		};
		rows.count_v = 2;
		rows.knots_v = flat;
		struct bspline_curve curve;
		const struct bspline_curve_net net = { exact.order, exact.count, dimension,
			                                   exact.knots, poles,       exact.weights };
		assert_int_equal(bspline_curve_create(context, &net, &curve), BATTEN_OK);
		for (size_t i = 0; i < 20; i++) {
			double t = draw_place(&seed, exact.order, exact.count, exact.knots), values[4 * 3];
			long double right[4][3];
			oracle_jet magnitude;
			bspline_curve_evaluate(&curve, t, 3, values);
			assert_true(oracle_curve_at(&exact, t, right));
			assert_true(oracle_surface_magnitude(&rows, t, 0, magnitude));
			for (size_t n = 0; n < 4 * dimension; n++) {
				size_t order = n / dimension, c = n % dimension;
				assert_true(fabsl(values[n] - right[order][c]) <=
				            32 * UNIT * magnitude[order][0][c]);
			}
		}
		bspline_curve_destroy(&curve);
	}
	batten_context_destroy(context);
}

/* How far the point and the derivatives of `now` at now_u, now_v are from those of `before` at u
 * and v, mirrored and run backwards as sign[coordinate], sign_u and sign_v say. */
static long double difference(const batten_surface *now, long double now_u, long double now_v,
                              const batten_surface_net *before, double u, double v,
                              const double sign[3], double sign_u, double sign_v)
{
	batten_surface_net net = batten_surface_describe(now);
	oracle_surface new = as_oracle(&net), old = as_oracle(before);
	oracle_jet a, b, magnitude;
	double rounded[4][4][3];
	assert_true(oracle_surface_at(&new, now_u, now_v, a));
	assert_true(oracle_surface_at(&old, u, v, b));
	assert_true(oracle_surface_magnitude(&new, now_u, now_v, magnitude));
	for (size_t i = 0; i < 4; i++)
		for (size_t j = 0; j < 4; j++)
			for (size_t c = 0; c < 3; c++)
				rounded[i][j][c] = (double)(a[i][j][c] * sign[c] * (i % 2 ? sign_u : 1) *
				                            (j % 2 ? sign_v : 1));
	return furthest(rounded, b, magnitude);
}

static const double same[] = { 1, 1, 1 };

/* Somewhere inside a span, away from its knots: no knot moves past it. */
static double draw_inside(uint64_t *seed, size_t order, size_t count, const double *knots)
{
	for (;;) {
		size_t span = order - 1 + draw(seed) % (count - order + 1);
		if (knots[span] < knots[span + 1])
			return knots[span] + (knots[span + 1] - knots[span]) * draw_real(seed, 0.05, 0.95);
	}
}

/* Knots put in and orders raised leave every point and derivative where it was. */
static void test_refinement(void **state)
{
	(void)state;
	uint64_t seed = 3;
	batten_context *context = open_context();
	drawn d;
	for (size_t round = 0; round < 4 * ORDER_PAIRS; round++) {
		size_t order[2] = { 2 + round % 7, 2 + round / 7 % 7 };
		draw_net(&seed, order[0], order[1], round >= 2 * ORDER_PAIRS, &d);
		for (size_t kind = 0; kind < 2; kind++) {
			batten_direction along = draw(&seed) % 2 ? BATTEN_DIRECTION_V : BATTEN_DIRECTION_U;
			bool up = along == BATTEN_DIRECTION_V;
			size_t count = up ? d.net.count_v : d.net.count_u;
			batten_surface *surface = NULL;
			assert_int_equal(batten_surface_create(context, &d.net, &surface), BATTEN_OK);
			if (kind == 0) {
				double t = draw_inside(&seed, order[up], count, up ? d.knots_v : d.knots_u);
				assert_int_equal(batten_surface_insert_knot(surface, along, t,
				                                            1 + draw(&seed) % (order[up] - 1)),
				                 BATTEN_OK);
			} else {
				size_t times = order[up] == 8 ? 0 : 1 + draw(&seed) % (8 - order[up]);
				assert_int_equal(batten_surface_elevate(surface, along, times), BATTEN_OK);
			}
			for (size_t i = 0; i < 10; i++) {
				double u = draw_inside(&seed, order[0], d.net.count_u, d.knots_u);
				double v = draw_inside(&seed, order[1], d.net.count_v, d.knots_v);
				assert_true(difference(surface, u, v, &d.net, u, v, same, 1, 1) <= 16 * UNIT);
			}
			batten_surface_destroy(surface);
		}
	}
	batten_context_destroy(context);
}

/* Reversal and the mirror: the same surface run backwards, or with y turned over. */
static void test_reversal_and_mirror(void **state)
{
	(void)state;
	static const double port[] = { 1, -1, 1 };
	uint64_t seed = 4;
	batten_context *context = open_context();
	drawn d;
	long double worst = 0;
	for (size_t round = 0; round < 2 * ORDER_PAIRS; round++) {
		draw_net(&seed, 2 + round % 7, 2 + round / 7 % 7, round >= ORDER_PAIRS, &d);
		double u = draw_inside(&seed, d.net.order_u, d.net.count_u, d.knots_u);
		double v = draw_inside(&seed, d.net.order_v, d.net.count_v, d.knots_v);
		long double back_u = (long double)d.knots_u[d.net.order_u - 1] + d.knots_u[d.net.count_u] -
		                     u;
		long double back_v = (long double)d.knots_v[d.net.order_v - 1] + d.knots_v[d.net.count_v] -
		                     v;
		batten_surface *surface = NULL;
		assert_int_equal(batten_surface_create(context, &d.net, &surface), BATTEN_OK);
		batten_surface_reverse(surface, BATTEN_DIRECTION_U);
		worst = fmaxl(worst, difference(surface, back_u, v, &d.net, u, v, same, -1, 1));
		batten_surface_reverse(surface, BATTEN_DIRECTION_V);
		worst = fmaxl(worst, difference(surface, back_u, back_v, &d.net, u, v, same, -1, -1));
		batten_surface_mirror(surface);
		worst = fmaxl(worst, difference(surface, u, back_v, &d.net, u, v, port, 1, -1));
		batten_surface_destroy(surface);
	}
	assert_true(worst <= 32 * UNIT);
	batten_context_destroy(context);
}

/* A map of the poles is the same map of every point, and without its shift of every derivative. */
static void test_affine_maps(void **state)
{
	(void)state;
	uint64_t seed = 5;
	batten_context *context = open_context();
	drawn d;
	long double worst = 0;
	for (size_t round = 0; round < 2 * ORDER_PAIRS; round++) {
		draw_net(&seed, 2 + round % 7, 2 + round / 7 % 7, round >= ORDER_PAIRS, &d);
		double u = draw_place(&seed, d.net.order_u, d.net.count_u, d.knots_u);
		double v = draw_place(&seed, d.net.order_v, d.net.count_v, d.knots_v);
		double matrix[9], shift[3];
		for (size_t i = 0; i < 9; i++)
			matrix[i] = draw_real(&seed, -2, 2);
		for (size_t i = 0; i < 3; i++)
			shift[i] = draw_real(&seed, -5, 5);
		batten_surface *surface = NULL;
		oracle_surface before = as_oracle(&d.net);
		assert_int_equal(batten_surface_create(context, &d.net, &surface), BATTEN_OK);
		assert_int_equal(batten_surface_map(surface, matrix, shift), BATTEN_OK);
		batten_surface_net net = batten_surface_describe(surface);
		oracle_surface after = as_oracle(&net);
		oracle_jet a, b, magnitude, size;
		assert_true(oracle_surface_at(&before, u, v, a));
		assert_true(oracle_surface_magnitude(&before, u, v, magnitude));
		assert_true(oracle_surface_at(&after, u, v, b));
		assert_true(oracle_surface_magnitude(&after, u, v, size));
		for (size_t i = 0; i < 4; i++) {
			for (size_t j = 0; i + j < 4; j++) {
				for (size_t c = 0; c < 3; c++) {
					long double right = i + j == 0 ? shift[c] : 0, most = size[i][j][c];
					for (size_t k = 0; k < 3; k++) {
						right += matrix[3 * c + k] * a[i][j][k];
						most += fabs(matrix[3 * c + k]) * magnitude[i][j][k];
					}
					worst = fmaxl(worst, fabsl(b[i][j][c] - right) / most);
				}
			}
		}
		batten_surface_destroy(surface);
	}
	assert_true(worst <= 8 * UNIT);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_derivatives), cmocka_unit_test(test_curves),
		cmocka_unit_test(test_refinement),  cmocka_unit_test(test_reversal_and_mirror),
		cmocka_unit_test(test_affine_maps),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
