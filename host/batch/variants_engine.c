#include "batch/variants_engine.h"

#include "batch/variants_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>
#include <string.h>

/* Most bytes of rows in one launch and how many rounds the compute units get: long enough to hide the
 * launch, small enough that a batch of any size runs in bounded memory. Work-items of a GPU: about as
 * many as a hull has stations. Turns after which a row that still looks for its hull is put off: most
 * need half as many, and one slow lane holds up the others of its group. */
enum { BLOCK_BYTES = 16 << 20, BLOCK_ROUNDS = 64, GPU_ITEMS = 16, TURNS = 12 };

static size_t room_bytes(const variants_plan *plan, const batch_engine_recipe *recipe)
{
	return variants_plan_room(plan, recipe->work_group) * recipe->lanes * sizeof(double);
}

static bool room_is_global(const variants_plan *plan, const batch_engine_recipe *recipe,
                           const batten_device *device)
{
	return room_bytes(plan, recipe) > device->local_memory_bytes;
}

static batten_status run_selftest(batch_engine *engine, const void *plan)
{
	(void)plan;
	return variants_selftest_run(engine);
}

batten_status variants_engine_open(const variants_plan *plan, size_t index,
                                   const batten_device *device, batch_engine **out,
                                   batten_selftest *result)
{
	batch_engine_recipe recipe = { .kernel = "hull_variants",
		                           .source = kernel_source_hull_variants,
		                           .device = index,
		                           .precision = BATTEN_F64,
		                           .lanes = plan->lanes,
		                           .work_group = plan->work_group };
	if (recipe.work_group == 0 && !device->is_cpu)
		recipe.work_group = GPU_ITEMS;
	batch_engine_shape_choose(device, recipe.precision, &recipe.lanes, &recipe.work_group);
	(void)snprintf(recipe.options, sizeof recipe.options, "%s",
	               batch_engine_state_option(room_is_global(plan, &recipe, device)));
	return batch_engine_open(plan->context, &recipe, run_selftest, plan, out, result);
}

/* Numbers that travel with a row. */
static size_t row_numbers(const variants_plan *plan)
{
	return VARIANTS_ASK_COUNT + variants_plan_nodes(plan) + variants_plan_outcome(plan);
}

size_t variants_engine_block(const batch_engine *engine, const variants_plan *plan)
{
	const batten_device *device = batch_engine_device(engine);
	const size_t group_bytes = (row_numbers(plan) * sizeof(double)) * engine->recipe.lanes +
	                           room_bytes(plan, &engine->recipe);
	const size_t limit = batch_engine_launch_bytes(engine, BLOCK_BYTES);
	size_t groups = (size_t)device->compute_units * BLOCK_ROUNDS;
	if (groups > limit / group_bytes)
		groups = limit / group_bytes;
	return (groups ? groups : 1) * engine->recipe.lanes;
}

/* Host memory and device buffers of one launch. A processor works in the memory of the engine itself: y and
 * out; the kernel's vectors want it to begin at a multiple of their size. */
typedef struct block {
	double *asked, *y, *out;
	bool direct;
	device_buffer *shape_on, *lists_on, *tables_on, *asked_on, *y_on, *out_on, *room_on;
	size_t groups, lanes;
	size_t asked_size, y_size, out_size; /* numbers of one group */
	int32_t shape[VARIANTS_SHAPE_SIZE];
} block;

static void block_release(const batch_engine *engine, block *b)
{
	device_buffer *buffers[] = { b->shape_on, b->lists_on, b->tables_on, b->asked_on,
		                         b->y_on,     b->out_on,   b->room_on };
	for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
		device_buffer_destroy(buffers[i]);
	batten_release(engine->context, b->asked);
}

enum { VECTOR_BYTES = 128 };

static double *next_vector(void *from)
{
	const uintptr_t at = (uintptr_t)from;
	return (double *)((char *)from + (VECTOR_BYTES - at % VECTOR_BYTES) % VECTOR_BYTES);
}

static batten_status block_allocate(batch_engine *engine, const variants_plan *plan, size_t count,
                                    block *b)
{
	batten_context *context = engine->context;
	b->lanes = engine->recipe.lanes;
	b->groups = (count + b->lanes - 1) / b->lanes;
	b->asked_size = VARIANTS_ASK_COUNT * b->lanes;
	b->y_size = variants_plan_nodes(plan) * b->lanes;
	b->out_size = variants_plan_outcome(plan) * b->lanes;
	b->direct = batch_engine_device(engine)->is_cpu && !engine->copies;
	b->asked = batten_allocate(context, b->groups, b->asked_size * sizeof(double));
	void *memory = batch_engine_memory(
		engine, 1, b->groups * (b->y_size + b->out_size) * sizeof(double) + 2 * VECTOR_BYTES);
	if (!b->asked || !memory)
		return BATTEN_MEMORY;
	b->y = next_vector(memory);
	b->out = next_vector(b->y + b->groups * b->y_size);
	return BATTEN_OK;
}

static batten_status block_upload(const batch_engine *engine, const variants_plan *plan, block *b)
{
	const bool global = room_is_global(plan, &engine->recipe, batch_engine_device(engine));
	const size_t y_bytes = b->groups * b->y_size * sizeof(double);
	const size_t out_bytes = b->groups * b->out_size * sizeof(double);
	const batch_engine_upload uploads[] = {
		{ &b->shape_on, sizeof b->shape, b->shape },
		{ &b->lists_on, plan->list_count * sizeof *plan->lists, plan->lists },
		{ &b->tables_on, plan->table_count * sizeof *plan->tables, plan->tables },
		{ &b->asked_on, b->groups * b->asked_size * sizeof(double), b->asked },
		{ &b->y_on, b->direct ? 0 : y_bytes, plan->y_m ? b->y : NULL },
		{ &b->out_on, b->direct ? 0 : out_bytes, NULL },
		{ &b->room_on, global ? room_bytes(plan, &engine->recipe) * b->groups : 0, NULL },
	};
	batten_status status = batch_engine_upload_all(engine, uploads,
	                                               sizeof uploads / sizeof uploads[0]);
	if (status == BATTEN_OK && b->direct)
		status = device_buffer_wrap(engine->session, y_bytes, b->y, &b->y_on);
	if (status == BATTEN_OK && b->direct)
		status = device_buffer_wrap(engine->session, out_bytes, b->out, &b->out_on);
	return status;
}

static batten_status block_fetch(const variants_plan *plan, block *b)
{
	device_buffer *const direct[] = { b->y_on, b->out_on };
	if (b->direct)
		return device_buffers_settle(direct, sizeof direct / sizeof direct[0]);
	batten_status status = device_buffer_read(b->out_on, b->groups * b->out_size * sizeof(double),
	                                          b->out);
	if (status == BATTEN_OK && plan->found_y_m)
		status = device_buffer_read(b->y_on, b->groups * b->y_size * sizeof(double), b->y);
	return status;
}

static batten_status block_launch(const batch_engine *engine, const variants_plan *plan, block *b)
{
	const device_argument arguments[] = {
		{ .buffer = b->shape_on },
		{ .buffer = b->lists_on },
		{ .buffer = b->tables_on },
		{ .buffer = b->asked_on },
		{ .buffer = b->y_on },
		{ .buffer = b->out_on },
		{ .buffer = b->room_on, .size = b->room_on ? 0 : room_bytes(plan, &engine->recipe) },
	};
	const batten_status status = device_launch(engine->session, engine->kernel, arguments,
	                                           sizeof arguments / sizeof arguments[0], b->groups,
	                                           engine->recipe.work_group);
	return status == BATTEN_OK ? block_fetch(plan, b) : status;
}

/* Rows in one launch, of at most so many turns each (0: however many). */
static batten_status run_turns(batch_engine *engine, const variants_plan *plan, const size_t *which,
                               size_t count, int turns)
{
	block b = { 0 };
	batten_status status = block_allocate(engine, plan, count, &b);
	if (status == BATTEN_OK) {
		memcpy(b.shape, plan->shape, sizeof b.shape);
		b.shape[VARIANTS_TURNS] = turns;
		/* lanes left over repeat the last row */
		for (size_t i = 0; i < b.groups * b.lanes; i++)
			variants_pack(plan, which[i < count ? i : count - 1], i % b.lanes, b.lanes,
			              b.asked + i / b.lanes * b.asked_size, b.y + i / b.lanes * b.y_size);
		status = block_upload(engine, plan, &b);
		if (status == BATTEN_OK)
			status = block_launch(engine, plan, &b);
		if (status != BATTEN_OK)
			status = batch_engine_fail(engine, status);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		variants_unpack(plan, which[i], i % b.lanes, b.lanes, b.y + i / b.lanes * b.y_size,
		                b.out + i / b.lanes * b.out_size);
	block_release(engine, &b);
	return status;
}

batten_status variants_engine_run(batch_engine *engine, const variants_plan *plan,
                                  const size_t *which, size_t count)
{
	batten_status status = run_turns(engine, plan, which, count, TURNS);
	if (status != BATTEN_OK || plan->shape[VARIANTS_METHOD] == VARIANTS_GIVEN)
		return status;
	size_t *slow = batten_allocate(engine->context, count, sizeof *slow);
	if (!slow)
		return BATTEN_MEMORY;
	size_t left = 0;
	for (size_t i = 0; i < count; i++)
		if (plan->out[which[i] * variants_plan_outcome(plan) + VARIANTS_OUT_END] ==
		    VARIANTS_END_UNFINISHED)
			slow[left++] = which[i];
	if (left > 0)
		status = run_turns(engine, plan, slow, left, 0);
	batten_release(engine->context, slow);
	return status;
}
