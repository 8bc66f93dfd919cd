/* The rules that the C path and the kernel share, one by one. */
#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/grid_energy.h"
#include "shared/multilevel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* f(s) = a s^2 + b s, f(0) = 0: the bottom lies at -b / 2a. */
static double bottom_of(double a, double b, double h)
{
	return parabola_step(h, a * h * h + b * h, a * h * h - b * h);
}

static void test_parabola_step(void **state)
{
	(void)state;
	/* Numbers that double holds exactly. */
	assert_true(bottom_of(2.0, 1.0, 0.5) == -0.25);
	assert_true(bottom_of(2.0, -3.0, 0.5) == 0.75);
	assert_true(bottom_of(1.0, 0.0, 0.5) == 0.0);
	/* Never longer than 4 h: a longer step may leap into a spurious minimum. */
	assert_true(bottom_of(1.0, -8.0, 0.5) == 2.0);
	assert_true(bottom_of(1.0, 8.0, 0.5) == -2.0);
	assert_true(bottom_of(1.0, -3.5, 0.5) == 1.75);
	assert_true(bottom_of(0.0625, -64.0, 0.5) == 2.0);
	/* No bottom: a line, a hilltop, or no number at all. */
	assert_true(bottom_of(0.0, 1.0, 0.5) == 0.0);
	assert_true(bottom_of(-1.0, 1.0, 0.5) == 0.0);
	assert_true(parabola_step(0.5, (double)NAN, 1.0) == 0.0);
}

static void test_hat_height(void **state)
{
	(void)state;
	for (int width = 1; width <= 8; width *= 2)
		for (int offset = -10; offset <= 10; offset++) {
			const int distance = offset < 0 ? -offset : offset;
			const double expected = distance < width ? 1.0 - (double)distance / width : 0.0;
			assert_true(hat_height(offset, 1.0 / width) == expected);
		}
}

static void test_move_stays_in_its_box(void **state)
{
	(void)state;
	assert_true(move_clamped(1.0, 0.25, 0.0, 2.0) == 1.25);
	assert_true(move_clamped(1.0, 3.0, 0.0, 2.0) == 2.0);
	assert_true(move_clamped(1.0, -3.0, 0.5, 2.0) == 0.5);
	assert_true(move_clamped(1.0, -3.0, 1.0, 1.0) == 1.0);
}

/* Towards a bound nine tenths of the way at most, and not at all where rounding would land on it. */
static void test_move_stays_inside(void **state)
{
	(void)state;
	assert_true(move_inside(1.0, 0.25, 0.0, 2.0) == 1.25);
	assert_true(fabs(move_inside(1.0, 3.0, 0.0, 2.0) - 1.9) < 1e-15);
	assert_true(fabs(move_inside(1.0, -3.0, 0.5, 2.0) - 0.55) < 1e-15);
	assert_true(move_inside(1.0, -3.0, 1.0, 1.0) == 1.0);
	const double next = nextafter(1.0, 2.0);
	assert_true(move_inside(next, -1.0, 1.0, 2.0) == next);
	assert_true(move_inside(next, 1.0, 1.0, nextafter(next, 2.0)) == next);
}

/* r (1/g + 1/g'), whatever the width. */
static void test_node_penalty(void **state)
{
	(void)state;
	assert_true(node_penalty(1.0, 0.5, 0.0, 1.0) == 4.0);
	assert_true(node_penalty(0.5, 3.0, 2.0, 6.0) == 0.5 * (4.0 + 4.0 / 3.0));
	assert_true(node_penalty(1.0, 3.0, 3.0, 3.0) == 0.0);
	assert_true(isfinite(node_penalty(1.0, 1e-300, 0.0, 1e-299)));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_parabola_step),         cmocka_unit_test(test_hat_height),
		cmocka_unit_test(test_move_stays_in_its_box), cmocka_unit_test(test_move_stays_inside),
		cmocka_unit_test(test_node_penalty),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
