/* Fairing a hull as batten_hull_fair does it by default, on the shipped hulls and on forms whose
 * answer is known. */
#include "support/search_case.h"

#include "fairing/gross_errors.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

typedef struct fixture {
	batten_context *context;
	batten_hull *hull;
	batten_fairing *fairing;
} fixture;

static batten_fair_options options_on_c_path(void)
{
	batten_fair_options options;
	batten_fair_options_default(&options);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	return options;
}

static fixture fair_shipped(const char *name, const batten_fair_options *options)
{
	fixture f = { 0 };
	char path[512];
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	assert_int_equal(batten_context_create(NULL, &f.context), BATTEN_OK);
	assert_int_equal(batten_hull_read(f.context, path, &f.hull), BATTEN_OK);
	if (batten_hull_fair(f.context, f.hull, options, &f.fairing) != BATTEN_OK)
		fail_msg("%s: %s", name, batten_context_error(f.context));
	return f;
}

static void release(fixture *f)
{
	batten_fairing_destroy(f->fairing);
	batten_hull_destroy(f->hull);
	batten_context_destroy(f->context);
}

static batten_measures measure(const fixture *f, const batten_hull *hull)
{
	batten_measures measures;
	assert_int_equal(batten_hull_measure(f->context, hull, NULL, &measures), BATTEN_OK);
	return measures;
}

/* Share of the bending energy that fairing, not smoothing, takes away. */
static double energy_fall(const fixture *f)
{
	const double before = measure(f, batten_fairing_smoothed(f->fairing)).energy_bending;
	const double after = measure(f, batten_fairing_faired(f->fairing)).energy_bending;
	return 1.0 - after / before;
}

static double cn_search(const fixture *f)
{
	batten_closeness closeness;
	assert_int_equal(batten_hull_closeness(f->context, batten_fairing_faired(f->fairing),
	                                       batten_fairing_smoothed(f->fairing), &closeness),
	                 BATTEN_OK);
	return closeness.cn_pct;
}

static double fairness_of_waterline(const fixture *f, const batten_hull *hull, double z)
{
	size_t count = 0;
	assert_int_equal(batten_hull_lines(f->context, hull, NULL, NULL, 0, &count), BATTEN_OK);
	batten_line *lines = calloc(count, sizeof *lines);
	assert_non_null(lines);
	assert_int_equal(batten_hull_lines(f->context, hull, NULL, lines, count, &count), BATTEN_OK);
	double fairness = NAN;
	for (size_t l = 0; l < count; l++)
		if (lines[l].kind == BATTEN_LINE_WATERLINE && fabs(lines[l].coordinate_m - z) < 1e-9)
			fairness = lines[l].fn_per_m2;
	free(lines);
	return fairness;
}

/* NPL carries a misprint, 0.1192 at station 8, z 0.15, where its section asks for about 0.109. */
static void test_npl_by_default(void **state)
{
	(void)state;
	const batten_fair_options options = options_on_c_path();
	fixture f = fair_shipped("npl_parent", &options);
	assert_int_equal(batten_fairing_replacement_count(f.fairing), 1);
	const batten_replacement *misprint = batten_fairing_replacements(f.fairing);
	assert_true(fabs(misprint->x_m - 2.032) < 1e-9 && fabs(misprint->z_m - 0.15) < 1e-9);
	assert_true(misprint->old_m == 0.1192);
	assert_true(misprint->new_m >= 0.108 && misprint->new_m <= 0.110);
	assert_true(energy_fall(&f) >= 0.12);
	assert_true(cn_search(&f) <= 1.0);
	assert_true(fairness_of_waterline(&f, f.hull, 0.15) > 1.09);
	assert_true(fairness_of_waterline(&f, batten_fairing_faired(f.fairing), 0.15) < 0.30);
	release(&f);
}

static void test_npl_with_weights(void **state)
{
	(void)state;
	batten_fair_options options = options_on_c_path();
	options.weights_given = true;
	options.w1 = 1.0;
	options.w2 = 1e4;
	fixture f = fair_shipped("npl_parent", &options);
	assert_true(energy_fall(&f) >= 0.20);
	assert_true(cn_search(&f) <= 1.0);
	release(&f);
}

/* No sound offset of the other hulls is taken for a gross error. */
static void test_sound_hulls_keep_their_offsets(void **state)
{
	(void)state;
	static const char *const names[] = { "bsra_trawler", "highspeed_craft", "wigley",
		                                 "wigley_noisy" };
	const batten_fair_options options = options_on_c_path();
	for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
		fixture f = fair_shipped(names[n], &options);
		assert_int_equal(batten_fairing_replacement_count(f.fairing), 0);
		assert_true(cn_search(&f) <= 1.0);
		release(&f);
	}
}

static void test_exact_wigley_stays(void **state)
{
	(void)state;
	const batten_fair_options options = options_on_c_path();
	fixture f = fair_shipped("wigley", &options);
	assert_true(cn_search(&f) <= 100.0 * 1e-6);
	release(&f);
}

/* Distance from the exact form, root mean square over all offsets. */
static double distance_from_wigley(const batten_hull *hull)
{
	const size_t nx = batten_hull_station_count(hull);
	const size_t nz = batten_hull_waterline_count(hull);
	double sum = 0.0;
	for (size_t n = 0; n < nx * nz; n++) {
		const double u = (batten_hull_x_m(hull)[n % nx] - 8.0) / 8.0;
		const double v = 1.0 - batten_hull_z_m(hull)[n / nx];
		const double off = batten_hull_y_m(hull)[n] - 0.8 * (1.0 - u * u) * (1.0 - v * v);
		sum += off * off;
	}
	return sqrt(sum / (double)(nx * nz));
}

static void test_noisy_wigley_comes_closer(void **state)
{
	(void)state;
	const batten_fair_options options = options_on_c_path();
	fixture f = fair_shipped("wigley_noisy", &options);
	const double before = distance_from_wigley(f.hull);
	const double after = distance_from_wigley(batten_fairing_faired(f.fairing));
	assert_true(before / after >= 1.6);
	release(&f);
}

enum { COSINE_STATIONS = 21, COSINE_WATERLINES = 20, COSINE_NODES = 420 };

/* y = 0.8 cos(pi u / 2) sin(pi v / 2): smooth, and no polynomial. */
static batten_hull *cosine_hull(batten_context *context, double bump)
{
	double x[COSINE_STATIONS], z[COSINE_WATERLINES], y[COSINE_NODES];
	for (int i = 0; i < COSINE_STATIONS; i++)
		x[i] = 0.8 * i;
	for (int k = 0; k < COSINE_WATERLINES; k++)
		z[k] = k / 19.0;
	for (int n = 0; n < COSINE_NODES; n++) {
		const double u = (x[n % COSINE_STATIONS] - 8.0) / 8.0;
		const double v = z[n / COSINE_STATIONS];
		const bool profile = n < COSINE_STATIONS || n % COSINE_STATIONS == 0 ||
		                     n % COSINE_STATIONS == COSINE_STATIONS - 1;
		y[n] = profile ? 0.0 : 0.8 * cos(0.5 * pi * u) * sin(0.5 * pi * v);
	}
	y[10 * COSINE_STATIONS + 8] += bump;
	const batten_hull_table table = { "cosine", 16.0, 1.0, COSINE_STATIONS, COSINE_WATERLINES, x,
		                              z,        y,    NULL };
	batten_hull *hull = NULL;
	assert_int_equal(batten_hull_create(context, &table, &hull), BATTEN_OK);
	return hull;
}

static void test_smooth_hull_stays(void **state)
{
	(void)state;
	fixture f = { 0 };
	assert_int_equal(batten_context_create(NULL, &f.context), BATTEN_OK);
	f.hull = cosine_hull(f.context, 0.0);
	const batten_fair_options options = options_on_c_path();
	assert_int_equal(batten_hull_fair(f.context, f.hull, &options, &f.fairing), BATTEN_OK);
	assert_int_equal(batten_fairing_replacement_count(f.fairing), 0);
	assert_true(cn_search(&f) < 100.0 * 1e-4);
	release(&f);
}

/* One wrong value in a smooth hull is found and put back, whichever way it is wrong. */
static void test_planted_error_is_found(void **state)
{
	(void)state;
	static const double bumps[] = { 0.02, -0.02, 0.2, -0.2 };
	for (size_t b = 0; b < sizeof bumps / sizeof bumps[0]; b++) {
		batten_context *context = NULL;
		assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
		batten_hull *hull = cosine_hull(context, bumps[b]);
		batten_hull *sound = cosine_hull(context, 0.0);
		batten_replacement *list = NULL;
		size_t count = 0;
		assert_int_equal(gross_errors_replace(hull, NULL, &list, &count), BATTEN_OK);
		assert_int_equal(count, 1);
		assert_int_equal(list[0].station, 8);
		assert_int_equal(list[0].waterline, 10);
		assert_true(fabs(list[0].new_m - batten_hull_y_m(sound)[10 * COSINE_STATIONS + 8]) < 1e-4);
		batten_release(context, list);
		batten_hull_destroy(hull);
		batten_hull_destroy(sound);
		batten_context_destroy(context);
	}
}

/* A 0 amid positive offsets is no profile point. */
static void test_lost_offset_is_found(void **state)
{
	(void)state;
	batten_context *context = NULL;
	batten_replacement *list = NULL;
	size_t count = 0;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	batten_hull *sound = cosine_hull(context, 0.0);
	const double value = batten_hull_y_m(sound)[10 * COSINE_STATIONS + 8];
	batten_hull *hull = cosine_hull(context, -value);
	assert_int_equal(gross_errors_replace(hull, NULL, &list, &count), BATTEN_OK);
	assert_int_equal(count, 1);
	assert_true(list[0].old_m == 0.0 && fabs(list[0].new_m - value) < 1e-4);
	batten_release(context, list);
	list = NULL;
	batten_hull_destroy(hull);
	/* A lock is stronger, and its neighbours are not blamed for it. */
	hull = cosine_hull(context, 0.2);
	uint8_t locked[COSINE_NODES] = { 0 };
	locked[10 * COSINE_STATIONS + 8] = 1;
	assert_int_equal(gross_errors_replace(hull, locked, &list, &count), BATTEN_OK);
	assert_int_equal(count, 0);
	batten_release(context, list);
	batten_hull_destroy(hull);
	batten_hull_destroy(sound);
	batten_context_destroy(context);
}

/* A hard chine is no gross error: its sections turn sharply, all at the same height. */
static void test_chine_is_kept(void **state)
{
	(void)state;
	double x[COSINE_STATIONS], z[COSINE_WATERLINES], y[COSINE_NODES];
	for (int i = 0; i < COSINE_STATIONS; i++)
		x[i] = i;
	for (int k = 0; k < COSINE_WATERLINES; k++)
		z[k] = 0.1 * k;
	for (int n = 0; n < COSINE_NODES; n++) {
		const int k = n / COSINE_STATIONS;
		const double u = (n % COSINE_STATIONS - 10.0) / 11.0;
		y[n] = (1.0 - u * u) * (k < 9 ? 0.4 * k + 0.1 : 3.7 + 0.03 * (k - 9));
	}
	const batten_hull_table table = { "chine", 20.0, 1.5, COSINE_STATIONS, COSINE_WATERLINES, x,
		                              z,       y,    NULL };
	batten_context *context = NULL;
	batten_hull *hull = NULL;
	batten_replacement *list = NULL;
	size_t count = 0;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	assert_int_equal(batten_hull_create(context, &table, &hull), BATTEN_OK);
	assert_int_equal(gross_errors_replace(hull, NULL, &list, &count), BATTEN_OK);
	assert_int_equal(count, 0);
	batten_release(context, list);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

static void test_locks_and_bounds_hold(void **state)
{
	(void)state;
	fixture f = { 0 };
	char path[512];
	(void)snprintf(path, sizeof path, "%s/hulls/wigley_noisy.csv", BATTEN_DATA_DIR);
	assert_int_equal(batten_context_create(NULL, &f.context), BATTEN_OK);
	assert_int_equal(batten_hull_read(f.context, path, &f.hull), BATTEN_OK);
	const double *x = batten_hull_x_m(f.hull);
	const double *z = batten_hull_z_m(f.hull);
	const batten_lock locks[] = { { BATTEN_LOCK_STATION, x[5], 0.0 },
		                          { BATTEN_LOCK_WATERLINE, 0.0, z[7] },
		                          { BATTEN_LOCK_POINT, x[12], z[12] } };
	batten_fair_options options = options_on_c_path();
	options.weights_given = true;
	options.w1 = 1.0;
	options.w2 = 1e3;
	options.max_distance_m = 0.05;
	options.locks = locks;
	options.lock_count = 3;
	/* The hull itself as lower bound: nothing may move inward. */
	options.lower = f.hull;
	assert_int_equal(batten_hull_fair(f.context, f.hull, &options, &f.fairing), BATTEN_OK);
	const double *before = batten_hull_y_m(f.hull);
	const double *after = batten_hull_y_m(batten_fairing_faired(f.fairing));
	size_t moved = 0;
	for (size_t n = 0; n < 420; n++) {
		const bool locked = n % 21 == 5 || n / 21 == 7 || n == 12 * 21 + 12;
		assert_true(after[n] >= before[n] && after[n] <= before[n] + 0.05);
		assert_true(!locked || after[n] == before[n]);
		assert_true(before[n] > 0.0 || after[n] == 0.0);
		moved += after[n] != before[n];
	}
	assert_true(moved > 100);
	release(&f);
}

static batten_status try_fair(batten_context *context, const batten_hull *hull,
                              const batten_fair_options *options)
{
	batten_fairing *fairing = NULL;
	const batten_status status = batten_hull_fair(context, hull, options, &fairing);
	assert_true((fairing != NULL) == (status == BATTEN_OK));
	batten_fairing_destroy(fairing);
	return status;
}

static void test_impossible_requests(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	batten_hull *hull = cosine_hull(context, 0.0);
	const batten_lock nowhere = { BATTEN_LOCK_STATION, 0.41, 0.0 };
	batten_fair_options options = options_on_c_path();
	options.locks = &nowhere;
	options.lock_count = 1;
	assert_int_equal(try_fair(context, hull, &options), BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(context), "0.41"));
	options = options_on_c_path();
	options.weights_given = true;
	assert_int_equal(try_fair(context, hull, &options), BATTEN_USAGE);
	/* Upper offsets below the hull by more than the distance allowed. */
	batten_hull *upper = NULL;
	assert_int_equal(batten_hull_clone(context, hull, &upper), BATTEN_OK);
	double y[COSINE_NODES];
	for (int n = 0; n < COSINE_NODES; n++)
		y[n] = 0.5 * batten_hull_y_m(hull)[n];
	assert_int_equal(batten_hull_set_y(context, upper, y), BATTEN_OK);
	options = options_on_c_path();
	options.upper = upper;
	assert_int_equal(try_fair(context, hull, &options), BATTEN_INPUT);
	assert_non_null(strstr(batten_context_error(context), "upper offsets"));
	batten_hull_destroy(upper);
	batten_hull_destroy(hull);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_npl_by_default),
		cmocka_unit_test(test_npl_with_weights),
		cmocka_unit_test(test_sound_hulls_keep_their_offsets),
		cmocka_unit_test(test_exact_wigley_stays),
		cmocka_unit_test(test_noisy_wigley_comes_closer),
		cmocka_unit_test(test_smooth_hull_stays),
		cmocka_unit_test(test_planted_error_is_found),
		cmocka_unit_test(test_lost_offset_is_found),
		cmocka_unit_test(test_chine_is_kept),
		cmocka_unit_test(test_locks_and_bounds_hold),
		cmocka_unit_test(test_impossible_requests),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
