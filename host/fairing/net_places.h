/* Where the offsets of a table lie on a surface. */
#ifndef BATTEN_FAIRING_NET_PLACES_H
#define BATTEN_FAIRING_NET_PLACES_H

#include "geometry/surface.h"
#include "hull/hull.h"

/* How a node of the table lies on the surface, seen along y. */
enum net_place_kind {
	NET_PLACE_NONE,   /* outside the hull, or off the surface */
	NET_PLACE_ON,     /* x(u, v) and z(u, v) are the node's */
	NET_PLACE_BEYOND, /* the same, a little beyond an edge */
};

struct net_place {
	enum net_place_kind kind;
	double u, v;           /* beyond an edge: outside the range */
	double edge_u, edge_v; /* the same within the range */
};

/* The place of every node of the hull, [waterlines][stations], and after them of every line end off
 * the table, released by the caller. A node
 * beyond an edge has one when that edge is no further than reach_m, seen along y. Of several
 * places at one x and z the one whose y is nearest to the node's is taken. Errors: MEMORY. */
batten_status net_places_find(const batten_hull *hull, const struct batten_surface *surface,
                              double reach_m, struct net_place **out);

/* Half-breadth of the faired surface at a place of the fitted one, which has the same x, z and
 * knots. Beyond an edge the fitted surface as it goes on there, moved as far as the edge was. */
double net_place_y(const struct net_place *place, const struct batten_surface *fitted,
                   const struct batten_surface *faired);

#endif
