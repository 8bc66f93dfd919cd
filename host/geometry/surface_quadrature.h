/* What integrals over surfaces need, one surface or many. */
#ifndef BATTEN_GEOMETRY_SURFACE_QUADRATURE_H
#define BATTEN_GEOMETRY_SURFACE_QUADRATURE_H

#include "core/context.h"

typedef struct surface_range {
	double least, most;
} surface_range;

/* Least and greatest of count >= 1 numbers. */
surface_range surface_range_of(const double *numbers, size_t count);

/* Of the poles' x, y and z. */
typedef struct surface_box {
	surface_range along[3];
} surface_box;
surface_box surface_box_of(const batten_surface_net *net);

/* The area of the net's box, as a square of its diagonal, over that of the parameters: what an area
 * element is held against. */
double surface_net_area(const batten_surface_net *net, const surface_box *box);

#endif
