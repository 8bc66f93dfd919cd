/* What a block search knows of each of its variables, whatever couples them: its slope and how that changed,
 * whether it is free. The includer has block_state, and block_array() that finds the arrays of block_layout.h. */
#ifndef BATTEN_SHARED_BLOCK_ROWS_H
#define BATTEN_SHARED_BLOCK_ROWS_H

#include "block_layout.h"
#include "dialect.h"

/* Values of one search a lane: of settings. */
typedef struct block_limits {
	real longest, last_step, far;
	real fair, close;
} block_limits;

/* What holds a search where it is: diagonals are raised by a part of them and by a weight. */
typedef struct block_stay {
	real part, weight;
} block_stay;

/* The array of a pair of `age` iterations before the newest; arrays go round. */
SHARED_FUNCTION int block_slot(int turn, int age)
{
	return (turn + 2 * BLOCK_MEMORY - 1 - age) % BLOCK_MEMORY;
}

/* The slope along a variable less the changes remembered, alpha of each. */
SHARED_FUNCTION real block_slope_left(const block_state *s, int n, int turn, const real *alpha)
{
	const real zero = SPREAD(LITERAL(0.0));
	real left = AT(block_array(s, BLOCK_STATE_SLOPE)[n]);
	for (int m = 0; m < BLOCK_MEMORY; m++) {
		const real change = AT(block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, m))[n]);
		left -= CHOOSE(alpha[m] != zero, alpha[m] * change, zero);
	}
	return left;
}

/* What the pattern move wants of the slopes: products with the moves remembered. */
typedef struct block_products {
	real slope[BLOCK_MEMORY];  /* move . slope, newest first */
	real change[BLOCK_MEMORY]; /* move . change of the slope since the iteration before */
	real changed;              /* variables that are held now and were not, or the other way */
} block_products;

/* A sum of all lines, in their order; the largest of theirs. */
SHARED_FUNCTION real block_total(const block_state *s, int sum)
{
	real total = SPREAD(LITERAL(0.0));
	ROLLED
	for (int line = 0; line < s->lines; line++)
		total += AT(s->sums[sum * s->lines + line]);
	return total;
}

SHARED_FUNCTION real block_most(const block_state *s, int sum)
{
	real most = SPREAD(LITERAL(0.0));
	ROLLED
	for (int line = 0; line < s->lines; line++) {
		const real value = AT(s->sums[sum * s->lines + line]);
		most = CHOOSE(value > most, value, most);
	}
	return most;
}

/* Products of no row yet. */
SHARED_FUNCTION block_products block_products_none(void)
{
	block_products sums;
	for (int m = 0; m < BLOCK_MEMORY; m++)
		sums.slope[m] = sums.change[m] = SPREAD(LITERAL(0.0));
	sums.changed = SPREAD(LITERAL(0.0));
	return sums;
}

/* Those of a line, for the pattern move. */
SHARED_FUNCTION void block_products_tell(const block_state *s, int line, const block_products *sums)
{
	for (int m = 0; m < BLOCK_MEMORY; m++) {
		AT(s->sums[m * s->lines + line]) = sums->slope[m];
		AT(s->sums[(BLOCK_MEMORY + m) * s->lines + line]) = sums->change[m];
	}
	AT(s->sums[2 * BLOCK_MEMORY * s->lines + line]) = sums->changed;
}

/* Takes the slope and the diagonal of row n: the bounds, the weight of staying, the change of the slope. Leaves
 * the diagonal in the place of the inverse of its pivot, 0 where it is held. Returns where it is free. */
SHARED_FUNCTION mask block_settle_row(const block_state *s, int n, int turn, block_stay stay,
                                      real slope_here, real diagonal, block_products *sums)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real y = AT(block_array(s, BLOCK_INPUT_START)[n]);
	const real lower = AT(block_array(s, BLOCK_INPUT_LOWER)[n]);
	const real upper = AT(block_array(s, BLOCK_INPUT_UPPER)[n]);
	const mask down = (y > lower) & (slope_here >= zero);
	const mask up = (y < upper) & (slope_here <= zero);
	const mask is_free = (diagonal > zero) & (down | up);
	const real raised = diagonal + (stay.part * diagonal + stay.weight);
	STATE stored *slope = block_array(s, BLOCK_STATE_SLOPE) + n;
	const real change = slope_here - AT(*slope);
	STATE stored *self = block_array(s, BLOCK_STATE_INVERSE) + n;
	const mask differs = is_free != (AT(*self) > zero);
	sums->changed += CHOOSE(differs, SPREAD(LITERAL(1.0)), zero);
	AT(*self) = CHOOSE(is_free, raised, zero);
	AT(*slope) = slope_here;
	AT(block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, 0))[n]) = change;
	for (int m = 0; m < BLOCK_MEMORY; m++) {
		const real move = AT(block_array(s, BLOCK_STATE_MOVE + block_slot(turn, m))[n]);
		sums->slope[m] += move * slope_here;
		sums->change[m] += move * change;
	}
	return is_free;
}

#endif
