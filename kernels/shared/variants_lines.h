/* Which nodes of a hull are its points, where its waterlines end and its sections begin
 * (host/hydrostatics/README.md). Lanes differ; those whose lines have gaps are marked, the host takes
 * them. */
#ifndef BATTEN_SHARED_VARIANTS_LINES_H
#define BATTEN_SHARED_VARIANTS_LINES_H

#include "variants_curve.h"

typedef struct variants_state {
	int stations, waterlines, drafts, slots;
	GLOBAL const int *shape, *lists;
	GLOBAL const scalar *tables;
	STATE real *y;     /* [waterline][station] */
	STATE real *on;    /* 1: a point of the hull */
	STATE real *bend;  /* [waterline][slot] of moved waterlines; then slopes [waterline][station] */
	STATE real *ends;  /* [waterline][4]; x NONE without points */
	STATE real *first; /* [station]: the waterline its section begins at; waterlines: no section */
	STATE real *edge;  /* [station]: z where the edge of the hull crosses it, or NONE */
	STATE real *parts; /* [draft][station][VARIANTS_PART_COUNT] */
	STATE real *moved; /* [4][slot] */
	STATE real *bad;   /* [waterlines + stations + drafts + 1]: 1 irregular */
	STATE real *forms; /* [drafts + 1][VARIANTS_FORM_COUNT] */
	STATE real *room;  /* of this work-item */
} variants_state;

#define TABLE(s, name) ((s)->tables + (s)->shape[VARIANTS_AT_##name])

/* A group's room taken apart. */
SHARED_FUNCTION variants_state variants_state_in(GLOBAL const int *shape, GLOBAL const int *lists,
                                                 GLOBAL const scalar *tables, STATE real *room,
                                                 int item)
{
	variants_state s;
	s.stations = shape[VARIANTS_STATIONS];
	s.waterlines = shape[VARIANTS_WATERLINES];
	s.drafts = shape[VARIANTS_DRAFTS];
	s.slots = VARIANTS_SLOTS(s.stations);
	s.shape = shape;
	s.lists = lists;
	s.tables = tables;
	s.y = room;
	s.on = s.y + s.waterlines * s.stations;
	s.bend = s.on + s.waterlines * s.stations;
	s.ends = s.bend + s.waterlines * s.slots;
	s.first = s.ends + 4 * s.waterlines;
	s.edge = s.first + s.stations;
	s.parts = s.edge + s.stations;
	s.moved = s.parts + (s.drafts + 1) * VARIANTS_PART_COUNT * s.stations;
	s.bad = s.moved + 4 * s.slots;
	s.forms = s.bad + s.waterlines + s.stations + s.drafts + 1;
	s.room = s.forms + (s.drafts + 1) * VARIANTS_FORM_COUNT +
	         item * VARIANTS_ITEM_ROOM(s.stations, s.waterlines);
	return s;
}

SHARED_FUNCTION variants_line variants_room(const variants_state *s)
{
	return variants_line_in(s->room, VARIANTS_ITEM_SLOTS(s->stations, s->waterlines));
}

/* ------------------------------------------------------------------------------------------------
 * Waterlines
 * --------------------------------------------------------------------------------------------- */

/* The points of a waterline: stations in slots 1 .. stations, ends off the table in those next to them;
 * from first to last, zeros that stand before zeros left out. */
typedef struct variants_run {
	real aft, fore;   /* slots of the ends off the table; below 0: none */
	real first, last; /* first > last: no points */
	mask irregular;
	int ended; /* the waterline may end off the table in some lane */
} variants_run;

SHARED_FUNCTION mask variants_station_on(const variants_state *s, int w, int slot)
{
	return slot > 0 && slot + 1 < s->slots ? s->on[w * s->stations + slot - 1] > ZERO : ZERO > ZERO;
}

SHARED_FUNCTION real variants_slot_y(const variants_state *s, int w, int slot, variants_run run)
{
	GLOBAL const scalar *ends = TABLE(s, ENDS) + 4 * w;
	const real y = slot > 0 && slot + 1 < s->slots ? s->y[w * s->stations + slot - 1] : ZERO;
	if (!run.ended)
		return y;
	return CHOOSE(run.aft == NUMBER(slot), SPREAD(ends[1]),
	              CHOOSE(run.fore == NUMBER(slot), SPREAD(ends[3]), y));
}

SHARED_FUNCTION real variants_slot_x(const variants_state *s, int w, int slot, variants_run run)
{
	GLOBAL const scalar *ends = TABLE(s, ENDS) + 4 * w;
	const real x = slot > 0 && slot + 1 < s->slots ? SPREAD(TABLE(s, X)[slot - 1]) : NONE;
	if (!run.ended)
		return x;
	return CHOOSE(run.aft == NUMBER(slot), SPREAD(ends[0]),
	              CHOOSE(run.fore == NUMBER(slot), SPREAD(ends[2]), x));
}

/* Puts the ends off the table beside the outermost stations. */
SHARED_FUNCTION variants_run variants_place_ends(const variants_state *s, int w)
{
	GLOBAL const scalar *ends = TABLE(s, ENDS) + 4 * w;
	GLOBAL const scalar *x = TABLE(s, X);
	const mask aft = SPREAD(ends[0]) < NONE, fore = SPREAD(ends[2]) < NONE;
	variants_run run = { -ONE, -ONE, ZERO, ZERO, ZERO > ZERO, ANY(aft | fore) };
	if (!run.ended)
		return run;
	real lowest = NUMBER(s->slots), highest = -ONE;
	ROLLED
	for (int i = 1; i + 1 < s->slots; i++) {
		const mask on = variants_station_on(s, w, i);
		lowest = CHOOSE(on, LEAST_OF(lowest, NUMBER(i)), lowest);
		highest = CHOOSE(on, NUMBER(i), highest);
	}
	run.aft = CHOOSE(aft, lowest - ONE, -ONE);
	run.fore = CHOOSE(fore, highest + ONE, -ONE);
	run.irregular = highest < ZERO;
	/* an end that passed its first station, or that empty cells of a grid part from it */
	const mask grid = NUMBER(s->shape[VARIANTS_LISTED]) == ZERO;
	ROLLED
	for (int i = 1; i + 1 < s->slots; i++) {
		const real here = NUMBER(i), at = SPREAD(x[i - 1]);
		const mask beyond = at > SPREAD(ends[0]), before = at < SPREAD(ends[2]);
		run.irregular = run.irregular | (aft & (here == lowest) & !beyond) |
		                (fore & (here == highest) & !before) |
		                (aft & grid & (here == lowest - ONE) & beyond) |
		                (fore & grid & (here == highest + ONE) & before);
	}
	return run;
}

/* Slots of points, of positive ones, and how many points there are. */
typedef struct variants_reach {
	real lowest, highest, first, last, count;
} variants_reach;

/* ended: a constant. Where half-breadths are positive there are points. */
SHARED_FUNCTION variants_reach variants_reach_of(const variants_state *s, int w, variants_run run,
                                                 int ended)
{
	const real far = NUMBER(s->slots);
	STATE const real *on = s->on + w * s->stations - 1, *y = s->y + w * s->stations - 1;
	variants_reach r = { far, -ONE, far, -ONE, ZERO };
	ROLLED
	for (int i = ended ? 0 : 1; i < (ended ? s->slots : s->slots - 1); i++) {
		const real here = NUMBER(i);
		mask is_on, positive;
		if (ended) {
			is_on = variants_station_on(s, w, i) | (run.aft == here) | (run.fore == here);
			positive = is_on & (variants_slot_y(s, w, i, run) > ZERO);
		} else {
			is_on = on[i] > ZERO;
			positive = y[i] > ZERO;
		}
		r.lowest = LEAST_OF(r.lowest, CHOOSE(is_on, here, far));
		r.highest = CHOOSE(is_on, here, r.highest);
		r.first = LEAST_OF(r.first, CHOOSE(positive, here, far));
		r.last = CHOOSE(positive, here, r.last);
		r.count += CHOOSE(is_on, ONE, ZERO);
	}
	return r;
}

SHARED_FUNCTION variants_run variants_run_of(const variants_state *s, int w)
{
	variants_run run = variants_place_ends(s, w);
	const variants_reach r = run.ended ? variants_reach_of(s, w, run, 1)
	                                   : variants_reach_of(s, w, run, 0);
	const mask none = r.last < ZERO;
	run.first = CHOOSE(none, r.lowest, MOST_OF(r.lowest, r.first - ONE));
	run.last = CHOOSE(none, r.highest, LEAST_OF(r.highest, r.last + ONE));
	/* empty slots between points */
	run.irregular = run.irregular | (r.count < r.highest - r.lowest + ONE);
	return run;
}

SHARED_FUNCTION void variants_find_ends(const variants_state *s, int w)
{
	const variants_run run = variants_run_of(s, w);
	STATE real *ends = s->ends + 4 * w;
	real aft_x = NONE, aft_y = ONE, fore_x = NONE, fore_y = ONE;
	ROLLED
	for (int i = 0; i < s->slots; i++) {
		const mask begins = run.first == NUMBER(i), stops = run.last == NUMBER(i);
		if (!ANY(begins | stops))
			continue;
		const real x = variants_slot_x(s, w, i, run);
		const real y = variants_slot_y(s, w, i, run);
		aft_x = CHOOSE(begins, x, aft_x);
		aft_y = CHOOSE(begins, y, aft_y);
		fore_x = CHOOSE(stops, x, fore_x);
		fore_y = CHOOSE(stops, y, fore_y);
	}
	ends[0] = aft_x;
	ends[1] = aft_y;
	ends[2] = fore_x;
	ends[3] = fore_y;
	s->bad[w] = CHOOSE(run.irregular, ONE, s->bad[w]);
}

/* The rows of a spline that stand in the room of a work-item: of the stations from first to last. */
typedef struct variants_knots {
	int stand;
	real first, last;
} variants_knots;

/* Slopes y_x at the nodes of a waterline, NONE where there are none, by its not-a-knot spline. The rows are
 * those of the waterline before where the same points stand in them. */
SHARED_FUNCTION void variants_find_slopes(const variants_state *s, int w, variants_knots *knots)
{
	const variants_run run = variants_run_of(s, w);
	const variants_line line = variants_room(s);
	ROLLED
	for (int i = 0; i < s->slots; i++)
		line.value[i] = variants_slot_y(s, w, i, run);
	if (!knots->stand || run.ended ||
	    ANY((run.first != knots->first) | (run.last != knots->last))) {
		ROLLED
		for (int i = 0; i < s->slots; i++)
			line.at[i] = variants_slot_x(s, w, i, run);
		variants_not_a_knot(line, s->slots, run.first, run.last);
		/* ends off the table lie elsewhere on each waterline */
		knots->stand = !run.ended;
		knots->first = run.first;
		knots->last = run.last;
	}
	variants_not_a_knot_bend(line, s->slots, run.first, run.last);
	ROLLED
	for (int i = 1; i + 1 < s->slots; i++) {
		const mask there = (NUMBER(i) >= run.first) & (NUMBER(i) <= run.last) &
		                   (run.last > run.first);
		s->bend[w * s->stations + i - 1] = CHOOSE(
			there, variants_slope_at(line, i, run.first, run.last), NONE);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Sections
 * --------------------------------------------------------------------------------------------- */

/* z where the edge of the hull crosses a station between waterline w, where its section begins, and
 * the one below; NONE: a flat bottom. */
SHARED_FUNCTION real variants_edge_at(const variants_state *s, int station, int w)
{
	const real x = SPREAD(TABLE(s, X)[station]);
	GLOBAL const scalar *z = TABLE(s, Z);
	STATE const real *below = s->ends + 4 * (w - 1), *here = s->ends + 4 * w;
	const real low = SPREAD(z[w - 1]), high = SPREAD(z[w]);
	const mask there = below[0] < NONE;
	const mask aft = there & (x < below[0]), fore = there & (x > below[2]);
	const real end_x = CHOOSE(aft, below[0], below[2]), end_y = CHOOSE(aft, below[1], below[3]);
	const real here_x = CHOOSE(aft, here[0], here[2]), here_y = CHOOSE(aft, here[1], here[3]);
	const mask crosses = (here_y <= ZERO) & (here_x != end_x);
	const real across = low + (high - low) * ((x - end_x) / (here_x - end_x));
	real onward = low;
	if (w + 1 < s->waterlines) {
		const real y0 = s->y[w * s->stations + station], y1 = s->y[(w + 1) * s->stations + station];
		const real foot = high - y0 * SPREAD(z[w + 1] - z[w]) / (y1 - y0);
		onward = CHOOSE(y1 > y0, MOST_OF(low, foot), low);
	}
	const real edge = CHOOSE(crosses, across, onward);
	return CHOOSE((aft | fore) & (end_y <= ZERO) & (edge < high), edge, NONE);
}

SHARED_FUNCTION void variants_find_section(const variants_state *s, int station)
{
	const real far = NUMBER(s->waterlines);
	real lowest = far, positive = far, empty = -ONE, first = far, before = ZERO, y = ZERO,
		 under = ZERO;
	/* least and most of what each waterline would be, so that none waits for the one before */
	ROLLED
	for (int w = 0; w < s->waterlines; w++) {
		const real here = NUMBER(w), on = s->on[w * s->stations + station];
		const mask is_on = on > ZERO;
		under = y;
		y = s->y[w * s->stations + station];
		const mask wide = y > ZERO;
		lowest = LEAST_OF(lowest, CHOOSE(is_on, here, far));
		empty = CHOOSE(is_on, empty, here);
		positive = LEAST_OF(positive, CHOOSE(wide, here, far));
		first = LEAST_OF(first, CHOOSE(wide, CHOOSE(before > ZERO, here - ONE, here), far));
		before = on;
	}
	const mask none = positive == far;
	first = CHOOSE(none, lowest, first);
	/* y and under are the topmost two */
	const mask closes = !none & (y <= ZERO) & (under <= ZERO);
	/* empty: the topmost one */
	const mask hole = (empty > lowest) & (empty >= first);
	const mask gap = hole | ((first == positive) & (lowest < positive));
	s->first[station] = first;
	s->bad[s->waterlines + station] = CHOOSE((first < far) & (closes | gap), ONE, ZERO);
	real edge = NONE;
	ROLLED
	for (int w = 1; w < s->waterlines; w++) {
		const mask flat = (first == NUMBER(w)) & (s->y[w * s->stations + station] > ZERO);
		if (ANY(flat))
			edge = CHOOSE(flat, variants_edge_at(s, station, w), edge);
	}
	s->edge[station] = edge;
}

/* Ends of waterlines, then beginnings of sections. */
SHARED_FUNCTION void variants_find_lines(const variants_state *s)
{
	ROLLED
	for (int w = WORK_ITEM; w < s->waterlines; w += WORK_ITEMS)
		variants_find_ends(s, w);
	WAIT;
	ROLLED
	for (int i = WORK_ITEM; i < s->stations; i += WORK_ITEMS)
		variants_find_section(s, i);
	WAIT;
}

#endif
