/*
 * The oracle for B-spline curves and surfaces: slow plain C in long double. Points by de Boor's
 * recursion over the control points, derivatives by differencing the control points, no basis
 * functions; rational ones in homogeneous coordinates. It includes nothing of the program.
 *
 * The order is the degree + 1, 2 to 8; count + order knots, not decreasing. The range of a
 * parameter is [knots[order - 1], knots[count]]; a knot belongs to the span that begins there, the
 * end of the range to the last span. Beyond the range the first or last polynomials go on.
 * Functions return false where orders, counts, knots or weights make no curve, or a place has no
 * value (a weight function of 0).
 */
#ifndef BATTEN_TESTS_ORACLE_BSPLINE_H
#define BATTEN_TESTS_ORACLE_BSPLINE_H

#include "oracle.h"

enum { ORACLE_ORDER_MOST = 8, ORACLE_ORDERS = 4 /* derivatives 0..3 */ };

typedef struct oracle_curve {
	size_t order, count, dimension; /* dimension 1..3 */
	const double *knots;
	const double *poles;   /* [count][dimension] */
	const double *weights; /* [count], or NULL: all 1 */
} oracle_curve;

typedef struct oracle_surface {
	size_t order_u, order_v;
	size_t count_u, count_v;
	const double *knots_u, *knots_v;
	const double *poles;   /* [count_v][count_u][3] */
	const double *weights; /* [count_v][count_u], or NULL: all 1 */
} oracle_surface;

/* derivative[d][coordinate], d = 0..3; coordinates beyond the dimension are 0. */
bool oracle_curve_at(const oracle_curve *curve, long double t,
                     long double derivative[ORACLE_ORDERS][3]);

/* derivative[a][b][coordinate]: a times by u, b times by v, a + b <= 3; the others are 0. */
typedef long double oracle_jet[ORACLE_ORDERS][ORACLE_ORDERS][3];
bool oracle_surface_at(const oracle_surface *surface, long double u, long double v,
                       oracle_jet derivative);

/* The span that (u, v) belongs to, numbered by the knots where it begins, and the polynomials of a
 * given one, wherever (u, v) lies: values from either side of a knot. */
bool oracle_surface_spans(const oracle_surface *surface, long double u, long double v,
                          size_t span[2]);
bool oracle_surface_in_span(const oracle_surface *surface, const size_t span[2], long double u,
                            long double v, oracle_jet derivative);

/* How large the terms are that add up to each derivative: an evaluation in shorter arithmetic errs
 * by a small multiple of its rounding unit times this. */
bool oracle_surface_magnitude(const oracle_surface *surface, long double u, long double v,
                              oracle_jet magnitude);

/* What the first and second derivatives say about the surface there. */
typedef struct oracle_forms {
	long double first[3];        /* E F G */
	long double second[3];       /* e f g with the normal below */
	long double normal[3];       /* x_u x x_v over its length; 0 where singular */
	long double area;            /* length of x_u x x_v */
	long double k[2];            /* principal curvatures, k[0] <= k[1] */
	long double direction[2][3]; /* their unit directions, at right angles */
	long double gauss, mean;     /* K = k1 k2, H = (k1 + k2) / 2 */
	/* False where x_u or x_v vanishes or their angle's sine is below 1e-12: what needs a tangent
	 * plane is 0 there. */
	bool regular;
} oracle_forms;
void oracle_surface_forms(const oracle_jet derivative, oracle_forms *out);

/* Squared derivatives of each principal curvature along its own direction, summed: the density of
 * the variation of curvature. By extrapolated differences over the polynomials of one span; NaN at
 * umbilics (|k1 - k2| <= apart) and singular points. */
long double oracle_surface_variation(const oracle_surface *surface, long double u, long double v,
                                     long double apart);

/* Gauss and Legendre's nodes on [-1, 1], ascending, and their weights. */
void oracle_gauss(size_t count, long double *node, long double *weight);

/* Integral of density dS, `nodes` (at most 64) Gauss nodes per span and direction; singular ones
 * are left out and counted (singular may be NULL). */
typedef long double oracle_density(const oracle_jet derivative, const oracle_forms *forms,
                                   const void *data);
bool oracle_surface_integral(const oracle_surface *surface, size_t nodes, oracle_density *density,
                             const void *data, long double *out, size_t *singular);

/* The energies of the surface; |K| is taken as sqrt(K^2 + rounding^2). terms: regular nodes. */
bool oracle_surface_energy(const oracle_surface *surface, size_t nodes, double rounding,
                           oracle_energies *out);

#endif
