/* What the differences over an offset table take from its coordinates, once for all hulls on it. */
#ifndef BATTEN_GEOMETRY_GRID_STENCILS_H
#define BATTEN_GEOMETRY_GRID_STENCILS_H

#include "core/context.h"
#include "core/difference.h"

/* Weights of one direction at one of its coordinates; all 0 where there are too few neighbours. */
typedef struct grid_stencil {
	double weight[4]; /* difference_weights() */
	difference_quartic third;
	double cell_m; /* difference_cell() */
} grid_stencil;

/* Along x the numbers of one kind stand side by side, for runs of stations. */
typedef struct grid_stencils {
	size_t station_count, waterline_count;
	double *weight_x[4], *third_x[4], *cell_x_m; /* [stations] */
	grid_stencil *z;                             /* [waterlines] */
} grid_stencils;

/* Errors: MEMORY. */
batten_status grid_stencils_create(batten_context *context, size_t station_count, const double *x_m,
                                   size_t waterline_count, const double *z_m, grid_stencils *out);
void grid_stencils_destroy(batten_context *context, grid_stencils *stencils);

#endif
