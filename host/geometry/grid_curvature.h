/* Derivatives and curvatures of a hull's graph y(x, z) at the nodes of its offset table, by
 * differences over 3 x 3 nodes, for pictures. What is summed of them: grid_energies.h.
 *
 * A derivative along one direction is that of the parabola through three neighbours, any spacing; the
 * mixed one applies both in turn. It is taken only where all nine nodes are on the hull, given or
 * filled: no stencil crosses the hull's edge. */
#ifndef BATTEN_GEOMETRY_GRID_CURVATURE_H
#define BATTEN_GEOMETRY_GRID_CURVATURE_H

#include "geometry/grid_stencils.h"

typedef enum grid_curvature_origin {
	GRID_CURVATURE_NONE = 0, /* outside the hull, or nothing to borrow from */
	GRID_CURVATURE_OWN = 1,  /* all nine nodes on the hull: the only ones a sum may use */
	GRID_CURVATURE_BORROWED =
		2, /* curvatures of the nearest OWN node along the waterline or section,
	                                for pictures; derivatives and area are 0 */
} grid_curvature_origin;

/* All arrays are [waterlines][stations], 0 where there is nothing. */
typedef struct grid_curvature {
	size_t station_count, waterline_count;
	uint8_t *origin; /* grid_curvature_origin */
	double *y_x, *y_z, *y_xx_per_m, *y_xz_per_m, *y_zz_per_m;
	double *mean_per_m;   /* H = (k1 + k2) / 2 by the outward normal: a convex hull's is negative */
	double *gauss_per_m2; /* K = k1 k2 */
	double *bending_per_m2; /* k1^2 + k2^2 = 4 H^2 - 2 K, never negative */
	double *area_m2;        /* dS = sqrt(1 + y_x^2 + y_z^2) dx dz, half-sum spacings; one side */
	size_t own_count;       /* nodes with a curvature of their own */
} grid_curvature;

/* A table of fewer than three stations or waterlines has no OWN node. Errors: MEMORY. */
batten_status grid_curvature_create(batten_context *context, const batten_hull *hull,
                                    grid_curvature **out);
void grid_curvature_destroy(batten_context *context, grid_curvature *grid);

#endif
