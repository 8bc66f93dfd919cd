/* surface.json: every bit comes back, and nothing else gets in. */
#include "batten.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

struct fixture {
	batten_context *context;
	char folder[64], path[128];
};

static int make_fixture(void **state)
{
	struct fixture *fixture = calloc(1, sizeof *fixture);
	assert_non_null(fixture);
	assert_int_equal(batten_context_create(NULL, &fixture->context), BATTEN_OK);
	(void)snprintf(fixture->folder, sizeof fixture->folder, "/tmp/batten-surface-XXXXXX");
	assert_non_null(mkdtemp(fixture->folder));
	(void)snprintf(fixture->path, sizeof fixture->path, "%s/surface.json", fixture->folder);
	*state = fixture;
	return 0;
}

static int end_fixture(void **state)
{
	struct fixture *fixture = *state;
	(void)unlink(fixture->path);
	assert_int_equal(rmdir(fixture->folder), 0); /* nothing else was left there */
	batten_context_destroy(fixture->context);
	free(fixture);
	return 0;
}

enum { COUNT_U = 4, COUNT_V = 3, POLES = COUNT_U * COUNT_V };
static const double knots_u[] = { -0.0, 0, 0, 0.1, 1.0 / 3.0 * 1e3, 1e3, 1234.5678901234567 };
static const double knots_v[] = { 0, 0, 0.5, 1, 1 };
static const double poles[3 * POLES] = { -0.0,
	                                     0.0,
	                                     1e-308,
	                                     4.9e-324,
	                                     0.1,
	                                     0.2,
	                                     0.30000000000000004,
	                                     1.0 / 3.0,
	                                     2.0 / 3.0,
	                                     1e9,
	                                     -1e9,
	                                     999999999.99999988,
	                                     123456789.01234567,
	                                     16777217,
	                                     2.2250738585072014e-308,
	                                     1.1102230246251565e-16,
	                                     -1e-5,
	                                     5,
	                                     16,
	                                     -3,
	                                     1e-7,
	                                     12.5,
	                                     1e5,
	                                     100000,
	                                     3.0,
	                                     2.0,
	                                     1.0,
	                                     0.5,
	                                     0.25,
	                                     0.125,
	                                     7,
	                                     8,
	                                     9,
	                                     10,
	                                     11,
	                                     -12 };
static const double weights[POLES] = { 1, 0.5, 1e-6, 2, 3, 1.0 / 7.0, 1, 1, 1, 1, 1, 1e6 };

static batten_surface *make_surface(batten_context *context, const char *name, bool rational)
{
	const batten_surface_net net = { .name = name,
		                             .order_u = 3,
		                             .order_v = 2,
		                             .count_u = COUNT_U,
		                             .count_v = COUNT_V,
		                             .knots_u = knots_u,
		                             .knots_v = knots_v,
		                             .poles_m = poles,
		                             .weights = rational ? weights : NULL };
	batten_surface *surface = NULL;
	if (batten_surface_create(context, &net, &surface) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return surface;
}

static void assert_same(const batten_surface *surface, const batten_surface *other)
{
	const batten_surface_net a = batten_surface_describe(surface);
	const batten_surface_net b = batten_surface_describe(other);
	assert_string_equal(a.name, b.name);
	assert_int_equal(a.order_u, b.order_u);
	assert_int_equal(a.order_v, b.order_v);
	assert_int_equal(a.count_u, b.count_u);
	assert_int_equal(a.count_v, b.count_v);
	assert_memory_equal(a.knots_u, b.knots_u, (a.count_u + a.order_u) * sizeof(double));
	assert_memory_equal(a.knots_v, b.knots_v, (a.count_v + a.order_v) * sizeof(double));
	assert_memory_equal(a.poles_m, b.poles_m, 3 * a.count_u * a.count_v * sizeof(double));
	assert_true((a.weights == NULL) == (b.weights == NULL));
	if (a.weights)
		assert_memory_equal(a.weights, b.weights, a.count_u * a.count_v * sizeof(double));
}

static batten_surface *read_back(const struct fixture *fixture)
{
	batten_surface *surface = NULL;
	if (batten_surface_read(fixture->context, fixture->path, &surface) != BATTEN_OK)
		fail_msg("%s", batten_context_error(fixture->context));
	return surface;
}

static void check_round_trip(const struct fixture *fixture, const char *name, bool rational)
{
	batten_surface *surface = make_surface(fixture->context, name, rational);
	assert_int_equal(batten_surface_write(fixture->context, surface, fixture->path), BATTEN_OK);
	batten_surface *found = read_back(fixture);
	assert_same(surface, found);
	batten_surface_destroy(found);
	batten_surface_destroy(surface);
}

static void test_round_trip(void **state)
{
	const struct fixture *fixture = *state;
	check_round_trip(fixture, "plain", false);
	check_round_trip(fixture, "rational", true);
	check_round_trip(fixture, "", false);
	check_round_trip(fixture, "\"quoted\\ \xc3\xbc\xe2\x82\xac/", true);
}

/* A sound file; each case below changes one thing. */
static const char sound[] =
	"{\"batten_surface\": 1, \"name\": \"n\", \"unit\": \"m\", \"frame\": \"ap-fwd\","
	" \"order_u\": 2, \"order_v\": 2, \"count_u\": 3, \"count_v\": 2, \"knots_u\": [0, 0, 0.5, 1, 1],"
	" \"knots_v\": [0, 0, 1, 1], \"poles\": [[[0, 0, 0], [1, 0.5, 0], [2, 0, 0]],"
	" [[0, 0, 1], [1, 0.75, 1], [2, 0, 1]]], \"weights\": [[1, 1, 1], [1, 2, 1]]}";

static const struct {
	const char *old, *new, *message;
} changes[] = {
	{ "{\"batten", "\"batten", "x.json:1:" },
	{ "\"batten_surface\": 1", "\"batten_surface\": 2",
	  "batten_surface: found 2, expected 1 to 1" },
	{ "\"batten_surface\": 1, ", "", "batten_surface: found nothing" },
	{ "\"batten_surface\": 1", "\"batten_surface\": 1.0", "batten_surface: found a number" },
	{ "\"n\"", "7", "name: found an integer, expected a text" },
	{ "\"n\"", "\"a\\nb\"", "name: found a control character" },
	{ "\"n\"", "\"a\\u0000b\"", "x.json:1:" },
	{ "\"n\"", "\"\xff\"", "x.json:1:" },
	{ "\"n\"", "\"a\nb\"", "x.json:1:" },
	{ "\"m\"", "\"mm\"", "unit: found another text, expected \"m\"" },
	{ "\"unit\": \"m\", ", "", "unit: found nothing, expected \"m\"" },
	{ "ap-fwd", "fp-aft", "frame: found another text, expected \"ap-fwd\"" },
	{ "\"order_u\": 2", "\"order_u\": 1", "order_u: found 1, expected 2 to 8" },
	{ "\"order_u\": 2", "\"order_u\": 9", "order_u: found 9, expected 2 to 8" },
	{ "\"order_v\": 2", "\"order_v\": \"2\"", "order_v: found a text, expected 2 to 8" },
	{ "\"count_u\": 3", "\"count_u\": 1", "count_u: found 1, expected 2 to 4096" },
	{ "\"count_u\": 3", "\"count_u\": 4096", "expected count_v = 2 rows of count_u = 4096" },
	{ "\"count_v\": 2", "\"count_v\": -2", "count_v: found -2, expected 2 to 4096" },
	{ "\"count_v\": 2", "\"count_v\": 99999999999999999999", "x.json:1:" },
	{ "[0, 0, 0.5, 1, 1]", "[0, 0, 0.5, 1]", "knots_u: found 4 entries, expected 5 numbers" },
	{ "[0, 0, 0.5, 1, 1]", "[0, 0, 1.5, 1, 1]", "x.json: knots_u" },
	{ "[0, 0, 0.5, 1, 1]", "[0, 0, 0, 1, 1]", "x.json: knots_u" },
	{ "[0, 0, 0.5, 1, 1]", "[1, 1, 1, 1, 1]", "x.json: knots_u" },
	{ "[0, 0, 0.5, 1, 1]", "[0, 0, null, 1, 1]", "knots_u[2]: found null, expected a number" },
	{ "[0, 0, 0.5, 1, 1]", "{}", "knots_u: found an object, expected an array of 5 numbers" },
	{ "[0, 0, 1, 1]", "[0, 0, NaN, 1]", "x.json:1:" },
	{ "[0, 0, 1, 1]", "[0, 0, 1e999, 1]", "x.json:1:" },
	{ "[0, 0, 1, 1]", "[0, 0, 1,5, 1]", "knots_v: found 5 entries" },
	{ "[0, 0, 1, 1]", "[0, 0, 0x1, 1]", "x.json:1:" },
	{ "[1, 0.5, 0]", "[1, 0.5]", "poles[0][1]: found 2 entries, expected 3 numbers" },
	{ "[1, 0.5, 0]", "0.5", "poles[0][1]: found a number, expected an array of 3 numbers" },
	{ "[1, 0.75, 1], ", "", "poles[1]: found an array of 2 entries, expected count_u = 3 poles" },
	{ "[1, 0.75, 1]", "[1, \"0.75\", 1]", "poles[1][1][1]: found a text, expected a number" },
	{ "[1, 2, 1]", "[1, 2]", "weights[1]: found 2 entries, expected 3 numbers" },
	{ "[1, 2, 1]", "[1, 0, 1]", "x.json: " },
	{ "[1, 2, 1]", "[1, -2, 1]", "x.json: " },
	{ "[[1, 1, 1], [1, 2, 1]]", "null", "weights: found null" },
	{ "\"weights\"", "\"heights\"", "found the member 'heights'" },
	{ "\"weights\"", "\"poles\"", "x.json:1:" },
	{ "\"weights\"", "\"he\\nights\"", "found the member 'he'" },
	{ "[1, 2, 1]]}", "[1, 2, 1]]} {}", "x.json:1:" },
	{ "[1, 2, 1]]}", "[1, 2, 1]]", "x.json:1:" },
};

static void check_refusal(batten_context *context, const char *text, size_t length,
                          const char *message)
{
	batten_surface *surface = NULL;
	const batten_status status = batten_surface_parse(context, "x.json", text, length, &surface);
	const char *said = batten_context_error(context);
	if (status != BATTEN_INPUT || surface)
		fail_msg("not refused (%d), '%s' was expected: %.*s", (int)status, message, (int)length,
		         text);
	if (strncmp(said, "x.json:", 7) != 0 || !strstr(said, message) || strchr(said, '\n'))
		fail_msg("found the message '%s', expected '%s'", said, message);
}

static void test_refusals(void **state)
{
	const struct fixture *fixture = *state;
	batten_surface *surface = NULL;
	assert_int_equal(
		batten_surface_parse(fixture->context, "x.json", sound, strlen(sound), &surface),
		BATTEN_OK);
	batten_surface_destroy(surface);
	for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
		char text[1024];
		const char *at = strstr(sound, changes[i].old);
		assert_non_null(at);
		(void)snprintf(text, sizeof text, "%.*s%s%s", (int)(at - sound), sound, changes[i].new,
		               at + strlen(changes[i].old));
		check_refusal(fixture->context, text, strlen(text), changes[i].message);
	}
	static const char *const others[] = { "", " ", "[]", "7", "null", "{}", "\"text\"", "[[[[[[" };
	for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
		check_refusal(fixture->context, others[i], strlen(others[i]), "");
	for (size_t length = 0; length + 1 < sizeof sound - 1; length++)
		check_refusal(fixture->context, sound, length, "");
}

/* Arrays within arrays without end are refused, not followed. */
static void test_deep(void **state)
{
	const struct fixture *fixture = *state;
	const size_t depth = 1000000;
	char *text = malloc(depth);
	assert_non_null(text);
	memset(text, '[', depth);
	check_refusal(fixture->context, text, depth, "");
	free(text);
}

/* Bytes changed at random: what is accepted is a surface that comes back, the rest is refused in
 * one line. */
static void test_changed_bytes(void **state)
{
	const struct fixture *fixture = *state;
	uint64_t seed = 12345;
	size_t accepted = 0;
	for (int k = 0; k < 20000; k++) {
		char text[sizeof sound];
		memcpy(text, sound, sizeof sound);
		for (int change = 0; change < 1 + k % 3; change++) {
			seed = seed * 6364136223846793005u + 1442695040888963407u;
			const size_t place = (size_t)(seed >> 33) % (sizeof sound - 1);
			static const char bytes[] = "0123456789-+.eE,:[]{}\" \n\\\x01\xff";
			text[place] = bytes[(size_t)(seed >> 20) % (sizeof bytes - 1)];
		}
		batten_surface *surface = NULL;
		const batten_status status = batten_surface_parse(fixture->context, "x.json", text,
		                                                  sizeof sound - 1, &surface);
		if (status == BATTEN_OK) {
			accepted++;
			batten_surface_point at;
			assert_int_equal(batten_surface_evaluate(surface, 0.3, 0.4, &at), BATTEN_OK);
			if (accepted % 50 == 0) {
				assert_int_equal(batten_surface_write(fixture->context, surface, fixture->path),
				                 BATTEN_OK);
				batten_surface *found = read_back(fixture);
				assert_same(surface, found);
				batten_surface_destroy(found);
			}
			batten_surface_destroy(surface);
			continue;
		}
		assert_int_equal(status, BATTEN_INPUT);
		assert_null(surface);
		assert_int_equal(strncmp(batten_context_error(fixture->context), "x.json:", 7), 0);
		assert_null(strchr(batten_context_error(fixture->context), '\n'));
	}
	assert_true(accepted > 100 && accepted < 20000);
}

static void test_files(void **state)
{
	const struct fixture *fixture = *state;
	char path[256];
	batten_surface *surface = NULL;
	assert_int_equal(batten_surface_read(fixture->context, fixture->path, &surface), BATTEN_IO);
	assert_int_equal(batten_surface_read(fixture->context, fixture->folder, &surface), BATTEN_IO);
	assert_null(surface);
	surface = make_surface(fixture->context, "n", false);
	(void)snprintf(path, sizeof path, "%s/none/surface.json", fixture->folder);
	assert_int_equal(batten_surface_write(fixture->context, surface, path), BATTEN_IO);
	assert_non_null(strstr(batten_context_error(fixture->context), path));
	batten_surface_destroy(surface);
}

/* A text larger than the memory allowed for it. */
static void test_memory_limit(void **state)
{
	(void)state;
	batten_context_options options;
	batten_context_options_default(&options);
	options.max_memory = 40 * 100;
	batten_context *context = NULL;
	batten_surface *surface = NULL;
	assert_int_equal(batten_context_create(&options, &context), BATTEN_OK);
	assert_int_equal(batten_surface_parse(context, "x.json", sound, strlen(sound), &surface),
	                 BATTEN_INPUT);
	assert_string_equal(batten_context_error(context), "x.json: longer than 100 bytes");
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_round_trip, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_refusals, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_deep, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_changed_bytes, make_fixture, end_fixture),
		cmocka_unit_test_setup_teardown(test_files, make_fixture, end_fixture),
		cmocka_unit_test(test_memory_limit),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
