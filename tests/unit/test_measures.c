/* The measures of a hull against closed forms (Letcher 9-11): to rounding where the rule is exact,
 * else at the expected order over three tables. */
#include "unit/measures_fixture.h"

#include <stdio.h>

static const double pi = 3.14159265358979323846;
static const batten_quadrature spline = BATTEN_QUADRATURE_SPLINE,
							   simpson = BATTEN_QUADRATURE_SIMPSON,
							   trapezoid = BATTEN_QUADRATURE_TRAPEZOID;

static void assert_near(double value, double expected, double tolerance)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%.17g where %.17g is expected", value, expected);
}

/* Errors on three tables, each twice as fine as the one before, fall by 2^order. */
static void assert_order(const double values[3], double exact, double order, double slack)
{
	double e[3];
	for (size_t k = 0; k < 3; k++)
		e[k] = values[k] - exact;
	for (size_t k = 0; k < 2; k++) {
		double found = log2(fabs(e[k] / e[k + 1]));
		if (!(fabs(found - order) <= slack))
			fail_msg("order %g (errors %g, %g) where %g is expected", found, e[k], e[k + 1], order);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Wigley's parabolic hull, L 100, B 10, T 6.25
 * --------------------------------------------------------------------------------------------- */

static double wigley(double x, double z)
{
	double s = x / 100, t = 1 - z / 6.25;
	return 5 * 4 * s * (1 - s) * (1 - t * t);
}

/* Simpson's rule is exact for the volume, its moments and the areas. */
static void wigley_by_simpson(void **state)
{
	(void)state;
	batten_measures m = measure_form(wigley, 100, 6.25, 21, 11, simpson, 0);
	assert_relative(m.volume_m3, 100 * 10 * 6.25 * 4 / 9, 1e-12);
	assert_relative(m.displacement_t, 1.025 * 100 * 10 * 6.25 * 4 / 9, 1e-12);
	assert_relative(m.waterplane_area_m2, 2000.0 / 3, 1e-12);
	assert_relative(m.midship_area_m2, 125.0 / 3, 1e-12);
	assert_relative(m.max_section_area_m2, 125.0 / 3, 1e-12);
	assert_relative(m.kb_m, 3.90625, 1e-12);
	assert_relative(m.cb, 4.0 / 9, 1e-12);
	assert_relative(m.cp, 2.0 / 3, 1e-12);
	assert_relative(m.cm, 2.0 / 3, 1e-12);
	assert_relative(m.cwp, 2.0 / 3, 1e-12);
	assert_relative(m.cv, 2.7777777777777778, 1e-12);
	assert_relative(m.xcb_from_ap_m, 50, 1e-12);
	assert_relative(m.xcf_from_ap_m, 50, 1e-12);
	assert_near(m.lcb_pct_lbp_fwd, 0, 1e-12);
	assert_near(m.lcf_pct_lbp_fwd, 0, 1e-12);
	assert_relative(m.tpc_t_per_cm, 6.8333333333333333, 1e-12);
	assert_true(m.lbp_m == 100 && m.lwl_m == 100 && m.beam_wl_m == 10 && m.beam_max_m == 10);
	assert_true(m.draft_m == 6.25 && m.half_beam_m == 5);
}

/* What the spline along x cannot hold, three tables at a time. */
static void wigley_orders(void **state)
{
	(void)state;
	static const struct {
		batten_quadrature rule;
		double volume, area, i_t, i_l, surface; /* orders; 0: exact */
	} cases[] = {
		/* a natural spline leaves the end spans of a parabola at the second order */
		{ BATTEN_QUADRATURE_SPLINE, 3, 3, 4.8, 3, 3 },
		{ BATTEN_QUADRATURE_SIMPSON, 0, 0, 4, 4, 4 },
		{ BATTEN_QUADRATURE_TRAPEZOID, 2, 2, 4, 2, 2 },
	};
	for (size_t c = 0; c < 3; c++) {
		double volume[3], area[3], i_t[3], i_l[3], surface[3];
		size_t n = 20;
		for (size_t k = 0; k < 3; k++, n *= 2) {
			batten_measures m = measure_form(wigley, 100, 6.25, n + 1, n + 1, cases[c].rule, 0);
			volume[k] = m.volume_m3;
			area[k] = m.waterplane_area_m2;
			i_t[k] = m.i_t_m4;
			i_l[k] = m.i_l_m4;
			surface[k] = m.wetted_surface_m2;
		}
		if (cases[c].volume > 0) {
			assert_order(volume, 25000.0 / 9, cases[c].volume, 0.1);
			assert_order(area, 2000.0 / 3, cases[c].area, 0.1);
		}
		assert_order(i_t, 80000.0 / 21, cases[c].i_t, 0.2);
		assert_order(i_l, 1e6 / 3, cases[c].i_l, 0.1);
		assert_order(surface, 1487.9063104958, cases[c].surface, 0.15);
		assert_relative(surface[2], 1487.9063104958, 2e-5);
	}
}

/* Trapezoids on n x m intervals: (1 - 1/n^2)(1 - 1/(4 m^2)) of the volume. */
static void wigley_by_trapezoids(void **state)
{
	(void)state;
	static const size_t sizes[][2] = { { 20, 10 }, { 30, 20 }, { 40, 20 } };
	for (size_t k = 0; k < 3; k++) {
		size_t n = sizes[k][0], m = sizes[k][1];
		double nn = (double)(n * n), mm = (double)(m * m);
		batten_measures found = measure_form(wigley, 100, 6.25, n + 1, m + 1, trapezoid, 0);
		assert_relative(found.volume_m3, 25000.0 / 9 * (1 - 1 / nn) * (1 - 1 / (4 * mm)), 1e-12);
	}
}

/* At any draft, on a waterline or between two, the splines hold the sections exactly: everything
 * that the splines along x do not enter is exact, the rest in proportion to the full draft. */
static void wigley_at_other_drafts(void **state)
{
	(void)state;
	static const struct {
		double part, kb, cb_of_beam;
	} cases[] = { { 0.25, 1.02982954545454545, 0.3492063492063492 },
		          { 0.5, 2.03125, 0.3703703703703704 },
		          { 0.75, 2.99479166666666667, 0.4 } };
	batten_context *context = make_context();
	batten_hull *hull = make_hull(context, wigley, 100, 6.25, 21, 8);
	batten_measures full = measure_at(context, hull, spline, 0);
	assert_relative(full.kb_m, 3.90625, 1e-12);
	for (size_t k = 0; k < 3; k++) {
		double e = cases[k].part, c = 2 * e - e * e;
		batten_measures m = measure_at(context, hull, spline, 6.25 * e);
		assert_relative(m.kb_m, cases[k].kb, 1e-12);
		assert_relative(m.volume_m3 / full.volume_m3, 1.5 * (e * e - e * e * e / 3), 1e-12);
		assert_relative(m.waterplane_area_m2 / full.waterplane_area_m2, c, 1e-12);
		assert_relative(m.i_t_m4 / full.i_t_m4, c * c * c, 1e-12);
		assert_relative(m.i_l_m4 / full.i_l_m4, c, 1e-12);
		assert_relative(m.beam_wl_m, 10 * c, 1e-12);
		assert_relative(m.cb / m.cp, cases[k].cb_of_beam * 1.5, 1e-12);
		assert_relative(m.cb, m.cp * m.cm, 1e-13);
		/* dV/dT = the waterplane, d(V KB)/dT = the waterplane times T */
		double h = 1e-3, t = 6.25 * e;
		batten_measures up = measure_at(context, hull, spline, t + h);
		batten_measures down = measure_at(context, hull, spline, t - h);
		assert_relative((up.volume_m3 - down.volume_m3) / (2 * h), m.waterplane_area_m2, 1e-7);
		assert_relative((up.volume_m3 * up.kb_m - down.volume_m3 * down.kb_m) / (2 * h),
		                m.waterplane_area_m2 * t, 1e-7);
	}
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static double stretched(double x, double z)
{
	return 0.9 * wigley(x / 1.2, z / 1.1);
}

static void stretching(void **state)
{
	(void)state;
	const double l = 1.2, b = 0.9, d = 1.1;
	for (int rule = 0; rule < 3; rule++) {
		batten_measures a = measure_form(wigley, 100, 6.25, 21, 11, (batten_quadrature)rule, 0);
		batten_measures s = measure_form(stretched, 120, 6.875, 21, 11, (batten_quadrature)rule, 0);
		assert_relative(s.volume_m3, a.volume_m3 * l * b * d, 1e-12);
		assert_relative(s.midship_area_m2, a.midship_area_m2 * b * d, 1e-12);
		assert_relative(s.waterplane_area_m2, a.waterplane_area_m2 * l * b, 1e-12);
		assert_relative(s.cb, a.cb, 1e-12);
		assert_relative(s.cv, a.cv * b * d / (l * l), 1e-12);
		assert_relative(s.kb_m, a.kb_m * d, 1e-12);
		assert_relative(s.xcb_from_ap_m, a.xcb_from_ap_m * l, 1e-12);
		assert_relative(s.bmt_m, a.bmt_m * b * b / d, 1e-12);
		assert_relative(s.bml_m, a.bml_m * l * l / d, 1e-12);
	}
	double surface[3];
	size_t n = 20;
	for (size_t k = 0; k < 3; k++, n *= 2)
		surface[k] =
			measure_form(stretched, 120, 6.875, n + 1, n + 1, simpson, 0).wetted_surface_m2;
	assert_order(surface, 1870.504377532, 4, 0.15);
}

/* ------------------------------------------------------------------------------------------------
 * Other bodies
 * --------------------------------------------------------------------------------------------- */

static double box(double x, double z)
{
	(void)x;
	(void)z;
	return 5;
}

static void box_by_every_rule(void **state)
{
	(void)state;
	const double l = 60, b = 10, t = 4;
	for (int rule = 0; rule < 3; rule++) {
		batten_measures m = measure_form(box, l, t, 9, 5, (batten_quadrature)rule, 0);
		assert_relative(m.volume_m3, l * b * t, 1e-12);
		assert_relative(m.waterplane_area_m2, l * b, 1e-12);
		assert_relative(m.kb_m, t / 2, 1e-12);
		assert_relative(m.bmt_m, b * b / (12 * t), 1e-12);
		/* x^2 is beyond trapezoids, by 1 / (2 n^2) of the integral */
		double bml = l * l / (12 * t);
		assert_relative(m.bml_m, rule == BATTEN_QUADRATURE_TRAPEZOID ? bml * (1 + 2.0 / 64) : bml,
		                1e-12);
		assert_relative(m.kmt_m, t / 2 + b * b / (12 * t), 1e-12);
		/* bottom and sides; the ends are transoms */
		assert_relative(m.wetted_surface_m2, l * b + 2 * l * t, 1e-12);
		assert_relative(m.cb, 1, 1e-12);
		assert_relative(m.cp, 1, 1e-12);
		assert_relative(m.cm, 1, 1e-12);
		assert_relative(m.cwp, 1, 1e-12);
		assert_near(m.lcb_pct_lbp_fwd, 0, 1e-12);
	}
}

static double wedge(double x, double z)
{
	(void)x;
	return 5 * z / 4;
}

static void wedge_by_every_rule(void **state)
{
	(void)state;
	const double l = 60, b = 10, t = 4;
	for (int rule = 0; rule < 3; rule++) {
		batten_measures m = measure_form(wedge, l, t, 9, 5, (batten_quadrature)rule, 0);
		assert_relative(m.volume_m3, l * b * t / 2, 1e-12);
		if (rule != BATTEN_QUADRATURE_TRAPEZOID)
			assert_relative(m.kb_m, 2 * t / 3, 1e-12);
		assert_relative(m.bmt_m, b * b / (6 * t), 1e-12);
		assert_relative(m.wetted_surface_m2, 2 * l * sqrt(b * b / 4 + t * t), 1e-12);
		assert_relative(m.cb, 0.5, 1e-12);
		assert_relative(m.cm, 0.5, 1e-12);
		assert_relative(m.cwp, 1, 1e-12);
	}
}

/* Plane sides, a wedge aft that a raked stem brings to a point: y = B/2 (z/T - x/L). On the grid
 * the edge passes through nodes. */
static double raked(double x, double z)
{
	double y = 5 * (z / 4 - x / 60);
	return y >= -1e-12 ? fmax(y, 0) : NAN;
}

static const double raked_volume = 60 * 10 * 4 / 6.0;

/* Two triangles of 60 x 4 / 2 in the profile. */
static double raked_surface(void)
{
	return 2 * 120 * sqrt(1 + 1.0 / 144 + 25.0 / 16);
}

static void raked_stem(void **state)
{
	(void)state;
	static const double orders[] = { 3, 0, 2 };
	for (int rule = 0; rule < 3; rule += 2) {
		double volume[3];
		size_t n = 16;
		for (size_t k = 0; k < 3; k++, n *= 2) {
			batten_measures m = measure_form(raked, 60, 4, n + 1, n / 2 + 1,
			                                 (batten_quadrature)rule, 0);
			volume[k] = m.volume_m3;
			assert_relative(m.waterplane_area_m2, 60 * 10 / 2.0, 1e-12);
			assert_relative(m.midship_area_m2, 10 * 4 / 8.0, 1e-12);
			assert_relative(m.max_section_area_m2, 10 * 4 / 2.0, 1e-12);
			/* the girth is linear along the ship */
			assert_relative(m.wetted_surface_m2, raked_surface(), 1e-12);
			assert_true(m.lwl_m == 60 && m.beam_wl_m == 10);
		}
		assert_order(volume, raked_volume, orders[rule], 0.1);
	}
}

/* The same body in the long layout: each waterline ends where the stem is, off the stations, and
 * the sections begin where the stem crosses them, between two waterlines. */
static void raked_stem_off_the_stations(void **state)
{
	(void)state;
	static char text[65536];
	size_t length = (size_t)snprintf(text, sizeof text,
	                                 "# batten-offsets: 1\n# name: raked\n# unit: m\n"
	                                 "# frame: ap-fwd\n# lbp: 60\n# draft: 4\n# layout: long\n"
	                                 "waterline,z,x,y\n");
	for (int j = 1; j <= 8; j++) {
		double z = 0.5 * j, reach = 60 * z / 4;
		for (int i = 0; i < 25; i++) {
			double x = 2.45 * i, y = 5 * (z / 4 - x / 60);
			if (y > 0)
				length += (size_t)snprintf(text + length, sizeof text - length,
				                           "%d,%.17g,%.17g,%.17g\n", j, z, x, y);
		}
		length += (size_t)snprintf(text + length, sizeof text - length, "%d,%.17g,%.17g,0\n", j, z,
		                           reach);
	}
	batten_context *context = make_context();
	batten_hull *hull = NULL;
	if (batten_hull_parse(context, "raked", text, length, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	batten_measures m = measure_at(context, hull, trapezoid, 0);
	assert_relative(m.lwl_m, 60, 1e-12);
	assert_relative(m.waterplane_area_m2, 300, 1e-12);
	/* the keel below the lowest waterline is not in the table: a strip 0.5 high, at most 7.5 long */
	assert_true(m.volume_m3 < raked_volume * (1 + 1e-3) && m.volume_m3 > raked_volume - 1);
	batten_measures finer = measure_at(context, hull, spline, 0);
	assert_true(finer.volume_m3 < raked_volume && finer.volume_m3 > raked_volume - 1);
	/* amidships the stem is between two waterlines, and the section a triangle all the same */
	assert_relative(finer.midship_area_m2, 10 * 4 / 8.0, 1e-4);
	assert_relative(m.wetted_surface_m2, raked_surface(), 0.02);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static double half_cylinder(double x, double z)
{
	(void)x;
	return sqrt(fmax(0, 100 - (10 - z) * (10 - z)));
}

/* Steep at the keel, where offsets converge at the order 1.5 whatever the rule. */
static void cylinder(void **state)
{
	(void)state;
	static const double orders[] = { 1.5, 1.5, 1.5 };
	for (int rule = 0; rule < 3; rule++) {
		double volume[3], girth[3];
		size_t n = 40;
		for (size_t k = 0; k < 3; k++, n *= 2) {
			batten_measures m = measure_form(half_cylinder, 50, 10, 11, n + 1,
			                                 (batten_quadrature)rule, 6);
			volume[k] = m.volume_m3;
			girth[k] = m.wetted_surface_m2 / 50;
			assert_relative(m.waterplane_area_m2, 916.515138991168, 1e-12);
			assert_relative(m.i_t_m4, 2.0 / 3 * 50 * pow(84, 1.5), 1e-12);
		}
		assert_order(volume, 3963.36712565, orders[rule], 0.1);
		assert_relative(volume[2], 3963.36712565, 2e-3);
		if (rule != BATTEN_QUADRATURE_SIMPSON) /* y_z is infinite at its first node */
			assert_relative(girth[2], 23.1855896145, 2e-3);
	}
	batten_measures m = measure_form(half_cylinder, 50, 10, 11, 161, spline, 6);
	assert_relative(m.kmt_m, 10, 1e-3);
	assert_relative(m.kb_m, 3.52509543574, 1e-3);
}

static double ellipsoid(double x, double z)
{
	double s = x / 50 - 1, t = 1 - z / 6.25;
	double inside = 1 - s * s - t * t;
	return inside >= -1e-12 ? 5 * sqrt(fmax(0, inside)) : NAN;
}

/* No node lies on its edge, so that what is between the last nodes and the edge is lost: order
 * 1. */
static void semi_ellipsoid(void **state)
{
	(void)state;
	double worst_before = INFINITY;
	for (size_t n = 20; n <= 80; n *= 2) {
		batten_measures m = measure_form(ellipsoid, 100, 6.25, 2 * n + 1, n + 1, spline, 0);
		double worst = fabs(m.volume_m3 / 3272.49234749 - 1);
		worst = fmax(worst, fabs(m.kb_m / 3.90625 - 1));
		worst = fmax(worst, fabs(m.bmt_m / 1.5 - 1));
		worst = fmax(worst, fabs(m.bml_m / 150 - 1));
		worst = fmax(worst, fabs(m.cb / (pi / 6) - 1));
		worst = fmax(worst, fabs(m.cwp / (pi / 4) - 1));
		assert_true(worst < worst_before / 1.8);
		worst_before = worst;
		assert_near(m.lcb_pct_lbp_fwd, 0, 1e-9);
		if (n == 80)
			assert_relative(m.wetted_surface_m2, 1400.0499714, 0.01);
	}
	assert_true(worst_before < 2e-3);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(wigley_by_simpson),
		cmocka_unit_test(wigley_orders),
		cmocka_unit_test(wigley_by_trapezoids),
		cmocka_unit_test(wigley_at_other_drafts),
		cmocka_unit_test(stretching),
		cmocka_unit_test(box_by_every_rule),
		cmocka_unit_test(wedge_by_every_rule),
		cmocka_unit_test(raked_stem),
		cmocka_unit_test(raked_stem_off_the_stations),
		cmocka_unit_test(cylinder),
		cmocka_unit_test(semi_ellipsoid),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
