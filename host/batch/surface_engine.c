#include "batch/surface_engine.h"

#include "batch/surface_pack.h"
#include "batch/surface_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>

/* Most bytes one launch gives back: enough to hide the launch, few enough to stay in the cache until
 * they are read. Most groups of lanes a run packs at a time. */
enum { LAUNCH_BYTES = 1 << 20, BLOCK_GROUPS = 16 };

batten_status surface_engine_open(const surface_plan *plan, size_t index,
                                  const batten_device *device, batch_engine **out,
                                  batten_selftest *result)
{
	batten_context *context = plan->context;
	batch_engine_recipe recipe = { .kernel = "surface_grid",
		                           .source = kernel_source_surface_grid,
		                           .device = index,
		                           .precision = plan->precision,
		                           .lanes = plan->lanes,
		                           .work_group = plan->work_group };
	batch_engine_shape_choose(device, recipe.precision, &recipe.lanes, &recipe.work_group);
	(void)snprintf(recipe.options, sizeof recipe.options,
	               "-DSURFACE_OUTPUT=%d -DORDER_U=%zu -DORDER_V=%zu -DRATIONAL=%d", plan->output,
	               plan->u.order, plan->v.order, plan->rational);
	batch_engine *made = batch_engine_find(context, &recipe);
	batten_status status = BATTEN_OK;
	if (!made) {
		made = batten_allocate(context, 1, sizeof *made);
		if (!made)
			return BATTEN_MEMORY;
		status = batch_engine_start(made, context, &recipe);
		if (status == BATTEN_OK)
			status = batch_engine_judge(made, surface_selftest_run(made, plan));
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

size_t surface_engine_block(const batch_engine *engine, const surface_plan *plan)
{
	(void)plan;
	return (size_t)BLOCK_GROUPS * engine->recipe.lanes;
}

/* Host memory and device buffers of one run. */
typedef struct block {
	const surface_plan *plan;
	size_t lanes, lane_bytes, groups;
	size_t net_bytes, line_bytes; /* of one group */
	size_t launch_groups, launch_lines;
	void *table_u, *table_v, *nets, *least_areas, *out;
	device_buffer *first_u_on, *first_v_on, *table_u_on, *table_v_on, *nets_on, *least_areas_on,
		*out_on;
} block;

static void block_release(const batch_engine *engine, block *b)
{
	device_buffer *buffers[] = { b->first_u_on, b->first_v_on,     b->table_u_on, b->table_v_on,
		                         b->nets_on,    b->least_areas_on, b->out_on };
	for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
		device_buffer_destroy(buffers[i]);
	void *memory[] = { b->table_u, b->table_v, b->nets, b->least_areas, b->out };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(engine->context, memory[i]);
}

/* Whole groups where they are small, else a part of the lines of one. */
static void block_divide(const batch_engine *engine, block *b)
{
	const batten_device *device = batch_engine_device(engine);
	size_t limit = LAUNCH_BYTES;
	if (device->max_allocation_bytes > 0 && limit > device->max_allocation_bytes)
		limit = (size_t)device->max_allocation_bytes;
	const size_t lines = b->plan->v.count;
	const size_t fit = limit / b->line_bytes > 0 ? limit / b->line_bytes : 1;
	b->launch_lines = fit < lines ? fit : lines;
	b->launch_groups = fit / lines > 0 ? fit / lines : 1;
	if (b->launch_groups > b->groups)
		b->launch_groups = b->groups;
}

static batten_status block_allocate(const batch_engine *engine, const surface_plan *plan,
                                    size_t count, block *b)
{
	batten_context *context = engine->context;
	b->plan = plan;
	b->lanes = engine->recipe.lanes;
	b->lane_bytes = b->lanes * batch_engine_number_size(engine->recipe.precision);
	b->groups = (count + b->lanes - 1) / b->lanes;
	b->net_bytes = surface_pack_net_count(plan) * b->lane_bytes;
	b->line_bytes = surface_plan_line_size(plan) * b->lane_bytes;
	block_divide(engine, b);
	b->table_u = batten_allocate(context, 1, surface_pack_table_size(plan, &plan->u));
	b->table_v = batten_allocate(context, 1, surface_pack_table_size(plan, &plan->v));
	b->nets = batten_allocate(context, b->groups, b->net_bytes);
	b->least_areas = batten_allocate(context, b->groups, b->lane_bytes);
	b->out = batten_allocate(context, b->launch_groups * b->launch_lines, b->line_bytes);
	return b->table_u && b->table_v && b->nets && b->least_areas && b->out ? BATTEN_OK
	                                                                       : BATTEN_MEMORY;
}

/* A lane left over works the last surface again, so that it meets no rounding of its own. */
static void block_pack(block *b, const size_t *which, size_t count)
{
	surface_pack_table(b->plan, &b->plan->u, b->table_u);
	surface_pack_table(b->plan, &b->plan->v, b->table_v);
	for (size_t i = 0; i < b->groups * b->lanes; i++)
		surface_pack_net(b->plan, &b->plan->items[which[i < count ? i : count - 1]], i % b->lanes,
		                 b->lanes, (char *)b->nets + i / b->lanes * b->net_bytes,
		                 (char *)b->least_areas + i / b->lanes * b->lane_bytes);
}

static batten_status block_upload(const batch_engine *engine, block *b)
{
	const surface_plan *plan = b->plan;
	const struct {
		device_buffer **buffer;
		size_t size;
		const void *from;
	} uploads[] = {
		{ &b->first_u_on, plan->u.count * sizeof *plan->u.first, plan->u.first },
		{ &b->first_v_on, plan->v.count * sizeof *plan->v.first, plan->v.first },
		{ &b->table_u_on, surface_pack_table_size(plan, &plan->u), b->table_u },
		{ &b->table_v_on, surface_pack_table_size(plan, &plan->v), b->table_v },
		{ &b->nets_on, b->groups * b->net_bytes, b->nets },
		{ &b->least_areas_on, b->groups * b->lane_bytes, b->least_areas },
		{ &b->out_on, b->launch_groups * b->launch_lines * b->line_bytes, NULL },
	};
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < sizeof uploads / sizeof uploads[0] && status == BATTEN_OK; i++)
		status = device_buffer_create(engine->session, uploads[i].size, uploads[i].from,
		                              uploads[i].buffer);
	return status;
}

static batten_status block_launch(const batch_engine *engine, block *b, size_t first_group,
                                  size_t groups, size_t first_line, size_t lines)
{
	const surface_plan *plan = b->plan;
	const bool sums = plan->output == SURFACE_OUTPUT_ENERGY;
	const size_t segments = plan->u.count / plan->segment_length;
	const size_t row = plan->u.poles * surface_plan_derivatives(plan) *
	                   surface_plan_dimension(plan);
	const size_t gathered = sums ? segments * SURFACE_SUM_COUNT : 1;
	const int32_t numbers[] = {
		(int32_t)first_group,  (int32_t)first_line,           (int32_t)lines,
		(int32_t)segments,     (int32_t)plan->segment_length, (int32_t)plan->u.poles,
		(int32_t)plan->v.poles
	};
	enum { NUMBER_COUNT = sizeof numbers / sizeof numbers[0] };
	device_argument arguments[] = {
		{ 0 },
		{ 0 },
		{ 0 },
		{ 0 },
		{ 0 },
		{ 0 },
		{ 0 },
		{ .buffer = b->first_v_on },
		{ .buffer = b->first_u_on },
		{ .buffer = b->table_v_on },
		{ .buffer = b->table_u_on },
		{ .buffer = b->nets_on },
		{ .buffer = b->least_areas_on },
		{ .buffer = b->out_on },
		{ .size = row * b->lane_bytes },
		{ .size = gathered * b->lane_bytes },
	};
	for (size_t n = 0; n < NUMBER_COUNT; n++)
		arguments[n] = (device_argument){ .size = sizeof numbers[n], .value = &numbers[n] };
	if ((row + gathered) * b->lane_bytes > batch_engine_device(engine)->local_memory_bytes)
		return batten_fail(
			engine->context, BATTEN_KERNEL,
			"device %zu (%s): a net of %zu poles along u does not fit its local memory",
			engine->recipe.device, batch_engine_device(engine)->name, plan->u.poles);
	batten_status status = device_launch(engine->session, engine->kernel, arguments,
	                                     sizeof arguments / sizeof arguments[0], groups * lines,
	                                     engine->recipe.work_group);
	if (status == BATTEN_OK)
		status = device_buffer_read(b->out_on, groups * lines * b->line_bytes, b->out);
	return status == BATTEN_OK ? status : batch_engine_fail(engine, status);
}

/* Line by line, so that a line is still in the cache for its last lane. */
static void block_unpack(const block *b, const size_t *which, size_t count, size_t first_group,
                         size_t groups, size_t first_line, size_t lines)
{
	for (size_t n = 0; n < groups * lines; n++)
		for (size_t lane = 0; lane < b->lanes; lane++) {
			const size_t item = (first_group + n / lines) * b->lanes + lane;
			if (item < count)
				surface_unpack(b->plan, which[item], first_line + n % lines, lane, b->lanes,
				               (const char *)b->out + n * b->line_bytes);
		}
}

batten_status surface_engine_run(batch_engine *engine, const surface_plan *plan,
                                 const size_t *which, size_t count)
{
	block b = { 0 };
	batten_status status = block_allocate(engine, plan, count, &b);
	if (status == BATTEN_OK) {
		block_pack(&b, which, count);
		status = block_upload(engine, &b);
		if (status != BATTEN_OK)
			status = batch_engine_fail(engine, status);
	}
	for (size_t g = 0; g < b.groups && status == BATTEN_OK; g += b.launch_groups) {
		const size_t groups = g + b.launch_groups < b.groups ? b.launch_groups : b.groups - g;
		for (size_t k = 0; k < plan->v.count && status == BATTEN_OK; k += b.launch_lines) {
			const size_t left = plan->v.count - k;
			const size_t lines = b.launch_lines < left ? b.launch_lines : left;
			status = block_launch(engine, &b, g, groups, k, lines);
			if (status == BATTEN_OK)
				block_unpack(&b, which, count, g, groups, k, lines);
		}
	}
	block_release(engine, &b);
	return status;
}
