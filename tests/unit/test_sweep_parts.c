/* Parts of a sweep that stand alone: expressions, the best so far, the non-dominated ones, shards. */
#include "sweep/best.h"
#include "sweep/expression.h"
#include "sweep/front.h"
#include "sweep/random.h"
#include "sweep/store.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static int make_context(void **state)
{
	return batten_context_create(NULL, (batten_context **)state) == BATTEN_OK ? 0 : -1;
}

static int drop_context(void **state)
{
	batten_context_destroy(*state);
	return 0;
}

/* a, b, c are numbers 0, 1, 2. */
static size_t look_up(const char *name, size_t length, const void *user)
{
	(void)user;
	return length == 1 && name[0] >= 'a' && name[0] <= 'c' ? (size_t)(name[0] - 'a') : SIZE_MAX;
}

static void expressions_have_the_value_of_their_arithmetic(void **state)
{
	(void)state;
	static const double numbers[3] = { 2, 5, -3 };
	static const struct {
		const char *text;
		double value;
	} cases[] = {
		{ "1", 1 },
		{ "a", 2 },
		{ " a + b * c ", -13 },
		{ "(a + b) * c", -21 },
		{ "b - a - c", 6 },
		{ "b / a / 2", 1.25 },
		{ "-a * -b", 10 },
		{ "--a", 2 },
		{ "sqrt(a * 8) + abs(c)", 7 },
		{ "min(a, b) - max(a, min(b, 4))", -2 },
		{ "1.5e2 - .5", 149.5 },
		{ "1e-1 * 10", 1 },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		sweep_expression parsed;
		expression_fault fault;
		assert_true(expression_parse(cases[i].text, look_up, NULL, &parsed, &fault));
		assert_true(expression_value(&parsed, numbers) == cases[i].value);
	}
	static const double missing[3] = { NAN, 5, -3 };
	sweep_expression parsed;
	expression_fault fault;
	assert_true(expression_parse("max(a, b)", look_up, NULL, &parsed, &fault));
	assert_true(isnan(expression_value(&parsed, missing)));
	assert_true(expression_parse("max(b, a)", look_up, NULL, &parsed, &fault));
	assert_true(isnan(expression_value(&parsed, missing)));
}

static void other_texts_are_refused_where_they_go_wrong(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		size_t at;
	} cases[] = {
		{ "", 0 },       { "a +", 3 },    { "d", 0 },      { "a b", 2 },        { "(a", 2 },
		{ "a)", 1 },     { "sin(a)", 0 }, { "min(a)", 5 }, { "sqrt(a, b)", 6 }, { "1..2", 0 },
		{ "a ** b", 3 }, { "1e", 0 },     { "a ^ 2", 2 },  { "abc * 2", 0 },    { "a + \x01", 4 },
	};
	for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
		sweep_expression parsed;
		expression_fault fault;
		assert_false(expression_parse(cases[i].text, look_up, NULL, &parsed, &fault));
		assert_int_equal(fault.at, cases[i].at);
	}
	char deep[200];
	memset(deep, '(', sizeof deep - 1);
	deep[sizeof deep - 1] = '\0';
	char steps[1200];
	for (size_t i = 0; i + 2 < sizeof steps; i += 2)
		memcpy(steps + i, "1+", 3);
	sweep_expression parsed;
	expression_fault fault;
	assert_false(expression_parse(deep, look_up, NULL, &parsed, &fault));
	assert_false(expression_parse(steps, look_up, NULL, &parsed, &fault));
}

/* Against a sort of all, in two orders; many keys are equal. */
static void the_best_are_those_of_a_sort(void **state)
{
	enum { COUNT = 300, BEST = 40 };
	for (int backwards = 0; backwards < 2; backwards++) {
		sweep_best best;
		bool in[COUNT] = { false };
		assert_int_equal(sweep_best_create(*state, BEST, &best), BATTEN_OK);
		for (uint64_t n = 0; n < COUNT; n++) {
			const uint64_t i = backwards ? COUNT - 1 - n : n;
			const double key = i % 17 == 0 ? NAN : (double)(sweep_random(1, i, 0, 0) % 50);
			uint64_t dropped = 0;
			in[i] = sweep_best_offer(&best, (best_entry){ key, i }, &dropped);
			if (dropped != UINT64_MAX) {
				assert_true(in[dropped]);
				in[dropped] = false;
			}
		}
		for (uint64_t i = 0; i < COUNT; i++) {
			if (i % 17 == 0) {
				assert_false(in[i]);
				continue;
			}
			size_t better = 0;
			const uint64_t key = sweep_random(1, i, 0, 0) % 50;
			for (uint64_t j = 0; j < COUNT; j++) {
				const uint64_t other = sweep_random(1, j, 0, 0) % 50;
				better += j % 17 != 0 && (other < key || (other == key && j < i));
			}
			assert_int_equal(in[i], better < BEST);
		}
		sweep_best_release(&best);
	}
}

/* Against every pair; values are coarse, so that many are equal. */
static void the_front_is_what_nothing_dominates(void **state)
{
	enum { COUNT = 200, OBJECTIVES_MOST = 4 };
	for (size_t objectives = 1; objectives <= OBJECTIVES_MOST; objectives++) {
		double values[COUNT * OBJECTIVES_MOST];
		uint8_t on_front[COUNT];
		for (size_t i = 0; i < COUNT * objectives; i++)
			values[i] = (double)(sweep_random(2, i, (uint32_t)objectives, 0) % 12);
		assert_int_equal(sweep_front_find(*state, COUNT, objectives, values, on_front), BATTEN_OK);
		size_t size = 0;
		for (size_t i = 0; i < COUNT; i++) {
			bool dominated = false;
			for (size_t j = 0; j < COUNT; j++) {
				bool no_worse = true;
				bool better = false;
				for (size_t o = 0; o < objectives; o++) {
					const double a = values[j * objectives + o];
					const double b = values[i * objectives + o];
					no_worse = no_worse && a <= b;
					better = better || a < b;
				}
				dominated = dominated || (no_worse && better);
			}
			assert_int_equal(on_front[i], !dominated);
			size += on_front[i];
		}
		assert_true(size > 0 && size < COUNT);
	}
}

static void shards_cover_a_sweep_once(void **state)
{
	(void)state;
	static const uint64_t counts[] = { 1, 7, 100, 101, (uint64_t)1 << 62 };
	for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++)
		for (uint64_t shards = 1; shards <= 13; shards++) {
			uint64_t next = 0;
			for (uint64_t s = 1; s <= shards; s++) {
				const sweep_shard shard = sweep_shard_of(counts[c], s, shards);
				assert_true(shard.first == next && shard.end >= shard.first);
				assert_true(shard.end - shard.first <= counts[c] / shards + 1);
				next = shard.end;
			}
			assert_true(next == counts[c]);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(expressions_have_the_value_of_their_arithmetic),
		cmocka_unit_test(other_texts_are_refused_where_they_go_wrong),
		cmocka_unit_test_setup_teardown(the_best_are_those_of_a_sort, make_context, drop_context),
		cmocka_unit_test_setup_teardown(the_front_is_what_nothing_dominates, make_context,
		                                drop_context),
		cmocka_unit_test(shards_cover_a_sweep_once),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
