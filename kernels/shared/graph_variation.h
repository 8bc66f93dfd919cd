/* The variation of curvature (surface_variation.h) of a graph y(x, z), where a third of the general formula
 * is left of it and neither principal directions nor a root are needed.
 *
 * C is the covariant derivative of the second form, S that form, both in the frame e of the waterline's
 * tangent and what is square to it in the surface. Along a direction at the angle t from the first,
 *   C(e, e, e) = alpha cos t + beta sin t + gamma cos 3t + delta sin 3t,
 * and the squares of that at t and at a right angle to it have the sum
 *   (alpha + gamma cos 4t + delta sin 4t)^2 + (beta + gamma sin 4t - delta cos 4t)^2.
 * The principal directions have tan 2t = 2 S12 / (S11 - S22), so that cos 4t and sin 4t are quotients. */
#ifndef BATTEN_SHARED_GRAPH_VARIATION_H
#define BATTEN_SHARED_GRAPH_VARIATION_H

#include "dialect.h"
#include "grid_energy.h"
#include "surface_variation.h"

/* What node_slopes leave out. */
typedef struct graph_third {
	real y_xxx, y_xxz, y_xzz, y_zzz;
} graph_third;

/* In the frame x_u, x_v - skew x_u, which is that of the waterline but for the lengths of its vectors: the
 * parts of S and C times the area element. */
typedef struct graph_frame {
	real along_2, across_2; /* one over the squares of these lengths */
	real inverse;           /* their product: one over the square of the area element */
	real s11, s12, s22, c111, c112, c122, c222;
} graph_frame;

SHARED_FUNCTION graph_frame graph_frame_of(node_slopes d, graph_third t, real along, real inverse)
{
	const real two = SPREAD(LITERAL(2.0));
	const real three = SPREAD(LITERAL(3.0));
	graph_frame f;
	f.inverse = inverse;
	f.along_2 = SPREAD(LITERAL(1.0)) / along;
	f.across_2 = along * inverse;
	const real skew = (d.y_x * d.y_z) * f.along_2;
	const real by_x = FUSED(d.y_x, d.y_xx, d.y_z * d.y_xz) * inverse;
	const real by_z = FUSED(d.y_x, d.y_xz, d.y_z * d.y_zz) * inverse;
	const real xxx = FUSED(-three * d.y_xx, by_x, t.y_xxx);
	const real xxz = FUSED(-two * d.y_xz, by_x, FUSED(-d.y_xx, by_z, t.y_xxz));
	const real xzz = FUSED(-two * d.y_xz, by_z, FUSED(-d.y_zz, by_x, t.y_xzz));
	const real zzz = FUSED(-three * d.y_zz, by_z, t.y_zzz);
	const real xz = FUSED(-skew, xxz, xzz), zz = FUSED(-skew, xzz, zzz);
	f.c111 = xxx;
	f.c112 = FUSED(-skew, xxx, xxz);
	f.c122 = FUSED(-skew, f.c112, xz);
	f.c222 = FUSED(-skew, f.c122, FUSED(-skew, xz, zz));
	f.s11 = d.y_xx;
	f.s12 = FUSED(-skew, d.y_xx, d.y_xz);
	f.s22 = FUSED(-skew, f.s12, FUSED(-skew, d.y_xz, d.y_zz));
	return f;
}

/* Its density times dS / (dx dz). 0 where there are no principal directions and where it is no number. */
SHARED_FUNCTION real graph_variation_of(node_slopes d, graph_third t, node_tangent tangent)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real two = SPREAD(LITERAL(2.0));
	const real three = SPREAD(LITERAL(3.0));
	const real most = SPREAD(LITERAL(0.75)), least = SPREAD(LITERAL(0.25));
	const real limit = SPREAD(SURFACE_UMBILIC * SURFACE_UMBILIC);
	const graph_frame f = graph_frame_of(d, t, tangent.along, tangent.inverse);
	const real a = f.along_2 * f.s11, c = f.across_2 * f.s22;
	const real half_off = SPREAD(LITERAL(0.5)) * (a - c);
	const real mixed = (f.inverse * f.s12) * f.s12;
	const real square = FUSED(half_off, half_off, mixed);
	const real size = FUSED(a, a, FUSED(c, c, two * mixed));
	const mask apart = SPREAD(LITERAL(4.0)) * square > limit * size;
	const real per_square = one / CHOOSE(apart, square, one);
	const real cosine = FUSED(half_off, half_off, -mixed) * per_square;
	const real sine = (two * half_off * f.s12) * per_square; /* but for both lengths */
	const real c111 = f.along_2 * f.c111, c112 = f.along_2 * f.c112;
	const real c122 = f.across_2 * f.c122, c222 = f.across_2 * f.c222;
	const real alpha = most * (c111 + c122), beta = most * (c222 + c112);
	const real gamma = least * FUSED(-three, c122, c111);
	const real delta = least * FUSED(three, c112, -c222);
	const real first = FUSED(f.across_2 * sine, delta, FUSED(gamma, cosine, alpha));
	const real second = FUSED(f.along_2 * sine, gamma, FUSED(-delta, cosine, beta));
	const real squares = FUSED(f.along_2 * first, first, (f.across_2 * second) * second);
	const real density = squares * tangent.root;
	return CHOOSE(apart & (density - density == zero), density, zero);
}

#endif
