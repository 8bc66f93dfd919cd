/* Passes in other shapes than the usual one: lanes and work-items change no bit of a hull. */
#include "support/kernel_compile.h"
#include "unit/pass_fixture.h"

enum { HULLS = 37, ITERATIONS = 2 };

static batten_pass *make_pass(batten_context *context, const batten_hull *hull, int method,
                              int device, unsigned lanes, unsigned work_group)
{
	batten_pass_options options;
	batten_pass *pass = NULL;
	batten_pass_options_default(&options);
	options.method = (batten_fair_method)method;
	options.order = 4;
	options.order_sections = 3;
	options.lanes = lanes;
	options.work_group = work_group;
	options.device = device;
	if (batten_pass_create(context, hull, &options, &pass) != BATTEN_OK)
		fail_msg("%s", batten_context_error(context));
	return pass;
}

static void test_shapes(void **state)
{
	static const unsigned shapes[][2] = { { 1, 4 }, { 4, 3 }, { 8, 1 } };
	batten_hull *hull = read_hull(*state, "npl_parent");
	kernels_unoptimised(true);
	for (int m = BATTEN_METHOD_FORWARD_APPROXIMATION; m <= BATTEN_METHOD_INVERSE; m++) {
		batten_pass *plain = make_pass(*state, hull, m, BATTEN_DEVICE_REFERENCE, 0, 0);
		const size_t values = batten_pass_describe(plain).value_count;
		double *y = malloc(3 * HULLS * values * sizeof *y);
		assert_non_null(y);
		double *known = y + HULLS * values;
		double *found = known + HULLS * values;
		for (size_t h = 0; h < HULLS; h++)
			batten_pass_values(plain, hull, y + h * values);
		for (size_t n = 0; n < HULLS * values; n++)
			y[n] *= 1 + 1e-3 * (double)(n * 7919 % 1013) / 1013;
		assert_int_equal(batten_pass_batch(*state, plain, HULLS, ITERATIONS, y, known, NULL),
		                 BATTEN_OK);
		for (size_t s = 0; s < sizeof shapes / sizeof shapes[0]; s++) {
			batten_pass *pass = make_pass(*state, hull, m, 0, shapes[s][0], shapes[s][1]);
			assert_int_equal(batten_pass_batch(*state, pass, HULLS, ITERATIONS, y, found, NULL),
			                 BATTEN_OK);
			assert_memory_equal(found, known, HULLS * values * sizeof *found);
			batten_pass_destroy(pass);
		}
		free(y);
		batten_pass_destroy(plain);
	}
	batten_hull_destroy(hull);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_shapes, make_context, end_context),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
