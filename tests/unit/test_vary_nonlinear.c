/* Soeding's method: the thesis's column, the presets, what stays and what is refused. */
#include "core/spline.h"
#include "unit/vary_fixture.h"

static batten_vary_options preset(batten_vary_preset which, double amount)
{
	batten_vary_options options = method(BATTEN_VARY_NONLINEAR);
	options.preset = which;
	options.amount = amount;
	return options;
}

/* z / T -> t - (a + b t) t (1 - t). */
static batten_vary_factors lowered(double a, double b)
{
	batten_vary_factors factors = { 0 };
	for (size_t c = 0; c < 3; c++)
		factors.moves[2][c].coefficients[0] = 1;
	factors.moves[2][2] = (batten_vary_factor){ .coefficients = { -a, -b },
		                                        .guard_first = 1,
		                                        .guard_last = 1 };
	return factors;
}

/* Volume, area amidships and centre from the sections that are printed (variation of the sections by
 * trapezoids, along the ship by the natural spline). */
struct form {
	double volume_m3, midship_m2, lcb_pct;
};

static struct form form_of(batten_context *context, const batten_hull *hull)
{
	const size_t stations = batten_hull_station_count(hull);
	const double *x = batten_hull_x_m(hull), *z = batten_hull_z_m(hull), *y = batten_hull_y_m(hull);
	double at[16] = { 0 }, areas[16] = { 0 };
	size_t count = 0;
	struct form form = { 0 };
	for (size_t s = 0; s < stations; s++) {
		if (s == 6 || s == 8) /* 4.5 and 5.5, which are not */
			continue;
		at[count] = x[s];
		areas[count] = 0;
		for (size_t w = 0; w + 1 < batten_hull_waterline_count(hull); w++)
			areas[count] += (y[w * stations + s] + y[(w + 1) * stations + s]) * (z[w + 1] - z[w]);
		if (s == 7)
			form.midship_m2 = areas[count];
		count++;
	}
	struct spline spline;
	assert_int_equal(count, 13);
	assert_int_equal(spline_create(context, count, at, areas, SPLINE_NATURAL, &spline), BATTEN_OK);
	form.volume_m3 = spline_integral(&spline, at[0], at[12], 0, 1);
	form.lcb_pct = 100 *
	               (spline_integral(&spline, at[0], at[12], 1, 1) / form.volume_m3 / 30.48 - 0.5);
	spline_destroy(&spline);
	return form;
}

/* Table B.4's column, thesis table 2.6: half-breadths stay and the waterlines move. Its waterlines are
 * not printed; the family matched to the volume and C_M that are gives C_P and LCB as printed. */
static void test_thesis_column(void **state)
{
	static const double z[] = { 0,      0.1267, 0.2013, 0.2838, 0.3733,
		                        0.4704, 0.6855, 1.1961, 1.8086, 2.515 };
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_vary_options options = method(BATTEN_VARY_NONLINEAR);
	batten_vary_factors factors = lowered(0.5583, -0.0682);
	options.factors = &factors;
	batten_hull *variant = vary(*state, hull, &options, NULL);
	const size_t nodes = batten_hull_station_count(hull) * batten_hull_waterline_count(hull);
	assert_memory_equal(batten_hull_nodes(variant), batten_hull_nodes(hull), nodes);
	for (size_t i = 0; i < nodes; i++)
		if (batten_hull_nodes(hull)[i] == BATTEN_NODE_GIVEN)
			assert_true(batten_hull_y_m(variant)[i] == batten_hull_y_m(hull)[i]);
	for (size_t w = 0; w < 10; w++)
		assert_near(batten_hull_z_m(variant)[w], z[w], 1e-3, "z");
	const struct form p = form_of(*state, hull), q = form_of(*state, variant);
	assert_near(q.volume_m3 / p.volume_m3, 1.0906, 1e-4, "volume");
	assert_near(q.midship_m2 / p.midship_m2, 1.0507, 1e-4, "C_M");
	assert_near(q.volume_m3 / p.volume_m3 / (q.midship_m2 / p.midship_m2), 1.0379, 1e-4, "C_P");
	assert_near(q.lcb_pct - p.lcb_pct, -0.272, 1e-3, "LCB");
	const batten_measures before = measures_of(*state, hull), after = measures_of(*state, variant);
	assert_near(after.cwp, before.cwp, 1e-15, "C_WP");
	assert_near(after.lcf_pct_lbp_fwd, before.lcf_pct_lbp_fwd, 1e-13, "LCF");
	batten_hull_destroy(variant);
	batten_hull_destroy(hull);
}

static void test_one_parameter(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_vary_options options = method(BATTEN_VARY_NONLINEAR);
	batten_vary_factors factors = lowered(0.532, 0);
	options.factors = &factors;
	batten_hull *variant = vary(*state, hull, &options, NULL);
	const struct form p = form_of(*state, hull), q = form_of(*state, variant);
	assert_near(q.midship_m2 / p.midship_m2, 1.0495, 1e-4, "C_M");
	assert_near(q.volume_m3 / p.volume_m3 / (q.midship_m2 / p.midship_m2), 1.0391, 1e-4, "C_P");
	assert_near(q.lcb_pct - p.lcb_pct, -0.286, 1e-3, "LCB");
	batten_hull_destroy(variant);
	batten_hull_destroy(hull);
}

/* ------------------------------------------------------------------------------------------------
 * Presets
 * --------------------------------------------------------------------------------------------- */

/* A box of 10 m, 4 m and 2 m with a flat bottom, tables of eleven stations and twenty-one waterlines up
 * to twice the draft. */
static batten_hull *make_box(batten_context *context)
{
	enum { X = 11, Z = 21 };
	double x[X], z[Z], y[X * Z];
	for (size_t i = 0; i < X; i++)
		x[i] = (double)i;
	for (size_t j = 0; j < Z; j++)
		z[j] = 0.1 * (double)j;
	for (size_t i = 0; i < X * Z; i++)
		y[i] = 2;
	const batten_hull_table table = { .name = "box",
		                              .lbp_m = 10,
		                              .draft_m = 1,
		                              .station_count = X,
		                              .waterline_count = Z,
		                              .x_m = x,
		                              .z_m = z,
		                              .y_m = y };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(context, &table, &hull), BATTEN_OK);
	return hull;
}

/* Half-breadths move: the formulas of the README at every node. */
static void test_breadths(void **state)
{
	batten_hull *box = make_box(*state);
	for (int k = 0; k < 3; k++) {
		static const batten_vary_preset presets[] = { BATTEN_VARY_BILGE_RADIUS, BATTEN_VARY_V_NESS,
			                                          BATTEN_VARY_FLARE };
		const batten_vary_options options = preset(presets[k], 0.3);
		batten_hull *variant = vary(*state, box, &options, NULL);
		for (size_t i = 0; i < 231; i++) {
			const double x = 0.1 * (double)(i % 11), z = 0.1 * (double)((i - i % 11) / 11);
			const double below = fmax(1 - z, 0),
						 f[] = { -4 * x * (1 - x) * z * pow(below, 4) / 0.08192, -pow(below, 2),
				                 pow(x, 4) * z * z };
			assert_near(batten_hull_y_m(variant)[i], 2 * (1 + 0.3 * f[k]), 1e-14, "y");
		}
		batten_hull_destroy(variant);
	}
	batten_hull_destroy(box);
}

/* The floor of a box rises as a straight line from the keel; amidships by 4 * 1/4 of the amount. */
static void test_floor(void **state)
{
	batten_hull *box = make_box(*state);
	const batten_vary_options options = preset(BATTEN_VARY_RISE_OF_FLOOR, 0.25);
	batten_hull *variant = vary(*state, box, &options, NULL);
	for (size_t w = 0; w < 21; w++) {
		const double z = 0.1 * (double)w;
		assert_near(batten_hull_z_m(variant)[w], z, 0, "z");
		assert_near(batten_hull_y_m(variant)[w * 11 + 5], fmin(2 * z / 0.25, 2), 1e-12,
		            "amidships");
		assert_near(batten_hull_y_m(variant)[w * 11], 2, 1e-12, "aft"); /* rests */
	}
	/* below the bottom there is nothing left but the keel */
	assert_int_equal(batten_hull_nodes(variant)[5], BATTEN_NODE_GIVEN);
	batten_hull_destroy(variant);
	batten_hull_destroy(box);
}

/* Waterlines sink as one; half-breadths, the keel and what lies above the draft stay. */
static void test_u_ness(void **state)
{
	batten_hull *box = make_box(*state);
	const batten_vary_options options = preset(BATTEN_VARY_U_NESS, 0.1);
	batten_hull *variant = vary(*state, box, &options, NULL);
	for (size_t w = 0; w < 21; w++) {
		const double z = 0.1 * (double)w;
		const double expected = z < 1 ? z - 0.675 * z * (1 - z) * (1 - z) : z;
		assert_near(batten_hull_z_m(variant)[w], expected, 1e-14, "z");
	}
	batten_hull_destroy(variant);
	batten_hull_destroy(box);
}

/* What every preset does to a ship: form as expected, profile and waterline kept, table read again. */
static void test_ships(void **state)
{
	static const char *const hulls[] = { "bsra_trawler", "npl_parent", "wigley" };
	static const int fuller[] = { -1, -1, 1, -1, 1 };
	for (size_t h = 0; h < 3; h++) {
		batten_hull *hull = read_hull(*state, hulls[h]);
		const batten_measures p = measures_of(*state, hull);
		for (int k = 0; k < BATTEN_VARY_PRESET_COUNT; k++) {
			const batten_vary_options options = preset((batten_vary_preset)k, 0.05);
			batten_hull *variant = vary(*state, hull, &options, NULL);
			const batten_measures q = measures_of(*state, variant);
			assert_true((q.volume_m3 - p.volume_m3) * fuller[k] > 1e-4 * p.volume_m3);
			assert_true(fabs(q.volume_m3 / p.volume_m3 - 1) < 0.1);
			if (k != BATTEN_VARY_FLARE)
				assert_near(q.waterplane_area_m2, p.waterplane_area_m2,
				            1e-12 * p.waterplane_area_m2, "waterplane");
			assert_near(q.lwl_m, p.lwl_m, 1e-12 * p.lwl_m, "waterline");
			batten_hull_destroy(variant);
		}
		batten_hull_destroy(hull);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Maps that move along the ship too, and what is refused
 * --------------------------------------------------------------------------------------------- */

/* x' = x + a x (1 - x) (1 + z / T) of a Wigley hull: its half-breadth at any place is known, through
 * the place it came from. */
static void test_sheared(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley");
	batten_vary_factors factors = { 0 };
	const double a = 0.1, lbp = batten_hull_lbp_m(hull), draft = batten_hull_draft_m(hull);
	factors.moves[0][0] = (batten_vary_factor){ .coefficients = { a },
		                                        .guard_first = 1,
		                                        .guard_last = 1 };
	factors.moves[0][1].coefficients[0] = 1;
	factors.moves[0][2] = (batten_vary_factor){ .coefficients = { 1, 1 } };
	batten_vary_options options = method(BATTEN_VARY_NONLINEAR);
	options.factors = &factors;
	batten_hull *variant = vary(*state, hull, &options, NULL);
	const size_t stations = batten_hull_station_count(hull);
	double most = 0;
	for (size_t w = 0; w < batten_hull_waterline_count(hull); w++) {
		const double t = batten_hull_z_m(hull)[w] / draft, b = a * (1 + t);
		assert_near(batten_hull_z_m(variant)[w], batten_hull_z_m(hull)[w], 0, "z");
		for (size_t s = 0; s < stations; s++) {
			const double part = batten_hull_x_m(variant)[s] / lbp;
			assert_near(batten_hull_x_m(variant)[s], batten_hull_x_m(hull)[s], 0, "x");
			/* part = x + b x (1 - x) */
			const double x = ((1 + b) - sqrt((1 + b) * (1 + b) - 4 * b * part)) / (2 * b);
			const double y = 4 * batten_hull_half_beam_m(hull) * x * (1 - x) *
			                 (1 - (1 - t) * (1 - t));
			most = fmax(most, fabs(batten_hull_y_m(variant)[w * stations + s] - y));
		}
	}
	/* natural splines bend the ends, as with every method that moves sections */
	assert_true(most < 0.012 * batten_hull_half_beam_m(hull));
	batten_hull_destroy(variant);
	batten_hull_destroy(hull);
}

static void refuse(batten_context *context, const batten_hull *hull,
                   const batten_vary_options *options, batten_status status, const char *part)
{
	batten_hull *variant = NULL;
	const batten_status found = batten_hull_vary(context, hull, options, &variant, NULL);
	if (found != status || !strstr(batten_context_error(context), part))
		fail_msg("status %d, '%s'; expected %d, '%s'", found, batten_context_error(context), status,
		         part);
	assert_null(variant);
}

static void test_refusals(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler"), *box = make_box(*state);
	batten_hull *craft = read_hull(*state, "highspeed_craft");
	batten_vary_options options = method(BATTEN_VARY_NONLINEAR);
	refuse(*state, hull, &options, BATTEN_USAGE, "neither a preset nor factors");
	options = preset(BATTEN_VARY_U_NESS, NAN);
	refuse(*state, hull, &options, BATTEN_USAGE, "amount is nan");
	options = preset(BATTEN_VARY_U_NESS, 0.2); /* turns back at the keel: 1 - 6.75 a */
	refuse(*state, hull, &options, BATTEN_INPUT, "the map would fold the hull");
	options = preset(BATTEN_VARY_V_NESS, 1.5);
	refuse(*state, hull, &options, BATTEN_INPUT, "the map would fold the hull");
	options = preset(BATTEN_VARY_RISE_OF_FLOOR, -0.2);
	refuse(*state, box, &options, BATTEN_INPUT, "the floor would fall below the keel");
	options = preset(BATTEN_VARY_RISE_OF_FLOOR, 0.2);
	refuse(*state, craft, &options, BATTEN_INPUT, "takes these ends off their lines");
	batten_vary_factors factors = lowered(1, 0);
	options.factors = &factors;
	factors.moves[2][1].coefficients[5] = INFINITY;
	refuse(*state, hull, &options, BATTEN_USAGE, "function F8");
	factors = lowered(1, 0);
	factors.moves[0][2].guard_last = 5;
	refuse(*state, hull, &options, BATTEN_USAGE, "function F3");
	batten_hull_destroy(craft);
	batten_hull_destroy(box);
	batten_hull_destroy(hull);
}

static void test_names(void **state)
{
	(void)state;
	assert_string_equal(batten_vary_preset_name(BATTEN_VARY_BILGE_RADIUS), "bilge-radius");
	assert_null(batten_vary_preset_name(BATTEN_VARY_PRESET_COUNT));
	assert_null(batten_vary_preset_text(BATTEN_VARY_PRESET_COUNT));
	batten_vary_factors none, zero = { 0 };
	batten_vary_preset_factors(BATTEN_VARY_PRESET_COUNT, 1, &none);
	assert_memory_equal(&none, &zero, sizeof none);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_thesis_column, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_one_parameter, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_breadths, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_floor, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_u_ness, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_ships, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_sheared, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
		cmocka_unit_test(test_names),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
