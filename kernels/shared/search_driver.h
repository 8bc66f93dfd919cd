/* The course of a multilevel pattern search (Hooke and Jeeves; thesis 7.2): exploratory moves along
 * every direction, pattern moves, steps that halve. The objective is the includer's. Several searches
 * run side by side, one a lane; in OpenCL the work-items of a group share the directions of a colour.
 *
 * Defined before this is included:
 *   search_state       nodes; y, base, trial: STATE real *; lower, upper: GLOBAL const real *;
 *                      colour_count; whatever the objective needs
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
#ifndef BATTEN_SHARED_SEARCH_DRIVER_H
#define BATTEN_SHARED_SEARCH_DRIVER_H

#include "dialect.h"
#include "multilevel.h"
#include "search_layout.h"

/* What a lane has come to; the same in every work-item. */
typedef struct search_progress {
	real objective, step, iterations, moves, extra_high, extra_low;
} search_progress;

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

/* All directions, coarse to fine. Returns the longest step this work-item took. */
SHARED_FUNCTION real search_sweep(const search_state *s, real h, real *extra)
{
	real longest = SPREAD(LITERAL(0.0));
	ROLLED
	for (int colour = 0; colour < s->colour_count; colour++) {
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

/* y + factor (y - base), kept in the box, into trial. */
SHARED_FUNCTION void search_extrapolate(const search_state *s, real factor)
{
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		s->trial[n] = move_clamped(s->y[n], factor * (s->y[n] - s->base[n]), s->lower[n],
		                           s->upper[n]);
	WAIT;
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

SHARED_FUNCTION void search_count(search_progress *p, real probes)
{
	const real block = SPREAD(LITERAL(1048576.0));
	p->extra_low += probes;
	/* f32 counts whole numbers up to 2^24, which one iteration's probes on the largest grid allowed
	 * stay below: sixteen turns clear them. */
	ROLLED
	for (int turn = 0; turn < 16; turn++) {
		const mask full = p->extra_low >= block;
		p->extra_high += CHOOSE(full, SPREAD(LITERAL(1.0)), SPREAD(LITERAL(0.0)));
		p->extra_low = CHOOSE(full, p->extra_low - block, p->extra_low);
	}
}

/* The objective at y (factor 0), then the pattern move: on along the iteration's way, doubling while
 * it falls. Lanes that are not `going` keep everything. */
SHARED_FUNCTION void search_pattern(const search_state *s, mask going, int pattern_limit,
                                    search_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	real factor = zero;
	real best = zero;
	real probes = zero;
	ROLLED
	for (int turn = 0; turn <= pattern_limit; turn++) {
		search_extrapolate(s, factor);
		const real found = whole_objective(s);
		if (turn == 0) {
			p->objective = CHOOSE(going, found, p->objective);
			factor = SPREAD(LITERAL(1.0));
			continue;
		}
		probes += CHOOSE(going, SPREAD(LITERAL(1.0)), zero);
		going = going & (found < p->objective - SPREAD(GAIN_FLOOR) * p->objective);
		p->objective = CHOOSE(going, found, p->objective);
		best = CHOOSE(going, factor, best);
		factor *= SPREAD(LITERAL(2.0));
		if (!ANY(going))
			break;
	}
	search_count(p, probes);
	if (ANY(best > zero)) {
		search_extrapolate(s, best);
		ROLLED
		for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
			s->y[n] = CHOOSE(best > zero, s->trial[n], s->y[n]);
		WAIT;
	}
}

/* One iteration of the lanes that are active. Turn 0 only evaluates the start. */
SHARED_FUNCTION void search_iterate(const search_state *s, int turn, mask active, mask unlimited,
                                    LOCAL real *gathered, search_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	real longest = zero;
	mask going = unlimited;
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		s->base[n] = s->y[n];
	WAIT;
	if (turn > 0) {
		real extra = zero;
		longest = search_sweep(s, CHOOSE(active, p->step, zero), &extra);
		search_gather(gathered, &longest, &extra);
		search_count(p, extra);
		going = active & (longest > zero);
		p->moves += CHOOSE(going, one, zero);
	}
	if (ANY(going))
		search_pattern(s, going, turn > 0 ? PATTERN_LIMIT : 0, p);
	if (turn == 0)
		return;
	p->step = CHOOSE(active & (longest < p->step), p->step * SPREAD(LITERAL(0.5)), p->step);
	p->iterations += CHOOSE(active, one, zero);
}

/* A whole search: y from and back to `values` (s->nodes of real), settings and outcome as in
 * search_layout.h. */
SHARED_FUNCTION void search_run(const search_state *s, int iteration_limit,
                                GLOBAL const real *settings, GLOBAL real *values,
                                GLOBAL real *outcome, LOCAL real *gathered)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real limit = SPREAD((scalar)iteration_limit);
	const real last_step = settings[SEARCH_SETTING_LAST_STEP];
	search_progress p = { zero, settings[SEARCH_SETTING_FIRST_STEP], zero, zero, zero, zero };
	real start = zero;
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		s->y[n] = values[n];
	WAIT;
	ROLLED
	for (int turn = 0;; turn++) {
		const mask unlimited = p.iterations < limit;
		const mask active = (p.step > last_step) & unlimited;
		if (turn > 0 && !ANY(active))
			break;
		search_iterate(s, turn, active, unlimited, gathered, &p);
		if (turn == 0)
			start = p.objective;
	}
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		values[n] = s->y[n];
	if (WORK_ITEM != 0)
		return;
	outcome[SEARCH_OUTCOME_START] = start;
	outcome[SEARCH_OUTCOME_END] = p.objective;
	outcome[SEARCH_OUTCOME_STEP] = p.step;
	outcome[SEARCH_OUTCOME_ITERATIONS] = p.iterations;
	outcome[SEARCH_OUTCOME_MOVES] = p.moves;
	outcome[SEARCH_OUTCOME_EXTRA_HIGH] = p.extra_high;
	outcome[SEARCH_OUTCOME_EXTRA_LOW] = p.extra_low;
}

#endif
