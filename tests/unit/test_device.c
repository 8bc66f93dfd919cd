/* The OpenCL layer: devices, programs, sizes, and several threads at once. */
#include "unit/device_fixture.h"

static void test_facts(void **state)
{
	place *here = *state;
	batten_context *context = make_context(here->cache, 0);
	const char *reason = NULL;
	assert_true(batten_device_count(context, &reason) >= 1);
	assert_string_equal(reason, "");
	batten_device facts;
	assert_int_equal(batten_device_describe(context, 0, &facts), BATTEN_OK);
	assert_string_not_equal(facts.name, "");
	assert_string_not_equal(facts.platform, "");
	assert_string_not_equal(facts.driver, "");
	assert_non_null(strstr(facts.version, "OpenCL "));
	assert_true(facts.compute_units >= 1 && facts.max_work_group >= GROUP);
	assert_true(facts.local_memory_bytes > 0 && facts.max_allocation_bytes > 0);
	assert_true(facts.global_memory_bytes >= facts.max_allocation_bytes);
	if (strcmp(facts.platform, "Portable Computing Language") == 0)
		assert_true(facts.is_cpu && facts.has_f64 && facts.has_correct_f32);
	assert_int_equal(batten_device_describe(context, 1000, &facts), BATTEN_DEVICE);
	assert_non_null(strstr(batten_context_error(context), "1000"));
	assert_int_equal(batten_device_describe(context, 0, NULL), BATTEN_USAGE);
	assert_int_equal(batten_device_count(NULL, &reason), 0);
	assert_string_equal(reason, "no context");
	batten_context_destroy(context);
	device_session_close(NULL);
	device_program_destroy(NULL);
	device_kernel_destroy(NULL);
	device_buffer_destroy(NULL);
}

static void test_build_failure(void **state)
{
	place *here = *state;
	batten_context *context = make_context(here->cache, 0);
	device_session *session = NULL;
	device_program *program = NULL;
	device_kernel *kernel = NULL;
	assert_int_equal(device_session_open(context, 0, &session), BATTEN_OK);
	const char *wrong = "__kernel void f(__global int *a)\n{\n\ta[0] = undeclared_thing;\n}\n";
	assert_int_equal(device_program_build(session, "wrong", wrong, "", &program, NULL, NULL),
	                 BATTEN_KERNEL);
	assert_null(program);
	const char *error = device_session_error(session);
	assert_non_null(strstr(error, "wrong does not build on "));
	assert_non_null(strstr(error, "error:"));
	assert_non_null(strstr(error, "undeclared_thing"));
	assert_null(strchr(error, '\n'));
	assert_int_equal(
		device_program_build(session, "odd", source, "-no-such-option", &program, NULL, NULL),
		BATTEN_KERNEL);
	assert_int_equal(device_program_build(session, "add", source, "", &program, NULL, NULL),
	                 BATTEN_OK);
	assert_int_equal(device_kernel_create(program, "subtract", &kernel), BATTEN_KERNEL);
	assert_null(kernel);
	assert_non_null(strstr(device_session_error(session),
	                       "clCreateKernel of subtract in add: CL_INVALID_KERNEL_NAME"));
	device_program_destroy(program);
	device_session_close(session);
	assert_int_equal(device_live_objects(context), 0);
	batten_context_destroy(context);
}

static char built_with[128];

static cl_int CL_API_CALL refuse_to_build(cl_program program, cl_uint count,
                                          const cl_device_id *devices, const char *options,
                                          void(CL_CALLBACK *done)(cl_program, void *), void *user)
{
	(void)program;
	(void)count;
	(void)devices;
	(void)done;
	(void)user;
	(void)snprintf(built_with, sizeof built_with, "%s", options);
	return CL_OUT_OF_HOST_MEMORY;
}

static void test_build_options(void **state)
{
	place *here = *state;
	batten_context *context = make_context(here->cache, 0);
	device_session *session = NULL;
	device_program *program = NULL;
	assert_int_equal(device_session_open(context, 0, &session), BATTEN_OK);
	context->devices->opencl.BuildProgram = refuse_to_build;
	assert_int_equal(device_program_build(session, "add", source, "-DA=1", &program, NULL, NULL),
	                 BATTEN_MEMORY);
	assert_null(program);
	assert_string_equal(built_with, "-cl-std=CL1.2 -DA=1");
	assert_non_null(
		strstr(device_session_error(session), "clBuildProgram of add: CL_OUT_OF_HOST_MEMORY (-6)"));
	device_session_close(session);
	assert_int_equal(device_live_objects(context), 0);
	batten_context_destroy(context);
}

/* A buffer in memory of our own: what is written to it is there after it has settled. */
static void test_wrapped_memory(void **state)
{
	place *here = *state;
	batten_context *context = make_context(here->cache, 0);
	device_session *session = NULL;
	device_buffer *buffer = NULL;
	char bytes[64] = { 0 };
	assert_int_equal(device_session_open(context, 0, &session), BATTEN_OK);
	const size_t live = device_live_objects(context);
	assert_int_equal(device_buffer_wrap(session, 0, bytes, &buffer), BATTEN_USAGE);
	assert_int_equal(device_buffer_wrap(session, 48, bytes + 8, &buffer), BATTEN_OK);
	assert_int_equal(
		device_buffer_write(buffer, 48, "a text of less than forty-eight bytes, and zeros"),
		BATTEN_OK);
	assert_int_equal(device_buffers_settle(&buffer, 1), BATTEN_OK);
	assert_memory_equal(bytes + 8, "a text of less than forty-eight bytes, and zeros", 48);
	assert_true(bytes[7] == 0 && bytes[56] == 0);
	for (unsigned long k = 1; k <= 3; k++) { /* map, unmap, finish */
		(void)device_fail_call(k);
		assert_int_equal(device_buffers_settle(&buffer, 1), BATTEN_DEVICE);
		(void)device_fail_call(0);
	}
	device_buffer_destroy(buffer);
	assert_int_equal(device_live_objects(context), live);
	device_session_close(session);
	batten_context_destroy(context);
}

static void test_sizes(void **state)
{
	place *here = *state;
	batten_context *context = make_context(here->cache, 0);
	device_session *session = NULL;
	device_session *other = NULL;
	device_program *program = NULL;
	device_kernel *kernel = NULL;
	device_buffer *buffer = NULL;
	char bytes[32] = { 0 };
	assert_int_equal(device_session_open(context, 0, &session), BATTEN_OK);
	assert_int_equal(device_session_open(context, 0, &other), BATTEN_OK);
	const batten_device *facts = device_session_device(session);
	size_t most = (size_t)facts->max_allocation_bytes;
	assert_int_equal(device_buffer_create(session, most + 1, NULL, &buffer), BATTEN_MEMORY);
	assert_non_null(strstr(device_session_error(session), "the most is"));
	assert_int_equal(device_buffer_create(session, SIZE_MAX, NULL, &buffer), BATTEN_MEMORY);
	assert_int_equal(device_buffer_create(session, 0, NULL, &buffer), BATTEN_USAGE);
	assert_null(buffer);
	assert_int_equal(device_buffer_create(session, 16, bytes, &buffer), BATTEN_OK);
	assert_int_equal(device_buffer_read(buffer, 17, bytes), BATTEN_USAGE);
	assert_int_equal(device_buffer_write(buffer, 17, bytes), BATTEN_USAGE);
	assert_non_null(strstr(device_session_error(session), "a write of 17 bytes of a buffer of 16"));
	assert_int_equal(device_program_build(session, "add", source, "", &program, NULL, NULL),
	                 BATTEN_OK);
	assert_int_equal(device_kernel_create(program, "add", &kernel), BATTEN_OK);
	size_t limit = device_kernel_group_limit(kernel);
	assert_int_equal(device_launch(session, kernel, NULL, 0, 1, limit + 1), BATTEN_USAGE);
	assert_int_equal(device_launch(session, kernel, NULL, 0, SIZE_MAX / 2, 4), BATTEN_USAGE);
	assert_int_equal(device_launch(session, kernel, NULL, 0, 0, 4), BATTEN_USAGE);
	assert_int_equal(device_launch(other, kernel, NULL, 0, 1, 4), BATTEN_USAGE);
	device_argument large[2] = { { .size = SIZE_MAX }, { .size = 2 } };
	assert_int_equal(device_launch(session, kernel, large, 2, 1, 4), BATTEN_USAGE);
	large[0].size = (size_t)facts->local_memory_bytes;
	assert_int_equal(device_launch(session, kernel, large, 2, 1, 4), BATTEN_MEMORY);
	assert_non_null(strstr(device_session_error(session), "local memory"));
	const device_argument small = { .size = 3, .value = bytes }; /* where a buffer belongs */
	assert_int_equal(device_launch(session, kernel, &small, 1, 1, 4), BATTEN_KERNEL);
	assert_non_null(
		strstr(device_session_error(session), "clSetKernelArg of add, argument 0, 3 bytes: CL_"));
	device_kernel_destroy(kernel);
	device_program_destroy(program);
	device_buffer_destroy(buffer);
	device_session_close(other);
	device_session_close(session);
	assert_int_equal(device_live_objects(context), 0);
	batten_context_destroy(context);
}

typedef struct worker {
	device_session *session;
	const char *cache;
	double factor;
	bool good;
} worker;

static void *run_session(void *memory)
{
	worker *mine = memory;
	mine->good = true;
	for (unsigned i = 0; i < 20 && mine->good; i++)
		mine->good = runs(mine->session, source, mine->factor + i, NULL);
	return NULL;
}

static void *run_context(void *memory)
{
	worker *mine = memory;
	batten_context *context = make_context(mine->cache, 0);
	device_session *session = NULL;
	mine->good = context && device_session_open(context, 0, &session) == BATTEN_OK &&
	             runs(session, source, 3.25, NULL);
	device_session_close(session);
	batten_context_destroy(context);
	return NULL;
}

static void run_two(void *(*body)(void *), worker workers[2])
{
	pthread_t threads[2];
	for (size_t i = 0; i < 2; i++)
		assert_int_equal(pthread_create(&threads[i], NULL, body, &workers[i]), 0);
	for (size_t i = 0; i < 2; i++)
		assert_int_equal(pthread_join(threads[i], NULL), 0);
	assert_true(workers[0].good);
	assert_true(workers[1].good);
}

static void test_two_contexts_at_once(void **state)
{
	place *here = *state;
	worker workers[2] = { { .cache = here->cache }, { .cache = here->cache } };
	run_two(run_context, workers);
}

static void test_two_sessions_at_once(void **state)
{
	place *here = *state;
	batten_context *context = make_context(here->cache, 0);
	worker workers[2] = { { .factor = 1.5 }, { .factor = 40.25 } };
	for (size_t i = 0; i < 2; i++)
		assert_int_equal(device_session_open(context, 0, &workers[i].session), BATTEN_OK);
	assert_int_equal(device_live_objects(context), 4);
	run_two(run_session, workers);
	/* An error is its session's alone. */
	device_buffer *buffer = NULL;
	assert_int_equal(device_buffer_create(workers[0].session, 0, NULL, &buffer), BATTEN_USAGE);
	assert_string_not_equal(device_session_error(workers[0].session), "");
	assert_string_equal(device_session_error(workers[1].session), "");
	for (size_t i = 0; i < 2; i++)
		device_session_close(workers[i].session);
	assert_int_equal(device_live_objects(context), 0);
	batten_context_destroy(context);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_two_contexts_at_once), /* first: it starts OpenCL in two threads */
		cmocka_unit_test(test_two_sessions_at_once), cmocka_unit_test(test_facts),
		cmocka_unit_test(test_build_failure),        cmocka_unit_test(test_build_options),
		cmocka_unit_test(test_wrapped_memory),       cmocka_unit_test(test_sizes),
	};
	return cmocka_run_group_tests(tests, make_place, remove_place);
}
