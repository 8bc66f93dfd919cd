/* The terms of a search's objective over an offset grid with their exact first and second
 * derivatives: what a certificate is made of. Takes nothing from the formulas a search probes. */
#ifndef BATTEN_BATCH_GRID_TERMS_H
#define BATTEN_BATCH_GRID_TERMS_H

#include "batch/jet.h"
#include "batch/search_plan.h"

/* Nodes of a stencil: waterline below, of the node, above, aft to fore in each; for the variation of
 * curvature then those two steps aft, forward, below, above. Derivatives of y that a term depends on. */
enum { GRID_STENCIL_MOST = 13, GRID_TERM_VARIABLES = 5, GRID_TERM_VARIABLES_MOST = 9 };

/* The derivatives of y at a node (y_x, y_z, y_xx, y_xz, y_zz; then y_xxx, y_xxz, y_xzz, y_zzz), each a sum
 * over the stencil. */
typedef struct grid_stencil {
	size_t count;  /* of the nodes */
	int variables; /* that the term depends on */
	double weight[GRID_TERM_VARIABLES_MOST][GRID_STENCIL_MOST];
} grid_stencil;

/* At a node that is not at the grid's ends. */
grid_stencil grid_stencil_of(const search_plan *plan, size_t station, size_t waterline);

/* Nodes of a stencil; the places of them around `node`, `stride` a waterline. */
size_t grid_stencil_count(const search_plan *plan);
void grid_stencil_places(size_t count, size_t node, size_t stride,
                         size_t places[GRID_STENCIL_MOST]);

/* Fairness times dS / (dx dz) by these derivatives; y: the stencil's values. */
jet grid_density(const search_plan *plan, double half_beam_m, const grid_stencil *stencil,
                 const double y[GRID_STENCIL_MOST]);

#endif
