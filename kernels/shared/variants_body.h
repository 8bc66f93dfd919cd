/* What runs along the ship at a draft: curves of sections and the waterline, integrated as the natural
 * splines they are (host/hydrostatics/hydrostatics.c). */
#ifndef BATTEN_SHARED_VARIANTS_BODY_H
#define BATTEN_SHARED_VARIANTS_BODY_H

#include "variants_forms.h"

/* Ends of the hull below a draft and of its waterline there; x NONE where there is none. */
typedef struct variants_tips {
	real hull_aft, hull_fore; /* profile points: half-breadth 0 */
	real aft_x, aft_y, fore_x, fore_y;
} variants_tips;

SHARED_FUNCTION variants_tips variants_tips_at(const variants_state *s, int d)
{
	GLOBAL const scalar *draft = TABLE(s, DRAFTS) + 4 * d;
	GLOBAL const scalar *z = TABLE(s, Z);
	const int line = (int)draft[1];
	const real part = SPREAD(draft[2]);
	STATE const real *a = s->ends + 4 * line;
	STATE const real *b = draft[2] > LITERAL(0.0) ? a + 4 : a;
	const mask there = (a[0] < NONE) & (b[0] < NONE);
	variants_tips tips;
	tips.aft_x = CHOOSE(there, a[0] + part * (b[0] - a[0]), NONE);
	tips.aft_y = CHOOSE(there, a[1] + part * (b[1] - a[1]), ONE);
	tips.fore_x = CHOOSE(there, a[2] + part * (b[2] - a[2]), NONE);
	tips.fore_y = CHOOSE(there, a[3] + part * (b[3] - a[3]), ONE);
	real aft = CHOOSE(tips.aft_y <= ZERO, tips.aft_x, NONE);
	real fore = CHOOSE(tips.fore_y <= ZERO, tips.fore_x, -NONE);
	ROLLED
	for (int w = 0; w < s->waterlines; w++) {
		STATE const real *ends = s->ends + 4 * w;
		if (z[w] > draft[0])
			continue;
		aft = CHOOSE(ends[1] <= ZERO, LEAST_OF(aft, ends[0]), aft);
		fore = CHOOSE((ends[3] <= ZERO) & (ends[2] < NONE), MOST_OF(fore, ends[2]), fore);
	}
	tips.hull_aft = aft;
	tips.hull_fore = CHOOSE(fore > -NONE, fore, NONE);
	return tips;
}

/* A curve through the wet stations, slots 1 .. stations, and the tips beyond them. */
typedef struct variants_span {
	real wet_first, wet_last; /* slots */
	real first, last;         /* with the tips */
} variants_span;

/* Places of the slots, and the rows of their spline. False where they do not ascend. */
SHARED_FUNCTION mask variants_lay(const variants_state *s, variants_line line, real aft, real fore,
                                  variants_span *span)
{
	GLOBAL const scalar *x = TABLE(s, X);
	const real near = SPREAD(TABLE(s, FORMULA)[VARIANTS_FORMULA_NEAR]);
	real first_x = ZERO, last_x = ZERO;
	ROLLED
	for (int i = 0; i < s->stations; i++) {
		first_x = CHOOSE(span->wet_first == NUMBER(i + 1), SPREAD(x[i]), first_x);
		last_x = CHOOSE(span->wet_last == NUMBER(i + 1), SPREAD(x[i]), last_x);
	}
	span->first = CHOOSE(aft < first_x - near, span->wet_first - ONE, span->wet_first);
	span->last = CHOOSE((fore < NONE) & (fore > last_x + near), span->wet_last + ONE,
	                    span->wet_last);
	ROLLED
	for (int i = 0; i < s->slots; i++) {
		const real here = NUMBER(i);
		const real at = SPREAD(x[i == 0 ? 0 : i <= s->stations ? i - 1 : s->stations - 1]);
		line.at[i] = CHOOSE(here < span->wet_first, aft, CHOOSE(here > span->wet_last, fore, at));
	}
	return variants_natural(line, s->slots, span->first, span->last);
}

/* Zeroth, first and second moment of the spline along the ship. */
SHARED_FUNCTION void variants_integrate(const variants_state *s, variants_line line,
                                        variants_span span, real sums[3])
{
	const real c24 = SPREAD(LITERAL(0.041666666666666664));
	const real c360 = SPREAD(LITERAL(0.0027777777777777779));
	sums[0] = sums[1] = sums[2] = ZERO;
	ROLLED
	for (int i = 0; i + 1 < s->slots; i++) {
		const mask runs = (NUMBER(i) >= span.first) & (NUMBER(i) < span.last);
		const real x = CHOOSE(runs, line.at[i], ZERO);
		const real h = CHOOSE(runs, line.at[i + 1] - line.at[i], ZERO), hh = h * h;
		const real y0 = line.value[i], y1 = line.value[i + 1];
		const real m0 = line.bend[i], m1 = line.bend[i + 1];
		const real area = h * FUSED(SPREAD(LITERAL(0.5)), y0 + y1, -(hh * c24) * (m0 + m1));
		const real first = hh * FUSED(SPREAD(LITERAL(0.16666666666666666)),
		                              FUSED(y1, NUMBER(2), y0),
		                              -(hh * c360) * FUSED(NUMBER(7), m0, NUMBER(8) * m1));
		const real second = hh * h *
		                    FUSED(SPREAD(LITERAL(0.083333333333333329)), FUSED(y1, NUMBER(3), y0),
		                          -(hh * c360) * FUSED(NUMBER(4), m0, NUMBER(5) * m1));
		sums[0] += area;
		sums[1] += FUSED(x, area, first);
		sums[2] += FUSED(x * x, area, FUSED(NUMBER(2) * x, first, second));
	}
}

/* Integral of the cube of the spline, five Gauss points an interval. */
SHARED_FUNCTION real variants_integrate_cube(const variants_state *s, variants_line line,
                                             variants_span span)
{
	real sum = ZERO;
	ROLLED
	for (int i = 0; i + 1 < s->slots; i++) {
		const mask runs = (NUMBER(i) >= span.first) & (NUMBER(i) < span.last);
		const real h = CHOOSE(runs, line.at[i + 1] - line.at[i], ZERO), hh = h * h;
		const real y0 = line.value[i], y1 = line.value[i + 1];
		const real m0 = hh * line.bend[i], m1 = hh * line.bend[i + 1];
		GLOBAL const scalar *rule = TABLE(s, RULES);
		real cubes = ZERO;
		ROLLED
		for (int g = 0; g < 5; g++, rule += 7) {
			const real y = FUSED(SPREAD(rule[0]), y0, SPREAD(rule[1]) * y1) -
			               FUSED(SPREAD(rule[2]), m0, SPREAD(rule[3]) * m1);
			cubes = FUSED(SPREAD(rule[6]), y * y * y, cubes);
		}
		sum = FUSED(h, cubes, sum);
	}
	return sum;
}

/* The spline at a place; NONE beyond its ends. */
SHARED_FUNCTION real variants_value_at(const variants_state *s, variants_line line,
                                       variants_span span, scalar place)
{
	const real x = SPREAD(place);
	real value = NONE;
	ROLLED
	for (int i = 0; i + 1 < s->slots; i++) {
		const mask runs = (NUMBER(i) >= span.first) & (NUMBER(i) < span.last);
		const mask here = runs & (line.at[i] <= x) & (x <= line.at[i + 1]);
		if (ANY(here))
			value = CHOOSE(here,
			               variants_cubic((x - line.at[i]) * line.step[i],
			                              line.at[i + 1] - line.at[i], line.value[i],
			                              line.value[i + 1], line.bend[i], line.bend[i + 1]),
			               value);
	}
	return value;
}

/* Values of a part of the stations in the slots of the wet ones; tips are 0. */
SHARED_FUNCTION void variants_take_values(const variants_state *s, int d, int part,
                                          variants_line line, variants_span span)
{
	STATE const real *parts = s->parts + d * s->stations * VARIANTS_PART_COUNT + part;
	ROLLED
	for (int i = 0; i < s->slots; i++) {
		const mask wet = (NUMBER(i) >= span.wet_first) & (NUMBER(i) <= span.wet_last);
		const int station = i == 0 ? 0 : i <= s->stations ? i - 1 : s->stations - 1;
		const real value = parts[station * VARIANTS_PART_COUNT];
		/* a dry section between wet ones has no area */
		line.value[i] = CHOOSE(wet, part == VARIANTS_PART_AREA ? MOST_OF(value, ZERO) : value,
		                       ZERO);
	}
	variants_natural_bend(line, s->slots, line.value, line.bend);
}

SHARED_FUNCTION void variants_take_plane(const variants_state *s, int d, variants_line line,
                                         variants_span span, variants_tips tips, STATE real *out)
{
	real sums[3], breadth = ZERO, length = ZERO;
	variants_take_values(s, d, VARIANTS_PART_BREADTH, line, span);
	ROLLED
	for (int i = 0; i < s->slots; i++) {
		const real here = NUMBER(i);
		real y = line.value[i];
		y = CHOOSE((here < span.wet_first) & (here >= span.first), tips.aft_y, y);
		y = CHOOSE((here > span.wet_last) & (here <= span.last), tips.fore_y, y);
		line.value[i] = y;
		breadth = MOST_OF(breadth, y);
		length = CHOOSE(here == span.first, length - line.at[i], length);
		length = CHOOSE(here == span.last, length + line.at[i], length);
	}
	variants_natural_bend(line, s->slots, line.value, line.bend);
	variants_integrate(s, line, span, sums);
	out[VARIANTS_WATERLINE_LENGTH] = length;
	out[VARIANTS_WATERLINE_BREADTH] = breadth;
	out[VARIANTS_PLANE_AREA] = NUMBER(2) * sums[0];
	out[VARIANTS_PLANE_MOMENT] = NUMBER(2) * sums[1];
	out[VARIANTS_PLANE_LONGITUDINAL] = NUMBER(2) * sums[2];
	out[VARIANTS_PLANE_TRANSVERSE] = SPREAD(LITERAL(0.66666666666666663)) *
	                                 variants_integrate_cube(s, line, span);
}

/* The hull at draft number d; all: everything, else volume, its moment along the ship and the section
 * amidships. out [VARIANTS_FORM_COUNT]. */
SHARED_FUNCTION void variants_take_body(const variants_state *s, int d, int all, STATE real *out)
{
	const variants_line line = variants_room(s);
	const variants_tips tips = variants_tips_at(s, d);
	STATE const real *parts = s->parts + d * s->stations * VARIANTS_PART_COUNT;
	variants_span span = { NUMBER(s->slots), -ONE, ZERO, ZERO };
	real sums[3], dry = -ONE, gap = ZERO, largest = ZERO, transom = ZERO;
	ROLLED
	for (int i = 0; i < s->stations; i++) {
		const real here = NUMBER(i + 1), area = parts[i * VARIANTS_PART_COUNT];
		const mask wet = area >= ZERO;
		gap = CHOOSE(wet & (dry > span.wet_first), ONE, gap);
		dry = CHOOSE(wet, dry, here);
		span.wet_first = CHOOSE(wet, LEAST_OF(span.wet_first, here), span.wet_first);
		span.wet_last = CHOOSE(wet, here, span.wet_last);
		largest = MOST_OF(largest, area);
	}
	mask good = variants_lay(s, line, tips.hull_aft, tips.hull_fore, &span) &
	            (span.wet_last > ZERO);
	variants_take_values(s, d, VARIANTS_PART_AREA, line, span);
	variants_integrate(s, line, span, sums);
	out[VARIANTS_VOLUME] = sums[0];
	out[VARIANTS_MOMENT_X] = sums[1];
	out[VARIANTS_MIDSHIP] = variants_value_at(s, line, span,
	                                          TABLE(s, FORMULA)[VARIANTS_FORMULA_AMIDSHIPS]);
	if (all) {
		ROLLED
		for (int i = 0; i < s->slots; i++) {
			transom += CHOOSE(NUMBER(i) == span.first, line.value[i], ZERO);
			transom += CHOOSE((NUMBER(i) == span.last) & (span.last > span.first), line.value[i],
			                  ZERO);
		}
		out[VARIANTS_LARGEST] = largest;
		out[VARIANTS_TRANSOM] = transom;
		variants_take_values(s, d, VARIANTS_PART_MOMENT, line, span);
		variants_integrate(s, line, span, sums);
		out[VARIANTS_MOMENT_Z] = sums[0];
		variants_take_values(s, d, VARIANTS_PART_GIRTH, line, span);
		variants_integrate(s, line, span, sums);
		out[VARIANTS_WETTED] = sums[0];
		good = good & variants_lay(s, line, tips.aft_x, tips.fore_x, &span);
		variants_take_plane(s, d, line, span, tips, out);
	}
	s->bad[s->waterlines + s->stations + d] = CHOOSE(good & (gap == ZERO), ZERO, ONE);
}

#endif
