/* One polynomial through, or near, points (thesis 3.1): in each of its forms a sum of coefficients times
 * basis functions. All of them work with u, the parameter scaled to -1..1. */
#ifndef BATTEN_GEOMETRY_POLYNOMIAL_H
#define BATTEN_GEOMETRY_POLYNOMIAL_H

#include "core/context.h"

enum {
	POLYNOMIAL_POINTS_MOST = 64,        /* of an interpolation: beyond, no form keeps any digit */
	POLYNOMIAL_DERIVATIVES = 4,         /* value to third derivative */
	POLYNOMIAL_LEAST_SQUARES_MOST = 31, /* degree */
};

enum polynomial_basis {
	POLYNOMIAL_MONOMIAL,  /* powers of u: Vandermonde's system, by an orthogonal method */
	POLYNOMIAL_LAGRANGE,  /* products that are 1 at one point and 0 at the others */
	POLYNOMIAL_NEWTON,    /* products over the points before: divided differences */
	POLYNOMIAL_CHEBYSHEV, /* least squares; a lower degree than points - 1 */
};

struct polynomial {
	batten_context *context;
	enum polynomial_basis basis;
	size_t count, width;  /* basis functions, coordinates */
	double first, last;   /* of the parameter */
	double *places;       /* [count]: u of the points (Lagrange, Newton) */
	double *factors;      /* [count]: 1 over Lagrange's products */
	double *coefficients; /* [count][width] */
};

/* parameters ascending, points >= 2; values [points][width], width 1..3. degree is that of a least
 * squares polynomial (0..points - 1), which the interpolating forms ignore. Errors: USAGE (more
 * points than POLYNOMIAL_POINTS_MOST, a degree out of its range), INPUT (to be told from rounding no
 * more), MEMORY. */
batten_status polynomial_create(batten_context *context, enum polynomial_basis basis, size_t points,
                                const double *parameters, size_t width, const double *values,
                                size_t degree, struct polynomial *out);
void polynomial_destroy(struct polynomial *polynomial);

/* out[derivative][coordinate] */
void polynomial_evaluate(const struct polynomial *polynomial, double t,
                         double out[POLYNOMIAL_DERIVATIVES][3]);

#endif
