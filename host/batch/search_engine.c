#include "batch/search_engine.h"

#include "batch/search_pack.h"
#include "batch/search_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>
#include <string.h>

struct search_engine {
	batch_engine base; /* first: the context knows its engines by it */
	search_shape shape;
};

/* Most bytes of packed searches in one launch: large enough to hide a launch, small enough that a
 * batch of any size runs in bounded memory. */
enum { BLOCK_BYTES = 64 << 20, BLOCK_ROUNDS = 8 };
/* Of a GPU, by measurement (bench/README.md, what was tried). */
enum { GPU_GROUPS_A_UNIT = 64, GPU_ABREAST = 8, GPU_TOGETHER = 32 };

static batch_engine_recipe recipe_of(const search_shape *shape)
{
	return (batch_engine_recipe){ .kernel = shape->textbook ? "textbook" : "multilevel",
		                          .source = shape->textbook ? kernel_source_textbook
		                                                    : kernel_source_multilevel,
		                          .device = shape->device,
		                          .precision = shape->precision,
		                          .lanes = shape->lanes,
		                          .work_group = shape->work_group };
}

/* Bytes of a group's state. */
static size_t state_bytes(const search_plan *plan, const batch_engine_recipe *recipe)
{
	const size_t together = batch_engine_together(recipe);
	return SEARCH_STATE_NUMBERS(plan->node_count, plan->waterline_count, together) * recipe->lanes *
	       batch_engine_number_size(recipe->precision);
}

search_shape search_shape_choose(const search_plan *plan, size_t index, const batten_device *device)
{
	search_shape shape = { .device = index,
		                   .precision = plan->options.precision,
		                   .lanes = plan->options.lanes,
		                   .work_group = plan->options.work_group,
		                   .fairness = plan->fairness,
		                   .textbook = plan->options.algorithm == BATTEN_ALGORITHM_TEXTBOOK,
		                   .penalised = plan->penalties != NULL };
	batch_engine_recipe recipe = recipe_of(&shape);
	batch_engine_shape_abreast(device, GPU_ABREAST, GPU_TOGETHER, &recipe);
	shape.lanes = recipe.lanes;
	shape.work_group = recipe.work_group;
	shape.global_state = recipe.abreast || state_bytes(plan, &recipe) > device->local_memory_bytes;
	return shape;
}

batch_engine *search_engine_base(search_engine *e)
{
	return &e->base;
}

const search_shape *search_engine_shape(const search_engine *e)
{
	return &e->shape;
}

bool search_engine_is_strict(const search_engine *e)
{
	return batch_engine_is_strict(&e->base);
}

batten_status search_engine_open(batten_context *context, const search_shape *shape,
                                 search_engine **out, batten_selftest *result)
{
	batch_engine_recipe recipe = recipe_of(shape);
	recipe.abreast = batch_engine_stands_abreast(shape->lanes, shape->work_group);
	(void)snprintf(recipe.options, sizeof recipe.options, "%s -DGRID_FAIRNESS=%d%s",
	               batch_engine_state_option(shape->global_state), shape->fairness,
	               shape->penalised ? " -DGRID_PENALTY=1" : "");
	search_engine *made = (search_engine *)batch_engine_find(context, &recipe);
	batten_status status = BATTEN_OK;
	if (!made) {
		made = batten_allocate(context, 1, sizeof *made);
		if (!made)
			return BATTEN_MEMORY;
		made->shape = *shape;
		made->base.size = sizeof *made;
		status = batch_engine_start(&made->base, context, &recipe);
		if (status == BATTEN_OK)
			status = batch_engine_judge(&made->base, search_selftest_run(made, &made->base.test));
		if (status == BATTEN_OK)
			batch_engine_keep(&made->base);
	}
	if (result)
		*result = made->base.test;
	if (status != BATTEN_OK)
		batch_engine_destroy(&made->base);
	else
		*out = made;
	return status;
}

size_t search_engine_block(const search_engine *engine, const search_plan *plan)
{
	const batten_device *device = batch_engine_device(&engine->base);
	const size_t lanes = engine->shape.lanes;
	const size_t group_bytes = SEARCH_ARRAY_COUNT * plan->node_count * lanes *
	                               batch_engine_number_size(engine->shape.precision) +
	                           state_bytes(plan, &engine->base.recipe);
	const size_t limit = batch_engine_search_bytes(&engine->base, BLOCK_BYTES);
	size_t groups = (size_t)device->compute_units *
	                (device->is_cpu ? BLOCK_ROUNDS : GPU_GROUPS_A_UNIT);
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
		batten_release(engine->base.context, memory[i]);
}

static batten_status block_allocate(search_engine *engine, const search_plan *plan, size_t count,
                                    block *b)
{
	batten_context *context = engine->base.context;
	const size_t number = batch_engine_number_size(engine->shape.precision);
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
	const size_t number = batch_engine_number_size(engine->shape.precision);
	/* An OpenCL buffer cannot be empty. */
	const size_t centres = (2 * plan->direction_count + 1) * sizeof(int32_t);
	const size_t state = engine->shape.global_state
	                         ? state_bytes(plan, &engine->base.recipe) * b->groups
	                         : 0;
	const batch_engine_upload uploads[] = {
		{ &b->levels_on, (size_t)plan->level_count * sizeof plan->levels[0], plan->levels },
		{ &b->centres_on, centres, plan->centres },
		{ &b->stencils_on, search_stencil_count(plan) * number, b->stencils },
		{ &b->arrays_on, b->groups * b->arrays_size, b->arrays },
		{ &b->settings_on, b->groups * b->settings_size, b->settings },
		{ &b->outcome_on, b->groups * b->outcome_size, NULL },
		{ &b->state_on, state, NULL },
	};
	return batch_engine_upload_all(&engine->base, uploads, sizeof uploads / sizeof uploads[0]);
}

static batten_status block_launch(search_engine *engine, const search_plan *plan, block *b)
{
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
		{ .buffer = b->state_on,
		  .size = b->state_on ? 0 : state_bytes(plan, &engine->base.recipe) },
		{ .size = sizeof(int32_t) },
	};
	batten_status status = device_launch(engine->base.session, engine->base.kernel, arguments,
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
			search_pack(plan, problems, which[i], i % lanes, lanes,
			            (char *)b.arrays + i / lanes * b.arrays_size,
			            (char *)b.settings + i / lanes * b.settings_size);
		status = block_upload(engine, plan, &b);
		if (status == BATTEN_OK)
			status = block_launch(engine, plan, &b);
		if (status != BATTEN_OK)
			status = batch_engine_fail(&engine->base, status);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		search_unpack(plan, &problems[which[i]], i % lanes, lanes,
		              (char *)b.arrays + i / lanes * b.arrays_size,
		              (char *)b.outcome + i / lanes * b.outcome_size, y_m + which[i] * nodes,
		              &results[which[i]]);
	block_release(engine, &b);
	return status;
}
