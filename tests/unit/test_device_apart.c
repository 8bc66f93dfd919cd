/* A device with memory of its own, as a GPU: here PoCL's, called so. Searches abreast in the shape that GPUs get,
 * several threads each with a queue, memory that is taken again; ends equal the C path's bit for bit. */
#include "support/kernel_compile.h"

#include "batten.h"
#include "device/system.h"

#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STATIONS = 7, WATERLINES = 6, NODES = STATIONS * WATERLINES, COUNT = 2500, THREADS = 2 };

typedef struct fleet {
	double x[STATIONS], z[WATERLINES], lower[NODES], upper[NODES];
	double start[COUNT][NODES], y[COUNT][NODES], known_y[COUNT][NODES];
	batten_search_problem problems[COUNT];
	batten_search_result results[COUNT], known[COUNT];
} fleet;

static fleet *fleet_create(void)
{
	fleet *f = calloc(1, sizeof *f);
	assert_non_null(f);
	uint32_t state = 20261127u;
	for (int i = 0; i < STATIONS; i++)
		f->x[i] = i;
	for (int k = 0; k < WATERLINES; k++)
		f->z[k] = 0.2 * k;
	for (int n = 0; n < NODES; n++)
		f->upper[n] = 1.0;
	for (int h = 0; h < COUNT; h++) {
		for (int n = 0; n < NODES; n++) {
			const double u = n % STATIONS / (STATIONS - 1.0), v = n / STATIONS / (WATERLINES - 1.0);
			state = state * 1664525u + 1013904223u;
			f->start[h][n] = 0.1 + 3.0 * u * (1.0 - u) * v * (2.0 - v) +
			                 0.02 * ((double)(state >> 8) / (1u << 24) - 0.5);
		}
		f->problems[h] = (batten_search_problem){ .start_m = f->start[h],
			                                      .target_m = f->start[h],
			                                      .lower_m = f->lower,
			                                      .upper_m = f->upper,
			                                      .w1 = 1.0,
			                                      .w2 = pow(10.0, h % 4),
			                                      .half_beam_m = 1.0 };
	}
	return f;
}

static batten_context *context_of(bool apart)
{
	batten_context_options options;
	batten_context_options_default(&options);
	options.threads = THREADS;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(&options, &context), BATTEN_OK);
	assert_true(batten_device_count(context, NULL) >= 1);
	context->devices->entries[0].facts.is_cpu = !apart;
	return context;
}

static batten_status search(batten_context *context, fleet *f, int device,
                            batten_precision precision, batten_run *run)
{
	const batten_grid grid = { STATIONS, WATERLINES, f->x, f->z };
	const bool known = device == BATTEN_DEVICE_REFERENCE;
	batten_search_options options;
	batten_search_options_default(&options);
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	options.device = device;
	options.precision = precision;
	return batten_search_batch(context, &grid, COUNT, f->problems, &options,
	                           known ? f->known_y[0] : f->y[0], known ? f->known : f->results, run);
}

static void check_ends(const fleet *f)
{
	assert_memory_equal(f->y, f->known_y, sizeof f->y);
	for (int h = 0; h < COUNT; h++) {
		assert_memory_equal(&f->results[h].objective_end, &f->known[h].objective_end,
		                    sizeof(double));
		assert_int_equal(f->results[h].iterations, f->known[h].iterations);
		assert_int_equal(f->results[h].end, f->known[h].end);
	}
}

static void test_ends_equal_the_c_path(void **state)
{
	(void)state;
	fleet *f = fleet_create();
	for (int p = 0; p < 2; p++) {
		const batten_precision precision = p ? BATTEN_F32 : BATTEN_F64;
		batten_context *context = context_of(true);
		batten_run run = { .strict = false };
		assert_int_equal(search(context, f, BATTEN_DEVICE_REFERENCE, precision, NULL), BATTEN_OK);
		/* Twice: the second time in memory that is there. */
		for (int turn = 0; turn < 2; turn++) {
			memset(f->y, 0, sizeof f->y);
			if (search(context, f, 0, precision, &run) != BATTEN_OK)
				fail_msg("%s", batten_context_error(context));
			assert_true(run.strict && run.lane_use > 0.5 && run.lane_use <= 1.0);
			check_ends(f);
		}
		batten_context_destroy(context);
	}
	free(f);
}

/* Whichever OpenCL call fails, the C path finishes what the device did not. */
static void test_failing_calls(void **state)
{
	(void)state;
	fleet *f = fleet_create();
	batten_context *context = context_of(true);
	batten_run run;
	assert_int_equal(search(context, f, BATTEN_DEVICE_REFERENCE, BATTEN_F64, NULL), BATTEN_OK);
	(void)device_fail_call(ULONG_MAX);
	assert_int_equal(search(context, f, BATTEN_DEVICE_AUTO, BATTEN_F64, &run), BATTEN_OK);
	const unsigned long calls = device_fail_call(0);
	size_t warned = 0;
	for (unsigned long k = 1; k <= calls; k += 1 + calls / 10) {
		batten_context *fresh = k % 2 == 0 ? context_of(true) : NULL;
		memset(f->y, 0, sizeof f->y);
		(void)device_fail_call(k);
		assert_int_equal(search(fresh ? fresh : context, f, BATTEN_DEVICE_AUTO, BATTEN_F64, &run),
		                 BATTEN_OK);
		(void)device_fail_call(0);
		check_ends(f);
		warned += run.warning[0] != '\0';
		batten_context_destroy(fresh);
	}
	assert_true(warned > 3);
	batten_context_destroy(context);
	free(f);
}

/* Buffers that are let go are kept and taken again, by size, and end with the session. */
static void test_memory_is_taken_again(void **state)
{
	(void)state;
	batten_context *context = context_of(true);
	device_session *session = NULL, *branch = NULL;
	device_buffer *first = NULL, *second = NULL;
	char bytes[4096] = "first", found[4096] = "";
	assert_int_equal(device_session_open(context, 0, &session), BATTEN_OK);
	const size_t live = device_live_objects(context);
	assert_int_equal(device_buffer_create(session, sizeof bytes, bytes, &first), BATTEN_OK);
	device_buffer_destroy(first);
	assert_int_equal(device_live_objects(context), live + 1);
	/* A quarter of it, and no less, may be had in its place. */
	assert_int_equal(device_buffer_create(session, sizeof bytes / 4, NULL, &second), BATTEN_OK);
	assert_int_equal(device_live_objects(context), live + 1);
	assert_int_equal(device_buffer_read(second, sizeof bytes, found), BATTEN_USAGE);
	device_buffer_destroy(second);
	assert_int_equal(device_buffer_create(session, sizeof bytes / 4 - 1, NULL, &second), BATTEN_OK);
	assert_int_equal(device_live_objects(context), live + 2);
	device_buffer_destroy(second);
	memcpy(bytes, "again", 6);
	assert_int_equal(device_buffer_create(session, sizeof bytes, bytes, &first), BATTEN_OK);
	assert_int_equal(device_live_objects(context), live + 2);
	assert_int_equal(device_buffer_read(first, sizeof bytes, found), BATTEN_OK);
	assert_string_equal(found, "again");
	device_buffer_destroy(first);
	assert_int_equal(device_session_branch(session, &branch), BATTEN_OK);
	assert_int_equal(device_buffer_create(branch, sizeof bytes, bytes, &first), BATTEN_OK);
	device_buffer_destroy(first);
	device_session_close(branch);
	assert_int_equal(device_live_objects(context), live + 2);
	device_session_close(session);
	assert_int_equal(device_live_objects(context), 0);
	batten_context_destroy(context);
}

int main(void)
{
	kernels_unoptimised(true);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_ends_equal_the_c_path),
		cmocka_unit_test(test_failing_calls),
		cmocka_unit_test(test_memory_is_taken_again),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
