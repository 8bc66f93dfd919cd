/* The variation of curvature of the graph y(x, z) at a node of an offset grid, by differences over its
 * 3 x 3 nodes and the two beyond them each way (Moreton and Sequin 1992).
 *
 * Defined before this is included: search_state, node_of(), stencil_of(). */
#ifndef BATTEN_SHARED_GRID_THIRD_H
#define BATTEN_SHARED_GRID_THIRD_H

#include "dialect.h"
#include "grid_energy.h"
#include "surface_variation.h"

SHARED_FUNCTION node_row third_row(const STATE stored *y)
{
	const node_row row = { AT(y[-1]), AT(y[0]), AT(y[1]) };
	return row;
}

/* The third derivative of the polynomial through five values `step` apart. */
SHARED_FUNCTION real third_along(GLOBAL const scalar *weights, const STATE stored *y, int step)
{
	const real low = weights[0] * (AT(y[-step]) - AT(y[-2 * step])) +
	                 weights[1] * (AT(y[0]) - AT(y[-step]));
	const real high = weights[2] * (AT(y[step]) - AT(y[0])) +
	                  weights[3] * (AT(y[2 * step]) - AT(y[step]));
	return low + high;
}

SHARED_FUNCTION surface_triple third_triple(scalar x, real y, scalar z)
{
	const surface_triple t = { SPREAD(x), y, SPREAD(z) };
	return t;
}

/* Derivatives of the surface (x, y, z) by u = x and v = z. */
SHARED_FUNCTION surface_jet third_jet(node_slopes d)
{
	const scalar none = LITERAL(0.0);
	surface_jet j;
	j.at = triple_zero();
	j.u = third_triple(LITERAL(1.0), d.y_x, none);
	j.v = third_triple(none, d.y_z, LITERAL(1.0));
	j.uu = third_triple(none, d.y_xx, none);
	j.uv = third_triple(none, d.y_xz, none);
	j.vv = third_triple(none, d.y_zz, none);
	return j;
}

SHARED_FUNCTION surface_third third_of(const search_state *s, const node_stencil *w,
                                       const STATE stored *y, int station, int waterline)
{
	const scalar none = LITERAL(0.0);
	real along_x[3], along_z[3];
	UNROLLED
	for (int n = 0; n < 3; n++) {
		const STATE stored *row = y + (n - 1) * s->stride;
		const STATE stored *column = y + (n - 1);
		along_x[n] = stencil_second(w->x[2], w->x[3], AT(row[-1]), AT(row[0]), AT(row[1]));
		along_z[n] = stencil_second(w->z[2], w->z[3], AT(column[-s->stride]), AT(column[0]),
		                            AT(column[s->stride]));
	}
	surface_third t;
	t.uuu = third_triple(none, third_along(s->third_x + station * STENCIL_THIRD, y, 1), none);
	t.uuv = third_triple(none, stencil_first(w->z[0], w->z[1], along_x[0], along_x[1], along_x[2]),
	                     none);
	t.uvv = third_triple(none, stencil_first(w->x[0], w->x[1], along_z[0], along_z[1], along_z[2]),
	                     none);
	t.vvv = third_triple(none, third_along(s->third_z + waterline * STENCIL_THIRD, y, s->stride),
	                     none);
	return t;
}

/* The density of the variation of curvature times dS / (dx dz) at a node of y; 0 where no lane has a term:
 * nothing is read there, for it may lie next to the grid's edge. */
SHARED_FUNCTION real third_fairness(const search_state *s, const STATE stored *y, int station,
                                    int waterline)
{
	const real zero = SPREAD(LITERAL(0.0));
	const int node = node_of(s, station, waterline);
	if (!ANY(AT(s->bend[node]) > zero))
		return zero;
	const node_stencil w = stencil_of(s, station, waterline);
	const STATE stored *at = y + node;
	const surface_jet j = third_jet(
		slopes_of(w, third_row(at - s->stride), third_row(at), third_row(at + s->stride)));
	const surface_shape shape = surface_shape_of(j, zero);
	const surface_third t = third_of(s, &w, at, station, waterline);
	return surface_variation_of(j, t, shape).density * shape.area;
}

/* The part of the objective of a node of y. */
SHARED_FUNCTION real third_objective(const search_state *s, const STATE stored *y, int station,
                                     int waterline)
{
	const int node = node_of(s, station, waterline);
	return node_energy(AT(s->bend[node]), third_fairness(s, y, station, waterline)) +
	       node_closeness(AT(s->close[node]), AT(y[node]), AT(s->target[node]));
}

#endif
