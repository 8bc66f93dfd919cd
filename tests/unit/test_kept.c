/* Measures that fairing keeps: alone and together, at the end of their tolerance and within it, at the
 * least objective there is; what cannot be kept is named. */
#include "support/search_case.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct fixture {
	batten_context *context;
	batten_hull *hull;
} fixture;

static size_t quantity(const char *name)
{
	for (size_t i = 0; i < BATTEN_HYDROSTATICS_COUNT; i++)
		if (strcmp(batten_hydrostatics_name(i), name) == 0)
			return i;
	fail_msg("no measure %s", name);
	return 0;
}

static fixture open_hull(const char *name)
{
	fixture f = { 0 };
	char path[512];
	(void)snprintf(path, sizeof path, "%s/hulls/%s.csv", BATTEN_DATA_DIR, name);
	assert_int_equal(batten_context_create(NULL, &f.context), BATTEN_OK);
	assert_int_equal(batten_hull_read(f.context, path, &f.hull), BATTEN_OK);
	return f;
}

static void close_hull(fixture *f)
{
	batten_hull_destroy(f->hull);
	batten_context_destroy(f->context);
}

/* Fairness counts for much: the hull flattens, and its measures change, where nothing keeps them. */
static batten_fair_options options_for(const batten_keep *keep, size_t count)
{
	batten_fair_options options;
	batten_fair_options_default(&options);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.weights_given = true;
	options.w1 = 1.0;
	options.w2 = 400.0;
	options.max_distance_part = 0.02;
	options.keep = keep;
	options.keep_count = count;
	return options;
}

static batten_fairing *fair(const fixture *f, const batten_fair_options *options)
{
	batten_fairing *fairing = NULL;
	if (batten_hull_fair(f->context, f->hull, options, &fairing) != BATTEN_OK)
		fail_msg("%s", batten_context_error(f->context));
	return fairing;
}

static double measured(const fixture *f, const batten_hull *hull, size_t which)
{
	batten_hydrostatics found;
	const double draft = batten_hull_draft_m(hull);
	double values[BATTEN_HYDROSTATICS_COUNT];
	assert_int_equal(batten_hull_hydrostatics(f->context, hull, NULL, 1, &draft, &found),
	                 BATTEN_OK);
	memcpy(values, &found, sizeof values);
	return values[which];
}

static double objective_of(const batten_fairing *fairing)
{
	return batten_fairing_result(fairing)->objective_end;
}

/* All that is asked for is within its tolerance; an end has a price, what lies within has none. */
static void check(const fixture *f, const batten_fairing *fairing, const batten_keep *keep,
                  size_t count)
{
	size_t kept_count = 0;
	unsigned rounds = 0;
	const batten_kept *kept = batten_fairing_kept(fairing, &kept_count, &rounds);
	assert_int_equal(kept_count, count);
	for (size_t i = 0; i < count; i++) {
		const double before = measured(f, batten_fairing_smoothed(fairing), keep[i].quantity);
		const double after = measured(f, batten_fairing_faired(fairing), keep[i].quantity);
		const double tolerance = keep[i].is_part ? keep[i].tolerance * fabs(before)
		                                         : keep[i].tolerance;
		assert_int_equal(kept[i].quantity, keep[i].quantity);
		assert_true(fabs(after - before) <= tolerance * (1.0 + 1e-9));
		assert_true(fabs(kept[i].value - after) <= 1e-9 * tolerance + 1e-12 * fabs(after));
		if (kept[i].multiplier != 0.0)
			assert_true(fabs(after - before) >= 0.89 * tolerance &&
			            kept[i].multiplier * (after - before) > 0.0);
	}
	const batten_certificate *certificate = batten_fairing_certificate(fairing);
	assert_non_null(certificate);
	assert_true(certificate->gap_estimate <= 1e-6);
	assert_true(fabs(certificate->objective - objective_of(fairing)) <=
	            1e-12 * objective_of(fairing));
}

enum { KEPT = 4 };
static void choose_keeps(batten_keep keep[KEPT])
{
	keep[0] = (batten_keep){ quantity("volume_m3"), 1e-4, true };
	keep[1] = (batten_keep){ quantity("waterplane_area_m2"), 1e-4, true };
	keep[2] = (batten_keep){ quantity("lcb_pct_lbp_fwd"), 1e-4, false };
	keep[3] = (batten_keep){ quantity("cp"), 1e-5, false };
}

static void test_alone_and_together(void **state)
{
	(void)state;
	static const char *const hulls[] = { "wigley_noisy", "bsra_trawler" };
	batten_keep keep[KEPT];
	choose_keeps(keep);
	for (size_t h = 0; h < sizeof hulls / sizeof hulls[0]; h++) {
		fixture f = open_hull(hulls[h]);
		batten_fair_options options = options_for(NULL, 0);
		batten_fairing *plain = fair(&f, &options);
		unsigned ends = 0;
		double dearest = objective_of(plain);
		for (size_t i = 0; i <= KEPT; i++) {
			const size_t count = i < KEPT ? 1 : KEPT;
			options = options_for(i < KEPT ? &keep[i] : keep, count);
			batten_fairing *fairing = fair(&f, &options);
			check(&f, fairing, options.keep, count);
			size_t ignored = 0;
			const batten_kept *kept = batten_fairing_kept(fairing, &ignored, NULL);
			for (size_t k = 0; k < count; k++)
				ends += kept[k].multiplier != 0.0;
			/* Together they cost at least what the dearest costs alone. */
			assert_true(objective_of(fairing) >=
			            (i < KEPT ? objective_of(plain) : dearest) * (1.0 - 1e-6));
			dearest = fmax(dearest, objective_of(fairing));
			batten_fairing_destroy(fairing);
		}
		assert_true(ends >= 5);
		batten_fairing_destroy(plain);
		close_hull(&f);
	}
}

/* Where f32 only screens the measures are kept as exactly, at the same objective; and where an interior penalty
 * keeps the bounds. */
static void test_f32_and_interior_penalty(void **state)
{
	(void)state;
	static const char *const hulls[] = { "wigley_noisy", "npl_parent" };
	batten_keep keep[KEPT];
	choose_keeps(keep);
	for (size_t h = 0; h < sizeof hulls / sizeof hulls[0]; h++) {
		fixture f = open_hull(hulls[h]);
		for (size_t i = 0; i <= KEPT; i++) {
			const size_t count = i < KEPT ? 1 : 2;
			batten_fair_options options = options_for(&keep[i < KEPT ? i : 1], count);
			batten_fairing *exact = fair(&f, &options);
			options.search.precision = BATTEN_F32;
			batten_fairing *screened = fair(&f, &options);
			check(&f, screened, options.keep, count);
			assert_true(fabs(objective_of(screened) - objective_of(exact)) <=
			            1e-5 * objective_of(exact));
			batten_fairing_destroy(screened);
			batten_fairing_destroy(exact);
		}
		batten_fair_options options = options_for(keep, 1);
		options.search.interior_penalty = true;
		batten_fairing *inside = fair(&f, &options);
		check(&f, inside, keep, 1);
		assert_int_equal(batten_fairing_describe(inside).at_limit_count, 0);
		batten_fairing_destroy(inside);
		close_hull(&f);
	}
}

/* All bending and a narrow box: single measures whose bounds let them be met are met, though most of the hull
 * is held and steps of the multipliers end where all of it is. */
static void test_mostly_held(void **state)
{
	(void)state;
	batten_keep keep[KEPT];
	choose_keeps(keep);
	fixture f = open_hull("wigley_noisy");
	for (size_t i = 0; i < KEPT; i++) {
		batten_fair_options options = options_for(&keep[i], 1);
		options.w2 = 40.0;
		batten_fairing *fairing = fair(&f, &options);
		check(&f, fairing, &keep[i], 1);
		batten_fairing_destroy(fairing);
	}
	close_hull(&f);
}

static void test_within_the_tolerance_nothing_changes(void **state)
{
	(void)state;
	fixture f = open_hull("wigley_noisy");
	const batten_keep keep[] = { { quantity("volume_m3"), 0.5, true },
		                         { quantity("lcb_pct_lbp_fwd"), 5.0, false } };
	batten_fair_options options = options_for(NULL, 0);
	batten_fairing *plain = fair(&f, &options);
	options = options_for(keep, 2);
	batten_fairing *fairing = fair(&f, &options);
	check(&f, fairing, keep, 2);
	const size_t nodes = batten_hull_station_count(f.hull) * batten_hull_waterline_count(f.hull);
	assert_memory_equal(batten_hull_y_m(batten_fairing_faired(plain)),
	                    batten_hull_y_m(batten_fairing_faired(fairing)), nodes * sizeof(double));
	batten_fairing_destroy(plain);
	batten_fairing_destroy(fairing);
	close_hull(&f);
}

/* The multiplier is what the objective gains by a wider tolerance: so it can be only at the least
 * objective of all hulls within it. */
static void test_multiplier_is_the_price(void **state)
{
	(void)state;
	fixture f = open_hull("wigley_noisy");
	double objective[3] = { 0.0 }, value[3] = { 0.0 }, multiplier[3] = { 0.0 };
	for (int i = 0; i < 3; i++) {
		const batten_keep keep = { quantity("volume_m3"), 1e-4 * (1.0 + i), true };
		batten_fair_options options = options_for(&keep, 1);
		batten_fairing *fairing = fair(&f, &options);
		size_t count = 0;
		objective[i] = objective_of(fairing);
		value[i] = batten_fairing_kept(fairing, &count, NULL)->value;
		multiplier[i] = batten_fairing_kept(fairing, &count, NULL)->multiplier;
		assert_true(multiplier[i] != 0.0);
		batten_fairing_destroy(fairing);
	}
	const double price = -(objective[2] - objective[0]) / (value[2] - value[0]);
	print_message("price %g, multipliers %g, %g, %g\n", price, multiplier[0], multiplier[1],
	              multiplier[2]);
	assert_true(fabs(price - multiplier[1]) <= 0.02 * fabs(price));
	close_hull(&f);
}

static void expect_fault(const fixture *f, const batten_fair_options *options, batten_status status,
                         const char *first, const char *second)
{
	batten_fairing *fairing = NULL;
	assert_int_equal(batten_hull_fair(f->context, f->hull, options, &fairing), status);
	assert_null(fairing);
	const char *error = batten_context_error(f->context);
	if (!strstr(error, first) || !strstr(error, second))
		fail_msg("found: %s", error);
}

/* A hull a little fuller before x_m. */
static batten_hull *fuller(const fixture *f, double part, double x_m)
{
	const size_t nx = batten_hull_station_count(f->hull);
	const size_t nodes = nx * batten_hull_waterline_count(f->hull);
	double *y = calloc(nodes, sizeof *y);
	batten_hull *hull = NULL;
	assert_non_null(y);
	for (size_t n = 0; n < nodes; n++)
		y[n] = batten_hull_y_m(f->hull)[n] *
		       (batten_hull_x_m(f->hull)[n % nx] > x_m ? 1.0 + part : 0.0);
	assert_int_equal(batten_hull_clone(f->context, f->hull, &hull), BATTEN_OK);
	assert_int_equal(batten_hull_set_y(f->context, hull, y), BATTEN_OK);
	free(y);
	return hull;
}

static void test_what_cannot_be_kept_is_named(void **state)
{
	(void)state;
	fixture f = open_hull("wigley_noisy");
	batten_keep keep[KEPT];
	choose_keeps(keep);
	batten_fair_options options = options_for(keep, 1);
	batten_hull *lower = fuller(&f, 0.005, -1.0);
	options.smooth = false;
	options.lower = lower;
	expect_fault(&f, &options, BATTEN_INPUT, "volume_m3", "the bounds of the offsets allow");
	batten_hull_destroy(lower);
	/* Much fuller forward: the volume wants less aft, the centre of buoyancy more. */
	lower = fuller(&f, 0.012, 8.0);
	const batten_keep both[] = { keep[0], keep[2] };
	options.keep = both;
	options.keep_count = 2;
	options.lower = lower;
	expect_fault(&f, &options, BATTEN_INPUT, "volume_m3, lcb_pct_lbp_fwd", "together");
	batten_hull_destroy(lower);
	options = options_for(keep, 1);
	options.w2 = 0.0;
	expect_fault(&f, &options, BATTEN_USAGE, "w2 above 0", "");
	keep[0].tolerance = 0.0;
	options = options_for(keep, 1);
	expect_fault(&f, &options, BATTEN_USAGE, "volume_m3", "tolerance above 0");
	close_hull(&f);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_alone_and_together),
		cmocka_unit_test(test_f32_and_interior_penalty),
		cmocka_unit_test(test_mostly_held),
		cmocka_unit_test(test_within_the_tolerance_nothing_changes),
		cmocka_unit_test(test_multiplier_is_the_price),
		cmocka_unit_test(test_what_cannot_be_kept_is_named),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
