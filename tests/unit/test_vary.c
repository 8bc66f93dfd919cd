/* Variation by each method: the parent again for nothing asked, targets met, laws of stretching,
 * refusals, many rows, memory that runs out. */
#include "unit/vary_fixture.h"

static const char *const hulls[] = { "bsra_trawler", "npl_parent", "highspeed_craft", "wigley",
	                                 "wigley_noisy" };
enum { HULLS = sizeof hulls / sizeof hulls[0] };

static void assert_same(const batten_hull *a, const batten_hull *b)
{
	const size_t stations = batten_hull_station_count(a), lines = batten_hull_waterline_count(a);
	assert_int_equal(stations, batten_hull_station_count(b));
	assert_int_equal(lines, batten_hull_waterline_count(b));
	const double near = 1e-13 * batten_hull_lbp_m(a);
	assert_near(batten_hull_lbp_m(a), batten_hull_lbp_m(b), near, "lbp");
	assert_near(batten_hull_draft_m(a), batten_hull_draft_m(b), near, "draft");
	for (size_t s = 0; s < stations; s++)
		assert_near(batten_hull_x_m(a)[s], batten_hull_x_m(b)[s], near, "x");
	for (size_t w = 0; w < lines; w++)
		assert_near(batten_hull_z_m(a)[w], batten_hull_z_m(b)[w], near, "z");
	for (size_t i = 0; i < stations * lines; i++) {
		if (batten_hull_nodes(a)[i] != batten_hull_nodes(b)[i])
			fail_msg("%s: node %zu of %zu stations is %d, expected %d", batten_hull_name(a), i,
			         stations, batten_hull_nodes(a)[i], batten_hull_nodes(b)[i]);
		assert_near(batten_hull_y_m(a)[i], batten_hull_y_m(b)[i], near, "y");
	}
}

static const double no_weight = 0, ends[] = { 0, 1 }, inner[] = { 0, 0.3, 1 };

/* Options that ask a method for nothing. */
static batten_vary_options identity(batten_vary_method which, const batten_hull *const *other,
                                    const batten_hull *hull)
{
	batten_vary_options options = method(which);
	options.other_count = 1;
	options.others = other;
	options.weights = &no_weight;
	options.point_count = 3;
	options.from_part = options.to_part = inner;
	options.middle_aft_m = 0.4 * batten_hull_lbp_m(hull);
	options.middle_fore_m = 0.6 * batten_hull_lbp_m(hull);
	return options;
}

static void test_identity(void **state)
{
	for (size_t h = 0; h < HULLS; h++) {
		batten_hull *hull = read_hull(*state, hulls[h]);
		const batten_hull *const other = hull;
		batten_lattice *lattice = affine_lattice(*state, hull, (const double[3]){ 0, 0, 0 });
		for (int m = 0; m < BATTEN_VARY_METHOD_COUNT; m++) {
			batten_vary_options options = identity((batten_vary_method)m, &other, hull);
			options.preset = BATTEN_VARY_RISE_OF_FLOOR;
			options.lattice = lattice;
			if (m == BATTEN_VARY_MOOR && strcmp(hulls[h], "highspeed_craft") == 0)
				continue; /* refused: its waterlines end off the grid (test_refusals) */
			batten_vary_outcome outcome;
			batten_hull *variant = vary(*state, hull, &options, &outcome);
			assert_same(variant, hull);
			assert_string_equal(outcome.warning, "");
			batten_hull_destroy(variant);
		}
		batten_lattice_destroy(lattice);
		batten_hull_destroy(hull);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Targets
 * --------------------------------------------------------------------------------------------- */

static void assert_met(batten_context *context, const batten_hull *parent,
                       const batten_vary_options *options)
{
	batten_vary_outcome outcome;
	batten_hull *variant = vary(context, parent, options, &outcome);
	const batten_measures measures = measures_of(context, variant);
	assert_true(outcome.target_count > 0);
	for (size_t i = 0; i < outcome.target_count; i++) {
		const struct batten_vary_target *target = &outcome.targets[i];
		size_t k = 0;
		while (strcmp(batten_measure_name(k), target->name) != 0)
			k++;
		assert_near(target->got, target->asked, 1e-7, target->name);
		assert_near(((const double *)&measures)[k], target->asked, 1e-7, target->name);
	}
	batten_hull_destroy(variant);
}

static void test_targets(void **state)
{
	for (size_t h = 0; h < HULLS; h++) {
		batten_hull *hull = read_hull(*state, hulls[h]);
		for (int sign = -1; sign <= 1; sign += 2) {
			batten_vary_options options = method(BATTEN_VARY_SWING);
			options.dlcb_pct = sign;
			assert_met(*state, hull, &options);
			options = method(BATTEN_VARY_LACKENBY);
			options.dcp_pct = 3 * sign;
			options.dlcb_pct = 0.7;
			assert_met(*state, hull, &options);
			options.dp_aft_pct = 2;
			options.dp_fore_pct = 3;
			assert_met(*state, hull, &options);
			options = method(BATTEN_VARY_ONE_MINUS_PRISMATIC);
			options.dcp_pct = 3;
			options.dlcb_pct = sign;
			assert_met(*state, hull, &options);
			options = method(BATTEN_VARY_MOOR);
			options.dcp_pct = 2;
			options.dlcb_pct = 0.4 * sign;
			options.dcwp_pct = 2;
			options.dlcf_pct = 0.4 * sign;
			if (strcmp(hulls[h], "highspeed_craft") != 0)
				assert_met(*state, hull, &options);
			const batten_measures before = measures_of(*state, hull);
			const batten_hull *const other = hull;
			options = identity(BATTEN_VARY_THREE_BODY, &other, hull);
			options.volume_m3 = before.volume_m3 * 1.05;
			options.cp = before.cp * (1 + 0.01 * sign);
			options.lcb_pct_lbp_fwd = before.lcb_pct_lbp_fwd + 0.2;
			assert_met(*state, hull, &options);
		}
		batten_hull_destroy(hull);
	}
}

/* One pass of the formulas misses, by little. */
static void test_first_pass(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_vary_options options = method(BATTEN_VARY_LACKENBY);
	options.dcp_pct = 5;
	options.dlcb_pct = 2;
	options.first_pass = true;
	batten_vary_outcome outcome;
	batten_hull_destroy(vary(*state, hull, &options, &outcome));
	assert_int_equal(outcome.passes, 1);
	const double off = outcome.targets[1].got - outcome.targets[1].asked;
	assert_true(fabs(off) > 0.05 && fabs(off) < 0.2);
	batten_hull_destroy(hull);
}

/* Wigley's section areas are 4 s (1 - s) of the one amidships: Cp 2/3, centre of a half at 3/8. */
static void test_parallel_body(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley");
	batten_vary_options options = method(BATTEN_VARY_LACKENBY);
	options.dp_aft_pct = options.dp_fore_pct = 30;
	options.dcp_pct = 15;
	batten_hull *variant = vary(*state, hull, &options, NULL);
	const size_t stations = batten_hull_station_count(hull);
	const size_t top = (batten_hull_waterline_count(hull) - 1) * stations;
	size_t inside = 0;
	for (size_t s = 0; s < stations; s++) {
		const double x = batten_hull_x_m(hull)[s] - 8;
		if (fabs(x) <= 0.3 * 8) {
			assert_near(batten_hull_y_m(variant)[top + s], 0.8, 1e-12, "parallel body");
			inside++;
		} else {
			assert_true(batten_hull_y_m(variant)[top + s] < 0.8);
		}
	}
	assert_true(inside >= 3);
	/* the parallel body is found again, and shortened */
	options.dp_aft_pct = options.dp_fore_pct = -10;
	options.dcp_pct = -5;
	assert_met(*state, variant, &options);
	batten_hull_destroy(variant);
	batten_hull_destroy(hull);
}

/* ------------------------------------------------------------------------------------------------
 * Laws of stretching (Letcher 10.1)
 * --------------------------------------------------------------------------------------------- */

static void test_affine(void **state)
{
	const double l = 1.2, b = 0.9, d = 1.1;
	for (size_t h = 0; h < HULLS; h++) {
		batten_hull *hull = read_hull(*state, hulls[h]);
		batten_vary_options options = method(BATTEN_VARY_AFFINE);
		options.scale_x = l;
		options.scale_y = b;
		options.scale_z = d;
		batten_hull *variant = vary(*state, hull, &options, NULL);
		const batten_measures p = measures_of(*state, hull), q = measures_of(*state, variant);
		const struct {
			const char *name;
			double got, expected;
		} laws[] = {
			{ "volume", q.volume_m3, p.volume_m3 * l * b * d },
			{ "midship area", q.midship_area_m2, p.midship_area_m2 * b * d },
			{ "waterplane", q.waterplane_area_m2, p.waterplane_area_m2 * l * b },
			{ "cb", q.cb, p.cb },
			{ "cp", q.cp, p.cp },
			{ "cm", q.cm, p.cm },
			{ "cwp", q.cwp, p.cwp },
			{ "cv", q.cv, p.cv * b * d / (l * l) },
			{ "xcb", q.xcb_from_ap_m, p.xcb_from_ap_m * l },
			{ "xcf", q.xcf_from_ap_m, p.xcf_from_ap_m * l },
			{ "kb", q.kb_m, p.kb_m * d },
			{ "bmt", q.bmt_m, p.bmt_m * b * b / d },
			{ "bml", q.bml_m, p.bml_m * l * l / d },
			{ "i_t", q.i_t_m4, p.i_t_m4 * l * b * b * b },
			{ "i_l", q.i_l_m4, p.i_l_m4 * l * l * l * b },
			{ "tpc", q.tpc_t_per_cm, p.tpc_t_per_cm * l * b },
			{ "beam", q.beam_wl_m, p.beam_wl_m * b },
		};
		for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++)
			assert_near(laws[i].got / laws[i].expected, 1, 1e-11, laws[i].name);
		batten_hull_destroy(variant);
		batten_hull_destroy(hull);
	}
}

/* A geosim: wetted surface by 4, its coefficient stays. */
static void test_geosim(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley");
	batten_vary_options options = method(BATTEN_VARY_AFFINE);
	options.scale_x = options.scale_y = options.scale_z = 2;
	batten_hull *variant = vary(*state, hull, &options, NULL);
	const batten_measures p = measures_of(*state, hull), q = measures_of(*state, variant);
	assert_near(q.wetted_surface_m2 / p.wetted_surface_m2, 4, 1e-12, "wetted surface");
	assert_near(q.volume_m3 / p.volume_m3, 8, 1e-12, "volume");
	assert_near(q.cws, p.cws, 1e-12, "cws");
	assert_near(q.cv, p.cv, 1e-12, "cv");
	batten_hull_destroy(variant);
	batten_hull_destroy(hull);
}

/* f linear is the affine stretch; in general volume = integral of S f' dx. */
static void test_stretch(void **state)
{
	const double to[] = { 0.1, 1.3 }, middle[] = { 0, 0.5, 1 }, moved[] = { 0, 0.55, 1 };
	batten_hull *hull = read_hull(*state, "wigley");
	batten_vary_options options = method(BATTEN_VARY_STRETCH);
	options.point_count = 2;
	options.from_part = ends;
	options.to_part = to;
	batten_hull *variant = vary(*state, hull, &options, NULL);
	options = method(BATTEN_VARY_AFFINE);
	options.scale_x = 1.2;
	batten_hull *affine = vary(*state, hull, &options, NULL);
	assert_same(variant, affine);
	batten_hull_destroy(affine);
	batten_hull_destroy(variant);
	/* the parabola through the three points, f' = 1 + 0.2 (1 - 2 s): S is symmetric, so that the
	 * volume stays; the centre goes to integral S f f' / integral S = 0.55 - 0.6 / 20 */
	options = method(BATTEN_VARY_STRETCH);
	options.point_count = 3;
	options.from_part = middle;
	options.to_part = moved;
	variant = vary(*state, hull, &options, NULL);
	const batten_measures p = measures_of(*state, hull), q = measures_of(*state, variant);
	assert_near(q.volume_m3 / p.volume_m3, 1, 2e-4, "volume");
	assert_near(q.xcb_from_ap_m / 16, 0.52, 2e-4, "centre");
	batten_hull_destroy(variant);
	batten_hull_destroy(hull);
}

/* ------------------------------------------------------------------------------------------------
 * Averaging
 * --------------------------------------------------------------------------------------------- */

/* Two affine images of one hull on one table: the mean is the image by the mean factors. */
static void test_average(void **state)
{
	batten_hull *hull = read_hull(*state, "highspeed_craft");
	batten_vary_options options = method(BATTEN_VARY_AFFINE);
	options.scale_x = options.scale_y = options.scale_z = 1.5;
	batten_hull *large = vary(*state, hull, &options, NULL);
	options.scale_x = options.scale_y = options.scale_z = 0.8;
	batten_hull *small = vary(*state, hull, &options, NULL);
	const batten_hull *const others[] = { large, small };
	/* extrapolated: 1 + 0.5 * 0.6 + 0.2 * 0.5 = 1.4 by weights 0.6 and -0.5 */
	const double weights[] = { 0.6, -0.5 };
	options = method(BATTEN_VARY_AVERAGE);
	options.other_count = 2;
	options.others = others;
	options.weights = weights;
	batten_hull *mean = vary(*state, hull, &options, NULL);
	options = method(BATTEN_VARY_AFFINE);
	options.scale_x = options.scale_y = options.scale_z = 1 + 0.5 * 0.6 + 0.2 * 0.5;
	batten_hull *expected = vary(*state, hull, &options, NULL);
	assert_same(mean, expected);
	batten_hull_destroy(expected);
	batten_hull_destroy(mean);
	batten_hull_destroy(small);
	batten_hull_destroy(large);
	batten_hull_destroy(hull);
}

/* Tables of other sizes: the finer one is the base, each of its vertices takes the nearest. */
static void test_average_unlike(void **state)
{
	const double x[2][3] = { { 0, 1, 2 }, { 0, 2, 0 } }, z[] = { 0, 1 };
	const double y[2][6] = { { 0, 1, 0, 0, 3, 0 }, { 2, 4, 6, 8, 0, 0 } };
	batten_hull *made[2] = { NULL };
	for (size_t k = 0; k < 2; k++) {
		const batten_hull_table table = { .name = "table",
			                              .lbp_m = k == 0 ? 2 : 4,
			                              .draft_m = 1,
			                              .station_count = 3 - k,
			                              .waterline_count = 2,
			                              .x_m = x[k],
			                              .z_m = z,
			                              .y_m = y[k] };
		assert_int_equal(batten_hull_create(*state, &table, &made[k]), BATTEN_OK);
	}
	const double half = 0.5;
	const batten_hull *const others[] = { made[0] };
	batten_vary_options options = method(BATTEN_VARY_AVERAGE);
	options.other_count = 1;
	options.others = others;
	options.weights = &half;
	/* the other hull's stations, at parts 0, 1/2, 1 of its length, are the base; the parent's stand at
	 * 0 and 1/2 of its own */
	batten_hull *mean = vary(*state, made[1], &options, NULL);
	assert_int_equal(batten_hull_station_count(mean), 3);
	const double at[] = { 0, 1.5, 3 }, expected[] = { 1, 2.5, 2, 3, 5.5, 4 };
	for (size_t s = 0; s < 3; s++)
		assert_near(batten_hull_x_m(mean)[s], at[s], 1e-15, "x");
	for (size_t i = 0; i < 6; i++)
		assert_near(batten_hull_y_m(mean)[i], expected[i], 1e-15, "y");
	batten_hull_destroy(mean);
	batten_hull_destroy(made[0]);
	batten_hull_destroy(made[1]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_identity, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_targets, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_first_pass, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_parallel_body, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_affine, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_geosim, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_stretch, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_average, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_average_unlike, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
