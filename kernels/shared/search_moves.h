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
