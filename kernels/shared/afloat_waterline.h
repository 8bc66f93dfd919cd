/* Extents of a surface and of its waterlines: samples of every span, the largest refined. */
#ifndef BATTEN_SHARED_AFLOAT_WATERLINE_H
#define BATTEN_SHARED_AFLOAT_WATERLINE_H

#include "afloat_integrals.h"
#include "afloat_search.h"

/* Samples a span, of a whole surface and of a waterline. */
#define AFLOAT_SAMPLES 8
#define AFLOAT_LINE_SAMPLES 4

/* Of a search for a half-breadth: how near its place has to be known, in spans. Where a waterline leaves the
 * surface, its half-breadth ends with a leap. */
#define AFLOAT_NEAR LITERAL(1e-11)

/* The part of a span between two parameters of the whole direction, and in which lanes there is one. */
SHARED_FUNCTION mask afloat_overlap(const afloat_state *s, int d, int span, real low, real high,
                                    real *from, real *to)
{
	const real a = afloat_larger(low, SPREAD(s->lines[d][span]));
	const real b = afloat_smaller(high, SPREAD(s->lines[d][span + 1]));
	const mask there = b > a;
	(void)afloat_in_span(s, d, span, CHOOSE(there, a, SPREAD(s->lines[d][span])), from);
	(void)afloat_in_span(s, d, span, CHOOSE(there, b, SPREAD(s->lines[d][span])), to);
	return there;
}

/* A parameter of the whole direction. */
SHARED_FUNCTION real afloat_parameter(const afloat_state *s, int d, int span, real at)
{
	const scalar from = s->lines[d][span], to = s->lines[d][span + 1];
	return FUSED(SPREAD(to - from), at + SPREAD(LITERAL(0.5)), SPREAD(from));
}

/* ---- extents ---- */

/* Largest y of a line across direction d, whose row is taken, between two parameters. */
SHARED_FUNCTION void afloat_raise_half_beam(const afloat_state *s, int d, real low, real high,
                                            real *best, real *best_at)
{
	const int order = s->order[d];
	ROLLED for (int span = 0; span < s->spans[d]; span++)
	{
		real from, to;
		afloat_search g;
		const mask there = afloat_overlap(s, d, span, low, high, &from, &to);
		if (!ANY(there))
			continue;
		const afloat_polynomial y = afloat_of_row(s, d, span, s->row + 1, 8);
		const afloat_polynomial w = afloat_of_row(s, d, span, s->row + 3, 8);
		afloat_search_begin(&g, from, to, SPREAD(AFLOAT_NEAR), there);
		ROLLED for (int n = 0; n < AFLOAT_TRIALS && ANY(g.active); n++)
		{
			const real at = afloat_search_next(&g);
			afloat_search_take(&g, at, afloat_value(order, &y, at) / afloat_value(order, &w, at));
		}
		const mask better = there & (g.value[0] > *best);
		*best = CHOOSE(better, g.value[0], *best);
		*best_at = CHOOSE(better, afloat_parameter(s, d, span, g.place[0]), *best_at);
	}
}

/* Of one line of samples along u, its row taken. */
SHARED_FUNCTION void afloat_sample_line(const afloat_state *s, real v, real *out, real best[2])
{
	const int order = s->order[AFLOAT_U];
	ROLLED for (int span = 0; span < s->spans[AFLOAT_U]; span++)
	{
		afloat_polynomial of[4];
		ROLLED for (int c = 0; c < 4; c++) of[c] = afloat_of_row(s, AFLOAT_U, span, s->row + c, 8);
		const int samples = span + 1 == s->spans[AFLOAT_U] ? AFLOAT_SAMPLES : AFLOAT_SAMPLES - 1;
		ROLLED for (int n = 0; n <= samples; n++)
		{
			const real at = SPREAD((scalar)n / AFLOAT_SAMPLES - LITERAL(0.5));
			const real w = afloat_value(order, &of[3], at);
			const real x = afloat_value(order, &of[0], at) / w;
			const real y = afloat_value(order, &of[1], at) / w;
			const real z = afloat_value(order, &of[2], at) / w;
			const mask better = y > out[AFLOAT_HALF_BEAM];
			out[AFLOAT_AFTMOST] = afloat_smaller(out[AFLOAT_AFTMOST], x);
			out[AFLOAT_FOREMOST] = afloat_larger(out[AFLOAT_FOREMOST], x);
			out[AFLOAT_LOWEST] = afloat_smaller(out[AFLOAT_LOWEST], z);
			out[AFLOAT_HIGHEST] = afloat_larger(out[AFLOAT_HIGHEST], z);
			out[AFLOAT_HALF_BEAM] = CHOOSE(better, y, out[AFLOAT_HALF_BEAM]);
			best[AFLOAT_U] = CHOOSE(better, afloat_parameter(s, AFLOAT_U, span, at),
			                        best[AFLOAT_U]);
			best[AFLOAT_V] = CHOOSE(better, v, best[AFLOAT_V]);
		}
	}
}

/* AFLOAT_OUT_COUNT numbers of the surface. */
SHARED_FUNCTION void afloat_take_extents(const afloat_state *s, real *out)
{
	enum { TURNS = 6 };
	real best[2] = { SPREAD(s->lines[AFLOAT_U][0]), SPREAD(s->lines[AFLOAT_V][0]) };
	out[AFLOAT_LOWEST] = out[AFLOAT_AFTMOST] = SPREAD(AFLOAT_FAR);
	out[AFLOAT_HIGHEST] = out[AFLOAT_FOREMOST] = out[AFLOAT_HALF_BEAM] = SPREAD(-AFLOAT_FAR);
	ROLLED for (int n = 0; n <= AFLOAT_SAMPLES * s->spans[AFLOAT_V]; n++)
	{
		const int last = s->spans[AFLOAT_V] - 1, at = n / AFLOAT_SAMPLES;
		const int span = at < last ? at : last;
		const real part = SPREAD((scalar)(n - span * AFLOAT_SAMPLES) / AFLOAT_SAMPLES -
		                         LITERAL(0.5));
		afloat_take_row(s, AFLOAT_V, span, part, part < SPREAD(1));
		afloat_sample_line(s, afloat_parameter(s, AFLOAT_V, span, part), out, best);
	}
	/* from the largest y of the samples along u and v in turn */
	ROLLED for (int turn = 0; turn < TURNS; turn++)
	{
		const int d = turn % 2;
		const scalar first = s->lines[d][0], end = s->lines[d][s->spans[d]];
		const real step = SPREAD((end - first) / (scalar)s->spans[d] / AFLOAT_SAMPLES);
		afloat_take_row_at(s, 1 - d, best[1 - d]);
		afloat_raise_half_beam(s, d, best[d] - step, best[d] + step, &out[AFLOAT_HALF_BEAM],
		                       &best[d]);
	}
}

/* ---- waterlines ---- */

/* A waterline: from aft to fore, its largest half-breadth and the parameter of that. */
typedef struct afloat_waterline {
	real aft, fore, half_breadth, at, near;
} afloat_waterline;

SHARED_FUNCTION void afloat_take_outer(mask where, real x, real y, real *outer_x, real *outer_y)
{
	const mask better = where & (y > *outer_y);
	*outer_x = CHOOSE(better, x, *outer_x);
	*outer_y = CHOOSE(better, y, *outer_y);
}

/* x and y of the outermost point of the waterline at one u, whose row is taken; y -AFLOAT_FAR where there
 * is none. */
SHARED_FUNCTION void afloat_waterline_at(const afloat_state *s, real edge, real near, real *x,
                                         real *y)
{
	const int order = s->order[AFLOAT_V], spans = s->spans[AFLOAT_V];
	const real bound = SPREAD(LITERAL(0.5));
	*x = SPREAD(0);
	*y = SPREAD(-AFLOAT_FAR);
	ROLLED for (int n = 0; n <= spans; n++)
	{
		/* on a knot line, or as near as makes no difference */
		const int span = n < spans ? n : spans - 1, end = n - span;
		real at[4];
		ROLLED for (int c = 0; c < 4; c++)
			at[c] = afloat_at_edge(s, AFLOAT_V, span, end, s->row + c, 8);
		const real over = at[2] / at[3] - edge;
		afloat_take_outer(afloat_size(over) <= near, at[0] / at[3], at[1] / at[3], x, y);
		if (n == spans)
			break;
		real low, high, cuts[AFLOAT_ROOTS];
		afloat_heights(s, AFLOAT_V, span, edge, &low, &high);
		const mask cut = (low <= SPREAD(0)) & (high > SPREAD(0));
		if (!ANY(cut))
			continue;
		const afloat_polynomial height = afloat_height_of(s, AFLOAT_V, span, edge);
		const afloat_polynomial of_x = afloat_of_row(s, AFLOAT_V, span, s->row, 8);
		const afloat_polynomial of_y = afloat_of_row(s, AFLOAT_V, span, s->row + 1, 8);
		const afloat_polynomial of_w = afloat_of_row(s, AFLOAT_V, span, s->row + 3, 8);
		afloat_clear(cuts, AFLOAT_ROOTS);
		afloat_roots(order, &height, -bound, bound, cut, cuts, AFLOAT_ROOTS);
		ROLLED for (int k = 0; k < AFLOAT_ROOTS; k++)
		{
			const mask there = cuts[k] <= bound;
			if (!ANY(there))
				break;
			const real root = CHOOSE(there, cuts[k], bound);
			const real w = afloat_value(order, &of_w, root);
			afloat_take_outer(there, afloat_value(order, &of_x, root) / w,
			                  afloat_value(order, &of_y, root) / w, x, y);
		}
	}
}

/* The waterline at the breaks of a span and at places between. */
SHARED_FUNCTION void afloat_sample_waterline(const afloat_state *s, int span, real edge,
                                             const real *breaks, afloat_waterline *line)
{
	const int samples = span + 1 == s->spans[AFLOAT_U] ? AFLOAT_LINE_SAMPLES + 1
	                                                   : AFLOAT_LINE_SAMPLES;
	const real bound = SPREAD(LITERAL(0.5));
	ROLLED for (int n = 0; n < samples + AFLOAT_BREAKS; n++)
	{
		real at = bound, x, y;
		if (n < samples)
			at = SPREAD((scalar)n / AFLOAT_LINE_SAMPLES - LITERAL(0.5));
		else
			at = breaks[n - samples];
		const mask there = at <= bound;
		if (!ANY(there))
			break;
		at = CHOOSE(there, at, bound);
		afloat_take_row(s, AFLOAT_U, span, at, there);
		afloat_waterline_at(s, edge, line->near, &x, &y);
		const mask found = there & (y > SPREAD(-AFLOAT_FAR));
		line->aft = CHOOSE(found, afloat_smaller(line->aft, x), line->aft);
		line->fore = CHOOSE(found, afloat_larger(line->fore, x), line->fore);
		const mask better = found & (y > line->half_breadth);
		line->half_breadth = CHOOSE(better, y, line->half_breadth);
		line->at = CHOOSE(better, afloat_parameter(s, AFLOAT_U, span, at), line->at);
	}
}

/* Its largest half-breadth, from the largest of the samples. */
SHARED_FUNCTION void afloat_refine_waterline(const afloat_state *s, real edge,
                                             afloat_waterline *line)
{
	const scalar first = s->lines[AFLOAT_U][0], end = s->lines[AFLOAT_U][s->spans[AFLOAT_U]];
	const real step = SPREAD((end - first) / (scalar)s->spans[AFLOAT_U] / AFLOAT_LINE_SAMPLES);
	const real low = line->at - step, high = line->at + step;
	const mask there_is = line->half_breadth > SPREAD(-AFLOAT_FAR);
	ROLLED for (int span = 0; span < s->spans[AFLOAT_U]; span++)
	{
		real from, to;
		afloat_search g;
		const mask there = there_is & afloat_overlap(s, AFLOAT_U, span, low, high, &from, &to);
		if (!ANY(there))
			continue;
		afloat_search_begin(&g, from, to, SPREAD(AFLOAT_NEAR), there);
		ROLLED for (int n = 0; n < AFLOAT_TRIALS && ANY(g.active); n++)
		{
			real x, y;
			const real at = afloat_search_next(&g);
			afloat_take_row(s, AFLOAT_U, span, at, to >= from);
			afloat_waterline_at(s, edge, line->near, &x, &y);
			afloat_search_take(&g, at, y);
		}
		const mask better = there & (g.value[0] > line->half_breadth);
		line->half_breadth = CHOOSE(better, g.value[0], line->half_breadth);
	}
}

#endif
