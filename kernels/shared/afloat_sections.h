/* Sections of a surface below a draft: their areas, that amidships and the largest. */
#ifndef BATTEN_SHARED_AFLOAT_SECTIONS_H
#define BATTEN_SHARED_AFLOAT_SECTIONS_H

#include "afloat_waterline.h"

/* Parts the hull is looked through in for its largest section; how near that is found, in lengths. */
#define AFLOAT_PARTS 16
#define AFLOAT_NEAR_SECTION LITERAL(1e-6)

/* A section: where, the draft, which end is nearer, the spans of u that it may cross, from and to, and the
 * span of v at work. */
typedef struct afloat_section {
	real x, edge;
	mask aft;
	int from, to, span;
} afloat_section;

/* A point of a section at a place along v: height over the draft, half-breadth, the rise of z along v. */
typedef struct afloat_station {
	real over, y, rise;
} afloat_station;

/* Writes how far the line of v, whose basis is given, lies before the section: its poles. */
SHARED_FUNCTION void afloat_take_distances(const afloat_state *s, const afloat_section *section,
                                           const real *along)
{
	const int dimension = s->dimension, across = dimension * s->count[AFLOAT_U];
	const int first = s->first[AFLOAT_U][section->from];
	const int beyond = s->first[AFLOAT_U][section->to] + s->order[AFLOAT_U];
	GLOBAL const real *pole = s->poles + s->first[AFLOAT_V][section->span] * across +
	                          first * dimension;
	ROLLED for (int n = first; n < beyond; n++, pole += dimension)
	{
		real x = SPREAD(0), w = dimension == 4 ? SPREAD(0) : SPREAD(1);
		ROLLED for (int k = 0; k < s->order[AFLOAT_V]; k++)
		{
			x = FUSED(along[k], pole[k * across], x);
			if (dimension == 4)
				w = FUSED(along[k], pole[k * across + 3], w);
		}
		s->row[n] = x - section->x * w;
	}
}

/* The span of u in which these distances change their sign; where they do not, the nearer end's, and
 * reached is false. Only spans whose poles lie on both sides can be crossed: the others are left out of
 * every lane by itself, so that it does not matter which the lanes beside it look through. */
SHARED_FUNCTION real afloat_crossed_span(const afloat_state *s, const afloat_section *section,
                                         mask *reached)
{
	const STATE real *bands = s->bands[AFLOAT_U];
	real where = SPREAD(-1), before = afloat_at_edge(s, AFLOAT_U, section->from, 0, s->row, 1);
	ROLLED for (int span = section->from; span <= section->to; span++)
	{
		const real after = afloat_at_edge(s, AFLOAT_U, span, 1, s->row, 1);
		const mask crosses = (where < SPREAD(0)) & (bands[2 * span] <= section->x) &
		                     (bands[2 * span + 1] >= section->x) &
		                     ((before > SPREAD(0)) != (after > SPREAD(0)));
		where = CHOOSE(crosses, SPREAD((scalar)span), where);
		before = after;
	}
	*reached = where >= SPREAD(0);
	const real last = SPREAD((scalar)(s->spans[AFLOAT_U] - 1));
	return CHOOSE(*reached, where, CHOOSE(section->aft, SPREAD(0), last));
}

/* The point at s of a span of u, on the line of v whose basis is given. */
SHARED_FUNCTION afloat_point afloat_point_on(const afloat_state *s, const afloat_section *section,
                                             int span, real at, const real *along,
                                             const real *along_by)
{
	const int dimension = s->dimension, across = dimension * s->count[AFLOAT_U];
	GLOBAL const real *pole = s->poles + s->first[AFLOAT_V][section->span] * across +
	                          s->first[AFLOAT_U][span] * dimension;
	real value[AFLOAT_ORDER_MOST], slope[AFLOAT_ORDER_MOST], p[4], by_u[4], by_v[4];
	afloat_point point;
	afloat_basis(s, AFLOAT_U, span, at, value, slope);
	ROLLED for (int c = 0; c < dimension; c++)
	{
		p[c] = by_u[c] = by_v[c] = SPREAD(0);
		ROLLED for (int k = 0; k < s->order[AFLOAT_U]; k++)
		{
			real here = SPREAD(0), by = SPREAD(0);
			ROLLED for (int n = 0; n < s->order[AFLOAT_V]; n++)
			{
				const real from = pole[n * across + k * dimension + c];
				here = FUSED(along[n], from, here);
				by = FUSED(along_by[n], from, by);
			}
			p[c] = FUSED(value[k], here, p[c]);
			by_u[c] = FUSED(slope[k], here, by_u[c]);
			by_v[c] = FUSED(value[k], by, by_v[c]);
		}
	}
	ROLLED for (int c = 0; c < 3; c++)
	{
		if (dimension == 4) {
			p[c] = p[c] / p[3];
			by_u[c] = (by_u[c] - p[c] * by_u[3]) / p[3];
			by_v[c] = (by_v[c] - p[c] * by_v[3]) / p[3];
		}
		point.p[c] = p[c];
		point.by_u[c] = by_u[c];
		point.by_v[c] = by_v[c];
	}
	return point;
}

SHARED_FUNCTION afloat_station afloat_station_at(const afloat_state *s,
                                                 const afloat_section *section, real v)
{
	const real bound = SPREAD(LITERAL(0.5)), nought = SPREAD(0);
	const int order = s->order[AFLOAT_U];
	const real end = CHOOSE(section->aft, -bound, bound);
	real along[AFLOAT_ORDER_MOST], along_by[AFLOAT_ORDER_MOST];
	mask reached;
	afloat_station station = { nought, nought, nought };
	afloat_basis(s, AFLOAT_V, section->span, v, along, along_by);
	afloat_take_distances(s, section, along);
	const real where = afloat_crossed_span(s, section, &reached);
	ROLLED for (int span = 0; span < s->spans[AFLOAT_U]; span++)
	{
		const mask here = where == SPREAD((scalar)span);
		if (!ANY(here))
			continue;
		real root = end;
		if (ANY(here & reached)) {
			const afloat_polynomial p = afloat_of_row(s, AFLOAT_U, span, s->row, 1);
			root = afloat_root_between(order, &p, -bound, afloat_value(order, &p, -bound), bound,
			                           afloat_value(order, &p, bound), here & reached);
		}
		const afloat_point q = afloat_point_on(s, section, span, CHOOSE(reached, root, end), along,
		                                       along_by);
		const mask leans = q.by_u[0] != nought;
		const real lean = q.by_v[0] / CHOOSE(leans, q.by_u[0], SPREAD(1));
		const real rise = q.by_v[2] - CHOOSE(leans, q.by_u[2] * lean, nought);
		station.over = CHOOSE(here, q.p[2] - section->edge, station.over);
		station.y = CHOOSE(here, q.p[1], station.y);
		station.rise = CHOOSE(here, rise, station.rise);
	}
	return station;
}

/* Where a section between a, where it is fa over the draft, and b, where it is fb of the other sign, meets
 * the draft, in the lanes of where: false position, the end that stays halved (Illinois), by bisection where
 * that is slow. */
SHARED_FUNCTION real afloat_section_root(const afloat_state *s, const afloat_section *section,
                                         real a, real fa, real b, real fb, mask where)
{
	const real bound = SPREAD(LITERAL(0.5));
	real side = SPREAD(0);
	mask active = where;
	ROLLED for (int turn = 0; turn < 120 && ANY(active); turn++)
	{
		const real middle = bound * (a + b);
		real t = b - fb * (b - a) / (fb - fa);
		const real low = afloat_smaller(a, b), high = afloat_larger(a, b);
		const mask within = (t > low) & (t < high);
		t = turn % 4 == 3 ? middle : CHOOSE(within, t, middle);
		const real f = afloat_station_at(s, section, t).over;
		const mask found = active & (f == SPREAD(0));
		const mask later = active & ((f > SPREAD(0)) == (fb > SPREAD(0)));
		const mask sooner = active & ((f > SPREAD(0)) != (fb > SPREAD(0)));
		const real fa_kept = CHOOSE(side > SPREAD(0), bound * fa, fa);
		const real fb_kept = CHOOSE(side < SPREAD(0), bound * fb, fb);
		fa = CHOOSE(later, fa_kept, CHOOSE(sooner, f, fa));
		fb = CHOOSE(sooner, fb_kept, CHOOSE(later, f, fb));
		a = CHOOSE(sooner | found, t, a);
		b = CHOOSE(later | found, t, b);
		side = CHOOSE(later, SPREAD(1), CHOOSE(sooner, SPREAD(-1), side));
		active = active & (afloat_size(b - a) > SPREAD(LITERAL(2e-16)));
	}
	return bound * (a + b);
}

#define AFLOAT_VALUE(t) afloat_station_at(s, section, t).over
#define AFLOAT_BETWEEN(a, fa, b, fb, where) afloat_section_root(s, section, a, fa, b, fb, where)
#define AFLOAT_SUBJECT const afloat_state *s, const afloat_section *section
AFLOAT_ROOTS_OF(afloat_section_roots, AFLOAT_SUBJECT, AFLOAT_VALUE, AFLOAT_BETWEEN)
#undef AFLOAT_SUBJECT
#undef AFLOAT_BETWEEN
#undef AFLOAT_VALUE

/* How far an end of the surface lies before the section, along v. */
SHARED_FUNCTION afloat_polynomial afloat_end_of(const afloat_state *s,
                                                const afloat_section *section, int end)
{
	const int dimension = s->dimension, across = dimension * s->count[AFLOAT_U];
	const int span = end ? s->spans[AFLOAT_U] - 1 : 0;
	GLOBAL const scalar *edge = s->edges[AFLOAT_U] + (2 * span + end) * s->order[AFLOAT_U];
	GLOBAL const real *pole = s->poles + s->first[AFLOAT_U][span] * dimension;
	ROLLED for (int n = 0; n < s->count[AFLOAT_V]; n++, pole += across)
	{
		real x = SPREAD(0), w = dimension == 4 ? SPREAD(0) : SPREAD(1);
		ROLLED for (int k = 0; k < s->order[AFLOAT_U]; k++)
		{
			x = FUSED(SPREAD(edge[k]), pole[k * dimension], x);
			if (dimension == 4)
				w = FUSED(SPREAD(edge[k]), pole[k * dimension + 3], w);
		}
		s->row[n] = x - section->x * w;
	}
	return afloat_of_row(s, AFLOAT_V, section->span, s->row, 1);
}

/* integral y dz of the section between two places of a span, cut at the draft in the lanes of cut, all of
 * it below in the others. */
SHARED_FUNCTION real afloat_section_part(const afloat_state *s, const afloat_section *section,
                                         real from, real to, mask there, mask cut)
{
	const real bound = SPREAD(LITERAL(0.5)), nought = SPREAD(0);
	real cuts[AFLOAT_ROOTS], sum = nought;
	afloat_clear(cuts, AFLOAT_ROOTS);
	if (ANY(there & cut))
		afloat_section_roots(s, section, from, to, there & cut, cuts, AFLOAT_ROOTS);
	ROLLED for (int n = 0; n <= AFLOAT_ROOTS; n++)
	{
		const real end = n < AFLOAT_ROOTS ? afloat_smaller(cuts[n], to) : to;
		mask wet = there & (end > from);
		if (ANY(wet & cut)) {
			const real over = afloat_station_at(s, section, bound * (from + end)).over;
			wet = wet & (over <= CHOOSE(cut, nought, SPREAD(AFLOAT_FAR)));
		}
		const real wide = CHOOSE(wet, end - from, nought);
		ROLLED for (int k = 0; k < s->points && ANY(wet); k++)
		{
			const afloat_station q = afloat_station_at(s, section,
			                                           FUSED(wide, SPREAD(s->rule[k]), from));
			sum += wide * SPREAD(s->rule[s->points + k]) * (q.y * q.rise);
		}
		from = end;
		if (!ANY(there & (from < to)))
			break;
	}
	return sum;
}

/* Bounds of the poles of each span: of x along u, of z along v. */
SHARED_FUNCTION void afloat_take_bands(const afloat_state *s, int d)
{
	const int dimension = s->dimension, other = 1 - d, count_u = s->count[AFLOAT_U];
	const int step = d == AFLOAT_U ? dimension : dimension * count_u;
	const int across = d == AFLOAT_U ? dimension * count_u : dimension;
	const int coordinate = d == AFLOAT_U ? 0 : 2;
	ROLLED for (int span = 0; span < s->spans[d]; span++)
	{
		real low = SPREAD(AFLOAT_FAR), high = SPREAD(-AFLOAT_FAR);
		ROLLED for (int k = 0; k < s->order[d]; k++)
		{
			GLOBAL const real *pole = s->poles + (s->first[d][span] + k) * step;
			ROLLED for (int n = 0; n < s->count[other]; n++, pole += across)
			{
				const real at = dimension == 4 ? pole[coordinate] / pole[3] : pole[coordinate];
				low = afloat_smaller(low, at);
				high = afloat_larger(high, at);
			}
		}
		s->bands[d][2 * span] = low;
		s->bands[d][2 * span + 1] = high;
	}
}

/* A section at x, with the spans of u that any lane may cross. */
SHARED_FUNCTION afloat_section afloat_section_at(const afloat_state *s, const real *extents, real x,
                                                 real edge)
{
	const STATE real *bands = s->bands[AFLOAT_U];
	const real middle = SPREAD(LITERAL(0.5)) * (extents[AFLOAT_AFTMOST] + extents[AFLOAT_FOREMOST]);
	afloat_section section = { x, edge, x < middle, s->spans[AFLOAT_U] - 1, 0, 0 };
	ROLLED for (int span = 0; span < s->spans[AFLOAT_U]; span++)
	{
		const mask may = (bands[2 * span] <= x) & (bands[2 * span + 1] >= x);
		if (!ANY(may))
			continue;
		section.from = span < section.from ? span : section.from;
		section.to = span;
	}
	if (section.to < section.from)
		section.to = section.from;
	return section;
}

/* Area of the section below the draft, both sides; 0 where there is none. */
SHARED_FUNCTION real afloat_section_area(const afloat_state *s, afloat_section section)
{
	const STATE real *bands = s->bands[AFLOAT_V];
	const int order = s->order[AFLOAT_V];
	const real bound = SPREAD(LITERAL(0.5)), nought = SPREAD(0);
	real sum = nought;
	ROLLED for (int span = 0; span < s->spans[AFLOAT_V]; span++)
	{
		const mask wet_at_all = bands[2 * span] <= section.edge,
				   cut = bands[2 * span + 1] > section.edge;
		section.span = span;
		if (!ANY(wet_at_all))
			continue;
		/* where the ends of the surface pass the station */
		real passes[AFLOAT_ROOTS];
		const afloat_polynomial aft = afloat_end_of(s, &section, 0);
		const afloat_polynomial fore = afloat_end_of(s, &section, 1);
		afloat_clear(passes, AFLOAT_ROOTS);
		ROLLED for (int end = 0; end < 2; end++)
		{
			const afloat_polynomial p = end ? fore : aft;
			afloat_roots(order, &p, -bound, bound, wet_at_all, passes, AFLOAT_ROOTS);
		}
		real from = -bound;
		ROLLED for (int n = 0; n <= AFLOAT_ROOTS; n++)
		{
			const real to = n < AFLOAT_ROOTS ? afloat_smaller(passes[n], bound) : bound;
			const real middle = bound * (from + to);
			const real a = afloat_value(order, &aft, middle),
					   b = afloat_value(order, &fore, middle);
			const mask reaches = ((a > nought) != (b > nought)) | (a == nought) | (b == nought);
			const mask there = wet_at_all & reaches & (to > from);
			if (ANY(there))
				sum += afloat_section_part(s, &section, from, to, there, cut);
			from = to;
			if (!ANY(from < bound))
				break;
		}
	}
	return afloat_size(sum + sum);
}

/* Area amidships, -AFLOAT_FAR where the hull does not reach; and the largest: of parts of the hull, then
 * searched for about the largest of these. */
SHARED_FUNCTION void afloat_take_sections(const afloat_state *s, const real *extents, real edge,
                                          real *form)
{
	const real aft = extents[AFLOAT_AFTMOST], fore = extents[AFLOAT_FOREMOST];
	const real length = s->length[0] > 0 ? SPREAD(s->length[0]) : fore;
	const real amidships = SPREAD(LITERAL(0.5)) * length;
	const real step = (fore - aft) / SPREAD(AFLOAT_PARTS);
	const real near = SPREAD(AFLOAT_NEAR_SECTION) * (fore - aft);
	const mask there = (amidships >= aft) & (amidships <= fore);
	real midship = SPREAD(0), largest = SPREAD(0), at = aft;
	afloat_search g;
	afloat_search_begin(&g, aft, fore, near, step >= SPREAD(0));
	ROLLED for (int n = -1; n <= AFLOAT_PARTS + AFLOAT_TRIALS && ANY(g.active); n++)
	{
		const int trial = n > AFLOAT_PARTS;
		real x = n < 0 ? amidships : FUSED(step, SPREAD((scalar)n), aft);
		if (trial)
			x = afloat_search_next(&g);
		const afloat_section section = afloat_section_at(s, extents, x, edge);
		const real area = afloat_section_area(s, section);
		if (n < 0) {
			midship = area;
		} else if (trial) {
			afloat_search_take(&g, x, area);
		} else {
			at = CHOOSE(area > largest, x, at);
			largest = afloat_larger(largest, area);
		}
		if (n == AFLOAT_PARTS)
			afloat_search_go_on(&g, afloat_larger(aft, at - step), afloat_smaller(fore, at + step),
			                    near, step >= SPREAD(0), at, largest);
	}
	largest = g.value[0];
	form[AFLOAT_MIDSHIP] = CHOOSE(there, midship, SPREAD(-AFLOAT_FAR));
	form[AFLOAT_LARGEST] = CHOOSE(there & (midship > largest), midship, largest);
}

#endif
