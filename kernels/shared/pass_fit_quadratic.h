/* What the fit of a line (pass_fit.h) takes longest over, in closed form for order 3, the thesis's own.
 * The quadratic of a span has its middle vertex as Bezier point; its joints lie halfway between
 * vertices, those at the ends on them. The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_FIT_QUADRATIC_H
#define BATTEN_SHARED_PASS_FIT_QUADRATIC_H

#include "shared/pass_line.h"

/* Point i's part in the normal equations, to whichever span each lane has it in. */
SHARED_FUNCTION void quadratic_add_point(const pass_line *l, int i, real y)
{
	const int spans = l->vertices - 2;
	const real zero = SPREAD(LITERAL(0.0));
	const real part = SPREAD(LITERAL(0.5));
	const real one = SPREAD(LITERAL(1.0));
	const real along = SPREAD(l->along[i]);
	const real t = l->parameter[i];
	real span = zero;
	ROLLED
	for (int s = 1; s < spans; s++)
		span = CHOOSE(t >= SPREAD((scalar)s), SPREAD((scalar)s), span);
	const real u = t - span;
	const real v = one - u;
	const real first = CHOOSE(span > zero, part, one);
	const real last = CHOOSE(span < SPREAD((scalar)(spans - 1)), part, one);
	const real a = first * (v * v);
	const real c = last * (u * u);
	const real b = (u + u) * v + (one - first) * (v * v) + (one - last) * (u * u);
	ROLLED
	for (int s = 0; s < spans; s++) {
		const mask here = span == SPREAD((scalar)s);
		if (!ANY(here))
			continue;
		const real part_a = CHOOSE(here, a, zero);
		const real part_b = CHOOSE(here, b, zero);
		const real part_c = CHOOSE(here, c, zero);
		GLOBAL real *band = l->band + 3 * s;
		band[0] += part_a * a;
		band[1] += part_a * b;
		band[2] += part_a * c;
		band[3] += part_b * b;
		band[4] += part_b * c;
		band[6] += part_c * c;
		l->x[s] += part_a * along;
		l->x[s + 1] += part_b * along;
		l->x[s + 2] += part_c * along;
		l->y[s] += part_a * y;
		l->y[s + 1] += part_b * y;
		l->y[s + 2] += part_c * y;
	}
}

/* Where the spans of the fitted line begin and end, x and then y: they take the room of the factor,
 * which has done its work. */
SHARED_FUNCTION void quadratic_find_joints(const pass_line *l)
{
	const int spans = l->vertices - 2;
	const real part = SPREAD(LITERAL(0.5));
	GLOBAL real *x = l->band;
	GLOBAL real *y = l->band + spans + 1;
	x[0] = l->x[0];
	y[0] = l->y[0];
	ROLLED
	for (int s = 1; s < spans; s++) {
		x[s] = part * (l->x[s] + l->x[s + 1]);
		y[s] = part * (l->y[s] + l->y[s + 1]);
	}
	x[spans] = l->x[spans + 1];
	y[spans] = l->y[spans + 1];
}

/* y where x(t) is `along`, in the last span that begins at or before it: there x(t) - along goes from
 * below 0 to above, and of the two roots the one is wanted where it ascends. */
SHARED_FUNCTION real quadratic_fitted(const pass_line *l, scalar along)
{
	const int spans = l->vertices - 2;
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	GLOBAL const real *joint_x = l->band;
	GLOBAL const real *joint_y = l->band + spans + 1;
	real x0 = joint_x[0], x1 = l->x[1], x2 = joint_x[1];
	real y0 = joint_y[0], y1 = l->y[1], y2 = joint_y[1];
	ROLLED
	for (int s = 1; s < spans; s++) {
		const mask here = joint_x[s] <= SPREAD(along);
		x0 = CHOOSE(here, joint_x[s], x0);
		x1 = CHOOSE(here, l->x[s + 1], x1);
		x2 = CHOOSE(here, joint_x[s + 1], x2);
		y0 = CHOOSE(here, joint_y[s], y0);
		y1 = CHOOSE(here, l->y[s + 1], y1);
		y2 = CHOOSE(here, joint_y[s + 1], y2);
	}
	/* second u^2 + 2 first u = rest */
	const real first = x1 - x0;
	const real second = (x2 - x1) - first;
	const real rest = SPREAD(along) - x0;
	const real square = first * first + second * rest;
	const real down = first + SQUARE_ROOT(CHOOSE(square > zero, square, zero));
	const real root = CHOOSE(down > zero, rest / down, zero);
	const real u = CHOOSE(root < one, CHOOSE(root > zero, root, zero), one);
	const real slope = y1 - y0;
	return y0 + u * ((slope + slope) + u * ((y2 - y1) - slope));
}

#endif
