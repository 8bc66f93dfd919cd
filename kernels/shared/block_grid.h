/* What the course of the block search asks of an offset grid: probes and tables of all its lines, the bottom of
 * their parabolas, rounds over them, its objective. */
#ifndef BATTEN_SHARED_BLOCK_GRID_H
#define BATTEN_SHARED_BLOCK_GRID_H

#include "block_rounds.h"

/* Probes and tables of all lines, WORK_ITEMS at a time: a line is gathered when those beside it are
 * probed, and factored when BLOCK_TOGETHER of a work-item's lines are gathered, or the last one is. part:
 * of the slopes along the first derivatives. Returns the objective. */
SHARED_FUNCTION real block_explore(const block_state *s, real far, real part, int turn,
                                   block_stay stay)
{
	const int at_once = WORK_ITEMS;
	int gathered = 0, line = 0;
	ROLLED
	for (int first = 0; first <= s->lines; first += at_once) {
		ROLLED
		for (line = first + WORK_ITEM; line < first + at_once && line < s->lines;
		     line += WORK_ITEMS)
			AT(s->sums[(BLOCK_SUM_COUNT - 1) * s->lines + line]) = block_probe_line(s, line, far,
			                                                                        part);
		WAIT;
		ROLLED
		for (line = first - 1 + WORK_ITEM; line < first + at_once - 1; line += WORK_ITEMS) {
			if (line < 0 || line >= s->lines)
				continue;
			block_gather_line(s, line, turn, stay);
			if (s->rounds > 0)
				block_begin_rounds(s, line, stay);
			gathered++;
			if (gathered == BLOCK_TOGETHER || line + WORK_ITEMS >= s->lines) {
				block_factor_lines(s, line - (gathered - 1) * WORK_ITEMS, WORK_ITEMS, gathered);
				gathered = 0;
			}
		}
		WAIT;
	}
	if (s->hats > 0)
		block_explore_hats(s, stay);
	return block_total(s, BLOCK_SUM_COUNT - 1);
}

SHARED_FUNCTION void block_solve(const block_state *s, int turn, const real *alpha)
{
	if (s->hats > 0) {
		ROLLED
		for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
			block_lessen_line(s, line, turn, alpha);
		block_choose_hats(s, block_array(s, BLOCK_STATE_WAY));
	}
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_solve_line(s, line, turn, alpha);
}

/* Every offset goes by itself, and of a search there is nothing to know beforehand. */
SHARED_FUNCTION void block_follow(const block_state *s)
{
	(void)s;
}

SHARED_FUNCTION void block_arrive(const block_state *s, int begun, mask fresh, real fair,
                                  real close)
{
	(void)s;
	(void)begun;
	(void)fresh;
	(void)fair;
	(void)close;
}

SHARED_FUNCTION real block_trial_objective(const block_state *s)
{
	const STATE stored *trial = block_array(s, BLOCK_STATE_TRIAL);
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		AT(s->sums[2 * s->lines + line]) = block_line_objective(s, trial, line);
	WAIT;
	return block_total(s, 2);
}

#endif
