/* What the course of the block search asks of a net: slopes along all poles and the table of their common parabola,
 * by sum factorisation, first along u at every line of samples, then along v; its bottom; the objective. */
#ifndef BATTEN_SHARED_NET_BLOCK_TABLES_H
#define BATTEN_SHARED_NET_BLOCK_TABLES_H

#include "block_band.h"
#include "net_block_lines.h"

/* What the columns that a sample sees change of its numbers, by their values and derivatives along v: y_u and y_uu
 * are of the value, y_v and y_uv of the first derivative, y_vv of the second. */
SHARED_FUNCTION void net_change_columns(const block_state *s, const net_line *at, int sample,
                                        STATE real *to)
{
	GLOBAL const scalar *table = s->table_u + sample * NET_TABLE_SIZE(NET_ORDER_U);
	const STATE real *probed = at->probes + sample * NET_BLOCK_PROBED;
	const STATE real *last = probed + NET_BLOCK_LAST;
	const STATE real *middle = probed + NET_BLOCK_MIDDLE;
	const STATE real *first = probed + NET_BLOCK_FIRST;
	UNROLLED
	for (int a = 0; a < NET_ORDER_U; a++) {
		const real t0 = SPREAD(table[a]);
		const real t1 = SPREAD(table[NET_ORDER_U + a]);
		const real t2 = SPREAD(table[2 * NET_ORDER_U + a]);
		STATE real *column = to + a * NET_BLOCK_COLUMN_SIZE;
		column[NET_BLOCK_COLUMN_LAST] = FUSED(t1, last[0], t2 * last[2]);
		column[NET_BLOCK_COLUMN_LAST + 1] = FUSED(t0, last[1], t1 * last[3]);
		column[NET_BLOCK_COLUMN_LAST + 2] = t0 * last[4];
		if (NET_BLOCK_BENDS) {
			column[NET_BLOCK_COLUMN_MIDDLE] = FUSED(t1, middle[0], t2 * middle[2]);
			column[NET_BLOCK_COLUMN_MIDDLE + 1] = FUSED(t0, middle[1], t1 * middle[3]);
			column[NET_BLOCK_COLUMN_FIRST] = FUSED(t1, first[0], t2 * first[2]);
			column[NET_BLOCK_COLUMN_FIRST + 1] = t0 * first[1];
		}
		column[NET_BLOCK_COLUMN_CLOSE] = t0 * probed[NET_BLOCK_CLOSE_CURVATURE];
	}
}

/* Adds a sample to a pair of columns: products of what both change. */
SHARED_FUNCTION void net_add_pair(const block_state *s, const STATE real *a, const STATE real *b,
                                  real close, real sums[9])
{
	(void)s;
	UNROLLED
	for (int n = 0; n < 9; n++)
		sums[n] = FUSED(a[NET_BLOCK_COLUMN_LAST + n / 3], b[NET_BLOCK_COLUMN_LAST + n % 3],
		                sums[n]);
	UNROLLED
	for (int x = 0; x < (NET_BLOCK_BENDS ? 2 : 0); x++) {
		UNROLLED
		for (int y = 0; y < 2; y++) {
			const real sum = FUSED(a[NET_BLOCK_COLUMN_MIDDLE + x], b[NET_BLOCK_COLUMN_MIDDLE + y],
			                       sums[3 * x + y]);
			sums[3 * x + y] = FUSED(a[NET_BLOCK_COLUMN_FIRST + x], b[NET_BLOCK_COLUMN_FIRST + y],
			                        sum);
		}
	}
	sums[0] = FUSED(a[NET_BLOCK_COLUMN_CLOSE], close, sums[0]);
}

/* Adds the samples of a span, from number i on, to all pairs of its columns. */
SHARED_FUNCTION void net_add_pairs(const block_state *s, const net_line *at, int i)
{
	GLOBAL const scalar *table = s->table_u + i * NET_TABLE_SIZE(NET_ORDER_U);
	const int size = NET_ORDER_U * NET_BLOCK_COLUMN_SIZE;
	STATE real *pairs = at->pairs + s->first_u[i] * (NET_ORDER_U * 9);
	ROLLED
	for (int j = 0; j < NET_POINTS_U; j++)
		net_change_columns(s, at, i + j, at->span + j * size);
	ROLLED
	for (int a = 0; a < NET_ORDER_U; a++) {
		ROLLED
		for (int b = a; b < NET_ORDER_U; b++) {
			STATE real *pair = pairs + (a * NET_ORDER_U + (b - a)) * 9;
			real sums[9];
			UNROLLED
			for (int n = 0; n < 9; n++)
				sums[n] = pair[n];
			UNROLLED
			for (int j = 0; j < NET_POINTS_U; j++) {
				const STATE real *span = at->span + j * size;
				net_add_pair(s, span + a * NET_BLOCK_COLUMN_SIZE, span + b * NET_BLOCK_COLUMN_SIZE,
				             SPREAD(table[j * NET_TABLE_SIZE(NET_ORDER_U) + b]), sums);
			}
			UNROLLED
			for (int n = 0; n < 9; n++)
				pair[n] = sums[n];
		}
	}
}

/* Slopes along the columns of a span, those along poles being their values and derivatives by v. */
SHARED_FUNCTION void net_add_slopes(const block_state *s, const net_line *at, int i)
{
	STATE real *slopes = at->slopes + 3 * s->first_u[i];
	ROLLED
	for (int j = i; j < i + NET_POINTS_U; j++) {
		GLOBAL const scalar *table = s->table_u + j * NET_TABLE_SIZE(NET_ORDER_U);
		const STATE real *probed = at->probes + j * NET_BLOCK_PROBED;
		const STATE real *along = probed + NET_BLOCK_SLOPE;
		UNROLLED
		for (int a = 0; a < NET_ORDER_U; a++) {
			const real t0 = SPREAD(table[a]);
			const real t1 = SPREAD(table[NET_ORDER_U + a]);
			const real t2 = SPREAD(table[2 * NET_ORDER_U + a]);
			STATE real *slope = slopes + 3 * a;
			slope[0] = FUSED(t0, probed[NET_BLOCK_CLOSE_SLOPE],
			                 FUSED(t1, along[0], FUSED(t2, along[2], slope[0])));
			slope[1] = FUSED(t0, along[1], FUSED(t1, along[3], slope[1]));
			slope[2] = FUSED(t0, along[4], slope[2]);
		}
	}
}

/* Probes a line and sums along it. Returns its part of the objective. */
SHARED_FUNCTION real net_work_line(const block_state *s, int line, real part)
{
	const real zero = SPREAD(LITERAL(0.0));
	const net_line at = net_line_of(s, line % s->slots);
	const real sum = net_probe_line(s, &at, line, part);
	ROLLED
	for (int n = 0; n < (3 + 9 * NET_ORDER_U) * s->lines; n++)
		at.slopes[n] = zero; /* and the pairs, which follow them */
	ROLLED
	for (int i = 0; i < s->count_u; i += NET_POINTS_U) {
		net_add_slopes(s, &at, i);
		net_add_pairs(s, &at, i);
	}
	return sum;
}

/* Adds the pair of columns i and i + d, at the lines of a span from number `line` on, to the table. */
SHARED_FUNCTION void net_add_poles(const block_state *s, int line, int i, int d)
{
	const real zero = SPREAD(LITERAL(0.0));
	const int first = s->first_v[line];
	STATE real *rows = s->rows + (i * s->length + first) * s->band + d * s->length;
	real sums[NET_ORDER_MOST * NET_ORDER_MOST];
	UNROLLED
	for (int n = 0; n < NET_ORDER_V * NET_ORDER_V; n++)
		sums[n] = zero;
	ROLLED
	for (int j = line; j < line + NET_POINTS_V; j++) {
		const STATE real *pair = net_line_of(s, j % s->slots).pairs + (i * NET_ORDER_U + d) * 9;
		GLOBAL const scalar *t = s->table_v + j * NET_TABLE_SIZE(NET_ORDER_V);
		UNROLLED
		for (int m = 0; m < NET_ORDER_V; m++) {
			const real t0 = SPREAD(t[m]);
			const real t1 = SPREAD(t[NET_ORDER_V + m]);
			const real t2 = SPREAD(t[2 * NET_ORDER_V + m]);
			const real none = FUSED(pair[2], t2, FUSED(pair[1], t1, pair[0] * t0));
			const real once = FUSED(pair[5], t2, FUSED(pair[4], t1, pair[3] * t0));
			const real twice = FUSED(pair[8], t2, FUSED(pair[7], t1, pair[6] * t0));
			UNROLLED
			for (int k = 0; k < NET_ORDER_V; k++) {
				const int n = m * NET_ORDER_V + k;
				sums[n] = FUSED(SPREAD(t[k]), none, sums[n]);
				sums[n] = FUSED(SPREAD(t[NET_ORDER_V + k]), once, sums[n]);
				sums[n] = FUSED(SPREAD(t[2 * NET_ORDER_V + k]), twice, sums[n]);
			}
		}
	}
	UNROLLED
	for (int n = 0; n < NET_ORDER_V * NET_ORDER_V; n++) {
		const int m = n / NET_ORDER_V;
		const int k = n % NET_ORDER_V;
		if (d > 0 || k <= m)
			rows[k * (s->band - 1) + m] += sums[n];
	}
}

/* Adds the slopes of column i at the lines of a span to those along the poles. */
SHARED_FUNCTION void net_add_pole_slopes(const block_state *s, int line, int i)
{
	STATE real *poles = s->bottom + i * s->length + s->first_v[line];
	ROLLED
	for (int j = line; j < line + NET_POINTS_V; j++) {
		const STATE real *slope = net_line_of(s, j % s->slots).slopes + 3 * i;
		GLOBAL const scalar *t = s->table_v + j * NET_TABLE_SIZE(NET_ORDER_V);
		UNROLLED
		for (int k = 0; k < NET_ORDER_V; k++)
			poles[k] = FUSED(SPREAD(t[k]), slope[0],
			                 FUSED(SPREAD(t[NET_ORDER_V + k]), slope[1],
			                       FUSED(SPREAD(t[2 * NET_ORDER_V + k]), slope[2], poles[k])));
	}
}

/* Adds a pair of columns, if it is one, at lines first to end of samples; with a column and itself its slopes. Looks
 * here whether there is work for it: PoCL loses the work of a loop that some work-items do not enter. */
SHARED_FUNCTION void net_add_column_pair(const block_state *s, int first, int end, int pair)
{
	const int i = pair / NET_ORDER_U;
	const int d = pair % NET_ORDER_U;
	ROLLED
	for (int line = first; line < end; line += NET_POINTS_V) {
		if (d == 0 && i < s->lines)
			net_add_pole_slopes(s, line, i);
		if (i + d < s->lines)
			net_add_poles(s, line, i, d);
	}
}

/* The number of the table that couples two poles. */
SHARED_FUNCTION STATE real *net_entry(const block_state *s, int a, int b)
{
	return a < b ? s->rows + (a * s->band + (b - a)) : s->rows + (b * s->band + (a - b));
}

/* A pole that goes with another becomes part of it: its row and slope are added to the other's. */
SHARED_FUNCTION void net_fold(const block_state *s, int from, int to)
{
	const real zero = SPREAD(LITERAL(0.0));
	const int begin = from - s->band + 1 > 0 ? from - s->band + 1 : 0;
	const int end = from + s->band < s->nodes ? from + s->band : s->nodes;
	ROLLED
	for (int n = begin; n < end; n++) {
		STATE real *entry = net_entry(s, from, n);
		const real value = n == to ? *entry + *entry : *entry;
		const int with = n == from ? to : n;
		*entry = zero;
		/* What lies outside the band is 0. */
		if (with - to < s->band && to - with < s->band)
			*net_entry(s, to, with) += value;
	}
	s->bottom[to] += s->bottom[from];
	s->bottom[from] = zero;
}

/* Completes the rows of a column and leaves them to be factored; what of a pivot is rounding stands where the way
 * will be. */
SHARED_FUNCTION void net_settle_line(const block_state *s, int line, int turn, block_stay stay)
{
	block_products sums = block_products_none();
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		STATE real *pivot = s->rows + n * s->band;
		(void)block_settle_row(s, n, turn, stay, s->bottom[n], *pivot, &sums);
		*pivot = block_array(s, BLOCK_STATE_INVERSE)[n];
		s->bottom[n] = SPREAD(BLOCK_PIVOT_FLOOR) * *pivot;
	}
	block_products_tell(s, line, &sums);
}

SHARED_FUNCTION block_band net_band(const block_state *s)
{
	block_band table;
	table.rows = s->rows;
	table.way = s->bottom;
	table.count = s->nodes;
	table.band = s->band;
	return table;
}

SHARED_FUNCTION void net_factor(const block_state *s)
{
	const block_band table = net_band(s);
	ROLLED
	for (int n = 0; n < table.count; n++)
		block_band_eliminate(table, n, table.count,
		                     block_band_inverse(table.rows[n * table.band], table.way[n]));
}

/* Probes all samples and sums up to the slopes along the poles and their table. */
SHARED_FUNCTION void net_gather(const block_state *s, real part)
{
	const real zero = SPREAD(LITERAL(0.0));
	ROLLED
	for (int n = WORK_ITEM; n < (s->band + 1) * s->nodes; n += WORK_ITEMS)
		s->rows[n] = zero;
	ROLLED
	for (int first = 0; first < s->count_v; first += s->slots) {
		const int end = first + s->slots < s->count_v ? first + s->slots : s->count_v;
		ROLLED
		for (int line = first + WORK_ITEM; line < end; line += WORK_ITEMS)
			s->terms[line] = net_work_line(s, line, part);
		WAIT;
		ROLLED
		for (int n = 0; n < s->lines * NET_ORDER_U; n += WORK_ITEMS)
			net_add_column_pair(s, first, end, n + WORK_ITEM);
		WAIT;
	}
}

SHARED_FUNCTION real net_terms_total(const block_state *s)
{
	real total = SPREAD(LITERAL(0.0));
	ROLLED
	for (int line = 0; line < s->count_v; line++)
		total += s->terms[line];
	return total;
}

SHARED_FUNCTION real block_explore(const block_state *s, real far, real part, int turn,
                                   block_stay stay)
{
	(void)far; /* probes of any size tell the same */
	net_gather(s, part);
	if (WORK_ITEM == 0) {
		ROLLED
		for (int f = 0; f < s->followers; f++)
			net_fold(s, s->follower[2 * f], s->follower[2 * f + 1]);
	}
	WAIT;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		net_settle_line(s, line, turn, stay);
	WAIT;
	if (WORK_ITEM == 0)
		net_factor(s);
	WAIT;
	return net_terms_total(s);
}

SHARED_FUNCTION void block_solve(const block_state *s, int turn, const real *alpha)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE real *self = block_array(s, BLOCK_STATE_INVERSE);
	STATE real *way = block_array(s, BLOCK_STATE_WAY);
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		s->bottom[n] = CHOOSE(self[n] > zero, block_slope_left(s, n, turn, alpha), zero);
	WAIT;
	if (WORK_ITEM == 0)
		block_band_solve(net_band(s));
	WAIT;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS) {
		real dot[BLOCK_MEMORY];
		for (int m = 0; m < BLOCK_MEMORY; m++)
			dot[m] = zero;
		ROLLED
		for (int n = line * s->length; n < (line + 1) * s->length; n++) {
			way[n] = s->bottom[n];
			for (int m = 0; m < BLOCK_MEMORY; m++)
				dot[m] += way[n] * block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, m))[n];
		}
		for (int m = 0; m < BLOCK_MEMORY; m++)
			s->sums[m * s->lines + line] = dot[m];
	}
}

/* Poles that go with another go its way. */
SHARED_FUNCTION void block_follow(const block_state *s)
{
	STATE real *way = block_array(s, BLOCK_STATE_WAY);
	ROLLED
	for (int f = WORK_ITEM; f < s->followers; f += WORK_ITEMS)
		way[s->follower[2 * f]] = way[s->follower[2 * f + 1]];
	WAIT;
}

SHARED_FUNCTION real block_trial_objective(const block_state *s)
{
	const STATE real *trial = block_array(s, BLOCK_STATE_TRIAL);
	ROLLED
	for (int line = WORK_ITEM; line < s->count_v; line += WORK_ITEMS)
		s->terms[line] = net_line_objective(s, trial, line);
	WAIT;
	return net_terms_total(s);
}

#endif
