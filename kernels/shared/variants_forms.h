/* Hydrostatics of a hull whose lines are known: sections below each draft, then what runs along the
 * ship (Letcher 9-11; host/hydrostatics/README.md). Areas, moments and half-breadths of a section are
 * linear in its half-breadths: their weights are tables, one a waterline that sections begin at. */
#ifndef BATTEN_SHARED_VARIANTS_FORMS_H
#define BATTEN_SHARED_VARIANTS_FORMS_H

#include "variants_lines.h"

/* ------------------------------------------------------------------------------------------------
 * Sections
 * --------------------------------------------------------------------------------------------- */

/* Where a section begins on the table, and the straight line from the edge of the hull up to there. */
typedef struct variants_foot {
	mask edged;
	real edge, z, y, slope;
} variants_foot;

SHARED_FUNCTION variants_foot variants_foot_of(const variants_state *s, int station)
{
	GLOBAL const scalar *z = TABLE(s, Z);
	const real first = s->first[station];
	variants_foot foot;
	foot.edge = s->edge[station];
	foot.edged = foot.edge < NONE;
	foot.z = NONE;
	foot.y = ZERO;
	ROLLED
	for (int w = 0; w < s->waterlines; w++) {
		const mask here = first == NUMBER(w);
		foot.z = CHOOSE(here, SPREAD(z[w]), foot.z);
		foot.y = CHOOSE(here, s->y[w * s->stations + station], foot.y);
	}
	foot.slope = CHOOSE(foot.edged, foot.y / (foot.z - foot.edge), ZERO);
	return foot;
}

/* Height of that line below a draft. */
SHARED_FUNCTION real variants_foot_height(variants_foot foot, scalar draft)
{
	const real top = LEAST_OF(SPREAD(draft), foot.z);
	return CHOOSE(foot.edged & (top > foot.edge), top - foot.edge, ZERO);
}

/* Sums of weights times half-breadths of a section that begins at waterline w. */
SHARED_FUNCTION real variants_weigh(const variants_state *s, GLOBAL const scalar *weights,
                                    int station, int w)
{
	real sum = ZERO;
	ROLLED
	for (int k = w; k < s->waterlines; k++)
		sum = FUSED(SPREAD(weights[k]), s->y[k * s->stations + station], sum);
	return sum;
}

/* Area of a section below draft number d, its moment and half-breadth where they are wanted. */
SHARED_FUNCTION void variants_take_area(const variants_state *s, int d, int station,
                                        variants_foot foot, int all)
{
	const int W = s->waterlines;
	GLOBAL const scalar *draft = TABLE(s, DRAFTS) + 4 * d;
	const real first = s->first[station], height = variants_foot_height(foot, draft[0]);
	real area = ZERO, moment = ZERO, breadth = ZERO;
	ROLLED
	for (int w = 0; w < W; w++) {
		const mask here = first == NUMBER(w);
		GLOBAL const scalar *weights = TABLE(s, SECTIONS) + ((d * W + w) * 3) * W;
		if (!ANY(here))
			continue;
		area = CHOOSE(here, variants_weigh(s, weights, station, w), area);
		if (all) {
			moment = CHOOSE(here, variants_weigh(s, weights + W, station, w), moment);
			breadth = CHOOSE(here, variants_weigh(s, weights + 2 * W, station, w), breadth);
		}
	}
	const real lowest = CHOOSE(foot.edged, foot.edge, foot.z);
	const real near = FUSED(SPREAD(LITERAL(-1e-9)), lowest, SPREAD(draft[3]));
	const mask wet = (first < NUMBER(W)) & (lowest <= SPREAD(draft[0]) + near);
	const real square = foot.slope * height * height;
	STATE real *part = s->parts + (d * s->stations + station) * VARIANTS_PART_COUNT;
	part[VARIANTS_PART_AREA] = CHOOSE(wet, area + square, -ONE);
	if (!all)
		return;
	const real third = SPREAD(LITERAL(0.66666666666666663));
	breadth = CHOOSE(foot.edged & (SPREAD(draft[0]) < foot.z), foot.slope * height, breadth);
	part[VARIANTS_PART_MOMENT] = CHOOSE(wet, moment + square * FUSED(third, height, foot.edge),
	                                    ZERO);
	part[VARIANTS_PART_BREADTH] = CHOOSE(wet, MOST_OF(breadth, ZERO), ZERO);
}

/* Second derivatives of a section's spline through value[k], begun at waterline w, into bend. */
SHARED_FUNCTION void variants_section_bend(const variants_state *s, int w, STATE const real *value,
                                           STATE real *bend)
{
	const int W = s->waterlines, count = W - w;
	GLOBAL const scalar *step = TABLE(s, Z) + W;
	GLOBAL const scalar *rows = TABLE(s, BENDS) + 4 * w * W;
	real right = ZERO, after = ZERO, chord = ZERO;
	ROLLED
	for (int k = w; k < W; k++)
		bend[k] = ZERO;
	if (count < 3)
		return;
	chord = (value[w + 1] - value[w]) * SPREAD(step[w]);
	ROLLED
	for (int k = w + 1; k + 1 < W; k++) {
		const real next = (value[k + 1] - value[k]) * SPREAD(step[k]);
		right = FUSED(SPREAD(-rows[W + k]), right, (next - chord) * SPREAD(rows[k]));
		bend[k] = right;
		chord = next;
	}
	ROLLED
	for (int k = W - 2; k > w; k--) {
		after = FUSED(SPREAD(-rows[2 * W + k]), after, bend[k]) * SPREAD(rows[3 * W + k]);
		bend[k] = after;
	}
	bend[w] = bend[w + 1];
	bend[W - 1] = bend[W - 2];
	if (count == 3)
		return;
	bend[w] -= (bend[w + 2] - bend[w + 1]) * SPREAD(step[w + 1] / step[w]);
	bend[W - 1] += (bend[W - 2] - bend[W - 3]) * SPREAD(step[W - 3] / step[W - 2]);
}

/* The slopes y_x of a section: a node without one takes the next one's, upwards first. */
SHARED_FUNCTION void variants_take_slopes(const variants_state *s, int station, STATE real *slope)
{
	const real first = s->first[station];
	real other = NONE;
	ROLLED
	for (int k = s->waterlines - 1; k >= 0; k--) {
		const real here = s->bend[k * s->stations + station];
		other = CHOOSE(here < NONE, here, other);
		slope[k] = other;
	}
	other = ZERO;
	ROLLED
	for (int k = 0; k < s->waterlines; k++) {
		other = CHOOSE((slope[k] < NONE) & (NUMBER(k) >= first), slope[k], other);
		slope[k] = CHOOSE(NUMBER(k) >= first, other, ZERO);
	}
}

/* Integral of sqrt(1 + y_x^2 + y_z^2) over a part of an interval, by the Gauss points of a rule. */
SHARED_FUNCTION real variants_arc(GLOBAL const scalar *rule, scalar width, const real y[2],
                                  const real bend[2], const real p[2], const real turn[2])
{
	const real h = SPREAD(width), rise = y[1] - y[0];
	const real m0 = h * h * bend[0], m1 = h * h * bend[1];
	const real t0 = h * h * turn[0], t1 = h * h * turn[1];
	const real step = SPREAD(LITERAL(1.0) / width);
	real sum = ZERO;
	ROLLED
	for (int g = 0; g < 5; g++, rule += 7) {
		const real along = FUSED(SPREAD(rule[0]), p[0], SPREAD(rule[1]) * p[1]) -
		                   FUSED(SPREAD(rule[2]), t0, SPREAD(rule[3]) * t1);
		const real up = step * (rise + FUSED(SPREAD(rule[4]), m0, SPREAD(rule[5]) * m1));
		sum = FUSED(SPREAD(rule[6]), SQUARE_ROOT(FUSED(along, along, FUSED(up, up, ONE))), sum);
	}
	return h * sum;
}

/* Girths of a section below every draft, both sides. */
SHARED_FUNCTION void variants_take_girths(const variants_state *s, int station, variants_foot foot)
{
	const int W = s->waterlines;
	const real first = s->first[station];
	const variants_line line = variants_room(s);
	GLOBAL const scalar *z = TABLE(s, Z);
	STATE real *parts = s->parts + station * VARIANTS_PART_COUNT + VARIANTS_PART_GIRTH;
	const int stride = s->stations * VARIANTS_PART_COUNT;
	real foot_slope = ZERO;
	/* at: y; value: y_x; bend, pivot: their second derivatives */
	variants_take_slopes(s, station, line.value);
	ROLLED
	for (int k = 0; k < W; k++) {
		line.at[k] = CHOOSE(NUMBER(k) >= first, s->y[k * s->stations + station], ZERO);
		foot_slope = CHOOSE(first == NUMBER(k), line.value[k], foot_slope);
		line.bend[k] = line.pivot[k] = ZERO;
	}
	ROLLED
	for (int w = 0; w < W; w++) {
		const mask here = first == NUMBER(w);
		if (!ANY(here))
			continue;
		for (int both = 0; both < 2; both++) {
			STATE real *into = both ? line.pivot : line.bend;
			variants_section_bend(s, w, both ? line.value : line.at, line.step);
			ROLLED
			for (int k = w; k < W; k++)
				into[k] = CHOOSE(here, line.step[k], into[k]);
		}
	}
	ROLLED
	for (int d = 0; d < s->drafts; d++) {
		const real height = variants_foot_height(foot, TABLE(s, DRAFTS)[4 * d]);
		const real along = FUSED(foot_slope, foot_slope, FUSED(foot.slope, foot.slope, ONE));
		parts[d * stride] = CHOOSE(foot.edged, height * SQUARE_ROOT(along), foot.y);
	}
	ROLLED
	for (int k = 0; k + 1 < W; k++) {
		const mask here = NUMBER(k) >= first;
		const real y[2] = { line.at[k], line.at[k + 1] };
		const real bend[2] = { line.bend[k], line.bend[k + 1] };
		const real p[2] = { line.value[k], line.value[k + 1] };
		const real turn[2] = { line.pivot[k], line.pivot[k + 1] };
		if (!ANY(here))
			continue;
		real whole = ZERO;
		/* the last turn is that of the whole interval */
		ROLLED
		for (int d = s->drafts - 1; d >= -1; d--) {
			const scalar draft = d < 0 ? z[k + 1] : TABLE(s, DRAFTS)[4 * d];
			if (d >= 0 && (draft <= z[k] || draft >= z[k + 1]))
				continue;
			const real arc = variants_arc(TABLE(s, RULES) + 35 * (d + 1), z[k + 1] - z[k], y, bend,
			                              p, turn);
			if (d < 0)
				whole = arc;
			else
				parts[d * stride] += CHOOSE(here, arc, ZERO);
		}
		ROLLED
		for (int d = 0; d < s->drafts; d++)
			if (TABLE(s, DRAFTS)[4 * d] >= z[k + 1])
				parts[d * stride] += CHOOSE(here, whole, ZERO);
	}
	ROLLED
	for (int d = 0; d < s->drafts; d++)
		parts[d * stride] = CHOOSE(parts[d * stride - VARIANTS_PART_GIRTH] >= ZERO,
		                           NUMBER(2) * parts[d * stride], ZERO);
}

#endif
