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
	LANES_MOST = 16,
	HULLS_MOST = 2 * LANES_MOST + 1
};

/* Both sides of the comparison and what they are given. */
typedef struct test_batch {
	int32_t operations[5 * PASS_OPERATION_SIZE], row_first[ROWS + 1], row_target[ROWS + 1];
	int32_t term_index[TERMS + 1], line_first[LINES + 1];
	int32_t point_from[LINES * POINTS + 1], point_to[LINES * POINTS + 1];
	double term_factor[TERMS], point_along[LINES * POINTS], constants[CONSTANTS];
	double y[HULLS_MOST * VALUES], found[HULLS_MOST * VALUES], known[HULLS_MOST * VALUES];
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

/* Lines like those of a hull, with noise; some numbers below 0 for the floor. No library function
 * takes part, so every machine gets the same numbers. */
static void make_hulls(test_batch *t, size_t count)
{
	uint32_t state = 20011u;
	for (size_t n = 0; n < count * VALUES; n++) {
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
	double worst = 0.0;
	for (size_t n = 0; n < plan->count * VALUES; n++) {
		test->different += memcmp(&t->found[n], &t->known[n], sizeof t->found[n]) != 0;
		const double off = fabs(t->found[n] - t->known[n]);
		if (!(off <= worst))
			worst = off;
	}
	test->compared += plan->count * VALUES;
	batch_engine_compare(test, worst, test->precision == BATTEN_F64 ? 1e-9 : 1e-2,
	                     "a half-breadth");
}

batten_status pass_selftest_run(batch_engine *engine)
{
	test_batch *t = batten_allocate(engine->context, 1, sizeof *t);
	if (!t)
		return BATTEN_MEMORY;
	const pass_program_numbers program = make_program(t);
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
	make_hulls(t, plan.count);
	const batten_status status = run_both(engine, &plan, t);
	if (status == BATTEN_OK)
		compare(&plan, t, &engine->test);
	batten_release(engine->context, t);
	return status;
}
