/* Bending and mean curvature of a surface at a sample, and what they do when the derivatives of y there change.
 *
 * With n = by_v x by_u, W = |n|^2, the metric E, F, G, and the second form times |n|, e, f, g, the curvatures of the
 * surface in the frame of by_u and of what is square to it are, all times the root of |n|,
 *     first = W^(-1/4) e / E,  middle = W^(-3/4) (f - k e),  last = W^(-5/4) E (g - 2 k f + k^2 e),  k = F / E,
 * and the energies sums of their squares: first^2 + 2 middle^2 + last^2, and ((first + last) / 2)^2. So what they do
 * along a way is told by how each of these numbers changes: their slopes, and what a parabola takes of the squares
 * of these (Gauss and Newton), which is never below 0. e, f, g are linear in each derivative, so that one probe of
 * any size tells what y_uu, y_uv, y_vv change; y_u and y_v are probed close by. */
#ifndef BATTEN_SHARED_NET_BLOCK_PROBES_H
#define BATTEN_SHARED_NET_BLOCK_PROBES_H

#include "dialect.h"
#include "net_block_layout.h"

/* Close enough for a slope by differences, far enough from its rounding. */
#if BATTEN_DOUBLE
#define NET_BLOCK_NEAR LITERAL(0.0001220703125) /* 2^-13 */
#else
#define NET_BLOCK_NEAR LITERAL(0.00390625) /* 2^-8 */
#endif

/* Derivatives of the way from the target. */
typedef struct net_way {
	real at, u, v, uu, uv, vv;
} net_way;

typedef struct net_metric {
	real n_x, n_y, n_z;
	real uu, uv, vv; /* E, F, G */
	real square;     /* W */
} net_metric;

/* u, v: derivatives of y. */
SHARED_FUNCTION net_metric net_metric_of(const STATE stored *sample, real u, real v)
{
	const real x_u = AT(sample[NET_BLOCK_XU]), x_v = AT(sample[NET_BLOCK_XV]);
	const real z_u = AT(sample[NET_BLOCK_ZU]), z_v = AT(sample[NET_BLOCK_ZV]);
	net_metric m;
	m.n_x = FUSED(v, z_u, -(u * z_v));
	m.n_y = FUSED(x_u, z_v, -(z_u * x_v));
	m.n_z = FUSED(u, x_v, -(v * x_u));
	m.uu = FUSED(u, u, FUSED(x_u, x_u, z_u * z_u));
	m.uv = FUSED(u, v, FUSED(x_u, x_v, z_u * z_v));
	m.vv = FUSED(v, v, FUSED(x_v, x_v, z_v * z_v));
	m.square = FUSED(m.n_x, m.n_x, FUSED(m.n_y, m.n_y, m.n_z * m.n_z));
	return m;
}

/* A sample with the net at hand. */
typedef struct net_forms {
	int bends; /* bending, or the mean curvature */
	mask has;  /* it has an energy */
	real at;   /* the way from the target */
	real u, v; /* derivatives of y */
	net_metric metric;
	real e, f, g;
	real by_square, by_uu, by_vv; /* 1 / W, 1 / E, 1 / G */
	real root;                    /* of 1 / W */
	real k;
} net_forms;

/* Where a sample has no energy what is worked is finite, and its weight is 0. */
SHARED_FUNCTION net_forms net_forms_of(const STATE stored *sample, net_way way, int bends)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const STATE stored *target = sample + NET_BLOCK_TARGET;
	net_forms s;
	s.bends = bends;
	s.has = AT(sample[NET_BLOCK_ROOT]) > zero;
	s.at = way.at;
	s.u = AT(target[0]) + way.u;
	s.v = AT(target[1]) + way.v;
	s.metric = net_metric_of(sample, s.u, s.v);
	const real n_y = s.metric.n_y;
	s.e = FUSED(AT(sample[NET_BLOCK_UU]), s.u,
	            FUSED(AT(sample[NET_BLOCK_UU + 1]), s.v, n_y * (AT(target[2]) + way.uu)));
	s.f = FUSED(AT(sample[NET_BLOCK_UV]), s.u,
	            FUSED(AT(sample[NET_BLOCK_UV + 1]), s.v, n_y * (AT(target[3]) + way.uv)));
	s.g = FUSED(AT(sample[NET_BLOCK_VV]), s.u,
	            FUSED(AT(sample[NET_BLOCK_VV + 1]), s.v, n_y * (AT(target[4]) + way.vv)));
	s.metric.square = CHOOSE(s.has, s.metric.square, one);
	s.metric.uu = CHOOSE(s.has, s.metric.uu, one);
	s.metric.vv = CHOOSE(s.has, s.metric.vv, one);
	/* One division for three. */
	const real across = s.metric.uu * s.metric.vv;
	const real inverse = one / (across * s.metric.square);
	s.by_square = inverse * across;
	s.by_uu = inverse * (s.metric.vv * s.metric.square);
	s.by_vv = inverse * (s.metric.uu * s.metric.square);
	s.root = SQUARE_ROOT(s.by_square);
	s.k = s.metric.uv * s.by_uu;
	return s;
}

/* The sample's part of the objective. */
SHARED_FUNCTION real net_forms_objective(const STATE stored *sample, const net_forms *s)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real half_of = SPREAD(LITERAL(0.5));
	const real two = SPREAD(LITERAL(2.0));
	const real first = s->e * s->by_uu;
	const real middle = FUSED(-s->k, s->e, s->f);
	const real last = (s->by_square * s->metric.uu) * FUSED(-s->k, s->f + middle, s->g);
	const real mean = half_of * (first + last);
	const real squares = s->bends ? FUSED(first, first,
	                                      FUSED((two * s->by_square) * middle, middle, last * last))
	                              : mean * mean;
	const real weight = half_of * (AT(sample[NET_BLOCK_ROOT]) * AT(sample[NET_BLOCK_ROOT]));
	const real energy = (weight * s->root) * squares;
	return FUSED(AT(sample[NET_BLOCK_CLOSE]) * s->at, s->at, CHOOSE(s->has, energy, zero));
}

/* The three numbers; middle with the root of its 2. */
typedef struct net_bends {
	real first, middle, last;
} net_bends;

/* Roots of 1 / W, the fourth and the second, and 1 / W. */
SHARED_FUNCTION net_bends net_bends_of(real fourth, real root, real by_square, real uu, real by_uu,
                                       real uv, real e, real f, real g)
{
	const real k = uv * by_uu;
	const real off = FUSED(-k, e, f);
	net_bends b;
	b.first = fourth * (e * by_uu);
	b.middle = (SPREAD(LITERAL(1.4142135623730951)) * (fourth * root)) * off;
	b.last = (fourth * (by_square * uu)) * FUSED(-k, f + off, g);
	return b;
}

/* How y_u, or y_v, changes e, f, g, F and W, and whether it is y_u, which changes E. */
typedef struct net_turn {
	real e, f, g, uv, square, square_twice;
	int along_u;
} net_turn;

/* The numbers where the derivative is `by` more. What W and E are the powers of there comes from those here, by
 * series: the changes d of both, as parts, are about NET_BLOCK_NEAR, and what is left out, d^4, is below
 * rounding. */
SHARED_FUNCTION net_bends net_bends_near(const net_forms *s, real fourth, const net_turn *t,
                                         real by)
{
	const real one = SPREAD(LITERAL(1.0));
	const real d = (by * FUSED(by, t->square_twice, t->square)) * s->by_square;
	const real rise = t->along_u ? (by * (s->u + (s->u + by))) * s->by_uu : SPREAD(LITERAL(0.0));
	const real fall = rise * FUSED(-rise, one - rise, one);
	const real d_1 = d * FUSED(-d, one - d, one);
	const real d_2 = d * FUSED(-d, FUSED(-SPREAD(LITERAL(0.3125)), d, SPREAD(LITERAL(0.375))),
	                           SPREAD(LITERAL(0.5)));
	const real d_4 = d * FUSED(-d, FUSED(-SPREAD(LITERAL(0.1171875)), d, SPREAD(LITERAL(0.15625))),
	                           SPREAD(LITERAL(0.25)));
	return net_bends_of(FUSED(-fourth, d_4, fourth), FUSED(-s->root, d_2, s->root),
	                    FUSED(-s->by_square, d_1, s->by_square),
	                    FUSED(s->metric.uu, rise, s->metric.uu), FUSED(-s->by_uu, fall, s->by_uu),
	                    FUSED(by, t->uv, s->metric.uv), FUSED(by, t->e, s->e),
	                    FUSED(by, t->f, s->f), FUSED(by, t->g, s->g));
}

/* Half the difference of two probes over how far they are from here. */
SHARED_FUNCTION net_bends net_bends_slope(net_bends plus, net_bends minus, real by)
{
	net_bends b;
	b.first = (plus.first - minus.first) * by;
	b.middle = (plus.middle - minus.middle) * by;
	b.last = (plus.last - minus.last) * by;
	return b;
}

/* Puts what a derivative changes, number n of the five. */
SHARED_FUNCTION void net_put_bends(const net_forms *s, STATE stored *to, int n, net_bends b)
{
	const real half_of = SPREAD(LITERAL(0.5));
	AT(to[NET_BLOCK_LAST + n]) = s->bends ? b.last : half_of * (b.first + b.last);
	if (s->bends && n < 4)
		AT(to[NET_BLOCK_MIDDLE + n]) = b.middle;
	if (s->bends && n < 3)
		AT(to[NET_BLOCK_FIRST + n]) = b.first;
}

/* A sample that is about to be probed, with the roots that takes: they are worked for several samples before the first
 * is probed, since a processor waits for a root long enough to begin others. */
typedef struct net_ready {
	net_forms forms;
	real fourth;               /* of 1 / W */
	real inverse_u, inverse_v; /* how far y_u and y_v turn the normal */
} net_ready;

SHARED_FUNCTION net_ready net_ready_of(const STATE stored *sample, net_way way, int bends)
{
	net_ready ready;
	ready.forms = net_forms_of(sample, way, bends);
	ready.fourth = SQUARE_ROOT(ready.forms.root);
	ready.inverse_u = SQUARE_ROOT(ready.forms.metric.vv * ready.forms.by_square);
	ready.inverse_v = SQUARE_ROOT(ready.forms.metric.uu * ready.forms.by_square);
	return ready;
}

/* What y_u and y_v change. How near they are probed: as far as turns the normal by about NET_BLOCK_NEAR. */
SHARED_FUNCTION void net_probe_near(const STATE stored *sample, const net_ready *ready, real weight,
                                    STATE stored *to)
{
	const real two = SPREAD(LITERAL(2.0));
	const net_forms *s = &ready->forms;
	const real fourth = ready->fourth;
	const real inverse_u = ready->inverse_u, inverse_v = ready->inverse_v;
	const real near = SPREAD(NET_BLOCK_NEAR) * s->metric.square;
	const real x_u = AT(sample[NET_BLOCK_XU]), x_v = AT(sample[NET_BLOCK_XV]);
	const real z_u = AT(sample[NET_BLOCK_ZU]), z_v = AT(sample[NET_BLOCK_ZV]);
	const real n_x = s->metric.n_x, n_z = s->metric.n_z;
	const real by_u = near * (s->by_vv * inverse_u);
	const real by_v = near * (s->by_uu * inverse_v);
	const real by_half = SPREAD(LITERAL(0.5) / NET_BLOCK_NEAR) * weight;
	const net_turn u = { AT(sample[NET_BLOCK_UU]),
		                 AT(sample[NET_BLOCK_UV]),
		                 AT(sample[NET_BLOCK_VV]),
		                 s->v,
		                 two * FUSED(n_z, x_v, -(n_x * z_v)),
		                 FUSED(x_v, x_v, z_v * z_v),
		                 1 };
	const net_turn v = { AT(sample[NET_BLOCK_UU + 1]),
		                 AT(sample[NET_BLOCK_UV + 1]),
		                 AT(sample[NET_BLOCK_VV + 1]),
		                 s->u,
		                 two * FUSED(n_x, z_u, -(n_z * x_u)),
		                 FUSED(x_u, x_u, z_u * z_u),
		                 0 };
	net_put_bends(s, to, 0,
	              net_bends_slope(net_bends_near(s, fourth, &u, by_u),
	                              net_bends_near(s, fourth, &u, -by_u), by_half * inverse_u));
	net_put_bends(s, to, 1,
	              net_bends_slope(net_bends_near(s, fourth, &v, by_v),
	                              net_bends_near(s, fourth, &v, -by_v), by_half * inverse_v));
}

/* What y_uu, y_uv and y_vv change. */
SHARED_FUNCTION void net_probe_far(const net_forms *s, real fourth, real weight, STATE stored *to)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real n_y = weight * s->metric.n_y;
	UNROLLED
	for (int n = 0; n < 3; n++)
		net_put_bends(s, to, 2 + n,
		              net_bends_of(fourth, s->root, s->by_square, s->metric.uu, s->by_uu,
		                           s->metric.uv, n == 0 ? n_y : zero, n == 1 ? n_y : zero,
		                           n == 2 ? n_y : zero));
}

/* All that is probed at a sample; what y_u and y_v change counts `part`. Returns the energy there. */
SHARED_FUNCTION real net_probe(const STATE stored *sample, const net_ready *ready, real part,
                               STATE stored *to)
{
	const real half_of = SPREAD(LITERAL(0.5));
	const net_forms *s = &ready->forms;
	const real weight = AT(sample[NET_BLOCK_ROOT]);
	const net_bends here = net_bends_of(ready->fourth, s->root, s->by_square, s->metric.uu,
	                                    s->by_uu, s->metric.uv, s->e, s->f, s->g);
	net_probe_near(sample, ready, weight * part, to);
	net_probe_far(s, ready->fourth, weight, to);
	const real last = weight * (s->bends ? here.last : half_of * (here.first + here.last));
	const real middle = weight * here.middle, first = weight * here.first;
	UNROLLED
	for (int n = 0; n < 5; n++) {
		real slope = last * AT(to[NET_BLOCK_LAST + n]);
		if (s->bends && n < 4)
			slope = FUSED(middle, AT(to[NET_BLOCK_MIDDLE + n]), slope);
		if (s->bends && n < 3)
			slope = FUSED(first, AT(to[NET_BLOCK_FIRST + n]), slope);
		AT(to[NET_BLOCK_SLOPE + n]) = slope;
	}
	const real squares = s->bends ? FUSED(first, first, FUSED(middle, middle, last * last))
	                              : last * last;
	return half_of * squares;
}

#endif
