/* Exploratory moves of a multilevel pattern search (Hooke and Jeeves; thesis 7.2) along every direction.
 * The objective is the includer's. Several searches run side by side, one a lane; in OpenCL the
 * work-items of a group share the directions of a colour.
 *
 * Defined before this is included:
 *   search_state       nodes; y, base, trial: STATE real *; lower, upper: GLOBAL const real *;
 *                      colour_count; wide_colours, those of them, the first, that wait for their turn
 *                      (multilevel.h), and wide_probes, a real, two for each of their directions;
 *                      whatever the objective needs
 *   search_move        step: real; whatever tells one direction from another
 *   void move_begin(const search_state *, int colour, int direction, search_move *)
 *   real move_objective(const search_state *, const search_move *)
 *                      the terms the direction can change, after move->step along it
 *   void move_end(const search_state *, const search_move *)
 *                      y after move->step for good; 0 leaves y as it was
 *   void colour_range(const search_state *, int colour, int *first, int *end)
 *                      directions of a colour, colours in the order they are worked
 *   real whole_objective(const search_state *)
 *                      at trial, the same in every work-item */
#ifndef BATTEN_SHARED_SEARCH_MOVES_H
#define BATTEN_SHARED_SEARCH_MOVES_H

#include "dialect.h"
#include "multilevel.h"
#include "search_progress.h"

/* Exploratory move along one direction: +h, -h and the bottom of the parabola through them; the best
 * is taken where it is a gain. One call of the objective in a loop: PoCL compiles each call anew.
 * Returns the length of the step taken. */
SHARED_FUNCTION real search_explore(const search_state *s, search_move *move, real h, real *extra)
{
	const real zero = SPREAD(LITERAL(0.0));
	real before = zero;
	real plus = zero;
	real change = zero;
	real step = zero;
	move->step = zero;
	ROLLED
	for (int turn = 0; turn < 4; turn++) {
		const real sum = move_objective(s, move);
		const real found = sum - before;
		if (turn == 0) {
			before = sum;
			move->step = h;
		} else if (turn == 1) {
			plus = found;
			change = found;
			step = h;
			move->step = -h;
		} else if (turn == 2) {
			const mask better = found < change;
			change = CHOOSE(better, found, change);
			step = CHOOSE(better, -h, step);
			move->step = parabola_step(h, plus, found);
			const mask tried = move->step != zero;
			*extra += CHOOSE(tried, SPREAD(LITERAL(1.0)), zero);
			if (!ANY(tried))
				break;
		} else {
			const mask better = (move->step != zero) & (found < change);
			change = CHOOSE(better, found, change);
			step = CHOOSE(better, move->step, step);
		}
	}
	const mask gain = change < -(SPREAD(GAIN_FLOOR) * before);
	move->step = CHOOSE(gain, step, zero);
	move_end(s, move);
	return CHOOSE(move->step < zero, -move->step, move->step);
}

/* The directions of some colours. Returns the longest step this work-item took. */
SHARED_FUNCTION real search_sweep(const search_state *s, int first_colour, int end_colour, real h,
                                  real *extra)
{
	real longest = SPREAD(LITERAL(0.0));
	ROLLED
	for (int colour = first_colour; colour < end_colour; colour++) {
		int first = 0;
		int end = 0;
		colour_range(s, colour, &first, &end);
		ROLLED
		for (int d = first + WORK_ITEM; d < end; d += WORK_ITEMS) {
			search_move move;
			move_begin(s, colour, d, &move);
			const real length = search_explore(s, &move, h, extra);
			longest = CHOOSE(length > longest, length, longest);
		}
		WAIT;
	}
	return longest;
}

/* The longest step and the number of probes of all work-items: a maximum and a sum of whole numbers,
 * so their order does not matter. gathered has two values a work-item. */
SHARED_FUNCTION void search_gather(LOCAL real *gathered, real *longest, real *extra)
{
	gathered[WORK_ITEM] = *longest;
	gathered[WORK_ITEMS + WORK_ITEM] = *extra;
	WAIT;
	*extra = SPREAD(LITERAL(0.0));
	ROLLED
	for (int w = 0; w < WORK_ITEMS; w++) {
		*longest = CHOOSE(gathered[w] > *longest, gathered[w], *longest);
		*extra += gathered[WORK_ITEMS + w];
	}
	WAIT;
}

#endif
