/* The points of one line. */
#ifndef BATTEN_GEOMETRY_POINTS_H
#define BATTEN_GEOMETRY_POINTS_H

#include "hull/hull.h"

struct batten_points {
	batten_context *context; /* whose memory it is */
	char *name, *source;     /* never NULL */
	hull_unit unit;          /* of the file */
	size_t dimension, count;
	double *m; /* [count][dimension] */
};

/* Number of the first point that lies closer than HULL_SMALLEST_STEP_M to the one before it; count
 * when there is none. */
size_t points_find_repeated(size_t dimension, size_t count, const double *points);

#endif
