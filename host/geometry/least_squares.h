/* Linear least squares by Givens rotations, row after row: as stable as any orthogonal method, and
 * cheap where rows have few numbers side by side, as those of a B-spline basis have. The order of
 * operations is fixed.
 *
 *   least_squares_create(context, columns, width, sides, &system);
 *   for every row: least_squares_add(&system, first, count, row, right);
 *   least_squares_solve(&system, solution);
 *   least_squares_destroy(&system); */
#ifndef BATTEN_GEOMETRY_LEAST_SQUARES_H
#define BATTEN_GEOMETRY_LEAST_SQUARES_H

#include "core/context.h"

enum { LEAST_SQUARES_SIDES_MOST = 3 };

struct least_squares {
	batten_context *context;
	size_t columns, width, sides;
	double *triangle; /* [columns][width]: row i from its diagonal on */
	double *right;    /* [columns][sides] */
	double *row;      /* [columns + width], one row at work */
	double *largest;  /* [columns]: largest number of each column given */
};

/* width: most numbers of a row, side by side; sides: right-hand sides, 1..3. Errors: MEMORY. */
batten_status least_squares_create(batten_context *context, size_t columns, size_t width,
                                   size_t sides, struct least_squares *out);
void least_squares_destroy(struct least_squares *system);

/* Adds a row with count <= width numbers that begin at column first; the rows' first columns do not
 * decrease. */
void least_squares_add(struct least_squares *system, size_t first, size_t count, const double *row,
                       const double *right);

/* solution [columns][sides]. False when a column depends on the others but for rounding. */
bool least_squares_solve(const struct least_squares *system, double *solution);

#endif
