/* Lines of a surface, a span of them at a time: polynomials, where they change their sign, and the row of
 * poles of a line. Parameters are those of a span, s = -0.5 .. 0.5, each lane with its own. */
#ifndef BATTEN_SHARED_AFLOAT_LINE_H
#define BATTEN_SHARED_AFLOAT_LINE_H

#include "afloat_layout.h"
#include "dialect.h"

/* Roots a line is looked through for in a span, and breaks a span is cut into at most. */
#define AFLOAT_ROOTS 8
#define AFLOAT_BREAKS 16
#define AFLOAT_FAR LITERAL(1e30)

/* What a work-item works with: what all share, its lanes' poles, room of its own. */
typedef struct afloat_state {
	int order[2], count[2], spans[2], points, drafts, dimension;
	GLOBAL const int *first[2];
	GLOBAL const scalar *lines[2], *bases[2], *edges[2], *rule, *drafts_m, *length;
	GLOBAL const real *poles; /* [v][u][dimension] */
	STATE real *row;          /* [count][2][4]: x, y, z, w and their derivatives across the line */
	STATE real
		*bands[2]; /* [spans][2]: of u the aftmost and foremost pole, of v the lowest and highest */
} afloat_state;

/* A polynomial over a span, of the lowest power first. */
typedef struct afloat_polynomial {
	real of[AFLOAT_ORDER_MOST];
} afloat_polynomial;

SHARED_FUNCTION afloat_state afloat_state_in(GLOBAL const int *shape, GLOBAL const int *lists,
                                             GLOBAL const scalar *tables, GLOBAL const real *poles,
                                             STATE real *room)
{
	afloat_state s;
	for (int d = 0; d < 2; d++) {
		s.order[d] = shape[AFLOAT_ORDER + d];
		s.count[d] = shape[AFLOAT_COUNT + d];
		s.spans[d] = shape[AFLOAT_SPANS + d];
		s.first[d] = lists + shape[AFLOAT_AT_FIRST + d];
		s.lines[d] = tables + shape[AFLOAT_AT_LINES + d];
		s.bases[d] = tables + shape[AFLOAT_AT_BASES + d];
		s.edges[d] = tables + shape[AFLOAT_AT_EDGES + d];
	}
	s.points = shape[AFLOAT_POINTS];
	s.drafts = shape[AFLOAT_DRAFTS];
	s.dimension = shape[AFLOAT_DIMENSION];
	s.rule = tables + shape[AFLOAT_AT_RULE];
	s.drafts_m = tables + shape[AFLOAT_AT_DRAFTS];
	s.length = tables + shape[AFLOAT_AT_LENGTH];
	s.poles = poles;
	s.row = room;
	s.bands[AFLOAT_U] = room + AFLOAT_ROW(s.count[AFLOAT_U], s.count[AFLOAT_V]);
	s.bands[AFLOAT_V] = s.bands[AFLOAT_U] + 2 * s.count[AFLOAT_U];
	return s;
}

SHARED_FUNCTION real afloat_smaller(real a, real b)
{
	return CHOOSE(a < b, a, b);
}

SHARED_FUNCTION real afloat_larger(real a, real b)
{
	return CHOOSE(a > b, a, b);
}

SHARED_FUNCTION real afloat_size(real a)
{
	return CHOOSE(a < SPREAD(0), -a, a);
}

/* ---- polynomials ---- */

SHARED_FUNCTION real afloat_value(int order, const afloat_polynomial *p, real at)
{
	real value = p->of[order - 1];
	ROLLED for (int m = order - 2; m >= 0; m--) value = FUSED(value, at, p->of[m]);
	return value;
}

/* With its slope. */
SHARED_FUNCTION real afloat_value_slope(int order, const afloat_polynomial *p, real at, real *slope)
{
	real value = p->of[order - 1], by = SPREAD(0);
	ROLLED for (int m = order - 2; m >= 0; m--)
	{
		by = FUSED(by, at, value);
		value = FUSED(value, at, p->of[m]);
	}
	*slope = by;
	return value;
}

/* The polynomial of a span from a row of values, stride apart. */
SHARED_FUNCTION afloat_polynomial afloat_of_row(const afloat_state *s, int d, int span,
                                                const STATE real *row, int stride)
{
	const int order = s->order[d];
	GLOBAL const scalar *basis = s->bases[d] + span * order * order;
	const STATE real *from = row + s->first[d][span] * stride;
	afloat_polynomial p;
	ROLLED for (int m = 0; m < order; m++)
	{
		real sum = SPREAD(basis[m * order]) * from[0];
		ROLLED for (int k = 1; k < order; k++)
			sum = FUSED(SPREAD(basis[m * order + k]), from[k * stride], sum);
		p.of[m] = sum;
	}
	return p;
}

/* The value of a row where a span begins (end 0) or ends (1). */
SHARED_FUNCTION real afloat_at_edge(const afloat_state *s, int d, int span, int end,
                                    const STATE real *row, int stride)
{
	const int order = s->order[d];
	GLOBAL const scalar *edge = s->edges[d] + (2 * span + end) * order;
	const STATE real *from = row + s->first[d][span] * stride;
	real sum = SPREAD(edge[0]) * from[0];
	ROLLED for (int k = 1; k < order; k++) sum = FUSED(SPREAD(edge[k]), from[k * stride], sum);
	return sum;
}

/* The basis of a span at a place, with its slope. */
SHARED_FUNCTION void afloat_basis(const afloat_state *s, int d, int span, real at, real *value,
                                  real *slope)
{
	const int order = s->order[d];
	GLOBAL const scalar *basis = s->bases[d] + span * order * order;
	value[0] = slope[0] = SPREAD(0); /* there is an order */
	ROLLED for (int k = 0; k < order; k++)
	{
		real sum = SPREAD(basis[(order - 1) * order + k]), by = SPREAD(0);
		ROLLED for (int m = order - 2; m >= 0; m--)
		{
			by = FUSED(by, at, sum);
			sum = FUSED(sum, at, SPREAD(basis[m * order + k]));
		}
		value[k] = sum;
		slope[k] = by;
	}
}

/* ---- rows ---- */

/* The poles of the line across direction d at a place of one of its spans, of the lanes where that is so:
 * row [poles of the other direction][2][4], the derivative by d second. Without weights w is 1. */
SHARED_FUNCTION void afloat_take_row(const afloat_state *s, int d, int span, real at, mask where)
{
	const int order = s->order[d], other = 1 - d, dimension = s->dimension;
	const int step = d == AFLOAT_U ? dimension : dimension * s->count[AFLOAT_U];
	const int across = d == AFLOAT_U ? dimension * s->count[AFLOAT_U] : dimension;
	real value[AFLOAT_ORDER_MOST], slope[AFLOAT_ORDER_MOST];
	afloat_basis(s, d, span, at, value, slope);
	ROLLED for (int n = 0; n < s->count[other]; n++)
	{
		GLOBAL const real *pole = s->poles + n * across + s->first[d][span] * step;
		STATE real *row = s->row + 8 * n;
		ROLLED for (int c = 0; c < dimension; c++)
		{
			real sum = value[0] * pole[c], by = slope[0] * pole[c];
			ROLLED for (int k = 1; k < order; k++)
			{
				sum = FUSED(value[k], pole[k * step + c], sum);
				by = FUSED(slope[k], pole[k * step + c], by);
			}
			row[c] = CHOOSE(where, sum, row[c]);
			row[4 + c] = CHOOSE(where, by, row[4 + c]);
		}
		if (dimension == 3) {
			row[3] = SPREAD(1);
			row[7] = SPREAD(0);
		}
	}
}

/* Where a parameter of the whole direction lies in a span, and in which lanes it does. */
SHARED_FUNCTION mask afloat_in_span(const afloat_state *s, int d, int span, real t, real *at)
{
	const scalar from = s->lines[d][span], to = s->lines[d][span + 1];
	*at = (t - SPREAD(from)) / SPREAD(to - from) - SPREAD(LITERAL(0.5));
	/* the first and the last span take what is beyond */
	const mask after = t >= SPREAD(span == 0 ? -AFLOAT_FAR : from);
	const mask before = t < SPREAD(span + 1 == s->spans[d] ? AFLOAT_FAR : to);
	return after & before;
}

/* The same row at parameters of the whole direction. */
SHARED_FUNCTION void afloat_take_row_at(const afloat_state *s, int d, real t)
{
	ROLLED for (int span = 0; span < s->spans[d]; span++)
	{
		real at;
		const mask here = afloat_in_span(s, d, span, t, &at);
		if (ANY(here))
			afloat_take_row(s, d, span, at, here);
	}
}

/* ---- roots ---- */

/* Of a polynomial between a, where it is fa, and b, where it is fb of the other sign, in the lanes of
 * where: Newton's method from the chord, kept between bounds that close in. */
SHARED_FUNCTION real afloat_root_between(int order, const afloat_polynomial *p, real a, real fa,
                                         real b, real fb, mask where)
{
	const mask rises = fb > fa;
	real low = a, high = b, at = a - fa * (b - a) / (fb - fa);
	mask active = where;
	at = CHOOSE((at >= low) & (at <= high), at, SPREAD(LITERAL(0.5)) * (a + b));
	ROLLED for (int turn = 0; turn < 60 && ANY(active); turn++)
	{
		real slope;
		const real f = afloat_value_slope(order, p, at, &slope);
		const mask beyond = (f > SPREAD(0)) == rises;
		high = CHOOSE(beyond, at, high);
		low = CHOOSE(beyond, low, at);
		const real step = at - f / slope;
		const mask within = (step >= low) & (step <= high);
		const real next = CHOOSE(within, step, SPREAD(LITERAL(0.5)) * (low + high));
		const mask done = (f == SPREAD(0)) | (afloat_size(next - at) <= SPREAD(LITERAL(1e-16)));
		at = CHOOSE(active & (f != SPREAD(0)), next, at);
		active = active & (done == (f != f));
	}
	return at;
}

/* Adds to a list that ascends and ends with places far away. */
SHARED_FUNCTION void afloat_insert(real *list, int capacity, real place)
{
	ROLLED for (int k = 0; k < capacity; k++)
	{
		const real kept = afloat_smaller(list[k], place);
		place = afloat_larger(list[k], place);
		list[k] = kept;
	}
}

SHARED_FUNCTION void afloat_clear(real *list, int capacity)
{
	ROLLED for (int k = 0; k < capacity; k++) list[k] = SPREAD(AFLOAT_FAR);
}

/* Adds where a function changes from <= 0 to > 0 or back between a and b, as far as samples tell it, in
 * the lanes of where. VALUE(t) is
 * the function, BETWEEN finds the root between two places. */
#define AFLOAT_ROOTS_OF(name, subject, VALUE, BETWEEN)                                             \
	SHARED_FUNCTION void name(subject, real a, real b, mask where, real *list, int capacity)       \
	{                                                                                              \
		real from = a, at_from = VALUE(from);                                                      \
		ROLLED for (int i = 1; i <= AFLOAT_ROOTS; i++)                                             \
		{                                                                                          \
			const real part = SPREAD((scalar)i / AFLOAT_ROOTS);                                    \
			const real to = i == AFLOAT_ROOTS ? b : FUSED(b - a, part, a);                         \
			const real at_to = VALUE(to);                                                          \
			const mask crosses = where & ((at_from > SPREAD(0)) != (at_to > SPREAD(0)));           \
			if (ANY(crosses)) {                                                                    \
				const real root = BETWEEN(from, at_from, to, at_to, crosses);                      \
				afloat_insert(list, capacity, CHOOSE(crosses, root, SPREAD(AFLOAT_FAR)));          \
			}                                                                                      \
			from = to;                                                                             \
			at_from = at_to;                                                                       \
		}                                                                                          \
	}

#define AFLOAT_VALUE(t) afloat_value(order, p, t)
#define AFLOAT_BETWEEN(a, fa, b, fb, where) afloat_root_between(order, p, a, fa, b, fb, where)
#define AFLOAT_SUBJECT int order, const afloat_polynomial *p
AFLOAT_ROOTS_OF(afloat_roots, AFLOAT_SUBJECT, AFLOAT_VALUE, AFLOAT_BETWEEN)
#undef AFLOAT_SUBJECT
#undef AFLOAT_BETWEEN
#undef AFLOAT_VALUE

#endif
