/* Batches of surfaces on devices: bits of the C path in the default shapes, failing devices. */
#include "support/surface_case.h"

#include "device/device.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void test_default_shapes_equal_the_c_path(void **state)
{
	(void)state;
	for (int rational = 0; rational < 2; rational++) {
		surface_case c = surface_case_open(4, 4, rational);
		for (int f32 = 0; f32 < 2; f32++) {
			const batten_surface_batch_options options = surface_case_options(
				0, f32 ? BATTEN_F32 : BATTEN_F64, BATTEN_SURFACE_EVERYTHING);
			surface_case_compare(&c, &options);
		}
		surface_case_close(&c);
	}
}

/* Lines shorter and longer than the lanes, values at every place in a line of the cache: runs overlap
 * at both ends of a line, and nothing beside the values is written. */
static void test_runs_of_any_length_and_place(void **state)
{
	(void)state;
	enum { MOST = 40, PLACES = 16, VALUES = SURFACE_CASE_COUNT * 2 * MOST };
	static double known[VALUES];
	static float found[VALUES + PLACES + 1];
	surface_case c = surface_case_open(4, 3, false);
	const batten_surface *const *surfaces = (const batten_surface *const *)c.surfaces;
	for (size_t n = 1; n <= MOST; n += n < 18 ? 1 : 11) {
		double u[MOST];
		const double v[2] = { c.v[0], c.v[1] };
		for (size_t i = 0; i < n; i++)
			u[i] = c.u[i % c.samples.u_count];
		const batten_surface_samples samples = { n, 1, u, v };
		batten_surface_batch_options options = surface_case_options(
			BATTEN_DEVICE_REFERENCE, BATTEN_F32, BATTEN_SURFACE_CURVATURE);
		assert_int_equal(batten_surface_grid_batch(c.context, c.count, surfaces, &samples, &options,
		                                           known, NULL, NULL),
		                 BATTEN_OK);
		options.device = 0;
		for (size_t place = 0; place < PLACES; place += n % 3 + 1) {
			const size_t numbers = c.count * 2 * n;
			memset(found, 0x5a, sizeof found);
			const float untouched = found[0];
			assert_int_equal(batten_surface_grid_batch_float(c.context, c.count, surfaces, &samples,
			                                                 &options, found + place, NULL, NULL),
			                 BATTEN_OK);
			for (size_t i = 0; i < numbers; i++)
				assert_true((double)found[place + i] == known[i]);
			assert_true(place == 0 || found[place - 1] == untouched);
			assert_true(found[place + numbers] == untouched);
		}
	}
	surface_case_close(&c);
}

/* Values as floats are the same as doubles, singular points too; on a device the output that is made
 * in bulk. */
static void test_floats_are_the_values(void **state)
{
	(void)state;
	surface_case c = surface_case_open(4, 4, false);
	c.samples.u = c.u;
	c.samples.v = c.v;
	const batten_surface *const *surfaces = (const batten_surface *const *)c.surfaces;
	for (int output = BATTEN_SURFACE_POSITION; output <= BATTEN_SURFACE_EVERYTHING; output++)
		for (int device = 0; device <= (output == BATTEN_SURFACE_CURVATURE); device++) {
			batten_surface_batch_options options = surface_case_options(
				device ? 0 : BATTEN_DEVICE_REFERENCE, BATTEN_F32, (batten_surface_output)output);
			const size_t numbers = surface_case_values(&c, options.output);
			const size_t points = c.count * surface_case_samples(&c);
			double *values = calloc(numbers, sizeof *values);
			float *floats = calloc(numbers, sizeof *floats);
			uint8_t *singular = calloc(2, points);
			assert_true(values && floats && singular);
			assert_int_equal(batten_surface_grid_batch(c.context, c.count, surfaces, &c.samples,
			                                           &options, values, singular, NULL),
			                 BATTEN_OK);
			assert_int_equal(batten_surface_grid_batch_float(c.context, c.count, surfaces,
			                                                 &c.samples, &options, floats,
			                                                 singular + points, NULL),
			                 BATTEN_OK);
			for (size_t n = 0; n < numbers; n++)
				assert_true((double)floats[n] == values[n]);
			assert_memory_equal(singular, singular + points, points);
			options.precision = BATTEN_F64;
			assert_int_equal(batten_surface_grid_batch_float(c.context, c.count, surfaces,
			                                                 &c.samples, &options, floats, NULL,
			                                                 NULL),
			                 BATTEN_USAGE);
			assert_non_null(strstr(batten_context_error(c.context), "f32 is expected"));
			free(values);
			free(floats);
			free(singular);
		}
	surface_case_close(&c);
}

/* Two devices share one queue. */
static void test_all_devices(void **state)
{
	(void)state;
	surface_case c = surface_case_open(4, 4, false);
	const batten_surface_batch_options options = surface_case_options(
		BATTEN_DEVICE_AUTO, BATTEN_F64, BATTEN_SURFACE_EVERYTHING);
	surface_case_compare(&c, &options);
	surface_case_close(&c);
}

static batten_status run_energies(const surface_case *c, int device,
                                  batten_surface_energies *energies, batten_run *run)
{
	const batten_surface_batch_options options = surface_case_options(device, BATTEN_F64,
	                                                                  BATTEN_SURFACE_CURVATURE);
	memset(energies, 0, SURFACE_CASE_COUNT * sizeof *energies);
	return batten_surface_energy_batch(
		c->context, c->count, (const batten_surface *const *)c->surfaces, &options, energies, run);
}

/* A device that fails gives its surfaces back: with `auto` they are done all the same and a warning
 * says so, with an index the failure is reported. */
static void test_failing_device_gives_back(void **state)
{
	(void)state;
	surface_case c = surface_case_open(3, 3, false);
	batten_surface_energies known[SURFACE_CASE_COUNT];
	batten_surface_energies found[SURFACE_CASE_COUNT];
	batten_run run;
	size_t warned = 0;
	assert_int_equal(run_energies(&c, BATTEN_DEVICE_REFERENCE, known, &run), BATTEN_OK);
	assert_string_equal(run.device, "reference");
	assert_int_equal(run_energies(&c, BATTEN_DEVICE_AUTO, found, &run), BATTEN_OK);
	for (unsigned long k = 1; k <= 24; k++) {
		(void)device_fail_call(k);
		const batten_status status = run_energies(&c, BATTEN_DEVICE_AUTO, found, &run);
		(void)device_fail_call(0);
		assert_int_equal(status, BATTEN_OK);
		assert_memory_equal(found, known, sizeof known);
		warned += run.warning[0] != '\0';
	}
	assert_true(warned >= 10);
	(void)device_fail_call(1);
	assert_int_equal(run_energies(&c, 0, found, &run), BATTEN_DEVICE);
	(void)device_fail_call(0);
	assert_int_equal(run_energies(&c, 7, found, &run), BATTEN_DEVICE);
	assert_non_null(strchr(batten_context_error(c.context), '7'));
	surface_case_close(&c);
}

/* The values of a grid lie in the caller's memory while a device works: one that fails at any call
 * leaves nothing of its own there, and keeps no object. */
static void test_failing_device_leaves_the_grid_whole(void **state)
{
	(void)state;
	surface_case c = surface_case_open(3, 3, false);
	const size_t numbers = surface_case_values(&c, BATTEN_SURFACE_CURVATURE);
	double *values = calloc(2 * numbers, sizeof *values);
	assert_non_null(values);
	c.samples.u = c.u;
	c.samples.v = c.v;
	const batten_surface *const *surfaces = (const batten_surface *const *)c.surfaces;
	batten_surface_batch_options options = surface_case_options(BATTEN_DEVICE_REFERENCE, BATTEN_F32,
	                                                            BATTEN_SURFACE_CURVATURE);
	assert_int_equal(batten_surface_grid_batch(c.context, c.count, surfaces, &c.samples, &options,
	                                           values, NULL, NULL),
	                 BATTEN_OK);
	options.device = BATTEN_DEVICE_AUTO;
	batten_run run;
	assert_int_equal(batten_surface_grid_batch(c.context, c.count, surfaces, &c.samples, &options,
	                                           values + numbers, NULL, &run),
	                 BATTEN_OK);
	const size_t live = device_live_objects(c.context);
	size_t warned = 0;
	for (unsigned long k = 1; k <= 40; k++) {
		memset(values + numbers, 0xff, numbers * sizeof *values);
		(void)device_fail_call(k);
		const batten_status status = batten_surface_grid_batch(
			c.context, c.count, surfaces, &c.samples, &options, values + numbers, NULL, &run);
		(void)device_fail_call(0);
		assert_int_equal(status, BATTEN_OK);
		assert_memory_equal(values, values + numbers, numbers * sizeof *values);
		assert_int_equal(device_live_objects(c.context), live);
		warned += run.warning[0] != '\0';
	}
	assert_true(warned >= 20);
	free(values);
	surface_case_close(&c);
}

int main(void)
{
	/* Before OpenCL is first opened. */
	(void)setenv("POCL_DEVICES", "pthread pthread", 1);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_default_shapes_equal_the_c_path),
		cmocka_unit_test(test_runs_of_any_length_and_place),
		cmocka_unit_test(test_floats_are_the_values),
		cmocka_unit_test(test_all_devices),
		cmocka_unit_test(test_failing_device_gives_back),
		cmocka_unit_test(test_failing_device_leaves_the_grid_whole),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
