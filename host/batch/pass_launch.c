#include "batch/pass_launch.h"

/* Groups a compute unit gets: more than one hide what is uneven, few keep their room in the cache. */
enum { GROUPS_OF_UNIT_CPU = 4, GROUPS_OF_UNIT = 32 };

bool pass_launch_in_doubles(const batten_device *device, batten_precision precision)
{
	return precision == BATTEN_F64 || (device->is_cpu && device->has_f64);
}

enum {
	SHAPE,
	OPERATIONS,
	ROW_FIRST,
	ROW_TARGET,
	TERM_INDEX,
	TERM_FACTOR,
	LINE_FIRST,
	POINT_FROM,
	POINT_TO,
	POINT_ALONG,
	CONSTANTS,
	FROM,
	TO,
	REFUSED,
	ROOM,
	BUFFER_COUNT
};

/* Host memory and device buffers of one run. */
typedef struct block {
	const batch_engine *engine;
	const pass_plan *plan;
	size_t first, count; /* hulls */
	size_t groups;       /* of work-items, each taking lanes' hulls again and again */
	size_t state_size, bytes;
	size_t side_by_side; /* states of hulls that a work-group has */
	bool stretches;
	bool doubles;
	bool direct; /* the device works in the caller's memory */
	float *short_numbers;
	pass_tables tables;
	device_buffer *buffers[BUFFER_COUNT];
} block;

static void block_release(block *b)
{
	for (size_t i = 0; i < BUFFER_COUNT; i++)
		device_buffer_destroy(b->buffers[i]);
	batten_release(b->engine->context, b->short_numbers);
	pass_tables_release(b->plan, &b->tables);
}

static batten_status block_create(block *b)
{
	const batch_engine_recipe *recipe = &b->engine->recipe;
	const batten_device *device = batch_engine_device(b->engine);
	const size_t rounds = device->is_cpu ? GROUPS_OF_UNIT_CPU : GROUPS_OF_UNIT;
	b->state_size = pass_plan_state(b->plan, recipe->work_group);
	b->stretches = b->plan->program->shape[PASS_SHAPE_STRETCHES];
	b->side_by_side = b->stretches ? PASS_STRETCH_HULLS : recipe->lanes;
	const size_t room = b->state_size * b->side_by_side *
	                    batch_engine_number_size(recipe->precision);
	const size_t wanted = (b->count + b->side_by_side - 1) / b->side_by_side;
	const size_t most[] = { device->compute_units * rounds,
		                    batch_engine_launch_bytes(b->engine, SIZE_MAX) / room };
	b->groups = wanted;
	for (size_t i = 0; i < 2; i++)
		if (b->groups > most[i])
			b->groups = most[i] > 0 ? most[i] : 1;
	b->doubles = pass_launch_in_doubles(device, recipe->precision);
	b->direct = device->is_cpu && b->doubles;
	const size_t numbers = b->count * pass_plan_values(b->plan);
	b->bytes = numbers * (b->doubles ? sizeof(double) : sizeof(float));
	const batten_status status = pass_tables_create(b->plan, &b->tables);
	if (status != BATTEN_OK || b->doubles)
		return status;
	b->short_numbers = batten_allocate(b->engine->context, numbers, sizeof *b->short_numbers);
	if (!b->short_numbers)
		return BATTEN_MEMORY;
	for (size_t n = 0; n < numbers; n++)
		b->short_numbers[n] = (float)b->plan->y_m[b->first * pass_plan_values(b->plan) + n];
	return BATTEN_OK;
}

/* Lines are fitted; stretches have none. */
static bool is_of_lines(const block *b, int which)
{
	return b->stretches && which >= LINE_FIRST && which <= POINT_ALONG;
}

/* An OpenCL buffer cannot be empty: lists that may be have room for one more. */
static batten_status block_upload(block *b)
{
	const pass_program_numbers *program = b->plan->program;
	const size_t number = batch_engine_number_size(b->engine->recipe.precision);
	const size_t operations = (size_t)program->shape[PASS_SHAPE_OPERATIONS];
	const size_t begin = b->first * pass_plan_values(b->plan);
	const void *from = b->doubles ? (const void *)(b->plan->y_m + begin) : b->short_numbers;
	const size_t lines = b->stretches ? 0 : 1; /* stretches have none that are fitted */
	const batch_engine_upload uploads[] = {
		{ &b->buffers[SHAPE], sizeof b->tables.shape, b->tables.shape },
		{ &b->buffers[OPERATIONS], (operations + 1) * PASS_OPERATION_SIZE * sizeof(int32_t),
		  program->operations },
		{ &b->buffers[ROW_FIRST], (program->row_count + 1) * sizeof(int32_t), program->row_first },
		{ &b->buffers[ROW_TARGET], (program->row_count + 1) * sizeof(int32_t),
		  program->row_target },
		{ &b->buffers[TERM_INDEX], (program->term_count + 1) * sizeof(int32_t),
		  program->term_index },
		{ &b->buffers[TERM_FACTOR], (program->term_count + 1) * number, b->tables.term_factor },
		{ &b->buffers[LINE_FIRST], lines * (program->line_count + 1) * sizeof(int32_t),
		  program->line_first },
		{ &b->buffers[POINT_FROM], lines * (program->point_count + 1) * sizeof(int32_t),
		  program->point_from },
		{ &b->buffers[POINT_TO], lines * (program->point_count + 1) * sizeof(int32_t),
		  program->point_to },
		{ &b->buffers[POINT_ALONG], lines * (program->point_count + 1) * number,
		  b->tables.point_along },
		{ &b->buffers[CONSTANTS], ((size_t)program->shape[PASS_SHAPE_CONSTANTS] + 1) * number,
		  b->tables.constants },
		{ &b->buffers[ROOM], b->groups * b->state_size * b->side_by_side * number, NULL },
		{ &b->buffers[FROM], b->direct ? 0 : b->bytes, from },
		{ &b->buffers[TO], b->direct ? 0 : b->bytes, NULL },
		{ &b->buffers[REFUSED], b->count * sizeof *b->plan->refused, b->plan->refused + b->first },
	};
	device_session *session = b->engine->session;
	batten_status status = batch_engine_upload_all(b->engine, uploads,
	                                               sizeof uploads / sizeof uploads[0]);
	/* Wrapped memory is read only, whatever its type says. */
	if (status == BATTEN_OK && b->direct)
		status = device_buffer_wrap(session, b->bytes, (void *)from, &b->buffers[FROM]);
	if (status == BATTEN_OK && b->direct)
		status = device_buffer_wrap(session, b->bytes, b->plan->out_m + begin, &b->buffers[TO]);
	return status;
}

static batten_status block_launch(const block *b)
{
	enum { PLAIN = 2 };
	const int32_t plain[PLAIN] = { (int32_t)b->count, (int32_t)b->state_size };
	device_argument arguments[PLAIN + BUFFER_COUNT] = { { 0 } };
	for (size_t i = 0; i < PLAIN; i++)
		arguments[i] = (device_argument){ .size = sizeof plain[i], .value = &plain[i] };
	size_t count = PLAIN;
	for (int i = 0; i < BUFFER_COUNT; i++)
		if (!is_of_lines(b, i))
			arguments[count++] = (device_argument){ .buffer = b->buffers[i] };
	return device_launch(b->engine->session, b->engine->kernel, arguments, count, b->groups,
	                     b->engine->recipe.work_group);
}

static batten_status block_read(const block *b)
{
	const batten_status told = device_buffer_read(
		b->buffers[REFUSED], b->count * sizeof *b->plan->refused, b->plan->refused + b->first);
	if (told != BATTEN_OK)
		return told;
	const size_t begin = b->first * pass_plan_values(b->plan);
	if (b->direct)
		return device_buffers_settle(&b->buffers[TO], 1);
	if (b->doubles)
		return device_buffer_read(b->buffers[TO], b->bytes, b->plan->out_m + begin);
	const batten_status status = device_buffer_read(b->buffers[TO], b->bytes, b->short_numbers);
	for (size_t n = 0; n < b->count * pass_plan_values(b->plan) && status == BATTEN_OK; n++)
		b->plan->out_m[begin + n] = (double)b->short_numbers[n];
	return status;
}

batten_status pass_launch_run(const batch_engine *engine, const pass_plan *plan, size_t first,
                              size_t count)
{
	block b = { .engine = engine, .plan = plan, .first = first, .count = count };
	batten_status status = block_create(&b);
	if (status == BATTEN_OK) {
		status = block_upload(&b);
		if (status == BATTEN_OK)
			status = block_launch(&b);
		if (status == BATTEN_OK)
			status = block_read(&b);
		/* Nothing may write to the caller's memory any more. */
		if (status != BATTEN_OK)
			(void)device_finish(engine->session);
		if (status != BATTEN_OK && *device_session_error(engine->session))
			status = batch_engine_fail(engine, status);
	}
	block_release(&b);
	return status;
}
