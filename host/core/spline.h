/* Cubic splines through points at any spacing, with any mixture of end conditions (Letcher 3.5, thesis
 * 3.2.1).
 *
 *   struct spline spline;
 *   status = spline_create(context, count, x, y, SPLINE_NATURAL, &spline);
 *   ... spline_value(&spline, 0.5) ...
 *   spline_destroy(&spline);
 *
 * Beyond its points a spline goes on as a straight line at a natural end, else as its first or last
 * cubic. */
#ifndef BATTEN_CORE_SPLINE_H
#define BATTEN_CORE_SPLINE_H

#include "core/context.h"

enum { SPLINE_DERIVATIVES = 4 }; /* value, slope, second and third derivative */

enum spline_end {
	SPLINE_NATURAL,    /* second derivative 0 */
	SPLINE_NOT_A_KNOT, /* third derivative continuous at the point next to the end */
	SPLINE_CLAMPED,    /* slope given */
	SPLINE_BENT,       /* second derivative given */
};

/* What holds at one end; value is the slope or second derivative given. */
struct spline_condition {
	enum spline_end end;
	double value;
};

struct spline {
	batten_context *context;
	enum spline_end ends[2]; /* first, last */
	size_t count;
	double *x, *y, *second; /* one allocation, x first; second derivatives at the points */
};

/* The same condition at both ends. x ascending, all finite, count >= 2; both arrays are copied. Where
 * not-a-knot has no point to act on, the third derivative is 0 there (two points) or one cubic runs
 * through three points; with both ends not-a-knot two points give the straight line, three the
 * parabola. On failure *out is zeroed. Errors: USAGE (fewer than two points, not ascending, not
 * finite, SPLINE_CLAMPED or SPLINE_BENT), MEMORY. */
batten_status spline_create(batten_context *context, size_t count, const double *x, const double *y,
                            enum spline_end ends, struct spline *out);
/* Any condition at either end. */
batten_status spline_create_mixed(batten_context *context, size_t count, const double *x,
                                  const double *y, struct spline_condition first,
                                  struct spline_condition last, struct spline *out);
void spline_destroy(struct spline *spline);

double spline_value(const struct spline *spline, double x);
double spline_slope(const struct spline *spline, double x);
double spline_second(const struct spline *spline, double x);

/* Value and derivatives of the cubic that begins at or before x; the last point belongs to the last
 * cubic. */
void spline_derivatives(const struct spline *spline, double x, double out[SPLINE_DERIVATIVES]);

/* The integral of x^x_power * spline^power from a to b, both within the points; exact, as
 * x_power + 3 power <= 9. */
double spline_integral(const struct spline *spline, double a, double b, int x_power, int power);

/* The same for many integrals, whose Gauss points are found once. */
enum { SPLINE_RULE_POINTS = 5 };
struct spline_rule {
	double nodes[SPLINE_RULE_POINTS], weights[SPLINE_RULE_POINTS];
};
void spline_rule_of(struct spline_rule *out);
double spline_integral_by(const struct spline_rule *rule, const struct spline *spline, double a,
                          double b, int x_power, int power);

#endif
