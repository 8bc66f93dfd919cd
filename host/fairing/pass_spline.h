/* B-splines of a line as rows of a fairing pass: what the vertices give at the points (thesis 5.2),
 * and least squares with parameters that depend on x alone (thesis 6). */
#ifndef BATTEN_FAIRING_PASS_SPLINE_H
#define BATTEN_FAIRING_PASS_SPLINE_H

#include "fairing/pass_writer.h"

/* The order functions that differ from 0 at a point, from vertex first on. */
typedef struct pass_stencil {
	size_t first;
	double weight[PASS_ORDER_MOST];
} pass_stencil;

/* The points themselves as polygon: stencils at t_i with x(t_i) = x_i. count >= order; along ascends. */
void pass_stencils_polygon(size_t order, size_t count, const double *along, pass_stencil *stencils);

/* How a line is represented. */
typedef struct pass_representation {
	size_t order;
	size_t vertices; /* 0: the points are the polygon */
} pass_representation;

/* Least points a line needs to be smoothed at all. */
size_t pass_least_points(const pass_representation *r);

/* Rows, each its own operation where it must: out[i] = what the representation of the numbers at
 * in[0..count) gives at point i; the end points keep theirs. in and out are different places. Nothing
 * is written, and *done false, where the line is too short. */
void pass_smooth(pass_writer *writer, const pass_representation *r, size_t count,
                 const double *along, const size_t *in, const size_t *out, bool *done);

#endif
