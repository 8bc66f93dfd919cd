/* The energies of a hull's graph y(x, z) over the nodes of its offset table, all in one pass.
 *
 * Bending, mean and Gauss energies are sums over the nodes whose 3 x 3 neighbours are all on the hull, by the
 * derivatives of grid_curvature. The variation of curvature (Moreton and Sequin 1992) is a sum over those
 * of them that have every node within two steps along x and z together on the hull: y_xxx and y_zzz come
 * from the polynomials of degree 4 through five nodes, y_xxz and y_xzz from three-point differences of y_xx
 * and y_zz. All are exact for cubics, whatever the spacing. */
#ifndef BATTEN_GEOMETRY_GRID_ENERGIES_H
#define BATTEN_GEOMETRY_GRID_ENERGIES_H

#include "geometry/grid_stencils.h"
#include "hull/hull.h"

/* Which nodes count, once for all hulls that have the same nodes. */
typedef struct grid_counted {
	double *near; /* [waterlines][stations]: 1 where the 3 x 3 nodes are on the hull, else 0 */
	double *wide; /* those two steps away too */
	size_t near_count, wide_count;
} grid_counted;

/* Errors: MEMORY. */
batten_status grid_counted_create(batten_context *context, const batten_hull *hull,
                                  grid_counted *out);
void grid_counted_destroy(batten_context *context, grid_counted *counted);

/* Sums over one side of the hull; NaN where no node counts. */
typedef struct grid_energies {
	double bending, mean, gauss; /* of (k1^2 + k2^2) dS, of H^2 dS, of |K| dS */
	/* Of ((dk1/de1)^2 + (dk2/de2)^2) dS. Where k1 and k2 are alike (kernels/shared/surface_variation.h) a
	 * node adds nothing. */
	double variation_per_m2;
} grid_energies;

/* stencils and counted: of the hull's table. */
grid_energies grid_energies_of(const batten_hull *hull, const grid_stencils *stencils,
                               const grid_counted *counted);

#endif
