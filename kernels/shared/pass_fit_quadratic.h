/* What the fit of a line (pass_fit.h) takes longest over, in closed form for order 3, the thesis's own.
 * The quadratic of a span has its middle vertex as Bezier point; its joints lie halfway between
 * vertices, those at the ends on them. The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_FIT_QUADRATIC_H
#define BATTEN_SHARED_PASS_FIT_QUADRATIC_H

#include "shared/pass_line.h"

/* A point's part in the normal equations of span s: basis values a, b, c, of lanes elsewhere 0. */
SHARED_FUNCTION void quadratic_add(const pass_line *l, int s, const real basis[3],
                                   const real part[3], real along, real y)
{
	GLOBAL real *band = l->band + 3 * s;
	band[0] = FUSED(part[0], basis[0], band[0]);
	band[1] = FUSED(part[0], basis[1], band[1]);
	band[2] = FUSED(part[0], basis[2], band[2]);
	band[3] = FUSED(part[1], basis[1], band[3]);
	band[4] = FUSED(part[1], basis[2], band[4]);
	band[6] = FUSED(part[2], basis[2], band[6]);
	UNROLLED
	for (int j = 0; j < 3; j++) {
		l->x[s + j] = FUSED(part[j], along, l->x[s + j]);
		l->y[s + j] = FUSED(part[j], y, l->y[s + j]);
	}
}

/* The values of the three functions that are not 0 in a span. */
SHARED_FUNCTION void quadratic_basis(int spans, real span, real t, real basis[3])
{
	const real zero = SPREAD(LITERAL(0.0));
	const real part = SPREAD(LITERAL(0.5));
	const real one = SPREAD(LITERAL(1.0));
	const real u = t - span;
	const real v = one - u;
	const real uu = u * u;
	const real vv = v * v;
	const real first = CHOOSE(span > zero, part, one);
	const real last = CHOOSE(span < SPREAD((scalar)(spans - 1)), part, one);
	basis[0] = first * vv;
	basis[1] = FUSED(one - last, uu, FUSED(one - first, vv, (u + u) * v));
	basis[2] = last * uu;
}

/* Parameters ascend, so that each lane's span is the one of the point before or a later one: only few are
 * looked at, from `least` to `most`, between which all lanes are. */
SHARED_FUNCTION void quadratic_add_points(const pass_line *l, GLOBAL const real *state)
{
	const int spans = l->vertices - 2;
	const real zero = SPREAD(LITERAL(0.0));
	real span = zero;
	int least = 0;
	int most = 0;
	ROLLED
	for (int i = 0; i < l->points; i++) {
		const real along = SPREAD(l->along[i]);
		const real y = state[l->from[i]];
		const real t = l->parameter[i];
		real basis[3];
		ROLLED
		for (int s = least + 1; s < spans; s++) {
			const mask there = t >= SPREAD((scalar)s);
			if (!ANY(there))
				break;
			span = CHOOSE(there, SPREAD((scalar)s), span);
			most = s > most ? s : most;
		}
		while (least < most && !ANY(span == SPREAD((scalar)least)))
			least++;
		quadratic_basis(spans, span, t, basis);
		ROLLED
		for (int s = least; s <= most; s++) {
			const mask here = span == SPREAD((scalar)s);
			const real part[3] = { CHOOSE(here, basis[0], zero), CHOOSE(here, basis[1], zero),
				                   CHOOSE(here, basis[2], zero) };
			quadratic_add(l, s, basis, part, along, y);
		}
	}
}

/* A span of the fitted line: x and y as polynomials of u in 0 .. 1. */
typedef struct quadratic_span {
	real x0, x1, x2, y0, y1, y2; /* coefficients of 1, 2 u (x) or u (y), and u^2 */
} quadratic_span;

/* Joints lie halfway between vertices, those at the ends on them. */
SHARED_FUNCTION real quadratic_joint(const pass_line *l, GLOBAL const real *vertex, int s)
{
	if (s == 0)
		return vertex[0];
	if (s == l->vertices - 2)
		return vertex[s + 1];
	return SPREAD(LITERAL(0.5)) * (vertex[s] + vertex[s + 1]);
}

SHARED_FUNCTION quadratic_span quadratic_span_of(const pass_line *l, int s)
{
	quadratic_span p;
	p.x0 = quadratic_joint(l, l->x, s);
	p.x1 = l->x[s + 1] - p.x0;
	p.x2 = (quadratic_joint(l, l->x, s + 1) - l->x[s + 1]) - p.x1;
	const real slope = l->y[s + 1] - (p.y0 = quadratic_joint(l, l->y, s));
	p.y1 = slope + slope;
	p.y2 = (quadratic_joint(l, l->y, s + 1) - l->y[s + 1]) - slope;
	return p;
}

SHARED_FUNCTION void quadratic_span_choose(mask here, const quadratic_span *next, quadratic_span *p)
{
	p->x0 = CHOOSE(here, next->x0, p->x0);
	p->x1 = CHOOSE(here, next->x1, p->x1);
	p->x2 = CHOOSE(here, next->x2, p->x2);
	p->y0 = CHOOSE(here, next->y0, p->y0);
	p->y1 = CHOOSE(here, next->y1, p->y1);
	p->y2 = CHOOSE(here, next->y2, p->y2);
}

/* y of a span where x(u) is `along`: x(u) - along goes from below 0 to above, and of the two roots the one
 * is wanted where it ascends. */
SHARED_FUNCTION real quadratic_fitted(const quadratic_span *p, real along)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	/* x2 u^2 + 2 x1 u = rest */
	const real rest = along - p->x0;
	const real square = FUSED(p->x2, rest, p->x1 * p->x1);
	const real down = p->x1 + SQUARE_ROOT(CHOOSE(square > zero, square, zero));
	const real root = CHOOSE(down > zero, rest / down, zero);
	const real u = CHOOSE(root < one, CHOOSE(root > zero, root, zero), one);
	return FUSED(u, FUSED(u, p->y2, p->y1), p->y0);
}

/* The least x of each joint and those behind it, in the room of the factor, which has done its work. */
SHARED_FUNCTION void quadratic_find_joints(const pass_line *l)
{
	real least = l->x[l->vertices - 1];
	ROLLED
	for (int s = l->vertices - 3; s > 0; s--) {
		const real joint = quadratic_joint(l, l->x, s);
		least = CHOOSE(joint < least, joint, least);
		l->band[s] = least;
	}
}

/* A point lies in the last span that begins at or before it, which is that of the point before or a later
 * one: all spans before `next` begin before the point, in all lanes. */
SHARED_FUNCTION void quadratic_move_points(const pass_line *l, real lost, GLOBAL real *state)
{
	const int spans = l->vertices - 2;
	const real zero = SPREAD(LITERAL(0.0));
	quadratic_span p = quadratic_span_of(l, 0);
	int next = 1;
	quadratic_find_joints(l);
	ROLLED
	for (int i = 1; i + 1 < l->points; i++) {
		const real along = SPREAD(l->along[i]);
		ROLLED
		for (int s = next; s < spans; s++) {
			const mask there = l->band[s] <= along;
			if (!ANY(there))
				break;
			const quadratic_span one = quadratic_span_of(l, s);
			quadratic_span_choose(there, &one, &p);
			if (!ANY(!there))
				next = s + 1;
		}
		const real fitted = quadratic_fitted(&p, along);
		state[l->to[i]] = CHOOSE(lost > zero, state[l->from[i]], fitted);
	}
}

#endif
