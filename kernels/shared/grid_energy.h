/* The objective of one node of an offset grid: fairness of the graph surface y(x, z) by differences
 * over 3 x 3 nodes (thesis 7.1; Letcher 4.5), and closeness. */
#ifndef BATTEN_SHARED_GRID_ENERGY_H
#define BATTEN_SHARED_GRID_ENERGY_H

#include "dialect.h"
#include "search_layout.h"

/* Weights of one direction's three-point differences at a node, exact for parabolas at any spacing:
 * with d = here - below and e = above - here, the first derivative is w[0] d + w[1] e, the second
 * w[3] e - w[2] d. Differences first: they are exact where neighbours are close, which f32 needs. */
#define STENCIL_SIZE 4

/* Three neighbours in a row along x. */
typedef struct node_row {
	real aft, here, fore;
} node_row;

/* The derivatives of y at a node. */
typedef struct node_slopes {
	real y_x, y_z, y_xx, y_xz, y_zz;
} node_slopes;

SHARED_FUNCTION real stencil_first(scalar w0, scalar w1, real below, real here, real above)
{
	return w0 * (here - below) + w1 * (above - here);
}

SHARED_FUNCTION real stencil_second(scalar w2, scalar w3, real below, real here, real above)
{
	return w3 * (above - here) - w2 * (here - below);
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

/* (k1^2 + k2^2) dS / (dx dz) with k1, k2 the principal curvatures: (4 H^2 - 2 K) times
 * sqrt(1 + y_x^2 + y_z^2), written with one division and one root. */
SHARED_FUNCTION real bending_density(node_slopes s)
{
	const real one = SPREAD(LITERAL(1.0));
	const real two = SPREAD(LITERAL(2.0));
	const real p2 = s.y_x * s.y_x;
	const real q2 = s.y_z * s.y_z;
	const real inverse = one / ((one + p2) + q2);
	const real mean = ((one + q2) * s.y_xx - (two * (s.y_x * s.y_z)) * s.y_xz) +
	                  (one + p2) * s.y_zz;
	const real gauss = s.y_xx * s.y_zz - s.y_xz * s.y_xz;
	const real sum = (mean * mean) * inverse - two * gauss;
	return (sum * inverse) * SQUARE_ROOT(inverse);
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
SHARED_FUNCTION real weighted_density(int kind, grid_weights w, node_slopes s)
{
	const real one = SPREAD(LITERAL(1.0));
	const real two = SPREAD(LITERAL(2.0));
	const real first = one + s.y_x * s.y_x;
	const real square = first + s.y_z * s.y_z;
	const real inverse = one / square;
	const real both = w.along * w.across;
	if (kind == GRID_GAUSS) {
		const real gauss = ((s.y_xx * s.y_zz - s.y_xz * s.y_xz) * both) * inverse;
		return SQUARE_ROOT((gauss * gauss) * inverse + w.blunt * square);
	}
	const real first_inverse = one / first;
	const real skew = (s.y_x * s.y_z) * first_inverse;
	const real twist = s.y_xz - skew * s.y_xx;
	const real turned = (s.y_zz - skew * s.y_xz) - skew * twist;
	const real along = w.along * (s.y_xx * first_inverse);
	const real across = w.across * (turned * (first * inverse));
	const real root = SQUARE_ROOT(inverse);
	if (kind == GRID_MEAN) {
		const real sum = along + across;
		return (SPREAD(LITERAL(0.25)) * (sum * sum)) * root;
	}
	return ((along * along + across * across) + ((two * both) * (twist * twist)) * inverse) * root;
}

/* The fairness of a kind (search_layout.h), times dS / (dx dz). kind is a constant in OpenCL, so that
 * only one of them is compiled. */
SHARED_FUNCTION real node_fairness(int kind, grid_weights w, node_slopes s)
{
	return kind == GRID_BENDING ? bending_density(s) : weighted_density(kind, w, s);
}

/* One node's part of the objective. bend = w1 dx dz where the node's 3 x 3 neighbours are all on the
 * hull, else 0: what lies beyond the hull's edge then never counts, whatever it is. */
SHARED_FUNCTION real node_objective(int kind, grid_weights w, node_slopes s, real bend, real close,
                                    real y, real target)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real off = y - target;
	const real energy = bend * node_fairness(kind, w, s);
	return CHOOSE(bend > zero, energy, zero) + close * (off * off);
}

#endif
