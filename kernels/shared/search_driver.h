/* The course of a multilevel pattern search (Hooke and Jeeves; thesis 7.2): exploratory moves along
 * every direction, a pattern move, steps that become shorter.
 *
 * Defined before this is included, beside what search_sweep.h asks for:
 *   void search_prepare(const search_state *)
 *                      what pattern moves need before the first
 *   void search_pattern(const search_state *, mask going, int turn, search_progress *)
 *                      the objective at y, in turn 0 no more; then on along the iteration's way, y -
 *                      base, while the objective falls. Lanes that are not `going` keep everything, and
 *                      where none is, nothing is worked */
#ifndef BATTEN_SHARED_SEARCH_DRIVER_H
#define BATTEN_SHARED_SEARCH_DRIVER_H

#include "search_sweep.h"

/* The wide levels of an iteration, for the lanes whose turn it is; p->wide is the objective after them.
 * Returns the longest step this work-item took. */
SHARED_FUNCTION real search_wide_sweep(const search_state *s, int colours, int turn, real h,
                                       real *extra, search_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real due = turn % WIDE_TURNS == 0 ? h : CHOOSE(p->wide_pays > zero, h, zero);
	const int swept = ANY_BESIDE(s, due > zero) ? colours : 0;
	const real longest = search_sweep(s, 0, swept, due, extra);
	const int nodes = swept > 0 ? s->nodes : 0;
	if (ALONE && swept == 0) {
		p->wide = p->objective;
		return longest;
	}
	ROLLED
	for (int n = WORK_ITEM; n < nodes; n += WORK_ITEMS)
		AT(s->trial[n]) = AT(s->y[n]);
	WAIT;
	const real found = whole_objective(s);
	p->wide = swept > 0 ? found : p->objective;
	search_count(p, swept > 0 ? CHOOSE(due > zero, s->wide_probes, zero) : zero);
	return longest;
}

/* One iteration of the lanes that are active. Turn 0 only evaluates the start. */
SHARED_FUNCTION void search_iterate(const search_state *s, int turn, mask active, mask unlimited,
                                    search_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	real longest = zero;
	const real before = p->objective;
	mask going = unlimited;
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		AT(s->base[n]) = AT(s->y[n]);
	WAIT;
	/* Every `if` around a barrier doubles what PoCL compiles: where there are any, turn 0 goes through sweeps
	 * of nothing, and what is not wanted is worked and left. */
	const int colours = turn > 0 ? s->colour_count : 0;
	const int wide_colours = turn > 0 ? s->wide_colours : 0;
	real extra = zero;
	const real h = CHOOSE(active, p->step, zero);
	sweeps_begin(s);
	const real wide = search_wide_sweep(s, wide_colours, turn, h, &extra, p);
	longest = search_sweep(s, wide_colours, colours, h, &extra);
	longest = CHOOSE(wide > longest, wide, longest);
	search_gather(s, &longest, &extra);
	if (turn > 0) {
		search_count(p, extra);
		going = active & (longest > zero);
		p->moves += CHOOSE(going, one, zero);
	}
	search_pattern(s, going, turn, p);
	if (turn == 0)
		return;
	const mask pays = before - p->wide > SPREAD(WIDE_SHARE) * (p->wide - p->objective);
	p->wide_pays = CHOOSE(pays, one, zero);
	p->step = CHOOSE(active, step_after(p->step, longest), p->step);
	p->iterations += CHOOSE(active, one, zero);
}

/* A whole search: y from and back to `values` (s->nodes of real), settings and outcome as in
 * search_layout.h. */
SHARED_FUNCTION void search_run(const search_state *s, int iteration_limit,
                                GLOBAL const stored *settings, GLOBAL stored *values,
                                GLOBAL stored *outcome)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real limit = SPREAD((scalar)iteration_limit);
	const real last_step = AT(settings[SEARCH_SETTING_LAST_STEP]);
	search_progress p = {
		zero, AT(settings[SEARCH_SETTING_FIRST_STEP]), zero, zero, zero, zero, zero, zero
	};
	real start = zero;
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		AT(s->y[n]) = AT(values[n]);
	search_prepare(s);
	WAIT;
	ROLLED
	for (int turn = 0;; turn++) {
		const mask unlimited = p.iterations < limit;
		const mask active = (p.step > last_step) & unlimited;
		if (turn > 0 && !ANY_BESIDE(s, active))
			break;
		search_iterate(s, turn, active, unlimited, &p);
		if (turn == 0)
			start = p.objective;
	}
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		AT(values[n]) = AT(s->y[n]);
	if (WORK_ITEM == 0)
		search_tell(&p, start, outcome);
}

#endif
