#include "batch/engine.h"

#include <stdio.h>
#include <string.h>

size_t batch_engine_number_size(batten_precision precision)
{
	return precision == BATTEN_F64 ? sizeof(double) : sizeof(float);
}

void batch_engine_shape_choose(const batten_device *device, batten_precision precision,
                               unsigned *lanes, unsigned *work_group)
{
	/* A CPU runs a work-item at a time: lanes fill its vector registers. A GPU has no vector
	 * registers: its work-items share one search or one line. */
	if (*lanes == 0)
		*lanes = !device->is_cpu ? 1 : precision == BATTEN_F64 ? 8 : 16;
	if (*work_group == 0)
		*work_group = device->is_cpu ? 1 : 64;
	if (device->max_work_group > 0 && *work_group > device->max_work_group)
		*work_group = device->max_work_group;
}

void batch_engine_shape_abreast(const batten_device *device, unsigned abreast, unsigned together,
                                batch_engine_recipe *recipe)
{
	if (!device->is_cpu && recipe->lanes == 0 && recipe->work_group == 0) {
		while (together > 1 && device->max_work_group > 0 &&
		       abreast * together > device->max_work_group)
			together /= 2;
		recipe->lanes = abreast;
		recipe->work_group = abreast * together;
	}
	batch_engine_shape_choose(device, recipe->precision, &recipe->lanes, &recipe->work_group);
	/* Vectors gain a GPU nothing, and NVIDIA's compiler crashes on some of these kernels with them. */
	if (!device->is_cpu && recipe->work_group % recipe->lanes != 0)
		recipe->work_group = recipe->lanes;
	recipe->abreast = batch_engine_stands_abreast(recipe->lanes, recipe->work_group);
}

size_t batch_engine_groups_most(const batch_engine *e, size_t groups, size_t group_bytes)
{
	const batten_device *device = batch_engine_device(e);
	if (device->is_cpu || group_bytes == 0)
		return groups;
	uint64_t most = device->global_memory_bytes / (4 * HANDS_MOST);
	if (device->max_allocation_bytes > 0 && most > device->max_allocation_bytes)
		most = device->max_allocation_bytes;
	if (groups > most / group_bytes)
		groups = (size_t)(most / group_bytes);
	return groups > 0 ? groups : 1;
}

bool batch_engine_stands_abreast(unsigned lanes, unsigned work_group)
{
	return lanes > 1 && work_group % lanes == 0;
}

size_t batch_engine_test_count(unsigned lanes)
{
	return lanes < BATCH_TEST_MOST / 2 ? 2 * (size_t)lanes + 1 : BATCH_TEST_MOST;
}

size_t batch_engine_together(const batch_engine_recipe *recipe)
{
	return recipe->abreast ? recipe->work_group / recipe->lanes : recipe->work_group;
}

batch_engine_queues batch_engine_queues_of(const batch_engine_recipe *recipe, size_t count,
                                           size_t groups_most)
{
	const size_t queues_a_group = recipe->abreast ? recipe->lanes : 1;
	const size_t lanes = recipe->abreast ? 1 : recipe->lanes;
	const size_t most = groups_most * queues_a_group;
	const size_t share = ((count + most - 1) / most + lanes - 1) / lanes * lanes;
	const size_t busy = (count + share - 1) / share;
	const size_t groups = (busy + queues_a_group - 1) / queues_a_group;
	return (batch_engine_queues){ share, groups * queues_a_group, groups };
}

uint64_t batch_engine_lane_turns(const batch_engine_recipe *recipe,
                                 const batch_engine_queues *queues, const int32_t *turns)
{
	const size_t queues_a_group = queues->count / queues->groups;
	uint64_t sum = 0;
	for (size_t g = 0; g < queues->groups; g++) {
		int32_t longest = 0;
		for (size_t q = g * queues_a_group; q < (g + 1) * queues_a_group; q++)
			if (turns[q] > longest)
				longest = turns[q];
		sum += (uint64_t)longest * recipe->lanes;
	}
	return sum;
}

static bool same_recipe(const batch_engine_recipe *a, const batch_engine_recipe *b)
{
	return a->device == b->device && a->precision == b->precision && a->lanes == b->lanes &&
	       a->work_group == b->work_group && a->abreast == b->abreast &&
	       strcmp(a->kernel, b->kernel) == 0 && strcmp(a->options, b->options) == 0;
}

batch_engine *batch_engine_find(const batten_context *context, const batch_engine_recipe *recipe)
{
	for (batch_engine *known = context->engines; known; known = known->next)
		if (same_recipe(&known->recipe, recipe))
			return known;
	return NULL;
}

static batten_status build(batch_engine *e)
{
	const batch_engine_recipe *recipe = &e->recipe;
	const batten_device *device = batch_engine_device(e);
	char shape[80], options[384];
	if (recipe->abreast)
		(void)snprintf(shape, sizeof shape, "-DBATTEN_LANES=1 -DBATTEN_ABREAST=%u", recipe->lanes);
	else
		(void)snprintf(shape, sizeof shape, "-DBATTEN_LANES=%u", recipe->lanes);
	(void)snprintf(options, sizeof options, "-DBATTEN_DOUBLE=%d %s%s%s %s%s",
	               recipe->precision == BATTEN_F64, shape,
	               batch_engine_together(recipe) == 1 ? " -DBATTEN_ALONE" : "",
	               device->is_cpu ? " -DBATTEN_PREFETCH" : "", recipe->options,
	               recipe->precision == BATTEN_F32 && device->has_correct_f32
	                   ? " -cl-fp32-correctly-rounded-divide-sqrt"
	                   : "");
	batten_status status = device_program_build(e->session, recipe->kernel, recipe->source, options,
	                                            &e->program, NULL, &e->test.build_s);
	if (status == BATTEN_OK)
		status = device_kernel_create(e->program, recipe->kernel, &e->kernel);
	if (status != BATTEN_OK)
		return batch_engine_fail(e, status);
	if (device_kernel_group_limit(e->kernel) < recipe->work_group)
		return batten_fail(
			e->context, BATTEN_KERNEL,
			"device %zu (%s): the kernel %s runs with at most %zu work-items a group, "
			"%u are asked for",
			recipe->device, device->name, recipe->kernel, device_kernel_group_limit(e->kernel),
			recipe->work_group);
	return BATTEN_OK;
}

static batten_status check_device(const batch_engine *e)
{
	if (e->recipe.precision == BATTEN_F64 && !batch_engine_device(e)->has_f64)
		return batten_fail(e->context, BATTEN_DEVICE, "device %zu (%s) has no f64",
		                   e->recipe.device, batch_engine_device(e)->name);
	return BATTEN_OK;
}

batten_status batch_engine_start(batch_engine *e, batten_context *context,
                                 const batch_engine_recipe *recipe)
{
	e->context = context;
	e->recipe = *recipe;
	if (e->size == 0)
		e->size = sizeof *e;
	e->test = (batten_selftest){ .precision = recipe->precision, .result = BATTEN_SELFTEST_FAILED };
	(void)snprintf(e->test.kernel, sizeof e->test.kernel, "%s", recipe->kernel);
	batten_status status = device_session_open(context, recipe->device, &e->session);
	if (status == BATTEN_OK)
		status = check_device(e);
	if (status == BATTEN_DEVICE && e->session)
		e->test.result = BATTEN_SELFTEST_ABSENT;
	if (status == BATTEN_OK)
		status = build(e);
	if (status != BATTEN_OK)
		(void)snprintf(e->test.message, sizeof e->test.message, "%s",
		               batten_context_error(context));
	return status;
}

batten_status batch_engine_judge(batch_engine *e, batten_status ran)
{
	if (ran == BATTEN_MEMORY)
		return ran;
	if (ran != BATTEN_OK) {
		e->test.result = BATTEN_SELFTEST_FAILED;
		(void)snprintf(e->test.message, sizeof e->test.message, "%s",
		               batten_context_error(e->context));
	}
	if (e->test.result == BATTEN_SELFTEST_FAILED)
		return batten_fail(e->context, BATTEN_KERNEL, "device %zu (%s): self-test failed: %s",
		                   e->recipe.device, batch_engine_device(e)->name, e->test.message);
	return BATTEN_OK;
}

void batch_engine_compare(batten_selftest *test, double worst, double tolerance, const char *what)
{
	if (test->different == 0)
		test->result = BATTEN_SELFTEST_EQUAL;
	else if (worst <= tolerance)
		test->result = BATTEN_SELFTEST_DIFFERENT;
	else
		test->result = BATTEN_SELFTEST_FAILED;
	if (test->different > 0)
		(void)snprintf(test->message, sizeof test->message,
		               "%zu of %zu numbers differ from the C path, %s by up to %.3g of it",
		               test->different, test->compared, what, worst);
}

void batch_engine_keep(batch_engine *e)
{
	e->next = e->context->engines;
	e->context->engines = e;
}

batten_status batch_engine_open(batten_context *context, const batch_engine_recipe *recipe,
                                batch_engine_selftest *selftest, const void *plan,
                                batch_engine **out, batten_selftest *result)
{
	batch_engine *made = batch_engine_find(context, recipe);
	batten_status status = BATTEN_OK;
	if (!made) {
		made = batten_allocate(context, 1, sizeof *made);
		if (!made)
			return BATTEN_MEMORY;
		status = batch_engine_start(made, context, recipe);
		if (status == BATTEN_OK)
			status = batch_engine_judge(made, selftest(made, plan));
		if (status == BATTEN_OK)
			batch_engine_keep(made);
	}
	if (result)
		*result = made->test;
	if (status != BATTEN_OK)
		batch_engine_destroy(made);
	else
		*out = made;
	return status;
}

void *batch_engine_memory(batch_engine *e, size_t count, size_t size)
{
	size_t bytes = 0;
	if (!__builtin_mul_overflow(count, size, &bytes) && e->memory && bytes <= e->memory_bytes)
		return e->memory;
	batten_release(e->context, e->memory);
	e->memory = batten_allocate(e->context, count, size);
	e->memory_bytes = e->memory ? bytes : 0;
	return e->memory;
}

batten_status batch_engine_upload_all(const batch_engine *e, const batch_engine_upload *uploads,
                                      size_t count)
{
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		if (uploads[i].size > 0)
			status = device_buffer_create(e->session, uploads[i].size, uploads[i].from,
			                              uploads[i].buffer);
	return status;
}

const char *batch_engine_state_option(bool global)
{
	return global ? "-DSTATE=global -DSTATE_IS_GLOBAL" : "-DSTATE=local";
}

size_t batch_engine_launch_bytes(const batch_engine *e, size_t most)
{
	const uint64_t device = batch_engine_device(e)->max_allocation_bytes;
	const size_t host = e->context->options.max_memory;
	if (device > 0 && most > device)
		most = (size_t)device;
	return host > 0 && most > host ? host : most;
}

size_t batch_engine_search_bytes(const batch_engine *e, size_t most)
{
	enum { GPU_BYTES = 160 << 20 };
	return batch_engine_launch_bytes(e, batch_engine_device(e)->is_cpu ? most : GPU_BYTES);
}

batten_status batch_engine_hand(batch_engine *e, size_t number, batch_engine **out)
{
	while (e->hand_count < number) {
		batch_engine *hand = batten_allocate(e->context, 1, e->size);
		if (!hand)
			return BATTEN_MEMORY;
		memcpy(hand, e, e->size);
		hand->session = NULL;
		hand->program = NULL;
		hand->kernel = NULL;
		hand->memory = NULL;
		hand->memory_bytes = 0;
		hand->hand_count = 0;
		batten_status status = device_session_branch(e->session, &hand->session);
		if (status == BATTEN_OK)
			status = device_kernel_branch(hand->session, e->program, e->recipe.kernel,
			                              &hand->kernel);
		if (status != BATTEN_OK) {
			batch_engine_destroy(hand);
			return status;
		}
		e->hands[e->hand_count++] = hand;
	}
	*out = e->hands[number - 1];
	return BATTEN_OK;
}

void batch_engine_destroy(batch_engine *e)
{
	if (!e)
		return;
	while (e->hand_count > 0)
		batch_engine_destroy(e->hands[--e->hand_count]);
	device_kernel_destroy(e->kernel);
	device_program_destroy(e->program);
	device_session_close(e->session);
	batten_release(e->context, e->memory);
	batten_release(e->context, e);
}

void batch_engines_destroy(batten_context *context, batch_engine *first)
{
	(void)context;
	while (first) {
		batch_engine *next = first->next;
		batch_engine_destroy(first);
		first = next;
	}
}

const batten_device *batch_engine_device(const batch_engine *e)
{
	return device_session_device(e->session);
}

bool batch_engine_is_strict(const batch_engine *e)
{
	return e->test.result == BATTEN_SELFTEST_EQUAL;
}

batten_status batch_engine_fail(const batch_engine *e, batten_status status)
{
	/* The session's error names the device. */
	return batten_fail(e->context, status, "device %zu: %s", e->recipe.device,
	                   device_session_error(e->session));
}
