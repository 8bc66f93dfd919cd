/* What a node's part of the bending energy e(p, q, r, s, t) does when the derivatives of y there change
 * (p, q along and r, s, t twice; s mixed): found from 14 values of e. As e is quadratic in r, s and
 * t, probes of any size tell their slopes and curvatures exactly; p and q are probed close by. */
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

typedef struct block_probes {
	real value; /* e */
	real p, q, r, s, t;
	real rr, ss, tt, rs, rt, st;
} block_probes;

SHARED_FUNCTION real block_value(real p, real q, real r, real s, real t)
{
	const node_slopes slopes = { p, q, r, s, t };
	return bending_density(slopes);
}

/* far: how far r, s and t are probed. */
SHARED_FUNCTION block_probes block_probe(node_slopes at, real far)
{
	const real near = SPREAD(BLOCK_NEAR);
	const real half_near = SPREAD(LITERAL(0.5) / BLOCK_NEAR);
	const real half_far = SPREAD(LITERAL(0.5)) / far;
	const real square = SPREAD(LITERAL(4.0)) * (half_far * half_far);
	const real p = at.y_x, q = at.y_z, r = at.y_xx, s = at.y_xz, t = at.y_zz;
	const real e = block_value(p, q, r, s, t);
	const real p_plus = block_value(p + near, q, r, s, t);
	const real p_minus = block_value(p - near, q, r, s, t);
	const real q_plus = block_value(p, q + near, r, s, t);
	const real q_minus = block_value(p, q - near, r, s, t);
	const real r_plus = block_value(p, q, r + far, s, t) - e;
	const real r_minus = block_value(p, q, r - far, s, t) - e;
	const real s_plus = block_value(p, q, r, s + far, t) - e;
	const real s_minus = block_value(p, q, r, s - far, t) - e;
	const real t_plus = block_value(p, q, r, s, t + far) - e;
	const real t_minus = block_value(p, q, r, s, t - far) - e;
	const real rs = block_value(p, q, r + far, s + far, t) - e;
	const real rt = block_value(p, q, r + far, s, t + far) - e;
	const real st = block_value(p, q, r, s + far, t + far) - e;
	block_probes found;
	found.value = e;
	found.p = (p_plus - p_minus) * half_near;
	found.q = (q_plus - q_minus) * half_near;
	found.r = (r_plus - r_minus) * half_far;
	found.s = (s_plus - s_minus) * half_far;
	found.t = (t_plus - t_minus) * half_far;
	found.rr = (r_plus + r_minus) * square;
	found.ss = (s_plus + s_minus) * square;
	found.tt = (t_plus + t_minus) * square;
	found.rs = (rs - (r_plus + s_plus)) * square;
	found.rt = (rt - (r_plus + t_plus)) * square;
	found.st = (st - (s_plus + t_plus)) * square;
	return found;
}

/* The same by the formulas of the derivatives, e = m^2 w^(5/2) - 2 (r t - s^2) w^(3/2) with w = 1 / (1 +
 * p^2 + q^2), m = (1 + q^2) r - 2 p q s + (1 + p^2) t: what probing is measured against. */
SHARED_FUNCTION block_probes block_derive(node_slopes at)
{
	const real one = SPREAD(LITERAL(1.0));
	const real two = SPREAD(LITERAL(2.0));
	const real p = at.y_x, q = at.y_z, r = at.y_xx, s = at.y_xz, t = at.y_zz;
	const real a = one + q * q;
	const real b = one + p * p;
	const real pq = two * (p * q);
	const real w = one / (a + p * p);
	const real w3 = w * SQUARE_ROOT(w);
	const real w5 = w3 * w;
	const real m = (a * r - pq * s) + b * t;
	const real g = r * t - s * s;
	const real mw5 = (two * m) * w5;
	const real tw3 = two * w3;
	const real fall = (SPREAD(LITERAL(5.0)) * ((m * m) * w5) - SPREAD(LITERAL(6.0)) * (g * w3)) * w;
	block_probes found;
	found.value = (m * m) * w5 - tw3 * g;
	found.p = mw5 * (two * (p * t - q * s)) - fall * p;
	found.q = mw5 * (two * (q * r - p * s)) - fall * q;
	found.r = mw5 * a - tw3 * t;
	found.s = (two * tw3) * s - mw5 * pq;
	found.t = mw5 * b - tw3 * r;
	const real d5 = two * w5;
	found.rr = d5 * (a * a);
	found.ss = d5 * (pq * pq) + two * tw3;
	found.tt = d5 * (b * b);
	found.rs = -(d5 * (a * pq));
	found.rt = d5 * (a * b) - tw3;
	found.st = -(d5 * (b * pq));
	return found;
}

#endif
