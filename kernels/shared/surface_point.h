/* One point of a surface: curvatures from derivatives (Letcher 4.2-4.3; thesis 4.4). */
#ifndef BATTEN_SHARED_SURFACE_POINT_H
#define BATTEN_SHARED_SURFACE_POINT_H

#include "dialect.h"
#include "surface_layout.h"

#if BATTEN_DOUBLE
#define SURFACE_ANGLE LITERAL(SURFACE_ANGLE_F64)
#else
#define SURFACE_ANGLE LITERAL(SURFACE_ANGLE_F32)
#endif

typedef struct surface_triple {
	real x, y, z;
} surface_triple;

/* A point and its derivatives. */
typedef struct surface_jet {
	surface_triple at, u, v, uu, uv, vv;
} surface_jet;

/* The weight of a rational surface there and its derivatives. */
typedef struct surface_weight {
	real at, u, v, uu, uv, vv;
} surface_weight;

/* What a normal makes known. regular: there is one; without it all the rest is 0. */
typedef struct surface_shape {
	real first_uu, first_uv, first_vv; /* known without a normal too */
	surface_triple normal;
	real area, second_uu, second_uv, second_vv, gauss, mean, bending;
	mask regular;
} surface_shape;

SHARED_FUNCTION surface_triple triple_zero(void)
{
	const real zero = SPREAD(LITERAL(0.0));
	const surface_triple t = { zero, zero, zero };
	return t;
}

/* factor * a + b */
SHARED_FUNCTION surface_triple triple_add(real factor, surface_triple a, surface_triple b)
{
	const surface_triple t = { FUSED(factor, a.x, b.x), FUSED(factor, a.y, b.y),
		                       FUSED(factor, a.z, b.z) };
	return t;
}

SHARED_FUNCTION surface_triple triple_scale(real factor, surface_triple a)
{
	const surface_triple t = { factor * a.x, factor * a.y, factor * a.z };
	return t;
}

SHARED_FUNCTION real triple_inner(surface_triple a, surface_triple b)
{
	return FUSED(a.x, b.x, FUSED(a.y, b.y, a.z * b.z));
}

SHARED_FUNCTION surface_triple triple_outer(surface_triple a, surface_triple b)
{
	const surface_triple t = { FUSED(a.y, b.z, -(a.z * b.y)), FUSED(a.z, b.x, -(a.x * b.z)),
		                       FUSED(a.x, b.y, -(a.y * b.x)) };
	return t;
}

/* Homogeneous coordinates to a point and its derivatives (Letcher 4.10), by the product rule. */
SHARED_FUNCTION surface_triple surface_divide_at(surface_triple at, real weight)
{
	return triple_scale(SPREAD(LITERAL(1.0)) / weight, at);
}

SHARED_FUNCTION surface_jet surface_divide(surface_jet h, surface_weight w)
{
	const real inverse = SPREAD(LITERAL(1.0)) / w.at;
	const real two = SPREAD(LITERAL(2.0));
	surface_jet j;
	j.at = triple_scale(inverse, h.at);
	j.u = triple_scale(inverse, triple_add(-w.u, j.at, h.u));
	j.v = triple_scale(inverse, triple_add(-w.v, j.at, h.v));
	j.uu = triple_add(-w.uu, j.at, triple_add(-(two * w.u), j.u, h.uu));
	j.uv = triple_add(-w.uv, j.at, triple_add(-w.u, j.v, triple_add(-w.v, j.u, h.uv)));
	j.vv = triple_add(-w.vv, j.at, triple_add(-(two * w.v), j.v, h.vv));
	j.uu = triple_scale(inverse, j.uu);
	j.uv = triple_scale(inverse, j.uv);
	j.vv = triple_scale(inverse, j.vv);
	return j;
}

/* Both fundamental forms, the second one times the area element, and what of the area element takes a
 * root and a division. inverse2: its square inverted, 0 where there is no normal. */
typedef struct surface_forms {
	real first_uu, first_uv, first_vv, second_uu, second_uv, second_vv, area, inverse2;
} surface_forms;

/* normal: by_v x by_u. least_area: the smallest length of it that is not rounding, squared. */
SHARED_FUNCTION surface_forms surface_forms_of(surface_jet j, surface_triple normal,
                                               real least_area)
{
	const real one = SPREAD(LITERAL(1.0));
	const real angle = SPREAD(SURFACE_ANGLE * SURFACE_ANGLE);
	surface_forms f;
	f.first_uu = triple_inner(j.u, j.u);
	f.first_uv = triple_inner(j.u, j.v);
	f.first_vv = triple_inner(j.v, j.v);
	f.second_uu = triple_inner(normal, j.uu);
	f.second_uv = triple_inner(normal, j.uv);
	f.second_vv = triple_inner(normal, j.vv);
	const real square = triple_inner(normal, normal);
	/* Comparisons that NaN fails: derivatives too large for the precision give no normal. */
	const mask regular = (square > least_area) & (square > angle * (f.first_uu * f.first_vv));
	/* Root and division side by side: neither waits for the other. */
	const real safe = CHOOSE(regular, square, one);
	f.area = SQUARE_ROOT(safe);
	f.inverse2 = CHOOSE(regular, one / safe, SPREAD(LITERAL(0.0)));
	return f;
}

SHARED_FUNCTION surface_shape surface_shape_from(surface_forms form, surface_triple normal)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real inverse = form.area * form.inverse2;
	surface_shape s;
	s.first_uu = form.first_uu;
	s.first_uv = form.first_uv;
	s.first_vv = form.first_vv;
	const real e = form.second_uu * inverse;
	const real f = form.second_uv * inverse;
	const real g = form.second_vv * inverse;
	const real gauss = FUSED(e, g, -(f * f)) * form.inverse2;
	const real mean = FUSED(e, s.first_vv, FUSED(g, s.first_uu, -((f + f) * s.first_uv))) *
	                  (SPREAD(LITERAL(0.5)) * form.inverse2);
	const real sum = mean + mean;
	const real bending = FUSED(sum, sum, -(gauss + gauss));
	s.regular = (form.inverse2 > zero) & (bending - bending == zero);
	s.normal.x = CHOOSE(s.regular, normal.x * inverse, zero);
	s.normal.y = CHOOSE(s.regular, normal.y * inverse, zero);
	s.normal.z = CHOOSE(s.regular, normal.z * inverse, zero);
	s.area = CHOOSE(s.regular, form.area, zero);
	s.second_uu = CHOOSE(s.regular, e, zero);
	s.second_uv = CHOOSE(s.regular, f, zero);
	s.second_vv = CHOOSE(s.regular, g, zero);
	s.gauss = CHOOSE(s.regular, gauss, zero);
	s.mean = CHOOSE(s.regular, mean, zero);
	s.bending = CHOOSE(s.regular, bending, zero);
	return s;
}

SHARED_FUNCTION surface_shape surface_shape_of(surface_jet j, real least_area)
{
	const surface_triple normal = triple_outer(j.v, j.u);
	return surface_shape_from(surface_forms_of(j, normal, least_area), normal);
}

/* Half the difference of the principal curvatures. */
SHARED_FUNCTION real surface_spread_of(surface_shape s)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real square = FUSED(s.mean, s.mean, -s.gauss);
	return SQUARE_ROOT(CHOOSE(square > zero, square, zero));
}

/* Second form in the orthonormal frame first = by_u / |by_u|, second = normal x first of the tangent
 * plane: the shape operator, a symmetric matrix. All 0 where there is no normal. */
typedef struct surface_frame {
	surface_triple first, second;
	real a, b, c;
} surface_frame;

SHARED_FUNCTION surface_frame surface_frame_of(surface_jet j, surface_shape s)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real square = CHOOSE(s.regular, s.first_uu, one);
	const real area = CHOOSE(s.regular, s.area, one);
	const real skew = s.first_uv / square;
	const real mixed = FUSED(-skew, s.second_uu, s.second_uv);
	surface_frame f;
	f.first = triple_scale(CHOOSE(s.regular, one / SQUARE_ROOT(square), zero), j.u);
	f.second = triple_outer(s.normal, f.first);
	/* by_v = skew * by_u - area / |by_u| * second */
	f.a = s.second_uu / square;
	f.b = -(mixed / area);
	f.c = FUSED(-skew, s.second_uv + mixed, s.second_vv) / area * (square / area);
	f.c = CHOOSE(s.regular, f.c, zero);
	return f;
}

/* Square of half the difference of the principal curvatures that is still rounding: the second
 * derivatives could all lie along the normal. */
SHARED_FUNCTION real surface_rounding_of(surface_jet j, surface_shape s)
{
	const real one = SPREAD(LITERAL(1.0));
	const real area = CHOOSE(s.regular, s.area, one);
	const real by_uu = s.first_vv / area / area;
	const real by_vv = s.first_uu / area / area;
	const real uu = triple_inner(j.uu, j.uu) * by_uu * by_uu;
	const real uv = triple_inner(j.uv, j.uv) * by_uu * by_vv;
	const real vv = triple_inner(j.vv, j.vv) * by_vv * by_vv;
	return SPREAD(SURFACE_ANGLE * SURFACE_ANGLE) * (uu + uv + vv);
}

/* Unit directions of k1 and k2, 0 at umbilics: the eigenvectors, by half the angle whose cosine and
 * sine the matrix gives. */
typedef struct surface_directions {
	surface_triple first, second;
} surface_directions;

SHARED_FUNCTION surface_directions surface_directions_of(surface_frame f, real rounding)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real apart_by = SPREAD(LITERAL(0.5)) * (f.a - f.c);
	const real square = FUSED(apart_by, apart_by, f.b * f.b);
	const mask apart = square > rounding;
	const real spread = SQUARE_ROOT(CHOOSE(apart, square, one));
	const real cosine = apart_by / spread;
	const real sine = f.b / spread;
	const mask steep = cosine < zero;
	const real large = one + CHOOSE(steep, -cosine, cosine);
	const real length = one / SQUARE_ROOT(FUSED(large, large, sine * sine));
	const real x = CHOOSE(apart, CHOOSE(steep, sine, large) * length, zero);
	const real y = CHOOSE(apart, CHOOSE(steep, large, sine) * length, zero);
	surface_directions d;
	d.first = triple_add(x, f.first, triple_scale(y, f.second));
	d.second = triple_add(-y, f.first, triple_scale(x, f.second));
	return d;
}

/* Normal curvatures (Letcher 4.3) along the x axis projected on the tangent plane and square to it;
 * 0 where the normal lies along x. */
typedef struct surface_sections {
	real along, across;
} surface_sections;

SHARED_FUNCTION surface_sections surface_sections_of(surface_frame f)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real x = f.first.x;
	const real y = f.second.x;
	const real square = FUSED(x, x, y * y);
	const mask inclined = square > SPREAD(SURFACE_ANGLE * SURFACE_ANGLE);
	const real safe = CHOOSE(inclined, square, one);
	const real twist = SPREAD(LITERAL(2.0)) * (x * y) * f.b;
	surface_sections k;
	k.along = FUSED(x * x, f.a, FUSED(y * y, f.c, twist)) / safe;
	k.across = FUSED(y * y, f.a, FUSED(x * x, f.c, -twist)) / safe;
	k.along = CHOOSE(inclined, k.along, zero);
	k.across = CHOOSE(inclined, k.across, zero);
	return k;
}

/* The mean curvature as it is stored. */
SHARED_FUNCTION real surface_mark(surface_shape s)
{
	return CHOOSE(s.regular, s.mean, SPREAD(LITERAL(SURFACE_NO_NORMAL)));
}

/* What a span of an integral adds up; all 0 before the first point. */
typedef struct surface_sums {
	real bending, mean, gauss, area, singular, variation, left_out;
} surface_sums;

SHARED_FUNCTION surface_sums surface_sums_zero(void)
{
	const real zero = SPREAD(LITERAL(0.0));
	const surface_sums sums = { zero, zero, zero, zero, zero, zero, zero };
	return sums;
}

SHARED_FUNCTION void surface_sums_add(surface_sums *sums, surface_shape s, scalar weight)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real area = SPREAD(weight) * s.area;
	sums->bending = FUSED(s.bending, area, sums->bending);
	sums->mean = FUSED(s.mean * s.mean, area, sums->mean);
	sums->gauss = FUSED(CHOOSE(s.gauss < zero, -s.gauss, s.gauss), area, sums->gauss);
	sums->area += area;
	sums->singular += CHOOSE(s.regular, zero, SPREAD(LITERAL(1.0)));
}

#endif
