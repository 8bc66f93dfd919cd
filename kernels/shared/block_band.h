/* The table of a parabola whose variables are coupled with neighbours alone, a band: its factors and its bottom
 * (L D L^T). */
#ifndef BATTEN_SHARED_BLOCK_BAND_H
#define BATTEN_SHARED_BLOCK_BAND_H

#include "dialect.h"

/* A pivot below this part of its diagonal is rounding. */
#if BATTEN_DOUBLE
#define BLOCK_PIVOT_FLOOR LITERAL(1e-11)
#else
#define BLOCK_PIVOT_FLOOR LITERAL(1e-5)
#endif

/* Rows of `band` numbers, the diagonal first; the inverses of the pivots take its place when it is factored.
 * way: a number a row. */
typedef struct block_band {
	STATE stored *rows, *way;
	int count, band;
} block_band;

/* 1 / pivot, 0 where it is rounding: a variable that is held, or depends on those before it, has none. */
SHARED_FUNCTION real block_band_inverse(real pivot, real floor)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const mask has = (pivot > floor) & (pivot > zero);
	return CHOOSE(has, one / CHOOSE(has, pivot, one), zero);
}

/* Takes row n out of those below that it couples with, before row `end`, and puts the inverse of its pivot
 * there. */
SHARED_FUNCTION void block_band_eliminate(block_band table, int n, int end, real inverse)
{
	STATE stored *row = table.rows + n * table.band;
	const int reach = end - n < table.band ? end - n : table.band;
	ROLLED
	for (int d = 1; d < reach; d++) {
		STATE stored *below = row + d * (table.band - 1);
		const real factor = AT(row[d]) * inverse;
		ROLLED
		for (int e = d; e < reach; e++)
			AT(below[e]) -= factor * AT(row[e]);
	}
	AT(row[0]) = inverse;
}

/* Rows taken out of those below at a time, so that a number below is read and written once for all of them. */
enum { BLOCK_BAND_PIVOTS = 4 };

/* Takes factors of so many rows out of the numbers at `below`, in whose column each of them is pointed to: before
 * number `most`, the first row as far as it reaches, each after it one further. */
SHARED_FUNCTION void block_band_take_rows(STATE stored *below,
                                          const STATE stored *rows[BLOCK_BAND_PIVOTS],
                                          const real factors[BLOCK_BAND_PIVOTS], int count,
                                          int reach, int most)
{
	int e = 0;
	ROLLED
	for (; e < reach && e < most; e++) {
		real left = AT(below[e]);
		UNROLLED
		for (int p = 0; p < count; p++)
			left = FUSED(-factors[p], AT(rows[p][e]), left);
		AT(below[e]) = left;
	}
	UNROLLED
	for (int p = 1; p < count; p++) {
		ROLLED
		for (int over = e; over < reach + p && over < most; over++)
			AT(below[over]) = FUSED(-factors[p], AT(rows[p][over]), AT(below[over]));
	}
}

/* Takes so many rows from number n on, whose pivots are inverted, out of row m below them. */
SHARED_FUNCTION void block_band_take(block_band table, int n, int count, int m)
{
	const STATE stored *rows[BLOCK_BAND_PIVOTS];
	real factors[BLOCK_BAND_PIVOTS];
	UNROLLED
	for (int p = 0; p < count; p++) {
		const STATE stored *row = table.rows + (n + p) * table.band;
		const int d = m - n - p;
		rows[p] = row + d;
		factors[p] = d < table.band ? AT(row[d]) * AT(row[0]) : SPREAD(LITERAL(0.0));
	}
	block_band_take_rows(table.rows + m * table.band, rows, factors, count, table.band - (m - n),
	                     table.count - m);
}

/* Takes BLOCK_BAND_PIVOTS rows from number n on out of rows m and m + 1, which the first of them reaches. */
SHARED_FUNCTION void block_band_take_from_two(block_band table, int n, int m)
{
	STATE stored *below = table.rows + m * table.band;
	STATE stored *next = below + table.band - 1; /* in the same columns */
	const STATE stored *rows[BLOCK_BAND_PIVOTS];
	real factors[BLOCK_BAND_PIVOTS], next_factors[BLOCK_BAND_PIVOTS];
	UNROLLED
	for (int p = 0; p < BLOCK_BAND_PIVOTS; p++) {
		const STATE stored *row = table.rows + (n + p) * table.band;
		rows[p] = row + (m - n - p);
		factors[p] = AT(rows[p][0]) * AT(row[0]);
		next_factors[p] = AT(rows[p][1]) * AT(row[0]);
	}
	const int most = table.count - m;
	const int reach = table.band - (m - n);
	const int common = reach < most ? reach : most;
	real left = AT(below[0]);
	UNROLLED
	for (int p = 0; p < BLOCK_BAND_PIVOTS; p++)
		left = FUSED(-factors[p], AT(rows[p][0]), left);
	AT(below[0]) = left;
	ROLLED
	for (int e = 1; e < common; e++) {
		real other = AT(next[e]);
		left = AT(below[e]);
		UNROLLED
		for (int p = 0; p < BLOCK_BAND_PIVOTS; p++) {
			const real row = AT(rows[p][e]);
			left = FUSED(-factors[p], row, left);
			other = FUSED(-next_factors[p], row, other);
		}
		AT(below[e]) = left;
		AT(next[e]) = other;
	}
	UNROLLED
	for (int over = 0; over < BLOCK_BAND_PIVOTS - 1; over++)
		if (reach + over < most) {
			real other = AT(next[reach + over]);
			left = AT(below[reach + over]);
			UNROLLED
			for (int p = over + 1; p < BLOCK_BAND_PIVOTS; p++) {
				const real row = AT(rows[p][reach + over]);
				left = FUSED(-factors[p], row, left);
				other = FUSED(-next_factors[p], row, other);
			}
			AT(below[reach + over]) = left;
			AT(next[reach + over]) = other;
		}
}

/* Factors all rows; what of each pivot is rounding stands in way. */
SHARED_FUNCTION void block_band_factor(block_band table)
{
	ROLLED
	for (int n = 0; n < table.count; n += BLOCK_BAND_PIVOTS) {
		UNROLLED
		for (int p = 0; p < BLOCK_BAND_PIVOTS; p++)
			if (n + p < table.count) {
				STATE stored *pivot = table.rows + (n + p) * table.band;
				block_band_take(table, n, p, n + p);
				AT(*pivot) = block_band_inverse(AT(*pivot), AT(table.way[n + p]));
			}
		int m = n + BLOCK_BAND_PIVOTS;
		ROLLED
		for (; m + 1 < n + table.band && m + 1 < table.count; m += 2)
			block_band_take_from_two(table, n, m);
		ROLLED
		for (; m < n + BLOCK_BAND_PIVOTS - 1 + table.band && m < table.count; m++)
			block_band_take(table, n, BLOCK_BAND_PIVOTS, m);
	}
}

/* Takes so many rows from number n on out of the slopes after them. */
SHARED_FUNCTION void block_band_go_down(block_band table, int n, int count)
{
	const STATE stored *rows[BLOCK_BAND_PIVOTS];
	real parts[BLOCK_BAND_PIVOTS];
	UNROLLED
	for (int p = 0; p < count; p++) {
		const STATE stored *row = table.rows + (n + p) * table.band;
		real left = AT(table.way[n + p]);
		UNROLLED
		for (int q = 0; q < p; q++)
			if (p - q < table.band)
				left = FUSED(-parts[q], AT(rows[q][p - count]), left);
		AT(table.way[n + p]) = left;
		parts[p] = left * AT(row[0]);
		rows[p] = row + (count - p);
	}
	block_band_take_rows(table.way + n + count, rows, parts, count, table.band - count,
	                     table.count - n - count);
}

/* What the rows from number n on, so many, leave of their slopes where the bottom after them is known; then their own. */
SHARED_FUNCTION void block_band_go_up(block_band table, int n, int count)
{
	const STATE stored *rows[BLOCK_BAND_PIVOTS]; /* in the columns after them */
	real left[BLOCK_BAND_PIVOTS];
	const STATE stored *known = table.way + n + count;
	const int most = table.count - n - count;
	UNROLLED
	for (int p = 0; p < count; p++) {
		rows[p] = table.rows + ((n + p) * table.band + (count - p));
		left[p] = AT(table.way[n + p]);
	}
	int e = 0;
	ROLLED
	for (; e < table.band - count && e < most; e++) {
		UNROLLED
		for (int p = 0; p < count; p++)
			left[p] = FUSED(-AT(rows[p][e]), AT(known[e]), left[p]);
	}
	UNROLLED
	for (int p = 1; p < count; p++) {
		ROLLED
		for (int over = e; over < table.band - count + p && over < most; over++)
			left[p] = FUSED(-AT(rows[p][over]), AT(known[over]), left[p]);
	}
	UNROLLED
	for (int p = count - 1; p >= 0; p--) {
		UNROLLED
		for (int q = count - 1; q > p; q--)
			if (q - p < table.band)
				left[p] = FUSED(-AT(rows[p][q - count]), left[q], left[p]);
		left[p] = left[p] * AT(rows[p][p - count]);
		AT(table.way[n + p]) = left[p];
	}
}

/* The bottom of the parabola in the place of the slopes, which stand in way. */
SHARED_FUNCTION void block_band_solve(block_band table)
{
	int n = 0;
	ROLLED
	for (; n + BLOCK_BAND_PIVOTS <= table.count; n += BLOCK_BAND_PIVOTS)
		block_band_go_down(table, n, BLOCK_BAND_PIVOTS);
	ROLLED
	for (; n < table.count; n++)
		block_band_go_down(table, n, 1);
	ROLLED
	for (; n % BLOCK_BAND_PIVOTS != 0; n--)
		block_band_go_up(table, n - 1, 1);
	ROLLED
	for (; n > 0; n -= BLOCK_BAND_PIVOTS)
		block_band_go_up(table, n - BLOCK_BAND_PIVOTS, BLOCK_BAND_PIVOTS);
}

#endif
