/* What a node's part of the bending energy e(p, q, r, s, t) does when the derivatives of y there change
 * (p, q along and r, s, t twice; s mixed): found from 14 values of e. As e is quadratic in r, s and
 * t, probes of any size tell their slopes and curvatures exactly; p and q are probed close by.
 *
 * e = (m^2 w - 2 g) w^(3/2) with w = 1 / (1 + p^2 + q^2), m = (1 + q^2) r - 2 p q s + (1 + p^2) t and
 * g = r t - s^2. What the probes share is worked once: w of all that change r, s or t; for the four
 * that change p or q it comes from w at the node, by a series. */
#ifndef BATTEN_SHARED_BLOCK_PROBES_H
#define BATTEN_SHARED_BLOCK_PROBES_H

#include "block_layout.h"
#include "dialect.h"
#include "grid_energy.h"

/* Close enough for a slope by differences, far enough from its rounding. */
#if BATTEN_DOUBLE
#define BLOCK_NEAR LITERAL(0.0001220703125) /* 2^-13 */
#else
#define BLOCK_NEAR LITERAL(0.00390625) /* 2^-8 */
#endif
enum { BLOCK_PROBES_A_NODE = 14 };

/* Each but value times the weight of the node. */
typedef struct block_probes {
	real value; /* e */
	real p, q, r, s, t;
	real rr, ss, tt, rs, rt, st;
} block_probes;

/* What e at a node is made of; the names are those of the formula above, doubled: 2 p q, 2 g. */
typedef struct block_parts {
	real a, b, double_pq; /* 1 + q^2, 1 + p^2 */
	real square;          /* 1 / w */
	real w, w3;           /* w3 = w^(3/2) */
	real m, double_g;
	real here;  /* e / w3 + 2 g */
	real value; /* e */
} block_parts;

/* The value is that of bending_density, to the bit. */
SHARED_FUNCTION block_parts block_parts_of(node_slopes at)
{
	const real one = SPREAD(LITERAL(1.0));
	const real two = SPREAD(LITERAL(2.0));
	block_parts e;
	e.a = one + at.y_z * at.y_z;
	e.b = one + at.y_x * at.y_x;
	e.double_pq = two * (at.y_x * at.y_z);
	e.square = e.b + at.y_z * at.y_z;
	e.w = one / e.square;
	const real root = SQUARE_ROOT(e.w);
	e.w3 = e.w * root;
	e.m = (e.a * at.y_xx - e.double_pq * at.y_xz) + e.b * at.y_zz;
	e.double_g = two * (at.y_xx * at.y_zz - at.y_xz * at.y_xz);
	e.here = (e.m * e.m) * e.w;
	e.value = ((e.here - e.double_g) * e.w) * root;
	return e;
}

/* e with other p and q: m and 1 / w there. The relative change d of 1 / w is at most BLOCK_NEAR, and
 * what the series leave out, d^4, is below rounding. */
SHARED_FUNCTION real block_value_near(const block_parts *e, real m, real square)
{
	const real one = SPREAD(LITERAL(1.0));
	const real d = (square - e->square) * e->w;
	const real w = e->w - (e->w * d) * (one - d * (one - d));
	const real series = SPREAD(LITERAL(1.5)) -
	                    d * (SPREAD(LITERAL(1.875)) - SPREAD(LITERAL(2.1875)) * d);
	return ((m * m) * w - e->double_g) * (e->w3 - (e->w3 * d) * series);
}

/* e / w3 with other r, s, t, by how much m and 2 g change, less e / w3 here. */
SHARED_FUNCTION real block_change_far(const block_parts *e, real m, real double_g)
{
	const real moved = e->m + m;
	return (moved * moved) * e->w - (e->here + double_g);
}

SHARED_FUNCTION void block_probe_near(node_slopes at, const block_parts *e, real weight,
                                      block_probes *found)
{
	const real one = SPREAD(LITERAL(1.0));
	const real two = SPREAD(LITERAL(2.0));
	const real near = SPREAD(BLOCK_NEAR);
	const real by_half = SPREAD(LITERAL(0.5) / BLOCK_NEAR) * weight;
	const real p2 = at.y_x * at.y_x, q2 = at.y_z * at.y_z;
	const real ps = (two * at.y_x) * at.y_xz, qs = (two * at.y_z) * at.y_xz;
	const real ar = e->a * at.y_xx, bt = e->b * at.y_zz;
	real value[4];
	for (int i = 0; i < 4; i++) {
		const real to = (i < 2 ? at.y_x : at.y_z) + (i & 1 ? -near : near);
		const real b = one + to * to;
		const real pq = to * (i < 2 ? qs : ps);
		const real m = i < 2 ? (ar - pq) + b * at.y_zz : (b * at.y_xx - pq) + bt;
		value[i] = block_value_near(e, m, b + (i < 2 ? q2 : p2));
	}
	found->p = (value[0] - value[1]) * by_half;
	found->q = (value[2] - value[3]) * by_half;
}

/* far: how far r, s and t are probed. */
SHARED_FUNCTION void block_probe_far(node_slopes at, const block_parts *e, real far, real weight,
                                     block_probes *found)
{
	const real two = SPREAD(LITERAL(2.0));
	const real half_far = SPREAD(LITERAL(0.5)) / far;
	const real scale = e->w3 * weight;
	const real by_half = half_far * scale;
	const real square = (SPREAD(LITERAL(4.0)) * (half_far * half_far)) * scale;
	const real m_r = e->a * far, m_s = -(e->double_pq * far), m_t = e->b * far;
	const real g_r = two * (far * at.y_zz), g_t = two * (far * at.y_xx);
	const real g_s = -(two * far) * (two * at.y_xz + far);
	const real g_s_back = (two * far) * (two * at.y_xz - far);
	const real r_plus = block_change_far(e, m_r, g_r);
	const real r_minus = block_change_far(e, -m_r, -g_r);
	const real s_plus = block_change_far(e, m_s, g_s);
	const real s_minus = block_change_far(e, -m_s, g_s_back);
	const real t_plus = block_change_far(e, m_t, g_t);
	const real t_minus = block_change_far(e, -m_t, -g_t);
	const real rs = block_change_far(e, m_r + m_s, g_r + g_s);
	const real rt = block_change_far(e, m_r + m_t, (g_r + g_t) + two * (far * far));
	const real st = block_change_far(e, m_s + m_t, g_s + g_t);
	found->r = (r_plus - r_minus) * by_half;
	found->s = (s_plus - s_minus) * by_half;
	found->t = (t_plus - t_minus) * by_half;
	found->rr = (r_plus + r_minus) * square;
	found->ss = (s_plus + s_minus) * square;
	found->tt = (t_plus + t_minus) * square;
	found->rs = (rs - (r_plus + s_plus)) * square;
	found->rt = (rt - (r_plus + t_plus)) * square;
	found->st = (st - (s_plus + t_plus)) * square;
}

SHARED_FUNCTION block_probes block_probe(node_slopes at, real far, real weight)
{
	const block_parts e = block_parts_of(at);
	block_probes found;
	found.value = e.value;
	block_probe_near(at, &e, weight, &found);
	block_probe_far(at, &e, far, weight, &found);
	return found;
}

/* The same by the formulas of the derivatives: what probing is measured against. */
SHARED_FUNCTION block_probes block_derive(node_slopes at, real weight)
{
	const real two = SPREAD(LITERAL(2.0));
	const real p = at.y_x, q = at.y_z, r = at.y_xx, s = at.y_xz, t = at.y_zz;
	const block_parts e = block_parts_of(at);
	const real w3 = weight * e.w3;
	const real d5 = (two * w3) * e.w;
	const real mw5 = e.m * d5;
	const real tw3 = two * w3;
	const real fall = (SPREAD(LITERAL(5.0)) * ((e.m * e.m) * e.w) -
	                   SPREAD(LITERAL(3.0)) * e.double_g) *
	                  (w3 * e.w);
	block_probes found;
	found.value = e.value;
	found.p = mw5 * (two * (p * t - q * s)) - fall * p;
	found.q = mw5 * (two * (q * r - p * s)) - fall * q;
	found.r = mw5 * e.a - tw3 * t;
	found.s = (two * tw3) * s - mw5 * e.double_pq;
	found.t = mw5 * e.b - tw3 * r;
	found.rr = d5 * (e.a * e.a);
	found.ss = d5 * (e.double_pq * e.double_pq) + two * tw3;
	found.tt = d5 * (e.b * e.b);
	found.rs = -(d5 * (e.a * e.double_pq));
	found.rt = d5 * (e.a * e.b) - tw3;
	found.st = -(d5 * (e.b * e.double_pq));
	return found;
}

#endif
