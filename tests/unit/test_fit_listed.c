/* Surfaces fitted to tables that list their points line by line: heights of the stations, or places
 * along the waterlines, that hardly any two lines share. A Wigley hull on an inclined keel is such a
 * surface exactly, whatever the places. */
#include "unit/fit_fixture.h"

enum { LINES = 13, POINTS = 9, TEXT_MOST = 1 << 16 };
static const double length = 100.0, depth = 6.25, half_beam = 5.0;

typedef struct text {
	char at[TEXT_MOST];
	size_t length;
} text;

static void put_header(text *to, const char *heading)
{
	to->length = (size_t)snprintf(to->at, sizeof to->at,
	                              "# batten-offsets: 1\n# name: listed\n# unit: m\n"
	                              "# frame: ap-fwd\n# lbp: 100\n# draft: 6.25\n"
	                              "# layout: long\n%s\n",
	                              heading);
}

static double half_breadth(double x, double height)
{
	const double along = x / length, up = 1.0 - height / depth;
	return half_beam * 4.0 * along * (1.0 - along) * (1.0 - up * up);
}

/* Part k of `parts`; those inside are moved by up to 0.3 of the way to the next. */
static double moved_part(size_t line, size_t k, size_t parts)
{
	const double by = k == 0 || k == parts ? 0.0 : 0.15 * ((double)((7 * line + 3 * k) % 5) - 2.0);
	return ((double)k + by) / (double)parts;
}

static void put_point(text *to, size_t line, double first, double second, double y)
{
	to->length += (size_t)snprintf(to->at + to->length, sizeof to->at - to->length,
	                               "%zu,%.17g,%.17g,%.17g\n", line, first, second, y);
	assert_true(to->length < sizeof to->at);
}

/* Stations; those the keel lets reach them have a point at z 3 and 4 as well. */
static void put_stations(text *to, double slope, bool shared)
{
	static const double common[] = { 3.0, 4.0 };
	put_header(to, "station,x,z,y");
	for (size_t s = 0; s < LINES; s++) {
		const double x = length * (double)s / (LINES - 1), keel = slope * x;
		double before = -HUGE_VAL;
		for (size_t k = 0; k < POINTS; k++) {
			const double height = depth * moved_part(s, k, POINTS - 1), z = keel + height;
			for (size_t c = 0; shared && c < 2; c++)
				if (before >= keel && before < common[c] && common[c] < z)
					put_point(to, s, x, common[c], half_breadth(x, common[c] - keel));
			put_point(to, s, x, z, half_breadth(x, height));
			before = z;
		}
	}
}

static void put_waterlines(text *to)
{
	put_header(to, "waterline,z,x,y");
	for (size_t w = 0; w < POINTS; w++) {
		const double z = depth * (double)w / (POINTS - 1);
		for (size_t k = 0; k < LINES; k++) {
			const double x = length * moved_part(w, k, LINES - 1);
			put_point(to, w, z, x, half_breadth(x, z));
		}
	}
}

static void fits_exactly(batten_context *context, const text *given)
{
	batten_hull *hull = NULL;
	if (batten_hull_parse(context, "listed", given->at, given->length, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	for (size_t order = 3; order <= 4; order++) {
		const batten_fit_options options = net(order + 2, order + 1, order);
		batten_fit_deviation deviation;
		batten_surface *surface = fit(context, hull, &options, &deviation);
		assert_int_equal(deviation.point_count, LINES * POINTS);
		assert_below(deviation.max_m, 1e-12, "largest deviation");
		batten_surface_destroy(surface);
	}
	batten_hull_destroy(hull);
}

/* Every height is shared, but by few stations. */
static void stations_that_share_some_heights(void **state)
{
	text given;
	put_stations(&given, 0.0, false);
	fits_exactly(*state, &given);
}

/* Feet and tops are at heights of their own. */
static void stations_on_an_inclined_keel(void **state)
{
	static const double slopes[] = { 0.01, 0.03, -0.02 };
	for (size_t i = 0; i < sizeof slopes / sizeof slopes[0]; i++) {
		text given;
		batten_hull *hull = NULL;
		batten_fit_deviation deviation;
		put_stations(&given, slopes[i], true);
		if (batten_hull_parse(*state, "inclined", given.at, given.length, &hull) != BATTEN_OK)
			fail_msg("%s", batten_context_error(*state));
		const batten_fit_options options = net(6, 5, 4);
		batten_surface *surface = fit(*state, hull, &options, &deviation);
		assert_true(deviation.point_count > LINES * POINTS);
		assert_below(deviation.max_m, 1e-12, "largest deviation");
		batten_surface_destroy(surface);
		batten_hull_destroy(hull);
	}
}

static void waterlines_that_share_some_places(void **state)
{
	text given;
	put_waterlines(&given);
	fits_exactly(*state, &given);
}

/* The last station is left out: profile points off every waterline tell where the stem is. */
static void a_stem_beyond_the_last_station(void **state)
{
	text given;
	batten_hull *hull = NULL;
	batten_fit_deviation deviation;
	put_stations(&given, 0.0, false);
	char *last = strstr(given.at, "\n12,");
	assert_non_null(last);
	given.length = (size_t)(last + 1 - given.at);
	for (size_t k = 0; k < 5; k++)
		given.length += (size_t)snprintf(given.at + given.length, sizeof given.at - given.length,
		                                 "profile,stem,%g,0,%g\n", 98.0 + 0.5 * (double)k,
		                                 1.5625 * (double)k);
	if (batten_hull_parse(*state, "raked", given.at, given.length, &hull) != BATTEN_OK)
		fail_msg("%s", batten_context_error(*state));
	const batten_fit_options options = net(7, 6, 4);
	batten_surface *surface = fit(*state, hull, &options, &deviation);
	for (size_t k = 0; k < 5; k++) {
		batten_surface_point at;
		assert_int_equal(batten_surface_evaluate(surface, 1.0, 0.25 * (double)k, &at), BATTEN_OK);
		assert_near(at.derivative[0][0][0], 98.0 + 0.32 * at.derivative[0][0][2], 0.05, "stem");
	}
	assert_below(deviation.rms_pct, 1.0, "rms");
	batten_surface_destroy(surface);
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(stations_that_share_some_heights, make_context,
		                                end_context),
		cmocka_unit_test_setup_teardown(stations_on_an_inclined_keel, make_context, end_context),
		cmocka_unit_test_setup_teardown(waterlines_that_share_some_places, make_context,
		                                end_context),
		cmocka_unit_test_setup_teardown(a_stem_beyond_the_last_station, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
