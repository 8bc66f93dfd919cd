/* Lines on a surface, one after the other in shared arrays. */
#ifndef BATTEN_GEOMETRY_CONTOUR_H
#define BATTEN_GEOMETRY_CONTOUR_H

#include "core/context.h"

typedef struct contour_line {
	size_t first, count; /* of the points */
	bool closed;
} contour_line;

struct batten_contours {
	batten_context *context;
	size_t count, points;
	contour_line *lines;
	double *u, *v, *points_m;
};

#endif
