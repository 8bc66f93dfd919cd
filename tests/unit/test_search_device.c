/* The search on OpenCL: its self-test, its default shapes against the C path, two devices on one
 * queue, and what happens when a device fails. Runs with two PoCL devices. */
#include "support/cases.h"
#include "support/search_equal.h"

#include "device/device.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void test_selftest_is_equal(void **state)
{
	(void)state;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	const size_t devices = batten_device_count(context, NULL);
	assert_int_equal(devices, 2);
	size_t built = 0;
	for (size_t d = 0; d < CASES(devices, 1); d++) {
		batten_selftest tests[32];
		size_t count = 0;
		assert_int_equal(batten_device_selftest(context, d, NULL, tests, 32, &count), BATTEN_OK);
		for (size_t t = 0; t < count; t++) {
			assert_int_equal(tests[t].result, BATTEN_SELFTEST_EQUAL);
			/* The smallest are the passes: 17 hulls of 22 values in f64. */
			assert_true(tests[t].compared >= 374);
			assert_int_equal(tests[t].different, 0);
			built++;
		}
	}
	/* f64 and f32 of eight kernels on each device, f64 of those of variants and of surfaces afloat. */
	assert_int_equal(built, CASES(36, 18));
	batten_selftest test;
	size_t count = 0;
	assert_int_equal(batten_device_selftest(context, 99, NULL, &test, 1, &count), BATTEN_DEVICE);
	/* Each alone, by its name. */
	for (size_t k = 0; batten_device_kernel_name(k); k++) {
		const char *name = batten_device_kernel_name(k);
		assert_int_equal(batten_device_selftest(context, 0, name, &test, 1, &count), BATTEN_OK);
		assert_string_equal(test.kernel, name);
		assert_true(count == 1 || count == 2);
	}
	assert_int_equal(batten_device_selftest(context, 0, "block", &test, 1, &count), BATTEN_USAGE);
	assert_non_null(strstr(batten_context_error(context), "block"));
	batten_context_destroy(context);
}

static void test_default_shapes_equal_the_c_path(void **state)
{
	(void)state;
	search_case c = search_case_open("npl_parent", 0.01, true);
	search_equal_check(&c,
	                   &(search_shape){ 0, BATTEN_F64, 8, 1, false, GRID_BENDING, false, false });
	search_equal_check(&c,
	                   &(search_shape){ 0, BATTEN_F32, 16, 1, false, GRID_BENDING, false, false });
	search_equal_check(&c,
	                   &(search_shape){ 0, BATTEN_F64, 8, 1, false, GRID_BENDING, true, false });
	search_equal_check(&c,
	                   &(search_shape){ 0, BATTEN_F32, 16, 1, false, GRID_BENDING, true, false });
	search_case_close(&c);
}

/* Runs the first iterations of the case's searches as a batch on a device, or all. */
static batten_status run_batch(const search_case *c, int device, double *y,
                               batten_search_result *results, batten_run *run)
{
	batten_search_problem problems[EQUAL_COUNT];
	search_equal_problems(c, problems);
	batten_search_options options;
	batten_search_options_default(&options);
	options.device = device;
	options.iteration_limit = 3;
	return batten_search_batch(c->context, &c->grid, EQUAL_COUNT, problems, &options, y, results,
	                           run);
}

typedef struct ends {
	double *y, *known_y;
	batten_search_result results[EQUAL_COUNT], known[EQUAL_COUNT];
	batten_run run;
} ends;

static ends ends_create(const search_case *c)
{
	ends e = { .y = calloc(EQUAL_COUNT * c->nodes, sizeof(double)),
		       .known_y = calloc(EQUAL_COUNT * c->nodes, sizeof(double)) };
	assert_non_null(e.y);
	assert_non_null(e.known_y);
	assert_int_equal(run_batch(c, BATTEN_DEVICE_REFERENCE, e.known_y, e.known, &e.run),
	                 BATTEN_INCOMPLETE);
	assert_string_equal(e.run.device, "reference");
	return e;
}

static void ends_release(ends *e)
{
	free(e->y);
	free(e->known_y);
}

static void test_all_devices_on_one_queue(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 0.01, false);
	ends e = ends_create(&c);
	assert_int_equal(run_batch(&c, BATTEN_DEVICE_AUTO, e.y, e.results, &e.run), BATTEN_INCOMPLETE);
	assert_true(e.run.strict);
	assert_non_null(strstr(e.run.device, " + "));
	assert_string_equal(e.run.warning, "");
	search_equal_compare(&c, e.y, e.results, e.known_y, e.known);
	ends_release(&e);
	search_case_close(&c);
}

/* A device that fails gives its searches back: with `auto` they are done all the same and a warning
 * says so, with an index the failure is reported. */
static void test_failing_device_gives_back(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 0.01, false);
	ends e = ends_create(&c);
	assert_int_equal(run_batch(&c, BATTEN_DEVICE_AUTO, e.y, e.results, &e.run), BATTEN_INCOMPLETE);
	size_t warned = 0;
	for (unsigned long k = 1; k <= 24; k++) {
		memset(e.y, 0, EQUAL_COUNT * c.nodes * sizeof *e.y);
		(void)device_fail_call(k);
		const batten_status status = run_batch(&c, BATTEN_DEVICE_AUTO, e.y, e.results, &e.run);
		(void)device_fail_call(0);
		assert_int_equal(status, BATTEN_INCOMPLETE);
		search_equal_compare(&c, e.y, e.results, e.known_y, e.known);
		warned += e.run.warning[0] != '\0';
	}
	assert_true(warned >= 10);
	(void)device_fail_call(1);
	assert_int_equal(run_batch(&c, 0, e.y, e.results, &e.run), BATTEN_DEVICE);
	(void)device_fail_call(0);
	assert_true(batten_context_error(c.context)[0] != '\0');
	ends_release(&e);
	search_case_close(&c);
}

static void test_absent_device_is_named(void **state)
{
	(void)state;
	search_case c = search_case_open("wigley_noisy", 0.01, false);
	ends e = ends_create(&c);
	assert_int_equal(run_batch(&c, 7, e.y, e.results, &e.run), BATTEN_DEVICE);
	assert_non_null(strchr(batten_context_error(c.context), '7'));
	ends_release(&e);
	search_case_close(&c);
}

int main(void)
{
	/* Before OpenCL is first opened. */
	(void)setenv("POCL_DEVICES", "pthread pthread", 1);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_selftest_is_equal),
		cmocka_unit_test(test_default_shapes_equal_the_c_path),
		cmocka_unit_test(test_all_devices_on_one_queue),
		cmocka_unit_test(test_failing_device_gives_back),
		cmocka_unit_test(test_absent_device_is_named),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
