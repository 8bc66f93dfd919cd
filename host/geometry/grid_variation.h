/* The variation of curvature of a hull's graph y(x, z) over the nodes of its offset table (Moreton and
 * Sequin 1992).
 *
 * A node counts where every node within two steps of it, along x and z together, is on the hull: its
 * 3 x 3 neighbours, as for the other energies, and the two beyond them each way. First and second
 * derivatives are those of grid_curvature; y_xxx and y_zzz come from the polynomials of degree 4 through
 * five nodes, y_xxz and y_xzz from three-point differences of y_xx and y_zz. All are exact for cubics,
 * whatever the spacing. */
#ifndef BATTEN_GEOMETRY_GRID_VARIATION_H
#define BATTEN_GEOMETRY_GRID_VARIATION_H

#include "geometry/grid_curvature.h"

/* Sum of ((dk1/de1)^2 + (dk2/de2)^2) dS in 1/m^2 over the nodes that count, one side of the hull. Where
 * k1 and k2 are alike (kernels/shared/surface_variation.h) a node adds nothing. NaN when no node
 * counts. grid: filled for this hull. */
double grid_variation_sum(const batten_hull *hull, const grid_stencils *stencils,
                          const grid_curvature *grid);

#endif
