/* One line of a hull by least squares (thesis 5.3): parameters by cumulative chord length, normal
 * equations of few vertices, Cholesky; the first and the last vertex give way to the end points, and
 * the new y are those at the parameters where x(t) is the old x. The includer has dialect.h. */
#ifndef BATTEN_SHARED_PASS_FIT_H
#define BATTEN_SHARED_PASS_FIT_H

#include "shared/line_spline.h"
#include "shared/pass_fit_quadratic.h"

SHARED_FUNCTION real pass_last_knot(const pass_line *l)
{
	return SPREAD((scalar)(l->vertices - l->order + 1));
}

/* Cumulative chord lengths, scaled to the last knot. */
SHARED_FUNCTION void pass_find_parameters(const pass_line *l, GLOBAL const real *state)
{
	l->parameter[0] = SPREAD(LITERAL(0.0));
	ROLLED
	for (int i = 1; i < l->points; i++) {
		const real dx = SPREAD(l->along[i] - l->along[i - 1]);
		const real dy = state[l->from[i]] - state[l->from[i - 1]];
		l->parameter[i] = l->parameter[i - 1] + SQUARE_ROOT(dx * dx + dy * dy);
	}
	const real scale = pass_last_knot(l) / l->parameter[l->points - 1];
	ROLLED
	for (int i = 1; i < l->points; i++)
		l->parameter[i] = l->parameter[i] * scale;
}

/* Point i's part in the normal equations, to whichever span each lane has it in. */
SHARED_FUNCTION void pass_add_point(const pass_line *l, int i, real y)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real t = l->parameter[i];
	const int spans = l->vertices - l->order + 1;
	real basis[PASS_ORDER_MOST];
	real span = zero;
	ROLLED
	for (int s = 1; s < spans; s++)
		span = CHOOSE(t >= SPREAD((scalar)s), SPREAD((scalar)s), span);
	spline_basis(l->order, pass_last_knot(l), span, t, basis);
	ROLLED
	for (int s = 0; s < spans; s++) {
		const mask here = span == SPREAD((scalar)s);
		if (!ANY(here))
			continue;
		ROLLED
		for (int a = 0; a < l->order; a++) {
			const real part = CHOOSE(here, basis[a], zero);
			l->x[s + a] += part * SPREAD(l->along[i]);
			l->y[s + a] += part * y;
			ROLLED
			for (int b = a; b < l->order; b++)
				l->band[(s + a) * l->order + b - a] += part * basis[b];
		}
	}
}

/* L D L^T of the normal equations in the place of their band: 1 / D on the diagonal, L beside it, which
 * takes no roots. D goes where the parameters were, which have done their work. 1 where a pivot is lost. */
SHARED_FUNCTION real pass_factor(const pass_line *l)
{
	const int order = l->order;
	GLOBAL real *pivot = l->parameter;
	const real one = SPREAD(LITERAL(1.0));
	real lost = SPREAD(LITERAL(0.0));
	ROLLED
	for (int i = 0; i < l->vertices; i++) {
		GLOBAL real *row = l->band + i * order;
		const real diagonal = row[0];
		const int first = i - order + 1 > 0 ? i - order + 1 : 0;
		const int end = l->vertices - i < order ? l->vertices - i : order;
		ROLLED
		for (int q = first; q < i; q++) {
			GLOBAL const real *other = l->band + q * order + i - q;
			const real part = -(other[0] * pivot[q]);
			ROLLED
			for (int d = 0; d < end && i + d - q < order; d++)
				row[d] = FUSED(part, other[d], row[d]);
		}
		const mask good = row[0] > SPREAD(PASS_PIVOT) * diagonal;
		lost = CHOOSE(good, lost, one);
		pivot[i] = CHOOSE(good, row[0], one);
		row[0] = one / pivot[i];
		ROLLED
		for (int d = 1; d < end; d++)
			row[d] *= row[0];
	}
	return lost;
}

SHARED_FUNCTION void pass_solve(const pass_line *l, GLOBAL real *right)
{
	const int order = l->order;
	ROLLED
	for (int i = 1; i < l->vertices; i++) {
		real sum = right[i];
		ROLLED
		for (int q = i - order + 1 > 0 ? i - order + 1 : 0; q < i; q++)
			sum = FUSED(-l->band[q * order + i - q], right[q], sum);
		right[i] = sum;
	}
	ROLLED
	for (int i = l->vertices - 1; i >= 0; i--) {
		real sum = right[i] * l->band[i * order];
		ROLLED
		for (int d = 1; d < order && i + d < l->vertices; d++)
			sum = FUSED(-l->band[i * order + d], right[i + d], sum);
		right[i] = sum;
	}
}

/* y where x(t) is `along`. knot_x: x of the curve at every knot inside the range. */
SHARED_FUNCTION real pass_fitted(const pass_line *l, GLOBAL const real *knot_x, scalar along)
{
	const real last = pass_last_knot(l);
	const int spans = l->vertices - l->order + 1;
	real span = SPREAD(LITERAL(0.0));
	real x[PASS_ORDER_MOST];
	real y[PASS_ORDER_MOST];
	/* The last span that begins at or before it: it ends beyond, whatever the curve does before. */
	ROLLED
	for (int s = 0; s < spans; s++) {
		const mask here = s == 0 ? SPREAD(along) >= SPREAD(along) : knot_x[s] <= SPREAD(along);
		span = CHOOSE(here, SPREAD((scalar)s), span);
		ROLLED
		for (int j = 0; j < l->order; j++) {
			x[j] = CHOOSE(here, l->x[s + j], s == 0 ? l->x[j] : x[j]);
			y[j] = CHOOSE(here, l->y[s + j], s == 0 ? l->y[j] : y[j]);
		}
	}
	const real t = spline_parameter(l->order, last, span, x, SPREAD(along));
	return spline_value(l->order, last, span, t, y);
}

/* x of the curve at every knot inside the range, into the room of the factor, which has done its work. */
SHARED_FUNCTION void pass_find_knots(const pass_line *l)
{
	const int spans = l->vertices - l->order + 1;
	ROLLED
	for (int s = 1; s < spans; s++) {
		real window[PASS_ORDER_MOST];
		ROLLED
		for (int j = 0; j < l->order; j++)
			window[j] = l->x[s + j];
		l->band[s] = spline_value(l->order, pass_last_knot(l), SPREAD((scalar)s), SPREAD((scalar)s),
		                          window);
	}
}

/* The points into the normal equations, and the new y from their solution, at any order. */
SHARED_FUNCTION void pass_add_points(const pass_line *l, GLOBAL const real *state)
{
	ROLLED
	for (int i = 0; i < l->points; i++)
		pass_add_point(l, i, state[l->from[i]]);
}

SHARED_FUNCTION void pass_move_points(const pass_line *l, real lost, GLOBAL real *state)
{
	const real zero = SPREAD(LITERAL(0.0));
	pass_find_knots(l);
	ROLLED
	for (int i = 1; i + 1 < l->points; i++) {
		const real fitted = pass_fitted(l, l->band, l->along[i]);
		state[l->to[i]] = CHOOSE(lost > zero, state[l->from[i]], fitted);
		PASS_BESIDE(l->beside, PASS_POINT_TIME);
	}
}

/* The vertices by least squares, at any order. 1 where a pivot is lost. */
SHARED_FUNCTION real pass_find_vertices(const pass_line *l, GLOBAL const real *state)
{
	ROLLED
	for (int i = 0; i < l->vertices * (l->order + 2); i++)
		l->band[i] = SPREAD(LITERAL(0.0)); /* x and y follow the band */
	pass_add_points(l, state);
	const real lost = pass_factor(l);
	pass_solve(l, l->x);
	pass_solve(l, l->y);
	return lost;
}

SHARED_FUNCTION void pass_fit_line(const pass_line *l, GLOBAL real *state)
{
	const int end = l->points - 1;
	const int quadratic = l->order == 3;
	real lost;
	pass_find_parameters(l, state);
	if (quadratic)
		lost = quadratic_solve(l, state);
	else
		lost = pass_find_vertices(l, state);
	l->x[0] = SPREAD(l->along[0]);
	l->y[0] = state[l->from[0]];
	l->x[l->vertices - 1] = SPREAD(l->along[end]);
	l->y[l->vertices - 1] = state[l->from[end]];
	if (quadratic)
		quadratic_move_points(l, lost, state);
	else
		pass_move_points(l, lost, state);
}

#endif
