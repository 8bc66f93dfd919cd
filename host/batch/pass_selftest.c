#include "batch/pass_selftest.h"

#include "batch/pass_reference.h"

#include <math.h>
#include <string.h>

enum {
	POINTS = 11,   /* of a line */
	LINES = 2,     /* fitted ones */
	VALUES = 22,   /* not a multiple of the lanes */
	CONSTANTS = 1, /* the end of the second line */
	STATE = VALUES + CONSTANTS + VALUES + 1,
	SPARE = STATE - 1,
	ORDER = 3,
	VERTICES = 5,
	TILES = (VALUES + PASS_TILE - 1) / PASS_TILE,
	TILE_READS = PASS_TILE + 1,
	ADDITIONS = VALUES + TILES * PASS_TILE, /* the row that is added */
	ROWS = ADDITIONS + 1,
	TERMS = 3 * VALUES + TILES * TILE_READS * PASS_TILE + 1,
	/* The pass of stretches, of another length: the last stretch begins before the one before ends. */
	STRETCH_VALUES = 45,
	STRETCH_ROOM = STRETCH_VALUES + CONSTANTS + PASS_STRETCH,
	STRETCH_ROWS = 4, /* two an operation */
	STRETCH_READS = 3,
	STRETCH_TERMS = STRETCH_ROWS * STRETCH_READS * PASS_STRETCH,
	ROWS_MOST = ROWS > STRETCH_ROWS ? ROWS : STRETCH_ROWS,
	TERMS_MOST = TERMS > STRETCH_TERMS ? TERMS : STRETCH_TERMS,
	VALUES_MOST = STRETCH_VALUES > VALUES ? STRETCH_VALUES : VALUES,
	LANES_MOST = 16,
	HULLS_MOST = 2 * LANES_MOST + 1
};

/* Both sides of the comparison and what they are given. */
typedef struct test_batch {
	int32_t operations[5 * PASS_OPERATION_SIZE], row_first[ROWS_MOST + 1],
		row_target[ROWS_MOST + 1];
	int32_t term_index[TERMS_MOST + 1], line_first[LINES + 1];
	int32_t point_from[LINES * POINTS + 1], point_to[LINES * POINTS + 1];
	double term_factor[TERMS_MOST], point_along[LINES * POINTS], constants[CONSTANTS];
	double y[HULLS_MOST * VALUES_MOST], found[HULLS_MOST * VALUES_MOST];
	double known[HULLS_MOST * VALUES_MOST];
	int32_t refused[HULLS_MOST];
} test_batch;

/* Rows of smoothing into the room. */
static void make_rows(test_batch *t)
{
	const double factors[] = { 0.3, 0.6, 0.1 };
	for (int32_t v = 0; v < VALUES; v++) {
		const int32_t reads[] = { v > 0 ? v - 1 : v, v, v + 1 < VALUES ? v + 1 : v };
		t->row_first[v] = 3 * v;
		t->row_target[v] = VALUES + CONSTANTS + v;
		memcpy(t->term_index + 3 * v, reads, sizeof reads);
		memcpy(t->term_factor + 3 * v, factors, sizeof factors);
	}
}

/* Tiles back into the values, each with what the one before left; the last has rows to spare. */
static void make_tiles(test_batch *t)
{
	int32_t n = 3 * VALUES;
	for (int32_t tile = 0; tile < TILES; tile++) {
		const int32_t begin = tile * PASS_TILE;
		for (int32_t i = 0; i < PASS_TILE; i++) {
			t->row_first[VALUES + begin + i] = i == 0 ? n : n + TILE_READS * PASS_TILE;
			t->row_target[VALUES + begin + i] = begin + i < VALUES ? begin + i : SPARE;
		}
		for (int32_t r = 0; r < TILE_READS; r++) {
			const int32_t v = begin + r < VALUES ? begin + r : VALUES - 1;
			const bool before = r == PASS_TILE && tile > 0;
			for (int32_t i = 0; i < PASS_TILE; i++, n++) {
				t->term_index[n] = before ? begin - 1 : VALUES + CONSTANTS + v;
				t->term_factor[n] = r == i ? 0.6 : r == PASS_TILE ? 0.25 - 0.05 * i : 0.05;
			}
		}
	}
	t->row_first[ADDITIONS] = n;
	t->row_target[ADDITIONS] = 2;
	t->term_index[n] = VALUES;
	t->row_first[ROWS] = TERMS;
}

static void make_lines(test_batch *t)
{
	for (int32_t l = 0; l < LINES; l++) {
		t->line_first[l] = l * POINTS;
		for (int32_t i = 0; i < POINTS; i++) {
			const bool end = l == 1 && i == POINTS - 1;
			t->point_from[l * POINTS + i] = end ? VALUES : l * POINTS + i;
			t->point_to[l * POINTS + i] = t->point_from[l * POINTS + i];
			t->point_along[l * POINTS + i] = 0.5 * i + 0.01 * i * i;
		}
	}
	t->line_first[LINES] = LINES * POINTS;
	t->constants[0] = 0.25;
}

static pass_program_numbers make_program(test_batch *t)
{
	const int32_t operations[] = { PASS_ROWS,  0,
		                           VALUES,     PASS_TILES_IN_ORDER,
		                           VALUES,     TILES * PASS_TILE,
		                           PASS_ADD,   ADDITIONS,
		                           1,          PASS_FIT,
		                           0,          LINES,
		                           PASS_FLOOR, 0,
		                           VALUES };
	memcpy(t->operations, operations, sizeof operations);
	make_rows(t);
	make_tiles(t);
	make_lines(t);
	pass_program_numbers program = { .row_count = ROWS,
		                             .term_count = TERMS,
		                             .line_count = LINES,
		                             .point_count = LINES * POINTS,
		                             .operations = t->operations,
		                             .row_first = t->row_first,
		                             .row_target = t->row_target,
		                             .term_index = t->term_index,
		                             .line_first = t->line_first,
		                             .point_from = t->point_from,
		                             .point_to = t->point_to,
		                             .term_factor = t->term_factor,
		                             .point_along = t->point_along,
		                             .constants = t->constants };
	program.shape[PASS_SHAPE_OPERATIONS] = 5;
	program.shape[PASS_SHAPE_VALUES] = VALUES;
	program.shape[PASS_SHAPE_LARGEST] = 1000;
	program.shape[PASS_SHAPE_CONSTANTS] = CONSTANTS;
	program.shape[PASS_SHAPE_STATE] = STATE;
	program.shape[PASS_SHAPE_FIT_ORDER] = ORDER;
	program.shape[PASS_SHAPE_VERTICES] = VERTICES;
	program.shape[PASS_SHAPE_FIT_POINTS] = POINTS;
	return program;
}

/* The row of a stretch that begins at a value: numbers that lie `apart` are taken together, of those
 * there are. */
static void make_stretch(test_batch *t, int32_t row, int32_t first, int32_t from, int32_t to,
                         int32_t apart)
{
	const double factors[STRETCH_READS] = { 0.3, 0.6, 0.1 };
	t->row_target[row] = to + first;
	t->row_first[row + 1] = (row + 1) * STRETCH_READS;
	for (int32_t r = 0; r < STRETCH_READS; r++) {
		const int32_t n = row * STRETCH_READS + r;
		const int32_t place = first + (r - 1) * apart; /* of the first that is read */
		t->term_index[n] = PASS_STRETCH + from + place;
		for (int32_t i = 0; i < PASS_STRETCH; i++) {
			const bool there = place + i >= 0 && place + i < STRETCH_VALUES + (from == 0);
			t->term_factor[n * PASS_STRETCH + i] = there ? factors[r] : 0.0;
		}
	}
}

/* The first operation reads the constant too. */
static pass_program_numbers make_stretches(test_batch *t)
{
	const int32_t last = STRETCH_VALUES - PASS_STRETCH;
	const int32_t operations[] = { PASS_STRETCHES, 0, 2, PASS_STRETCHES, 2, 2 };
	memcpy(t->operations, operations, sizeof operations);
	make_stretch(t, 0, 0, 0, STRETCH_ROOM, 1);
	make_stretch(t, 1, last, 0, STRETCH_ROOM, 1);
	make_stretch(t, 2, 0, STRETCH_ROOM, 0, POINTS);
	make_stretch(t, 3, last, STRETCH_ROOM, 0, POINTS);
	t->constants[0] = 0.25;
	pass_program_numbers program = { .row_count = STRETCH_ROWS,
		                             .term_count = STRETCH_TERMS,
		                             .operations = t->operations,
		                             .row_first = t->row_first,
		                             .row_target = t->row_target,
		                             .term_index = t->term_index,
		                             .term_factor = t->term_factor,
		                             .point_along = t->point_along,
		                             .constants = t->constants };
	program.shape[PASS_SHAPE_OPERATIONS] = 2;
	program.shape[PASS_SHAPE_VALUES] = STRETCH_VALUES;
	program.shape[PASS_SHAPE_LARGEST] = 1000;
	program.shape[PASS_SHAPE_CONSTANTS] = CONSTANTS;
	program.shape[PASS_SHAPE_STATE] = STRETCH_ROOM + STRETCH_VALUES;
	program.shape[PASS_SHAPE_STRETCHES] = 1;
	return program;
}

/* Lines like those of a hull, with noise; some numbers below 0 for the floor. No library function
 * takes part, so every machine gets the same numbers. */
static void make_hulls(test_batch *t, size_t numbers)
{
	uint32_t state = 20011u;
	for (size_t n = 0; n < numbers; n++) {
		const double a = (double)(n % POINTS) / (POINTS - 1);
		state = state * 1664525u + 1013904223u;
		t->y[n] = 4.0 * a * (1.0 - a) + 0.2 * ((double)(state >> 8) / (double)(1u << 24) - 0.5);
	}
}

static batten_status run_both(batch_engine *engine, pass_plan *plan, test_batch *t)
{
	size_t which[HULLS_MOST];
	for (size_t h = 0; h < plan->count; h++)
		which[h] = h;
	plan->out_m = t->found;
	const double begun = batten_wall_seconds();
	batten_status status = pass_engine_run(engine, plan, which, plan->count);
	engine->test.run_s = batten_wall_seconds() - begun;
	plan->out_m = t->known;
	pass_reference reference = { 0 };
	if (status == BATTEN_OK)
		status = pass_reference_create(plan, &reference);
	for (size_t h = 0; h < plan->count && status == BATTEN_OK; h++)
		pass_reference_run(&reference, h);
	pass_reference_release(&reference);
	return status;
}

static void compare(const pass_plan *plan, const test_batch *t, batten_selftest *test)
{
	const size_t numbers = plan->count * pass_plan_values(plan);
	double worst = 0.0;
	for (size_t n = 0; n < numbers; n++) {
		test->different += memcmp(&t->found[n], &t->known[n], sizeof t->found[n]) != 0;
		const double off = fabs(t->found[n] - t->known[n]);
		if (!(off <= worst))
			worst = off;
	}
	test->compared += numbers;
	batch_engine_compare(test, worst, test->precision == BATTEN_F64 ? 1e-9 : 1e-2,
	                     "a half-breadth");
}

batten_status pass_selftest_run(batch_engine *engine, bool stretches)
{
	test_batch *t = batten_allocate(engine->context, 1, sizeof *t);
	if (!t)
		return BATTEN_MEMORY;
	const pass_program_numbers program = stretches ? make_stretches(t) : make_program(t);
	/* Two full groups of lanes and one more, so that lanes left over are met too. */
	pass_plan plan = { .context = engine->context,
		               .program = &program,
		               .iterations = 3,
		               .precision = engine->recipe.precision,
		               .lanes = engine->recipe.lanes,
		               .work_group = engine->recipe.work_group,
		               .count = 2 * (size_t)engine->recipe.lanes + 1,
		               .y_m = t->y,
		               .refused = t->refused };
	make_hulls(t, plan.count * pass_plan_values(&plan));
	const batten_status status = run_both(engine, &plan, t);
	if (status == BATTEN_OK)
		compare(&plan, t, &engine->test);
	batten_release(engine->context, t);
	return status;
}
