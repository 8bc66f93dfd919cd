/* What integrals over surfaces need, one surface or many. */
#ifndef BATTEN_GEOMETRY_SURFACE_QUADRATURE_H
#define BATTEN_GEOMETRY_SURFACE_QUADRATURE_H

#include "core/context.h"

/* Least and greatest of count >= 1 numbers, stride apart. */
typedef struct surface_range {
	double least, most;
} surface_range;
surface_range surface_range_of(const double *numbers, size_t count, size_t stride);

/* The area of the net's box, as a square of its diagonal, over that of the parameters: what an area
 * element is held against. */
double surface_net_area(const batten_surface *surface);

#endif
