/* B-spline bases and curves (thesis 3.2, Letcher 3.7-3.8): any knots, orders 2 to 8, with weights
 * or without.
 *
 * The order is the degree + 1. A basis of count functions has count + order knots, not decreasing;
 * its parameters run over [knots[order - 1], knots[count]]. A place where a knot is repeated (a
 * knuckle) belongs to the span that begins there, the end of the range to the last span.
 *
 *   struct bspline_curve curve;
 *   status = bspline_curve_create(context, &(struct bspline_curve_net){ ... }, &curve);
 *   bspline_curve_evaluate(&curve, 0.5, 1, values);
 *   bspline_curve_destroy(&curve); */
#ifndef BATTEN_GEOMETRY_BSPLINE_H
#define BATTEN_GEOMETRY_BSPLINE_H

#include "core/context.h"

enum {
	BSPLINE_ORDER_LEAST = 2,
	BSPLINE_ORDER_MOST = 8,
	BSPLINE_POLES_MOST = 4096,    /* along one direction */
	BSPLINE_DERIVATIVES_MOST = 3, /* the third for the variation of curvature */
};

/* Largest coordinate of a pole, and the range of weights: no product of them can overflow. */
#define BSPLINE_POLE_LARGEST 1e9
#define BSPLINE_WEIGHT_SMALLEST 1e-9
#define BSPLINE_WEIGHT_LARGEST 1e9

/* ------------------------------------------------------------------------------------------------
 * Knots
 * --------------------------------------------------------------------------------------------- */

/* Order 2..8, poles order..4096; what as below. Errors: USAGE. */
batten_status bspline_shape_check(batten_context *context, const char *what, size_t order,
                                  size_t count);

/* Checks order, number of poles and knots; what ("knots_u") stands for the knots in the message.
 * Knots are finite and do not decrease, the first and the last span of the range are not empty, no
 * knot occurs more than order times (inside the range: order - 1 times, so that nothing comes
 * apart), and two that differ do so by 1e-9 of the range. Errors: USAGE. */
batten_status bspline_knots_check(batten_context *context, const char *what, size_t order,
                                  size_t count, const double *knots);

/* Open uniform as the thesis numbers them: 0 (order times), 1, 2, ..., count - order + 1 (order
 * times); with n = count - 1 and k = order the last is n - k + 2. Room for count + order. */
void bspline_knots_open(size_t order, size_t count, double *knots);

/* The same over 0..1 (Letcher 3.7, equations 23-25). */
void bspline_knots_clamped(size_t order, size_t count, double *knots);

/* Parameters 0..1 of points [count][dimension] by their cumulative chord length (Letcher 3.5).
 * Errors: USAGE (fewer than two points, not finite, all in one place). */
batten_status bspline_parameters_chord(batten_context *context, size_t count, size_t dimension,
                                       const double *points, double *parameters);

/* Knots to interpolate at count ascending parameters: clamped at the first and the last, each
 * inner one the mean of order - 1 parameters, so that every parameter lies within the support of
 * its basis function (Schoenberg and Whitney). Errors: USAGE. */
batten_status bspline_knots_averaged(batten_context *context, size_t order, size_t count,
                                     const double *parameters, double *knots);

/* Knots of count poles for a fit of more parameters than poles: every span takes an equal share of
 * the parameters' numbers, the same from either end. As bspline_knots_averaged where the numbers
 * agree. Errors: USAGE. */
batten_status bspline_knots_spread(batten_context *context, size_t order, size_t count,
                                   size_t parameter_count, const double *parameters, double *knots);

/* Places of the poles of a graph: the means of order - 1 knots (Greville); places has count. */
void bspline_knots_greville(size_t order, size_t count, const double *knots, double *places);

/* ------------------------------------------------------------------------------------------------
 * Basis
 * --------------------------------------------------------------------------------------------- */

/* The last i in order - 1 .. count - 1 with knots[i] <= t, whose span is never empty; outside the
 * range its first or last span. The functions i - order + 1 .. i are the ones that differ from 0
 * there. */
size_t bspline_span(size_t order, size_t count, const double *knots, double t);

/* Values of those order functions at t (Cox and de Boor); beyond the span its polynomials go on. */
void bspline_basis(size_t order, const double *knots, size_t span, double t, double *values);

/* Values (row 0) and derivatives up to highest <= BSPLINE_DERIVATIVES_MOST; rows beyond the degree
 * are 0. */
void bspline_basis_derivatives(size_t order, const double *knots, size_t span, double t,
                               size_t highest,
                               double rows[BSPLINE_DERIVATIVES_MOST + 1][BSPLINE_ORDER_MOST]);

/* ------------------------------------------------------------------------------------------------
 * Curves
 * --------------------------------------------------------------------------------------------- */

struct bspline_curve {
	batten_context *context;
	size_t order, count, dimension; /* dimension 1..3 */
	double *knots;                  /* count + order */
	double *poles;                  /* [count][dimension] */
	double *weights;                /* [count], > 0, or NULL: all 1 */
};

/* What a curve is made of; all arrays borrowed. */
struct bspline_curve_net {
	size_t order, count, dimension;
	const double *knots, *poles, *weights;
};

/* Checks and copies. On failure *out is zeroed. Errors: USAGE (one line that says what is wrong),
 * MEMORY. */
batten_status bspline_curve_create(batten_context *context, const struct bspline_curve_net *net,
                                   struct bspline_curve *out);
void bspline_curve_destroy(struct bspline_curve *curve);

/* Point and derivatives up to highest <= 3 at t: values[derivative * dimension + coordinate].
 * Beyond its range the curve goes on as its first or last polynomial. */
void bspline_curve_evaluate(const struct bspline_curve *curve, double t, size_t highest,
                            double *values);

/* The operations below change a curve in place and leave it untouched when they fail. */

/* Inserts the knot t times times; the curve stays the same. Errors: USAGE (outside the range, or
 * more than order - 1 of it), MEMORY. */
batten_status bspline_curve_insert_knot(struct bspline_curve *curve, double t, size_t times);

/* Raises the order by times; the curve stays the same. Errors: USAGE (beyond order 8), MEMORY. */
batten_status bspline_curve_elevate(struct bspline_curve *curve, size_t times);

/* Runs it the other way: c(a + b - t) over the same range [a, b]. */
void bspline_curve_reverse(struct bspline_curve *curve);

/* p -> matrix p + shift for every point p, matrix by rows [dimension][dimension]. Errors: USAGE (a
 * pole would not be finite). */
batten_status bspline_curve_map(struct bspline_curve *curve, const double *matrix,
                                const double *shift);

#endif
