/* Hydrostatics of B-spline surfaces against closed forms (Letcher 9-11): to rounding for polynomial
 * patches, to the accuracy of Gauss points for rational ones and where the waterline cuts spans. */
#include "unit/hydrostatics_fixture.h"

/* ------------------------------------------------------------------------------------------------
 * Wigley's hull, 100 x 10 x 6.25
 * --------------------------------------------------------------------------------------------- */

static void wigley_at_its_draft(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surface = wigley_surface(context, 100, 10, 6.25);
	batten_hydrostatics_options options = with_lbp(0);
	options.kg_m = 3.75;
	batten_hydrostatics h = surface_at(context, surface, &options, 6.25);
	assert_relative(h.volume_m3, 25000.0 / 9, 1e-12);
	assert_relative(h.displacement_t, 1.025 * 25000.0 / 9, 1e-12);
	assert_relative(h.waterplane_area_m2, 2000.0 / 3, 1e-12);
	assert_relative(h.midship_area_m2, 125.0 / 3, 1e-12);
	assert_relative(h.max_section_area_m2, 125.0 / 3, 1e-12);
	assert_relative(h.kb_m, 3.90625, 1e-12);
	assert_relative(h.bmt_m, 3.0 / 35 * 100 / 6.25, 1e-12);
	assert_relative(h.bml_m, 120, 1e-12);
	assert_relative(h.kmt_m, 3.90625 + 3.0 / 35 * 16, 1e-12);
	assert_relative(h.kml_m, 123.90625, 1e-12);
	assert_relative(h.i_t_m4, 80000.0 / 21, 1e-12);
	assert_relative(h.i_l_m4, 1e6 / 3, 1e-12);
	assert_relative(h.tpc_t_per_cm, 41.0 / 6, 1e-12);
	assert_relative(h.cb, 4.0 / 9, 1e-12);
	assert_relative(h.cp, 2.0 / 3, 1e-12);
	assert_relative(h.cm, 2.0 / 3, 1e-12);
	assert_relative(h.cwp, 2.0 / 3, 1e-12);
	assert_relative(h.cv, 25.0 / 9, 1e-12);
	/* the root of a polynomial: the more points the nearer */
	assert_relative(h.wetted_surface_m2, 1487.9063104958, 2e-9);
	options.gauss_points = 16;
	batten_hydrostatics more = surface_at(context, surface, &options, 6.25);
	assert_relative(more.wetted_surface_m2, 1487.9063104958, 2e-11);
	assert_relative(more.volume_m3, 25000.0 / 9, 1e-12);
	assert_relative(h.cws, 2.8231037, 1e-7);
	assert_relative(h.xcb_from_ap_m, 50, 1e-12);
	assert_relative(h.xcf_from_ap_m, 50, 1e-12);
	assert_near(h.lcb_pct_lbp_fwd, 0, 1e-11);
	assert_relative(h.gmt_m, 3.90625 + 3.0 / 35 * 16 - 3.75, 1e-12);
	assert_relative(h.mt1cm_t_m_per_cm, 34.211155, 1e-7);
	assert_relative(h.gml_m / h.gmt_m, 120.15625 / 1.52767857142857, 1e-12);
	assert_relative(h.beam_wl_m, 10, 1e-12);
	assert_relative(h.beam_max_m, 10, 1e-12);
	assert_relative(h.lwl_m, 100, 1e-12);
	assert_true(h.lbp_m == 100 && h.draft_m == 6.25);
	assert_true(h.transom_area_m2 == 0 && h.volume_mismatch_pct < 1e-10);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* On a waterline between two knots, and with the waterline on the edge: the four drafts, and the
 * derivatives of volume and moment. */
static void wigley_at_four_drafts(void **state)
{
	(void)state;
	static const struct {
		double part, volume, area, kb, bmt, bml, cb;
	} rows[] = {
		{ 0.25, 238.715277777778, 291.666666666667, 1.02982954545455, 1.33636363636364,
		  610.909090909091, 0.3492063492063492 },
		{ 0.50, 868.055555555556, 500, 2.03125, 1.85142857142857, 288, 0.3703703703703704 },
		{ 0.75, 1757.8125, 625, 2.99479166666667, 1.78571428571429, 177.777777777778, 0.4 },
		{ 1.00, 2777.77777777778, 666.666666666667, 3.90625, 1.37142857142857, 120,
		  0.4444444444444444 },
	};
	batten_context *context = make_context();
	batten_surface *surface = wigley_surface(context, 100, 10, 6.25);
	/* a finer description of the same surface, knots off the waterlines */
	batten_surface *finer = NULL;
	assert_int_equal(batten_surface_clone(context, surface, &finer), BATTEN_OK);
	assert_int_equal(batten_surface_elevate(finer, BATTEN_DIRECTION_U, 1), BATTEN_OK);
	assert_int_equal(batten_surface_insert_knot(finer, BATTEN_DIRECTION_U, 0.3, 1), BATTEN_OK);
	assert_int_equal(batten_surface_insert_knot(finer, BATTEN_DIRECTION_V, 0.6, 1), BATTEN_OK);
	assert_int_equal(batten_surface_insert_knot(finer, BATTEN_DIRECTION_V, 0.25, 2), BATTEN_OK);
	for (size_t k = 0; k < 4; k++) {
		double drafts[3] = { 6.25 * rows[k].part, 0, 0 };
		drafts[1] = drafts[0] - 1e-3;
		drafts[2] = drafts[0] - 2e-3;
		for (int which = 0; which < 2; which++) {
			batten_hydrostatics h[3];
			assert_int_equal(
				batten_surface_hydrostatics(context, which ? finer : surface, NULL, 3, drafts, h),
				BATTEN_OK);
			assert_relative(h->volume_m3, rows[k].volume, 2e-12);
			assert_relative(h->waterplane_area_m2, rows[k].area, 2e-12);
			assert_relative(h->kb_m, rows[k].kb, 2e-12);
			assert_relative(h->bmt_m, rows[k].bmt, 2e-12);
			assert_relative(h->bml_m, rows[k].bml, 2e-12);
			assert_relative(h->cb, rows[k].cb, 2e-12);
			assert_relative(h->cb, h->cp * h->cm, 1e-12);
			assert_relative(h->midship_area_m2, h->volume_m3 * 1.5 / 100, 1e-12);
			assert_true(h->volume_mismatch_pct < 1e-9);
			/* dV/dT = the waterplane, d(V KB)/dT = the waterplane times T */
			double rise = (h[0].volume_m3 - h[2].volume_m3) / 2e-3;
			assert_relative(rise, h[1].waterplane_area_m2, 1e-7);
			rise = (h[0].volume_m3 * h[0].kb_m - h[2].volume_m3 * h[2].kb_m) / 2e-3;
			assert_relative(rise, h[1].waterplane_area_m2 * drafts[1], 1e-6);
		}
	}
	batten_surface_destroy(finer);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* Either direction may run either way; a stretch follows its laws (Letcher 10.1). */
static void senses_and_stretches(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surface = wigley_surface(context, 100, 10, 6.25);
	const double matrix[9] = { 1.2, 0, 0, 0, 0.9, 0, 0, 0, 1.1 }, shift[3] = { 0 };
	for (int turn = 0; turn < 4; turn++) {
		batten_surface_reverse(surface, turn % 2 ? BATTEN_DIRECTION_U : BATTEN_DIRECTION_V);
		batten_hydrostatics h = surface_at(context, surface, NULL, 4);
		assert_relative(h.volume_m3, 2.0 / 3 * 6250 * (0.4096 - 0.262144 / 3), 1e-12);
		assert_relative(h.midship_area_m2, 1.5 / 100 * h.volume_m3, 1e-12);
		assert_true(h.volume_mismatch_pct < 1e-9);
	}
	batten_hydrostatics before = surface_at(context, surface, NULL, 6.25);
	assert_int_equal(batten_surface_map(surface, matrix, shift), BATTEN_OK);
	batten_hydrostatics after = surface_at(context, surface, NULL, 6.875);
	assert_relative(after.volume_m3, before.volume_m3 * 1.2 * 0.9 * 1.1, 1e-12);
	assert_relative(after.i_t_m4, before.i_t_m4 * 1.2 * 0.9 * 0.9 * 0.9, 1e-12);
	assert_relative(after.i_l_m4, before.i_l_m4 * 1.2 * 1.2 * 1.2 * 0.9, 1e-12);
	assert_relative(after.cb, before.cb, 1e-12);
	assert_relative(after.wetted_surface_m2, 1870.504377532, 2e-9);
	assert_relative(after.cws, 2.97242657833, 2e-9);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * Other bodies
 * --------------------------------------------------------------------------------------------- */

/* Box and wedge, their ends open as transoms are, at a draft inside and one on the edge. */
static void prisms(void **state)
{
	(void)state;
	static const double box[3][2] = { { 0, 0 }, { 5, 0 }, { 5, 6 } };
	static const double wedge[2][2] = { { 0, 0 }, { 7.5, 6 } };
	const double l = 60;
	batten_context *context = make_context();
	for (int turn = 0; turn < 2; turn++) {
		const double t = turn ? 6 : 4;
		batten_surface *surface = prism_surface(context, l, 3, box);
		batten_hydrostatics h = surface_at(context, surface, NULL, t);
		assert_relative(h.volume_m3, l * 10 * t, 1e-12);
		assert_relative(h.waterplane_area_m2, l * 10, 1e-12);
		assert_relative(h.kb_m, t / 2, 1e-12);
		assert_relative(h.bmt_m, 100 / (12 * t), 1e-12);
		assert_relative(h.bml_m, l * l / (12 * t), 1e-12);
		assert_relative(h.wetted_surface_m2, l * 10 + 2 * l * t, 1e-12);
		assert_relative(h.transom_area_m2, 2 * 10 * t, 1e-12);
		assert_relative(h.cb, 1, 1e-12);
		assert_relative(h.cm, 1, 1e-12);
		assert_true(h.volume_mismatch_pct < 1e-9);
		batten_surface_destroy(surface);
		surface = prism_surface(context, l, 2, wedge);
		h = surface_at(context, surface, NULL, t);
		double b = 2.5 * t;
		assert_relative(h.volume_m3, l * b * t / 2, 1e-12);
		assert_relative(h.kb_m, 2 * t / 3, 1e-12);
		assert_relative(h.bmt_m, b * b / (6 * t), 1e-12);
		assert_relative(h.bml_m, l * l / (6 * t), 1e-12);
		assert_relative(h.wetted_surface_m2, 2 * l * sqrt(b * b / 4 + t * t), 1e-12);
		assert_relative(h.transom_area_m2, b * t, 1e-12);
		assert_relative(h.cb, 0.5, 1e-12);
		batten_surface_destroy(surface);
	}
	batten_context_destroy(context);
}

/* A pyramid on its point: the waterline is a rectangle, the apex a place where the patch is shrunk
 * to a point. */
static void pyramid(void **state)
{
	(void)state;
	const double l = 60, b = 10, t = 4;
	const double poles[18 + 6] = { 30, 0, 0, 30, 0, 0, 30, 0, 0, 30, 0, 0,
		                           0,  0, 4, 0,  5, 4, 60, 5, 4, 60, 0, 4 };
	batten_context *context = make_context();
	batten_surface *surface = make_surface(
		context, &(batten_surface_net){ "pyramid", 2, 2, 4, 2, NULL, NULL, poles, NULL });
	for (int turn = 0; turn < 2; turn++) {
		const double part = turn ? 1 : 0.5;
		batten_hydrostatics h = surface_at(context, surface, NULL, part * t);
		assert_relative(h.volume_m3, part * part * part * l * b * t / 3, 1e-12);
		assert_relative(h.waterplane_area_m2, part * part * l * b, 1e-12);
		assert_relative(h.kb_m, 0.75 * part * t, 1e-12);
		assert_relative(h.bmt_m, part * b * b / (4 * t), 1e-12);
		assert_relative(h.bml_m, part * l * l / (4 * t), 1e-12);
		double ends = b * sqrt(l * l / 4 + t * t), sides = l * sqrt(b * b / 4 + t * t);
		assert_relative(h.wetted_surface_m2, part * part * (ends + sides), 1e-12);
		assert_true(h.volume_mismatch_pct < 1e-9);
	}
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* KM of a cylinder is its axis, at any draft. */
static void cylinder(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surface = cylinder_surface(context, 50, 10);
	batten_hydrostatics h = surface_at(context, surface, NULL, 6);
	assert_relative(h.volume_m3, 3963.36712565, 1e-11);
	assert_relative(h.max_section_area_m2, 79.267342513, 1e-11);
	assert_relative(h.waterplane_area_m2, 916.515138991168, 1e-11);
	assert_relative(h.kb_m, 3.52509543574, 1e-11);
	assert_relative(h.bmt_m, 6.47490456426, 1e-11);
	assert_relative(h.kmt_m, 10, 1e-11);
	assert_relative(h.wetted_surface_m2, 50 * 23.1855896145, 1e-11);
	h = surface_at(context, surface, NULL, 10);
	assert_relative(h.volume_m3, pi * 100 * 50 / 2, 1e-11);
	assert_relative(h.kb_m, 10 * (1 - 4 / (3 * pi)), 1e-11);
	assert_relative(h.bml_m, 2500 / (3 * pi * 10), 1e-11);
	assert_relative(h.wetted_surface_m2, pi * 500, 1e-11);
	assert_relative(h.cb, pi / 4, 1e-11);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

static void sphere_and_ellipsoid(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surface = ellipsoid_surface(context, 20, 20, 10);
	batten_hydrostatics h = surface_at(context, surface, NULL, 10);
	assert_relative(h.volume_m3, 2000 * pi / 3, 1e-10);
	assert_relative(h.kb_m, 6.25, 1e-10);
	assert_relative(h.bmt_m, 3.75, 1e-10);
	assert_relative(h.wetted_surface_m2, 200 * pi, 1e-9);
	assert_relative(h.cws, sqrt(3 * pi), 1e-9);
	assert_relative(h.cv, 261.799387799, 1e-10);
	/* a cap: the waterline begins and ends inside the patch */
	h = surface_at(context, surface, NULL, 6);
	assert_relative(h.volume_m3, 904.778684234, 1e-8);
	assert_relative(h.waterplane_area_m2, 263.893782902, 1e-8);
	assert_relative(h.kb_m, 3.875, 1e-8);
	assert_relative(h.bmt_m, 6.125, 1e-8);
	assert_relative(h.kmt_m, 10, 1e-8);
	assert_relative(h.kml_m, 10, 1e-7);
	assert_relative(h.wetted_surface_m2, 376.991118431, 1e-8);
	assert_relative(h.lwl_m, 2 * sqrt(84), 1e-9);
	assert_relative(h.beam_wl_m, 2 * sqrt(84), 1e-9);
	assert_relative(h.midship_area_m2, 79.267342513, 1e-9);
	batten_surface_destroy(surface);
	surface = ellipsoid_surface(context, 100, 10, 6.25);
	h = surface_at(context, surface, NULL, 6.25);
	assert_relative(h.volume_m3, 3272.49234749, 1e-10);
	assert_relative(h.wetted_surface_m2, 1400.0499714, 1e-7);
	assert_relative(h.kb_m, 3.90625, 1e-10);
	assert_relative(h.bmt_m, 1.5, 1e-10);
	assert_relative(h.bml_m, 150, 1e-10);
	assert_relative(h.cb, pi / 6, 1e-10);
	assert_relative(h.cp, 2.0 / 3, 1e-10);
	assert_relative(h.cwp, pi / 4, 1e-10);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

/* ------------------------------------------------------------------------------------------------
 * What is open, what is wrong
 * --------------------------------------------------------------------------------------------- */

static bool warned_of(const batten_hydrostatics *h, const char *name)
{
	batten_warning warnings[16];
	size_t count = batten_hydrostatics_warnings(h, warnings, 16);
	assert_true(count <= 16 && count == batten_hydrostatics_warnings(h, NULL, 0));
	for (size_t i = 0; i < count; i++) {
		assert_null(strchr(warnings[i].text, '\n'));
		if (strcmp(warnings[i].name, name) == 0)
			return true;
	}
	return false;
}

/* Without its flat bottom a box keeps its volume, and the forms of it tell. */
static void open_hulls_are_told(void **state)
{
	(void)state;
	static const double sides[2][2] = { { 5, 0 }, { 5, 6 } };
	static const double closed[3][2] = { { 0, 0 }, { 5, 0 }, { 5, 6 } };
	batten_context *context = make_context();
	batten_surface *surface = prism_surface(context, 60, 2, sides);
	batten_hydrostatics h = surface_at(context, surface, NULL, 4);
	assert_relative(h.volume_m3, 60 * 10 * 4, 1e-12);
	assert_relative(h.volume_mismatch_pct, 100, 1e-12);
	assert_true(warned_of(&h, "volume_mismatch_pct") && warned_of(&h, "transom_area_m2"));
	batten_surface_destroy(surface);
	surface = prism_surface(context, 60, 3, closed);
	h = surface_at(context, surface, NULL, 4);
	assert_false(warned_of(&h, "volume_mismatch_pct"));
	assert_true(warned_of(&h, "transom_area_m2"));
	batten_surface_destroy(surface);
	surface = wigley_surface(context, 100, 10, 6.25);
	batten_hydrostatics_options options = with_lbp(0);
	options.kg_m = 4;
	h = surface_at(context, surface, &options, 6.25);
	assert_int_equal(batten_hydrostatics_warnings(&h, NULL, 0), 0);
	options.kg_m = 6;
	h = surface_at(context, surface, &options, 6.25);
	assert_true(h.gmt_m < 0 && warned_of(&h, "gmt_m"));
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

static void wrong_calls(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surface = wigley_surface(context, 100, 10, 6.25);
	batten_hydrostatics h = { .lbp_m = -1 };
	static const double drafts[] = { 0, -1, 6.26, NAN, INFINITY };
	for (size_t k = 0; k < 5; k++) {
		assert_int_equal(batten_surface_hydrostatics(context, surface, NULL, 1, &drafts[k], &h),
		                 BATTEN_USAGE);
		assert_non_null(strstr(batten_context_error(context), "0 to 6.25"));
	}
	static const double weights[] = { 0, -1, 1e9, NAN };
	double draft = -1;
	for (size_t k = 0; k < 4; k++)
		assert_int_equal(batten_surface_draft_at(context, surface, NULL, weights[k], &draft),
		                 BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(context), "up to 2847.22222 t"));
	assert_true(draft == -1);
	batten_hydrostatics_options good = with_lbp(0), options = good;
	draft = 4;
	options.struct_size = 1;
	assert_int_equal(batten_surface_hydrostatics(context, surface, &options, 1, &draft, &h),
	                 BATTEN_USAGE);
	options = good;
	options.gauss_points = 17;
	assert_int_equal(batten_surface_hydrostatics(context, surface, &options, 1, &draft, &h),
	                 BATTEN_USAGE);
	options = good;
	options.lbp_m = -2;
	assert_int_equal(batten_surface_hydrostatics(context, surface, &options, 1, &draft, &h),
	                 BATTEN_USAGE);
	options = good;
	options.kg_m = INFINITY;
	assert_int_equal(batten_surface_hydrostatics(context, surface, &options, 1, &draft, &h),
	                 BATTEN_USAGE);
	const double matrix[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, behind[3] = { -200, 0, 0 };
	assert_int_equal(batten_surface_map(surface, matrix, behind), BATTEN_OK);
	assert_int_equal(batten_surface_hydrostatics(context, surface, NULL, 1, &draft, &h),
	                 BATTEN_USAGE);
	assert_true(h.lbp_m == -1);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

static void drafts_sections_and_measures(void **state)
{
	(void)state;
	batten_context *context = make_context();
	batten_surface *surface = wigley_surface(context, 100, 10, 6.25);
	static const double part[] = { 0.02, 0.25, 0.5, 0.75, 1 };
	for (size_t k = 0; k < 5; k++) {
		double e = part[k], draft = 0;
		double weight = 1.025 * 12500 / 3.0 * (e * e - e * e * e / 3);
		assert_int_equal(batten_surface_draft_at(context, surface, NULL, weight, &draft),
		                 BATTEN_OK);
		assert_relative(draft, 6.25 * e, 1e-11);
	}
	const double x[] = { 0, 10, 37, 50, 100, 120 }, z[] = { 1.5625, 4, 6.25 };
	double areas[18];
	assert_int_equal(batten_surface_section_areas(context, surface, NULL, 6, x, 3, z, areas),
	                 BATTEN_OK);
	for (size_t k = 0; k < 18; k++) {
		double s = x[k % 6] / 100, e = z[k / 6] / 6.25;
		double area = s > 1 ? 0 : 4 * s * (1 - s) * 62.5 * (e * e - e * e * e / 3);
		assert_near(areas[k], area, 1e-11);
	}
	batten_measures m;
	batten_surface_energies energies;
	assert_int_equal(batten_surface_measure(context, surface, NULL, 5, &m), BATTEN_OK);
	batten_hydrostatics h = surface_at(context, surface, NULL, 5);
	assert_true(m.volume_m3 == h.volume_m3 && m.tpc_t_per_cm == h.tpc_t_per_cm && m.cb == h.cb);
	assert_true(isnan(m.fn_per_m2) && isnan(m.noise_m) && isnan(m.inflections));
	const batten_surface *one = surface;
	batten_surface_batch_options how;
	batten_surface_batch_options_default(&how);
	how.variation = true;
	assert_int_equal(batten_surface_energy_batch(context, 1, &one, &how, &energies, NULL),
	                 BATTEN_OK);
	assert_relative(m.energy_bending, energies.bending, 1e-12);
	assert_true(energies.variation_per_m2 > 0);
	assert_relative(m.energy_mvc_per_m2, energies.variation_per_m2, 1e-12);
	assert_int_equal(batten_surface_measure(context, surface, NULL, 7, &m), BATTEN_USAGE);
	batten_surface_destroy(surface);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(wigley_at_its_draft),
		cmocka_unit_test(wigley_at_four_drafts),
		cmocka_unit_test(senses_and_stretches),
		cmocka_unit_test(prisms),
		cmocka_unit_test(pyramid),
		cmocka_unit_test(cylinder),
		cmocka_unit_test(sphere_and_ellipsoid),
		cmocka_unit_test(open_hulls_are_told),
		cmocka_unit_test(wrong_calls),
		cmocka_unit_test(drafts_sections_and_measures),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
