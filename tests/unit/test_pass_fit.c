/* The fit of a line (thesis 5.3) against the oracle: long double, basis functions by de Boor, normal
 * equations by Gauss, places on the curve by halving. */
#include "oracle/oracle_bspline.h"
#include "unit/pass_fixture.h"

enum { POINTS = 21, VERTICES = 8, KNOTS_MOST = VERTICES + ORACLE_ORDER_MOST };

/* 0 (order times), 1, 2, ..., last (order times). */
static void make_knots(size_t order, double *knots)
{
	const size_t last = VERTICES - order + 1;
	for (size_t k = 0; k < VERTICES + order; k++)
		knots[k] = k < order ? 0 : k - order + 1 < last ? (double)(k - order + 1) : (double)last;
}

static void curve_at(size_t order, const double *knots, const double *poles, long double t,
                     long double *x, long double *y)
{
	long double derivative[ORACLE_ORDERS][3];
	const oracle_curve curve = { order, VERTICES, 2, knots, poles, NULL };
	assert_true(oracle_curve_at(&curve, t, derivative));
	*x = derivative[0][0];
	*y = derivative[0][1];
}

/* Polygon vertices by least squares; the first and the last are the end points. */
static void fit(size_t order, const double *knots, const double *x, const double *y, double *poles)
{
	long double a[VERTICES][VERTICES + 2] = { { 0 } };
	long double length = 0, total = 0;
	for (size_t i = 1; i < POINTS; i++)
		total += hypotl((long double)x[i] - x[i - 1], (long double)y[i] - y[i - 1]);
	for (size_t i = 0; i < POINTS; i++) {
		long double row[VERTICES], none;
		if (i > 0)
			length += hypotl((long double)x[i] - x[i - 1], (long double)y[i] - y[i - 1]);
		for (size_t v = 0; v < VERTICES; v++) {
			double unit[2 * VERTICES] = { 0 };
			unit[2 * v] = 1;
			const long double t = i + 1 < POINTS ? length / total * knots[VERTICES]
			                                     : (long double)knots[VERTICES];
			curve_at(order, knots, unit, t, &row[v], &none);
		}
		for (size_t v = 0; v < VERTICES; v++) {
			for (size_t w = 0; w < VERTICES; w++)
				a[v][w] += row[v] * row[w];
			a[v][VERTICES] += row[v] * x[i];
			a[v][VERTICES + 1] += row[v] * y[i];
		}
	}
	for (size_t v = 0; v < VERTICES; v++)
		for (size_t r = 0; r < VERTICES; r++)
			for (size_t w = VERTICES + 2; r != v && w-- > v;)
				a[r][w] -= a[r][v] / a[v][v] * a[v][w];
	for (size_t v = 0; v < VERTICES; v++)
		for (size_t c = 0; c < 2; c++)
			poles[2 * v + c] = (double)(a[v][VERTICES + c] / a[v][v]);
	poles[0] = x[0];
	poles[1] = y[0];
	poles[2 * VERTICES - 2] = x[POINTS - 1];
	poles[2 * VERTICES - 1] = y[POINTS - 1];
}

static double fitted_at(size_t order, const double *knots, const double *poles, double along)
{
	long double low = 0, high = knots[VERTICES], x = 0, y = 0;
	for (int turn = 0; turn < 80; turn++) {
		curve_at(order, knots, poles, (low + high) / 2, &x, &y);
		*(x < along ? &low : &high) = (low + high) / 2;
	}
	return (double)y;
}

static void test_against_oracle(void **state)
{
	double x[POINTS], y[POINTS], found[POINTS], knots[KNOTS_MOST], poles[2 * VERTICES];
	for (size_t i = 0; i < POINTS; i++) {
		const double u = (double)i / (POINTS - 1);
		x[i] = 10 * u + 2 * u * (1 - u);
		y[i] = 3 * sqrt(u) * (1 - 0.8 * u) + 0.02 * (double)(i * 7919 % 13);
	}
	for (size_t order = 2; order <= 6; order++) {
		batten_pass_options options;
		batten_pass *pass = NULL;
		batten_pass_options_default(&options);
		options.method = BATTEN_METHOD_FORWARD_FIT;
		options.order = (unsigned)order;
		options.vertices = VERTICES;
		options.device = BATTEN_DEVICE_REFERENCE;
		assert_int_equal(batten_pass_create_line(*state, POINTS, x, &options, &pass), BATTEN_OK);
		assert_int_equal(batten_pass_batch(*state, pass, 1, 1, y, found, NULL), BATTEN_OK);
		batten_pass_destroy(pass);
		make_knots(order, knots);
		fit(order, knots, x, y, poles);
		for (size_t i = 1; i + 1 < POINTS; i++)
			assert_near(found[i], fitted_at(order, knots, poles, x[i]), 1e-11, "fitted point");
		assert_true(found[0] == y[0] && found[POINTS - 1] == y[POINTS - 1]);
		assert_true(fabs(found[5] - y[5]) > 1e-4);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_against_oracle, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
