/* Passes of forward fairing (thesis 5.2) over many hulls of one topology, as stretches (pass_layout.h).
 *
 * A work-group takes its share of the hulls, one after the other, with lanes of `real` along the values of
 * the hull: numbers come, are worked and go as they lie, and the state of one hull and the factors that all
 * share stay in the cache beside the processor. Its work-items share the stretches of an operation. On a CPU:
 * many lanes, one work-item. On a GPU: one lane, many work-items. Every number is summed in one fixed order
 * by one work-item, so the shape does not change a bit of the result.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, and NUMBER_DOUBLE of pass_numbers.h. */
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/pass_numbers.h"
#include "shared/pass_stretch.h"

/* The hulls that a group works side by side; those beyond the last are that one again. */
typedef struct hulls_at_work {
	global const number *from; /* of the first of them */
	global number *to;
	global int *refused;
	int values, count; /* count: all that are left of the group's share */
} hulls_at_work;

enum { FETCH_NUMBERS = 64 / sizeof(number) }; /* of a line of the cache */

/* Where hull h begins. */
static inline size_t begin_of(const hulls_at_work *w, int h)
{
	return (size_t)min(h, w->count - 1) * (size_t)w->values;
}

/* Their values into the states, in vectors of which the last may begin where the one before has not ended. */
static inline void take(const hulls_at_work *w, real largest, int state_size, global scalar *state)
{
	ROLLED
	for (int h = 0; h < STRETCH_HULLS; h++) {
		global const number *from = w->from + begin_of(w, h);
		ROLLED
		for (int v = WORK_ITEM * BATTEN_LANES; v < w->values; v += WORK_ITEMS * BATTEN_LANES) {
			const int at = min(v, w->values - BATTEN_LANES);
			const real y = LOAD(from + at);
			if (ANY(!((y <= largest) & (y >= -largest))))
				w->refused[min(h, w->count - 1)] = 1;
			WRITE(y, state + h * state_size + at);
		}
	}
}

/* Part `part` of `parts` of the hulls that are next on their way into the cache, and of where they go. */
static inline void fetch(const hulls_at_work *w, int part, int parts)
{
	const size_t numbers = STRETCH_HULLS * (size_t)w->values;
	const size_t lines = numbers / FETCH_NUMBERS + 1;
	const size_t end = lines * (part + 1) / parts;
	ROLLED
	for (size_t n = lines * part / parts; n < end; n++) {
		const size_t place = numbers + n * FETCH_NUMBERS;
		if (place < (size_t)w->count * w->values) {
			FETCH(w->from + place);
			FETCH_TO_WRITE(w->to + place);
		}
	}
}

/* Operation `turn` of all iterations'. The sums of the last one leave at once. In the last iteration the
 * next hulls are fetched, a few lines of the cache with every part: memory is neither waited for nor idle. */
static inline void work(const pass_program *p, int turn, const hulls_at_work *w, int state_size,
                        global scalar *state)
{
	const int operations = p->shape[PASS_SHAPE_OPERATIONS];
	const int begun = turn - operations * (p->shape[PASS_SHAPE_ITERATIONS] - 1);
	global const int *operation = p->operations + turn % operations * PASS_OPERATION_SIZE;
	const int first = operation[PASS_FIRST] * STRETCH_PARTS;
	const int parts = operation[PASS_COUNT] * STRETCH_PARTS;
	ROLLED
	for (int part = WORK_ITEM; part < parts; part += WORK_ITEMS) {
		real sum[STRETCH_HULLS][STRETCH_SUMS];
		const int target = stretch_target(p, first + part);
		stretch_sum(p, first + part, state, state_size, sum);
		UNROLLED
		for (int h = 0; h < STRETCH_HULLS; h++) {
			UNROLLED
			for (int s = 0; s < STRETCH_SUMS; s++) {
				const int at = target + s * BATTEN_LANES;
				if (begun + 1 == operations)
					STORE(sum[h][s], w->to + begin_of(w, h) + at);
				else
					WRITE(sum[h][s], state + h * state_size + at);
			}
		}
		if (begun >= 0)
			fetch(w, begun * parts + part, operations * parts);
	}
}

/* Zeros, and constants behind the values. */
static inline void prepare(global const int *shape, global const scalar *constants, int state_size,
                           size_t states, global scalar *room)
{
	ROLLED
	for (size_t n = WORK_ITEM; n < states * state_size; n += WORK_ITEMS)
		room[n] = LITERAL(0.0);
	WAIT;
	ROLLED
	for (size_t s = 0; s < states; s++) {
		ROLLED
		for (int c = WORK_ITEM; c < shape[PASS_SHAPE_CONSTANTS]; c += WORK_ITEMS)
			room[s * state_size + PASS_STRETCH + shape[PASS_SHAPE_VALUES] + c] = constants[c];
	}
}

/* The program: see pass_program.h. constants: those of the state. from, to [hull][values]; refused [hull].
 * room: STRETCH_HULLS states a group, state_size numbers each, those beside them included. */
kernel void fairing_stretches(int hulls, int state_size, global const int *shape,
                              global const int *operations, global const int *row_first,
                              global const int *row_target, global const int *term_index,
                              global const scalar *term_factor, global const scalar *constants,
                              global const number *from, global number *to, global int *refused,
                              global scalar *room)
{
	const int values = shape[PASS_SHAPE_VALUES];
	const int turns = shape[PASS_SHAPE_OPERATIONS] * shape[PASS_SHAPE_ITERATIONS];
	const size_t share = ((size_t)hulls + get_num_groups(0) - 1) / get_num_groups(0);
	const size_t begin = get_group_id(0) * share;
	const size_t end = min(begin + share, (size_t)hulls);
	const pass_program program = { shape,       operations, row_first, row_target, term_index,
		                           term_factor, 0,          0,         0,          0 };
	if (begin >= end)
		return;
	room += get_group_id(0) * STRETCH_HULLS * (size_t)state_size;
	prepare(shape, constants, state_size, STRETCH_HULLS, room);
	ROLLED
	for (size_t hull = begin; hull < end; hull += STRETCH_HULLS) {
		const hulls_at_work w = { from + hull * values, to + hull * values, refused + hull, values,
			                      (int)(end - hull) };
		take(&w, SPREAD((scalar)shape[PASS_SHAPE_LARGEST]), state_size, room + PASS_STRETCH);
		WAIT;
		ROLLED
		for (int turn = 0; turn < turns; turn++) {
			work(&program, turn, &w, state_size, room + PASS_STRETCH);
			WAIT;
		}
	}
}
