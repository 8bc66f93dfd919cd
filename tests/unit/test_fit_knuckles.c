/* Fits of hulls with knuckle lines, and of tables that do not determine the net. */
#include "support/failing_heap.h"
#include "unit/fit_fixture.h"

/* Chine height over the baseline at x. */
typedef double chine(double x);

static double level(double x)
{
	(void)x;
	return 0.5;
}

static double rising(double x)
{
	return 0.3 + 0.4 * x / 16.0;
}

static double half_breadth(double x, double z, double at)
{
	const double part = x / 16.0;
	const double section = z < at ? 0.7 * (z / at) * (z / at) : 0.7 + 0.3 * (z - at) / (1.0 - at);
	return 8.0 * part * (1.0 - part) * section;
}

enum { LENGTH = 1 << 16 };

/* A bottom of parabolas and straight sides that meet at the chine, on a grid of 13 stations and 17
 * waterlines: a rising chine lies between the waterlines. */
static batten_hull *chine_hull(batten_context *context, chine *at, bool marked)
{
	static char text[LENGTH];
	int used = snprintf(
		text, sizeof text,
		"# batten-offsets: 1\n# name: chine\n# unit: m\n# frame: ap-fwd\n# lbp: 16\n"
		"# draft: 1\n# layout: grid\nz\\x");
	for (int s = 0; s <= 12; s++)
		used += snprintf(text + used, sizeof text - (size_t)used, ",%.17g", 16.0 * s / 12);
	for (int w = 0; w <= 16; w++) {
		used += snprintf(text + used, sizeof text - (size_t)used, "\n%.17g", w / 16.0);
		for (int s = 0; s <= 12; s++)
			used += snprintf(text + used, sizeof text - (size_t)used, ",%.17g",
			                 half_breadth(16.0 * s / 12, w / 16.0, at(16.0 * s / 12)));
	}
	used += snprintf(text + used, sizeof text - (size_t)used, "\n");
	for (int s = 0; marked && s <= 12; s++)
		used += snprintf(text + used, sizeof text - (size_t)used, "knuckle,station,%.17g,%.17g\n",
		                 16.0 * s / 12, at(16.0 * s / 12));
	assert_true(used < LENGTH);
	batten_hull *hull = NULL;
	if (batten_hull_parse(context, "chine", text, (size_t)used, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static size_t times(const batten_surface *surface, double least, double most, double *at)
{
	const batten_surface_net net = batten_surface_describe(surface);
	size_t most_times = 0;
	for (size_t i = net.order_v; i < net.count_v; i++) {
		size_t n = 0;
		for (size_t k = net.order_v; k < net.count_v; k++)
			n += net.knots_v[k] == net.knots_v[i];
		if (n > most_times && net.knots_v[i] > least && net.knots_v[i] < most) {
			most_times = n;
			*at = net.knots_v[i];
		}
	}
	return most_times;
}

/* With the knuckles the crease is kept and the fit is exact; without, no net of this size holds it. */
static void test_chines(void **state)
{
	chine *const chines[] = { level, rising };
	for (size_t c = 0; c < 2; c++)
		for (size_t order = 3; order <= 4; order++) {
			const batten_fit_options options = net(6, 9, order);
			batten_fit_deviation with, without;
			batten_hull *marked = chine_hull(*state, chines[c], true);
			batten_hull *plain = chine_hull(*state, chines[c], false);
			batten_surface *surface = fit(*state, marked, &options, &with);
			batten_surface *other = fit(*state, plain, &options, &without);
			double crease = 0.0;
			assert_int_equal(times(surface, 0.0, 1.0, &crease), order - 1);
			assert_below(with.max_pct, 1e-9, "largest with the knuckles");
			assert_true(without.max_pct > 0.1);
			/* along the crease the surface is the chine, and has a corner across it */
			for (int k = 1; k < 8; k++) {
				batten_surface_point above, below;
				assert_int_equal(batten_surface_evaluate(surface, 0.125 * k, crease, &above),
				                 BATTEN_OK);
				assert_int_equal(batten_surface_evaluate(surface, 0.125 * k, crease - 1e-9, &below),
				                 BATTEN_OK);
				const double *p = above.derivative[0][0];
				const double height = chines[c](p[0]);
				assert_near(p[2], height, 1e-10, "height of the chine");
				assert_near(p[1], half_breadth(p[0], height, height), 1e-10,
				            "breadth of the chine");
				const double *up = above.derivative[0][1];
				const double *down = below.derivative[0][1];
				assert_true(fabs(up[1] / up[2] - down[1] / down[2]) > 0.2);
			}
			batten_surface_destroy(surface);
			batten_surface_destroy(other);
			batten_hull_destroy(marked);
			batten_hull_destroy(plain);
		}
}

/* ------------------------------------------------------------------------------------------------
 * Knuckles of waterlines, on grids
 * --------------------------------------------------------------------------------------------- */

/* A wedge before, a box behind: every waterline has its corner at x = 8. */
static batten_hull *shouldered(batten_context *context, const char *extra)
{
	static char text[LENGTH];
	int used = snprintf(
		text, sizeof text,
		"# batten-offsets: 1\n# name: shoulder\n# unit: m\n# frame: ap-fwd\n# lbp: 16\n"
		"# draft: 1\n# layout: grid\nz\\x");
	for (int s = 0; s <= 12; s++)
		used += snprintf(text + used, sizeof text - (size_t)used, ",%.17g", 16.0 * s / 12);
	for (int w = 0; w <= 8; w++) {
		used += snprintf(text + used, sizeof text - (size_t)used, "\n%.17g", w / 8.0);
		for (int s = 0; s <= 12; s++) {
			const double ahead = fmax(0.0, 16.0 * s / 12 - 8.0) / 8.0;
			used += snprintf(text + used, sizeof text - (size_t)used, ",%.17g",
			                 (1.0 - ahead) * (1.0 + 0.5 * w / 8.0));
		}
	}
	used += snprintf(text + used, sizeof text - (size_t)used, "\n%s", extra);
	assert_true(used < LENGTH);
	batten_hull *hull = NULL;
	if (batten_hull_parse(context, "shoulder", text, (size_t)used, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return hull;
}

static void test_waterline_knuckles(void **state)
{
	const batten_fit_options options = net(9, 5, 4);
	batten_fit_deviation with, without;
	/* one mark is enough: the line runs on straight up and down */
	batten_hull *marked = shouldered(*state, "knuckle,waterline,8,0.5\n");
	batten_hull *plain = shouldered(*state, "");
	batten_surface_destroy(fit(*state, marked, &options, &with));
	batten_surface_destroy(fit(*state, plain, &options, &without));
	assert_below(with.max_pct, 1e-9, "largest with the knuckle");
	assert_true(without.max_pct > 0.1);
	batten_hull_destroy(marked);
	batten_hull_destroy(plain);
	/* a mark on the edge of the surface changes nothing */
	batten_fit_deviation edge;
	batten_hull *ended = shouldered(*state, "knuckle,waterline,16,0.5\nknuckle,station,8,1\n");
	batten_surface_destroy(fit(*state, ended, &options, &edge));
	assert_true(edge.max_m == without.max_m);
	batten_hull_destroy(ended);
}

static void refuse(batten_context *context, const batten_hull *hull,
                   const batten_fit_options *options, const char *part)
{
	batten_surface *surface = NULL;
	assert_int_equal(batten_hull_fit(context, hull, options, &surface, NULL), BATTEN_INPUT);
	assert_null(surface);
	if (!strstr(batten_context_error(context), part))
		fail_msg("'%s' is not in '%s'", part, batten_context_error(context));
	assert_null(strchr(batten_context_error(context), '\n'));
}

static void test_refusals(void **state)
{
	batten_fit_options options = net(9, 5, 4);
	batten_hull *hull = shouldered(*state, "knuckle,waterline,8,0.5\nknuckle,waterline,4,0.5\n"
	                                       "knuckle,waterline,8,0.75\n");
	refuse(*state, hull, &options, "found 1 knuckles on the waterline at z = 0.75 m, expected 2");
	batten_hull_destroy(hull);
	hull = shouldered(*state, "knuckle,waterline,8,0.5\nknuckle,waterline,8,0.75\n"
	                          "knuckle,waterline,4,0.75\n");
	refuse(*state, hull, &options, "found 2 knuckles on the waterline at z = 0.75 m, expected 1");
	batten_hull_destroy(hull);
	hull = shouldered(*state, "knuckle,station,8,0.5\nknuckle,station,8,0.5\n");
	refuse(*state, hull, &options, "two knuckles in one place at x = 8 m, z = 0.5 m");
	batten_hull_destroy(hull);
	hull = shouldered(*state, "knuckle,waterline,8,0.5\n");
	options = net(6, 5, 4);
	refuse(*state, hull, &options, "found 6 poles along the waterlines, expected at least 7");
	batten_hull_destroy(hull);
	hull = shouldered(*state, "knuckle,waterline,2,0.5\n");
	options = net(9, 5, 4);
	refuse(*state, hull, &options, "points of the longest waterline beside a knuckle");
	batten_hull_destroy(hull);
}

/* ------------------------------------------------------------------------------------------------
 * Points that do not determine the net
 * --------------------------------------------------------------------------------------------- */

/* A table with a hole of '?' cells: points enough for every line of the net, none where some of its
 * poles are. */
static void test_free_poles(void **state)
{
	enum { X = 17, Z = 12 };
	double x[X], z[Z], y[X * Z];
	uint8_t nodes[X * Z];
	for (size_t i = 0; i < X; i++)
		x[i] = (double)i;
	for (size_t j = 0; j < Z; j++)
		z[j] = (double)j / (Z - 1);
	for (size_t n = 0; n < X * Z; n++) {
		const size_t i = n % X, j = n / X;
		y[n] = 1.0 + 0.1 * z[j] + 0.01 * x[i];
		nodes[n] = i > 5 && i < 11 && j > 3 && j < 11 ? BATTEN_NODE_UNKNOWN : BATTEN_NODE_GIVEN;
	}
	const batten_hull_table table = { "hole", 16, 1, X, Z, x, z, y, nodes };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(*state, &table, &hull), BATTEN_OK);
	batten_fit_options options = net(13, 12, 4);
	refuse(*state, hull, &options, "hole: the points do not determine pole ");
	options = net(5, 5, 4);
	batten_fit_deviation deviation;
	batten_surface_destroy(fit(*state, hull, &options, &deviation));
	assert_below(deviation.max_pct, 1e-9, "largest of a net that the points determine");
	batten_hull_destroy(hull);
}

static batten_status fit_once(batten_context *context, void *user)
{
	batten_fit_options options = net(6, 9, 4);
	options.correction_limit = 0;
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
	batten_hull *hull = chine_hull(context, rising, true);
	assert_true(failing_heap_each(&heap, context, fit_once, hull) > 20);
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_chines, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_waterline_knuckles, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_free_poles, make_context, end_context),
		cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
