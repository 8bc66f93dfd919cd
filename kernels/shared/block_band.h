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

/* The bottom of the parabola in the place of the slopes, which stand in way. */
SHARED_FUNCTION void block_band_solve(block_band table)
{
	ROLLED
	for (int n = 0; n < table.count; n++) {
		const STATE stored *row = table.rows + n * table.band;
		const int reach = table.count - n < table.band ? table.count - n : table.band;
		const real part = AT(table.way[n]) * AT(row[0]);
		ROLLED
		for (int d = 1; d < reach; d++)
			AT(table.way[n + d]) -= AT(row[d]) * part;
	}
	ROLLED
	for (int n = table.count - 1; n >= 0; n--) {
		const STATE stored *row = table.rows + n * table.band;
		const int reach = table.count - n < table.band ? table.count - n : table.band;
		real left = AT(table.way[n]);
		ROLLED
		for (int d = 1; d < reach; d++)
			left -= AT(row[d]) * AT(table.way[n + d]);
		AT(table.way[n]) = left * AT(row[0]);
	}
}

#endif
