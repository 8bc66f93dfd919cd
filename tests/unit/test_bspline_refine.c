/* Changes of a curve in place: knots, orders and direction that leave it where it is, and what they
 * refuse. */
#include "bspline_fixture.h"
#include "support/failing_heap.h"

enum { TRIALS = 120, SAMPLES = 25 };

static struct bspline_curve copy_of(const struct bspline_curve *curve)
{
	struct bspline_curve copy;
	struct bspline_curve_net net = { curve->order, curve->count, curve->dimension,
		                             curve->knots, curve->poles, curve->weights };
	assert_int_equal(bspline_curve_create(curve->context, &net, &copy), BATTEN_OK);
	return copy;
}

/* Point and derivatives agree over the range, relative to the size of each derivative; not at the
 * knots, where the higher ones may jump. */
static void assert_same_curve(const struct bspline_curve *a, const struct bspline_curve *b,
                              double tolerance)
{
	assert_close(curve_place(b, 0), curve_place(a, 0), 0);
	assert_close(curve_place(b, 1), curve_place(a, 1), 0);
	uint64_t seed = 21;
	for (int sample = 0; sample < SAMPLES; sample++) {
		double t = curve_place(a, random_between(&seed, 0.001, 0.999));
		double at_a[12];
		double at_b[12];
		bspline_curve_evaluate(a, t, 3, at_a);
		bspline_curve_evaluate(b, t, 3, at_b);
		double shortest = INFINITY;
		for (size_t i = a->order; i <= a->count; i++)
			if (a->knots[i] > a->knots[i - 1])
				shortest = fmin(shortest, a->knots[i] - a->knots[i - 1]);
		for (size_t d = 0; d <= 3; d++) {
			double size = pow((double)a->order / shortest, (double)d);
			assert_all_close(3, at_b + 3 * d, at_a + 3 * d, tolerance * size);
		}
	}
}

/* Number of distinct knots inside the range. */
static size_t inner_knots(const struct bspline_curve *curve)
{
	size_t number = 0;
	for (size_t i = curve->order; i < curve->count; i++)
		number += curve->knots[i] > curve->knots[i - 1];
	return number;
}

static void inserting_knots_changes_nothing(void **state)
{
	uint64_t seed = 22;
	for (int trial = 0; trial < TRIALS; trial++) {
		size_t order = random_size(&seed, 2, 8);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		struct bspline_curve c = random_curve(*state, &seed, order, count, trial % 3, trial % 2);
		struct bspline_curve finer = copy_of(&c);
		double t = curve_place(&c, random_between(&seed, 0.1, 0.9));
		size_t times = random_size(&seed, 1, order - 1);
		assert_int_equal(bspline_curve_insert_knot(&finer, t, times), BATTEN_OK);
		assert_int_equal(finer.count, count + times);
		assert_int_equal(bspline_knots_check(*state, "knots", order, finer.count, finer.knots),
		                 BATTEN_OK);
		assert_same_curve(&c, &finer, 1e-12);
		bspline_curve_destroy(&c);
		bspline_curve_destroy(&finer);
	}
}

/* A knot there order - 1 times has its pole on the curve. */
static void a_full_knot_lies_on_the_curve(void **state)
{
	uint64_t seed = 23;
	for (size_t order = 2; order <= 8; order++) {
		struct bspline_curve c = random_curve(*state, &seed, order, 12, true, order % 2);
		double t = curve_place(&c, 0.45);
		double point[3];
		bspline_curve_evaluate(&c, t, 0, point);
		assert_int_equal(bspline_curve_insert_knot(&c, t, order - 1), BATTEN_OK);
		size_t span = bspline_span(order, c.count, c.knots, t);
		assert_all_close(3, c.poles + 3 * (span + 1 - order), point, 1e-14);
		/* Nor can it come once more. */
		assert_refused(*state, bspline_curve_insert_knot(&c, t, 1), BATTEN_USAGE,
		               "can be inserted 0 times");
		bspline_curve_destroy(&c);
	}
}

static void raising_the_order_changes_nothing(void **state)
{
	uint64_t seed = 24;
	for (int trial = 0; trial < TRIALS; trial++) {
		size_t order = random_size(&seed, 2, 7);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		struct bspline_curve c = random_curve(*state, &seed, order, count, trial % 3, trial % 2);
		struct bspline_curve raised = copy_of(&c);
		size_t times = random_size(&seed, 1, 8 - order);
		assert_int_equal(bspline_curve_elevate(&raised, times), BATTEN_OK);
		assert_int_equal(raised.order, order + times);
		assert_int_equal(raised.count, count + times * (inner_knots(&c) + 1));
		assert_int_equal(
			bspline_knots_check(*state, "knots", raised.order, raised.count, raised.knots),
			BATTEN_OK);
		assert_same_curve(&c, &raised, 1e-11);
		bspline_curve_destroy(&c);
		bspline_curve_destroy(&raised);
	}
}

/* The half-breadths of the parabolic hull, order 3 to 4. */
static void raised_parabola(void **state)
{
	static const double knots[] = { 0, 0, 0, 1, 1, 1 };
	static const double poles[] = { 0, 0, 2, 1, 0, 1 };
	static const double raised[] = { 0, 0, 4. / 3, 2. / 3, 4. / 3, 1, 0, 1 };
	struct bspline_curve c;
	struct bspline_curve_net net = { 3, 3, 2, knots, poles, NULL };
	assert_int_equal(bspline_curve_create(*state, &net, &c), BATTEN_OK);
	assert_int_equal(bspline_curve_elevate(&c, 1), BATTEN_OK);
	assert_int_equal(c.count, 4);
	assert_all_close(8, c.poles, raised, 4e-16);
	bspline_curve_destroy(&c);
}

static void reversing(void **state)
{
	uint64_t seed = 25;
	for (int trial = 0; trial < TRIALS; trial++) {
		size_t order = random_size(&seed, 2, 8);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		struct bspline_curve c = random_curve(*state, &seed, order, count, trial % 3, trial % 2);
		struct bspline_curve back = copy_of(&c);
		bspline_curve_reverse(&back);
		assert_close(curve_place(&back, 0), curve_place(&c, 0), 0);
		assert_close(curve_place(&back, 1), curve_place(&c, 1), 0);
		assert_int_equal(bspline_knots_check(*state, "knots", order, count, back.knots), BATTEN_OK);
		double sum = curve_place(&c, 0) + curve_place(&c, 1);
		for (int sample = 0; sample < SAMPLES; sample++) {
			double t = curve_place(&c, random_between(&seed, 0, 1));
			double a[6];
			double b[6];
			bspline_curve_evaluate(&c, t, 1, a);
			bspline_curve_evaluate(&back, sum - t, 1, b);
			assert_all_close(3, b, a, 1e-13);
			for (size_t i = 3; i < 6; i++)
				assert_close(b[i], -a[i], 1e-11);
		}
		bspline_curve_reverse(&back);
		assert_all_close(3 * count, back.poles, c.poles, 0);
		assert_all_close(count + order, back.knots, c.knots, 1e-15 * 20);
		bspline_curve_destroy(&c);
		bspline_curve_destroy(&back);
	}
}

/* ------------------------------------------------------------------------------------------------
 * What is refused
 * --------------------------------------------------------------------------------------------- */

static const double quadratic_knots[] = { 0, 0, 0, 0.5, 1, 1, 1 };
static const double quadratic_poles[] = { 0, 0, 1, 2, 2, 2, 3, 0 };

static void assert_untouched(const struct bspline_curve *curve)
{
	assert_int_equal(curve->order, 3);
	assert_int_equal(curve->count, 4);
	assert_all_close(7, curve->knots, quadratic_knots, 0);
	assert_all_close(8, curve->poles, quadratic_poles, 0);
}

static void changes_that_are_refused(void **state)
{
	static const double shift[] = { 0, 0 };
	static const double blow_up[] = { 1e10, 0, 0, 1 };
	static const double not_finite[] = { 1, 0, NAN, 1 };
	struct bspline_curve c;
	struct bspline_curve_net net = { 3, 4, 2, quadratic_knots, quadratic_poles, NULL };
	assert_int_equal(bspline_curve_create(*state, &net, &c), BATTEN_OK);
	static const double outside[] = { 0, 1, -0.1, 1.1, NAN, INFINITY };
	for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++)
		assert_refused(*state, bspline_curve_insert_knot(&c, outside[i], 1), BATTEN_USAGE,
		               "is not inside the range 0..1");
	assert_refused(*state, bspline_curve_insert_knot(&c, 0.5, 2), BATTEN_USAGE,
	               "can be inserted 1 times at order 3, not 2");
	assert_refused(*state, bspline_curve_insert_knot(&c, 0.2, SIZE_MAX), BATTEN_USAGE,
	               "can be inserted 2 times");
	assert_refused(*state, bspline_curve_insert_knot(&c, 0.5 + 1e-12, 1), BATTEN_USAGE,
	               "differ by less than");
	assert_refused(*state, bspline_curve_elevate(&c, 6), BATTEN_USAGE, "gives order 9");
	assert_refused(*state, bspline_curve_map(&c, blow_up, shift), BATTEN_USAGE, "takes pole 2");
	assert_refused(*state, bspline_curve_map(&c, not_finite, shift), BATTEN_USAGE, "takes pole 1");
	assert_int_equal(bspline_curve_insert_knot(&c, 0.2, 0), BATTEN_OK);
	assert_int_equal(bspline_curve_elevate(&c, 0), BATTEN_OK);
	assert_untouched(&c);
	bspline_curve_destroy(&c);
	bspline_curve_destroy(&c);
}

static void curves_that_are_refused(void **state)
{
	static const double bad_poles[] = { 0, 0, 1, 2, 2, INFINITY, 3, 0 };
	static const double far_poles[] = { 0, 0, 1, 2, 2, 2, -2e9, 0 };
	static const double zero_weights[] = { 0, 0, 0, 0 };
	static const double bad_weights[] = { 1, 1, NAN, 1 };
	static const double down[] = { 0, 0, 0, 0.5, 0.4, 1, 1 };
	const double *knots = quadratic_knots;
	const double *poles = quadratic_poles;
	const struct {
		struct bspline_curve_net net;
		const char *words;
	} cases[] = {
		{ { 3, 4, 0, knots, poles, NULL }, "dimension 0" },
		{ { 3, 4, 4, knots, poles, NULL }, "dimension 4" },
		{ { 3, 4, 2, NULL, poles, NULL }, "without knots or poles" },
		{ { 3, 4, 2, knots, NULL, NULL }, "without knots or poles" },
		{ { 3, 2, 2, knots, poles, NULL }, "found 2 poles, order 3 needs at least as many" },
		{ { 3, 4, 2, down, poles, NULL }, "knot 5 (0.4) is below the one before" },
		{ { 3, 4, 2, knots, bad_poles, NULL }, "coordinate 2 of pole 3 is not finite" },
		{ { 3, 4, 2, knots, far_poles, NULL }, "coordinate 1 of pole 4" },
		{ { 3, 4, 2, knots, poles, zero_weights }, "weight 1: found 0" },
		{ { 3, 4, 2, knots, poles, bad_weights }, "weight 3: found" },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		struct bspline_curve c = { .order = 77 };
		assert_refused(*state, bspline_curve_create(*state, &cases[i].net, &c), BATTEN_USAGE,
		               cases[i].words);
		assert_null(c.poles);
		bspline_curve_destroy(&c);
	}
}

static batten_status create_and_change(batten_context *context, void *user)
{
	static const double unit[] = { 1, 1, 1, 1 };
	const int change = *(const int *)user;
	struct bspline_curve c;
	struct bspline_curve_net net = { 3, 4, 2, quadratic_knots, quadratic_poles, unit };
	batten_status status = bspline_curve_create(context, &net, &c);
	if (status == BATTEN_OK && change > 0) {
		status = change == 1 ? bspline_curve_insert_knot(&c, 0.3, 2) : bspline_curve_elevate(&c, 2);
		if (status != BATTEN_OK)
			assert_untouched(&c);
	}
	bspline_curve_destroy(&c);
	return status;
}

/* Whichever allocation fails: MEMORY, the curve as it was, nothing lost. */
static void memory_runs_out(void **state)
{
	(void)state;
	failing_heap heap = { 0 };
	batten_context *context = failing_heap_context(&heap);
	size_t failed[3];
	for (int change = 0; change < 3; change++) {
		failed[change] = failing_heap_each(&heap, context, create_and_change, &change);
		assert_true(failed[change] > 0 && failed[change] < 49);
	}
	assert_true(failed[1] > failed[0] && failed[2] > failed[0]);
	failing_heap_close(&heap, context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(inserting_knots_changes_nothing),
		cmocka_unit_test(a_full_knot_lies_on_the_curve),
		cmocka_unit_test(raising_the_order_changes_nothing),
		cmocka_unit_test(raised_parabola),
		cmocka_unit_test(reversing),
		cmocka_unit_test(changes_that_are_refused),
		cmocka_unit_test(curves_that_are_refused),
		cmocka_unit_test(memory_runs_out),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
