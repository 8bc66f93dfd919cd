/* Knot vectors and basis functions (thesis 3.2, Letcher 3.7). */
#include "bspline_fixture.h"

/* ------------------------------------------------------------------------------------------------
 * Basis functions
 * --------------------------------------------------------------------------------------------- */

enum { CUBIC = 4, SIX = 6 };

/* All values of the basis at t, most of them 0. */
static void all_values(size_t order, size_t count, const double *knots, double t, double *values)
{
	double some[BSPLINE_ORDER_MOST];
	size_t span = bspline_span(order, count, knots, t);
	bspline_basis(order, knots, span, t, some);
	for (size_t i = 0; i < count; i++)
		values[i] = 0;
	for (size_t j = 0; j < order; j++)
		values[span + 1 - order + j] = some[j];
}

/* Values worked out by hand for six poles of a clamped uniform cubic. */
static void known_values(void **state)
{
	(void)state;
	static const struct {
		double t, values[SIX];
	} cases[] = {
		{ 0, { 1, 0, 0, 0, 0, 0 } },
		{ 1. / 6, { 1. / 8, 19. / 32, 25. / 96, 1. / 48, 0, 0 } },
		{ 1. / 3, { 0, 1. / 4, 7. / 12, 1. / 6, 0, 0 } },
		{ 1. / 2, { 0, 1. / 32, 15. / 32, 15. / 32, 1. / 32, 0 } },
		{ 2. / 3, { 0, 0, 1. / 6, 7. / 12, 1. / 4, 0 } },
		{ 1, { 0, 0, 0, 0, 0, 1 } },
	};
	double knots[CUBIC + SIX];
	double values[SIX];
	bspline_knots_clamped(CUBIC, SIX, knots);
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		all_values(CUBIC, SIX, knots, cases[i].t, values);
		assert_all_close(SIX, values, cases[i].values, 4e-16);
	}
}

static void sum_is_one_and_none_negative(void **state)
{
	(void)state;
	uint64_t seed = 1;
	for (int trial = 0; trial < 400; trial++) {
		size_t order = random_size(&seed, 2, 8);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		double knots[FIXTURE_POLES_MOST + BSPLINE_ORDER_MOST];
		double values[FIXTURE_POLES_MOST];
		random_knots(&seed, order, count, trial % 2, knots);
		double t = random_between(&seed, knots[order - 1], knots[count]);
		all_values(order, count, knots, t, values);
		double sum = 0;
		for (size_t i = 0; i < count; i++) {
			assert_true(values[i] >= 0);
			assert_true(values[i] == 0 || (knots[i] <= t && t <= knots[i + order]));
			sum += values[i];
		}
		assert_close(sum, 1, 1e-15 * (double)order);
	}
}

/* Sum of all products of m of the numbers. */
static double symmetric_sum(size_t count, const double *numbers, size_t m)
{
	double sums[BSPLINE_ORDER_MOST + 1] = { 1 };
	for (size_t i = 0; i < count; i++)
		for (size_t j = m; j > 0; j--)
			sums[j] += sums[j - 1] * numbers[i];
	return sums[m];
}

static double choose(size_t n, size_t m)
{
	double value = 1;
	for (size_t i = 0; i < m; i++)
		value = value * (double)(n - i) / (double)(i + 1);
	return value;
}

/* d-th derivative of t^m. */
static double power(double t, size_t m, size_t d)
{
	if (d > m)
		return 0;
	double value = 1;
	for (size_t i = 0; i < d; i++)
		value *= (double)(m - i);
	return value * pow(t, (double)(m - d));
}

/* Every power of t up to the degree lies in the space of any knots; its poles are the symmetric means
 * of the knots (Marsden). So are its derivatives, within and beyond the range. */
static void powers_and_their_derivatives(void **state)
{
	(void)state;
	uint64_t seed = 2;
	for (int trial = 0; trial < 300; trial++) {
		size_t order = random_size(&seed, 2, 8);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		double knots[FIXTURE_POLES_MOST + BSPLINE_ORDER_MOST];
		double rows[BSPLINE_DERIVATIVES_MOST + 1][BSPLINE_ORDER_MOST];
		random_knots(&seed, order, count, trial % 2, knots);
		double t = random_between(&seed, knots[order - 1] - 0.1, knots[count] + 0.1);
		size_t span = bspline_span(order, count, knots, t);
		bspline_basis_derivatives(order, knots, span, t, 3, rows);
		for (size_t m = 0; m < order; m++) {
			for (size_t d = 0; d <= 3; d++) {
				double sum = 0;
				double size = fabs(power(t, m, d)) + 1;
				for (size_t j = 0; j < order; j++) {
					double pole = symmetric_sum(order - 1, knots + span + 2 - order + j, m) /
					              choose(order - 1, m);
					sum += rows[d][j] * pole;
					size = fmax(size, fabs(rows[d][j] * pole));
				}
				assert_close(sum, power(t, m, d), 1e-12 * size);
			}
		}
	}
}

/* A jump of the highest derivative at a simple knot and of none below (order - 2 are continuous). */
static void continuity_at_knots(void **state)
{
	(void)state;
	static const double knots[] = { 0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 4, 4, 4, 4 };
	static const struct {
		double knot;
		size_t continuous; /* highest continuous derivative */
	} cases[] = { { 1, 2 }, { 2, 1 }, { 3, 0 } };
	for (size_t i = 0; i < 3; i++) {
		double before[4][BSPLINE_ORDER_MOST];
		double after[4][BSPLINE_ORDER_MOST];
		size_t right = bspline_span(4, 10, knots, cases[i].knot);
		size_t left = bspline_span(4, 10, knots, cases[i].knot - 0.5);
		bspline_basis_derivatives(4, knots, left, cases[i].knot, 3, before);
		bspline_basis_derivatives(4, knots, right, cases[i].knot, 3, after);
		for (size_t d = 0; d <= 3; d++) {
			double largest = 0;
			for (size_t pole = 0; pole < 10; pole++) {
				double a = pole + 3 >= left && pole <= left ? before[d][pole + 3 - left] : 0;
				double b = pole + 3 >= right && pole <= right ? after[d][pole + 3 - right] : 0;
				largest = fmax(largest, fabs(b - a));
			}
			if (d <= cases[i].continuous)
				assert_close(largest, 0, 1e-14);
			else if (d == cases[i].continuous + 1)
				assert_true(largest > 0.1);
		}
	}
}

/* ------------------------------------------------------------------------------------------------
 * Knots
 * --------------------------------------------------------------------------------------------- */

static void uniform_knots(void **state)
{
	(void)state;
	static const double clamped[] = { 0, 0, 0, 0, 1. / 3, 2. / 3, 1, 1, 1, 1 };
	static const double open[] = { 0, 0, 0, 1, 2, 3, 4, 4, 4 };
	static const double bezier[] = { 0, 0, 0, 1, 1, 1 };
	double knots[10];
	bspline_knots_clamped(4, 6, knots);
	assert_all_close(10, knots, clamped, 0);
	bspline_knots_open(3, 6, knots); /* n = 5, k = 3: the last is n - k + 2 = 4 */
	assert_all_close(9, knots, open, 0);
	bspline_knots_open(3, 3, knots);
	assert_all_close(6, knots, bezier, 0);
}

static void greville_places(void **state)
{
	(void)state;
	static const double expected[] = { 0, 1. / 9, 1. / 3, 2. / 3, 8. / 9, 1 };
	double knots[10];
	double places[6];
	bspline_knots_clamped(4, 6, knots);
	bspline_knots_greville(4, 6, knots, places);
	assert_all_close(6, places, expected, 2e-16);
}

static void chord_lengths(void **state)
{
	static const double points[] = { 0, 0, 3, 4, 3, 4, 3, 9, 15, 9 };
	static const double expected[] = { 0, 5. / 22, 5. / 22, 10. / 22, 1 };
	static const double still[] = { 1, 2, 1, 2 };
	static const double broken[] = { 1, 2, 1, NAN };
	double parameters[5];
	assert_int_equal(bspline_parameters_chord(*state, 5, 2, points, parameters), BATTEN_OK);
	assert_all_close(5, parameters, expected, 1e-16);
	assert_refused(*state, bspline_parameters_chord(*state, 1, 2, points, parameters), BATTEN_USAGE,
	               "two points");
	assert_refused(*state, bspline_parameters_chord(*state, 2, 2, still, parameters), BATTEN_USAGE,
	               "one place");
	assert_refused(*state, bspline_parameters_chord(*state, 2, 2, broken, parameters), BATTEN_USAGE,
	               "not finite");
}

/* Schoenberg and Whitney: parameter i lies inside the support of function i. */
static void averaged_knots(void **state)
{
	static const double parameters[] = { 0, 0.1, 0.2, 0.8, 0.9, 1 };
	static const double expected[] = { 0, 0, 0, 0, 1.1 / 3, 1.9 / 3, 1, 1, 1, 1 };
	double knots[FIXTURE_POLES_MOST + BSPLINE_ORDER_MOST];
	assert_int_equal(bspline_knots_averaged(*state, 4, 6, parameters, knots), BATTEN_OK);
	assert_all_close(10, knots, expected, 2e-16);
	uint64_t seed = 3;
	for (int trial = 0; trial < 100; trial++) {
		double places[FIXTURE_POLES_MOST] = { 0 };
		size_t order = random_size(&seed, 2, 8);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		for (size_t i = 1; i < count; i++)
			places[i] = places[i - 1] + random_between(&seed, 0.01, 1);
		assert_int_equal(bspline_knots_averaged(*state, order, count, places, knots), BATTEN_OK);
		for (size_t i = 1; i + 1 < count; i++)
			assert_true(knots[i] < places[i] && places[i] < knots[i + order]);
	}
	static const double twice[] = { 0, 0.5, 0.5, 1 };
	assert_refused(*state, bspline_knots_averaged(*state, 3, 4, twice, knots), BATTEN_USAGE,
	               "parameter 3 (0.5) is not beyond the one before");
	assert_refused(*state, bspline_knots_averaged(*state, 4, 3, twice, knots), BATTEN_USAGE,
	               "found 3 poles");
}

/* Whether parameters can be found, one for each function and in their order, that lie inside the
 * supports: then a fit has one solution (Schoenberg and Whitney). */
static bool can_be_fitted(size_t order, size_t count, const double *knots, size_t place_count,
                          const double *places)
{
	size_t next = 0;
	for (size_t i = 0; i < count; i++) {
		while (next < place_count && places[next] <= knots[i] && i > 0)
			next++;
		if (next == place_count || (places[next] >= knots[i + order] && i + 1 < count))
			return false;
		next++;
	}
	return true;
}

static void spread_knots(void **state)
{
	uint64_t seed = 4;
	double knots[FIXTURE_POLES_MOST + BSPLINE_ORDER_MOST];
	double turned[FIXTURE_POLES_MOST + BSPLINE_ORDER_MOST];
	for (int trial = 0; trial < 400; trial++) {
		double places[60] = { 0 };
		double from_end[60];
		size_t order = random_size(&seed, 2, 8);
		size_t count = random_size(&seed, order, FIXTURE_POLES_MOST);
		size_t place_count = random_size(&seed, count + 1, trial % 2 ? 60 : count + 3);
		for (size_t i = 1; i < place_count; i++)
			places[i] = places[i - 1] + random_between(&seed, 0.01, 1);
		for (size_t i = 0; i < place_count; i++)
			from_end[i] = -places[place_count - 1 - i];
		assert_int_equal(bspline_knots_spread(*state, order, count, place_count, places, knots),
		                 BATTEN_OK);
		assert_close(knots[order - 1], 0, 0);
		assert_close(knots[count], places[place_count - 1], 0);
		assert_true(can_be_fitted(order, count, knots, place_count, places));
		assert_int_equal(bspline_knots_spread(*state, order, count, place_count, from_end, turned),
		                 BATTEN_OK);
		for (size_t i = 0; i < count + order; i++)
			assert_close(turned[i], -knots[count + order - 1 - i], 1e-12);
	}
}

static void spread_knots_by_hand(void **state)
{
	static const double places[] = { 0, 1, 2, 4, 8, 16, 32, 64 };
	static const double heap[] = { 0, 1, 1, 1, 1, 1, 1, 1, 2 };
	double knots[8];
	double averaged[8];
	assert_int_equal(bspline_knots_spread(*state, 3, 5, 8, places, knots), BATTEN_OK);
	/* At numbers 7/3 and 14/3 of the eight. */
	assert_close(knots[3], 2 + 2. / 3, 1e-15);
	assert_close(knots[4], 8 + 16. / 3, 1e-14);
	assert_close(knots[5], 64, 0);
	assert_int_equal(bspline_knots_spread(*state, 3, 4, 4, places, knots), BATTEN_OK);
	assert_int_equal(bspline_knots_averaged(*state, 3, 4, places, averaged), BATTEN_OK);
	assert_all_close(7, knots, averaged, 0);
	assert_refused(*state, bspline_knots_spread(*state, 3, 5, 4, places, knots), BATTEN_USAGE,
	               "found 4 parameters");
	assert_refused(*state, bspline_knots_spread(*state, 2, 6, 9, heap, knots), BATTEN_USAGE,
	               "occurs more than 1 times");
}

struct bad_knots {
	size_t order, count;
	double knots[12];
	const char *words;
};

static void bad_knots_are_refused(void **state)
{
	static const struct bad_knots cases[] = {
		{ 1, 4, { 0 }, "found order 1, expected 2..8" },
		{ 9, 12, { 0 }, "found order 9" },
		{ 4, 3, { 0 }, "found 3 poles, order 4 needs at least as many" },
		{ 2, 4097, { 0 }, "found 4097 poles, expected at most 4096" },
		{ 3, 4, { 0, 0, 0, 2, 1, 1, 1 }, "knots_u: knot 5 (1) is below the one before" },
		{ 3, 4, { 0, 0, 0, NAN, 1, 1, 1 }, "knot 4 is not finite" },
		{ 3, 4, { 0, 0, 0, 1, 1, INFINITY, 1 }, "knot 6 is not finite" },
		{ 3, 4, { 0, 0, 0, 1, 1, 1, 1e10 }, "knot 7 is not finite or beyond" },
		{ 3, 3, { 1, 1, 1, 1, 1, 1 }, "empty" },
		{ 3, 3, { 1e9, 1e9, 1e9, 1e9, 1e9, 1e9 }, "empty" },
		{ 3, 3, { 1e8, 1e8, 1e8, 1e8 + 1, 1e8 + 1, 1e8 + 1 }, "too small" },
		{ 3, 4, { 0, 0, 0, 0, 1, 1, 1 }, "knot 0 begins the range" },
		{ 3, 4, { 0, 0, 0, 1, 1, 1, 1 }, "knot 1 ends the range" },
		{ 3, 6, { 0, 0, 0, 1, 1, 1, 2, 2, 2 }, "knot 1 occurs more than 2 times" },
		{ 2, 4, { 0, 0, 1, 1, 2, 2 }, "knot 1 occurs more than 1 times" },
		{ 3, 5, { 0, 0, 0, 0.5, 0.5 + 1e-12, 1, 1, 1 }, "differ by less than" },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
		assert_refused(
			*state,
			bspline_knots_check(*state, "knots_u", cases[i].order, cases[i].count, cases[i].knots),
			BATTEN_USAGE, cases[i].words);
	static const double knuckle[] = { 0, 0, 0, 1, 1, 2, 2, 2 };
	assert_int_equal(bspline_knots_check(*state, "knots_u", 3, 5, knuckle), BATTEN_OK);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(known_values),
		cmocka_unit_test(sum_is_one_and_none_negative),
		cmocka_unit_test(powers_and_their_derivatives),
		cmocka_unit_test(continuity_at_knots),
		cmocka_unit_test(uniform_knots),
		cmocka_unit_test(greville_places),
		cmocka_unit_test(chord_lengths),
		cmocka_unit_test(averaged_knots),
		cmocka_unit_test(spread_knots),
		cmocka_unit_test(spread_knots_by_hand),
		cmocka_unit_test(bad_knots_are_refused),
	};
	return cmocka_run_group_tests(tests, make_context, end_context);
}
