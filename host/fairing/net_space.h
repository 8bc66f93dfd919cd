/* The poles of a net as what a search moves. */
#ifndef BATTEN_FAIRING_NET_SPACE_H
#define BATTEN_FAIRING_NET_SPACE_H

#include "fairing/fairing.h"
#include "fairing/net_box.h"

/* One search of the fitted surface of a fairing; borrows all but what is called scratch. Its measures are
 * batten_surface_hydrostatics() at the draft of the hull, over its length. */
typedef struct net_space {
	batten_fairing *fairing;
	const struct net_box *box;
	const batten_net_options *how;
	batten_net_problem problem; /* start: the fitted surface; no target */
	/* Scratch: */
	batten_surface *from;
	double *start_m, *lower_m, *upper_m, *poles_m;
} net_space;

/* fairing_conclude() of the search; what is called scratch is of no use to the caller. */
batten_status net_space_conclude(net_space *space, const batten_fair_options *options, double *y,
                                 batten_search_result *result);

#endif
