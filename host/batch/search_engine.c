#include "batch/search_engine.h"

#include "batch/search_pack.h"
#include "batch/search_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>
#include <string.h>

struct search_engine {
	batten_context *context;
	search_shape shape;
	device_session *session;
	device_program *program;
	device_kernel *kernel;
	batten_selftest test;
	search_engine *next;
};

/* Most bytes of packed searches in one launch: large enough to hide a launch, small enough that a
 * batch of any size runs in bounded memory. */
enum { BLOCK_BYTES = 64 << 20, BLOCK_ROUNDS = 8 };

static size_t bytes_of(batten_precision precision)
{
	return precision == BATTEN_F64 ? sizeof(double) : sizeof(float);
}

search_shape search_shape_choose(const search_plan *plan, size_t index, const batten_device *device)
{
	search_shape shape = { .device = index,
		                   .precision = plan->options.precision,
		                   .lanes = plan->options.lanes,
		                   .work_group = plan->options.work_group };
	/* A CPU runs a work-item at a time: lanes fill its vector registers. A GPU has no vector
	 * registers: its work-items share one search. */
	if (shape.lanes == 0)
		shape.lanes = !device->is_cpu ? 1 : shape.precision == BATTEN_F64 ? 8 : 16;
	if (shape.work_group == 0)
		shape.work_group = device->is_cpu ? 1 : 64;
	if (device->max_work_group > 0 && shape.work_group > device->max_work_group)
		shape.work_group = device->max_work_group;
	const size_t lane_bytes = shape.lanes * bytes_of(shape.precision);
	const size_t state = (3 * plan->node_count + plan->waterline_count + 2 * shape.work_group) *
	                     lane_bytes;
	shape.global_state = state > device->local_memory_bytes;
	return shape;
}

static bool same_shape(const search_shape *a, const search_shape *b)
{
	return a->device == b->device && a->precision == b->precision && a->lanes == b->lanes &&
	       a->work_group == b->work_group && a->global_state == b->global_state;
}

static void engine_destroy(search_engine *engine)
{
	if (!engine)
		return;
	device_kernel_destroy(engine->kernel);
	device_program_destroy(engine->program);
	device_session_close(engine->session);
	batten_release(engine->context, engine);
}

void search_engines_destroy(batten_context *context, search_engine *first)
{
	(void)context;
	while (first) {
		search_engine *next = first->next;
		engine_destroy(first);
		first = next;
	}
}

batten_context *search_engine_context(const search_engine *engine)
{
	return engine->context;
}

const search_shape *search_engine_shape(const search_engine *engine)
{
	return &engine->shape;
}

const batten_device *search_engine_device(const search_engine *engine)
{
	return device_session_device(engine->session);
}

bool search_engine_is_strict(const search_engine *engine)
{
	return engine->test.result == BATTEN_SELFTEST_EQUAL;
}

static batten_status build(search_engine *engine)
{
	const search_shape *shape = &engine->shape;
	const batten_device *device = device_session_device(engine->session);
	char options[192];
	(void)snprintf(options, sizeof options, "-DBATTEN_DOUBLE=%d -DBATTEN_LANES=%u -DSTATE=%s%s%s",
	               shape->precision == BATTEN_F64, shape->lanes,
	               shape->global_state ? "global" : "local",
	               shape->global_state ? " -DSTATE_IS_GLOBAL" : "",
	               shape->precision == BATTEN_F32 && device->has_correct_f32
	                   ? " -cl-fp32-correctly-rounded-divide-sqrt"
	                   : "");
	batten_status status = device_program_build(engine->session, "multilevel",
	                                            kernel_source_multilevel, options, &engine->program,
	                                            NULL, &engine->test.build_s);
	if (status == BATTEN_OK)
		status = device_kernel_create(engine->program, "multilevel", &engine->kernel);
	if (status == BATTEN_OK && device_kernel_group_limit(engine->kernel) < shape->work_group)
		return batten_fail(engine->context, BATTEN_KERNEL,
		                   "device %zu (%s): the search kernel runs with at most %zu work-items a "
		                   "group, %u are asked for",
		                   shape->device, device->name, device_kernel_group_limit(engine->kernel),
		                   shape->work_group);
	if (status != BATTEN_OK)
		return batten_fail(engine->context, status, "device %zu: %s", shape->device,
		                   device_session_error(engine->session));
	return BATTEN_OK;
}

/* Known answers before the first use: wrong ones shut the device out. */
static batten_status test(search_engine *engine)
{
	const batten_status status = search_selftest_run(engine, &engine->test);
	if (status == BATTEN_MEMORY)
		return status;
	const batten_device *device = search_engine_device(engine);
	if (status != BATTEN_OK) {
		engine->test.result = BATTEN_SELFTEST_FAILED;
		(void)snprintf(engine->test.message, sizeof engine->test.message, "%s",
		               batten_context_error(engine->context));
	}
	if (engine->test.result == BATTEN_SELFTEST_FAILED)
		return batten_fail(engine->context, BATTEN_KERNEL, "device %zu (%s): self-test failed: %s",
		                   engine->shape.device, device->name, engine->test.message);
	return BATTEN_OK;
}

static batten_status check_device(const search_engine *engine)
{
	const batten_device *device = search_engine_device(engine);
	if (engine->shape.precision == BATTEN_F64 && !device->has_f64)
		return batten_fail(engine->context, BATTEN_DEVICE, "device %zu (%s) has no f64",
		                   engine->shape.device, device->name);
	return BATTEN_OK;
}

batten_status search_engine_open(batten_context *context, const search_shape *shape,
                                 search_engine **out, batten_selftest *result)
{
	for (search_engine *known = context->engines; known; known = known->next)
		if (same_shape(&known->shape, shape)) {
			if (result)
				*result = known->test;
			*out = known;
			return BATTEN_OK;
		}
	search_engine *engine = batten_allocate(context, 1, sizeof *engine);
	if (!engine)
		return BATTEN_MEMORY;
	engine->context = context;
	engine->shape = *shape;
	engine->test = (batten_selftest){ .kernel = "multilevel",
		                              .precision = shape->precision,
		                              .result = BATTEN_SELFTEST_FAILED };
	batten_status status = device_session_open(context, shape->device, &engine->session);
	if (status == BATTEN_OK)
		status = check_device(engine);
	if (status == BATTEN_DEVICE && engine->session)
		engine->test.result = BATTEN_SELFTEST_ABSENT;
	if (status == BATTEN_OK)
		status = build(engine);
	if (status == BATTEN_OK)
		status = test(engine);
	if (status != BATTEN_OK && !engine->test.message[0])
		(void)snprintf(engine->test.message, sizeof engine->test.message, "%s",
		               batten_context_error(context));
	if (result)
		*result = engine->test;
	if (status != BATTEN_OK) {
		engine_destroy(engine);
		return status;
	}
	engine->next = context->engines;
	context->engines = engine;
	*out = engine;
	return BATTEN_OK;
}

size_t search_engine_block(const search_engine *engine, const search_plan *plan)
{
	const batten_device *device = search_engine_device(engine);
	const size_t lanes = engine->shape.lanes;
	const size_t group_bytes = (SEARCH_ARRAY_COUNT + 3) * plan->node_count * lanes *
	                           bytes_of(engine->shape.precision);
	size_t limit = BLOCK_BYTES;
	if (device->max_allocation_bytes > 0 && limit > device->max_allocation_bytes)
		limit = (size_t)device->max_allocation_bytes;
	const size_t most = engine->context->options.max_memory;
	if (most > 0 && limit > most)
		limit = most;
	size_t groups = (size_t)device->compute_units * BLOCK_ROUNDS;
	if (groups > limit / group_bytes)
		groups = limit / group_bytes;
	return (groups ? groups : 1) * lanes;
}

/* Host memory and device buffers of one launch. */
typedef struct block {
	void *stencils, *arrays, *settings, *outcome;
	device_buffer *levels_on, *centres_on, *stencils_on, *arrays_on, *settings_on, *outcome_on,
		*state_on;
	size_t groups, lanes;
	size_t arrays_size, settings_size, outcome_size; /* bytes of one group */
} block;

static void block_release(search_engine *engine, block *b)
{
	device_buffer *buffers[] = { b->levels_on,   b->centres_on, b->stencils_on, b->arrays_on,
		                         b->settings_on, b->outcome_on, b->state_on };
	for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
		device_buffer_destroy(buffers[i]);
	void *memory[] = { b->stencils, b->arrays, b->settings, b->outcome };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(engine->context, memory[i]);
}

static batten_status block_allocate(search_engine *engine, const search_plan *plan, size_t count,
                                    block *b)
{
	batten_context *context = engine->context;
	const size_t number = bytes_of(engine->shape.precision);
	b->lanes = engine->shape.lanes;
	b->groups = (count + b->lanes - 1) / b->lanes;
	b->arrays_size = SEARCH_ARRAY_COUNT * plan->node_count * b->lanes * number;
	b->settings_size = SEARCH_SETTING_COUNT * b->lanes * number;
	b->outcome_size = SEARCH_OUTCOME_COUNT * b->lanes * number;
	b->stencils = batten_allocate(context, search_stencil_count(plan), number);
	b->arrays = batten_allocate(context, b->groups, b->arrays_size);
	b->settings = batten_allocate(context, b->groups, b->settings_size);
	b->outcome = batten_allocate(context, b->groups, b->outcome_size);
	return b->stencils && b->arrays && b->settings && b->outcome ? BATTEN_OK : BATTEN_MEMORY;
}

static batten_status block_upload(search_engine *engine, const search_plan *plan, block *b)
{
	const size_t number = bytes_of(engine->shape.precision);
	/* An OpenCL buffer cannot be empty. */
	const size_t centres = (2 * plan->direction_count + 1) * sizeof(int32_t);
	const size_t state = engine->shape.global_state
	                         ? 3 * plan->node_count * b->lanes * number * b->groups
	                         : 0;
	const struct {
		device_buffer **buffer;
		size_t size;
		const void *from;
	} uploads[] = {
		{ &b->levels_on, (size_t)plan->level_count * sizeof plan->levels[0], plan->levels },
		{ &b->centres_on, centres, plan->centres },
		{ &b->stencils_on, search_stencil_count(plan) * number, b->stencils },
		{ &b->arrays_on, b->groups * b->arrays_size, b->arrays },
		{ &b->settings_on, b->groups * b->settings_size, b->settings },
		{ &b->outcome_on, b->groups * b->outcome_size, NULL },
		{ &b->state_on, state, NULL },
	};
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < sizeof uploads / sizeof uploads[0] && status == BATTEN_OK; i++)
		if (uploads[i].size > 0)
			status = device_buffer_create(engine->session, uploads[i].size, uploads[i].from,
			                              uploads[i].buffer);
	return status;
}

static batten_status block_launch(search_engine *engine, const search_plan *plan, block *b)
{
	const size_t lane_bytes = b->lanes * bytes_of(engine->shape.precision);
	const int32_t numbers[] = { (int32_t)plan->station_count, (int32_t)plan->waterline_count,
		                        plan->level_count, (int32_t)plan->options.iteration_limit };
	const size_t group = engine->shape.work_group;
	const device_argument arguments[] = {
		{ .size = sizeof(int32_t), .value = &numbers[0] },
		{ .size = sizeof(int32_t), .value = &numbers[1] },
		{ .size = sizeof(int32_t), .value = &numbers[2] },
		{ .size = sizeof(int32_t), .value = &numbers[3] },
		{ .buffer = b->levels_on },
		{ .buffer = b->centres_on },
		{ .buffer = b->stencils_on },
		{ .buffer = b->arrays_on },
		{ .buffer = b->settings_on },
		{ .buffer = b->outcome_on },
		{ .buffer = b->state_on, .size = b->state_on ? 0 : 3 * plan->node_count * lane_bytes },
		{ .size = plan->waterline_count * lane_bytes },
		{ .size = 2 * group * lane_bytes },
	};
	batten_status status = device_launch(engine->session, engine->kernel, arguments,
	                                     sizeof arguments / sizeof arguments[0], b->groups, group);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->arrays_on, b->groups * b->arrays_size, b->arrays);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->outcome_on, b->groups * b->outcome_size, b->outcome);
	return status;
}

batten_status search_engine_run(search_engine *engine, const search_plan *plan,
                                const batten_search_problem *problems, const size_t *which,
                                size_t count, double *y_m, batten_search_result *results)
{
	block b = { 0 };
	const size_t nodes = plan->station_count * plan->waterline_count;
	const size_t lanes = engine->shape.lanes;
	batten_status status = block_allocate(engine, plan, count, &b);
	if (status == BATTEN_OK) {
		search_pack_stencils(plan, b.stencils);
		for (size_t i = 0; i < count; i++)
			search_pack(plan, &problems[which[i]], i % lanes, lanes,
			            (char *)b.arrays + i / lanes * b.arrays_size,
			            (char *)b.settings + i / lanes * b.settings_size);
		status = block_upload(engine, plan, &b);
		if (status == BATTEN_OK)
			status = block_launch(engine, plan, &b);
		if (status != BATTEN_OK)
			status = batten_fail(engine->context, status, "device %zu: %s", engine->shape.device,
			                     device_session_error(engine->session));
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		search_unpack(plan, &problems[which[i]], i % lanes, lanes,
		              (char *)b.arrays + i / lanes * b.arrays_size,
		              (char *)b.outcome + i / lanes * b.outcome_size, y_m + which[i] * nodes,
		              &results[which[i]]);
	block_release(engine, &b);
	return status;
}
