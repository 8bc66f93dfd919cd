/* The terms of a search's objective over an offset grid with their exact first and second
 * derivatives: what a certificate is made of. Takes nothing from the formulas a search probes. */
#ifndef BATTEN_BATCH_GRID_TERMS_H
#define BATTEN_BATCH_GRID_TERMS_H

#include "batch/jet.h"
#include "batch/search_plan.h"

/* Nodes of a stencil: waterline below, of the node, above; aft to fore in each. Derivatives of y that a
 * term depends on. */
enum { GRID_STENCIL_NODES = 9, GRID_TERM_VARIABLES = 5 };

/* The five derivatives of y at a node (y_x, y_z, y_xx, y_xz, y_zz), each a sum over the stencil. */
typedef struct grid_stencil {
	double weight[GRID_TERM_VARIABLES][GRID_STENCIL_NODES];
} grid_stencil;

/* At a node that is not at the grid's ends. */
grid_stencil grid_stencil_of(const search_plan *plan, size_t station, size_t waterline);

/* Fairness times dS / (dx dz) by these derivatives; y: the stencil's values. */
jet grid_density(const search_plan *plan, double half_beam_m, const grid_stencil *stencil,
                 const double y[GRID_STENCIL_NODES]);

#endif
