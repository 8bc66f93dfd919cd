/* What is integrated over a surface below a draft, by the divergence theorem (Letcher 9.4): Gauss points
 * in every span, cut at the waterline. */
#ifndef BATTEN_SHARED_AFLOAT_INTEGRALS_H
#define BATTEN_SHARED_AFLOAT_INTEGRALS_H

#include "afloat_line.h"

/* A draft, and how far above it a point still counts as below. */
typedef struct afloat_draft {
	real at, edge;
} afloat_draft;

/* A span of a line: its four coordinates and their derivatives across it, as polynomials. */
typedef struct afloat_piece {
	afloat_polynomial of[8];
} afloat_piece;

/* A point with both derivatives. */
typedef struct afloat_point {
	real p[3], by_u[3], by_v[3];
} afloat_point;

SHARED_FUNCTION void afloat_take_piece(const afloat_state *s, int d, int span, afloat_piece *piece)
{
	ROLLED for (int c = 0; c < s->dimension; c++)
	{
		piece->of[c] = afloat_of_row(s, d, span, s->row + c, 8);
		piece->of[4 + c] = afloat_of_row(s, d, span, s->row + 4 + c, 8);
	}
}

/* A place of a line of constant u, its parameter being v. */
SHARED_FUNCTION afloat_point afloat_point_of(const afloat_state *s, const afloat_piece *piece,
                                             real at)
{
	const int order = s->order[AFLOAT_V];
	afloat_point point;
	ROLLED for (int c = 0; c < 3; c++)
	{
		point.p[c] = afloat_value_slope(order, &piece->of[c], at, &point.by_v[c]);
		point.by_u[c] = afloat_value(order, &piece->of[4 + c], at);
	}
	if (s->dimension == 3)
		return point;
	real w_v;
	const real w = afloat_value_slope(order, &piece->of[3], at, &w_v);
	const real w_u = afloat_value(order, &piece->of[7], at);
	ROLLED for (int c = 0; c < 3; c++)
	{
		point.p[c] = point.p[c] / w;
		point.by_v[c] = (point.by_v[c] - point.p[c] * w_v) / w;
		point.by_u[c] = (point.by_u[c] - point.p[c] * w_u) / w;
	}
	return point;
}

/* The surface itself. */
SHARED_FUNCTION void afloat_add_surface(const afloat_point *q, real draft, real weight, real *sums)
{
	const real n_x = weight * (q->by_v[1] * q->by_u[2] - q->by_v[2] * q->by_u[1]);
	const real n_y = weight * (q->by_v[2] * q->by_u[0] - q->by_v[0] * q->by_u[2]);
	const real n_z = weight * (q->by_v[0] * q->by_u[1] - q->by_v[1] * q->by_u[0]);
	sums[AFLOAT_VOLUME_X] += q->p[0] * n_x;
	sums[AFLOAT_VOLUME_Y] += q->p[1] * n_y;
	sums[AFLOAT_VOLUME_Z] += (q->p[2] - draft) * n_z;
	sums[AFLOAT_MOMENT_X] += q->p[0] * q->p[1] * n_y;
	sums[AFLOAT_MOMENT_Z] += q->p[2] * q->p[1] * n_y;
	sums[AFLOAT_PLANE] -= n_z;
	sums[AFLOAT_PLANE_X] -= q->p[0] * n_z;
	sums[AFLOAT_PLANE_XX] -= q->p[0] * q->p[0] * n_z;
	sums[AFLOAT_PLANE_YY] -= q->p[1] * q->p[1] * n_z;
	sums[AFLOAT_WETTED] += SQUARE_ROOT(n_x * n_x + n_y * n_y + n_z * n_z);
}

/* The flat end of a hull: straight lines across from the edge to the centreplane, whose normals have no
 * y-component. The weight has the sign of the end. */
SHARED_FUNCTION void afloat_add_end(const afloat_point *q, real draft, real weight, real *sums)
{
	const real n_x = weight * q->by_v[2] * q->p[1];
	const real n_z = SPREAD(0) - weight * q->by_v[0] * q->p[1];
	sums[AFLOAT_VOLUME_X] += q->p[0] * n_x;
	sums[AFLOAT_VOLUME_Z] += (q->p[2] - draft) * n_z;
	sums[AFLOAT_PLANE] -= n_z;
	sums[AFLOAT_PLANE_X] -= q->p[0] * n_z;
	sums[AFLOAT_PLANE_XX] -= q->p[0] * q->p[0] * n_z;
	sums[AFLOAT_PLANE_YY] -= q->p[1] * q->p[1] * n_z / SPREAD(3);
	sums[AFLOAT_TRANSOM] += SQUARE_ROOT(n_x * n_x + n_z * n_z);
}

/* The Gauss points between two places of a line in one span; a weight of 0 leaves a lane as it is. */
SHARED_FUNCTION void afloat_add_interval(const afloat_state *s, const afloat_piece *piece,
                                         const afloat_draft *draft, real from, real wide,
                                         real weight, int is_end, real *sums)
{
	ROLLED for (int k = 0; k < s->points; k++)
	{
		const real at = FUSED(wide, SPREAD(s->rule[k]), from);
		const real part = wide * SPREAD(s->rule[s->points + k]) * weight;
		const afloat_point point = afloat_point_of(s, piece, at);
		if (is_end)
			afloat_add_end(&point, draft->at, part, sums);
		else
			afloat_add_surface(&point, draft->at, part, sums);
	}
}

/* Height of a row's poles over the draft, homogeneous: of the sign of the height itself. */
SHARED_FUNCTION real afloat_over(const STATE real *pole, real edge)
{
	return pole[2] - edge * pole[3];
}

/* Lowest and highest pole of a span of the row, over the draft. */
SHARED_FUNCTION void afloat_heights(const afloat_state *s, int d, int span, real edge, real *low,
                                    real *high)
{
	const STATE real *from = s->row + 8 * s->first[d][span];
	*low = *high = afloat_over(from, edge);
	ROLLED for (int k = 1; k < s->order[d]; k++)
	{
		const real over = afloat_over(from + 8 * k, edge);
		*low = afloat_smaller(*low, over);
		*high = afloat_larger(*high, over);
	}
}

SHARED_FUNCTION afloat_polynomial afloat_height_of(const afloat_state *s, int d, int span,
                                                   real edge)
{
	afloat_polynomial p = afloat_of_row(s, d, span, s->row + 2, 8);
	const afloat_polynomial w = afloat_of_row(s, d, span, s->row + 3, 8);
	ROLLED for (int m = 0; m < s->order[d]; m++) p.of[m] = p.of[m] - edge * w.of[m];
	return p;
}

/* The part of the line of constant u that is below the draft, its row taken. */
SHARED_FUNCTION void afloat_add_line(const afloat_state *s, const afloat_draft *draft, real weight,
                                     int is_end, real *sums)
{
	const real bound = SPREAD(LITERAL(0.5)), nought = SPREAD(0);
	ROLLED for (int span = 0; span < s->spans[AFLOAT_V]; span++)
	{
		real low, high, cuts[AFLOAT_ROOTS];
		afloat_heights(s, AFLOAT_V, span, draft->edge, &low, &high);
		const mask wet_at_all = low <= nought, wet_wholly = high <= nought,
				   cut = wet_at_all & (high > nought);
		if (!ANY(wet_at_all))
			continue;
		afloat_piece piece;
		afloat_take_piece(s, AFLOAT_V, span, &piece);
		const afloat_polynomial over = afloat_height_of(s, AFLOAT_V, span, draft->edge);
		afloat_clear(cuts, AFLOAT_ROOTS);
		if (ANY(cut))
			afloat_roots(s->order[AFLOAT_V], &over, -bound, bound, cut, cuts, AFLOAT_ROOTS);
		real from = -bound;
		ROLLED for (int n = 0; n <= AFLOAT_ROOTS; n++)
		{
			const real to = n < AFLOAT_ROOTS ? afloat_smaller(cuts[n], bound) : bound;
			const real middle = afloat_value(s->order[AFLOAT_V], &over, bound * (from + to));
			const mask wet = wet_at_all & (wet_wholly | (middle <= nought)) & (to > from);
			if (ANY(wet))
				afloat_add_interval(s, &piece, draft, from, CHOOSE(wet, to - from, nought), weight,
				                    is_end, sums);
			from = to;
			if (!ANY(from < bound))
				break;
		}
	}
}

/* Where the waterline crosses the knot lines of v in a span of u, ascending. */
SHARED_FUNCTION void afloat_take_breaks(const afloat_state *s, int span, real edge, real *breaks)
{
	const int order = s->order[AFLOAT_U], dimension = s->dimension;
	const int across = dimension * s->count[AFLOAT_U];
	const real bound = SPREAD(LITERAL(0.5)), nought = SPREAD(0);
	afloat_clear(breaks, AFLOAT_BREAKS);
	ROLLED for (int line = 0; line <= s->spans[AFLOAT_V]; line++)
	{
		const int at = line < s->spans[AFLOAT_V] ? line : line - 1, end = line - at;
		GLOBAL const scalar *edges = s->edges[AFLOAT_V] + (2 * at + end) * s->order[AFLOAT_V];
		real low = nought, high = nought;
		ROLLED for (int k = 0; k < order; k++)
		{
			GLOBAL const real *pole = s->poles + s->first[AFLOAT_V][at] * across +
			                          (s->first[AFLOAT_U][span] + k) * dimension;
			real z = nought, w = nought;
			ROLLED for (int n = 0; n < s->order[AFLOAT_V]; n++)
			{
				const real part = SPREAD(edges[n]);
				z = FUSED(part, pole[n * across + 2], z);
				w = dimension == 4 ? FUSED(part, pole[n * across + 3], w) : SPREAD(1);
			}
			const real over = z - edge * w;
			low = k == 0 ? over : afloat_smaller(low, over);
			high = k == 0 ? over : afloat_larger(high, over);
			s->row[k] = over;
		}
		const mask crosses = (low <= nought) & (high > nought);
		if (!ANY(crosses))
			continue;
		afloat_polynomial over;
		GLOBAL const scalar *basis = s->bases[AFLOAT_U] + span * order * order;
		ROLLED for (int m = 0; m < order; m++)
		{
			real sum = SPREAD(basis[m * order]) * s->row[0];
			ROLLED for (int k = 1; k < order; k++)
				sum = FUSED(SPREAD(basis[m * order + k]), s->row[k], sum);
			over.of[m] = sum;
		}
		afloat_roots(order, &over, -bound, bound, crosses, breaks, AFLOAT_BREAKS);
	}
}

/* From 0..1 to a piece of u that is cut at its ends or not. The waterline leaves a break as a square root
 * where it runs into the keel, so that there the parameter begins with its square. */
SHARED_FUNCTION real afloat_map_piece(mask cut_first, mask cut_last, scalar t, real *slope)
{
	const real both = SPREAD(t * t * (3 - 2 * t)), both_by = SPREAD(6 * t * (1 - t));
	const real first = SPREAD(t * t), first_by = SPREAD(2 * t);
	const real last = SPREAD(t * (2 - t)), last_by = SPREAD(2 * (1 - t));
	*slope = CHOOSE(cut_first, CHOOSE(cut_last, both_by, first_by),
	                CHOOSE(cut_last, last_by, SPREAD(1)));
	return CHOOSE(cut_first, CHOOSE(cut_last, both, first), CHOOSE(cut_last, last, SPREAD(t)));
}

/* A span of u between its breaks. */
SHARED_FUNCTION void afloat_add_span(const afloat_state *s, int span, const afloat_draft *draft,
                                     const real *breaks, real *sums)
{
	const real bound = SPREAD(LITERAL(0.5)), nought = SPREAD(0);
	real from = -bound;
	ROLLED for (int n = 0; n <= AFLOAT_BREAKS; n++)
	{
		const real next = n < AFLOAT_BREAKS ? breaks[n] : SPREAD(AFLOAT_FAR);
		const real to = afloat_smaller(next, bound);
		const mask there = to > from, cut_last = next < SPREAD(AFLOAT_FAR);
		const mask cut_first = SPREAD((scalar)n) > SPREAD(LITERAL(0.5));
		const real wide = CHOOSE(there, to - from, nought);
		ROLLED for (int k = 0; k < s->points && ANY(there); k++)
		{
			real slope;
			const real part = afloat_map_piece(cut_first, cut_last, s->rule[k], &slope);
			afloat_take_row(s, AFLOAT_U, span, FUSED(wide, part, from), bound > nought);
			afloat_add_line(s, draft, wide * slope * SPREAD(s->rule[s->points + k]), 0, sums);
		}
		from = to;
		if (!ANY(cut_last))
			break;
	}
}

/* The two ends of the surface. */
SHARED_FUNCTION void afloat_add_ends(const afloat_state *s, const afloat_draft *draft, real *sums)
{
	const real bound = SPREAD(LITERAL(0.5));
	ROLLED for (int end = 0; end < 2; end++)
	{
		const real at = end == 0 ? -bound : bound;
		afloat_take_row(s, AFLOAT_U, end == 0 ? 0 : s->spans[AFLOAT_U] - 1, at, bound > SPREAD(0));
		afloat_add_line(s, draft, SPREAD(end == 0 ? -1 : 1), 1, sums);
	}
}

#endif
