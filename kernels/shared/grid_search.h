/* The multilevel pattern search over an offset grid: its directions, worked one by one. Defined before this is
 * included: what grid_state.h asks for. */
#ifndef BATTEN_SHARED_GRID_SEARCH_H
#define BATTEN_SHARED_GRID_SEARCH_H

#define GRID_FUSED 1
#include "grid_moves.h"

/* Takes the levels, SEARCH_LEVEL_SIZE numbers each, and the station and waterline of each direction. */
SHARED_FUNCTION void search_levels(search_state *s, int level_count, GLOBAL const int *levels,
                                   GLOBAL const int *centres)
{
	s->level_count = level_count;
	s->colour_count = level_count * GRID_COLOURS(GRID_FAIRNESS);
	s->wide_colours = search_wide_levels(levels, level_count) * GRID_COLOURS(GRID_FAIRNESS);
	s->hat_colours = 0;
	for (int l = 0; l < level_count; l++)
		if (GRID_FAIRNESS != GRID_VARIATION &&
		    levels[l * SEARCH_LEVEL_SIZE + SEARCH_LEVEL_WIDTH_X] > 1)
			s->hat_colours += GRID_COLOURS(GRID_FAIRNESS);
	s->levels = levels;
	s->centres = centres;
}

/* Derivatives of ring nodes are read beside the grid's edge, though none has a term. */
SHARED_FUNCTION void search_slopes_clear(const search_state *s)
{
	const real zero = SPREAD(LITERAL(0.0));
	const node_slopes none = { zero, zero, zero, zero, zero };
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		slopes_put(s->slopes + n, none);
}

/* The level of a colour: all colours of the coarsest level first. */
SHARED_FUNCTION GLOBAL const int *level_of(const search_state *s, int colour)
{
	return s->levels +
	       (s->level_count - 1 - colour / GRID_COLOURS(GRID_FAIRNESS)) * SEARCH_LEVEL_SIZE;
}

SHARED_FUNCTION void colour_range(const search_state *s, int colour, int *first, int *end)
{
	GLOBAL const int *at = level_of(s, colour) + SEARCH_LEVEL_FIRST +
	                       colour % GRID_COLOURS(GRID_FAIRNESS);
	*first = at[0];
	*end = at[1];
}

SHARED_FUNCTION void move_begin(const search_state *s, int colour, int direction, search_move *move)
{
	GLOBAL const int *level = level_of(s, colour);
	move->station = s->centres[2 * direction];
	move->waterline = s->centres[2 * direction + 1];
	move->width_x = level[SEARCH_LEVEL_WIDTH_X];
	move->width_z = level[SEARCH_LEVEL_WIDTH_Z];
	move->inverse_x = LITERAL(1.0) / (scalar)level[SEARCH_LEVEL_WIDTH_X];
	move->inverse_z = LITERAL(1.0) / (scalar)level[SEARCH_LEVEL_WIDTH_Z];
}

/* An exploratory move along a thin hat. Returns the step taken. */
SHARED_FUNCTION real thin_explore(const search_state *s, search_move *move, real h, real *extra)
{
	const real zero = SPREAD(LITERAL(0.0));
	const hat_window window = hat_window_of(s, move);
	const single_stencil x = single_stencil_of(s->along_x, move->station, s->stations);
	search_trial trial = search_trial_begin();
	const real before = hat_objective_before(s, &window, move->station, move->station);
	(void)search_trial_next(&trial, 0, h, before, extra);
	move->step = trial.next;
	ROLLED
	for (int turn = 1;; turn++) {
		const real sum = thin_objective(s, move, &window, &x);
		if (turn > 3)
			break; /* the step taken, worked again */
		if (search_trial_next(&trial, turn, h, sum, extra)) {
			move->step = trial.next;
			continue;
		}
		const real probed = move->step;
		move->step = search_trial_end(&trial);
		if (!ANY((move->step != zero) & (move->step != probed)))
			break; /* the terms of the last probe are those of the step taken */
		turn = 3;
	}
	if (ANY(move->step != zero))
		thin_end(s, move, &window, &x);
	return move->step;
}

/* An exploratory move along a wider hat. Returns the step taken. */
SHARED_FUNCTION real hat_explore(const search_state *s, search_move *move, real h, real *extra)
{
	const real zero = SPREAD(LITERAL(0.0));
	const hat_window window = hat_window_of(s, move);
	search_trial trial = search_trial_begin();
	const real before = hat_objective_before(s, &window, window.first_i, window.last_i);
	(void)search_trial_next(&trial, 0, h, before, extra);
	move->step = trial.next;
	int again = 1;
	ROLLED
	for (int turn = 1;; turn++) {
		hat_place(s, move, turn > 1);
		if (!again)
			break; /* the terms of the last probe are those of the step taken */
		const real sum = hat_objective(s, &window);
		if (turn > 3)
			break; /* the step taken, worked again */
		if (search_trial_next(&trial, turn, h, sum, extra)) {
			move->step = trial.next;
			continue;
		}
		const real probed = move->step;
		move->step = search_trial_end(&trial);
		again = ANY((move->step != zero) & (move->step != probed));
		turn = 3;
	}
	if (ANY(move->step != zero))
		hat_terms_take(s, &window, move->step != zero);
	return move->step;
}

/* An exploratory move of a single offset. Returns the step taken. */
SHARED_FUNCTION real single_explore(const search_state *s, int station, int waterline, real h,
                                    real *extra)
{
	single_offset offset;
	search_trial trial = search_trial_begin();
	single_begin(s, station, waterline, &offset);
	ROLLED
	for (int turn = 0; turn < 4; turn++)
		if (!search_trial_next(&trial, turn, h, single_objective(s, &offset, trial.next), extra))
			break;
	const real step = search_trial_end(&trial);
	single_end(s, &offset, step);
	return step;
}

/* An exploratory move along one direction. Returns the length of the step taken. */
SHARED_FUNCTION real direction_explore(const search_state *s, int colour, int direction, real h,
                                       real *extra)
{
	GLOBAL const int *level = level_of(s, colour);
	search_move move;
	real step;
	move_begin(s, colour, direction, &move);
	if (GRID_FAIRNESS == GRID_VARIATION || level[SEARCH_LEVEL_WIDTH_X] > 1)
		step = hat_explore(s, &move, h, extra);
	else if (level[SEARCH_LEVEL_WIDTH_Z] > 1)
		step = thin_explore(s, &move, h, extra);
	else
		step = single_explore(s, move.station, move.waterline, h, extra);
	return CHOOSE(step < SPREAD(LITERAL(0.0)), -step, step);
}

SHARED_FUNCTION void sweeps_begin(const search_state *s)
{
	grid_terms_begin(s, s->stations);
}

/* Wider hats, the first in an iteration, read no derivatives and leave them as they were: those at y are made
 * where thin ones begin. */
SHARED_FUNCTION void colour_end(const search_state *s, int colour)
{
	grid_terms_begin(s, colour + 1 == s->hat_colours ? s->stations : 0);
}

#define SEARCH_WAYS GRID_WAYS
#include "search_ways.h"
/* The course last: it calls the pattern move. */
#include "search_driver.h"

#endif
