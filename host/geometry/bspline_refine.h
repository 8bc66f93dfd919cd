/* Finer descriptions of the same B-spline: a knot more, an order more. They work on rows, one a
 * pole, of any width: the poles of a curve (homogeneous when it is rational), whole lines of a
 * net. */
#ifndef BATTEN_GEOMETRY_BSPLINE_REFINE_H
#define BATTEN_GEOMETRY_BSPLINE_REFINE_H

#include "geometry/bspline.h"

/* Knots count + order, rows [count][width]. */
struct bspline_rows {
	size_t order, count, width;
	double *knots, *rows;
};

void bspline_rows_release(batten_context *context, struct bspline_rows *rows);

/* As bspline_curve_insert_knot, times >= 1; out gets what is new, from stays. */
batten_status bspline_rows_insert(batten_context *context, const struct bspline_rows *from,
                                  double t, size_t times, struct bspline_rows *out);

/* As bspline_curve_elevate, times >= 1. */
batten_status bspline_rows_elevate(batten_context *context, const struct bspline_rows *from,
                                   size_t times, struct bspline_rows *out);

/* The knots of a curve that runs the other way over the same range, in place. */
void bspline_knots_reverse(size_t order, size_t count, double *knots);

/* Finite coordinates, and weights within their limits; weights may be NULL. Errors: USAGE. */
batten_status bspline_poles_check(batten_context *context, size_t count, size_t dimension,
                                  const double *poles, const double *weights);

/* Poles between the two ways of writing them: [count][dimension] beside weights, and homogeneous,
 * [count][dimension + 1] with the weight last. Without weights the two are the same. */
size_t bspline_homogeneous_width(size_t dimension, const double *weights);
void bspline_to_homogeneous(size_t count, size_t dimension, const double *poles,
                            const double *weights, double *to);
void bspline_from_homogeneous(size_t count, size_t dimension, const double *from, double *poles,
                              double *weights);

/* Last row first, in place. */
void bspline_rows_reverse(size_t count, size_t width, double *rows);

/* p -> matrix p + shift for every pole. Errors: USAGE (a pole would be beyond the limits; none
 * is changed). */
batten_status bspline_poles_map(batten_context *context, size_t count, size_t dimension,
                                const double *matrix, const double *shift, double *poles);

#endif
