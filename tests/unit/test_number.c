/* Numbers as text: the shortest decimal that reads back, as printf and strtod find it by trial. */
#include "core/number.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void check(double value)
{
	char found[BATTEN_NUMBER_SIZE], known[64];
	for (int digits = 15; digits <= 17; digits++) {
		(void)snprintf(known, sizeof known, "%.*g", digits, value);
		if (strtod(known, NULL) == value)
			break;
	}
	(void)batten_number_write(found, value);
	if (strcmp(found, known) != 0)
		fail_msg("%.17g: written %s, expected %s", value, found, known);
	double back = 0;
	assert_true(batten_number_read(found, strlen(found), &back));
	assert_memory_equal(&back, &value, sizeof value);
}

/* A value, its neighbours and their negatives. */
static void check_about(double value)
{
	const double beside[] = { value, nextafter(value, INFINITY), nextafter(value, 0) };
	for (size_t i = 0; i < 3; i++) {
		check(beside[i]);
		check(-beside[i]);
	}
}

static void test_powers(void **state)
{
	(void)state;
	for (int e = -60; e <= 60; e++) {
		char text[16];
		(void)snprintf(text, sizeof text, "1e%d", e / 3);
		check_about(ldexp(1, e));
		check_about(strtod(text, NULL));
		check_about(5 * strtod(text, NULL));
	}
	check_about(DBL_MIN);
	check_about(1e300);
	check(0);
	check(5e-324);
}

/* Numbers of few digits, of many, and of any bits. */
static void test_random(void **state)
{
	(void)state;
	uint64_t seed = 88172645463325252u;
	for (int i = 0; i < 50000; i++) {
		seed ^= seed << 13;
		seed ^= seed >> 7;
		seed ^= seed << 17;
		double bits = 0;
		memcpy(&bits, &seed, sizeof bits);
		if (isfinite(bits))
			check(bits);
		const double part = (double)(seed >> 11) * 0x1p-53;
		const double size = ldexp(1, (int)(seed % 64) - 14);
		check(part * size);
		check(round(part * 1e6) / 1e4);
		check((double)(seed >> (seed % 60)));
	}
}

static void test_what_is_no_number(void **state)
{
	(void)state;
	char text[BATTEN_NUMBER_SIZE];
	assert_string_equal(batten_number_write(text, NAN), "nan");
	assert_string_equal(batten_number_write(text, INFINITY), "inf");
	assert_string_equal(batten_number_write(text, -INFINITY), "-inf");
	assert_string_equal(batten_number_write(text, -0.0), "-0");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_powers),
		cmocka_unit_test(test_random),
		cmocka_unit_test(test_what_is_no_number),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
