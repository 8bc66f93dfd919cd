/* Roots of functions within a box: several, none, and those that only touch. */
#include "variation/roots.h"
#include "variation/three_body.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void assert_near(double value, double expected, double tolerance)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("found %.17g, expected %.17g within %g", value, expected, tolerance);
}

static struct roots find(size_t count, double least, double most, double start,
                         roots_function *function, void *user)
{
	struct roots roots;
	struct roots_task task = {
		.count = count, .tolerance = 1e-12, .function = function, .user = (void *)(uintptr_t)user
	};
	for (size_t i = 0; i < count; i++) {
		task.least[i] = least;
		task.most[i] = most;
		task.start[i] = start;
	}
	assert_int_equal(roots_find(&task, &roots), BATTEN_OK);
	return roots;
}

static batten_status cubic(void *user, const double *at, double *out)
{
	(void)user;
	*out = (*at - 1) * (*at - 2) * (*at + 3);
	return BATTEN_OK;
}

static batten_status parabola(void *user, const double *at, double *out)
{
	*out = (*at - 0.7) * (*at - 0.7) + *(const double *)user;
	return BATTEN_OK;
}

static batten_status steep(void *user, const double *at, double *out)
{
	(void)user;
	*out = atan(1e3 * (*at - 0.123456789));
	return BATTEN_OK;
}

static batten_status half(void *user, const double *at, double *out)
{
	if (*at < 0)
		return BATTEN_INPUT;
	return cubic(user, at, out);
}

static void one_number(void **state)
{
	(void)state;
	struct roots roots = find(1, -5, 5, 0.2, cubic, NULL);
	assert_int_equal(roots.count, 3);
	assert_near(roots.at[0][0], 1, 1e-12);
	assert_near(roots.at[1][0], 2, 1e-12);
	assert_near(roots.at[2][0], -3, 1e-12);
	/* a root on a place that is looked at, and at the ends of the box */
	roots = find(1, 1, 2, 1, cubic, NULL);
	assert_int_equal(roots.count, 2);
	assert_true(roots.at[0][0] == 1 && roots.at[1][0] == 2);
	/* where Newton's step is of no use */
	roots = find(1, -1, 1, 0.9, steep, NULL);
	assert_int_equal(roots.count, 1);
	assert_near(roots.at[0][0], 0.123456789, 1e-14);
	/* no values below 0 */
	roots = find(1, -5, 5, 0, half, NULL);
	assert_int_equal(roots.count, 2);
}

static void touching(void **state)
{
	(void)state;
	double on = 0, above = 1e-6, below = -1e-6;
	struct roots roots = find(1, -4, 4, 0, parabola, &on);
	assert_int_equal(roots.count, 1);
	assert_near(roots.at[0][0], 0.7, 1e-6);
	roots = find(1, -4, 4, 0, parabola, &above);
	assert_int_equal(roots.count, 0);
	assert_near(roots.nearest[0], 0.7, 1e-5);
	assert_near(roots.off, 1e-6, 1e-10);
	roots = find(1, -4, 4, 0, parabola, &below);
	assert_true(roots.count >= 1); /* 0.699 and 0.701, between two of the places looked at */
	assert_near(fabs(roots.at[0][0] - 0.7), 1e-3, 1e-9);
}

static batten_status circle(void *user, const double *at, double *out)
{
	out[0] = at[0] * at[0] + at[1] * at[1] - *(const double *)user;
	out[1] = at[0] - at[1];
	return BATTEN_OK;
}

static void two_numbers(void **state)
{
	(void)state;
	double two = 2, none = -1, far = 50;
	struct roots roots = find(2, -3, 3, 0.5, circle, &two);
	assert_int_equal(roots.count, 2);
	for (size_t i = 0; i < 2; i++) {
		assert_near(roots.at[0][i], 1, 1e-12);
		assert_near(roots.at[1][i], -1, 1e-12);
	}
	roots = find(2, -3, 3, 0.5, circle, &none);
	assert_int_equal(roots.count, 0);
	assert_true(roots.off >= 1 && roots.off < 1.1);
	roots = find(2, -3, 3, 0.5, circle, &far); /* roots outside the box: the corner comes nearest */
	assert_int_equal(roots.count, 0);
	assert_near(roots.off, 32, 1e-9);
}

/* ------------------------------------------------------------------------------------------------
 * Three bodies as a form-parameter problem (Letcher 10.4): wedge fore, parabolic aft
 * --------------------------------------------------------------------------------------------- */

static const three_body wedge = { .length = { 0.4, 0.1, 0.5 },
	                              .volume = { 0.2, 0.1, 1.0 / 3 },
	                              .centre = { 2.0 / 3, 0.5, 3.0 / 8 },
	                              .waterline = { 1, 1, 1 },
	                              .section_area = 1 };

static batten_status bodies(void *user, const double *at, double *out)
{
	const three_body_target *asked = user;
	const three_body_target got = three_body_measure(&wedge, at);
	out[0] = got.volume - asked->volume;
	out[1] = got.centre - asked->centre;
	out[2] = got.cp - asked->cp;
	return BATTEN_OK;
}

/* The second root has bodies of negative length: it lies outside every box that means anything. */
static void second_root_is_rejected(void **state)
{
	(void)state;
	three_body_target asked = { 19.0 / 30, 0.52, 0.66 };
	struct roots roots = find(3, 0.1, 4, 1, bodies, &asked);
	assert_int_equal(roots.count, 1);
	assert_near(roots.at[0][0], 0.91521804677335, 1e-10);
	assert_near(roots.at[0][1], 1.63851690162751, 1e-10);
	assert_near(roots.at[0][2], 0.859314101447738, 1e-10);
	roots = find(3, -80, 80, 1, bodies, &asked);
	assert_int_equal(roots.count, 2);
	assert_near(roots.at[0][0], 0.91521804677335, 1e-10);
	assert_near(roots.at[1][0], -29.127, 1e-3);
	assert_near(roots.at[1][1], -58.447, 1e-3);
	assert_near(roots.at[1][2], 36.910, 1e-3);
}

struct calls {
	size_t count, numbers;
};

static batten_status failing(void *user, const double *at, double *out)
{
	struct calls *calls = user;
	for (size_t i = 0; i < calls->numbers; i++)
		out[i] = at[i] + 2 * (double)i;
	return ++calls->count == 5 ? BATTEN_MEMORY : BATTEN_OK;
}

static void failures_end_it(void **state)
{
	(void)state;
	struct roots roots;
	for (size_t count = 1; count <= 2; count++) {
		struct calls calls = { 0, count };
		const struct roots_task task = { .count = count,
			                             .least = { -1, -1 },
			                             .most = { 1, 1 },
			                             .start = { 0.9, 0.9 },
			                             .tolerance = 1e-12,
			                             .function = failing,
			                             .user = &calls };
		assert_int_equal(roots_find(&task, &roots), BATTEN_MEMORY);
		assert_int_equal(calls.count, 5);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(one_number),      cmocka_unit_test(touching),
		cmocka_unit_test(two_numbers),     cmocka_unit_test(second_root_is_rejected),
		cmocka_unit_test(failures_end_it),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
