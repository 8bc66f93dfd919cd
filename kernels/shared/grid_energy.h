/* The objective of one node of an offset grid: fairness of the graph surface y(x, z) by differences
 * over 3 x 3 nodes (thesis 7.1; Letcher 4.5), and closeness. */
#ifndef BATTEN_SHARED_GRID_ENERGY_H
#define BATTEN_SHARED_GRID_ENERGY_H

#include "dialect.h"
#include "search_layout.h"

/* A product and a sum: rounded once where the includer has defined GRID_FUSED as 1, so that its C path is to
 * be compiled for processors with a multiply-add too. */
#if !defined(GRID_FUSED)
#define GRID_FUSED 0
#endif
#if GRID_FUSED
#define PRODUCT_AND(a, b, c) FUSED(a, b, c)
#else
#define PRODUCT_AND(a, b, c) ((a) * (b) + (c))
#endif

/* Weights of one direction's three-point differences at a node, exact for parabolas at any spacing:
 * with d = here - below and e = above - here, the first derivative is w[0] d + w[1] e, the second
 * w[3] e - w[2] d. Differences first: they are exact where neighbours are close, which f32 needs. */
#define STENCIL_SIZE 4

/* Weights of the third derivative by five nodes, one a difference of two neighbours. */
#define STENCIL_THIRD 4

/* Three neighbours in a row along x. */
typedef struct node_row {
	real aft, here, fore;
} node_row;

/* The derivatives of y at a node, and as they are kept. */
typedef struct node_slopes {
	real y_x, y_z, y_xx, y_xz, y_zz;
} node_slopes;

typedef struct stored_slopes {
	stored y_x, y_z, y_xx, y_xz, y_zz;
} stored_slopes;

SHARED_FUNCTION real stencil_first(scalar w0, scalar w1, real below, real here, real above)
{
	return PRODUCT_AND(SPREAD(w0), here - below, w1 * (above - here));
}

SHARED_FUNCTION real stencil_second(scalar w2, scalar w3, real below, real here, real above)
{
	return PRODUCT_AND(SPREAD(w3), above - here, -(w2 * (here - below)));
}

/* The stencils of a node's station and waterline. */
typedef struct node_stencil {
	scalar x[STENCIL_SIZE], z[STENCIL_SIZE];
} node_stencil;

SHARED_FUNCTION node_slopes slopes_of(node_stencil w, node_row below, node_row here, node_row above)
{
	node_slopes s;
	const real lower = stencil_first(w.x[0], w.x[1], below.aft, below.here, below.fore);
	const real upper = stencil_first(w.x[0], w.x[1], above.aft, above.here, above.fore);
	s.y_x = stencil_first(w.x[0], w.x[1], here.aft, here.here, here.fore);
	s.y_z = stencil_first(w.z[0], w.z[1], below.here, here.here, above.here);
	s.y_xx = stencil_second(w.x[2], w.x[3], here.aft, here.here, here.fore);
	s.y_xz = stencil_first(w.z[0], w.z[1], lower, s.y_x, upper);
	s.y_zz = stencil_second(w.z[2], w.z[3], below.here, here.here, above.here);
	return s;
}

/* What the fairness of a node takes of the slopes alone, and with them root and division. Plain bending has
 * no skew and no first_inverse, the others no `across` and no twice_product. */
typedef struct node_tangent {
	real along, across; /* 1 + y_x^2, 1 + y_z^2 */
	real square;        /* of the area element: 1 + y_x^2 + y_z^2 */
	real inverse, root; /* 1 / square and its root */
	real twice_product; /* 2 y_x y_z */
	real first_inverse, skew;
} node_tangent;

SHARED_FUNCTION node_tangent tangent_of(int kind, real y_x, real y_z)
{
	const real one = SPREAD(LITERAL(1.0));
	const real q2 = y_z * y_z;
	node_tangent t;
	t.along = PRODUCT_AND(y_x, y_x, one);
	t.across = one + q2;
	t.square = t.along + q2;
	t.inverse = one / t.square;
	t.root = SQUARE_ROOT(t.inverse);
	const real product = y_x * y_z;
	t.twice_product = product + product;
	t.first_inverse = t.inverse;
	t.skew = t.inverse;
	if (kind == GRID_BENDING_WEIGHTED || kind == GRID_MEAN) {
		t.first_inverse = one / t.along;
		t.skew = (y_x * y_z) * t.first_inverse;
	}
	return t;
}

/* (k1^2 + k2^2) dS / (dx dz) with k1, k2 the principal curvatures: (4 H^2 - 2 K) times
 * sqrt(1 + y_x^2 + y_z^2), written with one division and one root. */
SHARED_FUNCTION real bending_of(node_tangent t, real y_xx, real y_xz, real y_zz)
{
	const real across = PRODUCT_AND(-t.twice_product, y_xz, t.across * y_xx);
	const real mean = PRODUCT_AND(t.along, y_zz, across);
	const real gauss = PRODUCT_AND(y_xx, y_zz, -(y_xz * y_xz));
	const real sum = PRODUCT_AND(mean * mean, t.inverse, -(gauss + gauss));
	return (sum * t.inverse) * t.root;
}

SHARED_FUNCTION real bending_density(node_slopes s)
{
	return bending_of(tangent_of(GRID_BENDING, s.y_x, s.y_z), s.y_xx, s.y_xz, s.y_zz);
}

/* Longitudinal curvature, of the section along the tangent of the waterline, and transverse
 * curvature, square to it in the surface, may count differently (Letcher 4.5): the shape operator in
 * this frame is scaled by these numbers, roots of the weights of the squared curvatures. */
typedef struct grid_weights {
	real along, across;
	real blunt; /* square of the Gauss curvature below which its amount is rounded off */
} grid_weights;

/* A fairness other than plain bending, times dS / (dx dz). With E = 1 + y_x^2, W^2 = E + y_z^2 and
 * f = y_x y_z / E the operator has the entries y_xx / (E W), (y_xz - f y_xx) / W^2 and
 * (y_zz - 2 f y_xz + f^2 y_xx) E / W^3. */
SHARED_FUNCTION real weighted_of(int kind, grid_weights w, node_tangent t, real y_xx, real y_xz,
                                 real y_zz)
{
	const real two = SPREAD(LITERAL(2.0));
	const real both = w.along * w.across;
	if (kind == GRID_GAUSS) {
		const real gauss = ((y_xx * y_zz - y_xz * y_xz) * both) * t.inverse;
		return SQUARE_ROOT((gauss * gauss) * t.inverse + w.blunt * t.square);
	}
	const real twist = y_xz - t.skew * y_xx;
	const real turned = (y_zz - t.skew * y_xz) - t.skew * twist;
	const real along = w.along * (y_xx * t.first_inverse);
	const real across = w.across * (turned * (t.along * t.inverse));
	if (kind == GRID_MEAN) {
		const real sum = along + across;
		return (SPREAD(LITERAL(0.25)) * (sum * sum)) * t.root;
	}
	return ((along * along + across * across) + ((two * both) * (twist * twist)) * t.inverse) *
	       t.root;
}

/* The fairness of a kind (search_layout.h), times dS / (dx dz). kind is a constant in OpenCL, so that
 * only one of them is compiled. */
SHARED_FUNCTION real fairness_of(int kind, grid_weights w, node_tangent t, real y_xx, real y_xz,
                                 real y_zz)
{
	return kind == GRID_BENDING ? bending_of(t, y_xx, y_xz, y_zz)
	                            : weighted_of(kind, w, t, y_xx, y_xz, y_zz);
}

SHARED_FUNCTION real node_fairness(int kind, grid_weights w, node_slopes s)
{
	return fairness_of(kind, w, tangent_of(kind, s.y_x, s.y_z), s.y_xx, s.y_xz, s.y_zz);
}

/* A node's part of the objective for its fairness. bend = w1 dx dz where the node's 3 x 3 neighbours are
 * all on the hull, else 0: what lies beyond the hull's edge then never counts, whatever it is. */
SHARED_FUNCTION real node_energy(real bend, real fairness)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real energy = bend * fairness;
	return CHOOSE(bend > zero, energy, zero);
}

/* That for its closeness. */
SHARED_FUNCTION real node_closeness(real close, real y, real target)
{
	const real off = y - target;
	return close * (off * off);
}

/* One node's part of the objective. */
SHARED_FUNCTION real node_objective(int kind, grid_weights w, node_slopes s, real bend, real close,
                                    real y, real target)
{
	return node_energy(bend, node_fairness(kind, w, s)) + node_closeness(close, y, target);
}

/* One node's part of the interior penalty (thesis 7.1; Fiacco and McCormick): r (1/g + 1/g') with g and g'
 * the ways to its bounds as parts of the box's width, so that their sum is 1 and that of their inverses
 * their product's. A node that is held has none. */
SHARED_FUNCTION real node_penalty(real r, real y, real lower, real upper)
{
	const real one = SPREAD(LITERAL(1.0));
	const real width = upper - lower;
	const mask held = !(width > SPREAD(LITERAL(0.0)));
	const real down = CHOOSE(held, one, y - lower);
	const real up = CHOOSE(held, one, upper - y);
	return CHOOSE(held, SPREAD(LITERAL(0.0)), r * ((width / down) * (width / up)));
}

#endif
