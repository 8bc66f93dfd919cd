/* The largest value of a function of one parameter, in each lane its own: parabolas through the three best
 * places, kept within bounds that close in by the golden section where a parabola is no help (Brent 1973,
 * chapter 5). */
#ifndef BATTEN_SHARED_AFLOAT_SEARCH_H
#define BATTEN_SHARED_AFLOAT_SEARCH_H

#include "afloat_line.h"

/* Most trials. */
#define AFLOAT_TRIALS 60

/* Bounds; the three best places and what was found there, the best first; the last two steps. */
typedef struct afloat_search {
	real a, b, place[3], value[3], step, step_before, near;
	mask active;
	int begun;
} afloat_search;

/* Between a and b, in the lanes of where, to a place known within near; from a place between that has been
 * tried. */
SHARED_FUNCTION void afloat_search_go_on(afloat_search *g, real a, real b, real near, mask where,
                                         real place, real value)
{
	g->a = a;
	g->b = b;
	g->near = near;
	g->step = g->step_before = SPREAD(0);
	g->active = where;
	g->begun = 1;
	ROLLED for (int n = 0; n < 3; n++)
	{
		g->place[n] = place;
		g->value[n] = value;
	}
}

/* The same from nothing. */
SHARED_FUNCTION void afloat_search_begin(afloat_search *g, real a, real b, real near, mask where)
{
	afloat_search_go_on(g, a, b, near, where, a + SPREAD(LITERAL(0.38196601125010515)) * (b - a),
	                    SPREAD(-AFLOAT_FAR));
	g->begun = 0;
}

/* Where to try next. */
SHARED_FUNCTION real afloat_search_next(afloat_search *g)
{
	const real bound = SPREAD(LITERAL(0.5)), nought = SPREAD(0), near = g->near, x = g->place[0];
	const real middle = bound * (g->a + g->b);
	if (!g->begun)
		return x;
	/* x + p / q is the top of the parabola */
	const real r = (x - g->place[1]) * (g->value[2] - g->value[0]);
	const real t = (x - g->place[2]) * (g->value[1] - g->value[0]);
	const real over = (x - g->place[2]) * t - (x - g->place[1]) * r;
	const real under = SPREAD(2) * (t - r);
	const real p = CHOOSE(under > nought, -over, over), q = afloat_size(under);
	const real size_before = afloat_size(g->step_before), size = afloat_size(p);
	const real half_before = afloat_size(bound * q * g->step_before);
	const mask helps = (size_before > near) & (size < half_before) & (p > q * (g->a - x)) &
	                   (p < q * (g->b - x));
	const real wide = CHOOSE(x < middle, g->b - x, g->a - x);
	const real inward = CHOOSE(middle > x, near, -near);
	real step = p / CHOOSE(helps, q, SPREAD(1));
	const mask at_bound = (x + step - g->a < near + near) | (g->b - x - step < near + near);
	step = CHOOSE(at_bound, inward, step);
	step = CHOOSE(helps, step, SPREAD(LITERAL(0.38196601125010515)) * wide);
	g->step_before = CHOOSE(helps, g->step, wide);
	g->step = step;
	const real least = CHOOSE(step > nought, near, -near);
	return x + CHOOSE(afloat_size(step) >= near, step, least);
}

/* Takes what was found there. */
SHARED_FUNCTION void afloat_search_take(afloat_search *g, real at, real value)
{
	const real x = g->place[0], bound = SPREAD(LITERAL(0.5));
	const mask on = g->active;
	if (!g->begun) {
		afloat_search_go_on(g, g->a, g->b, g->near, on, x, value);
		return;
	}
	const mask best = on & (value >= g->value[0]), worse = on & (value < g->value[0]);
	const mask second = worse & ((value >= g->value[1]) | (g->place[1] == x));
	const mask third = worse &
	                   ((value >= g->value[2]) | (g->place[2] == x) | (g->place[2] == g->place[1]));
	g->a = CHOOSE((best & (at > x)) | (worse & (at < x)), CHOOSE(best, x, at), g->a);
	g->b = CHOOSE((best & (at < x)) | (worse & (at > x)), CHOOSE(best, x, at), g->b);
	const mask shifts = best | second;
	g->place[2] = CHOOSE(shifts, g->place[1], CHOOSE(third, at, g->place[2]));
	g->value[2] = CHOOSE(shifts, g->value[1], CHOOSE(third, value, g->value[2]));
	g->place[1] = CHOOSE(best, g->place[0], CHOOSE(second, at, g->place[1]));
	g->value[1] = CHOOSE(best, g->value[0], CHOOSE(second, value, g->value[1]));
	g->place[0] = CHOOSE(best, at, g->place[0]);
	g->value[0] = CHOOSE(best, value, g->value[0]);
	const mask apart = afloat_size(g->place[0] - bound * (g->a + g->b)) >
	                   g->near + g->near - bound * (g->b - g->a);
	g->active = on & apart;
}

#endif
