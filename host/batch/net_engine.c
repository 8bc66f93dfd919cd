#include "batch/net_engine.h"

#include "batch/net_pack.h"
#include "batch/net_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>

/* Most bytes of packed searches in one launch: large enough to hide a launch, small enough that a
 * batch of any size runs in bounded memory. */
enum { BLOCK_BYTES = 64 << 20, BLOCK_ROUNDS = 8 };
/* Of a GPU, as the search over offsets has them. */
enum { GPU_ABREAST = 8, GPU_TOGETHER = 32 };

/* Bytes of a group's state. */
static size_t state_bytes(const net_plan *plan, const batch_engine_recipe *recipe)
{
	const size_t together = batch_engine_together(recipe);
	return NET_STATE_NUMBERS(net_plan_poles(plan), plan->v.count, together) * recipe->lanes *
	       batch_engine_number_size(recipe->precision);
}

static bool state_is_global(const net_plan *plan, const batch_engine_recipe *recipe,
                            const batten_device *device)
{
	return recipe->abreast || state_bytes(plan, recipe) > device->local_memory_bytes;
}

static batten_status run_selftest(batch_engine *engine, const void *plan)
{
	return net_selftest_run(engine, plan);
}

batten_status net_engine_open(const net_plan *plan, size_t index, const batten_device *device,
                              batch_engine **out, batten_selftest *result)
{
	batch_engine_recipe recipe = { .kernel = "net_search",
		                           .source = kernel_source_net_search,
		                           .device = index,
		                           .precision = plan->options.precision,
		                           .lanes = plan->options.lanes,
		                           .work_group = plan->options.work_group };
	batch_engine_shape_abreast(device, GPU_ABREAST, GPU_TOGETHER, &recipe);
	(void)snprintf(recipe.options, sizeof recipe.options,
	               "-DNET_FAIRNESS=%d -DNET_ORDER_U=%zu -DNET_ORDER_V=%zu %s", plan->fairness,
	               plan->u.order, plan->v.order,
	               batch_engine_state_option(state_is_global(plan, &recipe, device)));
	return batch_engine_open(plan->context, &recipe, run_selftest, plan, out, result);
}

size_t net_engine_block(const batch_engine *engine, const net_plan *plan)
{
	const batten_device *device = batch_engine_device(engine);
	const size_t lane_bytes = engine->recipe.lanes *
	                          batch_engine_number_size(engine->recipe.precision);
	const size_t numbers = net_pack_sample_count(plan) + net_pack_kept_count(plan) +
	                       NET_ARRAY_COUNT * net_plan_poles(plan);
	const size_t group_bytes = numbers * lane_bytes + state_bytes(plan, &engine->recipe);
	const size_t limit = batch_engine_search_bytes(engine, BLOCK_BYTES);
	size_t groups = (size_t)device->compute_units * BLOCK_ROUNDS;
	if (groups > limit / group_bytes)
		groups = limit / group_bytes;
	return (groups ? groups : 1) * engine->recipe.lanes;
}

/* Host memory and device buffers of one launch. */
typedef struct block {
	void *tables, *heights, *samples, *arrays, *settings, *outcome;
	net_room *rooms;
	device_buffer *shape_on, *first_u_on, *first_v_on, *colours_on, *directions_on, *members_on,
		*heights_on, *tables_on, *samples_on, *arrays_on, *settings_on, *outcome_on, *kept_on,
		*state_on;
	size_t groups, lanes, number;
	size_t samples_size, arrays_size, settings_size, outcome_size; /* bytes of one group */
	int32_t shape[NET_SHAPE_SIZE];
} block;

static void block_release(const batch_engine *engine, block *b)
{
	device_buffer *buffers[] = { b->shape_on,      b->first_u_on, b->first_v_on,  b->colours_on,
		                         b->directions_on, b->members_on, b->heights_on,  b->tables_on,
		                         b->samples_on,    b->arrays_on,  b->settings_on, b->outcome_on,
		                         b->kept_on,       b->state_on };
	for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
		device_buffer_destroy(buffers[i]);
	void *memory[] = { b->tables,   b->heights, b->samples, b->arrays,
		               b->settings, b->outcome, b->rooms };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(engine->context, memory[i]);
}

static batten_status block_allocate(const batch_engine *engine, const net_plan *plan, size_t count,
                                    block *b)
{
	batten_context *context = engine->context;
	b->lanes = engine->recipe.lanes;
	b->number = batch_engine_number_size(engine->recipe.precision);
	const size_t lane_bytes = b->lanes * b->number;
	b->groups = (count + b->lanes - 1) / b->lanes;
	b->samples_size = net_pack_sample_count(plan) * lane_bytes;
	b->arrays_size = NET_ARRAY_COUNT * net_plan_poles(plan) * lane_bytes;
	b->settings_size = NET_SETTING_COUNT * lane_bytes;
	b->outcome_size = SEARCH_OUTCOME_COUNT * lane_bytes;
	b->tables = batten_allocate(context, net_pack_table_count(plan), b->number);
	b->heights = batten_allocate(context, plan->directions.member_count + 1, b->number);
	b->samples = batten_allocate(context, b->groups, b->samples_size);
	b->arrays = batten_allocate(context, b->groups, b->arrays_size);
	b->settings = batten_allocate(context, b->groups, b->settings_size);
	b->outcome = batten_allocate(context, b->groups, b->outcome_size);
	b->rooms = batten_allocate(context, net_plan_poles(plan), sizeof *b->rooms);
	return b->tables && b->heights && b->samples && b->arrays && b->settings && b->outcome &&
	               b->rooms
	           ? BATTEN_OK
	           : BATTEN_MEMORY;
}

static void block_pack(const net_plan *plan, const size_t *which, size_t count, block *b)
{
	net_pack_shape(plan, b->shape);
	net_pack_tables(plan, b->tables);
	net_pack_heights(plan, b->heights);
	for (size_t i = 0; i < count; i++) {
		const size_t group = i / b->lanes;
		net_pack(plan, which[i], i % b->lanes, b->lanes,
		         (char *)b->samples + group * b->samples_size,
		         (char *)b->arrays + group * b->arrays_size,
		         (char *)b->settings + group * b->settings_size, b->rooms);
	}
}

static batten_status block_upload(const batch_engine *engine, const net_plan *plan, block *b)
{
	const net_directions *d = &plan->directions;
	const bool global = state_is_global(plan, &engine->recipe, batch_engine_device(engine));
	const size_t state = state_bytes(plan, &engine->recipe) * b->groups;
	/* An OpenCL buffer cannot be empty: lists that may be have room for one more. */
	const batch_engine_upload uploads[] = {
		{ &b->shape_on, sizeof b->shape, b->shape },
		{ &b->first_u_on, plan->u.count * sizeof *plan->u.first, plan->u.first },
		{ &b->first_v_on, plan->v.count * sizeof *plan->v.first, plan->v.first },
		{ &b->colours_on, (d->colour_count + 1) * sizeof *d->colours, d->colours },
		{ &b->directions_on, (d->direction_count + 1) * NET_DIRECTION_SIZE * sizeof *d->directions,
		  d->directions },
		{ &b->members_on, (d->member_count + 1) * sizeof *d->members, d->members },
		{ &b->heights_on, (d->member_count + 1) * b->number, b->heights },
		{ &b->tables_on, net_pack_table_count(plan) * b->number, b->tables },
		{ &b->samples_on, b->groups * b->samples_size, b->samples },
		{ &b->arrays_on, b->groups * b->arrays_size, b->arrays },
		{ &b->settings_on, b->groups * b->settings_size, b->settings },
		{ &b->outcome_on, b->groups * b->outcome_size, NULL },
		{ &b->kept_on, b->groups * net_pack_kept_count(plan) * b->lanes * b->number, NULL },
		{ &b->state_on, global ? state : 0, NULL },
	};
	return batch_engine_upload_all(engine, uploads, sizeof uploads / sizeof uploads[0]);
}

static batten_status block_launch(const batch_engine *engine, const net_plan *plan, block *b)
{
	const size_t group = engine->recipe.work_group;
	const device_argument arguments[] = {
		{ .buffer = b->shape_on },
		{ .buffer = b->first_u_on },
		{ .buffer = b->first_v_on },
		{ .buffer = b->colours_on },
		{ .buffer = b->directions_on },
		{ .buffer = b->members_on },
		{ .buffer = b->heights_on },
		{ .buffer = b->tables_on },
		{ .buffer = b->samples_on },
		{ .buffer = b->arrays_on },
		{ .buffer = b->settings_on },
		{ .buffer = b->outcome_on },
		{ .buffer = b->kept_on },
		{ .buffer = b->state_on, .size = b->state_on ? 0 : state_bytes(plan, &engine->recipe) },
		{ .size = sizeof(int32_t) },
	};
	batten_status status = device_launch(engine->session, engine->kernel, arguments,
	                                     sizeof arguments / sizeof arguments[0], b->groups, group);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->arrays_on, b->groups * b->arrays_size, b->arrays);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->outcome_on, b->groups * b->outcome_size, b->outcome);
	return status;
}

batten_status net_engine_run(batch_engine *engine, const net_plan *plan, const size_t *which,
                             size_t count)
{
	block b = { 0 };
	batten_status status = block_allocate(engine, plan, count, &b);
	if (status == BATTEN_OK) {
		block_pack(plan, which, count, &b);
		status = block_upload(engine, plan, &b);
		if (status == BATTEN_OK)
			status = block_launch(engine, plan, &b);
		if (status != BATTEN_OK)
			status = batch_engine_fail(engine, status);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		net_unpack(plan, which[i], i % b.lanes, b.lanes,
		           (char *)b.arrays + i / b.lanes * b.arrays_size,
		           (char *)b.outcome + i / b.lanes * b.outcome_size, b.rooms);
	block_release(engine, &b);
	return status;
}
