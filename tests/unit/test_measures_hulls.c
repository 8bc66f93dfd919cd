/* The measures of the shipped hulls against the figures that were printed for them, and the
 * energies against sums written out. */
#include "batten.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

static batten_context *make_context(void)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	return context;
}

static batten_measures measure_shipped(const char *name, batten_quadrature rule)
{
	batten_context *context = make_context();
	char path[512];
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_read(context, path, &hull), BATTEN_OK);
	batten_measure_options options;
	batten_measure_options_default(&options);
	options.quadrature = rule;
	batten_measures measures;
	if (batten_hull_measure(context, hull, &options, &measures) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	batten_hull_destroy(hull);
	batten_context_destroy(context);
	return measures;
}

static void assert_near(double value, double expected, double tolerance)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%.17g where %.17g is expected", value, expected);
}

/* Thesis table 5.2, the column of the parent: every figure to its last digit, LCB to two units. */
static void npl_as_printed(void **state)
{
	(void)state;
	batten_measures m = measure_shipped("npl_parent", BATTEN_QUADRATURE_SPLINE);
	assert_near(m.lwl_m, 2.54, 0.0005);
	assert_near(m.beam_wl_m, 0.438, 0.0005);
	assert_near(m.cwp, 0.848, 0.0005);
	assert_near(m.cb, 0.54, 0.0005);
	assert_near(m.cm, 0.71, 0.0005);
	assert_near(m.volume_m3, 0.144, 0.0005);
	assert_near(m.lcb_pct_lbp_fwd, -6.126, 0.002);
	assert_near(m.fn_per_m2, 7.16, 0.005);
}

/* Thesis tables 2.2 to 2.6: volume 244, C_M 0.887, C_P 0.588, C_WP 0.753, LCB -1.34, LCF -4.06. The
 * printed C_M is less than the polygon through the offsets, which a convex section encloses, so no
 * rule reaches it: the polygon comes nearest in volume and C_M, the spline in the rest. */
static void trawler_as_printed(void **state)
{
	(void)state;
	batten_measures fair = measure_shipped("bsra_trawler", BATTEN_QUADRATURE_SPLINE);
	assert_near(fair.cp, 0.588, 0.003);
	assert_near(fair.cwp, 0.753, 0.0006);
	assert_near(fair.lcb_pct_lbp_fwd, -1.34, 0.04);
	assert_near(fair.lcf_pct_lbp_fwd, -4.06, 0.02);
	assert_near(fair.beam_wl_m, 6.1, 1e-12);
	batten_measures polygon = measure_shipped("bsra_trawler", BATTEN_QUADRATURE_TRAPEZOID);
	assert_near(polygon.volume_m3, 244, 2.44);
	assert_near(polygon.cm, 0.887, 0.012);
	assert_true(polygon.cm > 0.887 && fair.cm > polygon.cm);
}

static void simpson_refuses_uneven_tables(void **state)
{
	(void)state;
	static const char *const names[] = { "npl_parent", "bsra_trawler", "highspeed_craft", "wigley",
		                                 "wigley_noisy" };
	batten_context *context = make_context();
	for (size_t k = 0; k < 5; k++) {
		char path[512];
		(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, names[k]);
		batten_hull *hull = NULL;
		assert_int_equal(batten_hull_read(context, path, &hull), BATTEN_OK);
		batten_measure_options options;
		batten_measure_options_default(&options);
		options.quadrature = BATTEN_QUADRATURE_SIMPSON;
		batten_measures measures;
		assert_int_equal(batten_hull_measure(context, hull, &options, &measures), BATTEN_INPUT);
		batten_hull_destroy(hull);
	}
	batten_context_destroy(context);
}

enum { NX = 6, NZ = 5 };
typedef double form(double x, double z);

static batten_measures measure_form(form *surface, const double *x, const double *z)
{
	double y[NX * NZ];
	for (size_t i = 0; i < (size_t)NX * NZ; i++)
		y[i] = surface(x[i % NX], z[i / NX]);
	batten_context *context = make_context();
	batten_hull_table table = { "test", 10, 2, NX, NZ, x, z, y, NULL };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(context, &table, &hull), BATTEN_OK);
	batten_measures measures;
	if (batten_hull_measure(context, hull, NULL, &measures) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	batten_hull_destroy(hull);
	batten_context_destroy(context);
	return measures;
}

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

/* Forms whose derivatives the three-point stencils hold exactly: the sums over the inner nodes can
 * be written out. */
static void energies(void **state)
{
	(void)state;
	static const double x[NX] = { 0, 1, 3, 4.5, 8, 10 }, z[NZ] = { 0, 0.4, 1, 1.6, 2 };
	double bending[2] = { 0 }, mean[2] = { 0 }, gauss[2] = { 0 };
	for (size_t j = 1; j + 1 < NZ; j++)
		for (size_t i = 1; i + 1 < NX; i++) {
			double cell = (x[i + 1] - x[i - 1]) / 2 * (z[j + 1] - z[j - 1]) / 2;
			/* a cylinder of curvature k */
			double w = sqrt(1 + pow(0.6 * z[j], 2)), k = 0.6 / (w * w * w);
			bending[0] += k * k * w * cell;
			mean[0] += k * k / 4 * w * cell;
			/* y = a x z: K = -a^2 / w^4, H = -a^3 x z / w^3 */
			double a = 0.2, p = a * (z[j] - 1), q = a * (x[i] - 5);
			w = sqrt(1 + p * p + q * q);
			double big_k = -a * a / pow(w, 4), h = -a * p * q / (w * w * w);
			bending[1] += (4 * h * h - 2 * big_k) * w * cell;
			mean[1] += h * h * w * cell;
			gauss[1] += -big_k * w * cell;
		}
	form *const forms[] = { trough, saddle };
	for (size_t k = 0; k < 2; k++) {
		batten_measures m = measure_form(forms[k], x, z);
		assert_near(m.energy_bending, bending[k], 1e-12);
		assert_near(m.energy_mean, mean[k], 1e-12);
		assert_near(m.energy_gauss, gauss[k], 1e-12);
	}
	batten_measures m = measure_form(plane, x, z);
	assert_near(m.energy_bending, 0, 1e-24);
	assert_near(m.energy_mean, 0, 1e-24);
	assert_near(m.energy_gauss, 0, 1e-24);
	assert_near(m.fn_per_m2, 0, 1e-24);
	assert_near(m.fn_sections_per_m2, 0, 1e-24);
	assert_true(m.inflections == 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(npl_as_printed),
		cmocka_unit_test(trawler_as_printed),
		cmocka_unit_test(simpson_refuses_uneven_tables),
		cmocka_unit_test(energies),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
