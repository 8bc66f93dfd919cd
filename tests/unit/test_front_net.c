/* The fairness-closeness front of a hull over the control net of its surface: every point is a fairing by itself. */
#include "unit/fit_fixture.h"

#include "support/failing_heap.h"

enum { COUNT = 5 };

static batten_fair_options net_options(void)
{
	batten_fair_options options;
	batten_fair_options_default(&options);
	options.variables = BATTEN_VARIABLES_NET;
	options.search.device = BATTEN_DEVICE_REFERENCE;
	options.fit.count_u = 8;
	options.fit.count_v = 7;
	options.max_distance_part = 0.02;
	return options;
}

static void sweep(batten_context *context, const batten_hull *hull,
                  const batten_fair_options *options, batten_front_point *points)
{
	if (batten_hull_front(context, hull, options, 10.0, 1e5, COUNT, points, NULL) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
}

static void release(batten_front_point *points)
{
	for (int p = 0; p < COUNT; p++) {
		assert_non_null(points[p].surface);
		batten_surface_destroy(points[p].surface);
	}
}

static void expect_same_surface(const batten_surface *a, const batten_surface *b)
{
	const batten_surface_net x = batten_surface_describe(a);
	const batten_surface_net y = batten_surface_describe(b);
	assert_int_equal(x.count_u, y.count_u);
	assert_int_equal(x.count_v, y.count_v);
	assert_memory_equal(x.poles_m, y.poles_m, 3 * x.count_u * x.count_v * sizeof(double));
}

/* A point is the fairing with its weights, to the last bit. */
static void expect_single(batten_context *context, const batten_hull *hull,
                          const batten_fair_options *options, const batten_front_point *point)
{
	batten_fair_options single = *options;
	batten_fairing *fairing = NULL;
	size_t kept_count = 0;
	single.weights_given = true;
	single.w1 = 1.0;
	single.w2 = point->ratio;
	if (batten_hull_fair(context, hull, &single, &fairing) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	const batten_search_result *result = batten_fairing_result(fairing);
	const batten_certificate *certificate = batten_fairing_certificate(fairing);
	const batten_kept *kept = batten_fairing_kept(fairing, &kept_count, NULL);
	expect_same_surface(point->surface, batten_fairing_faired_surface(fairing));
	assert_true(point->result.objective_end == result->objective_end);
	assert_int_equal(point->result.iterations, result->iterations);
	assert_int_equal(point->result.end, result->end);
	assert_true(point->fairness == certificate->fairness);
	assert_true(point->closeness.closeness_m4 == certificate->closeness_m4);
	assert_true(point->gap_estimate == certificate->gap_estimate);
	assert_true(point->closeness.cn_rms_m == batten_fairing_describe(fairing).rms_change_m);
	for (size_t k = 0; k < kept_count; k++)
		assert_true(point->kept[k].value == kept[k].value &&
		            point->kept[k].multiplier == kept[k].multiplier);
	batten_fairing_destroy(fairing);
}

/* By two minima F1 + r1 C1 <= F2 + r1 C2 and F2 + r2 C2 <= F1 + r2 C1, each as far above its own as its gap
 * says: C falls and F rises with r. Returns how many points the front falls at by more than that. */
static unsigned check_monotone(const batten_front_point *points, double half_beam_m)
{
	const double h4 = pow(half_beam_m, 4);
	unsigned apart = 0;
	for (int p = 1; p < COUNT; p++) {
		const batten_front_point *a = &points[p - 1];
		const batten_front_point *b = &points[p];
		const double off = a->gap_estimate * a->result.objective_end;
		const double off_next = b->gap_estimate * b->result.objective_end;
		const double close = (off + off_next) * h4 / (b->ratio - a->ratio);
		const double fair = (b->ratio * off + a->ratio * off_next) / (b->ratio - a->ratio);
		assert_true(b->closeness.closeness_m4 <= a->closeness.closeness_m4 + close);
		assert_true(b->fairness >= a->fairness - fair);
		assert_false(a->dominated || b->dominated);
		apart += b->closeness.closeness_m4 < a->closeness.closeness_m4 - close &&
		         b->fairness > a->fairness + fair;
	}
	return apart;
}

/* Fairness and closeness make up the objective. */
static void expect_parts(const batten_front_point *point, batten_fairness fairness,
                         double half_beam_m)
{
	const double h2 = half_beam_m * half_beam_m;
	const double sum = point->fairness * (fairness == BATTEN_FAIRNESS_VARIATION ? h2 : 1.0) +
	                   point->ratio * point->closeness.closeness_m4 / (h2 * h2);
	assert_near(point->result.objective_end, sum, 1e-11 * sum, "objective");
}

static void check(batten_context *context, const batten_hull *hull,
                  const batten_fair_options *options)
{
	batten_front_point points[COUNT];
	const double h = batten_hull_half_beam_m(hull);
	sweep(context, hull, options, points);
	assert_int_equal(check_monotone(points, h), COUNT - 1);
	for (int p = 0; p < COUNT; p++) {
		const batten_closeness *c = &points[p].closeness;
		assert_true(points[p].gap_estimate >= 0.0 && points[p].gap_estimate <= 1e-5);
		assert_near(points[p].ratio, pow(10.0, p + 1), 1e-12 * points[p].ratio, "ratio");
		expect_parts(&points[p], options->fairness, h);
		assert_true(c->cn_rms_m <= c->cn_max_m && c->cn_max_m <= 0.02 * h);
		assert_near(c->cn_pct, 100.0 * c->cn_max_m / h, 1e-12, "cn_pct");
	}
	expect_single(context, hull, options, &points[1]);
	expect_single(context, hull, options, &points[COUNT - 1]);
	release(points);
}

static void test_every_fairness(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	const batten_net_lock row = { .kind = BATTEN_NET_LOCK_ROW, .row = 3 };
	const batten_lock station = { .kind = BATTEN_LOCK_STATION, .x_m = 8.0 };
	for (int f = BATTEN_FAIRNESS_BENDING; f <= BATTEN_FAIRNESS_VARIATION; f++) {
		batten_fair_options options = net_options();
		options.fairness = (batten_fairness)f;
		options.search.iteration_limit = 2000;
		if (f == BATTEN_FAIRNESS_MEAN) {
			options.net_locks = &row;
			options.net_lock_count = 1;
			options.locks = &station;
			options.lock_count = 1;
		}
		if (f == BATTEN_FAIRNESS_GAUSS)
			options.fixed_tangents = BATTEN_EDGE_DECK;
		check(*state, hull, &options);
	}
	batten_hull_destroy(hull);
}

static void test_f32_and_polish(void **state)
{
	batten_hull *hull = read_hull(*state, "bsra_trawler");
	batten_fair_options options = net_options();
	batten_front_point exact[COUNT], screened[COUNT], polished[COUNT];
	sweep(*state, hull, &options, exact);
	options.search.precision = BATTEN_F32;
	sweep(*state, hull, &options, screened);
	expect_single(*state, hull, &options, &screened[2]);
	options.polish_gap = 1e-12;
	sweep(*state, hull, &options, polished);
	expect_single(*state, hull, &options, &polished[2]);
	for (int p = 0; p < COUNT; p++) {
		const double objective = exact[p].result.objective_end;
		assert_near(screened[p].result.objective_end, objective, 3e-4 * objective, "f32");
		assert_true(polished[p].gap_estimate <= 1e-12);
		assert_true(polished[p].result.objective_end <= objective * (1.0 + 1e-11));
	}
	release(exact);
	release(screened);
	release(polished);
	batten_hull_destroy(hull);
}

/* Each point keeps what its fairing keeps; and the price is in its objective. */
static void test_measures_are_kept(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options();
	batten_front_point plain[COUNT], points[COUNT];
	size_t volume = 0;
	while (strcmp(batten_hydrostatics_name(volume), "volume_m3") != 0)
		volume++;
	const batten_keep keep = { volume, 1e-4, true };
	unsigned held = 0;
	sweep(*state, hull, &options, plain);
	options.keep = &keep;
	options.keep_count = 1;
	sweep(*state, hull, &options, points);
	for (int p = 0; p < COUNT; p++) {
		const batten_kept *kept = &points[p].kept[0];
		expect_single(*state, hull, &options, &points[p]);
		expect_parts(&points[p], options.fairness, batten_hull_half_beam_m(hull));
		assert_int_equal(kept->quantity, volume);
		assert_true(fabs(kept->value - kept->wanted) <= kept->tolerance);
		if (kept->multiplier != 0.0) {
			held++;
			assert_true(points[p].result.objective_end > plain[p].result.objective_end);
		}
	}
	assert_true(held > 0);
	release(plain);
	release(points);
	batten_hull_destroy(hull);
}

/* Any device gives these bits. */
static void test_every_device(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options();
	batten_front_point known[COUNT], found[COUNT];
	sweep(*state, hull, &options, known);
	options.search.device = BATTEN_DEVICE_AUTO;
	sweep(*state, hull, &options, found);
	for (int p = 0; p < COUNT; p++) {
		expect_same_surface(known[p].surface, found[p].surface);
		assert_true(known[p].fairness == found[p].fairness);
	}
	release(known);
	release(found);
	batten_hull_destroy(hull);
}

static void test_limit(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	batten_fair_options options = net_options();
	batten_front_point points[COUNT];
	options.search.iteration_limit = 1;
	assert_int_equal(batten_hull_front(*state, hull, &options, 10.0, 1e5, COUNT, points, NULL),
	                 BATTEN_INCOMPLETE);
	assert_non_null(strstr(batten_context_error(*state), "w2/w1 = 10"));
	release(points);
	/* What the limit left, a polish ends. */
	options.polish_gap = 1e-9;
	assert_int_equal(batten_hull_front(*state, hull, &options, 1e3, 1e5, COUNT, points, NULL),
	                 BATTEN_OK);
	release(points);
	batten_hull_destroy(hull);
}

static void expect_fault(batten_context *context, const batten_hull *hull,
                         const batten_fair_options *options, batten_status status, const char *says)
{
	batten_front_point points[COUNT];
	assert_int_equal(batten_hull_front(context, hull, options, 10.0, 1e5, COUNT, points, NULL),
	                 status);
	if (!strstr(batten_context_error(context), says) || strchr(batten_context_error(context), '\n'))
		fail_msg("found: %s", batten_context_error(context));
}

static void test_refusals(void **state)
{
	batten_hull *hull = read_hull(*state, "wigley_noisy");
	const batten_net_lock row = { .kind = BATTEN_NET_LOCK_ROW, .row = 7 };
	const batten_keep keep = { 0, 1e-3, true };
	batten_fair_options options = net_options();
	options.lower = hull;
	expect_fault(*state, hull, &options, BATTEN_USAGE, "lower and upper offsets");
	options = net_options();
	options.search.interior_penalty = true;
	expect_fault(*state, hull, &options, BATTEN_USAGE,
	             "an interior penalty is of searches over offsets");
	options = net_options();
	options.search.algorithm = BATTEN_ALGORITHM_TEXTBOOK;
	expect_fault(*state, hull, &options, BATTEN_USAGE, "search algorithm textbook");
	options = net_options();
	options.net_locks = &row;
	options.net_lock_count = 1;
	expect_fault(*state, hull, &options, BATTEN_USAGE, "found row 7");
	options = net_options();
	options.fit.count_u = 22;
	expect_fault(*state, hull, &options, BATTEN_INPUT, "expected at least 22");
	options = net_options();
	options.keep = &keep;
	options.keep_count = 1;
	options.polish_gap = 1e-9;
	expect_fault(*state, hull, &options, BATTEN_USAGE, "keeps no measures");
	options = net_options();
	options.weights_given = true;
	expect_fault(*state, hull, &options, BATTEN_USAGE, "sweeps its own weights");
	batten_hull_destroy(hull);
}

static batten_status sweep_once(batten_context *context, const batten_hull *hull,
                                const batten_fair_options *options)
{
	batten_front_point points[2];
	const batten_status status = batten_hull_front(context, hull, options, 1e3, 1e4, 2, points,
	                                               NULL);
	for (int p = 0; p < 2 && status != BATTEN_USAGE; p++) {
		assert_true((points[p].surface != NULL) == (status == BATTEN_OK));
		batten_surface_destroy(points[p].surface);
	}
	return status;
}

/* Each allocation from the fit's end on fails once, every third of a polish, which makes the same ones a step;
 * those before are a fairing's. */
static void test_memory(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	batten_hull *hull = read_hull(context, "wigley_noisy");
	const batten_net_lock row = { .kind = BATTEN_NET_LOCK_ROW, .row = 4 };
	batten_fair_options options = net_options();
	options.fit.count_u = options.fit.count_v = 4;
	options.fit.correction_limit = 1; /* else the fit before the search is most of the time */
	options.net_locks = &row;
	options.net_lock_count = 1;
	heap.count = 0;
	assert_int_equal(sweep_once(context, hull, &options), BATTEN_USAGE);
	const size_t fitted = heap.count;
	options.net_lock_count = 0;
	for (int polished = 0; polished < 2; polished++) {
		options.polish_gap = polished ? 1e-12 : 0.0;
		heap.count = 0;
		heap.fail_at = 0;
		assert_int_equal(sweep_once(context, hull, &options), BATTEN_OK);
		const size_t all = heap.count;
		assert_true(all > fitted + 30);
		for (size_t fail_at = fitted; fail_at <= all; fail_at += polished ? 3 : 1) {
			const size_t before = heap.live;
			heap.count = 0;
			heap.fail_at = fail_at;
			assert_int_equal(sweep_once(context, hull, &options), BATTEN_MEMORY);
			assert_int_equal(heap.live, before);
		}
	}
	batten_hull_destroy(hull);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_every_fairness, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_f32_and_polish, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_measures_are_kept, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_every_device, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_limit, make_context, end_context),
		cmocka_unit_test_setup_teardown(test_refusals, make_context, end_context),
		cmocka_unit_test(test_memory),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
