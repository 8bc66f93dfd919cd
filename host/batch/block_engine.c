#include "batch/block_engine.h"

#include "batch/block_hats.h"
#include "batch/block_pack.h"
#include "batch/block_selftest.h"
#include "batch/search_pack.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>
#include <string.h>

/* Most bytes of packed searches in one launch, searches a lane of it, and groups a compute unit: lanes
 * that come free take the next search, so the more of them, the less do lanes stand idle. A GPU has as many groups
 * at work as it takes to wait for memory side by side (bench/README.md, what was tried). */
enum { BLOCK_BYTES = 8 << 20, SEARCHES_A_LANE = 32, GROUPS_A_UNIT = 2 };
enum { GPU_GROUPS_A_UNIT = 8, GPU_ABREAST = 4, GPU_TOGETHER = 16 };

/* Lines of probes that are kept: all where there are hats or rounds. */
static size_t slots_of(const search_plan *plan, const batch_engine_recipe *recipe,
                       block_course course)
{
	const bool all = course.hats > 0 || course.rounds > 0;
	const size_t together = batch_engine_together(recipe);
	return (all ? block_lines_of(plan).lines : together) + 2;
}

/* Numbers of a search's state. */
static size_t state_numbers(const search_plan *plan, const batch_engine_recipe *recipe,
                            block_course course)
{
	const block_lines_shape shape = block_lines_of(plan);
	return BLOCK_STATE_NUMBERS(shape.lines, shape.length, course.hats,
	                           slots_of(plan, recipe, course));
}

static batten_status run_selftest(batch_engine *engine, const void *plan)
{
	return block_selftest_run(engine, plan, &engine->test);
}

batten_status block_engine_open(const search_plan *plan, size_t index, const batten_device *device,
                                batch_engine **out, batten_selftest *result)
{
	batch_engine_recipe recipe = { .kernel = "block_search",
		                           .source = kernel_source_block_search,
		                           .device = index,
		                           .precision = plan->options.precision,
		                           .lanes = plan->options.lanes,
		                           .work_group = plan->options.work_group };
	batch_engine_shape_abreast(device, GPU_ABREAST, GPU_TOGETHER, &recipe);
	const block_course most = { .hats = block_hat_count(plan), .rounds = 1 };
	const size_t bytes = state_numbers(plan, &recipe, most) * recipe.lanes *
	                     batch_engine_number_size(recipe.precision);
	const bool global = recipe.abreast || bytes > device->local_memory_bytes;
	(void)snprintf(recipe.options, sizeof recipe.options, "%s -DBLOCK_ANALYTIC=%d",
	               batch_engine_state_option(global), plan->options.analytic_slopes);
	return batch_engine_open(plan->context, &recipe, run_selftest, plan, out, result);
}

static size_t units_of(const batch_engine *engine)
{
	const batten_device *device = batch_engine_device(engine);
	const size_t units = device->compute_units ? device->compute_units : 1;
	return units * (device->is_cpu ? GROUPS_A_UNIT : GPU_GROUPS_A_UNIT);
}

size_t block_engine_block(const batch_engine *engine, const search_plan *plan)
{
	const block_lines_shape shape = block_lines_of(plan);
	const size_t lanes = engine->recipe.lanes;
	const size_t search_bytes = BLOCK_INPUT_COUNT * shape.lines * shape.length *
	                            search_scalar_size(plan);
	const size_t limit = batch_engine_search_bytes(engine, BLOCK_BYTES);
	size_t searches = units_of(engine) * lanes * SEARCHES_A_LANE;
	if (searches > limit / search_bytes)
		searches = limit / search_bytes;
	return searches < lanes ? lanes : searches / lanes * lanes;
}

/* Host memory and device buffers of one launch. */
typedef struct block {
	const search_plan *plan;
	size_t count;
	batch_engine_queues queues;
	block_course course;
	size_t number, nodes; /* bytes of a number; numbers of an array */
	size_t input_bytes;
	bool direct; /* the device works in the host's memory, where ends take the place of starts */
	void *stencils, *inputs, *settings, *outcomes;
	void *ends; /* of searches, ends_apart numbers one from the next */
	size_t ends_apart;
	int32_t *turns;
	device_buffer *stencils_on, *inputs_on, *settings_on, *outcomes_on, *ends_on, *turns_on,
		*state_on;
} block;

static void block_release(batch_engine *engine, block *b)
{
	device_buffer *buffers[] = { b->stencils_on, b->inputs_on, b->settings_on, b->outcomes_on,
		                         b->ends_on,     b->turns_on,  b->state_on };
	for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
		device_buffer_destroy(buffers[i]);
	void *memory[] = { b->stencils, b->settings, b->outcomes, b->turns,
		               b->direct ? NULL : b->ends };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(engine->context, memory[i]);
}

static batten_status block_allocate(batch_engine *engine, block *b)
{
	batten_context *context = engine->context;
	const block_lines_shape shape = block_lines_of(b->plan);
	b->number = search_scalar_size(b->plan);
	b->nodes = shape.lines * shape.length;
	const size_t state = state_numbers(b->plan, &engine->recipe, b->course) * engine->recipe.lanes *
	                     b->number;
	b->queues = batch_engine_queues_of(&engine->recipe, b->count,
	                                   batch_engine_groups_most(engine, units_of(engine), state));
	b->stencils = batten_allocate(context, block_stencil_count(b->plan), b->number);
	b->input_bytes = BLOCK_INPUT_COUNT * b->nodes * b->number;
	b->direct = batch_engine_device(engine)->is_cpu && !engine->copies;
	b->inputs = batch_engine_memory(engine, b->count, b->input_bytes);
	b->ends_apart = b->direct ? BLOCK_INPUT_COUNT * b->nodes : b->nodes;
	b->ends = b->direct ? b->inputs : batten_allocate(context, b->count, b->nodes * b->number);
	b->settings = batten_allocate(context, b->count * BLOCK_SETTING_COUNT, b->number);
	b->outcomes = batten_allocate(context, b->count * BLOCK_OUTCOME_COUNT, b->number);
	b->turns = batten_allocate(context, b->queues.count, sizeof *b->turns);
	return b->stencils && b->inputs && b->ends && b->settings && b->outcomes && b->turns
	           ? BATTEN_OK
	           : BATTEN_MEMORY;
}

static batten_status block_fill(const batten_search_problem *problems, const size_t *which,
                                block *b)
{
	for (size_t i = 0; i < b->count; i++)
		block_pack(b->plan, &problems[which[i]], (char *)b->inputs + i * b->input_bytes,
		           (char *)b->settings + i * BLOCK_SETTING_COUNT * b->number);
	return block_pack_stencils(b->plan, b->stencils);
}

static bool is_global(const batch_engine *engine)
{
	return engine->recipe.options[strlen("-DSTATE=")] == 'g';
}

static batten_status block_upload(batch_engine *engine, block *b)
{
	const size_t state = state_numbers(b->plan, &engine->recipe, b->course) * engine->recipe.lanes *
	                     b->number * b->queues.groups;
	const batch_engine_upload uploads[] = {
		{ &b->stencils_on, block_stencil_count(b->plan) * b->number, b->stencils },
		{ &b->inputs_on, b->direct ? 0 : b->count * b->input_bytes, b->inputs },
		{ &b->settings_on, b->count * BLOCK_SETTING_COUNT * b->number, b->settings },
		{ &b->outcomes_on, b->count * BLOCK_OUTCOME_COUNT * b->number, NULL },
		{ &b->ends_on, b->direct ? 0 : b->count * b->nodes * b->number, NULL },
		{ &b->turns_on, b->queues.count * sizeof *b->turns, NULL },
		{ &b->state_on, is_global(engine) ? state : 0, NULL },
	};
	batten_status status = batch_engine_upload_all(engine, uploads,
	                                               sizeof uploads / sizeof uploads[0]);
	if (status == BATTEN_OK && b->direct)
		status = device_buffer_wrap(engine->session, b->count * b->input_bytes, b->inputs,
		                            &b->inputs_on);
	return status;
}

static batten_status block_launch(batch_engine *engine, block *b)
{
	const block_lines_shape shape = block_lines_of(b->plan);
	const size_t lane_bytes = engine->recipe.lanes * b->number;
	const int32_t numbers[] = { (int32_t)shape.lines,
		                        (int32_t)shape.length,
		                        (int32_t)b->course.hats,
		                        (int32_t)b->course.rounds,
		                        (int32_t)slots_of(b->plan, &engine->recipe, b->course),
		                        (int32_t)b->plan->options.iteration_limit,
		                        (int32_t)b->count,
		                        (int32_t)b->queues.share,
		                        (int32_t)b->ends_apart };
	const device_argument arguments[] = {
		{ .size = sizeof(int32_t), .value = &numbers[0] },
		{ .size = sizeof(int32_t), .value = &numbers[1] },
		{ .size = sizeof(int32_t), .value = &numbers[2] },
		{ .size = sizeof(int32_t), .value = &numbers[3] },
		{ .size = sizeof(int32_t), .value = &numbers[4] },
		{ .size = sizeof(int32_t), .value = &numbers[5] },
		{ .size = sizeof(int32_t), .value = &numbers[6] },
		{ .size = sizeof(int32_t), .value = &numbers[7] },
		{ .buffer = b->stencils_on },
		{ .buffer = b->inputs_on },
		{ .buffer = b->settings_on },
		{ .buffer = b->outcomes_on },
		{ .buffer = b->direct ? b->inputs_on : b->ends_on },
		{ .size = sizeof(int32_t), .value = &numbers[8] },
		{ .buffer = b->turns_on },
		{ .buffer = b->state_on,
		  .size = b->state_on ? 0
		                      : state_numbers(b->plan, &engine->recipe, b->course) * lane_bytes },
		{ .size = sizeof(int32_t) },
	};
	batten_status status = device_launch(engine->session, engine->kernel, arguments,
	                                     sizeof arguments / sizeof arguments[0], b->queues.groups,
	                                     engine->recipe.work_group);
	if (status == BATTEN_OK)
		status = b->direct
		             ? device_buffers_settle(&b->inputs_on, 1)
		             : device_buffer_read(b->ends_on, b->count * b->nodes * b->number, b->ends);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->outcomes_on, b->count * BLOCK_OUTCOME_COUNT * b->number,
		                            b->outcomes);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->turns_on, b->queues.count * sizeof *b->turns, b->turns);
	return status;
}

static bool is_same(block_course a, block_course b)
{
	return a.hats == b.hats && a.rounds == b.rounds;
}

/* Searches of one course. */
static batten_status run_alike(batch_engine *engine, const search_plan *plan,
                               const batten_search_problem *problems, const size_t *which,
                               size_t count, double *y_m, batten_search_result *results,
                               uint64_t *lane_turns)
{
	block b = { .plan = plan,
		        .count = count,
		        .course = block_course_of(plan, &problems[which[0]]) };
	batten_status status = block_allocate(engine, &b);
	if (status == BATTEN_OK) {
		status = block_fill(problems, which, &b);
		if (status == BATTEN_OK)
			status = block_upload(engine, &b);
		if (status == BATTEN_OK)
			status = block_launch(engine, &b);
		if (status != BATTEN_OK)
			status = batch_engine_fail(engine, status);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		block_unpack(plan, &problems[which[i]], (char *)b.ends + i * b.ends_apart * b.number,
		             (char *)b.outcomes + i * BLOCK_OUTCOME_COUNT * b.number,
		             y_m + which[i] * b.nodes, &results[which[i]]);
	if (status == BATTEN_OK && lane_turns)
		*lane_turns += batch_engine_lane_turns(&engine->recipe, &b.queues, b.turns);
	block_release(engine, &b);
	return status;
}

batten_status block_engine_run(batch_engine *engine, const search_plan *plan,
                               const batten_search_problem *problems, const size_t *which,
                               size_t count, double *y_m, batten_search_result *results,
                               uint64_t *lane_turns)
{
	batten_status status = BATTEN_OK;
	for (size_t first = 0, last = 0; first < count && status == BATTEN_OK; first = last) {
		const block_course course = block_course_of(plan, &problems[which[first]]);
		while (last < count && is_same(block_course_of(plan, &problems[which[last]]), course))
			last++;
		status = run_alike(engine, plan, problems, which + first, last - first, y_m, results,
		                   lane_turns);
	}
	return status;
}
