/* What lines alone do not see in the block search: the coupling of neighbouring lines along ways that
 * are smooth along them. Hats one line wide, quadratic B-splines along it, span such ways; their common
 * parabola has a table of its own, from the same probes: hats, line by line, coupled over two lines. The
 * way of the lines has a part of it already, what the blocks of that table on the diagonal say; so the
 * exploratory move takes the bottom of the hats' parabola in place of the bottom of these blocks (the
 * sum of both would go twice as far where the two agree). Hats are cut where offsets are held. */
#ifndef BATTEN_SHARED_BLOCK_HATS_H
#define BATTEN_SHARED_BLOCK_HATS_H

#include "block_band.h"
#include "block_lines.h"

/* All hats coupled. */
SHARED_FUNCTION block_band block_hats_whole(const block_state *s)
{
	block_band table;
	table.count = s->lines * s->hats;
	table.band = BLOCK_HAT_BAND(s->hats);
	table.rows = s->hat_rows;
	table.way = table.rows + table.count * (table.band + BLOCK_HATS_MET);
	return table;
}

/* The lines apart. */
SHARED_FUNCTION block_band block_hats_apart(const block_state *s)
{
	block_band table = block_hats_whole(s);
	table.rows += table.count * table.band;
	table.way += table.count;
	table.band = BLOCK_HATS_MET;
	return table;
}

/* 1 where an offset is free, else 0. */
SHARED_FUNCTION real block_is_free(const block_state *s, int n)
{
	const real zero = SPREAD(LITERAL(0.0));
	return CHOOSE(AT(block_array(s, BLOCK_STATE_INVERSE)[n]) > zero, SPREAD(LITERAL(1.0)), zero);
}

/* What the hats of a line weigh in the second derivatives at a node; t only on its own line. */
typedef struct block_hats {
	real r[BLOCK_HATS_MET], s[BLOCK_HATS_MET], t[BLOCK_HATS_MET];
} block_hats;

/* Those of line `of` at node k of line `at`, the same line or one beside it. */
SHARED_FUNCTION void block_hats_at(const block_state *s, int at, int of, int k, block_hats *hats)
{
	GLOBAL const scalar *w = s->across + at * STENCIL_SIZE;
	GLOBAL const scalar *v = s->hat_values + k * BLOCK_HAT_SIZE;
	const scalar once = of < at ? -w[0] : of > at ? w[1] : w[0] - w[1];
	const scalar twice = of < at ? w[2] : of > at ? w[3] : -(w[2] + w[3]);
	const int n = of * s->length + k;
	const real below = block_is_free(s, n - 1);
	const real here = block_is_free(s, n);
	const real above = block_is_free(s, n + 1);
	for (int j = 0; j < BLOCK_HATS_MET; j++) {
		GLOBAL const scalar *first = v + BLOCK_HAT_ONCE + j;
		hats->r[j] = (twice * v[BLOCK_HAT_VALUE + j]) * here;
		hats->s[j] = once * ((first[0] * below + first[BLOCK_HATS_MET] * here) +
		                     first[2 * BLOCK_HATS_MET] * above);
	}
	if (of != at)
		return;
	for (int j = 0; j < BLOCK_HATS_MET; j++) {
		GLOBAL const scalar *second = v + BLOCK_HAT_TWICE + j;
		hats->t[j] = (second[0] * below + second[BLOCK_HATS_MET] * here) +
		             second[2 * BLOCK_HATS_MET] * above;
	}
}

/* Adds what hats of one line, at a node, couple with those of the same or a later line: to rows, where
 * the coupling of the first of both is. `met` hats are not 0. bends: the second line is the node's own. */
SHARED_FUNCTION void block_couple(STATE stored *rows, int band, int met, int same, int bends,
                                  const block_hats *bent, const block_hats *hats)
{
	ROLLED
	for (int j = 0; j < met; j++) {
		STATE stored *row = rows + j * (band - 1);
		ROLLED
		for (int i = same ? j : 0; i < met; i++) {
			const real sum = bent->r[j] * hats->r[i] + bent->s[j] * hats->s[i];
			AT(row[i]) += bends ? sum + bent->t[j] * hats->t[i] : sum;
		}
	}
}

/* The curvatures probed at a node times what hats weigh there: of its own line, or of another. */
SHARED_FUNCTION void block_bend_hats(STATE const stored *probes, int own, const block_hats *hats,
                                     block_hats *bent)
{
	for (int j = 0; j < BLOCK_HATS_MET; j++) {
		const real r = hats->r[j], s = hats->s[j];
		bent->r[j] = AT(probes[BLOCK_PROBE_RR]) * r + AT(probes[BLOCK_PROBE_RS]) * s;
		bent->s[j] = AT(probes[BLOCK_PROBE_RS]) * r + AT(probes[BLOCK_PROBE_SS]) * s;
		bent->t[j] = AT(probes[BLOCK_PROBE_RT]) * r + AT(probes[BLOCK_PROBE_ST]) * s;
		if (own) {
			bent->r[j] += AT(probes[BLOCK_PROBE_RT]) * hats->t[j];
			bent->s[j] += AT(probes[BLOCK_PROBE_ST]) * hats->t[j];
			bent->t[j] += AT(probes[BLOCK_PROBE_TT]) * hats->t[j];
		}
	}
}

/* Adds the curvatures of the nodes of line `at` to the rows of the lines from number `from` to `to` of
 * the three they are of. */
SHARED_FUNCTION void block_gather_hats_around(const block_state *s, int at, int from, int to)
{
	const block_band table = block_hats_whole(s);
	const STATE stored *ring = block_ring(s, at);
	ROLLED
	for (int k = 1; k + 1 < s->length; k++) {
		GLOBAL const scalar *v = s->hat_values + k * BLOCK_HAT_SIZE;
		const STATE stored *probes = ring + k * BLOCK_PROBE_COUNT;
		const int first = (int)v[BLOCK_HAT_FIRST];
		const int met = (int)v[BLOCK_HAT_COUNT];
		STATE stored *rows = table.rows + ((at - 1) * s->hats + first) * table.band;
		block_hats hats[3], bent;
		ROLLED
		for (int a = from; a < 3; a++)
			block_hats_at(s, at, at - 1 + a, k, &hats[a]);
		ROLLED
		for (int a = from; a <= to; a++) {
			block_bend_hats(probes, a == 1, &hats[a], &bent);
			ROLLED
			for (int b = a; b < 3; b++)
				block_couple(rows + a * s->hats * table.band + (b - a) * s->hats, table.band, met,
				             a == b, b == 1, &bent, &hats[b]);
		}
	}
}

/* Begins a line's rows: closeness and the weight of staying. */
SHARED_FUNCTION void block_begin_hats(const block_state *s, int line, real weight)
{
	const block_band table = block_hats_whole(s);
	const STATE stored *close = block_array(s, BLOCK_INPUT_CLOSE);
	STATE stored *rows = table.rows + line * s->hats * table.band;
	ROLLED
	for (int n = 0; n < s->hats * table.band; n++)
		AT(rows[n]) = SPREAD(LITERAL(0.0));
	ROLLED
	for (int k = 0; k < s->length; k++) {
		GLOBAL const scalar *v = s->hat_values + k * BLOCK_HAT_SIZE;
		const int n = line * s->length + k;
		const real here = ((AT(close[n]) + AT(close[n])) + weight) * block_is_free(s, n);
		ROLLED
		for (int j = 0; j < BLOCK_HATS_MET; j++) {
			STATE stored *row = rows + ((int)v[BLOCK_HAT_FIRST] + j) * table.band - j;
			ROLLED
			for (int i = j; i < BLOCK_HATS_MET; i++)
				AT(row[i]) += (v[BLOCK_HAT_VALUE + j] * v[BLOCK_HAT_VALUE + i]) * here;
		}
	}
}

/* Completes them; what is rounding of a pivot goes where the way will be. */
SHARED_FUNCTION void block_end_hats(const block_state *s, int line, real part)
{
	const real zero = SPREAD(LITERAL(0.0));
	const block_band whole = block_hats_whole(s);
	const block_band apart = block_hats_apart(s);
	ROLLED
	for (int hat = 0; hat < s->hats; hat++) {
		const int n = line * s->hats + hat;
		STATE stored *row = whole.rows + n * whole.band;
		AT(row[0]) += part * AT(row[0]);
		for (int d = 0; d < BLOCK_HATS_MET; d++)
			AT(apart.rows[n * apart.band + d]) = hat + d < s->hats ? AT(row[d]) : zero;
		AT(whole.way[n]) = AT(apart.way[n]) = SPREAD(BLOCK_PIVOT_FLOOR) * AT(row[0]);
	}
}

/* Factors all rows, by one work-item: each waits for the one before. */
SHARED_FUNCTION void block_factor_whole(const block_state *s)
{
	const block_band whole = block_hats_whole(s);
	ROLLED
	for (int n = 0; n < whole.count; n++)
		block_band_eliminate(whole, n, whole.count,
		                     block_band_inverse(AT(whole.rows[n * whole.band]), AT(whole.way[n])));
}

/* Factors a line's rows of the lines apart. A hat without a pivot among all has none here. */
SHARED_FUNCTION void block_factor_apart(const block_state *s, int line)
{
	const real zero = SPREAD(LITERAL(0.0));
	const block_band whole = block_hats_whole(s);
	const block_band apart = block_hats_apart(s);
	const int end = (line + 1) * s->hats;
	ROLLED
	for (int n = line * s->hats; n < end; n++) {
		const real inverse = block_band_inverse(AT(apart.rows[n * apart.band]), AT(apart.way[n]));
		const mask has = AT(whole.rows[n * whole.band]) > zero;
		block_band_eliminate(apart, n, end, CHOOSE(has, inverse, zero));
	}
}

/* Adds the curvatures to all rows. Each row gets them from lines of nodes in turn, those of number 3 n + 1
 * first, then 3 n + 2, then 3 n: alone, a line's hats are then worked out once for all rows they add to;
 * many work-items take each its own lines and need not wait for each other. */
SHARED_FUNCTION void block_gather_hats(const block_state *s)
{
	ROLLED
	for (int third = 1; third <= 3; third++) {
#if defined(BATTEN_ALONE)
		ROLLED
		for (int at = third; at + 1 < s->lines; at += 3)
			block_gather_hats_around(s, at, 0, 2);
#else
		ROLLED
		for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS) {
			const int at = line - 1 + (third + 4 - line % 3) % 3;
			if (block_is_inside(at, s->lines))
				block_gather_hats_around(s, at, line - at + 1, line - at + 1);
		}
#endif
	}
}

/* The factors of both tables from the probes of all lines. */
SHARED_FUNCTION void block_explore_hats(const block_state *s, block_stay stay)
{
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_begin_hats(s, line, stay.weight);
	block_gather_hats(s);
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_end_hats(s, line, stay.part);
	WAIT;
	if (WORK_ITEM == 0)
		block_factor_whole(s);
	WAIT;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_factor_apart(s, line);
	WAIT;
}

/* Slopes along a line's hats. */
SHARED_FUNCTION void block_slope_hats(const block_state *s, int line, const STATE stored *slopes)
{
	STATE stored *whole = block_hats_whole(s).way + line * s->hats;
	STATE stored *apart = block_hats_apart(s).way + line * s->hats;
	ROLLED
	for (int hat = 0; hat < s->hats; hat++)
		AT(whole[hat]) = SPREAD(LITERAL(0.0));
	ROLLED
	for (int k = 0; k < s->length; k++) {
		GLOBAL const scalar *v = s->hat_values + k * BLOCK_HAT_SIZE;
		const int n = line * s->length + k;
		const real slope = AT(slopes[n]) * block_is_free(s, n);
		for (int j = 0; j < BLOCK_HATS_MET; j++)
			AT(whole[(int)v[BLOCK_HAT_FIRST] + j]) += v[BLOCK_HAT_VALUE + j] * slope;
	}
	ROLLED
	for (int hat = 0; hat < s->hats; hat++)
		AT(apart[hat]) = AT(whole[hat]);
}

/* The way of the hats beyond that of the lines. */
SHARED_FUNCTION void block_choose_hats(const block_state *s, const STATE stored *slopes)
{
	const block_band whole = block_hats_whole(s);
	const block_band apart = block_hats_apart(s);
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_slope_hats(s, line, slopes);
	WAIT;
	if (WORK_ITEM == 0) {
		ROLLED
		for (int both = 0; both < 2; both++)
			block_band_solve(both ? apart : whole);
		ROLLED
		for (int n = 0; n < whole.count; n++)
			AT(whole.way[n]) -= AT(apart.way[n]);
	}
	WAIT;
}

/* How far that moves node k of a line. */
SHARED_FUNCTION real block_hats_beyond(const block_state *s, int line, int k)
{
	GLOBAL const scalar *v = s->hat_values + k * BLOCK_HAT_SIZE;
	const STATE stored *way = block_hats_whole(s).way + line * s->hats + (int)v[BLOCK_HAT_FIRST];
	real moved = SPREAD(LITERAL(0.0));
	for (int j = 0; j < BLOCK_HATS_MET; j++)
		moved += v[BLOCK_HAT_VALUE + j] * AT(way[j]);
	return moved * block_is_free(s, line * s->length + k);
}

#endif
