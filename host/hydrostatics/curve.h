/* A line as a curve that can be integrated by each of the quadrature rules: sections, waterlines
 * and curves of sections along the ship. */
#ifndef BATTEN_HYDROSTATICS_CURVE_H
#define BATTEN_HYDROSTATICS_CURVE_H

#include "core/context.h"
#include "core/spline.h"

/* What stands at a point of a curve. */
enum curve_break {
	CURVE_SMOOTH = 0,
	CURVE_BREAK_AT = 1,    /* a knuckle: one spline ends here, the next begins */
	CURVE_BREAK_AFTER = 2, /* a knuckle between this point and the next: a straight line there */
};

typedef struct curve {
	batten_context *context;
	size_t count;
	double *at, *value; /* at ascending */
	size_t piece_count;
	struct spline *pieces; /* none below two points */
} curve;

/* Copies count >= 1 points; breaks (enum curve_break, [count]) may be NULL. Errors: MEMORY,
 * USAGE. */
batten_status curve_create(batten_context *context, size_t count, const double *at,
                           const double *value, const unsigned char *breaks, enum spline_end ends,
                           curve *out);
void curve_destroy(curve *line);

/* By the spline. A curve of one point is constant. */
double curve_value(const curve *line, double at);
double curve_slope(const curve *line, double at);

/* By the straight line between the neighbours. */
double curve_value_straight(const curve *line, double at);

/* Where a rule takes a curve's value, and with what weight: an integral of f(at, value) is the sum
 * of weight * f. */
typedef struct curve_nodes {
	size_t count;
	double *at, *weight, *value;
} curve_nodes;

/* The nodes of a rule between from and to, both within the curve.
 *   spline:    five Gauss points in every interval, exact for the spline up to its cube
 *   Simpson:   the points; needs an even number of equal intervals from end to end and before each
 *              knuckle
 *   trapezoid: the points, and the straight line's value at ends between two of them
 * what and coordinate name the line in a message. Errors: INPUT (Simpson's conditions), MEMORY. */
batten_status curve_quadrature(const curve *line, batten_quadrature rule, double from, double to,
                               const char *what, double coordinate, curve_nodes *out);
void curve_nodes_release(batten_context *context, curve_nodes *nodes);

/* Integral of at^power * value over the nodes. */
double curve_nodes_moment(const curve_nodes *nodes, int power);
double curve_nodes_cube(const curve_nodes *nodes); /* of value^3 */

#endif
