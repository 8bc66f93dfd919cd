/* What the course of the block search asks of a net: slopes along all poles and the table of their common parabola,
 * by sum factorisation, first along u at every line of samples, then along v; its bottom; the objective. */
#ifndef BATTEN_SHARED_NET_BLOCK_TABLES_H
#define BATTEN_SHARED_NET_BLOCK_TABLES_H

#include "block_band.h"
#include "net_block_lines.h"

/* What the columns that a sample sees change of its numbers, as probed, by their values and derivatives along v: y_u and
 * y_uu are of the value, y_v and y_uv of the first derivative, y_vv of the second. */
SHARED_FUNCTION void net_change_columns(const block_state *s, const STATE stored *probed,
                                        int sample, STATE stored *to)
{
	GLOBAL const scalar *table = s->table_u + sample * NET_TABLE_SIZE(NET_ORDER_U);
	const STATE stored *last = probed + NET_BLOCK_LAST;
	const STATE stored *middle = probed + NET_BLOCK_MIDDLE;
	const STATE stored *first = probed + NET_BLOCK_FIRST;
	UNROLLED
	for (int a = 0; a < NET_ORDER_U; a++) {
		const real t0 = SPREAD(table[a]);
		const real t1 = SPREAD(table[NET_ORDER_U + a]);
		const real t2 = SPREAD(table[2 * NET_ORDER_U + a]);
		STATE stored *column = to + a * NET_BLOCK_COLUMN_SIZE;
		AT(column[NET_BLOCK_COLUMN_LAST]) = FUSED(t1, AT(last[0]), t2 * AT(last[2]));
		AT(column[NET_BLOCK_COLUMN_LAST + 1]) = FUSED(t0, AT(last[1]), t1 * AT(last[3]));
		AT(column[NET_BLOCK_COLUMN_LAST + 2]) = t0 * AT(last[4]);
		if (NET_BLOCK_BENDS) {
			AT(column[NET_BLOCK_COLUMN_MIDDLE]) = FUSED(t1, AT(middle[0]), t2 * AT(middle[2]));
			AT(column[NET_BLOCK_COLUMN_MIDDLE + 1]) = FUSED(t0, AT(middle[1]), t1 * AT(middle[3]));
			AT(column[NET_BLOCK_COLUMN_FIRST]) = FUSED(t1, AT(first[0]), t2 * AT(first[2]));
			AT(column[NET_BLOCK_COLUMN_FIRST + 1]) = t0 * AT(first[1]);
		}
		AT(column[NET_BLOCK_COLUMN_CLOSE]) = t0 * AT(probed[NET_BLOCK_CLOSE_CURVATURE]);
	}
}

/* Adds a sample to a pair of columns: products of what both change, those of LAST to `sums`, of the others to `bent`,
 * whose rows lie `apart`. own: of a column with itself half of them tell. */
SHARED_FUNCTION void net_add_pair(const block_state *s, const STATE stored *a,
                                  const STATE stored *b, int own, real close, real sums[9],
                                  real *bent, int apart)
{
	(void)s;
	UNROLLED
	for (int x = 0; x < 3; x++) {
		UNROLLED
		for (int y = own ? x : 0; y < 3; y++)
			sums[3 * x + y] = FUSED(AT(a[NET_BLOCK_COLUMN_LAST + x]),
			                        AT(b[NET_BLOCK_COLUMN_LAST + y]), sums[3 * x + y]);
	}
	sums[0] = FUSED(AT(a[NET_BLOCK_COLUMN_CLOSE]), close, sums[0]);
	UNROLLED
	for (int x = 0; x < (NET_BLOCK_BENDS ? 2 : 0); x++) {
		UNROLLED
		for (int y = own ? x : 0; y < 2; y++) {
			const real sum = FUSED(AT(a[NET_BLOCK_COLUMN_MIDDLE + x]),
			                       AT(b[NET_BLOCK_COLUMN_MIDDLE + y]), bent[apart * x + y]);
			bent[apart * x + y] = FUSED(AT(a[NET_BLOCK_COLUMN_FIRST + x]),
			                            AT(b[NET_BLOCK_COLUMN_FIRST + y]), sum);
		}
	}
}

enum { NET_PAIRS_MOST = 2 }; /* side by side: what they share is loaded once */

/* Adds the samples of a span, from number i on, to so many pairs of its columns from a and b on; those before number
 * `known` have some already. */
SHARED_FUNCTION void net_add_span(const block_state *s, const net_line *at, int i, int known, int a,
                                  int b, int count, int own)
{
	const real zero = SPREAD(LITERAL(0.0));
	GLOBAL const scalar *table = s->table_u + (i * NET_TABLE_SIZE(NET_ORDER_U) + b);
	STATE stored *pairs = at->pairs + ((s->first_u[i] + a) * NET_ORDER_U + (b - a)) * 9;
	real sums[NET_PAIRS_MOST][9];
	real bent[4] = { zero, zero, zero, zero };
	UNROLLED
	for (int c = 0; c < count; c++) {
		UNROLLED
		for (int n = 0; n < 9; n++)
			sums[c][n] = b + c < known ? AT(pairs[9 * c + n]) : zero;
	}
	UNROLLED
	for (int j = 0; j < NET_POINTS_U; j++) {
		const STATE stored *span = at->span + j * (NET_ORDER_U * NET_BLOCK_COLUMN_SIZE);
		UNROLLED
		for (int c = 0; c < count; c++)
			net_add_pair(s, span + a * NET_BLOCK_COLUMN_SIZE,
			             span + (b + c) * NET_BLOCK_COLUMN_SIZE, own,
			             SPREAD(table[j * NET_TABLE_SIZE(NET_ORDER_U) + c]), sums[c],
			             count == 1 ? bent : sums[c], count == 1 ? 2 : 3);
	}
	/* A pair alone has its sums in two parts, since a sum waits for each number added to it. */
	UNROLLED
	for (int n = 0; n < (NET_BLOCK_BENDS && count == 1 ? 4 : 0); n++)
		sums[0][n / 2 * 3 + n % 2] += bent[n];
	UNROLLED
	for (int c = 0; c < count; c++) {
		UNROLLED
		for (int n = 0; n < 9; n++)
			AT(pairs[9 * c + n]) = sums[c][own && n % 3 < n / 3 ? 3 * (n % 3) + n / 3 : n];
	}
}

/* Adds them to all pairs. */
SHARED_FUNCTION void net_add_pairs(const block_state *s, const net_line *at, int i, int known)
{
	ROLLED
	for (int a = 0; a < NET_ORDER_U; a++) {
		int b = a + 1;
		net_add_span(s, at, i, known, a, a, 1, 1);
		ROLLED
		for (; b + 1 < NET_ORDER_U; b += 2)
			net_add_span(s, at, i, known, a, b, 2, 0);
		if (b < NET_ORDER_U)
			net_add_span(s, at, i, known, a, b, 1, 0);
	}
}

/* Slopes along the columns that a sample sees, those along poles being their values and derivatives by v. */
SHARED_FUNCTION void net_add_slopes(const block_state *s, const STATE stored *probed, int sample,
                                    STATE stored *slopes)
{
	GLOBAL const scalar *table = s->table_u + sample * NET_TABLE_SIZE(NET_ORDER_U);
	const STATE stored *along = probed + NET_BLOCK_SLOPE;
	UNROLLED
	for (int a = 0; a < NET_ORDER_U; a++) {
		const real t0 = SPREAD(table[a]);
		const real t1 = SPREAD(table[NET_ORDER_U + a]);
		const real t2 = SPREAD(table[2 * NET_ORDER_U + a]);
		STATE stored *slope = slopes + 3 * a;
		AT(slope[0]) = FUSED(t0, AT(probed[NET_BLOCK_CLOSE_SLOPE]),
		                     FUSED(t1, AT(along[0]), FUSED(t2, AT(along[2]), AT(slope[0]))));
		AT(slope[1]) = FUSED(t0, AT(along[1]), FUSED(t1, AT(along[3]), AT(slope[1])));
		AT(slope[2]) = FUSED(t0, AT(along[4]), AT(slope[2]));
	}
}

/* Pairs of columns that no span of a line sees together, where columns from number `first` on come after those before
 * `end`. */
SHARED_FUNCTION void net_part_columns(const block_state *s, const net_line *at, int first, int end)
{
	const real zero = SPREAD(LITERAL(0.0));
	(void)s;
	ROLLED
	for (int b = end; b < first + NET_ORDER_U; b++) {
		ROLLED
		for (int a = b - NET_ORDER_U + 1 > 0 ? b - NET_ORDER_U + 1 : 0; a < first; a++) {
			STATE stored *pair = at->pairs + (a * NET_ORDER_U + (b - a)) * 9;
			for (int n = 0; n < 9; n++)
				AT(pair[n]) = zero;
		}
	}
}

/* Probes a line and sums along it. Returns its part of the objective. */
SHARED_FUNCTION real net_work_line(const block_state *s, int line, real part)
{
	const net_line at = net_line_of(s, line % s->slots);
	real sum = SPREAD(LITERAL(0.0));
	int end = 0; /* of the columns that samples before have seen */
	net_collapse_line(s, block_array(s, BLOCK_INPUT_START), line, at.columns);
	ROLLED
	for (int n = 0; n < 3 * s->lines; n++)
		AT(at.slopes[n]) = SPREAD(LITERAL(0.0));
	ROLLED
	for (int i = 0; i < s->count_u; i += NET_POINTS_U) {
		const int first = s->first_u[i];
		net_ready all[NET_POINTS_MOST];
		ROLLED
		for (int j = 0; j < NET_POINTS_U; j++)
			all[j] = net_ready_of(net_sample(s, line, i + j), net_way_at(s, at.columns, i + j),
			                      NET_BLOCK_BENDS);
		ROLLED
		for (int j = 0; j < NET_POINTS_U; j++) {
			STATE stored *probed = at.probes + j * NET_BLOCK_PROBED;
			net_ready ready = all[j];
			ready.forms.bends = NET_BLOCK_BENDS; /* known beforehand */
			sum += net_probe_sample(s, line, i + j, &ready, part, probed);
			net_add_slopes(s, probed, i + j, at.slopes + 3 * first);
			net_change_columns(s, probed, i + j,
			                   at.span + j * (NET_ORDER_U * NET_BLOCK_COLUMN_SIZE));
		}
		net_part_columns(s, &at, first, end);
		net_add_pairs(s, &at, i, end - first);
		end = first + NET_ORDER_U;
	}
	return sum;
}

/* Adds the pair of columns i and i + d, at the lines of a span from number `line` on, to the table. */
SHARED_FUNCTION void net_add_poles(const block_state *s, int line, int i, int d)
{
	const real zero = SPREAD(LITERAL(0.0));
	const int first = s->first_v[line];
	STATE stored *rows = s->rows + (i * s->length + first) * s->band + d * s->length;
	real sums[NET_ORDER_MOST * NET_ORDER_MOST];
	UNROLLED
	for (int n = 0; n < NET_ORDER_V * NET_ORDER_V; n++)
		sums[n] = zero;
	ROLLED
	for (int j = line; j < line + NET_POINTS_V; j++) {
		const STATE stored *pair = net_line_of(s, j % s->slots).pairs + (i * NET_ORDER_U + d) * 9;
		GLOBAL const scalar *t = s->table_v + j * NET_TABLE_SIZE(NET_ORDER_V);
		UNROLLED
		for (int m = 0; m < NET_ORDER_V; m++) {
			const real t0 = SPREAD(t[m]);
			const real t1 = SPREAD(t[NET_ORDER_V + m]);
			const real t2 = SPREAD(t[2 * NET_ORDER_V + m]);
			const real none = FUSED(AT(pair[2]), t2, FUSED(AT(pair[1]), t1, AT(pair[0]) * t0));
			const real once = FUSED(AT(pair[5]), t2, FUSED(AT(pair[4]), t1, AT(pair[3]) * t0));
			const real twice = FUSED(AT(pair[8]), t2, FUSED(AT(pair[7]), t1, AT(pair[6]) * t0));
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
			AT(rows[k * (s->band - 1) + m]) += sums[n];
	}
}

/* Adds the slopes of column i at the lines of a span to those along the poles. */
SHARED_FUNCTION void net_add_pole_slopes(const block_state *s, int line, int i)
{
	STATE stored *poles = s->bottom + i * s->length + s->first_v[line];
	ROLLED
	for (int j = line; j < line + NET_POINTS_V; j++) {
		const STATE stored *slope = net_line_of(s, j % s->slots).slopes + 3 * i;
		GLOBAL const scalar *t = s->table_v + j * NET_TABLE_SIZE(NET_ORDER_V);
		UNROLLED
		for (int k = 0; k < NET_ORDER_V; k++)
			AT(poles[k]) = FUSED(
				SPREAD(t[k]), AT(slope[0]),
				FUSED(SPREAD(t[NET_ORDER_V + k]), AT(slope[1]),
			          FUSED(SPREAD(t[2 * NET_ORDER_V + k]), AT(slope[2]), AT(poles[k]))));
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
SHARED_FUNCTION STATE stored *net_entry(const block_state *s, int a, int b)
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
		STATE stored *entry = net_entry(s, from, n);
		const real value = n == to ? AT(*entry) + AT(*entry) : AT(*entry);
		const int with = n == from ? to : n;
		AT(*entry) = zero;
		/* What lies outside the band is 0. */
		if (with - to < s->band && to - with < s->band)
			AT(*net_entry(s, to, with)) += value;
	}
	AT(s->bottom[to]) += AT(s->bottom[from]);
	AT(s->bottom[from]) = zero;
}

/* Completes the rows of a column and leaves them to be factored; what of a pivot is rounding stands where the way
 * will be. */
SHARED_FUNCTION void net_settle_line(const block_state *s, int line, int turn, block_stay stay)
{
	block_products sums = block_products_none();
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		STATE stored *pivot = s->rows + n * s->band;
		(void)block_settle_row(s, n, turn, stay, AT(s->bottom[n]), AT(*pivot), &sums);
		AT(*pivot) = AT(block_array(s, BLOCK_STATE_INVERSE)[n]);
		AT(s->bottom[n]) = SPREAD(BLOCK_PIVOT_FLOOR) * AT(*pivot);
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

/* Probes all samples and sums up to the slopes along the poles and their table. */
SHARED_FUNCTION void net_gather(const block_state *s, real part)
{
	const real zero = SPREAD(LITERAL(0.0));
	ROLLED
	for (int n = WORK_ITEM; n < (s->band + 1) * s->nodes; n += WORK_ITEMS)
		AT(s->rows[n]) = zero;
	ROLLED
	for (int first = 0; first < s->count_v; first += s->slots) {
		const int end = first + s->slots < s->count_v ? first + s->slots : s->count_v;
		ROLLED
		for (int line = first + WORK_ITEM; line < end; line += WORK_ITEMS)
			AT(s->terms[line]) = net_work_line(s, line, part);
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
		total += AT(s->terms[line]);
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
		block_band_factor(net_band(s));
	WAIT;
	return net_terms_total(s);
}

SHARED_FUNCTION void block_solve(const block_state *s, int turn, const real *alpha)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *self = block_array(s, BLOCK_STATE_INVERSE);
	STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		AT(s->bottom[n]) = CHOOSE(AT(self[n]) > zero, block_slope_left(s, n, turn, alpha), zero);
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
			AT(way[n]) = AT(s->bottom[n]);
			for (int m = 0; m < BLOCK_MEMORY; m++)
				dot[m] += AT(way[n]) *
				          AT(block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, m))[n]);
		}
		for (int m = 0; m < BLOCK_MEMORY; m++)
			AT(s->sums[m * s->lines + line]) = dot[m];
	}
}

/* Poles that go with another go its way. */
SHARED_FUNCTION void block_follow(const block_state *s)
{
	STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	ROLLED
	for (int f = WORK_ITEM; f < s->followers; f += WORK_ITEMS)
		AT(way[s->follower[2 * f]]) = AT(way[s->follower[2 * f + 1]]);
	WAIT;
}

SHARED_FUNCTION real block_trial_objective(const block_state *s)
{
	const STATE stored *trial = block_array(s, BLOCK_STATE_TRIAL);
	ROLLED
	for (int line = WORK_ITEM; line < s->count_v; line += WORK_ITEMS)
		AT(s->terms[line]) = net_line_objective(s, trial, line);
	WAIT;
	return net_terms_total(s);
}

#endif
