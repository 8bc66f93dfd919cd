/* Variants of the trawler against the thesis's printed columns (tables B.4, B.5, 2.2, 2.4). */
#include "unit/vary_fixture.h"
#include "variation/variation.h"

static batten_vary_options thesis(batten_vary_method which)
{
	batten_vary_options options = method(which);
	options.thesis = options.first_pass = true;
	return options;
}

static void assert_column(const batten_hull *hull, const char *table, const char *column,
                          double max_m, double rms_m)
{
	const struct difference found = differ(hull, table, column);
	if (!(found.max_m <= max_m && found.rms_m <= rms_m))
		fail_msg("%s: off by %g m, rms %g m; expected at most %g and %g", column, found.max_m,
		         found.rms_m, max_m, rms_m);
}

static void test_swing(void **state)
{
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	batten_vary_options options = thesis(BATTEN_VARY_SWING);
	options.dlcb_pct = -2;
	batten_vary_outcome outcome;
	batten_hull *variant = vary(*state, parent, &options, &outcome);
	assert_column(variant, "tableB4_trawler", "swing", 0.0015, 0.0006);
	/* read off the printed column: -0.5221 stations */
	assert_near(parameter(&outcome, "dx_midship_m") / 3.048, -0.5221, 0.001, "dx amidships");
	const batten_measures measures = measures_of(*state, variant);
	assert_near(measures.cwp, 0.744, 0.001, "C_WP of table 2.2");
	assert_near(measures.lcf_pct_lbp_fwd, -5.22, 0.02, "LCF of table 2.2");
	batten_hull_destroy(variant);
	batten_hull_destroy(parent);
}

static void test_lackenby(void **state)
{
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	batten_vary_options options = thesis(BATTEN_VARY_LACKENBY);
	options.dcp_pct = 5;
	options.dlcb_pct = 2;
	batten_vary_outcome outcome;
	batten_hull *variant = vary(*state, parent, &options, &outcome);
	/* the split as it should be */
	assert_near(parameter(&outcome, "a_fore"), 0.3887, 0.0005, "a_fore");
	assert_near(parameter(&outcome, "a_aft"), -0.0855, 0.0005, "a_aft");
	assert_true(differ(variant, "tableB4_trawler", "lackenby").max_m > 0.01);
	batten_hull_destroy(variant);
	/* the split with the centre the thesis's program took */
	options.lcb_used_pct = 0.67;
	variant = vary(*state, parent, &options, &outcome);
	assert_near(parameter(&outcome, "a_fore"), 0.3998, 0.0005, "a_fore");
	assert_near(parameter(&outcome, "a_aft"), -0.0974, 0.0005, "a_aft");
	assert_column(variant, "tableB4_trawler", "lackenby", 0.0015, 0.0006);
	const batten_measures measures = measures_of(*state, variant);
	assert_near(measures.cwp, 0.782, 0.001, "C_WP of table 2.4");
	assert_near(measures.lcf_pct_lbp_fwd, -2.28, 0.02, "LCF of table 2.4");
	batten_hull_destroy(variant);
	batten_hull_destroy(parent);
}

/* A Lackenby shift without parallel body, dx = a x (1 - x) in each half. */
static batten_hull *shifted(batten_context *context, const batten_hull *parent, double a_aft,
                            double a_fore)
{
	variation_parent ready;
	batten_hull *variant = NULL;
	assert_int_equal(variation_parent_create(context, parent, &ready), BATTEN_OK);
	assert_int_equal(variation_parent_sections(&ready, true), BATTEN_OK);
	const variation_shift shift = { .span = ready.span,
		                            .aft = { .linear = a_aft },
		                            .fore = { .linear = a_fore } };
	assert_int_equal(batten_hull_clone(context, parent, &variant), BATTEN_OK);
	assert_int_equal(variation_move_sections(&ready, &shift, variant), BATTEN_OK);
	variation_parent_destroy(&ready);
	return variant;
}

/* The pairs fitted to the printed columns: what is left is the move of the sections itself. */
static void test_fitted_pairs(void **state)
{
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	batten_hull *final = shifted(*state, parent, 0.6233, 0.6554);
	assert_column(final, "tableB5_trawler_avg", "final", 0.001, 0.0003);
	batten_hull *lackenby = shifted(*state, parent, -0.0974, 0.4000);
	assert_column(lackenby, "tableB4_trawler", "lackenby", 0.0004, 0.0002);
	batten_hull_destroy(lackenby);
	batten_hull_destroy(final);
	batten_hull_destroy(parent);
}

/* No column is at hand: the shifts that were read off it, and the particulars of its offsets. */
static void test_one_minus_prismatic(void **state)
{
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	batten_vary_options options = thesis(BATTEN_VARY_ONE_MINUS_PRISMATIC);
	options.dcp_pct = 5;
	options.dlcb_pct = -2;
	batten_vary_outcome outcome;
	batten_hull_destroy(vary(*state, parent, &options, &outcome));
	assert_near(parameter(&outcome, "c_fore"), -0.0612, 0.0002, "c_fore");
	assert_near(parameter(&outcome, "c_aft"), 0.2208, 0.0002, "c_aft");
	options.lcb_used_pct = 0.67;
	batten_hull *variant = vary(*state, parent, &options, &outcome);
	assert_near(parameter(&outcome, "c_fore"), -0.0557, 0.0006, "c_fore");
	assert_near(parameter(&outcome, "c_aft"), 0.2143, 0.0006, "c_aft");
	const batten_measures measures = measures_of(*state, variant);
	assert_near(measures.lcb_pct_lbp_fwd, -3.44, 0.04, "LCB");
	assert_near(measures.cwp, 0.760, 0.001, "C_WP");
	assert_near(measures.lcf_pct_lbp_fwd, -5.09, 0.02, "LCF");
	batten_hull_destroy(variant);
	batten_hull_destroy(parent);
}

/* The places sections are taken from, as another program of these formulas found them; the one at
 * station 6 lies where area over breadth hardly changes. */
static void test_moor(void **state)
{
	static const double stations[] = { 0.5, 1, 2, 3, 4, 6, 7, 8, 9, 9.5 };
	static const double places[] = { .500,  1.002, 2.003, 3.018, 4.021,
		                             5.839, 6.794, 7.935, 9.085, 9.552 };
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	variation_parent ready;
	variation_moor moor;
	assert_int_equal(variation_parent_create(*state, parent, &ready), BATTEN_OK);
	assert_int_equal(variation_parent_sections(&ready, true), BATTEN_OK);
	const variation_change areas = { 5, 1, 0.67, 0, 0 }, waterline = { 5, 1, 2.03, 0, 0 };
	variation_shift of_areas, of_waterline;
	assert_true(variation_shift_lackenby(&ready.areas, &ready.span, &areas, &of_areas));
	assert_true(variation_shift_lackenby(&ready.waterline, &ready.span, &waterline, &of_waterline));
	assert_near(of_waterline.fore.linear, 0.38698, 5e-5, "a of the fore waterline");
	assert_near(of_waterline.aft.linear, 0.07854, 5e-5, "a of the after waterline");
	assert_int_equal(variation_moor_create(&ready, &of_areas, &of_waterline, &moor), BATTEN_OK);
	for (size_t i = 0; i < sizeof stations / sizeof stations[0]; i++) {
		bool found = false;
		const double place = variation_moor_place(&moor, 3.048 * stations[i], &found) / 3.048;
		assert_true(found);
		assert_near(place, places[i], fabs(stations[i] - 6) < 0.1 ? 0.02 : 0.004, "place");
	}
	variation_moor_destroy(&moor);
	variation_parent_destroy(&ready);
	batten_vary_options options = thesis(BATTEN_VARY_MOOR);
	options.dcp_pct = options.dcwp_pct = 5;
	options.dlcb_pct = options.dlcf_pct = 1;
	options.lcb_used_pct = 0.67;
	options.lcf_used_pct = 2.03;
	batten_hull *variant = vary(*state, parent, &options, NULL);
	const batten_measures before = measures_of(*state, parent),
						  after = measures_of(*state, variant);
	assert_near(after.volume_m3 / before.volume_m3, 1.050, 0.0015, "volume");
	assert_near(after.lcb_pct_lbp_fwd, -0.18, 0.04, "LCB");
	assert_near(after.cwp, 0.790, 0.001, "C_WP");
	assert_near(after.lcf_pct_lbp_fwd, -2.70, 0.01, "LCF");
	batten_hull_destroy(variant);
	batten_hull_destroy(parent);
}

/* Five steps from the parent to the final form: table B.5 prints the ends, the steps are linear. */
static void test_average(void **state)
{
	static struct printed first, last;
	read_column("tableB5_trawler_avg", "parent", &first);
	read_column("tableB5_trawler_avg", "final", &last);
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	batten_hull *final = shifted(*state, parent, 0.6233, 0.6554);
	const double ratios[] = { 1, 1.040, 1.080, 1.120, 1.160, 1.2003 };
	const double volume = measures_of(*state, parent).volume_m3;
	for (size_t k = 0; k <= 5; k++) {
		const double weight = (double)k / 5;
		const batten_hull *const others[] = { final };
		batten_vary_options options = method(BATTEN_VARY_AVERAGE);
		options.other_count = 1;
		options.others = others;
		options.weights = &weight;
		batten_hull *variant = vary(*state, parent, &options, NULL);
		for (size_t i = 0; i < first.count; i++)
			assert_near(offset_at(variant, first.x_m[i], first.z_m[i]),
			            (1 - weight) * first.y_m[i] + weight * last.y_m[i], 0.001 * weight + 1e-12,
			            "offset");
		assert_near(measures_of(*state, variant).volume_m3 / volume, ratios[k], 0.003, "volume");
		batten_hull_destroy(variant);
	}
	batten_hull_destroy(final);
	batten_hull_destroy(parent);
}

/* Particulars of table 2.2. */
static void test_parent(void **state)
{
	batten_hull *parent = read_hull(*state, "bsra_trawler");
	const batten_measures measures = measures_of(*state, parent);
	assert_near(measures.volume_m3, 244, 2.7, "volume");
	assert_near(measures.cwp, 0.753, 0.0006, "C_WP");
	assert_near(measures.cp, 0.588, 0.003, "C_P");
	assert_near(measures.lcb_pct_lbp_fwd, -1.34, 0.04, "LCB");
	assert_near(measures.lcf_pct_lbp_fwd, -4.06, 0.02, "LCF");
	batten_hull_destroy(parent);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_parent, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_swing, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_lackenby, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_fitted_pairs, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_one_minus_prismatic, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_moor, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_average, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
