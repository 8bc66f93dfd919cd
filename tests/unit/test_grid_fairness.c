/* Fairness of offset grids as a search sees it, against the oracle's surface at every node. */
#include "support/search_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

typedef long double vector[3];

static long double inner(const vector a, const vector b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Second fundamental form over an orthonormal frame: the tangent of the waterline, and square to it,
 * each given by its parts along X_x and X_z. */
static void shape_operator(const oracle_shape *s, long double k[3])
{
	const vector by_x = { 1.0L, s->y_x, 0.0L };
	const vector by_z = { 0.0L, s->y_z, 1.0L };
	const long double length = sqrtl(inner(by_x, by_x));
	const long double part = inner(by_x, by_z) / inner(by_x, by_x);
	const vector square = { by_z[0] - part * by_x[0], by_z[1] - part * by_x[1],
		                    by_z[2] - part * by_x[2] };
	const long double width = sqrtl(inner(square, square));
	const long double along[2] = { 1.0L / length, 0.0L };
	const long double across[2] = { -part / width, 1.0L / width };
	/* y_xx ... times the y of the unit normal */
	const long double normal = 1.0L / sqrtl(1.0L + s->y_x * s->y_x + s->y_z * s->y_z);
	const long double *const pairs[3][2] = { { along, along },
		                                     { along, across },
		                                     { across, across } };
	for (int i = 0; i < 3; i++) {
		const long double *a = pairs[i][0];
		const long double *b = pairs[i][1];
		k[i] = normal * (a[0] * b[0] * s->y_xx + (a[0] * b[1] + a[1] * b[0]) * s->y_xz +
		                 a[1] * b[1] * s->y_zz);
	}
}

static long double density(batten_fairness fairness, long double along, long double across,
                           long double half_beam, const oracle_shape *s)
{
	long double k[3];
	shape_operator(s, k);
	const long double a = sqrtl(along);
	const long double b = sqrtl(across);
	const long double gauss = a * b * (k[0] * k[2] - k[1] * k[1]);
	const long double blunt = 1e-3L / (half_beam * half_beam);
	const long double mean = 0.5L * (a * k[0] + b * k[2]);
	if (fairness == BATTEN_FAIRNESS_GAUSS)
		return sqrtl(gauss * gauss + blunt * blunt);
	if (fairness == BATTEN_FAIRNESS_MEAN)
		return mean * mean;
	return along * k[0] * k[0] + 2.0L * a * b * k[1] * k[1] + across * k[2] * k[2];
}

static bool is_inside(const search_case *c, size_t i, size_t k)
{
	const uint8_t *nodes = batten_hull_nodes(c->hull);
	for (size_t b = k - 1; b <= k + 1; b++)
		for (size_t a = i - 1; a <= i + 1; a++)
			if (nodes[b * c->grid.station_count + a] == BATTEN_NODE_OUTSIDE)
				return false;
	return true;
}

static long double known_fairness(const search_case *c, const batten_search_options *options)
{
	const size_t nx = c->grid.station_count;
	const size_t nz = c->grid.waterline_count;
	long double sum = 0.0L;
	for (size_t k = 1; k + 1 < nz; k++)
		for (size_t i = 1; i + 1 < nx; i++) {
			oracle_shape shape;
			if (!is_inside(c, i, k))
				continue;
			assert_true(oracle_shape_at(nx, nz, c->grid.x_m, c->grid.z_m, batten_hull_y_m(c->hull),
			                            i, k, &shape));
			const long double cell = 0.25L * (c->grid.x_m[i + 1] - c->grid.x_m[i - 1]) *
			                         (c->grid.z_m[k + 1] - c->grid.z_m[k - 1]);
			sum += cell * sqrtl(1.0L + shape.y_x * shape.y_x + shape.y_z * shape.y_z) *
			       density(options->fairness, options->longitudinal_weight,
			               options->transverse_weight, c->half_beam_m, &shape);
		}
	return sum;
}

static batten_search_options options_of(batten_fairness fairness, double along, double across)
{
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = BATTEN_DEVICE_REFERENCE;
	options.fairness = fairness;
	options.longitudinal_weight = along;
	options.transverse_weight = across;
	return options;
}

/* The objective at the start is all fairness: closeness is 0 there. */
static void check(const char *name, batten_fairness fairness, double along, double across,
                  batten_precision precision)
{
	search_case c = search_case_open(name, 0.01, true);
	batten_search_options options = options_of(fairness, along, across);
	options.precision = precision;
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	batten_search_result result;
	double *y = calloc(c.nodes, sizeof *y);
	assert_non_null(y);
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &result, NULL),
		BATTEN_OK);
	const double known = (double)known_fairness(&c, &options);
	const double tolerance = precision == BATTEN_F64 ? 1e-12 : 1e-4;
	if (!(fabs(result.objective_start - known) <= tolerance * known))
		fail_msg("%s fairness %d weights %g %g: found %.17g, the oracle %.17g", name, fairness,
		         along, across, result.objective_start, known);
	assert_true(result.objective_end < result.objective_start);
	free(y);
	search_case_close(&c);
}

static void test_fairness_is_the_oracles(void **state)
{
	(void)state;
	static const char *const hulls[] = { "npl_parent", "wigley_noisy" };
	static const double weights[][2] = { { 1.0, 1.0 }, { 4.0, 1.0 }, { 1.0, 0.0 }, { 0.0, 3.0 } };
	for (int h = 0; h < 2; h++)
		for (int w = 0; w < 4; w++)
			for (int fairness = BATTEN_FAIRNESS_BENDING; fairness <= BATTEN_FAIRNESS_GAUSS;
			     fairness++)
				check(hulls[h], (batten_fairness)fairness, weights[w][0], weights[w][1],
				      BATTEN_F64);
	check("npl_parent", BATTEN_FAIRNESS_BENDING, 4.0, 1.0, BATTEN_F32);
	check("npl_parent", BATTEN_FAIRNESS_MEAN, 4.0, 1.0, BATTEN_F32);
	check("npl_parent", BATTEN_FAIRNESS_GAUSS, 4.0, 1.0, BATTEN_F32);
}

/* Weighted alike, bending is bending times the weight: the two formulas agree. */
static void test_equal_weights_scale(void **state)
{
	(void)state;
	search_case c = search_case_open("bsra_trawler", 0.01, true);
	batten_search_result results[2];
	double *y = calloc(c.nodes, sizeof *y);
	assert_non_null(y);
	for (int w = 0; w < 2; w++) {
		const double weight = w ? 2.0 : 1.0;
		const batten_search_options options = options_of(BATTEN_FAIRNESS_BENDING, weight, weight);
		const batten_search_problem problem = search_case_problem(&c, 1.0 / weight, 1e4);
		assert_int_equal(
			batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &results[w], NULL),
			BATTEN_OK);
	}
	assert_true(fabs(results[1].objective_start - results[0].objective_start) <=
	            1e-12 * results[0].objective_start);
	assert_true(fabs(results[1].objective_end - results[0].objective_end) <=
	            1e-7 * results[0].objective_end);
	free(y);
	search_case_close(&c);
}

/* What is weighted more comes out lower. */
static void test_weights_do_what_they_say(void **state)
{
	(void)state;
	search_case c = search_case_open("npl_parent", 0.01, true);
	const size_t nx = c.grid.station_count;
	double *y = calloc(c.nodes, sizeof *y);
	assert_non_null(y);
	long double bent[2][2] = { { 0.0L } };
	for (int w = 0; w < 2; w++) {
		const batten_search_options options = options_of(BATTEN_FAIRNESS_BENDING, w ? 30.0 : 1.0,
		                                                 w ? 1.0 : 30.0);
		const batten_search_problem problem = search_case_problem(&c, 1.0, 1e3);
		batten_search_result result;
		assert_int_equal(
			batten_search_batch(c.context, &c.grid, 1, &problem, &options, y, &result, NULL),
			BATTEN_OK);
		for (size_t k = 1; k + 1 < c.grid.waterline_count; k++)
			for (size_t i = 1; i + 1 < nx; i++) {
				oracle_shape shape;
				long double entries[3];
				if (!is_inside(&c, i, k))
					continue;
				assert_true(oracle_shape_at(nx, c.grid.waterline_count, c.grid.x_m, c.grid.z_m, y,
				                            i, k, &shape));
				shape_operator(&shape, entries);
				bent[w][0] += shape.area * entries[0] * entries[0];
				bent[w][1] += shape.area * entries[2] * entries[2];
			}
	}
	assert_true(bent[1][0] < bent[0][0]);
	assert_true(bent[1][1] > bent[0][1]);
	free(y);
	search_case_close(&c);
}

static void expect_usage(const batten_search_options *options)
{
	search_case c = search_case_open("wigley", 0.01, false);
	const batten_search_problem problem = search_case_problem(&c, 1.0, 1e4);
	batten_search_result result;
	double *y = calloc(c.nodes, sizeof *y);
	assert_non_null(y);
	assert_int_equal(
		batten_search_batch(c.context, &c.grid, 1, &problem, options, y, &result, NULL),
		BATTEN_USAGE);
	free(y);
	search_case_close(&c);
}

static void test_refusals(void **state)
{
	(void)state;
	const batten_search_options refused[] = {
		options_of(BATTEN_FAIRNESS_VARIATION, 2.0, 1.0),
		options_of((batten_fairness)7, 1.0, 1.0),
		options_of(BATTEN_FAIRNESS_BENDING, 0.0, 0.0),
		options_of(BATTEN_FAIRNESS_BENDING, -1.0, 1.0),
		options_of(BATTEN_FAIRNESS_BENDING, 1.0, NAN),
		options_of(BATTEN_FAIRNESS_BENDING, 1e7, 1.0),
		options_of(BATTEN_FAIRNESS_BENDING, 1e-7, 1.0),
	};
	for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++)
		expect_usage(&refused[i]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_fairness_is_the_oracles),
		cmocka_unit_test(test_equal_weights_scale),
		cmocka_unit_test(test_weights_do_what_they_say),
		cmocka_unit_test(test_refusals),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
