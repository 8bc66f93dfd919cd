/* Lines of offsets in the block search: the state of a search, its objective and its probes line by line,
 * and what the probes of three neighbouring lines of nodes say of one line's slopes and curvatures. */
#ifndef BATTEN_SHARED_BLOCK_LINES_H
#define BATTEN_SHARED_BLOCK_LINES_H

#include "block_probes.h"

typedef struct block_state {
	int lines, length, nodes;
	int slots; /* lines that the ring of probes has room for */
	int analytic;
	int rounds; /* of an iteration (block_rounds.h); 0: one, bent by the moves remembered */
	GLOBAL const scalar *across, *along; /* STENCIL_SIZE a line, a node of a line */
	STATE stored *arrays;                /* [BLOCK_STATE_COUNT][nodes] */
	STATE stored *ring;                  /* [slots][length][BLOCK_PROBE_COUNT] */
	STATE stored *sums;                  /* [BLOCK_SUM_COUNT][lines] */
	LOCAL int *vote;
	int hats;                        /* of a line (block_hats.h); 0: lines alone */
	GLOBAL const scalar *hat_values; /* BLOCK_HAT_SIZE a node of a line */
	STATE stored *hat_rows;          /* [BLOCK_HAT_NUMBERS(lines, hats)] */
} block_state;

SHARED_FUNCTION STATE stored *block_array(const block_state *s, int array)
{
	return s->arrays + array * s->nodes;
}

#include "block_rows.h"

/* Differences of y at three neighbouring nodes of a line, as a walk along it keeps them: those across
 * the line at the node before, here and at the next, those along it from the node before and to the
 * next. */
typedef struct block_window {
	real first_below, first_here, first_above;
	real second_here, second_above;
	real rise_below, rise_above;
	real here;
} block_window;

/* Goes on to node k; the next one's differences are taken in. */
SHARED_FUNCTION void block_walk(const block_state *s, STATE const stored *y, int line, int k,
                                block_window *at)
{
	GLOBAL const scalar *w = s->across + line * STENCIL_SIZE;
	const STATE stored *next = y + (line * s->length + k + 1);
	const real here = AT(next[0]);
	const real aft = here - AT(next[-s->length]);
	const real fore = AT(next[s->length]) - here;
	at->first_below = at->first_here;
	at->first_here = at->first_above;
	at->first_above = w[0] * aft + w[1] * fore;
	at->second_here = at->second_above;
	at->second_above = w[3] * fore - w[2] * aft;
	at->rise_below = at->rise_above;
	at->rise_above = here - at->here;
	at->here = here;
}

/* Stands before node 1 of a line. */
SHARED_FUNCTION block_window block_window_at(const block_state *s, STATE const stored *y, int line)
{
	const real zero = SPREAD(LITERAL(0.0));
	block_window at = { zero, zero, zero, zero, zero, zero, zero, zero };
	block_walk(s, y, line, -1, &at);
	block_walk(s, y, line, 0, &at);
	return at;
}

/* The derivatives of y at node k, to the bit those of slopes_of. */
SHARED_FUNCTION node_slopes block_slopes_at(const block_state *s, const block_window *at, int k)
{
	GLOBAL const scalar *w = s->along + k * STENCIL_SIZE;
	node_slopes d;
	d.y_x = at->first_here;
	d.y_z = w[0] * at->rise_below + w[1] * at->rise_above;
	d.y_xx = at->second_here;
	d.y_xz = stencil_first(w[0], w[1], at->first_below, at->first_here, at->first_above);
	d.y_zz = w[3] * at->rise_above - w[2] * at->rise_below;
	return d;
}

SHARED_FUNCTION int block_is_inside(int at, int count)
{
	return at > 0 && at + 1 < count;
}

SHARED_FUNCTION real block_line_closeness(const block_state *s, STATE const stored *y, int line)
{
	const STATE stored *close = block_array(s, BLOCK_INPUT_CLOSE);
	const STATE stored *target = block_array(s, BLOCK_INPUT_TARGET);
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		const real off = AT(y[n]) - AT(target[n]);
		sum += AT(close[n]) * (off * off);
	}
	return sum;
}

/* A line's part of the objective at y. */
SHARED_FUNCTION real block_line_objective(const block_state *s, STATE const stored *y, int line)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *bend = block_array(s, BLOCK_INPUT_BEND) + line * s->length;
	real sum = block_line_closeness(s, y, line);
	if (!block_is_inside(line, s->lines))
		return sum;
	block_window at = block_window_at(s, y, line);
	ROLLED
	for (int k = 1; k + 1 < s->length; k++) {
		block_walk(s, y, line, k, &at);
		const real energy = AT(bend[k]) * bending_density(block_slopes_at(s, &at, k));
		sum += CHOOSE(AT(bend[k]) > zero, energy, zero);
	}
	return sum;
}

/* Where the probes of a line are kept, node by node. */
SHARED_FUNCTION STATE stored *block_ring(const block_state *s, int line)
{
	return s->ring + (line % s->slots) * s->length * BLOCK_PROBE_COUNT;
}

SHARED_FUNCTION void block_keep(STATE stored *to, block_probes found)
{
	AT(to[BLOCK_PROBE_P]) = found.p;
	AT(to[BLOCK_PROBE_Q]) = found.q;
	AT(to[BLOCK_PROBE_R]) = found.r;
	AT(to[BLOCK_PROBE_S]) = found.s;
	AT(to[BLOCK_PROBE_T]) = found.t;
	AT(to[BLOCK_PROBE_RR]) = found.rr;
	AT(to[BLOCK_PROBE_SS]) = found.ss;
	AT(to[BLOCK_PROBE_TT]) = found.tt;
	AT(to[BLOCK_PROBE_RS]) = found.rs;
	AT(to[BLOCK_PROBE_RT]) = found.rt;
	AT(to[BLOCK_PROBE_ST]) = found.st;
}

/* Derivatives at a node without an energy, which may be anything, as 0: what is probed there is then
 * finite, and its weight is 0. */
SHARED_FUNCTION node_slopes block_slopes_where(mask has, node_slopes at)
{
	const real zero = SPREAD(LITERAL(0.0));
	at.y_x = CHOOSE(has, at.y_x, zero);
	at.y_z = CHOOSE(has, at.y_z, zero);
	at.y_xx = CHOOSE(has, at.y_xx, zero);
	at.y_xz = CHOOSE(has, at.y_xz, zero);
	at.y_zz = CHOOSE(has, at.y_zz, zero);
	return at;
}

/* Probes a line of nodes; its slopes along the first derivatives count `part`. Returns the line's part of
 * the objective at y. */
SHARED_FUNCTION real block_probe_line(const block_state *s, int line, real far, real part)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *y = block_array(s, BLOCK_INPUT_START);
	const STATE stored *bend = block_array(s, BLOCK_INPUT_BEND) + line * s->length;
	real sum = block_line_closeness(s, y, line);
	if (!block_is_inside(line, s->lines))
		return sum;
	block_window window = block_window_at(s, y, line);
	STATE stored *ring = block_ring(s, line);
	ROLLED
	for (int k = 1; k + 1 < s->length; k++) {
		block_walk(s, y, line, k, &window);
		const node_slopes at = block_slopes_where(AT(bend[k]) > zero,
		                                          block_slopes_at(s, &window, k));
		block_probes found = BLOCK_ANALYTIC ? block_derive(at, AT(bend[k]))
		                                    : block_probe(at, far, AT(bend[k]));
		found.p *= part;
		found.q *= part;
		block_keep(ring + k * BLOCK_PROBE_COUNT, found);
		sum += AT(bend[k]) * found.value;
	}
	return sum;
}

/* What the terms of a node and of those beside it, across the line, add to the line: to the slopes of
 * the offsets below, at and above it, to the diagonal, to what couples neighbours, and those one
 * apart. */
typedef struct block_terms {
	real slope_below, slope_here, slope_above;
	real self_below, self_here, self_above;
	real below_here, here_above, below_above;
} block_terms;

/* Those terms, still along the five derivatives: across the line its offset at the node weighs in as
 * much as the stencils say. */
typedef struct block_across {
	real here;          /* slope of the offset itself */
	real mixed, second; /* slopes along the first and the second difference along the line */
	real rr, rs, ss, rt, st, tt;
} block_across;

/* What a line's offsets weigh in the derivatives across at one of three lines of nodes, and the probes
 * there; NULL where that line has none. */
typedef struct block_side {
	const STATE stored *probes;
	scalar first, second, square, both, bend; /* weights, their products: first^2, both, second^2 */
} block_side;

SHARED_FUNCTION block_side block_side_of(const block_state *s, int line, scalar first,
                                         scalar second)
{
	block_side side;
	side.probes = block_is_inside(line, s->lines) ? block_ring(s, line) : (const STATE stored *)0;
	side.first = first;
	side.second = second;
	side.square = first * first;
	side.both = second * first;
	side.bend = second * second;
	return side;
}

/* The lines at, before and behind a line, as the line is felt there. */
typedef struct block_sides {
	block_side own, aft, fore;
} block_sides;

SHARED_FUNCTION block_sides block_sides_of(const block_state *s, int line)
{
	GLOBAL const scalar *w = s->across + line * STENCIL_SIZE;
	GLOBAL const scalar *aft = w - (line > 0 ? STENCIL_SIZE : 0);
	GLOBAL const scalar *fore = w + (line + 1 < s->lines ? STENCIL_SIZE : 0);
	block_sides sides;
	sides.own = block_side_of(s, line, w[0] - w[1], -(w[2] + w[3]));
	sides.aft = block_side_of(s, line - 1, aft[1], aft[3]);
	sides.fore = block_side_of(s, line + 1, -fore[0], fore[2]);
	return sides;
}

SHARED_FUNCTION void block_add_across(block_across *t, const block_side *side, int k)
{
	if (!side->probes)
		return;
	const STATE stored *probes = side->probes + k * BLOCK_PROBE_COUNT;
	t->here += side->second * AT(probes[BLOCK_PROBE_R]) + side->first * AT(probes[BLOCK_PROBE_P]);
	t->mixed += side->first * AT(probes[BLOCK_PROBE_S]);
	t->rr += side->bend * AT(probes[BLOCK_PROBE_RR]);
	t->rs += side->both * AT(probes[BLOCK_PROBE_RS]);
	t->ss += side->square * AT(probes[BLOCK_PROBE_SS]);
}

SHARED_FUNCTION block_across block_across_at(const block_sides *sides, int k)
{
	const real zero = SPREAD(LITERAL(0.0));
	block_across t = { zero, zero, zero, zero, zero, zero, zero, zero, zero };
	block_add_across(&t, &sides->own, k);
	if (sides->own.probes) {
		const STATE stored *probes = sides->own.probes + k * BLOCK_PROBE_COUNT;
		t.mixed += AT(probes[BLOCK_PROBE_Q]);
		t.second = AT(probes[BLOCK_PROBE_T]);
		t.rt = sides->own.second * AT(probes[BLOCK_PROBE_RT]);
		t.st = sides->own.first * AT(probes[BLOCK_PROBE_ST]);
		t.tt = AT(probes[BLOCK_PROBE_TT]);
	}
	block_add_across(&t, &sides->aft, k);
	block_add_across(&t, &sides->fore, k);
	return t;
}

/* The terms of node k of a line and of those beside it, as the line feels them. */
SHARED_FUNCTION block_terms block_terms_at(const block_state *s, const block_sides *sides, int k)
{
	const real zero = SPREAD(LITERAL(0.0));
	block_terms t = { zero, zero, zero, zero, zero, zero, zero, zero, zero };
	if (!block_is_inside(k, s->length))
		return t;
	const block_across a = block_across_at(sides, k);
	GLOBAL const scalar *w = s->along + k * STENCIL_SIZE;
	/* Weights of the three offsets in the first and the second derivative along the line. */
	const scalar first_below = -w[0], first_here = w[0] - w[1], first_above = w[1];
	const scalar second_below = w[2], second_here = -(w[2] + w[3]), second_above = w[3];
	t.slope_below = first_below * a.mixed + second_below * a.second;
	t.slope_here = a.here + (first_here * a.mixed + second_here * a.second);
	t.slope_above = first_above * a.mixed + second_above * a.second;
	const real s_below = first_below * a.ss + second_below * a.st;
	const real t_below = first_below * a.st + second_below * a.tt;
	const real s_above = first_above * a.ss + second_above * a.st;
	const real t_above = first_above * a.st + second_above * a.tt;
	const real s_here = (first_here * a.ss + second_here * a.st) + a.rs;
	const real t_here = (first_here * a.st + second_here * a.tt) + a.rt;
	t.self_below = first_below * s_below + second_below * t_below;
	t.self_above = first_above * s_above + second_above * t_above;
	t.below_above = first_below * s_above + second_below * t_above;
	t.below_here = first_below * s_here + second_below * t_here;
	t.here_above = first_above * s_here + second_above * t_here;
	t.self_here = (first_here * s_here + second_here * t_here) +
	              ((first_here * a.rs + second_here * a.rt) + a.rr);
	return t;
}

#endif
