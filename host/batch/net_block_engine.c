#include "batch/net_block_engine.h"

#include "batch/net_block_pack.h"
#include "batch/net_block_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>

/* Searches a lane of a launch and groups a compute unit: lanes that come free take the next search, so the more of
 * them, the less do lanes stand idle. A CPU has one group a unit, whose state fills its caches. */
enum { SEARCHES_A_LANE = 32, GPU_GROUPS_A_UNIT = 2 };
/* Of a GPU, by measurement (bench/README.md, what was tried). */
enum { GPU_ABREAST = 16, GPU_TOGETHER = 16 };

static batten_status run_selftest(batch_engine *engine, const void *plan)
{
	return net_block_selftest_run(engine, plan);
}

batten_status net_block_engine_open(const net_plan *plan, size_t index, const batten_device *device,
                                    batch_engine **out, batten_selftest *result)
{
	batch_engine_recipe recipe = { .kernel = "net_block",
		                           .source = kernel_source_net_block,
		                           .device = index,
		                           .precision = plan->options.precision,
		                           .lanes = plan->options.lanes,
		                           .work_group = plan->options.work_group };
	net_block_shape shape;
	const batten_status status = net_block_shape_of(plan, &shape);
	if (status != BATTEN_OK)
		return status;
	batch_engine_shape_abreast(device, GPU_ABREAST, GPU_TOGETHER, &recipe);
	(void)snprintf(recipe.options, sizeof recipe.options,
	               "-DNET_FAIRNESS=%d -DNET_ORDER_U=%zu -DNET_ORDER_V=%zu -DNET_POINTS_U=%zu "
	               "-DNET_POINTS_V=%zu",
	               plan->fairness, shape.u->order, shape.v->order, shape.u->points,
	               shape.v->points);
	return batch_engine_open(plan->context, &recipe, run_selftest, plan, out, result);
}

static size_t units_of(const batch_engine *engine)
{
	const batten_device *device = batch_engine_device(engine);
	const size_t units = device->compute_units ? device->compute_units : 1;
	return device->is_cpu ? units : GPU_GROUPS_A_UNIT * units;
}

size_t net_block_engine_block(const batch_engine *engine)
{
	return units_of(engine) * engine->recipe.lanes * SEARCHES_A_LANE;
}

/* Host memory and device buffers of one launch. */
typedef struct block {
	const net_plan *plan;
	net_block_shape shape;
	size_t count;
	batch_engine_queues queues;
	size_t number, input_bytes, state_bytes; /* of a number; of a search; of all groups */
	bool alone;
	int32_t numbers[NET_BLOCK_SHAPE_SIZE];
	void *tables, *inputs, *settings, *outcomes, *ends;
	void *state; /* kept from launch to launch; NULL: the device's own */
	int32_t *followers, *turns;
	net_room *rooms;
	device_buffer *shape_on, *first_u_on, *first_v_on, *followers_on, *tables_on, *inputs_on,
		*settings_on, *outcomes_on, *ends_on, *turns_on, *state_on;
} block;

static void block_release(batch_engine *engine, block *b)
{
	device_buffer *buffers[] = { b->shape_on,  b->first_u_on, b->first_v_on,  b->followers_on,
		                         b->tables_on, b->inputs_on,  b->settings_on, b->outcomes_on,
		                         b->ends_on,   b->turns_on,   b->state_on };
	for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
		device_buffer_destroy(buffers[i]);
	void *memory[] = { b->tables, b->inputs, b->settings,  b->outcomes,
		               b->ends,   b->turns,  b->followers, b->rooms };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(engine->context, memory[i]);
}

/* Memory for the state that the engine keeps, so that its pages are there at the next launch; where the device works in
 * the host's. Lanes begin where vectors may. */
static void *state_memory(batch_engine *engine, size_t bytes)
{
	enum { APART = 128 };
	if (!batch_engine_device(engine)->is_cpu || engine->copies || bytes > SIZE_MAX - APART)
		return NULL;
	char *memory = batch_engine_memory(engine, bytes + APART, 1);
	return memory ? memory + (APART - (uintptr_t)memory % APART) : NULL;
}

static batten_status block_allocate(batch_engine *engine, block *b)
{
	batten_context *context = engine->context;
	const size_t poles = net_plan_poles(b->plan);
	const batten_status status = net_block_shape_of(b->plan, &b->shape);
	if (status != BATTEN_OK)
		return status;
	b->number = batch_engine_number_size(engine->recipe.precision);
	b->alone = batch_engine_together(&engine->recipe) == 1;
	const size_t state = net_block_state_numbers(&b->shape, b->alone) * engine->recipe.lanes *
	                     b->number;
	b->queues = batch_engine_queues_of(&engine->recipe, b->count,
	                                   batch_engine_groups_most(engine, units_of(engine), state));
	b->state_bytes = b->queues.groups * state;
	b->state = state_memory(engine, b->state_bytes);
	b->input_bytes = BLOCK_INPUT_COUNT * poles * b->number;
	b->tables = batten_allocate(context, net_block_table_count(&b->shape), b->number);
	b->inputs = batten_allocate(context, b->count, b->input_bytes);
	b->ends = batten_allocate(context, b->count, poles * b->number);
	b->settings = batten_allocate(context, b->count * BLOCK_SETTING_COUNT, b->number);
	b->outcomes = batten_allocate(context, b->count * BLOCK_OUTCOME_COUNT, b->number);
	b->turns = batten_allocate(context, b->queues.count, sizeof *b->turns);
	b->followers = batten_allocate(context, b->shape.followers + 1, 2 * sizeof *b->followers);
	b->rooms = batten_allocate(context, poles, sizeof *b->rooms);
	return b->tables && b->inputs && b->ends && b->settings && b->outcomes && b->turns &&
	               b->followers && b->rooms
	           ? BATTEN_OK
	           : BATTEN_MEMORY;
}

static void block_fill(const size_t *which, block *b)
{
	net_block_pack_shape(b->plan, &b->shape, b->alone, b->numbers);
	b->numbers[NET_BLOCK_COUNT] = (int32_t)b->count;
	b->numbers[NET_BLOCK_SHARE] = (int32_t)b->queues.share;
	net_block_pack_followers(b->plan, b->followers);
	net_block_pack_tables(b->plan, &b->shape, b->tables);
	for (size_t i = 0; i < b->count; i++)
		net_block_pack(b->plan, which[i], (char *)b->inputs + i * b->input_bytes,
		               (char *)b->settings + i * BLOCK_SETTING_COUNT * b->number, b->rooms);
}

static batten_status block_upload(const batch_engine *engine, block *b)
{
	/* An OpenCL buffer cannot be empty: the list of followers has room for one more. */
	const batch_engine_upload uploads[] = {
		{ &b->shape_on, sizeof b->numbers, b->numbers },
		{ &b->first_u_on, b->shape.u->count * sizeof *b->shape.u->first, b->shape.u->first },
		{ &b->first_v_on, b->shape.v->count * sizeof *b->shape.v->first, b->shape.v->first },
		{ &b->followers_on, (b->shape.followers + 1) * 2 * sizeof *b->followers, b->followers },
		{ &b->tables_on, net_block_table_count(&b->shape) * b->number, b->tables },
		{ &b->inputs_on, b->count * b->input_bytes, b->inputs },
		{ &b->settings_on, b->count * BLOCK_SETTING_COUNT * b->number, b->settings },
		{ &b->outcomes_on, b->count * BLOCK_OUTCOME_COUNT * b->number, NULL },
		{ &b->ends_on, b->count * net_plan_poles(b->plan) * b->number, NULL },
		{ &b->turns_on, b->queues.count * sizeof *b->turns, NULL },
		{ &b->state_on, b->state ? 0 : b->state_bytes, NULL },
	};
	batten_status status = batch_engine_upload_all(engine, uploads,
	                                               sizeof uploads / sizeof uploads[0]);
	if (status == BATTEN_OK && b->state)
		status = device_buffer_wrap(engine->session, b->state_bytes, b->state, &b->state_on);
	return status;
}

static batten_status block_launch(const batch_engine *engine, block *b)
{
	const device_argument arguments[] = {
		{ .buffer = b->shape_on },     { .buffer = b->first_u_on },  { .buffer = b->first_v_on },
		{ .buffer = b->followers_on }, { .buffer = b->tables_on },   { .buffer = b->inputs_on },
		{ .buffer = b->settings_on },  { .buffer = b->outcomes_on }, { .buffer = b->ends_on },
		{ .buffer = b->turns_on },     { .buffer = b->state_on },    { .size = sizeof(int32_t) },
	};
	batten_status status = device_launch(engine->session, engine->kernel, arguments,
	                                     sizeof arguments / sizeof arguments[0], b->queues.groups,
	                                     engine->recipe.work_group);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->ends_on, b->count * net_plan_poles(b->plan) * b->number,
		                            b->ends);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->outcomes_on, b->count * BLOCK_OUTCOME_COUNT * b->number,
		                            b->outcomes);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->turns_on, b->queues.count * sizeof *b->turns, b->turns);
	return status;
}

batten_status net_block_engine_run(batch_engine *engine, const net_plan *plan, const size_t *which,
                                   size_t count, uint64_t *lane_turns)
{
	block b = { .plan = plan, .count = count };
	batten_status status = block_allocate(engine, &b);
	if (status == BATTEN_OK) {
		block_fill(which, &b);
		status = block_upload(engine, &b);
		if (status == BATTEN_OK)
			status = block_launch(engine, &b);
		if (status != BATTEN_OK)
			status = batch_engine_fail(engine, status);
	}
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		net_block_unpack(plan, which[i], (char *)b.ends + i * net_plan_poles(plan) * b.number,
		                 (char *)b.outcomes + i * BLOCK_OUTCOME_COUNT * b.number);
	if (status == BATTEN_OK && lane_turns)
		*lane_turns += batch_engine_lane_turns(&engine->recipe, &b.queues, b.turns);
	block_release(engine, &b);
	return status;
}
