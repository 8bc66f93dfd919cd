#include "batch/surface_launch.h"

#include "batch/surface_pack.h"
#include "core/number.h"

/* Most bytes one launch gives back to be taken apart on the host: enough to hide the launch; on a CPU
 * few enough to stay in the cache until they are read. */
enum { LAUNCH_BYTES_CPU = 1 << 20, LAUNCH_BYTES = 1 << 24 };

/* Host memory and device buffers of one run. */
typedef struct block {
	const batch_engine *engine;
	const surface_plan *plan;
	size_t first, count; /* surfaces */
	size_t lanes, lane_bytes, groups;
	size_t net_bytes; /* of a group */
	/* Values go right to where the caller wants them, whole surfaces at a time. */
	bool direct, sums, doubles;
	size_t surface_bytes;             /* of the values of a line of a surface, as they come back */
	size_t sums_bytes, missing_bytes; /* of a line of a group */
	size_t launch_groups, launch_lines;
	void *table_u, *table_v, *nets, *least_areas, *values, *sums_of_lines;
	int32_t *missing;
	device_buffer *first_u_on, *first_v_on, *table_u_on, *table_v_on, *nets_on, *least_areas_on,
		*values_on, *sums_on, *missing_on;
} block;

/* What one launch works. */
typedef struct part {
	size_t group, groups, line, lines;
} part;

static const batten_device *device_of(const block *b)
{
	return batch_engine_device(b->engine);
}

static void block_release(block *b)
{
	batten_context *context = b->engine->context;
	device_buffer *buffers[] = { b->first_u_on, b->first_v_on, b->table_u_on,
		                         b->table_v_on, b->nets_on,    b->least_areas_on,
		                         b->values_on,  b->sums_on,    b->missing_on };
	for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
		device_buffer_destroy(buffers[i]);
	void *memory[] = { b->table_u, b->table_v,       b->nets,   b->least_areas,
		               b->values,  b->sums_of_lines, b->missing };
	for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
		batten_release(context, memory[i]);
}

/* Bytes of the values of whole surfaces in a group, 0 where that is too large a number. */
static size_t whole_group_bytes(const block *b)
{
	size_t bytes = b->lanes * surface_plan_values(b->plan) * surface_plan_number(b->plan);
	return batten_size_multiply(bytes, b->plan->u.count, &bytes) &&
	               batten_size_multiply(bytes, b->plan->v.count, &bytes)
	           ? bytes
	           : 0;
}

static size_t least_of(size_t a, size_t b)
{
	return a < b ? a : b;
}

/* Whole groups where they are small, else a part of the lines of one. */
static void block_divide(block *b)
{
	const batten_device *device = device_of(b);
	const size_t lines = b->plan->v.count;
	const size_t whole = whole_group_bytes(b);
	size_t most = device->max_allocation_bytes > 0 ? (size_t)device->max_allocation_bytes
	                                               : SIZE_MAX;
	const bool as_wanted = b->doubles != b->plan->floats;
	b->direct = !b->sums && as_wanted && device->is_cpu && b->lanes > 1 && whole > 0 &&
	            whole <= most;
	if (b->direct) {
		b->launch_lines = lines;
		b->launch_groups = least_of(most / whole, b->groups);
		return;
	}
	most = least_of(most, device->is_cpu ? LAUNCH_BYTES_CPU : LAUNCH_BYTES);
	const size_t line_bytes = b->sums ? b->sums_bytes : b->lanes * b->surface_bytes;
	const size_t fit = most / line_bytes > 0 ? most / line_bytes : 1;
	b->launch_lines = least_of(fit, lines);
	b->launch_groups = least_of(fit / lines > 0 ? fit / lines : 1, b->groups);
}

static void block_measure(block *b)
{
	const surface_plan *plan = b->plan;
	const batch_engine_recipe *recipe = &b->engine->recipe;
	b->lanes = recipe->lanes;
	b->lane_bytes = b->lanes * batch_engine_number_size(recipe->precision);
	b->groups = (b->count + b->lanes - 1) / b->lanes;
	b->net_bytes = surface_pack_net_count(plan) * b->lane_bytes;
	b->sums = SURFACE_SUMS(plan->output);
	b->doubles = surface_engine_returns_doubles(device_of(b), plan);
	b->surface_bytes = surface_plan_values(plan) * plan->u.count *
	                   (b->doubles ? sizeof(double) : sizeof(float));
	b->sums_bytes = SURFACE_SUM_COUNT * b->lane_bytes;
	b->missing_bytes = recipe->work_group * sizeof *b->missing;
	block_divide(b);
}

static batten_status block_allocate(block *b)
{
	batten_context *context = b->engine->context;
	const surface_plan *plan = b->plan;
	const size_t lines = b->launch_groups * b->launch_lines;
	b->table_u = batten_allocate(context, 1, surface_pack_table_size(plan, &plan->u));
	b->table_v = batten_allocate(context, 1, surface_pack_table_size(plan, &plan->v));
	b->nets = batten_allocate(context, b->groups, b->net_bytes);
	b->least_areas = batten_allocate(context, b->groups, b->lane_bytes);
	bool good = b->table_u && b->table_v && b->nets && b->least_areas;
	if (good && b->sums) {
		b->sums_of_lines = batten_allocate(context, lines, b->sums_bytes);
		good = b->sums_of_lines;
	} else if (good) {
		b->missing = batten_allocate(context, lines, b->missing_bytes);
		good = b->missing;
	}
	if (good && !b->sums && !b->direct) {
		b->values = batten_allocate(context, lines * b->lanes, b->surface_bytes);
		good = b->values;
	}
	return good ? BATTEN_OK : BATTEN_MEMORY;
}

/* A lane left over works the last surface again, so that it meets no rounding of its own. */
static void block_pack(block *b)
{
	surface_pack_table(b->plan, &b->plan->u, b->table_u);
	surface_pack_table(b->plan, &b->plan->v, b->table_v);
	for (size_t i = 0; i < b->groups * b->lanes; i++)
		surface_pack_net(b->plan, &b->plan->items[b->first + least_of(i, b->count - 1)],
		                 i % b->lanes, b->lanes, (char *)b->nets + i / b->lanes * b->net_bytes,
		                 (char *)b->least_areas + i / b->lanes * b->lane_bytes);
}

static batten_status block_upload(block *b)
{
	const surface_plan *plan = b->plan;
	const size_t lines = b->launch_groups * b->launch_lines;
	const batch_engine_upload uploads[] = {
		{ &b->first_u_on, plan->u.count * sizeof *plan->u.first, plan->u.first },
		{ &b->first_v_on, plan->v.count * sizeof *plan->v.first, plan->v.first },
		{ &b->table_u_on, surface_pack_table_size(plan, &plan->u), b->table_u },
		{ &b->table_v_on, surface_pack_table_size(plan, &plan->v), b->table_v },
		{ &b->nets_on, b->groups * b->net_bytes, b->nets },
		{ &b->least_areas_on, b->groups * b->lane_bytes, b->least_areas },
		{ &b->sums_on, b->sums ? lines * b->sums_bytes : 0, NULL },
		{ &b->missing_on, b->sums || b->direct ? 0 : lines * b->missing_bytes, NULL },
		{ &b->values_on, b->values ? lines * b->lanes * b->surface_bytes : 0, NULL },
	};
	batten_status status = batch_engine_upload_all(b->engine, uploads,
	                                               sizeof uploads / sizeof uploads[0]);
	if (status == BATTEN_OK && b->direct)
		status = device_buffer_wrap(b->engine->session, lines * b->missing_bytes, b->missing,
		                            &b->missing_on);
	return status;
}

/* Surfaces of a part, fewer than its lanes at the end of the block. */
static size_t part_surfaces(const block *b, const part *p)
{
	return least_of(p->groups * b->lanes, b->count - p->group * b->lanes);
}

static batten_status check_local_memory(const block *b, size_t bytes)
{
	if (bytes <= device_of(b)->local_memory_bytes)
		return BATTEN_OK;
	return batten_fail(b->engine->context, BATTEN_KERNEL,
	                   "device %zu (%s): a net of %zu poles along u does not fit its local memory",
	                   b->engine->recipe.device, device_of(b)->name, b->plan->u.poles);
}

static batten_status part_launch(const block *b, const part *p)
{
	const surface_plan *plan = b->plan;
	const size_t segments = plan->u.count / plan->segment_length;
	const size_t row = plan->u.poles * surface_plan_derivatives(plan) *
	                   surface_plan_dimension(plan);
	const size_t gathered = b->sums ? segments * SURFACE_SUM_COUNT : 1;
	const int32_t numbers[] = { (int32_t)p->group,      (int32_t)p->line,
		                        (int32_t)p->lines,      (int32_t)part_surfaces(b, p),
		                        (int32_t)segments,      (int32_t)plan->segment_length,
		                        (int32_t)plan->u.poles, (int32_t)plan->v.poles };
	enum { NUMBER_COUNT = sizeof numbers / sizeof numbers[0], ARGUMENT_COUNT = NUMBER_COUNT + 14 };
	const bool f64 = plan->precision == BATTEN_F64;
	const float light[] = { (float)plan->light[0], (float)plan->light[1], (float)plan->light[2] };
	/* What the output does not call for is never touched: any buffer will do. */
	device_argument arguments[ARGUMENT_COUNT] = {
		[NUMBER_COUNT + 3] = { .buffer = b->first_v_on },
		{ .buffer = b->first_u_on },
		{ .buffer = b->table_v_on },
		{ .buffer = b->table_u_on },
		{ .buffer = b->nets_on },
		{ .buffer = b->least_areas_on },
		{ .buffer = b->values_on ? b->values_on : b->least_areas_on },
		{ .buffer = b->sums ? b->sums_on : b->least_areas_on },
		{ .buffer = b->sums ? b->least_areas_on : b->missing_on },
		{ .size = row * b->lane_bytes },
		{ .size = gathered * b->lane_bytes },
	};
	for (size_t n = 0; n < NUMBER_COUNT; n++)
		arguments[n] = (device_argument){ .size = sizeof numbers[n], .value = &numbers[n] };
	for (size_t c = 0; c < 3; c++)
		arguments[NUMBER_COUNT + c] = (device_argument){
			.size = f64 ? sizeof plan->light[c] : sizeof light[c],
			.value = f64 ? (const void *)&plan->light[c] : (const void *)&light[c]
		};
	const batten_status status = check_local_memory(b, (row + gathered) * b->lane_bytes);
	return status != BATTEN_OK
	           ? status
	           : device_launch(b->engine->session, b->engine->kernel, arguments, ARGUMENT_COUNT,
	                           p->groups * p->lines, b->engine->recipe.work_group);
}

/* Values and sums as the device made them, to the caller. */
static batten_status part_read(const block *b, const part *p)
{
	const size_t lines = p->groups * p->lines;
	device_buffer *const direct[] = { b->values_on, b->missing_on };
	if (b->sums)
		return device_buffer_read(b->sums_on, lines * b->sums_bytes, b->sums_of_lines);
	if (b->direct)
		return device_buffers_settle(direct, sizeof direct / sizeof direct[0]);
	const batten_status status = device_buffer_read(
		b->values_on, part_surfaces(b, p) * p->lines * b->surface_bytes, b->values);
	return status == BATTEN_OK
	           ? device_buffer_read(b->missing_on, lines * b->missing_bytes, b->missing)
	           : status;
}

/* Whether a line of a group has a point without a normal. */
static bool is_missing(const block *b, size_t line)
{
	const size_t items = b->engine->recipe.work_group;
	bool missing = false;
	for (size_t i = 0; i < items; i++)
		missing = missing || b->missing[line * items + i] != 0;
	return missing;
}

static void part_unpack(const block *b, const part *p)
{
	const surface_plan *plan = b->plan;
	const size_t surfaces = part_surfaces(b, p);
	const size_t number = b->doubles ? sizeof(double) : sizeof(float);
	for (size_t s = 0; s < surfaces; s++)
		for (size_t k = 0; k < p->lines; k++) {
			const size_t which = b->first + p->group * b->lanes + s;
			const size_t line = s / b->lanes * p->lines + k;
			if (b->sums) {
				surface_add_sums(plan, which, p->line + k, s % b->lanes, b->lanes,
				                 (const char *)b->sums_of_lines + line * b->sums_bytes);
				continue;
			}
			if (!b->direct)
				surface_take_line(plan, which, p->line + k,
				                  (const char *)b->values + s * p->lines * b->surface_bytes +
				                      k * plan->u.count * number,
				                  b->doubles, p->lines * plan->u.count, 1);
			surface_mark_line(plan, which, p->line + k, is_missing(b, line));
		}
}

static batten_status part_run(block *b, const part *p)
{
	const surface_plan *plan = b->plan;
	const size_t bytes = surface_plan_values(plan) * plan->u.count * plan->v.count *
	                     surface_plan_number(plan);
	batten_status status = BATTEN_OK;
	if (b->direct)
		status = device_buffer_wrap(b->engine->session, part_surfaces(b, p) * bytes,
		                            (char *)plan->values + (b->first + p->group * b->lanes) * bytes,
		                            &b->values_on);
	if (status == BATTEN_OK)
		status = part_launch(b, p);
	if (status == BATTEN_OK)
		status = part_read(b, p);
	if (b->direct) {
		/* Nothing may write to the caller's memory any more. */
		if (status != BATTEN_OK)
			(void)device_finish(b->engine->session);
		device_buffer_destroy(b->values_on);
		b->values_on = NULL;
	}
	if (status == BATTEN_OK)
		part_unpack(b, p);
	return status;
}

static batten_status block_run(block *b)
{
	batten_status status = BATTEN_OK;
	part p = { 0 };
	for (p.group = 0; p.group < b->groups && status == BATTEN_OK; p.group += p.groups) {
		p.groups = least_of(b->launch_groups, b->groups - p.group);
		for (p.line = 0; p.line < b->plan->v.count && status == BATTEN_OK; p.line += p.lines) {
			p.lines = least_of(b->launch_lines, b->plan->v.count - p.line);
			status = part_run(b, &p);
		}
	}
	return status;
}

batten_status surface_launch_run(const batch_engine *engine, const surface_plan *plan, size_t first,
                                 size_t count)
{
	block b = { .engine = engine, .plan = plan, .first = first, .count = count };
	block_measure(&b);
	batten_status status = block_allocate(&b);
	if (status == BATTEN_OK) {
		block_pack(&b);
		status = block_upload(&b);
		if (status == BATTEN_OK)
			status = block_run(&b);
		if (status != BATTEN_OK && *device_session_error(engine->session))
			status = batch_engine_fail(engine, status);
	}
	block_release(&b);
	return status;
}
