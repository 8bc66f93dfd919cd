/* The course of a pass (pass_layout.h) that is not of stretches, the same source for the kernel and the C
 * path. The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_RUN_H
#define BATTEN_SHARED_PASS_RUN_H

#include "shared/pass_fit.h"
#include "shared/pass_program.h"

#define PASS_TERM(n) (SPREAD(p->term_factor[n]) * state[p->term_index[n]])

SHARED_FUNCTION void pass_work_row(const pass_program *p, int row, GLOBAL real *state)
{
	const int end = p->row_first[row + 1];
	int n = p->row_first[row];
	real sum = PASS_TERM(n);
	ROLLED
	for (n++; n < end; n++)
		sum += PASS_TERM(n);
	state[p->row_target[row]] = sum;
}

SHARED_FUNCTION void pass_work_tile(const pass_program *p, int row, GLOBAL real *state)
{
	const int end = p->row_first[row + 1];
	real a = SPREAD(LITERAL(0.0));
	real b = a;
	real c = a;
	real d = a;
	ROLLED
	for (int n = p->row_first[row]; n < end; n += PASS_TILE) {
		const real read = state[p->term_index[n]];
		a = FUSED(SPREAD(p->term_factor[n]), read, a);
		b = FUSED(SPREAD(p->term_factor[n + 1]), read, b);
		c = FUSED(SPREAD(p->term_factor[n + 2]), read, c);
		d = FUSED(SPREAD(p->term_factor[n + 3]), read, d);
	}
	state[p->row_target[row]] = a;
	state[p->row_target[row + 1]] = b;
	state[p->row_target[row + 2]] = c;
	state[p->row_target[row + 3]] = d;
}

SHARED_FUNCTION void pass_work_line(const pass_program *p, int line, GLOBAL real *state,
                                    pass_beside *beside)
{
	const int first = p->line_first[line];
	pass_line l;
	l.beside = beside;
	l.points = p->line_first[line + 1] - first;
	l.order = p->shape[PASS_SHAPE_FIT_ORDER];
	l.vertices = p->shape[PASS_SHAPE_VERTICES];
	l.from = p->point_from + first;
	l.to = p->point_to + first;
	l.along = p->point_along + first;
	l.parameter = state + p->shape[PASS_SHAPE_STATE] +
	              WORK_ITEM * PASS_FIT_ROOM(l.order, l.vertices, p->shape[PASS_SHAPE_FIT_POINTS]);
	l.band = l.parameter + p->shape[PASS_SHAPE_FIT_POINTS];
	l.x = l.band + l.vertices * l.order;
	l.y = l.x + l.vertices;
	pass_fit_line(&l, state);
}

SHARED_FUNCTION void pass_work_operation(const pass_program *p, int number, GLOBAL real *state,
                                         pass_beside *beside)
{
	const int kind = p->operations[number * PASS_OPERATION_SIZE + PASS_KIND];
	const int first = p->operations[number * PASS_OPERATION_SIZE + PASS_FIRST];
	const int end = first + p->operations[number * PASS_OPERATION_SIZE + PASS_COUNT];
	const real zero = SPREAD(LITERAL(0.0));
	if (kind == PASS_ROWS) {
		ROLLED
		for (int row = first + WORK_ITEM; row < end; row += WORK_ITEMS) {
			pass_work_row(p, row, state);
			PASS_BESIDE(beside, PASS_ROW_TIME);
		}
	} else if (kind == PASS_TILES || (WORK_ITEM == 0 && kind == PASS_TILES_IN_ORDER)) {
		const int items = kind == PASS_TILES ? WORK_ITEMS : 1;
		ROLLED
		for (int row = first + (items > 1 ? WORK_ITEM * PASS_TILE : 0); row < end;
		     row += items * PASS_TILE) {
			pass_work_tile(p, row, state);
			PASS_BESIDE(beside, PASS_TILE_TIME);
		}
	} else if (kind == PASS_ADD) {
		ROLLED
		for (int row = first + WORK_ITEM; row < end; row += WORK_ITEMS)
			state[p->row_target[row]] += state[p->term_index[p->row_first[row]]];
	} else if (kind == PASS_FLOOR) {
		ROLLED
		for (int v = first + WORK_ITEM; v < end; v += WORK_ITEMS)
			state[v] = CHOOSE(state[v] < zero, zero, state[v]);
	} else if (kind == PASS_FIT) {
		ROLLED
		for (int line = first + WORK_ITEM; line < end; line += WORK_ITEMS)
			pass_work_line(p, line, state, beside);
	}
}

/* Above 0 where a value of this work-item's share is no length. */
SHARED_FUNCTION real pass_refused(GLOBAL const int *shape, GLOBAL const real *state)
{
	const real largest = SPREAD((scalar)shape[PASS_SHAPE_LARGEST]);
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	real sound = one;
	ROLLED
	for (int v = WORK_ITEM; v < shape[PASS_SHAPE_VALUES]; v += WORK_ITEMS) {
		sound = CHOOSE(state[v] <= largest, sound, zero);
		sound = CHOOSE(state[v] >= -largest, sound, zero);
	}
	return one - sound;
}

/* How long a pass takes, in parts of PASS_BESIDE. */
SHARED_FUNCTION int pass_time(const pass_program *p)
{
	int time = 0;
	ROLLED
	for (int n = 0; n < p->shape[PASS_SHAPE_OPERATIONS]; n++) {
		const int kind = p->operations[n * PASS_OPERATION_SIZE + PASS_KIND];
		const int first = p->operations[n * PASS_OPERATION_SIZE + PASS_FIRST];
		const int count = p->operations[n * PASS_OPERATION_SIZE + PASS_COUNT];
		if (kind == PASS_ROWS)
			time += count * PASS_ROW_TIME;
		else if (kind == PASS_TILES || kind == PASS_TILES_IN_ORDER)
			time += count / PASS_TILE * PASS_TILE_TIME;
		else if (kind == PASS_FIT)
			time += (p->line_first[first + count] - p->line_first[first]) * PASS_POINT_TIME;
	}
	return time * p->shape[PASS_SHAPE_ITERATIONS];
}

SHARED_FUNCTION void pass_run(const pass_program *p, GLOBAL real *state, pass_beside *beside)
{
	const int iterations = p->shape[PASS_SHAPE_ITERATIONS];
	const int operations = p->shape[PASS_SHAPE_OPERATIONS];
	ROLLED
	for (int iteration = 0; iteration < iterations; iteration++) {
		ROLLED
		for (int n = 0; n < operations; n++) {
			pass_work_operation(p, n, state, beside);
			WAIT;
		}
	}
}

#endif
