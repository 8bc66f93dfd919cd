/* The rules of the multilevel pattern search (Hooke and Jeeves; thesis 7.2) that the C path and the
 * kernel share: directions, steps, acceptance.
 *
 * A direction is a hat over index space: 1 at its centre, falling linearly to 0 at `width` nodes from
 * it. Width 1 is a single offset. Centres of one level lie `width` apart, so that directions whose
 * centre numbers agree modulo 3 both ways share no term of the objective and neither reads what the
 * other writes: nine colours, each of which may be worked through in any order or at once. */
#ifndef BATTEN_SHARED_MULTILEVEL_H
#define BATTEN_SHARED_MULTILEVEL_H

#include "dialect.h"
#include "search_layout.h"

#define PATTERN_LIMIT 7 /* longest pattern move: 2^6 times the last exploratory move */

/* Once one direction's hats are as wide as the table lets them, levels go on along the other alone. They
 * rarely gain, and the kinks they leave the finer levels have to smooth again; on long tables nearly all
 * that is left may be theirs. So they are worked every WIDE_TURNS iterations, and again in the next one
 * where they gained at least WIDE_SHARE of what the rest of the iteration did. */
#define WIDE_TURNS 4
#define WIDE_SHARE LITERAL(0.25)

/* How many levels, the last ones, those are. */
SHARED_FUNCTION int search_wide_levels(GLOBAL const int *levels, int level_count)
{
	int count = 0;
	for (int l = 1; l < level_count; l++) {
		GLOBAL const int *level = levels + l * SEARCH_LEVEL_SIZE;
		GLOBAL const int *finer = level - SEARCH_LEVEL_SIZE;
		const int x = level[SEARCH_LEVEL_WIDTH_X];
		const int z = level[SEARCH_LEVEL_WIDTH_Z];
		count += (x > 1 && x == finer[SEARCH_LEVEL_WIDTH_X]) ||
		         (z > 1 && z == finer[SEARCH_LEVEL_WIDTH_Z]);
	}
	return count;
}

/* A gain below this part of the sum it was found in is rounding, not a gain. */
#if BATTEN_DOUBLE
#define GAIN_FLOOR LITERAL(1e-14)
#else
#define GAIN_FLOOR LITERAL(3e-7)
#endif

/* The hat's height `offset` nodes from its centre; inverse_width = 1 / width. */
SHARED_FUNCTION scalar hat_height(int offset, scalar inverse_width)
{
	const scalar height = LITERAL(1.0) - (scalar)(offset < 0 ? -offset : offset) * inverse_width;
	return height > LITERAL(0.0) ? height : LITERAL(0.0);
}

/* A value moved by step and kept in its box. A fixed node has lower == upper. */
SHARED_FUNCTION real move_clamped(real y, real step, real lower, real upper)
{
	const real moved = y + step;
	const real raised = CHOOSE(moved < lower, lower, moved);
	return CHOOSE(raised > upper, upper, raised);
}

/* Interior penalty: the part of the way to a bound that a move goes at most. The next r is a hundredth of
 * the last, and that brings the minimum a tenth as near to a bound that holds it. */
#define INSIDE_PART LITERAL(0.9)

/* A value moved by step, but not to a bound, where an interior penalty is infinite: at most INSIDE_PART of
 * the way there, and nowhere where rounding would land on it. */
SHARED_FUNCTION real move_inside(real y, real step, real lower, real upper)
{
	const real down = SPREAD(INSIDE_PART) * (lower - y);
	const real up = SPREAD(INSIDE_PART) * (upper - y);
	const real moved = y + CHOOSE(step < down, down, CHOOSE(step > up, up, step));
	return CHOOSE((moved > lower) & (moved < upper), moved, y);
}

/* The step to the bottom of the parabola through the changes at +h, 0 and -h, at most 4 h long: a
 * longer one may leap into a spurious minimum, because a cliff in a graph surface costs almost
 * nothing. 0 where the parabola has no bottom. */
SHARED_FUNCTION real parabola_step(real h, real plus, real minus)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real bend = plus + minus;
	const real limit = SPREAD(LITERAL(4.0)) * h;
	const real safe = CHOOSE(bend > zero, bend, SPREAD(LITERAL(1.0)));
	const real bottom = (h * (minus - plus)) / (SPREAD(LITERAL(2.0)) * safe);
	const real cut = CHOOSE(bottom > limit, limit, CHOOSE(bottom < -limit, -limit, bottom));
	return CHOOSE(bend > zero, cut, zero);
}

/* The step after an iteration whose longest was so long: the same where it was as long as that, else half of
 * it, or a quarter or an eighth where those were long enough. */
SHARED_FUNCTION real step_after(real step, real longest)
{
	const real part = SPREAD(LITERAL(0.5));
	const real halved = part * step;
	const real quarter = part * halved;
	const real eighth = part * quarter;
	const real least = CHOOSE(longest < eighth, eighth, CHOOSE(longest < quarter, quarter, halved));
	return CHOOSE(longest < step, least, step);
}

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

#endif
