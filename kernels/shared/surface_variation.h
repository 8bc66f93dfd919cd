/* One point of a surface: the variation of curvature (Moreton and Sequin 1992; Letcher 4.5), from
 * derivatives up to the third.
 *
 * The second fundamental form h has a derivative along the surface, its covariant derivative
 *   C_ijk = n.x_ijk - h_il G^l_jk - h_jl G^l_ik - h_kl G^l_ij,   G^l_jk = g^lm x_m.x_jk
 * symmetric in i, j and k (Codazzi and Mainardi). Along a principal direction e, a unit vector, the
 * curvature there changes by dk/de = C(e, e, e): no curvature is differenced. */
#ifndef BATTEN_SHARED_SURFACE_VARIATION_H
#define BATTEN_SHARED_SURFACE_VARIATION_H

#include "dialect.h"
#include "surface_point.h"

/* Principal directions exist where |k1 - k2| is more than this part of sqrt(k1^2 + k2^2); nearer to
 * an umbilic point rounding chooses them. The density loses that part's digits there. */
#define SURFACE_UMBILIC_F64 1e-6
#define SURFACE_UMBILIC_F32 1e-3

#if BATTEN_DOUBLE
#define SURFACE_UMBILIC LITERAL(SURFACE_UMBILIC_F64)
#else
#define SURFACE_UMBILIC LITERAL(SURFACE_UMBILIC_F32)
#endif

/* What a surface_jet leaves out. */
typedef struct surface_third {
	surface_triple uuu, uuv, uvv, vvv;
} surface_third;

/* What a surface_weight leaves out. */
typedef struct surface_weight_third {
	real uuu, uuv, uvv, vvv;
} surface_weight_third;

/* known: the point is regular and not umbilic; without it all the rest is 0. */
typedef struct surface_variation {
	real along_1, along_2; /* dk1/de1 and dk2/de2, k1 >= k2; the sign is that of e, any */
	real density;          /* the sum of their squares */
	real any_density; /* the same, at an umbilic point along any two directions at right angles */
	mask known;
} surface_variation;

/* A symmetric form of three vectors, by its values along the parameters. */
typedef struct surface_cubic {
	real uuu, uuv, uvv, vvv;
} surface_cubic;

/* The vector x_u u + x_v v of the tangent plane. */
typedef struct surface_pair {
	real u, v;
} surface_pair;

/* Third derivatives of a rational surface from the homogeneous ones, as surface_divide(); j: what
 * that gave. */
SHARED_FUNCTION surface_third surface_divide_third(surface_third h, surface_weight w,
                                                   surface_weight_third w3, surface_jet j)
{
	const real two = SPREAD(LITERAL(2.0));
	const real three = SPREAD(LITERAL(3.0));
	const real inverse = SPREAD(LITERAL(1.0)) / w.at;
	surface_third t;
	t.uuu = triple_add(-w3.uuu, j.at, h.uuu);
	t.uuu = triple_add(-(three * w.uu), j.u, triple_add(-(three * w.u), j.uu, t.uuu));
	t.uuv = triple_add(-w3.uuv, j.at, h.uuv);
	t.uuv = triple_add(-w.uu, j.v, triple_add(-w.v, j.uu, t.uuv));
	t.uuv = triple_add(-(two * w.uv), j.u, triple_add(-(two * w.u), j.uv, t.uuv));
	t.uvv = triple_add(-w3.uvv, j.at, h.uvv);
	t.uvv = triple_add(-w.vv, j.u, triple_add(-w.u, j.vv, t.uvv));
	t.uvv = triple_add(-(two * w.uv), j.v, triple_add(-(two * w.v), j.uv, t.uvv));
	t.vvv = triple_add(-w3.vvv, j.at, h.vvv);
	t.vvv = triple_add(-(three * w.vv), j.v, triple_add(-(three * w.v), j.vv, t.vvv));
	t.uuu = triple_scale(inverse, t.uuu);
	t.uuv = triple_scale(inverse, t.uuv);
	t.uvv = triple_scale(inverse, t.uvv);
	t.vvv = triple_scale(inverse, t.vvv);
	return t;
}

/* The coefficients G^l of the second derivative d in x_u and x_v; inverse2: 1 / area^2. */
SHARED_FUNCTION surface_pair surface_christoffel(surface_jet j, surface_shape s, surface_triple d,
                                                 real inverse2)
{
	const real a = triple_inner(j.u, d);
	const real b = triple_inner(j.v, d);
	const surface_pair g = { FUSED(s.first_vv, a, -(s.first_uv * b)) * inverse2,
		                     FUSED(s.first_uu, b, -(s.first_uv * a)) * inverse2 };
	return g;
}

/* The covariant derivative of the second form of a regular point. */
SHARED_FUNCTION surface_cubic surface_codazzi(surface_jet j, surface_third t, surface_shape s,
                                              real inverse2)
{
	const real two = SPREAD(LITERAL(2.0));
	const real three = SPREAD(LITERAL(3.0));
	const surface_pair uu = surface_christoffel(j, s, j.uu, inverse2);
	const surface_pair uv = surface_christoffel(j, s, j.uv, inverse2);
	const surface_pair vv = surface_christoffel(j, s, j.vv, inverse2);
	/* h_ul G^l and h_vl G^l */
	const real u_uu = FUSED(s.second_uu, uu.u, s.second_uv * uu.v);
	const real v_uu = FUSED(s.second_uv, uu.u, s.second_vv * uu.v);
	const real u_uv = FUSED(s.second_uu, uv.u, s.second_uv * uv.v);
	const real v_uv = FUSED(s.second_uv, uv.u, s.second_vv * uv.v);
	const real u_vv = FUSED(s.second_uu, vv.u, s.second_uv * vv.v);
	const real v_vv = FUSED(s.second_uv, vv.u, s.second_vv * vv.v);
	surface_cubic c;
	c.uuu = FUSED(-three, u_uu, triple_inner(s.normal, t.uuu));
	c.uuv = FUSED(-two, u_uv, triple_inner(s.normal, t.uuv)) - v_uu;
	c.uvv = FUSED(-two, v_uv, triple_inner(s.normal, t.uvv)) - u_vv;
	c.vvv = FUSED(-three, v_vv, triple_inner(s.normal, t.vvv));
	return c;
}

/* C(e, e, e) */
SHARED_FUNCTION real surface_cubic_along(surface_cubic c, surface_pair e)
{
	const real three = SPREAD(LITERAL(3.0));
	const real low = FUSED(c.uuu, e.u, three * (c.uuv * e.v));
	const real high = FUSED(c.vvv, e.v, three * (c.uvv * e.u));
	return FUSED(e.u * e.u, low, (e.v * e.v) * high);
}

/* The principal directions, unit vectors in the parameters, that of the greater curvature first. */
typedef struct surface_axes {
	surface_pair first, second;
	mask apart; /* they exist */
} surface_axes;

SHARED_FUNCTION surface_axes surface_axes_of(surface_shape s)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real two = SPREAD(LITERAL(2.0));
	const real limit = SPREAD(SURFACE_UMBILIC * SURFACE_UMBILIC);
	/* Two unit vectors of the tangent plane at right angles, x_u r and (x_v - x_u shear) q, and the
	 * second form in them: a symmetric matrix whose eigenvectors are the directions. */
	const real square_u = CHOOSE(s.regular, s.first_uu, one);
	const real root = SQUARE_ROOT(square_u);
	const real r = one / root;
	const real q = root / CHOOSE(s.regular, s.area, one);
	const real shear = s.first_uv / square_u;
	const real mixed = FUSED(-shear, s.second_uu, s.second_uv);
	const real a = (s.second_uu * r) * r;
	const real b = (mixed * r) * q;
	const real c = (FUSED(-shear, s.second_uv + mixed, s.second_vv) * q) * q;
	const real half_off = (a - c) * SPREAD(LITERAL(0.5));
	const real square = FUSED(half_off, half_off, b * b);
	const real size = FUSED(a, a, FUSED(c, c, (two * b) * b));
	surface_axes axes;
	axes.apart = s.regular & (SPREAD(LITERAL(4.0)) * square > limit * size);
	/* The eigenvector whose larger component is a sum: nothing cancels. */
	const real safe = CHOOSE(axes.apart, square, one);
	const real large = SQUARE_ROOT(safe) + CHOOSE(half_off < zero, -half_off, half_off);
	const real unit = one / SQUARE_ROOT(FUSED(large, large, b * b));
	const real cosine = CHOOSE(half_off < zero, b, large) * unit;
	const real sine = CHOOSE(half_off < zero, large, b) * unit;
	axes.first.v = sine * q;
	axes.first.u = FUSED(cosine, r, -(shear * axes.first.v));
	axes.second.v = cosine * q;
	axes.second.u = FUSED(-sine, r, -(shear * axes.second.v));
	return axes;
}

/* s: the shape surface_shape_of() found for j. Never NaN. */
SHARED_FUNCTION surface_variation surface_variation_of(surface_jet j, surface_third t,
                                                       surface_shape s)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const surface_axes axes = surface_axes_of(s);
	const real area = CHOOSE(s.regular, s.area, one);
	const surface_cubic c = surface_codazzi(j, t, s, one / (area * area));
	const real along_1 = surface_cubic_along(c, axes.first);
	const real along_2 = surface_cubic_along(c, axes.second);
	const real density = FUSED(along_1, along_1, along_2 * along_2);
	surface_variation v;
	const mask finite = s.regular & (density - density == zero);
	v.any_density = CHOOSE(finite, density, zero);
	v.known = axes.apart & finite;
	v.along_1 = CHOOSE(v.known, along_1, zero);
	v.along_2 = CHOOSE(v.known, along_2, zero);
	v.density = CHOOSE(v.known, density, zero);
	return v;
}

/* Beside surface_sums_add(). */
SHARED_FUNCTION void surface_sums_add_variation(surface_sums *sums, surface_shape s,
                                                surface_variation v, scalar weight)
{
	sums->variation = FUSED(v.density, SPREAD(weight) * s.area, sums->variation);
	sums->left_out += CHOOSE(v.known, SPREAD(LITERAL(0.0)), SPREAD(LITERAL(1.0)));
}

#endif
