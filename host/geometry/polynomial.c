#include "geometry/polynomial.h"

#include "geometry/least_squares.h"

#include <math.h>
#include <string.h>

/* A value with its first three Taylor coefficients in u. */
struct taylor {
	double c[POLYNOMIAL_DERIVATIVES];
};

/* What runs from one basis function to the next: this one, and Chebyshev's before. */
struct walk {
	struct taylor here, before;
};

static double scaled(const struct polynomial *polynomial, double t)
{
	return ((t - polynomial->first) - (polynomial->last - t)) /
	       (polynomial->last - polynomial->first);
}

/* Times (value + epsilon). */
static void multiply_linear(struct taylor *a, double value)
{
	for (size_t d = POLYNOMIAL_DERIVATIVES; d-- > 1;)
		a->c[d] = value * a->c[d] + a->c[d - 1];
	a->c[0] *= value;
}

/* ------------------------------------------------------------------------------------------------
 * Basis functions
 * --------------------------------------------------------------------------------------------- */

/* Lagrange's product over all points but one (thesis 3.1.1.2). */
static void lagrange(const struct polynomial *polynomial, size_t j, double u,
                     struct taylor *product)
{
	*product = (struct taylor){ { polynomial->factors[j] } };
	for (size_t k = 0; k < polynomial->count; k++)
		if (k != j)
			multiply_linear(product, u - polynomial->places[k]);
}

/* T_j = 2 u T_{j-1} - T_{j-2}. */
static void chebyshev(struct walk *walk, size_t j, double u)
{
	const struct taylor here = walk->here;
	multiply_linear(&walk->here, u);
	for (size_t d = 0; j > 1 && d < POLYNOMIAL_DERIVATIVES; d++)
		walk->here.c[d] = 2 * walk->here.c[d] - walk->before.c[d];
	walk->before = here;
}

/* walk->here becomes basis function j; called for j = 0, 1, 2 ... in turn. */
static void step(const struct polynomial *polynomial, size_t j, double u, struct walk *walk)
{
	if (polynomial->basis == POLYNOMIAL_LAGRANGE)
		lagrange(polynomial, j, u, &walk->here);
	else if (j == 0)
		walk->here = (struct taylor){ { 1 } };
	else if (polynomial->basis == POLYNOMIAL_MONOMIAL)
		multiply_linear(&walk->here, u);
	else if (polynomial->basis == POLYNOMIAL_NEWTON)
		multiply_linear(&walk->here, u - polynomial->places[j - 1]);
	else
		chebyshev(walk, j, u);
}

void polynomial_evaluate(const struct polynomial *polynomial, double t,
                         double out[POLYNOMIAL_DERIVATIVES][3])
{
	double u = scaled(polynomial, t);
	double scale = 2 / (polynomial->last - polynomial->first);
	struct walk walk = { { { 0 } }, { { 0 } } };
	memset(out, 0, POLYNOMIAL_DERIVATIVES * sizeof *out);
	for (size_t j = 0; j < polynomial->count; j++) {
		step(polynomial, j, u, &walk);
		for (size_t d = 0; d < POLYNOMIAL_DERIVATIVES; d++)
			for (size_t c = 0; c < polynomial->width; c++)
				out[d][c] += walk.here.c[d] * polynomial->coefficients[j * polynomial->width + c];
	}
	double factor = 1;
	for (size_t d = 1; d < POLYNOMIAL_DERIVATIVES; d++) {
		factor *= scale * (double)d;
		for (size_t c = 0; c < polynomial->width; c++)
			out[d][c] *= factor;
	}
}

/* ------------------------------------------------------------------------------------------------
 * Coefficients
 * --------------------------------------------------------------------------------------------- */

/* Divided differences (thesis 3.1.1.3), column after column in place. */
static void divide_differences(struct polynomial *polynomial)
{
	size_t width = polynomial->width;
	double *a = polynomial->coefficients;
	for (size_t order = 1; order < polynomial->count; order++)
		for (size_t i = polynomial->count; i-- > order;) {
			double span = polynomial->places[i] - polynomial->places[i - order];
			for (size_t c = 0; c < width; c++)
				a[i * width + c] = (a[i * width + c] - a[(i - 1) * width + c]) / span;
		}
}

static void find_lagrange_factors(struct polynomial *polynomial)
{
	for (size_t j = 0; j < polynomial->count; j++) {
		double product = 1;
		for (size_t k = 0; k < polynomial->count; k++)
			if (k != j)
				product *= polynomial->places[j] - polynomial->places[k];
		polynomial->factors[j] = 1 / product;
	}
}

/* All conditions p(t_i) = P_i at once: as many as coefficients (Vandermonde's system) or more. */
static batten_status solve_conditions(struct polynomial *polynomial, size_t points,
                                      const double *parameters, const double *values)
{
	struct least_squares system;
	batten_status status = least_squares_create(polynomial->context, polynomial->count,
	                                            polynomial->count, polynomial->width, &system);
	if (status != BATTEN_OK)
		return status;
	for (size_t i = 0; i < points; i++) {
		double row[POLYNOMIAL_POINTS_MOST];
		struct walk walk = { { { 0 } }, { { 0 } } };
		double u = scaled(polynomial, parameters[i]);
		for (size_t j = 0; j < polynomial->count; j++) {
			step(polynomial, j, u, &walk);
			row[j] = walk.here.c[0];
		}
		least_squares_add(&system, 0, polynomial->count, row, values + i * polynomial->width);
	}
	if (!least_squares_solve(&system, polynomial->coefficients))
		status = batten_fail(polynomial->context, BATTEN_INPUT,
		                     "a polynomial of degree %zu: its equations cannot be told from "
		                     "dependent ones",
		                     polynomial->count - 1);
	least_squares_destroy(&system);
	return status;
}

static batten_status find_coefficients(struct polynomial *polynomial, size_t points,
                                       const double *parameters, const double *values)
{
	if (polynomial->basis == POLYNOMIAL_MONOMIAL || polynomial->basis == POLYNOMIAL_CHEBYSHEV)
		return solve_conditions(polynomial, points, parameters, values);
	for (size_t i = 0; i < points; i++)
		polynomial->places[i] = scaled(polynomial, parameters[i]);
	memcpy(polynomial->coefficients, values, points * polynomial->width * sizeof *values);
	if (polynomial->basis == POLYNOMIAL_NEWTON)
		divide_differences(polynomial);
	else
		find_lagrange_factors(polynomial);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

static batten_status check(batten_context *context, enum polynomial_basis basis, size_t points,
                           size_t degree)
{
	if (basis != POLYNOMIAL_CHEBYSHEV && points > POLYNOMIAL_POINTS_MOST)
		return batten_fail(context, BATTEN_USAGE,
		                   "one polynomial through %zu points, expected %d at most", points,
		                   (int)POLYNOMIAL_POINTS_MOST);
	if (basis == POLYNOMIAL_CHEBYSHEV && degree > POLYNOMIAL_LEAST_SQUARES_MOST)
		return batten_fail(context, BATTEN_USAGE,
		                   "a least squares polynomial of degree %zu, expected %d at most", degree,
		                   (int)POLYNOMIAL_LEAST_SQUARES_MOST);
	if (basis == POLYNOMIAL_CHEBYSHEV && degree >= points)
		return batten_fail(context, BATTEN_USAGE,
		                   "a least squares polynomial of degree %zu needs more than %zu points",
		                   degree, points);
	return BATTEN_OK;
}

batten_status polynomial_create(batten_context *context, enum polynomial_basis basis, size_t points,
                                const double *parameters, size_t width, const double *values,
                                size_t degree, struct polynomial *out)
{
	*out = (struct polynomial){ 0 };
	batten_status status = check(context, basis, points, degree);
	if (status != BATTEN_OK)
		return status;
	struct polynomial polynomial = { .context = context,
		                             .basis = basis,
		                             .count = basis == POLYNOMIAL_CHEBYSHEV ? degree + 1 : points,
		                             .width = width,
		                             .first = parameters[0],
		                             .last = parameters[points - 1] };
	polynomial.places = batten_allocate(context, polynomial.count, sizeof(double));
	polynomial.factors = batten_allocate(context, polynomial.count, sizeof(double));
	polynomial.coefficients = batten_allocate(context, polynomial.count, width * sizeof(double));
	if (!polynomial.places || !polynomial.factors || !polynomial.coefficients)
		status = BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = find_coefficients(&polynomial, points, parameters, values);
	if (status != BATTEN_OK) {
		polynomial_destroy(&polynomial);
		return status;
	}
	*out = polynomial;
	return BATTEN_OK;
}

void polynomial_destroy(struct polynomial *polynomial)
{
	if (polynomial->context) {
		batten_release(polynomial->context, polynomial->places);
		batten_release(polynomial->context, polynomial->factors);
		batten_release(polynomial->context, polynomial->coefficients);
	}
	*polynomial = (struct polynomial){ 0 };
}
