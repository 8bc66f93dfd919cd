/* Hooke and Jeeves' pattern search as published (thesis 7.2, figure 7.2): the baseline. The exploratory
 * move tries every offset in turn by +h, then -h; after one that gained, the pattern move goes as far
 * again, to 2 y - base, and explores about that point, offset by offset against the point's own value;
 * after one that did not gain h is halved. Every probe is the whole objective anew.
 *
 * y is the best point, trial the one a sweep explores about. */
#ifndef BATTEN_SHARED_TEXTBOOK_H
#define BATTEN_SHARED_TEXTBOOK_H

#include "grid_state.h"
#include "multilevel.h"
#include "search_progress.h"

/* +h, then -h for the lanes that +h gained nothing. Returns the objective at trial. */
SHARED_FUNCTION real textbook_explore(const search_state *s, int node, real h, mask active,
                                      real before, real *probes)
{
	const real lower = AT(s->lower[node]);
	const real upper = AT(s->upper[node]);
	const real old = AT(s->trial[node]);
	const real enough = before - SPREAD(GAIN_FLOOR) * before;
	real here = old;
	real best = before;
	real step = h;
	mask open = active & (lower < upper);
	WAIT;
	ROLLED
	for (int turn = 0; turn < 2 && ANY_BESIDE(s, open); turn++) {
		const real moved = CHOOSE(open, move_clamped(old, step, lower, upper), here);
		if (WORK_ITEM == 0)
			AT(s->trial[node]) = moved;
		WAIT;
		const real found = whole_objective(s);
		const mask gain = open & (found < enough);
		*probes += CHOOSE(open, SPREAD(LITERAL(1.0)), SPREAD(LITERAL(0.0)));
		here = CHOOSE(gain, moved, here);
		best = CHOOSE(gain, found, best);
		open = open & (best >= before);
		step = -h;
	}
	if (WORK_ITEM == 0)
		AT(s->trial[node]) = here;
	WAIT;
	return best;
}

/* Every offset in turn, about trial, where the objective is given. Returns what it is in the end. */
SHARED_FUNCTION real textbook_sweep(const search_state *s, real h, mask active, real objective,
                                    real *probes)
{
	ROLLED
	for (int k = 0; k < s->waterlines; k++) {
		ROLLED
		for (int i = 0; i < s->stations; i++) {
			const int node = node_of(s, i, k);
			if (ANY_BESIDE(s, AT(s->lower[node]) < AT(s->upper[node])))
				objective = textbook_explore(s, node, h, active, objective, probes);
		}
	}
	return objective;
}

/* Lanes whose sweep gained take its point and go on from a pattern point, the others from y. */
SHARED_FUNCTION void textbook_take(const search_state *s, mask gained)
{
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		const real y = AT(s->y[n]);
		const real found = AT(s->trial[n]);
		const real pattern = move_clamped(found, found - y, AT(s->lower[n]), AT(s->upper[n]));
		AT(s->y[n]) = CHOOSE(gained, found, y);
		AT(s->trial[n]) = CHOOSE(gained, pattern, y);
	}
	WAIT;
}

/* A whole search: y from and back to `values` (s->nodes of real), settings and outcome as in
 * search_layout.h. */
SHARED_FUNCTION void textbook_run(const search_state *s, int iteration_limit,
                                  GLOBAL const stored *settings, GLOBAL stored *values,
                                  GLOBAL stored *outcome)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real limit = SPREAD((scalar)iteration_limit);
	const real last_step = AT(settings[SEARCH_SETTING_LAST_STEP]);
	search_progress p = {
		zero, AT(settings[SEARCH_SETTING_FIRST_STEP]), zero, zero, zero, zero, zero, zero
	};
	real pattern = zero; /* 1 where trial is a pattern point */
	real start = zero;
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		AT(s->y[n]) = AT(values[n]);
		AT(s->trial[n]) = AT(values[n]);
	}
	WAIT;
	ROLLED
	for (int turn = 0;; turn++) {
		const mask active = (p.step > last_step) & (p.iterations < limit);
		if (turn > 0 && !ANY_BESIDE(s, active))
			break;
		const real about = whole_objective(s);
		if (turn == 0)
			start = p.objective = about;
		real probes = pattern;
		const real found = textbook_sweep(s, p.step, active, about, &probes);
		const mask gained = active & (found < p.objective - SPREAD(GAIN_FLOOR) * p.objective);
		const real halved = CHOOSE(active & (pattern == zero), p.step * SPREAD(LITERAL(0.5)),
		                           p.step);
		search_count(&p, CHOOSE(active, probes, zero));
		textbook_take(s, gained);
		pattern = CHOOSE(gained, one, zero);
		p.objective = CHOOSE(gained, found, p.objective);
		p.moves += pattern;
		p.step = CHOOSE(gained, p.step, halved);
		p.iterations += CHOOSE(active, one, zero);
	}
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		AT(values[n]) = AT(s->y[n]);
	if (WORK_ITEM == 0)
		search_tell(&p, start, outcome);
}

#endif
