/* An exploratory move of a multilevel pattern search (Hooke and Jeeves; thesis 7.2) along one direction. The
 * objective is the includer's.
 *
 * Defined before this is included:
 *   search_state       whatever the objective needs
 *   search_move        step: real; whatever tells one direction from another
 *   real move_objective(const search_state *, const search_move *)
 *                      the terms the direction can change, after move->step along it
 *   void move_end(const search_state *, const search_move *)
 *                      y after move->step for good; 0 leaves y as it was before the first probe */
#ifndef BATTEN_SHARED_SEARCH_MOVES_H
#define BATTEN_SHARED_SEARCH_MOVES_H

#include "dialect.h"
#include "multilevel.h"
#include "search_progress.h"

/* What the probes of one direction have come to. */
typedef struct search_trial {
	real before, plus, change, step;
	real next; /* the step to probe */
} search_trial;

SHARED_FUNCTION search_trial search_trial_begin(void)
{
	const real zero = SPREAD(LITERAL(0.0));
	const search_trial trial = { zero, zero, zero, zero, zero };
	return trial;
}

/* Takes the objective at trial->next: 0 in turn 0, then +h, -h and the bottom of the parabola through them.
 * Returns whether there is another turn. One call of the objective in a loop: PoCL compiles each call anew. */
SHARED_FUNCTION int search_trial_next(search_trial *t, int turn, real h, real sum, real *extra)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real found = sum - t->before;
	if (turn == 0) {
		t->before = sum;
		t->next = h;
	} else if (turn == 1) {
		t->plus = found;
		t->change = found;
		t->step = h;
		t->next = -h;
	} else {
		const mask better = (t->next != zero) & (found < t->change);
		t->change = CHOOSE(better, found, t->change);
		t->step = CHOOSE(better, t->next, t->step);
	}
	if (turn != 2)
		return turn < 3;
	t->next = parabola_step(h, t->plus, found);
	const mask tried = t->next != zero;
	*extra += CHOOSE(tried, SPREAD(LITERAL(1.0)), zero);
	return ANY(tried);
}

/* The step to take: the best probed where it is a gain, else 0. */
SHARED_FUNCTION real search_trial_end(const search_trial *t)
{
	const mask gain = t->change < -(SPREAD(GAIN_FLOOR) * t->before);
	return CHOOSE(gain, t->step, SPREAD(LITERAL(0.0)));
}

/* Exploratory move along one direction. Returns the length of the step taken. */
SHARED_FUNCTION real search_explore(const search_state *s, search_move *move, real h, real *extra)
{
	search_trial trial = search_trial_begin();
	ROLLED
	for (int turn = 0; turn < 4; turn++) {
		move->step = trial.next;
		if (!search_trial_next(&trial, turn, h, move_objective(s, move), extra))
			break;
	}
	move->step = search_trial_end(&trial);
	move_end(s, move);
	return CHOOSE(move->step < SPREAD(LITERAL(0.0)), -move->step, move->step);
}

#endif
