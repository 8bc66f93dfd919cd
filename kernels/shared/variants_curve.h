/* Splines through points of a line that differ from lane to lane: of the slots of a line those from
 * first to last (numbers of slots, as reals) are points, the others are passed over (Letcher 3.5). */
#ifndef BATTEN_SHARED_VARIANTS_CURVE_H
#define BATTEN_SHARED_VARIANTS_CURVE_H

#include "dialect.h"
#include "variants_layout.h"

#define ZERO SPREAD(LITERAL(0.0))
#define ONE SPREAD(LITERAL(1.0))
#define NUMBER(i) SPREAD((scalar)(i))
#define NONE SPREAD(LITERAL(VARIANTS_NONE))
#define LEAST_OF(a, b) CHOOSE((a) < (b), a, b)
#define MOST_OF(a, b) CHOOSE((a) > (b), a, b)

/* Room for one line (VARIANTS_LINE_...). */
typedef struct variants_line {
	STATE real *at, *step, *pivot, *factor, *value, *bend, *below, *scale;
} variants_line;

SHARED_FUNCTION variants_line variants_line_in(STATE real *room, int slots)
{
	const variants_line line = {
		room + VARIANTS_LINE_AT * slots,    room + VARIANTS_LINE_STEP * slots,
		room + VARIANTS_LINE_PIVOT * slots, room + VARIANTS_LINE_FACTOR * slots,
		room + VARIANTS_LINE_VALUE * slots, room + VARIANTS_LINE_BEND * slots,
		room + VARIANTS_LINE_BELOW * slots, room + VARIANTS_LINE_SCALE * slots
	};
	return line;
}

/* Eliminates the rows of a natural spline. False in lanes whose points do not ascend. */
SHARED_FUNCTION mask variants_natural(variants_line line, int slots, real first, real last)
{
	real before = ZERO, inverse = ZERO, worst = ONE;
	ROLLED
	for (int i = 0; i < slots; i++) {
		const mask runs = (NUMBER(i) >= first) & (NUMBER(i) < last);
		const mask inner = runs & (NUMBER(i) > first);
		const real here = line.at[i];
		const real next = line.at[i + 1 < slots ? i + 1 : i];
		const real width = CHOOSE(runs, next - here, ZERO);
		const real factor = before * inverse;
		worst = CHOOSE(runs, LEAST_OF(width, worst), worst);
		line.step[i] = CHOOSE(runs, ONE / width, ZERO);
		inverse = CHOOSE(inner, ONE / FUSED(-factor, before, NUMBER(2) * (before + width)), ZERO);
		line.factor[i] = factor;
		line.pivot[i] = inverse;
		before = width;
	}
	return worst > ZERO;
}

/* Second derivatives of values, with rows that stand eliminated. */
SHARED_FUNCTION void variants_natural_bend(variants_line line, int slots, STATE const real *value,
                                           STATE real *bend)
{
	real chord = ZERO, right = ZERO;
	ROLLED
	for (int i = 0; i + 1 < slots; i++) {
		const real next = (value[i + 1] - value[i]) * line.step[i];
		right = FUSED(-line.factor[i], right, NUMBER(6) * (next - chord));
		bend[i] = right;
		chord = next;
	}
	real after = ZERO;
	bend[slots - 1] = ZERO;
	ROLLED
	for (int i = slots - 2; i >= 0; i--) {
		/* each waits for the one before: as little as can be between them; a pivot of 0 gives 0 */
		const real width = line.at[i + 1] - line.at[i], pivot = line.pivot[i];
		after = FUSED(-(width * pivot), after, bend[i] * pivot);
		bend[i] = after;
	}
}

/* Weights of a natural or any cubic piece at part u of its width: value = (1 - u) y0 + u y1 -
 * width^2 (a m0 + b m1). */
SHARED_FUNCTION real variants_cubic(real u, real width, real y0, real y1, real m0, real m1)
{
	const real v = ONE - u;
	const real sixth = SPREAD(LITERAL(0.16666666666666666));
	const real bends = u * v * sixth * FUSED(ONE + v, m0, (ONE + u) * m1);
	return FUSED(v, y0, FUSED(u, y1, -(width * width) * bends));
}

/* Eliminates the rows of a spline that is not-a-knot at both ends (a straight line through two points, a
 * parabola through three). */
SHARED_FUNCTION void variants_not_a_knot(variants_line line, int slots, real first, real last)
{
	real before = ZERO, inverse = ZERO, above = ZERO;
	ROLLED
	for (int i = 0; i < slots; i++) {
		const mask runs = (NUMBER(i) >= first) & (NUMBER(i) < last);
		const mask inner = runs & (NUMBER(i) > first);
		const mask begins = NUMBER(i) == first + ONE, ends = NUMBER(i) == last - ONE;
		const int j = i + 1 < slots ? i + 1 : i;
		const real width = CHOOSE(runs, line.at[j] - line.at[i], ZERO);
		const real both = before + width;
		/* of the second point, of the last but one, of the only one between */
		const real inside = CHOOSE(begins, width, before);
		const mask one_end = (begins | ends) & !(begins & ends);
		const real diagonal = CHOOSE(begins & ends, NUMBER(3) * both,
		                             CHOOSE(one_end, both + inside, NUMBER(2) * both));
		const real below = CHOOSE(begins, ZERO, CHOOSE(ends, before - width, before));
		const real factor = below * inverse;
		inverse = CHOOSE(inner, ONE / FUSED(-factor, above, diagonal), ZERO);
		above = CHOOSE(ends, ZERO, CHOOSE(begins, width - before, width));
		line.step[i] = width;
		line.pivot[i] = inverse;
		line.factor[i] = above;
		line.below[i] = factor;
		line.scale[i] = CHOOSE(one_end, inside / both, ONE);
		before = width;
	}
}

/* Second derivatives of that spline through line.value, with rows that stand eliminated; one point has none.
 * Chords take the place of the values. */
SHARED_FUNCTION void variants_not_a_knot_bend(variants_line line, int slots, real first, real last)
{
	real right = ZERO, chord = ZERO, after = ZERO;
	ROLLED
	for (int i = 0; i < slots; i++) {
		const mask runs = (NUMBER(i) >= first) & (NUMBER(i) < last);
		const int j = i + 1 < slots ? i + 1 : i;
		const real next = CHOOSE(runs, (line.value[j] - line.value[i]) / line.step[i], ZERO);
		right = FUSED(-line.below[i], right, NUMBER(6) * (next - chord) * line.scale[i]);
		line.bend[i] = right;
		line.value[i] = next;
		chord = next;
	}
	ROLLED
	for (int i = slots - 1; i >= 0; i--) {
		const mask inner = (NUMBER(i) > first) & (NUMBER(i) < last);
		after = CHOOSE(inner, FUSED(-line.factor[i], after, line.bend[i]) * line.pivot[i], ZERO);
		line.bend[i] = after;
	}
	/* the ends go on as the cubics next to them */
	const mask two = last - first > ONE, three = last - first > NUMBER(2);
	ROLLED
	for (int i = 0; i + 2 < slots; i++) {
		const mask here = (NUMBER(i) == first) & two;
		if (!ANY(here))
			continue;
		const real turn = CHOOSE(
			three, (line.bend[i + 2] - line.bend[i + 1]) * line.step[i] / line.step[i + 1], ZERO);
		line.bend[i] = CHOOSE(here, line.bend[i + 1] - turn, line.bend[i]);
	}
	ROLLED
	for (int i = slots - 1; i >= 2; i--) {
		const mask here = (NUMBER(i) == last) & two;
		if (!ANY(here))
			continue;
		const real turn = CHOOSE(
			three, (line.bend[i - 1] - line.bend[i - 2]) * line.step[i - 1] / line.step[i - 2],
			ZERO);
		line.bend[i] = CHOOSE(here, line.bend[i - 1] + turn, line.bend[i]);
	}
}

/* Slope of that spline at a point of it; 0 where there is but one. */
SHARED_FUNCTION real variants_slope_at(variants_line line, int i, real first, real last)
{
	const real sixth = SPREAD(LITERAL(0.16666666666666666));
	const int j = i > 0 ? i - 1 : 0;
	/* the last point belongs to the interval before it */
	const mask at_end = NUMBER(i) == last;
	const real width = CHOOSE(at_end, line.step[j], line.step[i]);
	const real chord = CHOOSE(at_end, line.value[j], line.value[i]);
	const real bends = CHOOSE(at_end, FUSED(NUMBER(2), line.bend[i], line.bend[j]),
	                          -FUSED(NUMBER(2), line.bend[i], line.bend[i + 1]));
	return CHOOSE(last > first, FUSED(width * sixth, bends, chord), ZERO);
}

#endif
