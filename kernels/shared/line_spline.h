/* B-splines on the open uniform knots of the thesis (3.2): 0 (order times), 1, 2, ..., last (order
 * times), in lanes that may each be in another span. The includer has dialect.h.
 *
 * A span s (a whole number as a real) runs from knot s to s + 1; the functions s .. s + order - 1 are
 * those that differ from 0 there. */
#ifndef BATTEN_SHARED_LINE_SPLINE_H
#define BATTEN_SHARED_LINE_SPLINE_H

#include "shared/pass_layout.h"

#if BATTEN_DOUBLE
#define SPLINE_ROUNDING LITERAL(4e-16)
#else
#define SPLINE_ROUNDING LITERAL(2e-7)
#endif
/* Turns of the search for a parameter: one that only halves its bracket would be done by then. */
#define SPLINE_TURNS 64

/* Knot number j, counted from the one that begins the range. */
SHARED_FUNCTION real spline_knot(real j, real last)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real above = CHOOSE(j < zero, zero, j);
	return CHOOSE(above > last, last, above);
}

/* The order functions of span s at t (Cox and de Boor). */
SHARED_FUNCTION void spline_basis(int order, real last, real s, real t, real *values)
{
	real left[PASS_ORDER_MOST];
	real right[PASS_ORDER_MOST];
	values[0] = SPREAD(LITERAL(1.0));
	ROLLED
	for (int d = 1; d < order; d++) {
		real saved = SPREAD(LITERAL(0.0));
		left[d] = t - spline_knot(s + SPREAD((scalar)(1 - d)), last);
		right[d] = spline_knot(s + SPREAD((scalar)d), last) - t;
		ROLLED
		for (int r = 0; r < d; r++) {
			const real part = values[r] / (right[r + 1] + left[d - r]);
			values[r] = saved + right[r + 1] * part;
			saved = left[d - r] * part;
		}
		values[d] = saved;
	}
}

/* The value at t of the curve whose vertices in span s are window[0..order). */
SHARED_FUNCTION real spline_value(int order, real last, real s, real t, const real *window)
{
	real basis[PASS_ORDER_MOST];
	real sum = SPREAD(LITERAL(0.0));
	spline_basis(order, last, s, t, basis);
	ROLLED
	for (int j = 0; j < order; j++)
		sum += basis[j] * window[j];
	return sum;
}

SHARED_FUNCTION real spline_size(real a)
{
	return CHOOSE(a < SPREAD(LITERAL(0.0)), -a, a);
}

/* The t of span s where the curve of window has the value wanted, which is not below the one at s
 * and not above the one at s + 1: by the chord of the bracket, an end that stays twice counting half
 * (Illinois). A lane that has its t keeps it while others go on. */
SHARED_FUNCTION real spline_parameter(int order, real last, real s, const real *window, real wanted)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real part = SPREAD(LITERAL(0.5));
	const real near = SPREAD(SPLINE_ROUNDING) *
	                  (spline_size(window[0]) + spline_size(window[order - 1]));
	const real step = SPREAD(SPLINE_ROUNDING) * (s + one);
	real low = s;
	real high = s + one;
	real at_low = spline_value(order, last, s, low, window) - wanted;
	real at_high = spline_value(order, last, s, high, window) - wanted;
	real t = CHOOSE(spline_size(at_high) < spline_size(at_low), high, low);
	real stayed = zero; /* -1: low did, 1: high did */
	const real best = CHOOSE(spline_size(at_high) < spline_size(at_low), at_high, at_low);
	real going = CHOOSE(spline_size(best) > near, one, zero);
	ROLLED
	for (int turn = 0; turn < SPLINE_TURNS && ANY(going > zero); turn++) {
		const real middle = part * (low + high);
		const real chord = (low * at_high - high * at_low) / (at_high - at_low);
		/* Also where the chord is none: comparing with what is no number is false. */
		const real inside = CHOOSE(chord > low, CHOOSE(chord < high, chord, middle), middle);
		const real next = CHOOSE(going > zero, inside, t);
		const real at = spline_value(order, last, s, next, window) - wanted;
		const real below = CHOOSE(at < zero, going, zero);
		const real above = going - below;
		const real less_high = CHOOSE(stayed > zero, part * at_high, at_high);
		const real less_low = CHOOSE(stayed < zero, part * at_low, at_low);
		t = next;
		low = CHOOSE(below > zero, next, low);
		at_low = CHOOSE(below > zero, at, CHOOSE(above > zero, less_low, at_low));
		high = CHOOSE(above > zero, next, high);
		at_high = CHOOSE(above > zero, at, CHOOSE(below > zero, less_high, at_high));
		stayed = CHOOSE(below > zero, one, CHOOSE(above > zero, -one, stayed));
		going = CHOOSE(spline_size(at) > near, CHOOSE(high - low > step, going, zero), zero);
	}
	return t;
}

#endif
