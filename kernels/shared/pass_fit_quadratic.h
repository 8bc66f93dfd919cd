/* What the fit of a line (pass_fit.h) takes longest over, in closed form for order 3, the thesis's own.
 * The quadratic of a span has its middle vertex as Bezier point; its joints lie halfway between
 * vertices, those at the ends on them. The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_FIT_QUADRATIC_H
#define BATTEN_SHARED_PASS_FIT_QUADRATIC_H

#include "shared/pass_line.h"

/* The third Newton step leaves the square of this part of itself, nothing that counts. */
#define QUADRATIC_OFF LITERAL(0.015625)
#if BATTEN_DOUBLE
#define QUADRATIC_STEP LITERAL(1e-12)
#else
#define QUADRATIC_STEP LITERAL(4e-5)
#endif

/* What the points of a span add to the normal equations: to the products of the three functions that are
 * not 0 there, and to those of each with x and with y. */
enum { QUADRATIC_X = 6, QUADRATIC_Y = 9, QUADRATIC_SUMS = 12 };

SHARED_FUNCTION void quadratic_add(const real basis[3], real along, real y,
                                   real sums[QUADRATIC_SUMS])
{
	sums[0] = FUSED(basis[0], basis[0], sums[0]);
	sums[1] = FUSED(basis[0], basis[1], sums[1]);
	sums[2] = FUSED(basis[0], basis[2], sums[2]);
	sums[3] = FUSED(basis[1], basis[1], sums[3]);
	sums[4] = FUSED(basis[1], basis[2], sums[4]);
	sums[5] = FUSED(basis[2], basis[2], sums[5]);
	UNROLLED
	for (int j = 0; j < 3; j++) {
		sums[QUADRATIC_X + j] = FUSED(basis[j], along, sums[QUADRATIC_X + j]);
		sums[QUADRATIC_Y + j] = FUSED(basis[j], y, sums[QUADRATIC_Y + j]);
	}
}

/* The sums of span s. Parameters ascend: its points are those from *begin on until all lanes are beyond it,
 * each counting in the lanes that have it here; *begin becomes the first that a lane has beyond. */
SHARED_FUNCTION void quadratic_sum(const pass_line *l, GLOBAL const real *state, int s, int *begin,
                                   real sums[QUADRATIC_SUMS])
{
	const int spans = l->vertices - 2;
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real first = SPREAD(s > 0 ? LITERAL(0.5) : LITERAL(1.0));
	const real last = SPREAD(s < spans - 1 ? LITERAL(0.5) : LITERAL(1.0));
	const real from = SPREAD((scalar)s);
	/* The last parameter may be rounded up. */
	const real to = SPREAD((scalar)(s < spans - 1 ? s + 1 : s + 2));
	ROLLED
	for (int i = *begin; i < l->points; i++) {
		const real t = l->parameter[i];
		const mask before = t < to;
		if (!ANY(before))
			break;
		if (!ANY(!before))
			*begin = i + 1;
		const mask here = (t >= from) & before;
		const real u = t - from;
		const real v = one - u;
		const real uu = u * u;
		const real vv = v * v;
		const real middle = FUSED(one - last, uu, FUSED(one - first, vv, (u + u) * v));
		const real basis[3] = { CHOOSE(here, first * vv, zero), CHOOSE(here, middle, zero),
			                    CHOOSE(here, last * uu, zero) };
		quadratic_add(basis, SPREAD(l->along[i]), state[l->from[i]], sums);
	}
}

/* A row of the normal equations: its diagonal, what lies beside it, and its right sides. */
typedef struct quadratic_row {
	real diagonal, next, beyond, x, y;
} quadratic_row;

/* Row i less what the two before it, eliminated, take from it (L D L^T); 1 / D and L go into the band, the
 * right sides into x and y. Returns where the pivot is lost. */
SHARED_FUNCTION mask quadratic_eliminate(const pass_line *l, int i, const quadratic_row *before,
                                         const quadratic_row *last, quadratic_row *row)
{
	const real one = SPREAD(LITERAL(1.0));
	const real diagonal = row->diagonal;
	GLOBAL real *band = l->band + 3 * i;
	if (i > 0) {
		const real part = -band[-2];
		row->diagonal = FUSED(part, last->next, row->diagonal);
		row->next = FUSED(part, last->beyond, row->next);
		row->x = FUSED(part, last->x, row->x);
		row->y = FUSED(part, last->y, row->y);
	}
	if (i > 1) {
		const real part = -band[-4];
		row->diagonal = FUSED(part, before->beyond, row->diagonal);
		row->x = FUSED(part, before->x, row->x);
		row->y = FUSED(part, before->y, row->y);
	}
	const mask good = row->diagonal > SPREAD(PASS_PIVOT) * diagonal;
	band[0] = one / CHOOSE(good, row->diagonal, one);
	band[1] = row->next * band[0];
	band[2] = row->beyond * band[0];
	l->x[i] = row->x;
	l->y[i] = row->y;
	return good;
}

/* The vertices from the rows that are eliminated. */
SHARED_FUNCTION void quadratic_put_back(const pass_line *l)
{
	const real zero = SPREAD(LITERAL(0.0));
	real x[2] = { zero, zero };
	real y[2] = { zero, zero };
	ROLLED
	for (int i = l->vertices - 1; i >= 0; i--) {
		GLOBAL const real *band = l->band + 3 * i;
		const real new_x = FUSED(-band[1], x[0], FUSED(-band[2], x[1], l->x[i] * band[0]));
		const real new_y = FUSED(-band[1], y[0], FUSED(-band[2], y[1], l->y[i] * band[0]));
		x[1] = x[0];
		y[1] = y[0];
		l->x[i] = x[0] = new_x;
		l->y[i] = y[0] = new_y;
	}
}

/* The vertices by least squares. A row is eliminated as soon as the span that begins with it is summed, so
 * that the equations stay in registers. 1 where a pivot is lost. */
SHARED_FUNCTION real quadratic_solve(const pass_line *l, GLOBAL const real *state)
{
	const real zero = SPREAD(LITERAL(0.0));
	real lost = zero;
	int begin = 0;
	quadratic_row before = { zero, zero, zero, zero, zero };
	quadratic_row last = before;
	quadratic_row row = before;   /* what spans summed so far have of row s, */
	quadratic_row after = before; /* and of the one after it */
	ROLLED
	for (int s = 0; s < l->vertices; s++) {
		real sums[QUADRATIC_SUMS];
		UNROLLED
		for (int n = 0; n < QUADRATIC_SUMS; n++)
			sums[n] = zero;
		if (s < l->vertices - 2)
			quadratic_sum(l, state, s, &begin, sums);
		row.diagonal += sums[0];
		row.next += sums[1];
		row.beyond = sums[2];
		row.x += sums[QUADRATIC_X];
		row.y += sums[QUADRATIC_Y];
		lost = CHOOSE(quadratic_eliminate(l, s, &before, &last, &row), lost, SPREAD(LITERAL(1.0)));
		before = last;
		last = row;
		row.diagonal = after.diagonal + sums[3];
		row.next = sums[4];
		row.x = after.x + sums[QUADRATIC_X + 1];
		row.y = after.y + sums[QUADRATIC_Y + 1];
		after.diagonal = sums[5];
		after.x = sums[QUADRATIC_X + 2];
		after.y = sums[QUADRATIC_Y + 2];
	}
	quadratic_put_back(l);
	return lost;
}

/* A span of the fitted line: x and y as polynomials of u in 0 .. 1. */
typedef struct quadratic_span {
	real x0, x1, x2, y0, y1, y2; /* coefficients of 1, u, u^2 */
	real per_x;                  /* u gained along x, by the chord */
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
	const real begin = l->x[s + 1] - p.x0;
	p.x1 = begin + begin;
	p.x2 = (quadratic_joint(l, l->x, s + 1) - l->x[s + 1]) - begin;
	p.per_x = SPREAD(LITERAL(1.0)) / (p.x1 + p.x2);
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
	p->per_x = CHOOSE(here, next->per_x, p->per_x);
}

/* u of a span where x(u) - x0 is `rest`, by the formula: of the two roots that where x ascends. */
SHARED_FUNCTION real quadratic_root(const quadratic_span *p, real rest)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real slope = SPREAD(LITERAL(0.5)) * p->x1;
	const real square = FUSED(p->x2, rest, slope * slope);
	const real down = slope + SQUARE_ROOT(CHOOSE(square > zero, square, zero));
	return CHOOSE(down > zero, rest / down, zero);
}

/* The same from the chord by three Newton steps, whose slope is inverted by multiply-adds too: no root, no
 * division. u is found to the last digits where the last step is that small and the slope inverted well;
 * elsewhere, on lines that are far from even, it takes the formula. */
SHARED_FUNCTION real quadratic_place(const quadratic_span *p, real rest)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real chord = rest * p->per_x;
	real u = FUSED(p->x2 * p->per_x * chord, one - chord, chord);
	/* 1 / (1 - off) is (1 + off) (1 + off^2), but for the fourth power of it. */
	real off = FUSED(-p->per_x, FUSED(p->x2, u + u, p->x1), one);
	real inverse = p->per_x * FUSED(off, off, one);
	inverse = FUSED(inverse, off, inverse);
	u = FUSED(inverse, FUSED(-u, FUSED(p->x2, u, p->x1), rest), u);
	off = FUSED(-inverse, FUSED(p->x2, u + u, p->x1), one);
	inverse = FUSED(inverse, off, inverse);
	u = FUSED(inverse, FUSED(-u, FUSED(p->x2, u, p->x1), rest), u);
	const real step = inverse * FUSED(-u, FUSED(p->x2, u, p->x1), rest);
	u += step;
	const mask found = (step * step <= SPREAD(QUADRATIC_STEP * QUADRATIC_STEP)) &
	                   (off * off <= SPREAD(QUADRATIC_OFF * QUADRATIC_OFF)) & (inverse > zero);
	if (ANY(!found))
		u = CHOOSE(found, u, quadratic_root(p, rest));
	return u;
}

/* y of a span where x(u) is `along`. */
SHARED_FUNCTION real quadratic_fitted(const quadratic_span *p, real along)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real root = quadratic_place(p, along - p->x0);
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
		PASS_BESIDE(l->beside, PASS_POINT_TIME);
	}
}

#endif
