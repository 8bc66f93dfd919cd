/* Surfaces fitted to hulls: what is met exactly, the shipped hulls, the same table at another
 * scale. */
#include "unit/fit_fixture.h"

/* The Wigley hull is biquadratic: its Bezier net is known (Letcher 4.1, 4.9). */
static void test_wigley(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley");
	const batten_fit_options options = net(3, 3, 3);
	batten_fit_deviation deviation;
	batten_surface *surface = fit(*state, hull, &options, &deviation);
	const batten_surface_net found = batten_surface_describe(surface);
	const double along[3] = { 0, 2, 0 };
	const double up[3] = { 0, 1, 1 };
	for (size_t j = 0; j < 3; j++)
		for (size_t i = 0; i < 3; i++) {
			assert_near(pole(&found, i, j)[0], 8.0 * (double)i, 1e-12, "x of a pole");
			assert_near(pole(&found, i, j)[1], 0.8 * along[i] * up[j], 1e-13, "y of a pole");
			assert_near(pole(&found, i, j)[2], 0.5 * (double)j, 1e-13, "z of a pole");
		}
	assert_string_equal(found.name, batten_hull_name(hull));
	assert_int_equal(deviation.point_count, 13 * 20);
	assert_below(deviation.max_m, 1e-13, "largest deviation");
	assert_below(deviation.rms_m, deviation.max_m, "rms");
	batten_surface_destroy(surface);
	batten_hull_destroy(hull);
}

/* A finer net of a higher order holds the same hull. */
static void test_wigley_finer(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley");
	for (size_t order = 3; order <= 6; order++) {
		const batten_fit_options options = net(9, 8, order);
		batten_fit_deviation deviation;
		batten_surface *surface = fit(*state, hull, &options, &deviation);
		assert_below(deviation.max_m, 1e-11, "largest deviation");
		for (int k = 0; k < 100; k++) {
			batten_surface_point at;
			const double u = 0.01 * (k + 0.5);
			const double v = fmod(0.61803398875 * k, 1.0);
			assert_int_equal(batten_surface_evaluate(surface, u, v, &at), BATTEN_OK);
			const double *p = at.derivative[0][0];
			const double part = p[0] / 16.0;
			assert_near(p[1], 0.8 * 4.0 * part * (1.0 - part) * (1.0 - (1.0 - p[2]) * (1.0 - p[2])),
			            1e-11, "y between the offsets");
		}
		batten_surface_destroy(surface);
	}
	batten_hull_destroy(hull);
}

static void test_interpolation(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	for (size_t order = 3; order <= 5; order++) {
		batten_fit_options options = net(21, 20, order);
		batten_fit_deviation deviation;
		batten_surface *surface = fit(*state, hull, &options, &deviation);
		assert_int_equal(deviation.point_count, 420);
		assert_below(deviation.max_m, 1e-11, "largest deviation of as many poles as points");
		batten_surface_destroy(surface);
		/* One pole less can not do it. */
		options.count_u--;
		surface = fit(*state, hull, &options, &deviation);
		assert_true(deviation.max_m > 1e-4);
		batten_surface_destroy(surface);
	}
	batten_hull_destroy(hull);
}

/* Distance of a place from the nearest of many points of a surface, closer and closer around the
 * best. */
static double sampled_distance(const batten_surface *surface, const double place[3])
{
	enum { SAMPLES = 150, ROUNDS = 3 };
	double least = HUGE_VAL;
	double u = 0.5;
	double v = 0.5;
	double reach = 0.5;
	for (int round = 0; round < ROUNDS; round++, reach *= 4.0 / SAMPLES) {
		const double centre_u = u;
		const double centre_v = v;
		for (int i = -SAMPLES; i <= SAMPLES; i++)
			for (int j = -SAMPLES; j <= SAMPLES; j++) {
				const double at_u = fmin(1.0, fmax(0.0, centre_u + reach * i / SAMPLES));
				const double at_v = fmin(1.0, fmax(0.0, centre_v + reach * j / SAMPLES));
				batten_surface_point at;
				assert_int_equal(batten_surface_evaluate(surface, at_u, at_v, &at), BATTEN_OK);
				const double *p = at.derivative[0][0];
				const double away = hypot(hypot(p[0] - place[0], p[1] - place[1]), p[2] - place[2]);
				if (away < least) {
					least = away;
					u = at_u;
					v = at_v;
				}
			}
	}
	return least;
}

/* The worst point lies as far off as is said, by a search of its own. */
static void check_worst(const batten_surface *surface, const batten_fit_deviation *deviation)
{
	const double place[3] = { deviation->x_m, deviation->y_m, deviation->z_m };
	assert_near(sampled_distance(surface, place), deviation->max_m, 0.01 * deviation->max_m,
	            "distance of the worst point, sampled");
}

static void check_hull(batten_context *context, const batten_hull *hull, size_t count_u,
                       size_t count_v, size_t points, double rms_pct, double max_pct)
{
	const batten_fit_options options = net(count_u, count_v, 4);
	const double half_beam = batten_hull_half_beam_m(hull);
	batten_fit_deviation deviation;
	batten_surface *surface = fit(context, hull, &options, &deviation);
	assert_int_equal(deviation.point_count, points);
	assert_below(deviation.rms_pct, rms_pct, "rms in percent of the half-beam");
	assert_below(deviation.max_pct, max_pct, "largest in percent of the half-beam");
	assert_near(deviation.rms_m, 0.01 * deviation.rms_pct * half_beam, 1e-15, "rms");
	assert_near(deviation.max_m, 0.01 * deviation.max_pct * half_beam, 1e-15, "largest");
	check_worst(surface, &deviation);
	batten_surface_destroy(surface);
}

static void test_npl(void **state)
{
	batten_hull *hull = read_hull(*state, "npl_parent");
	batten_fair_options options;
	batten_fairing *fairing = NULL;
	batten_fair_options_default(&options);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.max_distance_m = 0.0; /* gross errors only */
	const batten_status status = batten_hull_fair(*state, hull, &options, &fairing);
	assert_true(status == BATTEN_OK || status == BATTEN_INCOMPLETE);
	const batten_hull *smoothed = batten_fairing_smoothed(fairing);
	check_hull(*state, smoothed, 13, 13, 275, 0.2, 1.2);
	check_hull(*state, smoothed, 10, 10, 275, 0.2, 1.2);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* Nets of at most 70 % of the points; the bounds are the first measurement (0.106, 0.61 and 0.153,
 * 1.75), rounded up. */
static void test_trawler(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	assert_true(11 * 8 <= 0.7 * 128);
	check_hull(*state, hull, 11, 8, 128, 0.11, 0.65);
	batten_hull_destroy(hull);
}

static void test_highspeed_craft(void **state)
{
	batten_hull *hull = read_hull(*state, "highspeed_craft");
	assert_true(12 * 14 <= 0.7 * 243);
	check_hull(*state, hull, 12, 14, 243, 0.16, 1.8);
	batten_hull_destroy(hull);
}

/* A table that is 2^10 times as large has a surface that is, to the last bit; and twice the same
 * call gives the same bits. */
static void test_scale(void **state)
{
	batten_hull *hull = read_hull(*state, "npl_parent");
	const size_t stations = batten_hull_station_count(hull);
	const size_t waterlines = batten_hull_waterline_count(hull);
	double *numbers = calloc(stations + waterlines + stations * waterlines, sizeof *numbers);
	assert_non_null(numbers);
	double *z = numbers + stations;
	double *y = z + waterlines;
	for (size_t s = 0; s < stations; s++)
		numbers[s] = 1024.0 * batten_hull_x_m(hull)[s];
	for (size_t w = 0; w < waterlines; w++)
		z[w] = 1024.0 * batten_hull_z_m(hull)[w];
	for (size_t n = 0; n < stations * waterlines; n++)
		y[n] = 1024.0 * batten_hull_y_m(hull)[n];
	const batten_hull_table table = { .name = "large",
		                              .lbp_m = 1024.0 * batten_hull_lbp_m(hull),
		                              .draft_m = 1024.0 * batten_hull_draft_m(hull),
		                              .station_count = stations,
		                              .waterline_count = waterlines,
		                              .x_m = numbers,
		                              .z_m = z,
		                              .y_m = y,
		                              .nodes = batten_hull_nodes(hull) };
	batten_hull *large = NULL;
	assert_int_equal(batten_hull_create(*state, &table, &large), BATTEN_OK);
	const batten_fit_options options = net(11, 9, 4);
	batten_fit_deviation deviation, large_deviation;
	batten_surface *surface = fit(*state, hull, &options, &deviation);
	batten_surface *again = fit(*state, hull, &options, NULL);
	batten_surface *other = fit(*state, large, &options, &large_deviation);
	const batten_surface_net a = batten_surface_describe(surface);
	const batten_surface_net b = batten_surface_describe(again);
	const batten_surface_net c = batten_surface_describe(other);
	for (size_t i = 0; i < 3 * 11 * 9; i++) {
		assert_true(a.poles_m[i] == b.poles_m[i]);
		assert_true(1024.0 * a.poles_m[i] == c.poles_m[i]);
	}
	assert_true(1024.0 * deviation.max_m == large_deviation.max_m);
	batten_surface_destroy(surface);
	batten_surface_destroy(again);
	batten_surface_destroy(other);
	batten_hull_destroy(large);
	batten_hull_destroy(hull);
	free(numbers);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_wigley, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_wigley_finer, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_interpolation, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_npl, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_trawler, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_highspeed_craft, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_scale, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
