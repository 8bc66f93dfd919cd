/* What no surface is fitted to, and memory that runs out. */
#include "support/failing_heap.h"
#include "unit/fit_fixture.h"

/* Round at keel, stem and stern alike: an ellipsoid's half below its widest waterline. */
static double ellipsoid(double x, double z)
{
	const double along = (x - 8.0) / 8.0;
	const double down = 1.0 - z;
	const double rest = 1.0 - along * along - down * down;
	return rest > 0.0 ? 2.0 * sqrt(rest) : 0.0;
}

static void refuse(batten_context *context, const batten_hull *hull,
                   const batten_fit_options *options, batten_status status, const char *part)
{
	batten_surface *surface = NULL;
	batten_fit_deviation deviation = { .point_count = 12345 };
	assert_int_equal(batten_hull_fit(context, hull, options, &surface, &deviation), status);
	assert_null(surface);
	assert_int_equal(deviation.point_count, 12345);
	if (!strstr(batten_context_error(context), part))
		fail_msg("'%s' is not in '%s'", part, batten_context_error(context));
	assert_null(strchr(batten_context_error(context), '\n'));
}

static void test_refusals(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_hull *wigley = read_hull(*state, "wigley");
	batten_fit_options options = net(8, 8, 1);
	refuse(*state, hull, &options, BATTEN_USAGE, "order 1");
	options = net(9, 9, 9);
	refuse(*state, hull, &options, BATTEN_USAGE, "order 9");
	options = net(8, 3, 4);
	refuse(*state, hull, &options, BATTEN_USAGE, "3 poles along the sections");
	options = net(0, 0, 4);
	refuse(*state, hull, &options, BATTEN_USAGE, "0 poles along the hull");
	options = net(4097, 4, 4);
	refuse(*state, hull, &options, BATTEN_USAGE, "4097 poles");
	options = net(12, 11, 4);
	refuse(*state, hull, &options, BATTEN_INPUT, "found 128 points, expected at least 132");
	options = net(16, 4, 4);
	refuse(*state, hull, &options, BATTEN_INPUT, "on the longest waterline, expected at least 16");
	options = net(4, 11, 4);
	refuse(*state, hull, &options, BATTEN_INPUT, "on the longest section, expected at least 11");
	options = net(8, 8, 4);
	options.rounded = BATTEN_ROUNDED_STEM;
	refuse(*state, hull, &options, BATTEN_USAGE, "the stem cannot be rounded");
	options.rounded = 8;
	refuse(*state, hull, &options, BATTEN_USAGE, "edge 8");
	options = net(8, 8, 4);
	options.stiffness = 0.0;
	refuse(*state, hull, &options, BATTEN_USAGE, "stiffness 0");
	options.stiffness = 1.5;
	refuse(*state, hull, &options, BATTEN_USAGE, "stiffness 1.5");
	options = net(3, 3, 3);
	options.rounded = BATTEN_ROUNDED_STEM;
	refuse(*state, wigley, &options, BATTEN_USAGE, "rounded edge needs");
	batten_hull_destroy(wigley);
	batten_hull_destroy(hull);
}

static double nothing(double x, double z)
{
	(void)x;
	(void)z;
	return 0.0;
}

/* Tables that are no body, and one whose surface meets itself at the keel line. */
static void test_strange_hulls(void **state)
{
	const batten_fit_options options = net(6, 6, 4);
	batten_hull *flat = hull_of(*state, nothing);
	refuse(*state, flat, &options, BATTEN_INPUT, "no half-breadth is above 0");
	batten_hull_destroy(flat);
	const double x[3] = { 0, 1, 2 };
	const double z[3] = { 0, 1, 2 };
	const double y[9] = { 1, 1, 1, 1, 1, 1, 1, 1, 1 };
	/* One section, then one waterline. */
	const uint8_t nodes[2][9] = { { 0, 1, 0, 0, 1, 0, 0, 1, 0 }, { 0, 0, 0, 1, 1, 1, 0, 0, 0 } };
	for (size_t k = 0; k < 2; k++) {
		const batten_hull_table table = { .name = "line",
			                              .lbp_m = 2,
			                              .draft_m = 1,
			                              .station_count = 3,
			                              .waterline_count = 3,
			                              .x_m = x,
			                              .z_m = z,
			                              .y_m = y,
			                              .nodes = nodes[k] };
		batten_hull *hull = NULL;
		batten_surface *surface = NULL;
		const batten_fit_options least = net(2, 2, 2);
		assert_int_equal(batten_hull_create(*state, &table, &hull), BATTEN_OK);
		assert_int_equal(batten_hull_fit(*state, hull, &least, &surface, NULL), BATTEN_INPUT);
		assert_null(surface);
		batten_hull_destroy(hull);
	}
	batten_hull *round = hull_of(*state, ellipsoid);
	batten_fit_deviation deviation;
	batten_surface *surface = fit(*state, round, &options, &deviation);
	assert_true(isfinite(deviation.max_m) && isfinite(deviation.rms_m));
	batten_surface_destroy(surface);
	batten_hull_destroy(round);
}

static batten_status fit_once(batten_context *context, void *user)
{
	batten_fit_options options = net(8, 7, 4);
	options.correction_limit = 1;
	batten_surface *surface = NULL;
	const batten_status status = batten_hull_fit(context, user, &options, &surface, NULL);
	assert_int_equal(surface != NULL, status == BATTEN_OK);
	batten_surface_destroy(surface);
	return status;
}

static void test_memory(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_hull *hull = read_hull(context, "highspeed_craft");
	assert_true(failing_heap_each(&heap, context, fit_once, hull) > 20);
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_strange_hulls, make_context, end_context),
		cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
