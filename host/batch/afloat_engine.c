#include "batch/afloat_engine.h"

#include "batch/afloat_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>

/* Most bytes of surfaces in one launch and how many rounds the compute units get: a surface takes long
 * enough to hide the launch. Work-items of a GPU: each takes drafts of its own. */
enum { BLOCK_BYTES = 16 << 20, BLOCK_ROUNDS = 8, GPU_ITEMS = 8 };

static size_t room_bytes(const afloat_plan *plan, const batch_engine_recipe *recipe)
{
	return afloat_plan_room(plan, recipe->work_group) * recipe->lanes * sizeof(double);
}

static bool room_is_global(const afloat_plan *plan, const batch_engine_recipe *recipe,
                           const batten_device *device)
{
	return room_bytes(plan, recipe) > device->local_memory_bytes;
}

static batten_status run_selftest(batch_engine *engine, const void *plan)
{
	(void)plan;
	return afloat_selftest_run(engine);
}

batten_status afloat_engine_open(const afloat_plan *plan, size_t index, const batten_device *device,
                                 batch_engine **out, batten_selftest *result)
{
	batch_engine_recipe recipe = { .kernel = "surface_hydrostatics",
		                           .source = kernel_source_surface_hydrostatics,
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

size_t afloat_engine_block(const batch_engine *engine, const afloat_plan *plan)
{
	const batten_device *device = batch_engine_device(engine);
	const size_t numbers = afloat_plan_net(plan) + afloat_plan_outcome(plan);
	const size_t group_bytes = numbers * sizeof(double) * engine->recipe.lanes +
	                           room_bytes(plan, &engine->recipe);
	const size_t limit = batch_engine_launch_bytes(engine, BLOCK_BYTES);
	size_t groups = (size_t)device->compute_units * BLOCK_ROUNDS;
	if (groups > limit / group_bytes)
		groups = limit / group_bytes;
	return (groups ? groups : 1) * engine->recipe.lanes;
}

/* Host memory and device buffers of one launch. */
typedef struct block {
	double *poles, *out;
	device_buffer *shape_on, *lists_on, *tables_on, *poles_on, *out_on, *room_on;
	size_t groups, lanes;
	size_t net_size, out_size; /* numbers of one group */
} block;

static void block_release(const batch_engine *engine, block *b)
{
	device_buffer *buffers[] = { b->shape_on, b->lists_on, b->tables_on,
		                         b->poles_on, b->out_on,   b->room_on };
	for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
		device_buffer_destroy(buffers[i]);
	batten_release(engine->context, b->poles);
	batten_release(engine->context, b->out);
}

static batten_status block_allocate(const batch_engine *engine, const afloat_plan *plan,
                                    size_t count, block *b)
{
	b->lanes = engine->recipe.lanes;
	b->groups = (count + b->lanes - 1) / b->lanes;
	b->net_size = afloat_plan_net(plan) * b->lanes;
	b->out_size = afloat_plan_outcome(plan) * b->lanes;
	b->poles = batten_allocate(engine->context, b->groups, b->net_size * sizeof(double));
	b->out = batten_allocate(engine->context, b->groups, b->out_size * sizeof(double));
	return b->poles && b->out ? BATTEN_OK : BATTEN_MEMORY;
}

static batten_status block_upload(const batch_engine *engine, const afloat_plan *plan, block *b)
{
	const bool global = room_is_global(plan, &engine->recipe, batch_engine_device(engine));
	const batch_engine_upload uploads[] = {
		{ &b->shape_on, sizeof plan->shape, plan->shape },
		{ &b->lists_on, plan->list_count * sizeof *plan->lists, plan->lists },
		{ &b->tables_on, plan->table_count * sizeof *plan->tables, plan->tables },
		{ &b->poles_on, b->groups * b->net_size * sizeof(double), b->poles },
		{ &b->out_on, b->groups * b->out_size * sizeof(double), NULL },
		{ &b->room_on, global ? room_bytes(plan, &engine->recipe) * b->groups : 0, NULL },
	};
	return batch_engine_upload_all(engine, uploads, sizeof uploads / sizeof uploads[0]);
}

static batten_status block_launch(const batch_engine *engine, const afloat_plan *plan, block *b)
{
	const device_argument arguments[] = {
		{ .buffer = b->shape_on },
		{ .buffer = b->lists_on },
		{ .buffer = b->tables_on },
		{ .buffer = b->poles_on },
		{ .buffer = b->out_on },
		{ .buffer = b->room_on, .size = b->room_on ? 0 : room_bytes(plan, &engine->recipe) },
	};
	const batten_status status = device_launch(engine->session, engine->kernel, arguments,
	                                           sizeof arguments / sizeof arguments[0], b->groups,
	                                           engine->recipe.work_group);
	return status == BATTEN_OK
	           ? device_buffer_read(b->out_on, b->groups * b->out_size * sizeof(double), b->out)
	           : status;
}

batten_status afloat_engine_run(batch_engine *engine, const afloat_plan *plan, const size_t *which,
                                size_t count)
{
	block b = { .lanes = 0 };
	batten_status status = block_allocate(engine, plan, count, &b);
	if (status == BATTEN_OK) {
		/* lanes left over repeat the last surface */
		for (size_t i = 0; i < b.groups * b.lanes; i++)
			afloat_pack(plan, which[i < count ? i : count - 1], i % b.lanes, b.lanes,
			            b.poles + i / b.lanes * b.net_size);
		status = block_upload(engine, plan, &b);
		if (status == BATTEN_OK)
			status = block_launch(engine, plan, &b);
		if (status != BATTEN_OK)
			status = batch_engine_fail(engine, status);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		afloat_unpack(plan, which[i], i % b.lanes, b.lanes, b.out + i / b.lanes * b.out_size);
	block_release(engine, &b);
	return status;
}
