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
 * factors go. A held row has 0 on its diagonal, couples with nothing, whatever lies there, and has no pivot. */
SHARED_FUNCTION void block_factor_row(const block_state *s, int n, block_factor *f)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	STATE stored *inverse = block_array(s, BLOCK_STATE_INVERSE) + n;
	STATE stored *factor_1 = block_array(s, BLOCK_STATE_FACTOR_1) + n;
	STATE stored *factor_2 = block_array(s, BLOCK_STATE_FACTOR_2) + n;
	const real self = AT(*inverse);
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
	f->next = CHOOSE(has, AT(*factor_1), zero);
	f->over_2 = f->over_1;
	f->over_1 = CHOOSE(has, AT(*factor_2), zero);
	AT(*inverse) = f->inverse_1;
	AT(*factor_1) = by_1;
	AT(*factor_2) = by_2;
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

/* Completes row n: closeness and what all rows have; leaves it to be factored, its own diagonal where the trial
 * will be. */
SHARED_FUNCTION void block_finish_row(const block_state *s, int n, int turn, block_stay stay,
                                      block_row row, block_products *sums)
{
	const real two = SPREAD(LITERAL(2.0));
	const real y = AT(block_array(s, BLOCK_INPUT_START)[n]);
	const real close = two * AT(block_array(s, BLOCK_INPUT_CLOSE)[n]);
	row.self += close;
	row.slope += close * (y - AT(block_array(s, BLOCK_INPUT_TARGET)[n]));
	(void)block_settle_row(s, n, turn, stay, row.slope, row.self, sums);
	AT(block_array(s, BLOCK_STATE_FACTOR_1)[n]) = row.next;
	AT(block_array(s, BLOCK_STATE_FACTOR_2)[n]) = row.over;
	AT(block_array(s, BLOCK_STATE_TRIAL)[n]) = row.self;
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

/* What a walk along a line that solves its system takes from row to row: forth, from the two rows before;
 * back, what the rows above pull this one and the one below it. */
typedef struct block_carry {
	real one, two;
} block_carry;

SHARED_FUNCTION real block_solve_forth(const block_state *s, int n, real slope, block_carry *c)
{
	const real z = (slope - AT(block_array(s, BLOCK_STATE_FACTOR_2)[n]) * c->two) -
	               AT(block_array(s, BLOCK_STATE_FACTOR_1)[n]) * c->one;
	c->two = c->one;
	c->one = z;
	return z;
}

SHARED_FUNCTION real block_solve_back(const block_state *s, int n, real z, block_carry *c)
{
	const real bottom = z * AT(block_array(s, BLOCK_STATE_INVERSE)[n]) - c->one;
	c->one = AT(block_array(s, BLOCK_STATE_FACTOR_1)[n]) * bottom + c->two;
	c->two = AT(block_array(s, BLOCK_STATE_FACTOR_2)[n]) * bottom;
	return bottom;
}

/* The slopes of a line less the changes remembered, alpha of each, into its way. */
SHARED_FUNCTION void block_lessen_line(const block_state *s, int line, int turn, const real *alpha)
{
	STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++)
		AT(way[n]) = block_slope_left(s, n, turn, alpha);
}

/* The bottom of the line's parabola with the slope less the changes remembered, alpha of each, and what
 * the hats have beyond it. Products with the changes go into the sums. */
SHARED_FUNCTION void block_solve_line(const block_state *s, int line, int turn, const real *alpha)
{
	const real zero = SPREAD(LITERAL(0.0));
	const int first = line * s->length;
	STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	block_carry forth = { zero, zero }, back = { zero, zero };
	ROLLED
	for (int n = first; n < first + s->length; n++)
		AT(way[n]) = block_solve_forth(s, n, block_slope_left(s, n, turn, alpha), &forth);
	real dot[BLOCK_MEMORY];
	for (int m = 0; m < BLOCK_MEMORY; m++)
		dot[m] = zero;
	ROLLED
	for (int n = first + s->length - 1; n >= first; n--) {
		const real bottom = block_solve_back(s, n, AT(way[n]), &back);
		const real whole = s->hats == 0 ? bottom : bottom + block_hats_beyond(s, line, n - first);
		AT(way[n]) = whole;
		for (int m = 0; m < BLOCK_MEMORY; m++)
			dot[m] += whole * AT(block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, m))[n]);
	}
	for (int m = 0; m < BLOCK_MEMORY; m++)
		AT(s->sums[m * s->lines + line]) = dot[m];
}

#endif
