/* What fairing may do to a control net: the bounds of the y of its poles, and which move together. */
#ifndef BATTEN_FAIRING_NET_BOX_H
#define BATTEN_FAIRING_NET_BOX_H

#include "fairing/fairing.h"
#include "fairing/net_places.h"

/* Arrays are [rows][columns], as the poles of the surface. */
struct net_box {
	double *lower_m, *upper_m; /* equal where a pole stays */
	size_t *leader;            /* the pole that each moves with, or itself */
	size_t locked_count;       /* poles that stay */
};

/* Poles of the surface within this part of the half-beam from the centreplane, on the edges that may
 * lie in it, are taken to lie there. */
#define NET_BOX_CENTREPLANE 0.01

/* Bounds, locks and links of the fitted surface (batten.h, BATTEN_VARIABLES_NET); places are those
 * of its hull. Errors: USAGE (a lock that is not on the net), MEMORY. */
batten_status net_box_create(const batten_fairing *fairing, const batten_fair_options *options,
                             const struct net_place *places, struct net_box *out);
void net_box_release(batten_context *context, struct net_box *box);

#endif
