/* The exploratory move of the block search, one line of offsets at a time: the table of the line's
 * parabola, which has five diagonals, its factors, and the bottom of the parabola. Offsets at a bound
 * that the slope pushes against are held: their rows are taken out of the table. */
#ifndef BATTEN_SHARED_BLOCK_TABLES_H
#define BATTEN_SHARED_BLOCK_TABLES_H

#include "block_hats.h"

/* Lines whose rows are factored side by side. */
#if BATTEN_LANES > 1
enum { BLOCK_TOGETHER = 4 };
#else
enum { BLOCK_TOGETHER = 1 };
#endif

/* A row of a line's table as it is gathered. */
typedef struct block_row {
	real slope, self, next, over;
} block_row;

/* Factors of the rows before, as the next one needs them. */
typedef struct block_factor {
	real inverse_1, inverse_2; /* pivots one and two rows before */
	real factor;               /* of the row before with the one before that */
	real next, over_1, over_2; /* what couples the rows before with this one and the next */
} block_factor;

/* Factors row n, whose diagonal, coupling with the next row and with the one after that lie where the
 * factors go. A held row has 0 on its diagonal, couples with nothing and has no pivot. */
SHARED_FUNCTION void block_factor_row(const block_state *s, int n, block_factor *f)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	STATE real *inverse = block_array(s, BLOCK_STATE_INVERSE) + n;
	STATE real *factor_1 = block_array(s, BLOCK_STATE_FACTOR_1) + n;
	STATE real *factor_2 = block_array(s, BLOCK_STATE_FACTOR_2) + n;
	const real self = *inverse;
	const mask has = self > zero;
	const real over = CHOOSE(has, f->over_2, zero);
	const real next = CHOOSE(has, f->next - f->factor * over, zero);
	const real by_2 = over * f->inverse_2;
	const real by_1 = next * f->inverse_1;
	const real pivot = (self - by_2 * over) - by_1 * next;
	const real sound = CHOOSE(pivot > SPREAD(BLOCK_PIVOT_FLOOR) * self, pivot, self);
	f->inverse_2 = f->inverse_1;
	f->inverse_1 = CHOOSE(has, one / CHOOSE(has, sound, one), zero);
	f->factor = by_1;
	f->next = *factor_1;
	f->over_2 = f->over_1;
	f->over_1 = *factor_2;
	*inverse = f->inverse_1;
	*factor_1 = by_1;
	*factor_2 = by_2;
}

/* Factors the tables of `count` lines, at most BLOCK_TOGETHER, from `first` on, `apart` lines one from
 * the other. Every row waits for the one before: rows of several lines wait side by side. */
SHARED_FUNCTION void block_factor_lines(const block_state *s, int first, int apart, int count)
{
	const real zero = SPREAD(LITERAL(0.0));
	block_factor factors[BLOCK_TOGETHER];
	for (int i = 0; i < BLOCK_TOGETHER; i++) {
		factors[i].inverse_1 = factors[i].inverse_2 = factors[i].factor = zero;
		factors[i].next = factors[i].over_1 = factors[i].over_2 = zero;
	}
	if (count == BLOCK_TOGETHER) {
		ROLLED
		for (int k = 0; k < s->length; k++)
			for (int i = 0; i < BLOCK_TOGETHER; i++)
				block_factor_row(s, (first + i * apart) * s->length + k, &factors[i]);
		return;
	}
	ROLLED
	for (int i = 0; i < count; i++) {
		block_factor f = factors[0];
		ROLLED
		for (int k = 0; k < s->length; k++)
			block_factor_row(s, (first + i * apart) * s->length + k, &f);
	}
}

/* Completes row n: closeness and what all rows have; leaves it to be factored. */
SHARED_FUNCTION void block_finish_row(const block_state *s, int n, int turn, block_stay stay,
                                      block_row row, block_products *sums)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real two = SPREAD(LITERAL(2.0));
	const real y = block_array(s, BLOCK_INPUT_START)[n];
	const real close = two * block_array(s, BLOCK_INPUT_CLOSE)[n];
	row.self += close;
	row.slope += close * (y - block_array(s, BLOCK_INPUT_TARGET)[n]);
	const mask is_free = block_settle_row(s, n, turn, stay, row.slope, row.self, sums);
	block_array(s, BLOCK_STATE_FACTOR_1)[n] = CHOOSE(is_free, row.next, zero);
	block_array(s, BLOCK_STATE_FACTOR_2)[n] = CHOOSE(is_free, row.over, zero);
}

/* Slopes and the table of one line, whose probes and those beside it are in the ring. */
SHARED_FUNCTION void block_gather_line(const block_state *s, int line, int turn, block_stay stay)
{
	const real zero = SPREAD(LITERAL(0.0));
	block_row row = { zero, zero, zero, zero };
	block_row above = row;
	block_products sums = block_products_none();
	const block_sides sides = block_sides_of(s, line);
	ROLLED
	for (int k = 1; k <= s->length; k++) {
		const block_terms t = block_terms_at(s, &sides, k);
		row.slope += t.slope_below;
		row.self += t.self_below;
		row.next += t.below_here;
		row.over = t.below_above;
		block_finish_row(s, line * s->length + k - 1, turn, stay, row, &sums);
		row.slope = above.slope + t.slope_here;
		row.self = above.self + t.self_here;
		row.next = t.here_above;
		above.slope = t.slope_above;
		above.self = t.self_above;
	}
	block_products_tell(s, line, &sums);
}

/* The bottom of the line's parabola with the slope less the changes remembered, alpha of each, and what
 * the hats have beyond it. Products with the changes go into the sums. */
SHARED_FUNCTION void block_solve_line(const block_state *s, int line, int turn, const real *alpha)
{
	const real zero = SPREAD(LITERAL(0.0));
	const int first = line * s->length;
	const STATE real *inverse = block_array(s, BLOCK_STATE_INVERSE);
	const STATE real *factor_1 = block_array(s, BLOCK_STATE_FACTOR_1);
	const STATE real *factor_2 = block_array(s, BLOCK_STATE_FACTOR_2);
	STATE real *way = block_array(s, BLOCK_STATE_WAY);
	real one_before = zero, two_before = zero;
	ROLLED
	for (int n = first; n < first + s->length; n++) {
		real z = block_slope_left(s, n, turn, alpha);
		z = (z - factor_2[n] * two_before) - factor_1[n] * one_before;
		two_before = one_before;
		one_before = z;
		way[n] = z;
	}
	real dot[BLOCK_MEMORY];
	for (int m = 0; m < BLOCK_MEMORY; m++)
		dot[m] = zero;
	real pull_1 = zero, pull_2 = zero; /* of the rows above on this one and on the one below it */
	ROLLED
	for (int n = first + s->length - 1; n >= first; n--) {
		const real bottom = way[n] * inverse[n] - pull_1;
		pull_1 = factor_1[n] * bottom + pull_2;
		pull_2 = factor_2[n] * bottom;
		const real whole = s->hats == 0 ? bottom : bottom + block_hats_beyond(s, line, n - first);
		way[n] = whole;
		for (int m = 0; m < BLOCK_MEMORY; m++)
			dot[m] += whole * block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, m))[n];
	}
	for (int m = 0; m < BLOCK_MEMORY; m++)
		s->sums[m * s->lines + line] = dot[m];
}

#endif
