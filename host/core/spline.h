/* Cubic splines through points at any spacing: values, slopes and exact integrals (Letcher 3.5).
 *
 *   struct spline spline;
 *   status = spline_create(context, count, x, y, SPLINE_NATURAL, &spline);
 *   ... spline_value(&spline, 0.5) ...
 *   spline_destroy(&spline);
 *
 * Two points give the straight line, three with SPLINE_NOT_A_KNOT the parabola. Beyond its points a
 * natural spline goes on as a straight line, the others as their first and last cubic. */
#ifndef BATTEN_CORE_SPLINE_H
#define BATTEN_CORE_SPLINE_H

#include "core/context.h"

enum spline_ends {
	SPLINE_NATURAL,    /* second derivative 0 at both ends */
	SPLINE_NOT_A_KNOT, /* third derivative continuous at the second and the last but one point */
	SPLINE_CLAMPED,    /* slopes given: spline_create_clamped() */
};

struct spline {
	batten_context *context;
	enum spline_ends ends;
	size_t count;
	double *x, *y, *second; /* one allocation, x first; second derivatives at the points */
};

/* x ascending, all finite, count >= 2; both arrays are copied. On failure *out is zeroed.
 * Errors: USAGE (fewer than two points, not ascending, not finite, SPLINE_CLAMPED), MEMORY. */
batten_status spline_create(batten_context *context, size_t count, const double *x, const double *y,
                            enum spline_ends ends, struct spline *out);
batten_status spline_create_clamped(batten_context *context, size_t count, const double *x,
                                    const double *y, double first_slope, double last_slope,
                                    struct spline *out);
void spline_destroy(struct spline *spline);

double spline_value(const struct spline *spline, double x);
double spline_slope(const struct spline *spline, double x);
double spline_second(const struct spline *spline, double x);

/* Integrals of the spline s over [a, b] (b < a: the negative), exact but for rounding. */
double spline_integral(const struct spline *spline, double a, double b);      /* s dx */
double spline_moment(const struct spline *spline, double a, double b);        /* x s dx */
double spline_second_moment(const struct spline *spline, double a, double b); /* x^2 s dx */
double spline_square(const struct spline *spline, double a, double b);        /* s^2 dx */
double spline_cube(const struct spline *spline, double a, double b);          /* s^3 dx */

#endif
