/* Edges of fitted surfaces: held in the centreplane, rounded, along a raked profile. */
#include "unit/fit_fixture.h"

/* Sections of one shape, round at the keel, over round waterlines; full at every height. */
static double round_hull(double x, double z)
{
	const double along = (x - 8.0) / 8.0;
	return 2.0 * sqrt(fmax(0.0, 1.0 - along * along)) * sqrt(1.0 - (1.0 - z) * (1.0 - z));
}

/* Edges in the centreplane stay in it exactly; told not to, they leave it. */
static void test_held_edges(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fit_options options = net(12, 9, 4);
	for (int held = 1; held >= 0; held--) {
		options.hold_centreplane = held;
		batten_surface *surface = fit(*state, hull, &options, NULL);
		const batten_surface_net found = batten_surface_describe(surface);
		double off = 0.0;
		for (size_t i = 0; i < found.count_u; i++)
			off = fmax(off, fabs(pole(&found, i, 0)[1]));
		for (size_t j = 0; j < found.count_v; j++)
			off = fmax(off, fmax(fabs(pole(&found, 0, j)[1]), fabs(pole(&found, 11, j)[1])));
		assert_true(held ? off == 0.0 : off > 0.0);
		batten_surface_destroy(surface);
	}
	batten_hull_destroy(hull);
}

static void check_row_rounded(const double *edge, const double *inner)
{
	assert_true(edge[0] == inner[0]);
	assert_true(edge[1] == 0.0);
	assert_true(edge[2] == inner[2]);
}

/* A rounded edge is the projection of the next row on the centreplane: it is left along y, and a
 * mirrored half goes on with the same curvature (Letcher 3.12, 4.13). */
static void test_rounded_edges(void **state)
{
	batten_hull *hull = hull_of(*state, round_hull);
	batten_fit_options options = net(10, 8, 4);
	for (unsigned rounded = 1; rounded < 8; rounded++) {
		options.rounded = rounded;
		batten_fit_deviation deviation;
		batten_surface *surface = fit(*state, hull, &options, &deviation);
		const batten_surface_net found = batten_surface_describe(surface);
		for (size_t i = 0; i < 10 && rounded & BATTEN_ROUNDED_KEEL; i++)
			check_row_rounded(pole(&found, i, 0), pole(&found, i, 1));
		for (size_t j = 0; j < 8 && rounded & BATTEN_ROUNDED_STERN; j++)
			check_row_rounded(pole(&found, 0, j), pole(&found, 1, j));
		for (size_t j = 0; j < 8 && rounded & BATTEN_ROUNDED_STEM; j++)
			check_row_rounded(pole(&found, 9, j), pole(&found, 8, j));
		if (rounded == BATTEN_ROUNDED_KEEL)
			for (int k = 1; k < 8; k++) {
				batten_surface_point at;
				assert_int_equal(batten_surface_evaluate(surface, 0.125 * k, 0.0, &at), BATTEN_OK);
				const double *across = at.derivative[0][1];
				assert_near(across[0], 0.0, 1e-12, "x of the tangent across the keel");
				assert_near(across[2], 0.0, 1e-12, "z of the tangent across the keel");
				assert_true(across[1] > 0.1);
			}
		assert_below(deviation.max_pct, 3.0, "largest in percent of the half-beam");
		batten_surface_destroy(surface);
	}
	batten_hull_destroy(hull);
}

/* A rising keel and a raked stem in a long table: the edges of the surface follow them. */
static void test_profile(void **state)
{
	char text[8192];
	int used = snprintf(
		text, sizeof text,
		"# batten-offsets: 1\n# name: raked\n# unit: m\n# frame: ap-fwd\n# lbp: 10\n"
		"# draft: 2\n# layout: long\nwaterline,z,x,y\n");
	for (int w = 0; w <= 8; w++) {
		const double z = 0.25 * w;
		const double stem = 9.0 + 0.5 * z; /* 2 up, 1 forward */
		/* The keel rises aft, 0.2 in 1, from x = 5; below z = 0 there is none. */
		const double aft = fmax(0.0, 5.0 - 5.0 * z);
		used += snprintf(text + used, sizeof text - (size_t)used, "%d,%.17g,%.17g,0\n", w, z, aft);
		for (int s = 1; s < 10; s++)
			if (s > aft && s < stem)
				used += snprintf(text + used, sizeof text - (size_t)used, "%d,%.17g,%d,%.17g\n", w,
				                 z, s, 0.05 * (s - aft) * (stem - s) * (0.2 + z));
		used += snprintf(text + used, sizeof text - (size_t)used, "%d,%.17g,%.17g,0\n", w, z, stem);
	}
	batten_hull *hull = NULL;
	if (batten_hull_parse(*state, "raked.csv", text, (size_t)used, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(*state));
	const batten_fit_options options = net(9, 7, 4);
	batten_fit_deviation deviation;
	batten_surface *surface = fit(*state, hull, &options, &deviation);
	assert_below(deviation.max_pct, 2.0, "largest in percent of the half-beam");
	for (int k = 0; k <= 20; k++) {
		batten_surface_point at;
		assert_int_equal(batten_surface_evaluate(surface, 1.0, 0.05 * k, &at), BATTEN_OK);
		const double *p = at.derivative[0][0];
		assert_true(p[1] == 0.0);
		assert_near(p[0], 9.0 + 0.5 * p[2], 0.01, "x of the stem");
		assert_int_equal(batten_surface_evaluate(surface, 0.05 * k, 0.0, &at), BATTEN_OK);
		assert_near(p[2], fmax(0.0, 0.2 * (5.0 - p[0])), 0.08, "z of the keel");
	}
	batten_surface_destroy(surface);
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_held_edges, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_rounded_edges, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_profile, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
