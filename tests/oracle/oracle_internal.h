/* What the files of the oracle share among themselves. */
#ifndef BATTEN_TESTS_ORACLE_INTERNAL_H
#define BATTEN_TESTS_ORACLE_INTERNAL_H

#include "oracle.h"

#include <float.h>

/* The accuracies the tests ask for need the 64 bits of x86, or more. */
_Static_assert(LDBL_MANT_DIG >= 64, "the oracle needs a long double longer than double");

/* A table prepared for local work. */
typedef struct oracle_grid {
	size_t nx, nz;
	const uint8_t *nodes;
	uint8_t *whole;           /* [nz][nx]: 3 x 3 neighbours all on the hull */
	long double *quadratic_x; /* [nx][3][3]: coefficient of power a from value b of the parabola */
	long double *quadratic_z; /* [nz][3][3]  through three points, origin at the middle one */
	long double *width_x;     /* [nx], [nz]: half-sum spacings, half a spacing at the ends */
	long double *width_z;
} oracle_grid;

bool oracle_grid_create(size_t nx, size_t nz, const double *x, const double *z,
                        const uint8_t *nodes, oracle_grid *out);
void oracle_grid_release(oracle_grid *grid);
bool oracle_grid_on_hull(const oracle_grid *grid, size_t node);

enum { ORACLE_P, ORACLE_Q, ORACLE_R, ORACLE_S, ORACLE_T, ORACLE_DERIVATIVES };

/* Derivatives (p q r s t) = (y_x y_z y_xx y_xz y_zz) at an inner node. */
void oracle_derivatives(const oracle_grid *grid, const long double *y, size_t i, size_t j,
                        long double out[ORACLE_DERIVATIVES]);
/* Their weights of the node's nine neighbours, [derivative][(dj + 1) * 3 + (di + 1)]. */
void oracle_derivative_weights(const oracle_grid *grid, size_t i, size_t j,
                               long double out[ORACLE_DERIVATIVES][9]);
/* Eigenvalues of the shape operator, smaller first. */
void oracle_principal_curvatures(const long double d[ORACLE_DERIVATIVES], long double k[2]);
/* (k1^2 + k2^2) dS / (dx dz). */
long double oracle_bending_density(const long double d[ORACLE_DERIVATIVES]);

/* Bending over the whole table. */
long double oracle_bending_sum(const oracle_grid *grid, const long double *y);
long double oracle_closeness_sum(const oracle_grid *grid, const long double *y,
                                 const double *target, const double *weight);
long double oracle_objective_sum(const oracle_problem *problem, const oracle_grid *grid,
                                 const long double *y);
/* Factor of (y - target)^2 in the objective at a node. */
long double oracle_closeness_factor(const oracle_problem *problem, const oracle_grid *grid,
                                    size_t node);

/* y is disturbed and restored. */
void oracle_gradient_sum(const oracle_problem *problem, const oracle_grid *grid, long double *y,
                         long double *gradient);
void oracle_gradient_by_hand_sum(const oracle_problem *problem, const oracle_grid *grid,
                                 const long double *y, long double *gradient);
/* Second derivatives by the nodes that variable[] numbers (SIZE_MAX: none), dense, [count][count].
 * frozen: without the change of the metric; never indefinite. */
void oracle_hessian_sum(const oracle_problem *problem, const oracle_grid *grid,
                        const long double *y, const size_t *variable, size_t count, bool frozen,
                        long double *hessian);

/* The nodes that may move, ascending; returns how many. */
size_t oracle_variables(const oracle_problem *problem, size_t *node);
/* start, moved into the box, and 0 outside the hull. */
void oracle_start(const oracle_problem *problem, long double *y);
/* Writes y back as double, the nodes outside as start has them. */
void oracle_finish(const oracle_problem *problem, const long double *y, double *out);
/* Fills what both minimisers report. */
bool oracle_report(const oracle_problem *problem, const oracle_grid *grid, long double *y,
                   oracle_minimum *out);

/* Memory for count long doubles, zeroed. */
long double *oracle_reals(size_t count);
/* Gauss elimination with row pivots; the solution replaces right. False when singular. */
bool oracle_solve(size_t n, long double *matrix, long double *right);
/* L L^T in the lower triangle, a row's leading zeros skipped; false when not positive. */
bool oracle_cholesky(size_t n, long double *matrix, size_t *first);
void oracle_cholesky_solve(size_t n, const long double *factor, const size_t *first,
                           long double *right);

/* Differences are taken with the steps s, s/2, ... and extrapolated to 0: the even powers of the
 * step up to the tenth vanish. */
enum { ORACLE_LEVELS = 5 };
long double oracle_extrapolate(long double column[ORACLE_LEVELS]);

#endif
