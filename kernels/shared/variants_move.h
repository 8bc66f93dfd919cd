/* A parent's sections moved along the ship and its waterlines taken at the stations again: what
 * host/variation does with one hull (thesis 2.3.1-2.3.3, Lackenby 1950). */
#ifndef BATTEN_SHARED_VARIANTS_MOVE_H
#define BATTEN_SHARED_VARIANTS_MOVE_H

#include "variants_lines.h"

/* dx = (1 - x)(level + linear (x - p)) of each half; where the section amidships stands after it. */
typedef struct variants_shift {
	real level[2], linear[2]; /* aft, fore */
	real body_from, body_to;
	real last;      /* slot of the last moved point */
	mask body, two; /* the parallel body has points: its two ends, or one */
	mask good;      /* no sections change places */
} variants_shift;

/* ------------------------------------------------------------------------------------------------
 * The formulas
 * --------------------------------------------------------------------------------------------- */

SHARED_FUNCTION variants_shift variants_swing(const variants_state *s, real centre)
{
	GLOBAL const scalar *formula = TABLE(s, FORMULA);
	const real factor = centre * SPREAD(formula[VARIANTS_FORMULA_SWING]);
	variants_shift shift;
	shift.level[0] = shift.level[1] = factor;
	shift.linear[0] = shift.linear[1] = ZERO;
	shift.body_from = shift.body_to = ZERO;
	shift.body = shift.two = ZERO > ZERO;
	shift.good = (FUSED(factor, SPREAD(formula[VARIANTS_FORMULA_SLOPE_LEAST]), ONE) > ZERO) &
	             (FUSED(factor, SPREAD(formula[VARIANTS_FORMULA_SLOPE_MOST]), ONE) > ZERO);
	return shift;
}

/* One half: its change of fullness and of its parallel body made a shift; where the body then ends. */
SHARED_FUNCTION real variants_half(GLOBAL const scalar *numbers, real fuller, real body, int side,
                                   variants_shift *shift)
{
	const real room = ONE - SPREAD(numbers[VARIANTS_HALF_PARALLEL]);
	const real level = FUSED(SPREAD(numbers[VARIANTS_HALF_BY_FULLNESS]), fuller,
	                         SPREAD(numbers[VARIANTS_HALF_BY_BODY]) * body);
	const real rest = ONE - SPREAD(numbers[VARIANTS_HALF_FULLNESS]);
	const real linear = SPREAD(numbers[VARIANTS_HALF_LINEAR]) * FUSED(-level, rest, fuller);
	shift->level[side] = level;
	shift->linear[side] = linear;
	/* the derivative is linear: its ends tell whether it folds */
	shift->good = shift->good & (ONE - level + linear * room > ZERO) &
	              (ONE - level - linear * room > ZERO);
	return FUSED(room, level, SPREAD(numbers[VARIANTS_HALF_PARALLEL])) *
	       SPREAD(numbers[VARIANTS_HALF_LENGTH]);
}

SHARED_FUNCTION variants_shift variants_halves(const variants_state *s, real fullness, real centre,
                                               real body_aft, real body_fore)
{
	GLOBAL const scalar *formula = TABLE(s, FORMULA);
	GLOBAL const scalar *aft = formula + VARIANTS_FORMULA_AFT;
	GLOBAL const scalar *fore = formula + VARIANTS_FORMULA_FORE;
	const real full = SPREAD(formula[VARIANTS_FORMULA_FULLNESS]);
	const real own = SPREAD(formula[VARIANTS_FORMULA_CENTRE]);
	const real middle = SPREAD(formula[VARIANTS_FORMULA_MIDDLE]);
	const real least = SPREAD(formula[VARIANTS_FORMULA_LEAST_BODY]);
	const real b_aft = SPREAD(aft[VARIANTS_HALF_LEVER]), b_fore = SPREAD(fore[VARIANTS_HALF_LEVER]);
	const real more = full * fullness / NUMBER(100);
	const real moment = centre / NUMBER(50) * (full + more);
	const real parallel = FUSED(SPREAD(fore[VARIANTS_HALF_BODY_LEVER]), body_fore,
	                            -(SPREAD(aft[VARIANTS_HALF_BODY_LEVER]) * body_aft));
	const real both = b_fore + b_aft;
	const real fuller_fore = (NUMBER(2) * FUSED(more, b_aft + own, moment) + parallel) / both;
	const real fuller_aft = (NUMBER(2) * FUSED(more, b_fore - own, -moment) - parallel) / both;
	variants_shift shift;
	shift.good = ONE > ZERO;
	shift.body_from = middle - variants_half(aft, fuller_aft, body_aft, 0, &shift);
	shift.body_to = middle + variants_half(fore, fuller_fore, body_fore, 1, &shift);
	const real length = shift.body_to - shift.body_from;
	const mask always = SPREAD(formula[VARIANTS_FORMULA_ALWAYS_BODY]) > ZERO;
	shift.good = shift.good & (length >= -least);
	shift.body = always | (length > least) | (length < -least);
	shift.two = shift.body & (length > least);
	return shift;
}

/* ------------------------------------------------------------------------------------------------
 * The move
 * --------------------------------------------------------------------------------------------- */

SHARED_FUNCTION variants_line variants_moved_line(const variants_state *s)
{
	return variants_line_in(s->moved, s->slots);
}

SHARED_FUNCTION int variants_station(const variants_state *s, int number)
{
	return number < 0 ? 0 : number < s->stations ? number : s->stations - 1;
}

SHARED_FUNCTION real variants_moved_x(const variants_state *s, const variants_shift *shift,
                                      int number)
{
	const int station = variants_station(s, number);
	GLOBAL const scalar *by = TABLE(s, SHIFT) + 3 * station;
	const int side = by[2] > LITERAL(0.0);
	return SPREAD(TABLE(s, X)[station]) +
	       FUSED(SPREAD(by[0]), shift->level[side], SPREAD(by[1]) * shift->linear[side]);
}

/* What stands in a slot of moved points: lanes without a parallel body have the stations, others its
 * ends in place of those within it. plain, one, two: what stands there in each case. */
SHARED_FUNCTION real variants_pick(const variants_shift *shift, real plain, real one, real two)
{
	return CHOOSE(shift->two, two, CHOOSE(shift->body, one, plain));
}

SHARED_FUNCTION mask variants_move_points(const variants_state *s, variants_shift *shift)
{
	const variants_line line = variants_moved_line(s);
	const int before = s->shape[VARIANTS_BEFORE_BODY], within = s->shape[VARIANTS_WITHIN_BODY];
	const int bodies = ANY(shift->body);
	shift->last = variants_pick(shift, NUMBER(s->stations - 1), NUMBER(s->stations - within),
	                            NUMBER(s->stations - within + 1));
	ROLLED
	for (int q = 0; q < s->slots; q++) {
		const real plain = variants_moved_x(s, shift, q);
		line.at[q] = plain;
		if (!bodies || q < before)
			continue;
		const real one = q == before ? shift->body_to : variants_moved_x(s, shift, q - 1 + within);
		const real two = q == before       ? shift->body_from
		                 : q == before + 1 ? shift->body_to
		                                   : variants_moved_x(s, shift, q - 2 + within);
		line.at[q] = variants_pick(shift, plain, one, two);
	}
	return variants_natural(line, s->slots, ZERO, shift->last);
}

/* The parent's half-breadths as moved points have them, by numbers of the compiler's own: what lies in
 * memory it would read again after every store. */
typedef struct variants_source {
	GLOBAL const scalar *y, *middle;
	int stations, before, within, bodies;
} variants_source;

SHARED_FUNCTION variants_source variants_source_of(const variants_state *s,
                                                   const variants_shift *shift)
{
	const variants_source from = { TABLE(s, PARENT),
		                           TABLE(s, MIDDLE),
		                           s->stations,
		                           s->shape[VARIANTS_BEFORE_BODY],
		                           s->shape[VARIANTS_WITHIN_BODY],
		                           ANY(shift->body) };
	return from;
}

/* Half-breadth of the parent's waterline in a slot. */
SHARED_FUNCTION real variants_moved_y(variants_source from, const variants_shift *shift, int w,
                                      int q)
{
	GLOBAL const scalar *y = from.y + w * from.stations;
	const int last = from.stations - 1;
	const real plain = SPREAD(y[q < last ? q : last]);
	if (!from.bodies || q < from.before)
		return plain;
	const real middle = SPREAD(from.middle[w]);
	const int after = q - 1 + from.within;
	const real one = q == from.before ? middle : SPREAD(y[after < last ? after : last]);
	const real two = q <= from.before + 1 ? middle : SPREAD(y[after - 1 < last ? after - 1 : last]);
	return variants_pick(shift, plain, one, two);
}

SHARED_FUNCTION int variants_is_empty(const variants_state *s, int w)
{
	GLOBAL const scalar *y = TABLE(s, PARENT) + w * s->stations;
	int empty = 1;
	ROLLED
	for (int i = 0; i < s->stations; i++)
		empty &= !(y[i] > LITERAL(0.0));
	return empty;
}

SHARED_FUNCTION void variants_bend_line(const variants_state *s, const variants_shift *shift, int w)
{
	STATE real *bend = s->bend + w * s->slots;
	const variants_line room = variants_room(s);
	const variants_source from = variants_source_of(s, shift);
	if (variants_is_empty(s, w)) {
		ROLLED
		for (int q = 0; q < s->slots; q++)
			bend[q] = ZERO;
		return;
	}
	ROLLED
	for (int q = 0; q < s->slots; q++)
		room.value[q] = variants_moved_y(from, shift, w, q);
	variants_natural_bend(variants_moved_line(s), s->slots, room.value, bend);
}

/* All waterlines at one station. No lane has it before slot from_slot; returns the same for stations beyond
 * it. */
SHARED_FUNCTION int variants_take_station(const variants_state *s, const variants_shift *shift,
                                          int station, int from_slot)
{
	const variants_line line = variants_moved_line(s);
	const variants_source from = variants_source_of(s, shift);
	const int waterlines = s->waterlines, slots = s->slots;
	const real x = SPREAD(TABLE(s, X)[station]);
	const real least = SPREAD(TABLE(s, FORMULA)[VARIANTS_FORMULA_LEAST]);
	const real sixth = SPREAD(LITERAL(0.16666666666666666));
	const mask in_body = shift->body & (x >= shift->body_from) & (x <= shift->body_to);
	const int ends = station == 0 || station == from.stations - 1;
	STATE real *y = s->y + station;
	ROLLED
	for (int w = 0; w < waterlines; w++)
		y[w * from.stations] = ends ? SPREAD(from.y[w * from.stations + station]) : ZERO;
	int lowest = slots;
	ROLLED
	for (int q = from_slot; q + 1 < slots && !ends; q++) {
		const mask runs = (line.at[q] <= x) & (NUMBER(q) < shift->last);
		const mask here = runs & (x < line.at[q + 1]);
		if (!ANY(runs))
			break;
		if (!ANY(here))
			continue;
		lowest = lowest < q ? lowest : q;
		const real width = line.at[q + 1] - line.at[q];
		const real u = (x - line.at[q]) * line.step[q], v = ONE - u;
		const real bends = -(width * width) * sixth * (u * v);
		const real a = bends * (ONE + v), b = bends * (ONE + u);
		STATE const real *bend = s->bend + q;
		ROLLED
		for (int w = 0; w < waterlines; w++, bend += slots) {
			STATE real *to = y + w * from.stations;
			const real y0 = variants_moved_y(from, shift, w, q);
			const real y1 = variants_moved_y(from, shift, w, q + 1);
			real found = FUSED(v, y0, FUSED(u, y1, FUSED(a, bend[0], b * bend[1])));
			found = CHOOSE(in_body, SPREAD(from.middle[w]), found);
			*to = CHOOSE(here, CHOOSE(found > least, found, ZERO), *to);
		}
	}
	return lowest < slots ? lowest : from_slot;
}

/* ------------------------------------------------------------------------------------------------
 * Nodes
 * --------------------------------------------------------------------------------------------- */

/* At an edge of the table a node stands for the one beyond it: what it has itself changes nothing. */
SHARED_FUNCTION void variants_take_nodes(const variants_state *s, int w)
{
	const int stations = s->stations;
	GLOBAL const scalar *nodes = TABLE(s, NODES) + w * stations;
	STATE const real *y = s->y + w * stations;
	STATE const real *above = w + 1 < s->waterlines ? y + stations : y;
	STATE real *on = s->on + w * stations;
	real aft = y[0], here = y[0];
	s->bad[w] = ZERO;
	ROLLED
	for (int i = 0; i < stations; i++) {
		const int kind = (int)nodes[i];
		const real fore = y[i + 1 < stations ? i + 1 : i];
		real most = here;
		if (kind & VARIANTS_NODE_BESIDE)
			most = MOST_OF(MOST_OF(aft, fore), MOST_OF(here, above[i]));
		on[i] = kind & VARIANTS_NODE_ALWAYS ? ONE : CHOOSE(most > ZERO, ONE, ZERO);
		aft = here;
		here = fore;
	}
}

/* The rows of a spline that stand in the room of a work-item. */
typedef struct variants_rows {
	int list; /* of points; 0: none */
	real first, last;
	mask ascend;
} variants_rows;

/* Fills the '?' of a waterline from its other points, by a natural spline (host/hull/hull_fill.c). The
 * rows are those of the waterline before where the same points stand in them. */
SHARED_FUNCTION void variants_fill(const variants_state *s, int w, variants_rows *rows)
{
	const variants_line line = variants_room(s);
	GLOBAL const int *list = s->lists + s->lists[w];
	GLOBAL const scalar *x = TABLE(s, X);
	const int known = list[0], unknown = list[known + 1];
	real first = NUMBER(known), last = -ONE, hole = -ONE, gap = -ONE;
	if (s->lists[w] == 0)
		return;
	ROLLED
	for (int j = 0; j < known; j++) {
		const int node = w * s->stations + list[1 + j];
		const mask on = s->on[node] > ZERO;
		line.value[j] = s->y[node];
		gap = CHOOSE(on, MOST_OF(gap, hole), gap);
		first = CHOOSE(on, LEAST_OF(first, NUMBER(j)), first);
		last = CHOOSE(on, NUMBER(j), last);
		hole = CHOOSE(!on & (last >= ZERO), NUMBER(j), hole);
	}
	if (rows->list != s->lists[w] || ANY((first != rows->first) | (last != rows->last))) {
		ROLLED
		for (int j = 0; j < known; j++)
			line.at[j] = SPREAD(x[list[1 + j]]);
		rows->list = s->lists[w];
		rows->first = first;
		rows->last = last;
		rows->ascend = variants_natural(line, known, first, last);
	}
	mask good = rows->ascend & (gap < ZERO);
	variants_natural_bend(line, known, line.value, line.bend);
	ROLLED
	for (int n = 0; n < unknown; n++) {
		const int station = list[known + 2 + 2 * n], j = list[known + 3 + 2 * n];
		const scalar width = x[list[2 + j]] - x[list[1 + j]];
		const scalar u = (x[station] - x[list[1 + j]]) / width;
		const real y = variants_cubic(SPREAD(u), SPREAD(width), line.value[j], line.value[j + 1],
		                              line.bend[j], line.bend[j + 1]);
		good = good & (first <= NUMBER(j)) & (last >= NUMBER(j + 1));
		s->y[w * s->stations + station] = MOST_OF(y, ZERO);
	}
	s->bad[w] = CHOOSE(good, s->bad[w], ONE);
}

/* The hull of a shift: half-breadths and nodes. False in lanes where it is none. */
SHARED_FUNCTION mask variants_move(const variants_state *s, variants_shift *shift)
{
	mask good = shift->good;
	/* every work-item knows the shift; one writes where the points are */
	if (WORK_ITEM == 0)
		s->forms[0] = CHOOSE(variants_move_points(s, shift), ONE, ZERO);
	else
		shift->last = variants_pick(shift, NUMBER(s->stations - 1),
		                            NUMBER(s->stations - s->shape[VARIANTS_WITHIN_BODY]),
		                            NUMBER(s->stations - s->shape[VARIANTS_WITHIN_BODY] + 1));
	WAIT;
	good = good & (s->forms[0] > ZERO);
	ROLLED
	for (int w = WORK_ITEM; w < s->waterlines; w += WORK_ITEMS)
		variants_bend_line(s, shift, w);
	WAIT;
	int from_slot = 0;
	ROLLED
	for (int i = WORK_ITEM; i < s->stations; i += WORK_ITEMS)
		from_slot = variants_take_station(s, shift, i, from_slot);
	WAIT;
	ROLLED
	for (int w = WORK_ITEM; w < s->waterlines; w += WORK_ITEMS)
		variants_take_nodes(s, w);
	WAIT;
	variants_rows rows = { 0, -ONE, -ONE, ZERO > ZERO };
	ROLLED
	for (int w = WORK_ITEM; w < s->waterlines; w += WORK_ITEMS)
		variants_fill(s, w, &rows);
	WAIT;
	return good;
}

#endif
