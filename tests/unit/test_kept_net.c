/* Measures that fairing by a control net keeps: of the surface, alone and together, at the end of their
 * tolerance and within it, at the least objective there is. */
#include "support/cases.h"
#include "unit/fit_fixture.h"

#include "fairing/net_problem.h"
#include "geometry/surface.h"
#include "oracle/oracle_bspline.h"
#include "support/failing_heap.h"

enum { KEPT = 4 };

static size_t quantity(const char *name)
{
	for (size_t i = 0; i < BATTEN_HYDROSTATICS_COUNT; i++)
		if (strcmp(batten_hydrostatics_name(i), name) == 0)
			return i;
	fail_msg("no measure %s", name);
	return 0;
}

static void choose_keeps(batten_keep keep[KEPT])
{
	keep[0] = (batten_keep){ quantity("volume_m3"), 1e-4, true };
	keep[1] = (batten_keep){ quantity("waterplane_area_m2"), 1e-4, true };
	keep[2] = (batten_keep){ quantity("lcb_pct_lbp_fwd"), 1e-4, false };
	keep[3] = (batten_keep){ quantity("cp"), 1e-5, false };
}

/* Fairness counts for much: the surface flattens, and its measures change, where nothing keeps them. */
static batten_fair_options options_for(const batten_keep *keep, size_t count)
{
	batten_fair_options options;
	batten_fair_options_default(&options);
	options.variables = BATTEN_VARIABLES_NET;
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.fit.count_u = 8;
	options.fit.count_v = 7;
	options.weights_given = true;
	options.w1 = 1.0;
	options.w2 = 400.0;
	options.max_distance_part = 0.02;
	options.keep = keep;
	options.keep_count = count;
	return options;
}

static batten_fairing *fair(batten_context *context, const batten_hull *hull,
                            const batten_fair_options *options)
{
	batten_fairing *fairing = NULL;
	if (batten_hull_fair(context, hull, options, &fairing) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return fairing;
}

static double measured(batten_context *context, const batten_hull *hull,
                       const batten_surface *surface, size_t which)
{
	batten_hydrostatics found;
	batten_hydrostatics_options options;
	const double draft = batten_hull_draft_m(hull);
	double values[BATTEN_HYDROSTATICS_COUNT];
	batten_hydrostatics_options_default(&options);
	options.lbp_m = batten_hull_lbp_m(hull);
	assert_int_equal(batten_surface_hydrostatics(context, surface, &options, 1, &draft, &found),
	                 BATTEN_OK);
	memcpy(values, &found, sizeof values);
	return values[which];
}

static double objective_of(const batten_fairing *fairing)
{
	return batten_fairing_result(fairing)->objective_end;
}

/* All that is asked for is within its tolerance; an end has a price, what lies within has none. Returns how
 * many have. */
static unsigned check(batten_context *context, const batten_fairing *fairing,
                      const batten_keep *keep, size_t count, batten_precision precision)
{
	const batten_hull *hull = batten_fairing_smoothed(fairing);
	size_t kept_count = 0;
	unsigned ends = 0;
	const batten_kept *kept = batten_fairing_kept(fairing, &kept_count, NULL);
	assert_int_equal(kept_count, count);
	for (size_t i = 0; i < count; i++) {
		const double before = measured(context, hull, batten_fairing_fitted_surface(fairing),
		                               keep[i].quantity);
		const double after = measured(context, hull, batten_fairing_faired_surface(fairing),
		                              keep[i].quantity);
		const double tolerance = keep[i].is_part ? keep[i].tolerance * fabs(before)
		                                         : keep[i].tolerance;
		assert_int_equal(kept[i].quantity, keep[i].quantity);
		assert_near(kept[i].wanted, before, 1e-9 * fabs(before) + 1e-4 * tolerance, "wanted");
		assert_near(kept[i].value, after, 1e-9 * fabs(after) + 1e-4 * tolerance, "value");
		assert_true(fabs(after - before) <= tolerance * (1.0 + 1e-4));
		if (kept[i].multiplier != 0.0)
			assert_true(fabs(after - before) >= 0.89 * tolerance &&
			            kept[i].multiplier * (after - before) > 0.0);
		ends += kept[i].multiplier != 0.0;
	}
	/* Without a search after the first the end is that of its precision. */
	const bool exact = ends > 0 || precision == BATTEN_F64;
	const batten_certificate *certificate = batten_fairing_certificate(fairing);
	assert_non_null(certificate);
	assert_below(certificate->gap_estimate, exact ? 1e-6 : 1e-4, "gap");
	assert_near(certificate->objective, objective_of(fairing),
	            (exact ? 1e-12 : 1e-6) * objective_of(fairing), "objective");
	return ends;
}

static void test_alone_and_together(void **state)
{
	static const char *const hulls[] = { "wigley_noisy", "bsra_trawler" };
	batten_keep keep[KEPT];
	choose_keeps(keep);
	for (size_t h = 0; h < sizeof hulls / sizeof hulls[0]; h++) {
		batten_hull *hull = read_hull(*state, hulls[h]);
		batten_fair_options options = options_for(NULL, 0);
		batten_fairing *plain = fair(*state, hull, &options);
		double dearest = objective_of(plain);
		unsigned ends = 0;
		for (size_t i = 0; i <= KEPT; i++) {
			const size_t count = i < KEPT ? 1 : KEPT;
			options = options_for(i < KEPT ? &keep[i] : keep, count);
			batten_fairing *fairing = fair(*state, hull, &options);
			ends += check(*state, fairing, options.keep, count, BATTEN_F64);
			/* Together they cost at least what the dearest costs alone. */
			assert_true(objective_of(fairing) >=
			            (i < KEPT ? objective_of(plain) : dearest) * (1.0 - 1e-6));
			dearest = fmax(dearest, objective_of(fairing));
			batten_fairing_destroy(fairing);
		}
		assert_true(ends >= 5);
		batten_fairing_destroy(plain);
		batten_hull_destroy(hull);
	}
}

/* By every fairness, also where f32 only screens, and with rows, stations and tangents held. */
static void test_every_fairness(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	const batten_keep keep[] = { { quantity("volume_m3"), 1e-4, true },
		                         { quantity("lcb_pct_lbp_fwd"), 1e-3, false } };
	const batten_net_lock row = { .kind = BATTEN_NET_LOCK_ROW, .row = 2 };
	unsigned ends = 0;
	for (int fairness = BATTEN_FAIRNESS_BENDING;
	     fairness <= CASES(BATTEN_FAIRNESS_VARIATION, BATTEN_FAIRNESS_BENDING); fairness++) {
		batten_fair_options options = options_for(keep, 2);
		options.fairness = (batten_fairness)fairness;
		options.net_locks = &row;
		options.net_lock_count = 1;
		options.fixed_tangents = BATTEN_EDGE_DECK;
		batten_fairing *exact = fair(*state, hull, &options);
		ends += check(*state, exact, keep, 2, BATTEN_F64);
		const batten_surface_net a = batten_surface_describe(batten_fairing_fitted_surface(exact));
		const batten_surface_net b = batten_surface_describe(batten_fairing_faired_surface(exact));
		for (size_t i = 0; i < a.count_u; i++) {
			assert_true(pole(&a, i, 2)[1] == pole(&b, i, 2)[1]);
			assert_near(pole(&b, i, 6)[1] - pole(&a, i, 6)[1],
			            pole(&b, i, 5)[1] - pole(&a, i, 5)[1], 1e-14, "deck and beside it");
		}
		options.search.precision = BATTEN_F32;
		batten_fairing *screened = fair(*state, hull, &options);
		(void)check(*state, screened, keep, 2, BATTEN_F32);
		assert_near(objective_of(screened), objective_of(exact), 1e-5 * objective_of(exact),
		            "objective after f32");
		batten_fairing_destroy(screened);
		batten_fairing_destroy(exact);
	}
	assert_true(ends >= CASES(4, 1));
	batten_hull_destroy(hull);
}

static void expect_same_poles(const batten_fairing *a, const batten_fairing *b)
{
	const batten_surface_net x = batten_surface_describe(batten_fairing_faired_surface(a));
	const batten_surface_net y = batten_surface_describe(batten_fairing_faired_surface(b));
	assert_memory_equal(x.poles_m, y.poles_m, 3 * x.count_u * x.count_v * sizeof(double));
}

static void test_within_the_tolerance_nothing_changes(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	const batten_keep keep[] = { { quantity("volume_m3"), 0.5, true },
		                         { quantity("lcb_pct_lbp_fwd"), 5.0, false } };
	batten_fair_options options = options_for(NULL, 0);
	batten_fairing *plain = fair(*state, hull, &options);
	options = options_for(keep, 2);
	batten_fairing *fairing = fair(*state, hull, &options);
	assert_int_equal(check(*state, fairing, keep, 2, BATTEN_F64), 0);
	expect_same_poles(plain, fairing);
	batten_fairing_destroy(plain);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* Whatever device searches, the bits are those of the C path. */
static void test_every_device(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_keep keep[KEPT];
	choose_keeps(keep);
	batten_fair_options options = options_for(keep, KEPT);
	batten_fairing *known = fair(*state, hull, &options);
	assert_true(check(*state, known, keep, KEPT, BATTEN_F64) > 0);
	options.search.device = BATTEN_DEVICE_AUTO;
	batten_fairing *fairing = fair(*state, hull, &options);
	expect_same_poles(known, fairing);
	batten_fairing_destroy(known);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* The multiplier is what the objective gains by a wider tolerance: so it can be only at the least
 * objective of all surfaces within it. */
static void test_multiplier_is_the_price(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	double objective[3] = { 0.0 }, value[3] = { 0.0 }, multiplier[3] = { 0.0 };
	for (int i = 0; i < 3; i++) {
		const batten_keep keep = { quantity("volume_m3"), 1e-4 * (1.0 + i), true };
		batten_fair_options options = options_for(&keep, 1);
		batten_fairing *fairing = fair(*state, hull, &options);
		size_t count = 0;
		objective[i] = objective_of(fairing);
		value[i] = batten_fairing_kept(fairing, &count, NULL)->value;
		multiplier[i] = batten_fairing_kept(fairing, &count, NULL)->multiplier;
		assert_true(multiplier[i] != 0.0);
		batten_fairing_destroy(fairing);
	}
	const double price = -(objective[2] - objective[0]) / (value[2] - value[0]);
	assert_near(price, multiplier[1], 0.02 * fabs(price), "price");
	batten_hull_destroy(hull);
}

/* 2 y times the y of the normal, seen from the side. */
static long double volume_at(const oracle_surface *s, long double u, long double v)
{
	oracle_jet d;
	assert_true(oracle_surface_at(s, u, v, d));
	return 2.0L * d[0][0][1] * (d[1][0][0] * d[0][1][2] - d[1][0][2] * d[0][1][0]);
}

/* The v, at most 1, up to which the surface lies below the draft. */
static long double top_at(const oracle_surface *s, long double u, double draft)
{
	long double low = 0.5L;
	long double high = 1.0L;
	oracle_jet d;
	assert_true(oracle_surface_at(s, u, high, d));
	while (d[0][0][2] > draft && high - low > 1e-12L) {
		const long double middle = 0.5L * (low + high);
		oracle_jet at;
		assert_true(oracle_surface_at(s, u, middle, at));
		if (at[0][0][2] > draft)
			high = middle;
		else
			low = middle;
	}
	return high;
}

enum { NODES = 12 };

/* Along v, span by span up to the draft. */
static long double volume_along(const oracle_surface *s, long double u, double draft)
{
	long double node[NODES], weight[NODES], sum = 0.0L;
	const long double top = top_at(s, u, draft);
	oracle_gauss(NODES, node, weight);
	for (size_t j = s->order_v - 1; j < s->count_v; j++) {
		const long double end = fminl(s->knots_v[j + 1], top);
		const long double half = 0.5L * (end - s->knots_v[j]);
		for (int q = 0; q < NODES && half > 0.0L; q++)
			sum += half * weight[q] * volume_at(s, u, s->knots_v[j] + half * (1.0L + node[q]));
	}
	return sum;
}

static double oracle_volume(const batten_surface *surface, double draft)
{
	const batten_surface_net net = batten_surface_describe(surface);
	const oracle_surface s = { net.order_u, net.order_v, net.count_u, net.count_v,
		                       net.knots_u, net.knots_v, net.poles_m, NULL };
	long double node[NODES], weight[NODES], sum = 0.0L;
	oracle_gauss(NODES, node, weight);
	for (size_t i = s.order_u - 1; i < s.count_u; i++) {
		const long double half = 0.5L * ((long double)s.knots_u[i + 1] - s.knots_u[i]);
		for (int q = 0; q < NODES; q++)
			sum += half * weight[q] *
			       volume_along(&s, s.knots_u[i] + half * (1.0L + node[q]), draft);
	}
	return (double)fabsl(sum);
}

/* The volume is the integral of y over the surface below the draft, seen from the side. */
static void test_volume_by_the_oracle(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	const batten_keep keep = { quantity("volume_m3"), 1e-4, true };
	batten_fair_options options = options_for(&keep, 1);
	batten_fairing *fairing = fair(*state, hull, &options);
	const double draft = batten_hull_draft_m(hull);
	const double before = oracle_volume(batten_fairing_fitted_surface(fairing), draft);
	const double after = oracle_volume(batten_fairing_faired_surface(fairing), draft);
	size_t count = 0;
	assert_near(batten_fairing_kept(fairing, &count, NULL)->value, after, 1e-6 * after, "volume");
	assert_true(fabs(after - before) <= 1.01e-4 * before &&
	            fabs(after - before) >= 0.8e-4 * before);
	options = options_for(NULL, 0);
	batten_fairing *plain = fair(*state, hull, &options);
	assert_true(fabs(oracle_volume(batten_fairing_faired_surface(plain), draft) - before) >
	            2e-4 * before);
	batten_fairing_destroy(plain);
	batten_fairing_destroy(fairing);
	batten_hull_destroy(hull);
}

/* Against the slope of closeness along an even shift of all free poles stands just that shift: bases add up to
 * 1. Poles that are fixed, and those that lead and follow, included. */
static void test_closeness_inverted(void **state)
{
	enum { U = 8, V = 7, POLES = U * V };
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	const batten_fit_options how = net(U, V, 4);
	batten_surface *surface = fit(*state, hull, &how, NULL);
	double lower[POLES], upper[POLES], slopes[2 * POLES] = { 0.0 }, ways[2 * POLES], y[POLES];
	size_t leader[POLES];
	batten_net_options options;
	batten_net_options_default(&options);
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.leader = leader;
	for (size_t p = 0; p < POLES; p++) {
		const bool fixed = p % U == 3;
		y[p] = surface->poles[3 * p + 1];
		lower[p] = y[p] - (fixed ? 0.0 : 1.0);
		upper[p] = y[p] + (fixed ? 0.0 : 1.0);
		leader[p] = p >= 2 * U ? p : p % U;
	}
	const batten_net_problem problem = { .start = surface,
		                                 .lower_y_m = lower,
		                                 .upper_y_m = upper,
		                                 .w1 = 0.0,
		                                 .w2 = 50.0,
		                                 .half_beam_m = 3.0 };
	/* By differences of the objective, which is a parabola: the slope along a pole at `shift`. */
	const double shift[2] = { 0.25, -0.5 };
	for (size_t k = 0; k < 2; k++)
		for (size_t p = 0; p < POLES; p++) {
			batten_certificate of[2];
			if (p % U == 3 || leader[p] != p)
				continue;
			for (size_t side = 0; side < 2; side++) {
				double moved[POLES];
				for (size_t n = 0; n < POLES; n++)
					moved[n] = y[n] + (n % U == 3 ? 0.0 : shift[k]) +
					           (leader[n] == p ? (side ? 0.1 : -0.1) : 0.0);
				assert_int_equal(
					batten_net_certify_batch(*state, 1, &problem, &options, moved, &of[side]),
					BATTEN_OK);
			}
			slopes[k * POLES + p] = (of[1].objective - of[0].objective) / 0.2;
		}
	assert_int_equal(net_problem_yield(*state, &problem, &options, 2, slopes, ways), BATTEN_OK);
	for (size_t k = 0; k < 2; k++)
		for (size_t p = 0; p < POLES; p++)
			assert_near(ways[k * POLES + p], p % U == 3 ? 0.0 : shift[k], 1e-8, "way");
	/* Closeness is all there is: the objective answers alike. */
	bool known = false;
	double answers[2 * POLES];
	assert_int_equal(net_problem_answer(*state, &problem, &options, y, 2, slopes, answers, &known),
	                 BATTEN_OK);
	assert_true(known);
	for (size_t n = 0; n < 2 * (size_t)POLES; n++)
		assert_near(answers[n], ways[n], 1e-8, "answer");
	batten_surface_destroy(surface);
	batten_hull_destroy(hull);
}

static void expect_fault(batten_context *context, const batten_hull *hull,
                         const batten_fair_options *options, batten_status status,
                         const char *first, const char *second)
{
	batten_fairing *fairing = NULL;
	assert_int_equal(batten_hull_fair(context, hull, options, &fairing), status);
	assert_null(fairing);
	const char *error = batten_context_error(context);
	if (!strstr(error, first) || !strstr(error, second))
		fail_msg("found: %s", error);
}

/* The fitted surface, which the bounds allow, has all its own measures: only what does not exist is
 * refused, as a height above a centre of gravity that nobody gave. */
static void test_what_cannot_be_kept_is_named(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	const batten_keep volume = { quantity("volume_m3"), 0.1, true };
	const batten_keep stability = { quantity("gmt_m"), 1e-3, false };
	batten_fair_options options = options_for(&stability, 1);
	expect_fault(*state, hull, &options, BATTEN_INPUT, "gmt_m", "cannot be kept");
	options.w2 = 0.0;
	options.keep = &volume;
	expect_fault(*state, hull, &options, BATTEN_USAGE, "w2 above 0", "");
	batten_hull_destroy(hull);
}

static batten_status fair_once(batten_context *context, const batten_hull *hull,
                               const batten_fair_options *options)
{
	batten_fairing *fairing = NULL;
	const batten_status status = batten_hull_fair(context, hull, options, &fairing);
	batten_fairing_destroy(fairing);
	return status;
}

/* Every third allocation from the search on fails once: that meets each line of the code, which runs a search and
 * a measurement several times. */
static void test_memory(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_hull *hull = read_hull(context, "wigley_noisy");
	const batten_keep keep = { quantity("volume_m3"), 2e-3, true };
	batten_fair_options options = options_for(&keep, 1);
	options.fit.count_u = options.fit.count_v = 4;
	options.fit.correction_limit = 1; /* else the fit before the search is nearly all of the time */
	options.keep_count = 0;
	heap.count = 0;
	assert_int_equal(fair_once(context, hull, &options), BATTEN_OK);
	const size_t plain = heap.count;
	options.keep_count = 1;
	heap.count = 0;
	assert_int_equal(fair_once(context, hull, &options), BATTEN_OK);
	const size_t all = heap.count;
	assert_true(all > plain + 30);
	for (size_t fail_at = plain - plain / 7; fail_at <= all; fail_at += 3) {
		const size_t before = heap.live;
		heap.count = 0;
		heap.fail_at = fail_at;
		assert_int_equal(fair_once(context, hull, &options), BATTEN_MEMORY);
		assert_int_equal(heap.live, before);
	}
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_alone_and_together, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_every_fairness, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_within_the_tolerance_nothing_changes, make_context,
		                                end_context),
		cmocka_unit_test_setup_teardown(test_every_device, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_multiplier_is_the_price, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_volume_by_the_oracle, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_closeness_inverted, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_what_cannot_be_kept_is_named, make_context,
		                                end_context),
		cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
