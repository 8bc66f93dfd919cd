/*
 * The oracle: what the program's numbers are held against. Slow plain C in long double, by other
 * algorithms than the program's; it includes nothing of the program and shares no formula with it
 * (README.md says how each quantity is found and how exactly).
 *
 * Arrays over a table are waterline-major, index waterline * nx + station, as in batten.h. nodes: 0
 * is outside the hull, everything else on it; NULL: all on the hull. What lies outside is not read.
 * Functions return false (the long double ones NaN) when memory is short, a table has fewer than 3
 * lines in a direction, or coordinates do not ascend.
 */
#ifndef BATTEN_TESTS_ORACLE_H
#define BATTEN_TESTS_ORACLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- fairness and closeness of a table ----------------------------------------------------- */

typedef struct oracle_energies {
	long double bending; /* sum (k1^2 + k2^2) dS */
	long double mean;    /* sum ((k1 + k2) / 2)^2 dS */
	long double gauss;   /* sum |k1 k2| dS */
	long double area;    /* sum dS, of the same nodes */
	size_t terms;        /* nodes whose 3 x 3 neighbours are all on the hull */
} oracle_energies;
bool oracle_energy(size_t nx, size_t nz, const double *x, const double *z, const double *y,
                   const uint8_t *nodes, oracle_energies *out);

/* The surface at one inner node (0 < station < nx - 1, 0 < waterline < nz - 1). */
typedef struct oracle_shape {
	long double y_x, y_z, y_xx, y_xz, y_zz;
	long double k1, k2; /* principal curvatures, k1 <= k2, negative where the hull is convex */
	long double area;   /* dS */
} oracle_shape;
bool oracle_shape_at(size_t nx, size_t nz, const double *x, const double *z, const double *y,
                     size_t station, size_t waterline, oracle_shape *out);

/* sum weight (y - target)^2 dx dz over the nodes on the hull; weight may be NULL: 1. dx of a node
 * is half the sum of the spacings to its neighbours in the table, half a spacing at the table's
 * ends. */
long double oracle_closeness(size_t nx, size_t nz, const double *x, const double *z,
                             const double *y, const double *target, const double *weight,
                             const uint8_t *nodes);

/* ---- the objective ------------------------------------------------------------------------- */

/* Minimise w1 * bending + w2 * closeness / h^4, lower <= y <= upper; lower == upper is fixed. */
typedef struct oracle_problem {
	size_t nx, nz;
	const double *x, *z;
	const uint8_t *nodes;
	const double *start, *target;
	const double *lower, *upper;
	double w1, w2, h;
	const double *closeness_weight; /* or NULL: 1 everywhere */
} oracle_problem;

long double oracle_objective(const oracle_problem *problem, const double *y);

/* Derivative by each node's half-breadth, [nz][nx], 0 outside the hull: central differences of the
 * terms that touch the node, five steps, extrapolated. Bounds play no part. */
bool oracle_gradient(const oracle_problem *problem, const double *y, long double *gradient);

/* The same by the chain rule, derived by hand from the trace of the squared shape operator. */
bool oracle_gradient_by_hand(const oracle_problem *problem, const double *y, long double *gradient);

/* Second derivatives, dense, [nz * nx][nz * nx]: for small tables. */
bool oracle_hessian(const oracle_problem *problem, const double *y, long double *hessian);

/* hessian * direction, [nz][nx], by extrapolated differences of oracle_gradient_by_hand(). */
bool oracle_hessian_vector(const oracle_problem *problem, const double *y, const double *direction,
                           long double *product);

/* First-order movement of the minimiser away from the target as w2 grows,
 *     -w1 (d bending / dy) h^4 / (2 w2 weight dx dz),
 * at nodes with lower < upper, 0 elsewhere; what it leaves out falls as 1/w2^2. Where a weight is 0
 * it is infinite. */
bool oracle_first_order(const oracle_problem *problem, long double *movement);

/* ---- its minimum --------------------------------------------------------------------------- */

typedef struct oracle_minimum {
	long double objective, bending, closeness;
	/* What a further Newton step over the free nodes promises, relative to the objective. */
	long double promise;
	/* Largest move (m) of a gradient step, each node scaled by its own second derivative, cut at
	 * the bounds: 0 at a minimum. */
	long double residual;
	size_t variables, at_bound;
	unsigned evaluations; /* of the objective */
	unsigned iterations;
	bool converged;
} oracle_minimum;

/* A local minimum from problem->start (moved into the box), by a projected Newton method with
 * dense factors in long double. y may be start. Where closeness counts nothing (w2 or weights 0)
 * the bounds must pin the hull down: every plane has the energy 0, and the method then ends
 * unconverged. */
bool oracle_minimise(const oracle_problem *problem, double *y, oracle_minimum *out);

/* A second opinion: NLopt's LD_LBFGS in double on the gradient by hand, started again until nothing
 * is gained. promise is not found (0). */
bool oracle_minimise_lbfgs(const oracle_problem *problem, double *y, oracle_minimum *out);

/* ---- lines --------------------------------------------------------------------------------- */

/* Sum of squared second differences over the inner points of a line; 0 below three points. */
long double oracle_line_fairness(size_t count, const double *along, const double *value);

/* The second differences themselves; out[0] and out[count - 1] are 0. */
bool oracle_line_second_differences(size_t count, const double *along, const double *value,
                                    long double *out);

typedef enum oracle_ends { ORACLE_NATURAL, ORACLE_NOT_A_KNOT } oracle_ends;

/* Cubic spline through the points (2 or more; a line through two, with not-a-knot ends a parabola
 * through three): value, slope and second derivative at `at`; beyond the ends the last cubics go
 * on. */
bool oracle_spline(size_t count, const double *along, const double *value, oracle_ends ends,
                   double at, long double out[3]);

/* What holds at one end of a spline; value: the slope or second derivative given. */
typedef enum oracle_end { ORACLE_FREE, ORACLE_JOINED, ORACLE_SLOPE, ORACLE_BEND } oracle_end;
typedef struct oracle_condition {
	oracle_end end; /* FREE: no second derivative; JOINED: not-a-knot */
	double value;
} oracle_condition;

/* The same with a condition of its own at either end. Where a joined end has no point to be joined at
 * (two points) the third derivative is 0; both joined, as above. */
bool oracle_spline_mixed(size_t count, const double *along, const double *value,
                         oracle_condition first, oracle_condition last, double at,
                         long double out[3]);

/* Its integral from a to b, both within the points; NaN otherwise. */
long double oracle_spline_integral(size_t count, const double *along, const double *value,
                                   oracle_ends ends, double a, double b);

#endif
