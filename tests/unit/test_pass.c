/* Forward and inverse fairing: what stays, identities, layouts, stops, what is restored, refusals. */
#include "unit/pass_fixture.h"

static double largest_change(const batten_hull *a, const batten_hull *b)
{
	double worst = 0;
	const size_t nodes = batten_hull_station_count(a) * batten_hull_waterline_count(a);
	for (size_t n = 0; n < nodes; n++)
		worst = fmax(worst, fabs(batten_hull_y_m(a)[n] - batten_hull_y_m(b)[n]));
	return worst;
}

/* Order 2 joins the points by straight lines, and as many vertices as points reproduce them: nothing
 * changes, by approximation and inversely to the last bit. */
static void test_identities(void **state)
{
	static const char *const names[] = { "wigley_noisy", "npl_parent", "highspeed_craft",
		                                 "bsra_trawler" };
	for (size_t n = 0; n < 4; n++) {
		batten_hull *hull = read_hull(*state, names[n]);
		for (int m = 0; m < 2; m++) {
			batten_fair_options options = by_method(
				m == 0 ? BATTEN_METHOD_FORWARD_APPROXIMATION : BATTEN_METHOD_INVERSE, 3);
			options.pass.order = 2;
			batten_fairing *fairing = fair(*state, hull, &options);
			assert_true(largest_change(hull, batten_fairing_faired(fairing)) == 0);
			batten_fairing_destroy(fairing);
		}
		batten_hull_destroy(hull);
	}
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = by_method(BATTEN_METHOD_FORWARD_FIT, 1);
	options.pass.order = 4;
	options.pass.order_sections = 2;
	options.pass.vertices = (unsigned)batten_hull_station_count(hull);
	batten_fairing *fairing = fair(*state, hull, &options);
	const double off = largest_change(hull, batten_fairing_faired(fairing));
	assert_true(off > 0 && off < 1e-9);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* A field that its representation has: cubic lines have linear second derivatives, which a fit of the
 * field at any order reproduces; so do sections, and the offsets stay. */
static void test_inverse_keeps_cubics(void **state)
{
	enum { N = 12 };
	double x[N], z[N], y[N * N];
	for (size_t i = 0; i < N; i++) {
		x[i] = (double)i + 0.02 * (double)(i * i);
		z[i] = 0.3 * (double)i;
	}
	for (size_t k = 0; k < N; k++)
		for (size_t i = 0; i < N; i++)
			y[k * N + i] = 1 + 0.05 * x[i] * (16 - x[i]) + 0.3 * z[k] - 0.02 * z[k] * z[k] * z[k] +
			               0.01 * x[i] * z[k];
	const batten_hull_table table = { "cubic", 16, 2, N, N, x, z, y, NULL };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(*state, &table, &hull), BATTEN_OK);
	batten_fair_options options = by_method(BATTEN_METHOD_INVERSE, 1);
	options.pass.order = 3;
	options.pass.order_sections = 4;
	options.pass.vertices = 5;
	batten_fairing *fairing = fair(*state, hull, &options);
	assert_true(largest_change(hull, batten_fairing_faired(fairing)) < 1e-11);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* What inverse fairing is for: noise goes, the form and all edges stay. */
static void test_inverse_fairs(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_hull *exact = read_hull(*state, "wigley");
	batten_fair_options options = by_method(BATTEN_METHOD_INVERSE, 1);
	options.pass.order = 4;
	options.pass.order_sections = 3;
	batten_fairing *fairing = fair(*state, hull, &options);
	const batten_hull *faired = batten_fairing_faired(fairing);
	const batten_fairing_row *rows = batten_fairing_rows(fairing);
	/* The edges keep their noise. */
	assert_true(rows[1].fn_per_m2 < 0.6 * rows[0].fn_per_m2);
	const size_t nx = batten_hull_station_count(hull);
	const size_t nz = batten_hull_waterline_count(hull);
	for (size_t k = 0; k < nz; k++)
		for (size_t i = 0; i < nx; i++)
			if (i == 0 || k == 0 || i + 1 == nx || k + 1 == nz)
				assert_true(batten_hull_y_m(faired)[k * nx + i] ==
				            batten_hull_y_m(hull)[k * nx + i]);
	/* Different orders give different hulls. */
	options.pass.order = 3;
	options.pass.order_sections = 4;
	batten_fairing *other = fair(*state, hull, &options);
	assert_true(largest_change(faired, batten_fairing_faired(other)) > 1e-6);
	batten_fairing_destroy(other);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(exact);
	batten_hull_destroy(hull);
}

/* A single line: the new second differences are those of the representation, to rounding. */
static void test_inverse_of_a_line(void **state)
{
	enum { N = 8 };
	const double x[N] = { 0, 1, 2, 3, 4, 5, 6, 7 };
	const double y[N] = { 0, 1, 3, 9, 16, 25, 37, 48 };
	double out[N];
	batten_pass_options options;
	batten_pass_options_default(&options);
	options.method = BATTEN_METHOD_INVERSE;
	options.device = BATTEN_DEVICE_REFERENCE;
	batten_pass *pass = NULL;
	assert_int_equal(batten_pass_create_line(*state, N, x, &options, &pass), BATTEN_OK);
	assert_int_equal(batten_pass_batch(*state, pass, 1, 1, y, out, NULL), BATTEN_OK);
	batten_pass_destroy(pass);
	assert_true(out[0] == y[0] && out[N - 1] == y[N - 1]);
	/* The second differences 1, 4, 1, 2, 3, -1 as a quadratic polygon at equal spacing: inside, the
	 * knots' mid-spans are the points, whose value is (1/8, 3/4, 1/8) of the vertices. */
	const double d2 = out[3 - 1] - 2 * out[3] + out[3 + 1];
	assert_near(d2, 0.125 * 4 + 0.75 * 1 + 0.125 * 2, 1e-12, "second difference");
	const double first = out[0] - 2 * out[1] + out[2];
	assert_near(first, 1, 1e-12, "second difference at the end of the field");
}

/* x is the parameter's business, y only weights: a line that is straight stays, whatever its spacing. */
static void test_straight_line(void **state)
{
	const double x[] = { 0, 0.1, 1, 1.5, 4, 4.2, 9 };
	double y[7], out[7];
	for (size_t i = 0; i < 7; i++)
		y[i] = 3 - 0.5 * x[i];
	for (unsigned order = 2; order <= 7; order++)
		for (int m = BATTEN_METHOD_FORWARD_APPROXIMATION; m <= BATTEN_METHOD_INVERSE; m++) {
			batten_pass_options options;
			batten_pass_options_default(&options);
			options.method = (batten_fair_method)m;
			options.order = order;
			options.vertices = m == BATTEN_METHOD_FORWARD_FIT ? order : 0;
			options.device = BATTEN_DEVICE_REFERENCE;
			batten_pass *pass = NULL;
			if (m == BATTEN_METHOD_INVERSE && order > 5)
				continue;
			assert_int_equal(batten_pass_create_line(*state, 7, x, &options, &pass), BATTEN_OK);
			assert_int_equal(batten_pass_batch(*state, pass, 1, 2, y, out, NULL), BATTEN_OK);
			batten_pass_destroy(pass);
			for (size_t i = 0; i < 7; i++)
				assert_near(out[i], y[i], 1e-10, "straight line");
		}
}

static const char header[] = "# batten-offsets: 1\n# name: t\n# unit: m\n# frame: ap-fwd\n"
							 "# lbp: 6\n# draft: 1\n";

/* A long table: line ends off the grid end their lines, points between are faired like any other. */
static void test_long_layout(void **state)
{
	char text[2048];
	(void)snprintf(text, sizeof text, "%s%s", header,
	               "# layout: long\nwaterline,z,x,y\n"
	               "1,0.5,0.2,0\n1,0.5,1,0.8\n1,0.5,2,1\n1,0.5,2.4,1.3\n1,0.5,3,1.1\n"
	               "1,0.5,4,0.9\n1,0.5,5.5,0\n"
	               "2,1,0,0.1\n2,1,1,0.9\n2,1,2,1.1\n2,1,3,1.2\n2,1,4,1\n2,1,5.8,0\n"
	               "3,1.5,0,0.2\n3,1.5,1,1\n3,1.5,2,1.2\n3,1.5,3,1.3\n3,1.5,4,1.1\n3,1.5,6,0\n");
	batten_hull *hull = parse_hull(*state, text);
	const batten_fair_options options = by_method(BATTEN_METHOD_FORWARD_APPROXIMATION, 1);
	batten_fairing *fairing = fair(*state, hull, &options);
	assert_true(largest_change(hull, batten_fairing_faired(fairing)) > 1e-4);
	/* Read again, the written hull has the moved point and the ends it had. */
	batten_pass *pass = NULL;
	assert_int_equal(batten_pass_create(*state, hull, NULL, &pass), BATTEN_OK);
	const size_t values = batten_pass_describe(pass).value_count;
	double before[64], after[64];
	assert_true(values <= 64);
	batten_pass_values(pass, hull, before);
	batten_pass_values(pass, batten_fairing_faired(fairing), after);
	const size_t nodes = batten_hull_station_count(hull) * batten_hull_waterline_count(hull);
	size_t moved = 0;
	for (size_t v = nodes; v < values; v++) {
		moved += before[v] != after[v];
		if (before[v] < 1)
			assert_true(before[v] == after[v]);
	}
	assert_int_equal(moved, 1);
	/* The section at x = 0 has two points. */
	assert_int_equal(batten_fairing_describe_pass(fairing).facts.passed_count, 1);
	batten_pass_destroy(pass);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

static void test_stops(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = by_method(BATTEN_METHOD_FORWARD_APPROXIMATION, 20);
	options.max_cn_pct = 3;
	batten_fairing *fairing = fair(*state, hull, &options);
	size_t count = batten_fairing_row_count(fairing);
	assert_int_equal(batten_fairing_describe_pass(fairing).stop, BATTEN_STOP_MAX_CN);
	assert_true(count > 1 && count < 21);
	assert_true(batten_fairing_rows(fairing)[count - 1].cn_pct <= 3);
	batten_closeness closeness;
	assert_int_equal(
		batten_hull_closeness(*state, batten_fairing_faired(fairing), hull, &closeness), BATTEN_OK);
	assert_true(closeness.cn_pct == batten_fairing_rows(fairing)[count - 1].cn_pct);
	batten_fairing_destroy(fairing);
	options.max_cn_pct = 0;
	options.least_gain_pct = 5;
	fairing = fair(*state, hull, &options);
	count = batten_fairing_row_count(fairing);
	const batten_fairing_row *last = &batten_fairing_rows(fairing)[count - 1];
	assert_int_equal(batten_fairing_describe_pass(fairing).stop, BATTEN_STOP_GAIN);
	assert_true(count > 2 && count < 21);
	assert_true(last[0].fn_per_m2 > 0.95 * last[-1].fn_per_m2);
	assert_true(last[-1].fn_per_m2 <= 0.95 * last[-2].fn_per_m2);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

static void test_restore(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	for (int what = BATTEN_RESTORE_BEAM; what <= BATTEN_RESTORE_CP_LCB; what++) {
		batten_fair_options options = by_method(BATTEN_METHOD_FORWARD_APPROXIMATION, 3);
		options.restore = (batten_restore)what;
		batten_fairing *fairing = fair(*state, hull, &options);
		const batten_fairing_row *rows = batten_fairing_rows(fairing);
		assert_int_equal(batten_fairing_row_count(fairing), 5);
		assert_true(rows[4].restored && !rows[3].restored && rows[4].iteration == 3);
		if (what == BATTEN_RESTORE_BEAM)
			assert_near(rows[4].beam_m, rows[0].beam_m, 1e-12 * rows[0].beam_m, "beam");
		if (what == BATTEN_RESTORE_VOLUME)
			assert_near(rows[4].volume_m3, rows[0].volume_m3, 1e-9 * rows[0].volume_m3, "volume");
		if (what == BATTEN_RESTORE_CP_LCB) {
			assert_near(rows[4].lcb_pct_lbp_fwd, rows[0].lcb_pct_lbp_fwd, 1e-4, "LCB");
			assert_near(rows[4].cb / rows[4].cm, rows[0].cb / rows[0].cm, 1e-4, "C_P");
		}
		batten_fairing_destroy(fairing);
	}
	batten_hull_destroy(hull);
}

/* The smoothing of gross errors as a method: the misprint of the NPL hull and nothing else. */
static void test_smooth(void **state)
{
	batten_hull *hull = read_hull(*state, "npl_parent");
	batten_fair_options options = by_method(BATTEN_METHOD_SMOOTH, 5);
	options.smooth = true;
	batten_fairing *fairing = fair(*state, hull, &options);
	assert_int_equal(batten_fairing_replacement_count(fairing), 1);
	const batten_replacement *replaced = batten_fairing_replacements(fairing);
	assert_near(replaced->old_m, 0.1192, 1e-12, "misprint");
	assert_near(replaced->new_m, 0.109, 0.0005, "what it should be");
	assert_near(largest_change(hull, batten_fairing_faired(fairing)),
	            replaced->old_m - replaced->new_m, 1e-15, "change");
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

static void assert_refused(batten_context *context, batten_status status, batten_status expected,
                           const char *words)
{
	assert_int_equal(status, expected);
	if (!strstr(batten_context_error(context), words))
		fail_msg("\"%s\" does not say \"%s\"", batten_context_error(context), words);
}

static void test_refusals(void **state)
{
	batten_context *context = *state;
	batten_hull *hull = read_hull(context, "wigley");
	batten_pass *pass = NULL;
	batten_pass_options options;
	const struct {
		batten_fair_method method;
		unsigned order, vertices;
		const char *words;
	} cases[] = {
		{ BATTEN_METHOD_FORWARD_APPROXIMATION, 1, 0, "found order 1, expected 2 to 8" },
		{ BATTEN_METHOD_FORWARD_APPROXIMATION, 9, 0, "found order 9, expected 2 to 8" },
		{ BATTEN_METHOD_FORWARD_APPROXIMATION, 3, 8, "found 8 vertices" },
		{ BATTEN_METHOD_FORWARD_FIT, 4, 3, "found 3 vertices, expected at least the order 4" },
		{ BATTEN_METHOD_FORWARD_FIT, 4, 14,
		  "order 4 with 14 vertices needs 14 points, the longest waterline has 13" },
		{ BATTEN_METHOD_SEARCH, 3, 0, "is expected" },
	};
	for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
		batten_pass_options_default(&options);
		options.method = cases[c].method;
		options.order = cases[c].order;
		options.vertices = cases[c].vertices;
		assert_refused(context, batten_pass_create(context, hull, &options, &pass), BATTEN_USAGE,
		               cases[c].words);
		assert_null(pass);
	}
	const double x[] = { 0, 1, 1, 2, 3, 4 };
	batten_pass_options_default(&options);
	assert_refused(context, batten_pass_create_line(context, 6, x, &options, &pass), BATTEN_INPUT,
	               "points 2 and 3");
	assert_refused(context, batten_pass_create_line(context, 2, x, &options, &pass), BATTEN_USAGE,
	               "a line of 2 points, expected 3");
	options.order = 4;
	assert_refused(context, batten_pass_create_line(context, 3, x + 2, &options, &pass),
	               BATTEN_USAGE, "order 4 needs 4 points, the line has 3");
	batten_fairing *fairing = NULL;
	for (int i = 0; i < 2; i++) {
		const batten_fair_options bad = by_method(BATTEN_METHOD_INVERSE, i == 0 ? 0 : 1000000000);
		assert_refused(context, batten_hull_fair(context, hull, &bad, &fairing), BATTEN_USAGE,
		               "iterations, expected 1 to 10000");
	}
	const batten_lock lock = { BATTEN_LOCK_STATION, 8, 0 };
	batten_fair_options locked = by_method(BATTEN_METHOD_INVERSE, 1);
	locked.locks = &lock;
	locked.lock_count = 1;
	assert_refused(context, batten_hull_fair(context, hull, &locked, &fairing), BATTEN_USAGE,
	               "are of the search");
	batten_hull_destroy(hull);
}

/* A stem point within its waterline; and a line too short is passed over and counted. */
static void test_profile_and_short_lines(void **state)
{
	static const char rows[] = "# layout: grid\nz\\x,0,1,2,3,4,5,6\n0,,,0,0.2,0.1,,\n"
							   "0.5,0,0.5,0.8,1,0.9,0.6,0.2\n1,0,0.6,0.9,1.1,1,0.7,0.3\n"
							   "1.5,0,0.7,1,1.2,1.1,0.8,0.4\n2,0,0.7,1,1.25,1.1,0.8,0.4\n";
	char text[1024];
	batten_pass *pass = NULL;
	batten_pass_options options;
	batten_pass_options_default(&options);
	(void)snprintf(text, sizeof text, "%s%sprofile,stem,6.4,0,1\n", header, rows);
	batten_hull *hull = parse_hull(*state, text);
	options.order = 4;
	assert_int_equal(batten_pass_create(*state, hull, &options, &pass), BATTEN_OK);
	assert_true(batten_pass_describe(pass).passed_count > 0);
	batten_pass_destroy(pass);
	batten_hull_destroy(hull);
	(void)snprintf(text, sizeof text, "%s%sprofile,stem,5.5,0,1\n", header, rows);
	hull = parse_hull(*state, text);
	pass = NULL;
	assert_refused(*state, batten_pass_create(*state, hull, NULL, &pass), BATTEN_INPUT,
	               "stem point at x = 5.5 m, z = 1 m lies behind the end of the waterline at 1 m");
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_identities, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_inverse_keeps_cubics, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_inverse_fairs, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_inverse_of_a_line, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_straight_line, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_long_layout, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_stops, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_restore, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_smooth, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_profile_and_short_lines, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
