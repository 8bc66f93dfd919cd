/* The poles of a net as what a search moves. */
#ifndef BATTEN_FAIRING_NET_SPACE_H
#define BATTEN_FAIRING_NET_SPACE_H

#include "fairing/fairing.h"
#include "fairing/net_box.h"
#include "fairing/space.h"

/* One search of the fitted surface of a fairing; borrows all but what is called scratch. Its measures are
 * batten_surface_hydrostatics() at the draft of the hull, over its length. */
typedef struct net_space {
	const batten_fairing *fairing;
	const struct net_box *box;
	const batten_net_options *how;
	batten_net_problem problem; /* start: the fitted surface; no target */
	/* Scratch: */
	batten_surface *from;
	double *start_m, *lower_m, *upper_m, *poles_m;
} net_space;

/* The space of the search, valid as long as `space` is; net_space_close() whatever comes back. Errors:
 * MEMORY. */
batten_status net_space_open(net_space *space, fairing_space *out);
void net_space_close(net_space *space);

#endif
