/* Three bodies stretched (Letcher 10.4): closed forms of synthetic parents of unit length and area. */
#include "variation/three_body.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Ends of 0.4 and 0.5 of the length about a middle body of 0.1. */
static three_body body_of(double fullness_fore, double centre_fore)
{
	return (three_body){ .length = { 0.4, 0.1, 0.5 },
		                 .volume = { 0.4 * fullness_fore, 0.1, 0.5 * 2 / 3 },
		                 .centre = { centre_fore, 0.5, 0.375 },
		                 .waterline = { 1, 1, 1 },
		                 .section_area = 1 };
}

static void assert_near(double value, double expected, double tolerance)
{
	if (!(fabs(value - expected) <= tolerance))
		fail_msg("%.17g where %.17g is expected", value, expected);
}

static void check(const three_body *body, three_body_target target, const double expected[3],
                  size_t expected_rejected)
{
	double factors[2][3];
	size_t rejected = 99;
	assert_int_equal(three_body_solve(body, &target, factors, &rejected), 1);
	assert_int_equal(rejected, expected_rejected);
	for (size_t i = 0; i < 3; i++)
		assert_near(factors[0][i], expected[i], 1e-11);
	const three_body_target got = three_body_measure(body, factors[0]);
	assert_near(got.volume, target.volume, 1e-13);
	assert_near(got.centre, target.centre, 1e-13);
	assert_near(got.cp, target.cp, 1e-13);
}

static void test_parabolic_ends(void **state)
{
	(void)state;
	const three_body body = body_of(2.0 / 3, 0.625);
	const double one[3] = { 1, 1, 1 };
	const three_body_target parent = three_body_measure(&body, one);
	assert_near(parent.volume, 0.7, 1e-15);
	assert_near(parent.centre, 409.0 / 840, 1e-15);
	assert_near(parent.cp, 0.7, 1e-15);
	/* mirrored ends leave one equation linear: one solution */
	check(&body, parent, one, 0);
	check(&body, (three_body_target){ 0.7, 0.5, 0.7 }, (double[]){ 1.125, 1, 0.9 }, 0);
	check(&body, (three_body_target){ 0.7, 0.5, 0.72 },
	      (double[]){ 49.0 / 48, 14.0 / 9, 49.0 / 60 }, 0);
	check(&body, (three_body_target){ 0.77, 0.51, 0.71 },
	      (double[]){ 1.28161379783, 1.40985915493, 0.861751215256 }, 0);
}

static void test_wedge(void **state)
{
	(void)state;
	const three_body body = body_of(0.5, 2.0 / 3);
	const double one[3] = { 1, 1, 1 };
	const three_body_target parent = three_body_measure(&body, one);
	assert_near(parent.volume, 19.0 / 30, 1e-15);
	assert_near(parent.centre, 393.0 / 760, 1e-15);
	/* the second solution stretches two bodies by less than 0 */
	check(&body, (three_body_target){ 19.0 / 30, 0.52, 0.66 },
	      (double[]){ 0.91521804677335, 1.63851690162751, 0.859314101447738 }, 1);
	check(&body, (three_body_target){ 2.0 / 3, 0.53, 0.65 },
	      (double[]){ 1.06887677069361, 1.62493302856671, 0.871194029013822 }, 1);
}

static void test_none(void **state)
{
	(void)state;
	const three_body body = body_of(0.5, 2.0 / 3);
	double factors[2][3];
	size_t rejected = 0;
	/* fuller than a box */
	assert_int_equal(
		three_body_solve(&body, &(three_body_target){ 0.6, 0.5, 1.2 }, factors, &rejected), 0);
	/* a box all along: length and volume say the same */
	three_body box = body;
	for (size_t i = 0; i < 3; i++)
		box.volume[i] = box.length[i];
	assert_int_equal(
		three_body_solve(&box, &(three_body_target){ 1.1, 0.5, 1 }, factors, &rejected), 0);
	assert_int_equal(rejected, 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_parabolic_ends),
		cmocka_unit_test(test_wedge),
		cmocka_unit_test(test_none),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
