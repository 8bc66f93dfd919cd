/* The objective of a search over a control net: fairness of the surface (thesis 7.1; Letcher 4.5) and
 * closeness, integrated over knot spans.
 *
 * Defined before this is included: NET_FAIRNESS, NET_ORDER_U, NET_ORDER_V; constants in OpenCL, in C
 * they may look into `s`, the state at hand. */
#ifndef BATTEN_SHARED_NET_ENERGY_H
#define BATTEN_SHARED_NET_ENERGY_H

#include "dialect.h"
#include "multilevel.h"
#include "net_layout.h"
#include "surface_point.h"
#include "surface_variation.h"

#define NET_THIRD (NET_FAIRNESS == NET_FAIRNESS_VARIATION)
#define NET_SAMPLE_NUMBERS (NET_THIRD ? NET_SAMPLE_SIZE_THIRD : NET_SAMPLE_SIZE)
#define NET_KEPT_NUMBERS (NET_THIRD ? NET_KEPT_SIZE_THIRD : NET_KEPT_SIZE)

typedef struct search_state {
	int nodes;         /* poles */
	int columns;       /* poles along u */
	int lines, length; /* samples along v, along u */
	int colour_count, wide_colours;
	int order_u, order_v, fairness;
	STATE stored *y, *base, *trial, *ways; /* [v][u] */
	STATE stored *moves; /* of the poles, by one probe and another: trial and the net after it */
	GLOBAL const stored *lower, *upper;
	GLOBAL const int *first_u, *first_v; /* the first pole a sample sees */
	GLOBAL const scalar *table_u, *table_v;
	GLOBAL const int *colours, *directions, *members; /* members: numbers of poles */
	GLOBAL const scalar *heights;                     /* of the members */
	GLOBAL const stored *samples;                     /* [line][sample][NET_SAMPLE_NUMBERS] */
	GLOBAL stored *kept;                              /* [line][sample][NET_KEPT_NUMBERS] */
	STATE stored *sums;                               /* one a line */
	STATE stored *gathered;                           /* two numbers a work-item */
	LOCAL int *vote;
	real rounding, wide_probes;
} search_state;

/* The way from the target and its derivatives at a sample. */
typedef struct net_jet {
	real at, u, v, uu, uv, vv, uuu, uuv, uvv, vvv;
} net_jet;

/* A column of the net taken together along v: value and derivatives. */
typedef struct net_pole {
	real derivative[4];
} net_pole;

/* Its poles first to end - 1 of those that the line sees. */
SHARED_FUNCTION net_pole net_collapse(const search_state *s, const STATE stored *column, int first,
                                      int end, GLOBAL const scalar *table)
{
	const real zero = SPREAD(LITERAL(0.0));
	net_pole pole = { { zero, zero, zero, zero } };
	ROLLED
	for (int a = first; a < end; a++) {
		const real y = AT(column[a * s->columns]);
		pole.derivative[0] = FUSED(SPREAD(table[a]), y, pole.derivative[0]);
		pole.derivative[1] = FUSED(SPREAD(table[NET_ORDER_V + a]), y, pole.derivative[1]);
		pole.derivative[2] = FUSED(SPREAD(table[2 * NET_ORDER_V + a]), y, pole.derivative[2]);
		if (NET_THIRD)
			pole.derivative[3] = FUSED(SPREAD(table[3 * NET_ORDER_V + a]), y, pole.derivative[3]);
	}
	return pole;
}

/* Adds pole number b of those that a sample sees along u. */
SHARED_FUNCTION void net_jet_add(const search_state *s, net_jet *j, const net_pole *pole, int b,
                                 GLOBAL const scalar *table)
{
	const real t0 = SPREAD(table[b]);
	const real t1 = SPREAD(table[NET_ORDER_U + b]);
	const real t2 = SPREAD(table[2 * NET_ORDER_U + b]);
	(void)s; /* OpenCL knows the order without it */
	j->at = FUSED(t0, pole->derivative[0], j->at);
	j->u = FUSED(t1, pole->derivative[0], j->u);
	j->v = FUSED(t0, pole->derivative[1], j->v);
	j->uu = FUSED(t2, pole->derivative[0], j->uu);
	j->uv = FUSED(t1, pole->derivative[1], j->uv);
	j->vv = FUSED(t0, pole->derivative[2], j->vv);
	if (NET_THIRD) {
		const real t3 = SPREAD(table[3 * NET_ORDER_U + b]);
		j->uuu = FUSED(t3, pole->derivative[0], j->uuu);
		j->uuv = FUSED(t2, pole->derivative[1], j->uuv);
		j->uvv = FUSED(t1, pole->derivative[2], j->uvv);
		j->vvv = FUSED(t0, pole->derivative[3], j->vvv);
	}
}

SHARED_FUNCTION net_jet net_jet_kept(const search_state *s, GLOBAL const stored *kept)
{
	const real zero = SPREAD(LITERAL(0.0));
	const net_jet j = { AT(kept[NET_KEPT_JET]),
		                AT(kept[NET_KEPT_JET + 1]),
		                AT(kept[NET_KEPT_JET + 2]),
		                AT(kept[NET_KEPT_JET + 3]),
		                AT(kept[NET_KEPT_JET + 4]),
		                AT(kept[NET_KEPT_JET + 5]),
		                NET_THIRD ? AT(kept[NET_KEPT_JET + 6]) : zero,
		                NET_THIRD ? AT(kept[NET_KEPT_JET + 7]) : zero,
		                NET_THIRD ? AT(kept[NET_KEPT_JET + 8]) : zero,
		                NET_THIRD ? AT(kept[NET_KEPT_JET + 9]) : zero };
	(void)s;
	return j;
}

SHARED_FUNCTION void net_jet_keep(const search_state *s, GLOBAL stored *kept, const net_jet *j)
{
	(void)s;
	AT(kept[NET_KEPT_JET]) = j->at;
	AT(kept[NET_KEPT_JET + 1]) = j->u;
	AT(kept[NET_KEPT_JET + 2]) = j->v;
	AT(kept[NET_KEPT_JET + 3]) = j->uu;
	AT(kept[NET_KEPT_JET + 4]) = j->uv;
	AT(kept[NET_KEPT_JET + 5]) = j->vv;
	if (NET_THIRD) {
		AT(kept[NET_KEPT_JET + 6]) = j->uuu;
		AT(kept[NET_KEPT_JET + 7]) = j->uuv;
		AT(kept[NET_KEPT_JET + 8]) = j->uvv;
		AT(kept[NET_KEPT_JET + 9]) = j->vvv;
	}
}

SHARED_FUNCTION surface_triple net_triple(GLOBAL const stored *sample, int x, int z, int target,
                                          real way)
{
	const surface_triple t = { AT(sample[x]), AT(sample[target]) + way, AT(sample[z]) };
	return t;
}

SHARED_FUNCTION surface_jet net_surface_jet(GLOBAL const stored *sample, net_jet d)
{
	surface_jet j;
	j.at = triple_zero();
	j.u = net_triple(sample, NET_SAMPLE_X, NET_SAMPLE_Z, NET_SAMPLE_TARGET, d.u);
	j.v = net_triple(sample, NET_SAMPLE_X + 1, NET_SAMPLE_Z + 1, NET_SAMPLE_TARGET + 1, d.v);
	j.uu = net_triple(sample, NET_SAMPLE_X + 2, NET_SAMPLE_Z + 2, NET_SAMPLE_TARGET + 2, d.uu);
	j.uv = net_triple(sample, NET_SAMPLE_X + 3, NET_SAMPLE_Z + 3, NET_SAMPLE_TARGET + 3, d.uv);
	j.vv = net_triple(sample, NET_SAMPLE_X + 4, NET_SAMPLE_Z + 4, NET_SAMPLE_TARGET + 4, d.vv);
	return j;
}

SHARED_FUNCTION surface_third net_surface_third(GLOBAL const stored *sample, net_jet d)
{
	surface_third t;
	t.uuu = net_triple(sample, NET_SAMPLE_X_THIRD, NET_SAMPLE_Z_THIRD, NET_SAMPLE_TARGET_THIRD,
	                   d.uuu);
	t.uuv = net_triple(sample, NET_SAMPLE_X_THIRD + 1, NET_SAMPLE_Z_THIRD + 1,
	                   NET_SAMPLE_TARGET_THIRD + 1, d.uuv);
	t.uvv = net_triple(sample, NET_SAMPLE_X_THIRD + 2, NET_SAMPLE_Z_THIRD + 2,
	                   NET_SAMPLE_TARGET_THIRD + 2, d.uvv);
	t.vvv = net_triple(sample, NET_SAMPLE_X_THIRD + 3, NET_SAMPLE_Z_THIRD + 3,
	                   NET_SAMPLE_TARGET_THIRD + 3, d.vvv);
	return t;
}

/* A fairness of first and second derivatives times dA / (du dv). With n = by_v x by_u, not made a
 * unit, e = n.by_uu ..., and m = e G - 2 f F + g E: H = m / (2 n^3), K = (e g - f^2) / n^4; one
 * division and one root. */
SHARED_FUNCTION real net_density(const search_state *s, surface_jet j)
{
	const real one = SPREAD(LITERAL(1.0));
	const real two = SPREAD(LITERAL(2.0));
	const surface_triple normal = triple_outer(j.v, j.u);
	const real square = triple_inner(normal, normal);
	const real e = triple_inner(normal, j.uu);
	const real f = triple_inner(normal, j.uv);
	const real g = triple_inner(normal, j.vv);
	const real inverse = one / square;
	const real gauss = FUSED(e, g, -(f * f));
	if (NET_FAIRNESS == NET_FAIRNESS_GAUSS) {
		/* sqrt(K^2 + rounding) n */
		const real part = gauss * inverse;
		return SQUARE_ROOT(FUSED(part * part, inverse, s->rounding * square));
	}
	const real first_uu = triple_inner(j.u, j.u);
	const real first_uv = triple_inner(j.u, j.v);
	const real first_vv = triple_inner(j.v, j.v);
	const real mean = FUSED(e, first_vv, FUSED(g, first_uu, -((two * f) * first_uv)));
	const real mean2 = (mean * mean) * inverse;
	const real root = SQUARE_ROOT(inverse);
	if (NET_FAIRNESS == NET_FAIRNESS_MEAN)
		return ((SPREAD(LITERAL(0.25)) * mean2) * inverse) * root;
	return (FUSED(-two, gauss, mean2) * inverse) * root;
}

SHARED_FUNCTION real net_sample_objective(const search_state *s, GLOBAL const stored *sample,
                                          net_jet d)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real fair = AT(sample[NET_SAMPLE_FAIR]);
	const surface_jet j = net_surface_jet(sample, d);
	real density;
	if (NET_THIRD) {
		const surface_shape shape = surface_shape_of(j, zero);
		/* Umbilic points count too: a search would make points umbilic to be rid of them. */
		const surface_variation v = surface_variation_of(j, net_surface_third(sample, d), shape);
		density = v.any_density * shape.area;
	} else {
		density = net_density(s, j);
	}
	const real energy = fair * density;
	return FUSED(AT(sample[NET_SAMPLE_CLOSE]) * d.at, d.at, CHOOSE(fair > zero, energy, zero));
}

/* The samples of one line with the net y. Where it `keeps`, terms and derivatives are. */
SHARED_FUNCTION real net_line_objective(const search_state *s, const STATE stored *y, int line,
                                        int keeps)
{
	const real zero = SPREAD(LITERAL(0.0));
	GLOBAL const scalar *table = s->table_v + line * NET_TABLE_SIZE(NET_ORDER_V);
	GLOBAL const scalar *along = s->table_u;
	GLOBAL const stored *sample = s->samples +
	                              (size_t)(line * s->length) * (size_t)NET_SAMPLE_NUMBERS;
	GLOBAL stored *kept = s->kept + (size_t)(line * s->length) * (size_t)NET_KEPT_NUMBERS;
	const STATE stored *row = y + s->first_v[line] * s->columns;
	/* Column c is in place c % order. */
	net_pole ring[NET_ORDER_MOST];
	real sum = zero;
	int reached = 0;
	ROLLED
	for (int i = 0; i < s->length; i++) {
		const int first = s->first_u[i];
		ROLLED
		for (; reached < first + NET_ORDER_U; reached++)
			ring[reached % NET_ORDER_U] = net_collapse(s, row + reached, 0, NET_ORDER_V, table);
		net_jet j = { zero, zero, zero, zero, zero, zero, zero, zero, zero, zero };
		ROLLED
		for (int b = 0; b < NET_ORDER_U; b++)
			net_jet_add(s, &j, ring + (first + b) % NET_ORDER_U, b, along);
		const real term = net_sample_objective(s, sample, j);
		if (keeps) {
			AT(kept[NET_KEPT_TERM]) = term;
			net_jet_keep(s, kept, &j);
		}
		sum += term;
		along += NET_TABLE_SIZE(NET_ORDER_U);
		sample += NET_SAMPLE_NUMBERS;
		kept += NET_KEPT_NUMBERS;
	}
	return sum;
}

/* ------------------------------------------------------------------------------------------------
 * What search_sweep.h and search_ways.h ask for
 * --------------------------------------------------------------------------------------------- */

SHARED_FUNCTION void colour_range(const search_state *s, int colour, int *first, int *end)
{
	*first = s->colours[colour];
	*end = s->colours[colour + 1];
}

/* Where a step leads from y in a box. */
SHARED_FUNCTION real step_from(const search_state *s, real y, real step, real lower, real upper)
{
	(void)s;
	return move_clamped(y, step, lower, upper);
}

SHARED_FUNCTION real whole_objective(const search_state *s)
{
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		AT(s->sums[line]) = net_line_objective(s, s->trial, line, 0);
	WAIT;
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int line = 0; line < s->lines; line++)
		sum += AT(s->sums[line]);
	WAIT;
	return sum;
}

/* Terms and derivatives at y, anew once an iteration: what moves add to them is rounded. */
SHARED_FUNCTION void sweeps_begin(const search_state *s)
{
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		(void)net_line_objective(s, s->y, line, 1);
	WAIT;
}

/* Every move keeps what it changes. */
SHARED_FUNCTION void colour_end(const search_state *s, int colour)
{
	(void)s;
	(void)colour;
}

#include "net_moves.h"

#endif
