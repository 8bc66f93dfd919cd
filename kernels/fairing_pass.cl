/* Passes of forward and inverse fairing (thesis 5.3, 6; 5.2 where lines are too uneven for stretches) over
 * many hulls of one topology.
 *
 * A work-group takes BATTEN_LANES hulls at a time, one a lane of `real`, through all iterations of the
 * pass, and then the next: its room stays in the cache. Its work-items share the rows and lines of an
 * operation. On a CPU: many lanes, one work-item.
 * On a GPU: one lane, many work-items. Every row and line is worked in one fixed order by one
 * work-item, so the shape does not change a bit of the result.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, and NUMBER_DOUBLE of pass_numbers.h. */
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/pass_numbers.h"
#include "shared/turn.h"

/* Lines of the cache that are still to be fetched, some beside every piece of work: fetched at one go they are
 * waited for. */
typedef struct pass_beside {
	global const number *from; /* of the hulls that this group takes next */
	global number *to;         /* where these go */
	size_t at, due, end, step; /* numbers; the step in a part of the time */
} pass_beside;

static inline void fetch(pass_beside *f, size_t time)
{
	enum { LINE = 64 / sizeof(number) };
	f->due += time * f->step;
	ROLLED
	for (; f->at < min(f->due, f->end); f->at += WORK_ITEMS * LINE) {
		FETCH(f->from + f->at);
		FETCH_TO_WRITE(f->to + f->at);
	}
}
#define PASS_BESIDE(beside, time) fetch(beside, time)
#include "shared/pass_run.h"

/* The values of the lanes' hulls, each beside its next: hull l begins at from + l * values. Lanes
 * beyond the last hull work that one again. */
static inline void take(global const number *from, int values, int hulls, global real *state)
{
	const int whole = values - values % BATTEN_LANES;
	ROLLED
	for (int v = WORK_ITEM * BATTEN_LANES; v < whole; v += WORK_ITEMS * BATTEN_LANES) {
		real square[BATTEN_LANES];
		UNROLLED
		for (int l = 0; l < BATTEN_LANES; l++)
			square[l] = LOAD(from + (size_t)(l < hulls ? l : hulls - 1) * (size_t)values + v);
		turn(square);
		UNROLLED
		for (int l = 0; l < BATTEN_LANES; l++)
			state[v + l] = square[l];
	}
	ROLLED
	for (int n = WORK_ITEM; n < (values - whole) * BATTEN_LANES; n += WORK_ITEMS) {
		const int l = n % BATTEN_LANES;
		const int v = whole + n / BATTEN_LANES;
		((global scalar *)(state + v))[l] = (scalar)
			from[(size_t)(l < hulls ? l : hulls - 1) * (size_t)values + v];
	}
}

static inline void give_back(global const real *state, int values, int hulls, global number *to)
{
	const int whole = values - values % BATTEN_LANES;
	ROLLED
	for (int v = WORK_ITEM * BATTEN_LANES; v < whole; v += WORK_ITEMS * BATTEN_LANES) {
		real square[BATTEN_LANES];
		UNROLLED
		for (int l = 0; l < BATTEN_LANES; l++)
			square[l] = state[v + l];
		turn(square);
		UNROLLED
		for (int l = 0; l < BATTEN_LANES; l++)
			if (l < hulls)
				STORE(square[l], to + (size_t)l * (size_t)values + v);
	}
	ROLLED
	for (int n = WORK_ITEM; n < (values - whole) * BATTEN_LANES; n += WORK_ITEMS) {
		const int l = n % BATTEN_LANES;
		const int v = whole + n / BATTEN_LANES;
		if (l < hulls)
			to[(size_t)l * (size_t)values + v] = (number)((global const scalar *)(state + v))[l];
	}
}

/* What is to be fetched while the hulls from `first` on are worked, in that time. */
static inline pass_beside begin_fetch(global const number *from, global number *to, int first,
                                      int hulls, int values, int time)
{
	enum { LINE = 64 / sizeof(number) };
	const size_t next = (size_t)first + get_num_groups(0) * BATTEN_LANES;
	const size_t here = hulls - first < BATTEN_LANES ? hulls - first : BATTEN_LANES;
	const bool whole = next + BATTEN_LANES <= (size_t)hulls;
	const size_t end = here * (size_t)values;
	return (pass_beside){ from + (whole ? next : (size_t)first) * (size_t)values,
		                  to + (size_t)first * (size_t)values,
		                  WORK_ITEM * LINE,
		                  0,
		                  end,
		                  end / (size_t)max(time, 1) * WORK_ITEMS + 1 };
}

/* Tells of hulls that are none: looking at their numbers here costs no journey to memory. */
static inline void refuse(global const int *shape, global const real *state, int hulls,
                          global int *refused)
{
	const real off = pass_refused(shape, state);
	for (int l = 0; l < hulls; l++)
		if (((const scalar *)&off)[l] > LITERAL(0.0))
			refused[l] = 1;
}

/* The program: see pass_run.h. constants: those of the state. from, to [hull][values]; refused [hull].
 * room: state_size reals a group. */
kernel void fairing_pass(int hulls, int state_size, global const int *shape,
                         global const int *operations, global const int *row_first,
                         global const int *row_target, global const int *term_index,
                         global const scalar *term_factor, global const int *line_first,
                         global const int *point_from, global const int *point_to,
                         global const scalar *point_along, global const scalar *constants,
                         global const number *from, global number *to, global int *refused,
                         global real *room)
{
	const int values = shape[PASS_SHAPE_VALUES];
	global real *state = room + get_group_id(0) * (size_t)state_size;
	const pass_program program = { shape,       operations, row_first,  row_target, term_index,
		                           term_factor, line_first, point_from, point_to,   point_along };
	const int time = pass_time(&program);
	ROLLED
	for (int first = (int)get_group_id(0) * BATTEN_LANES; first < hulls;
	     first += (int)get_num_groups(0) * BATTEN_LANES) {
		const int here = hulls - first < BATTEN_LANES ? hulls - first : BATTEN_LANES;
		const size_t begin = (size_t)first * (size_t)values;
		take(from + begin, values, here, state);
		ROLLED
		for (int c = WORK_ITEM; c < shape[PASS_SHAPE_CONSTANTS]; c += WORK_ITEMS)
			state[values + c] = SPREAD(constants[c]);
		WAIT;
		refuse(shape, state, here, refused + first);
		pass_beside beside = begin_fetch(from, to, first, hulls, values, time);
		pass_run(&program, state, &beside);
		give_back(state, values, here, to + begin);
		WAIT;
	}
}
