/* Every OpenCL call and every allocation on the way from the list of devices to a result fails once:
 * a named error, or the right result where the call was only a convenience, and nothing is left. */
#include "device/folder.h"
#include "device/system.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COUNT = 256, GROUP = 8, CALLS_MOST = 400 };

static const char source[] =
	"__kernel void sum(__global const int *a, __global int *b, __local int *row, int step)\n"
	"{\n"
	"	size_t i = get_local_id(0);\n"
	"	row[i] = a[get_global_id(0)];\n"
	"	barrier(CLK_LOCAL_MEM_FENCE);\n"
	"	b[get_global_id(0)] = row[i] + step * row[get_local_size(0) - 1 - i];\n"
	"}\n";

/* Memory that counts itself and fails when told to. */
typedef struct memory {
	unsigned long asked, fails_at; /* 0: never */
	long held;
} memory;

static void *allocate(size_t size, void *user)
{
	memory *all = user;
	if (++all->asked == all->fails_at)
		return NULL;
	all->held++;
	return malloc(size);
}

static void release(void *block, void *user)
{
	memory *all = user;
	all->held--;
	free(block);
}

/* What a run came to. */
typedef struct outcome {
	batten_status status;
	char error[600];
	bool right; /* the numbers */
	bool from_cache;
	size_t left;      /* OpenCL objects */
	long memory_left; /* blocks */
	unsigned long calls, allocations;
} outcome;

static batten_status calculate(device_session *session, bool *from_cache, int32_t *found)
{
	device_program *program = NULL;
	device_kernel *kernel = NULL;
	device_buffer *in = NULL;
	device_buffer *out = NULL;
	int32_t given[COUNT];
	int32_t step = 1000;
	for (int32_t i = 0; i < COUNT; i++)
		given[i] = i;
	batten_status status = device_program_build(session, "sum", source, "", &program, from_cache,
	                                            NULL);
	if (status == BATTEN_OK)
		status = device_kernel_create(program, "sum", &kernel);
	if (status == BATTEN_OK)
		status = device_buffer_create(session, sizeof given, given, &in);
	if (status == BATTEN_OK)
		status = device_buffer_create(session, sizeof given, NULL, &out);
	if (status == BATTEN_OK) {
		const device_argument arguments[] = { { .buffer = in },
			                                  { .buffer = out },
			                                  { .size = GROUP * sizeof(int32_t) },
			                                  { .size = sizeof step, .value = &step } };
		status = device_launch(session, kernel, arguments, 4, COUNT / GROUP, GROUP);
	}
	if (status == BATTEN_OK)
		status = device_finish(session);
	if (status == BATTEN_OK)
		status = device_buffer_read(out, sizeof given, found);
	device_buffer_destroy(out);
	device_buffer_destroy(in);
	device_kernel_destroy(kernel);
	device_program_destroy(program);
	return status;
}

static void start(batten_context *context, outcome *out, int32_t *found)
{
	const char *reason = NULL;
	device_session *session = NULL;
	if (device_count(context, &reason) == 0) {
		out->status = BATTEN_DEVICE;
		(void)snprintf(out->error, sizeof out->error, "%s", reason);
		return;
	}
	/* PoCL's programs are not stored; under another name they are. */
	(void)strcpy(context->devices->entries[0].facts.platform, "test");
	out->status = device_session_open(context, 0, &session);
	if (out->status != BATTEN_OK) {
		(void)snprintf(out->error, sizeof out->error, "%s", batten_context_error(context));
		return;
	}
	out->status = calculate(session, &out->from_cache, found);
	(void)snprintf(out->error, sizeof out->error, "%s", device_session_error(session));
	device_session_close(session);
}

static bool is_right(const int32_t *found)
{
	for (int32_t i = 0; i < COUNT; i++)
		if (found[i] != i + 1000 * (i - i % GROUP + GROUP - 1 - i % GROUP))
			return false;
	return true;
}

static outcome run(const char *cache, unsigned long call, unsigned long allocation)
{
	memory all = { .fails_at = allocation };
	batten_context_options options;
	batten_context_options_default(&options);
	options.cache_directory = cache;
	options.allocate = allocate;
	options.release = release;
	options.allocate_user = &all;
	batten_context *context = NULL;
	int32_t found[COUNT] = { 0 };
	outcome out = { .status = batten_context_create(&options, &context) };
	if (out.status == BATTEN_OK) {
		(void)device_fail_call(call);
		start(context, &out, found);
		out.calls = device_fail_call(0);
		out.left = device_live_objects(context);
		batten_context_destroy(context);
	}
	out.right = is_right(found);
	out.memory_left = all.held;
	out.allocations = all.asked;
	return out;
}

static int make_folder(void **state)
{
	char *folder = strdup("/tmp/batten-test.XXXXXX");
	char pocl[64];
	assert_non_null(folder);
	assert_non_null(mkdtemp(folder));
	(void)snprintf(pocl, sizeof pocl, "%s/pocl", folder);
	assert_int_equal(setenv("POCL_CACHE_DIR", pocl, 0), 0);
	*state = folder;
	return 0;
}

static int remove_folder(void **state)
{
	device_folder_remove(*state);
	free(*state);
	return 0;
}

/* Fails call 1, 2, ... of a run each time until a run makes fewer; returns how many failures a run
 * bore without an error of its own. */
static unsigned fail_each_call(const char *cache, bool cold)
{
	unsigned borne = 0;
	for (unsigned long call = 1; call < CALLS_MOST; call++) {
		if (cold)
			device_folder_remove(cache);
		outcome out = run(cache, call, 0);
		assert_int_equal(out.left, 0);
		assert_int_equal(out.memory_left, 0);
		if (out.calls < call) {
			assert_int_equal(out.status, BATTEN_OK);
			assert_true(out.right);
			assert_true(call > 30);
			return borne;
		}
		if (out.status == BATTEN_OK) {
			assert_true(out.right);
			borne++;
		} else {
			assert_int_equal(out.status, BATTEN_DEVICE);
			assert_non_null(strstr(out.error, ": CL_OUT_OF_RESOURCES (-5)"));
			assert_non_null(strstr(out.error, "cl"));
		}
	}
	fail();
	return 0;
}

static void test_every_call_of_a_build(void **state)
{
	char cache[64];
	(void)snprintf(cache, sizeof cache, "%s/cold", (const char *)*state);
	assert_int_equal(fail_each_call(cache, true),
	                 2); /* the two that read the binary to be stored */
}

static void test_every_call_of_a_load(void **state)
{
	char cache[64];
	(void)snprintf(cache, sizeof cache, "%s/warm", (const char *)*state);
	outcome first = run(cache, 0, 0);
	assert_int_equal(first.status, BATTEN_OK);
	assert_false(first.from_cache);
	assert_true(first.right);
	outcome second = run(cache, 0, 0);
	assert_int_equal(second.status, BATTEN_OK);
	assert_true(second.from_cache);
	assert_true(second.right);
	assert_int_equal(fail_each_call(cache, false), 2); /* the binary's creation and build */
}

static void fail_each_allocation(const char *cache)
{
	for (unsigned long allocation = 1; allocation < CALLS_MOST; allocation++) {
		outcome out = run(cache, 0, allocation);
		assert_int_equal(out.left, 0);
		assert_int_equal(out.memory_left, 0);
		if (out.allocations < allocation) {
			assert_int_equal(out.status, BATTEN_OK);
			assert_true(allocation > 10);
			return;
		}
		if (out.status == BATTEN_OK) /* without the cache */
			assert_true(out.right);
		else if (out.status !=
		         BATTEN_MEMORY) /* no list of devices is no error, but has its reason */
			assert_string_equal(out.error, "out of memory");
		else if (allocation > 2)
			assert_non_null(strstr(out.error, "out of memory"));
	}
	fail();
}

static void test_every_allocation(void **state)
{
	char cache[64];
	(void)snprintf(cache, sizeof cache, "%s/memory", (const char *)*state);
	fail_each_allocation(cache);
	fail_each_allocation(cache); /* now with a program to load */
}

static void test_hook(void **state)
{
	(void)state;
	assert_int_equal(device_fail_call(2), 0);
	assert_false(device_opencl_fails());
	assert_true(device_opencl_fails());
	assert_false(device_opencl_fails());
	assert_int_equal(device_fail_call(0), 3);
	assert_false(device_opencl_fails());
	assert_int_equal(device_fail_call(0), 0);
}

static void test_codes(void **state)
{
	(void)state;
	assert_string_equal(device_opencl_name(CL_OUT_OF_RESOURCES), "CL_OUT_OF_RESOURCES");
	assert_string_equal(device_opencl_name(-1001), "CL_PLATFORM_NOT_FOUND_KHR");
	assert_null(device_opencl_name(-9999));
	assert_int_equal(device_opencl_status(CL_OUT_OF_RESOURCES), BATTEN_DEVICE);
	assert_int_equal(device_opencl_status(CL_DEVICE_NOT_AVAILABLE), BATTEN_DEVICE);
	assert_int_equal(device_opencl_status(-9999), BATTEN_DEVICE);
	assert_int_equal(device_opencl_status(CL_MEM_OBJECT_ALLOCATION_FAILURE), BATTEN_MEMORY);
	assert_int_equal(device_opencl_status(CL_OUT_OF_HOST_MEMORY), BATTEN_MEMORY);
	assert_int_equal(device_opencl_status(CL_BUILD_PROGRAM_FAILURE), BATTEN_KERNEL);
	assert_int_equal(device_opencl_status(CL_INVALID_KERNEL_NAME), BATTEN_KERNEL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_hook),
		cmocka_unit_test(test_codes),
		cmocka_unit_test(test_every_call_of_a_build),
		cmocka_unit_test(test_every_call_of_a_load),
		cmocka_unit_test(test_every_allocation),
	};
	return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
