/* The exploratory move of the block search, one line of offsets at a time: from the probes of three
 * neighbouring lines of nodes the slope of the objective along every offset of a line and the table of
 * its parabola, which has five diagonals; the table's factors; the bottom of the parabola. Offsets at a
 * bound that the slope pushes against are held: their rows are taken out of the table. */
#ifndef BATTEN_SHARED_BLOCK_LINES_H
#define BATTEN_SHARED_BLOCK_LINES_H

#include "block_probes.h"

/* A pivot below this part of its diagonal is rounding. */
#if BATTEN_DOUBLE
#define BLOCK_PIVOT_FLOOR LITERAL(1e-11)
#else
#define BLOCK_PIVOT_FLOOR LITERAL(1e-5)
#endif

typedef struct block_state {
	int lines, length, nodes;
	int slots; /* lines that the ring of probes has room for */
	int analytic;
	GLOBAL const scalar *across, *along; /* STENCIL_SIZE a line, a node of a line */
	STATE real *arrays;                  /* [BLOCK_STATE_COUNT][nodes] */
	STATE real *ring;                    /* [slots][length][BLOCK_PROBE_COUNT] */
	LOCAL real *sums;                    /* [BLOCK_SUM_COUNT][lines] */
} block_state;

SHARED_FUNCTION STATE real *block_array(const block_state *s, int array)
{
	return s->arrays + array * s->nodes;
}

SHARED_FUNCTION node_slopes block_slopes_at(const block_state *s, STATE const real *y, int line,
                                            int k)
{
	node_stencil stencil;
	for (int w = 0; w < STENCIL_SIZE; w++) {
		stencil.x[w] = s->across[line * STENCIL_SIZE + w];
		stencil.z[w] = s->along[k * STENCIL_SIZE + w];
	}
	const STATE real *h = y + (line * s->length + k);
	const STATE real *aft = h - s->length;
	const STATE real *fore = h + s->length;
	const node_row below = { aft[-1], h[-1], fore[-1] };
	const node_row here = { aft[0], h[0], fore[0] };
	const node_row above = { aft[1], h[1], fore[1] };
	return slopes_of(stencil, below, here, above);
}

SHARED_FUNCTION int block_is_inside(int at, int count)
{
	return at > 0 && at + 1 < count;
}

/* A line's part of the objective at y. */
SHARED_FUNCTION real block_line_objective(const block_state *s, STATE const real *y, int line)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE real *bend = block_array(s, BLOCK_INPUT_BEND) + line * s->length;
	const STATE real *close = block_array(s, BLOCK_INPUT_CLOSE) + line * s->length;
	const STATE real *target = block_array(s, BLOCK_INPUT_TARGET) + line * s->length;
	const int inside = block_is_inside(line, s->lines);
	real sum = zero;
	ROLLED
	for (int k = 0; k < s->length; k++) {
		const real off = y[line * s->length + k] - target[k];
		if (inside && block_is_inside(k, s->length)) {
			const real energy = bend[k] * bending_density(block_slopes_at(s, y, line, k));
			sum += CHOOSE(bend[k] > zero, energy, zero);
		}
		sum += close[k] * (off * off);
	}
	return sum;
}

SHARED_FUNCTION STATE real *block_ring(const block_state *s, int line, int k)
{
	return s->ring + ((line % s->slots) * s->length + k) * BLOCK_PROBE_COUNT;
}

SHARED_FUNCTION void block_keep(STATE real *to, block_probes found, real bend)
{
	const mask has = bend > SPREAD(LITERAL(0.0));
	const real zero = SPREAD(LITERAL(0.0));
	to[BLOCK_PROBE_P] = CHOOSE(has, bend * found.p, zero);
	to[BLOCK_PROBE_Q] = CHOOSE(has, bend * found.q, zero);
	to[BLOCK_PROBE_R] = CHOOSE(has, bend * found.r, zero);
	to[BLOCK_PROBE_S] = CHOOSE(has, bend * found.s, zero);
	to[BLOCK_PROBE_T] = CHOOSE(has, bend * found.t, zero);
	to[BLOCK_PROBE_RR] = CHOOSE(has, bend * found.rr, zero);
	to[BLOCK_PROBE_SS] = CHOOSE(has, bend * found.ss, zero);
	to[BLOCK_PROBE_TT] = CHOOSE(has, bend * found.tt, zero);
	to[BLOCK_PROBE_RS] = CHOOSE(has, bend * found.rs, zero);
	to[BLOCK_PROBE_RT] = CHOOSE(has, bend * found.rt, zero);
	to[BLOCK_PROBE_ST] = CHOOSE(has, bend * found.st, zero);
}

/* Probes a line of nodes. Returns the line's part of the objective at y. */
SHARED_FUNCTION real block_probe_line(const block_state *s, int line, real far)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE real *y = block_array(s, BLOCK_INPUT_START);
	const STATE real *bend = block_array(s, BLOCK_INPUT_BEND) + line * s->length;
	const STATE real *close = block_array(s, BLOCK_INPUT_CLOSE) + line * s->length;
	const STATE real *target = block_array(s, BLOCK_INPUT_TARGET) + line * s->length;
	const int inside = block_is_inside(line, s->lines);
	real sum = zero;
	ROLLED
	for (int k = 0; k < s->length; k++) {
		const real off = y[line * s->length + k] - target[k];
		if (inside && block_is_inside(k, s->length)) {
			const node_slopes at = block_slopes_at(s, y, line, k);
			const block_probes found = BLOCK_ANALYTIC ? block_derive(at) : block_probe(at, far);
			block_keep(block_ring(s, line, k), found, bend[k]);
			sum += CHOOSE(bend[k] > zero, bend[k] * found.value, zero);
		}
		sum += close[k] * (off * off);
	}
	return sum;
}

/* What the term of one node, or of three side by side, adds to a line: to the slopes of the offsets
 * below, at and above it, to the diagonal, to what couples neighbours, and those one apart. */
typedef struct block_terms {
	real slope_below, slope_here, slope_above;
	real self_below, self_here, self_above;
	real below_here, here_above, below_above;
} block_terms;

/* A line's stencils at a node: of the mixed and of the second derivative. */
typedef struct block_stencil {
	scalar first_below, first_here, first_above;
	scalar second_below, second_here, second_above;
} block_stencil;

SHARED_FUNCTION block_stencil block_stencil_of(GLOBAL const scalar *w)
{
	block_stencil b;
	b.first_below = -w[0];
	b.first_here = w[0] - w[1];
	b.first_above = w[1];
	b.second_below = w[2];
	b.second_here = -(w[2] + w[3]);
	b.second_above = w[3];
	return b;
}

/* first, second: weights that the line's offset has in the first and the second derivative across. */
SHARED_FUNCTION void block_add_across(block_terms *t, const STATE real *probes, scalar first,
                                      scalar second, block_stencil b)
{
	const real slope = second * probes[BLOCK_PROBE_R] + first * probes[BLOCK_PROBE_P];
	const real mixed = first * probes[BLOCK_PROBE_S];
	const real rr = (second * second) * probes[BLOCK_PROBE_RR];
	const real rs = (second * first) * probes[BLOCK_PROBE_RS];
	const real ss = (first * first) * probes[BLOCK_PROBE_SS];
	const real here = rs + b.first_here * ss;
	t->slope_below += b.first_below * mixed;
	t->slope_here += slope + b.first_here * mixed;
	t->slope_above += b.first_above * mixed;
	t->self_below += (b.first_below * b.first_below) * ss;
	t->self_here += rr + b.first_here * (rs + here);
	t->self_above += (b.first_above * b.first_above) * ss;
	t->below_here += b.first_below * here;
	t->here_above += b.first_above * here;
	t->below_above += (b.first_below * b.first_above) * ss;
}

/* What the line's own nodes add beyond that: the derivatives along it. */
SHARED_FUNCTION void block_add_along(block_terms *t, const STATE real *probes, scalar first,
                                     scalar second, block_stencil b)
{
	const real two = SPREAD(LITERAL(2.0));
	const real q = probes[BLOCK_PROBE_Q];
	const real u = probes[BLOCK_PROBE_T];
	const real tt = probes[BLOCK_PROBE_TT];
	const real rt = second * probes[BLOCK_PROBE_RT];
	const real st = first * probes[BLOCK_PROBE_ST];
	const real cross = rt + b.first_here * st;
	const real here = b.second_here * tt + cross;
	t->slope_below += b.first_below * q + b.second_below * u;
	t->slope_here += b.first_here * q + b.second_here * u;
	t->slope_above += b.first_above * q + b.second_above * u;
	t->self_below += b.second_below * (b.second_below * tt + two * (b.first_below * st));
	t->self_here += b.second_here * (here + cross);
	t->self_above += b.second_above * (b.second_above * tt + two * (b.first_above * st));
	t->below_here += b.second_below * here + (b.second_here * b.first_below) * st;
	t->here_above += b.second_above * here + (b.second_here * b.first_above) * st;
	t->below_above += (b.second_below * b.second_above) * tt +
	                  (b.first_below * b.second_above + b.first_above * b.second_below) * st;
}

/* The terms of node k of a line and of those beside it, as the line feels them. */
SHARED_FUNCTION block_terms block_terms_at(const block_state *s, int line, int k)
{
	const real zero = SPREAD(LITERAL(0.0));
	block_terms t = { zero, zero, zero, zero, zero, zero, zero, zero, zero };
	if (!block_is_inside(k, s->length))
		return t;
	const block_stencil b = block_stencil_of(s->along + k * STENCIL_SIZE);
	GLOBAL const scalar *w = s->across + line * STENCIL_SIZE;
	if (block_is_inside(line, s->lines)) {
		const STATE real *probes = block_ring(s, line, k);
		const scalar first = w[0] - w[1];
		const scalar second = -(w[2] + w[3]);
		block_add_across(&t, probes, first, second, b);
		block_add_along(&t, probes, first, second, b);
	}
	if (line > 1)
		block_add_across(&t, block_ring(s, line - 1, k), w[1 - STENCIL_SIZE], w[3 - STENCIL_SIZE],
		                 b);
	if (line + 2 < s->lines)
		block_add_across(&t, block_ring(s, line + 1, k), -w[STENCIL_SIZE], w[2 + STENCIL_SIZE], b);
	return t;
}

/* A row of a line's table as it is gathered, and the factors of the rows before. */
typedef struct block_row {
	real slope, self, next, over;
} block_row;
typedef struct block_factor {
	real inverse_1, inverse_2; /* pivots one and two rows before */
	real factor;               /* of the row before with the one before that */
	real next, over_1, over_2; /* what couples the rows before with this one and the next */
} block_factor;

/* Factors row n; a held row couples with nothing and has no pivot. */
SHARED_FUNCTION void block_factor_row(const block_state *s, int n, block_row row, mask is_free,
                                      block_factor *f)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real over = CHOOSE(is_free, f->over_2, zero);
	const real next = CHOOSE(is_free, f->next, zero) - f->factor * over;
	const real factor_2 = over * f->inverse_2;
	const real factor_1 = next * f->inverse_1;
	const real pivot = row.self - (factor_2 * over + factor_1 * next);
	const real sound = CHOOSE(pivot > SPREAD(BLOCK_PIVOT_FLOOR) * row.self, pivot, row.self);
	const mask has = is_free & (sound > zero);
	const real inverse = CHOOSE(has, one / CHOOSE(has, sound, one), zero);
	block_array(s, BLOCK_STATE_INVERSE)[n] = inverse;
	block_array(s, BLOCK_STATE_FACTOR_1)[n] = factor_1;
	block_array(s, BLOCK_STATE_FACTOR_2)[n] = factor_2;
	f->inverse_2 = f->inverse_1;
	f->inverse_1 = inverse;
	f->factor = factor_1;
	f->next = row.next;
	f->over_2 = f->over_1;
	f->over_1 = row.over;
}

/* What the pattern move wants of the slopes: products with the moves remembered. */
typedef struct block_products {
	real slope[BLOCK_MEMORY];  /* move . slope, newest first */
	real change[BLOCK_MEMORY]; /* move . change of the slope since the iteration before */
	real changed;              /* offsets that are held now and were not, or the other way */
} block_products;

/* The array of a pair of `age` iterations before the newest; arrays go round. */
SHARED_FUNCTION int block_slot(int turn, int age)
{
	return (turn + 2 * BLOCK_MEMORY - 1 - age) % BLOCK_MEMORY;
}

/* Completes row n: closeness, the bounds, the change of the slope; then factors it. */
SHARED_FUNCTION void block_finish_row(const block_state *s, int n, int turn, real damping,
                                      block_row row, block_factor *f, block_products *sums)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real two = SPREAD(LITERAL(2.0));
	const real y = block_array(s, BLOCK_INPUT_START)[n];
	const real lower = block_array(s, BLOCK_INPUT_LOWER)[n];
	const real upper = block_array(s, BLOCK_INPUT_UPPER)[n];
	const real close = two * block_array(s, BLOCK_INPUT_CLOSE)[n];
	row.self += close;
	row.slope += close * (y - block_array(s, BLOCK_INPUT_TARGET)[n]);
	const mask down = (y > lower) & (row.slope >= zero);
	const mask up = (y < upper) & (row.slope <= zero);
	const mask is_free = (row.self > zero) & (down | up);
	row.self += damping * row.self;
	STATE real *slope = block_array(s, BLOCK_STATE_SLOPE) + n;
	const real change = row.slope - *slope;
	const real before = block_array(s, BLOCK_STATE_INVERSE)[n];
	block_factor_row(s, n, row, is_free, f);
	const real now = block_array(s, BLOCK_STATE_INVERSE)[n];
	const mask differs = ((before > zero) & (now == zero)) | ((now > zero) & (before == zero));
	sums->changed += CHOOSE(differs, SPREAD(LITERAL(1.0)), zero);
	*slope = row.slope;
	block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, 0))[n] = change;
	for (int m = 0; m < BLOCK_MEMORY; m++) {
		const real move = block_array(s, BLOCK_STATE_MOVE + block_slot(turn, m))[n];
		sums->slope[m] += move * row.slope;
		sums->change[m] += move * change;
	}
}

/* Slopes and the factored table of one line, whose probes and those beside it are in the ring. */
SHARED_FUNCTION void block_gather_line(const block_state *s, int line, int turn, real damping)
{
	const real zero = SPREAD(LITERAL(0.0));
	block_row row = { zero, zero, zero, zero };
	block_row above = row;
	block_factor factor = { zero, zero, zero, zero, zero, zero };
	block_products sums;
	for (int m = 0; m < BLOCK_MEMORY; m++)
		sums.slope[m] = sums.change[m] = zero;
	sums.changed = zero;
	ROLLED
	for (int k = 1; k <= s->length; k++) {
		const block_terms t = block_terms_at(s, line, k);
		row.slope += t.slope_below;
		row.self += t.self_below;
		row.next += t.below_here;
		row.over = t.below_above;
		block_finish_row(s, line * s->length + k - 1, turn, damping, row, &factor, &sums);
		row.slope = above.slope + t.slope_here;
		row.self = above.self + t.self_here;
		row.next = t.here_above;
		above.slope = t.slope_above;
		above.self = t.self_above;
	}
	for (int m = 0; m < BLOCK_MEMORY; m++) {
		s->sums[m * s->lines + line] = sums.slope[m];
		s->sums[(BLOCK_MEMORY + m) * s->lines + line] = sums.change[m];
	}
	s->sums[2 * BLOCK_MEMORY * s->lines + line] = sums.changed;
}

/* The bottom of the line's parabola with the slope less the changes remembered, alpha of each. Its
 * products with the changes go into the sums. */
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
		real z = block_array(s, BLOCK_STATE_SLOPE)[n];
		for (int m = 0; m < BLOCK_MEMORY; m++) {
			const real change = block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, m))[n];
			z -= CHOOSE(alpha[m] != zero, alpha[m] * change, zero);
		}
		z -= factor_1[n] * one_before + factor_2[n] * two_before;
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
		way[n] = bottom;
		for (int m = 0; m < BLOCK_MEMORY; m++)
			dot[m] += bottom * block_array(s, BLOCK_STATE_CHANGE + block_slot(turn, m))[n];
	}
	for (int m = 0; m < BLOCK_MEMORY; m++)
		s->sums[m * s->lines + line] = dot[m];
}

#endif
