/* A fairing over a net made ready: the fitted surface, where the offsets lie on it, what its poles may do; then
 * searches of it, alike but for their weights. */
#ifndef BATTEN_FAIRING_NET_FAIRING_H
#define BATTEN_FAIRING_NET_FAIRING_H

#include "fairing/fairing.h"
#include "fairing/net_box.h"
#include "fairing/net_places.h"

/* Borrows fairing and options. */
typedef struct net_fairing {
	batten_fairing *fairing;
	const batten_fair_options *options;
	struct net_place *places; /* of the nodes, then of the line ends off the table */
	struct net_box box;
	batten_net_options how;
} net_fairing;

/* Makes the surfaces of a fairing that is prepared, both as fitted; fits net.deviation. net_fairing_close()
 * whatever comes back. Errors: USAGE (a lock that is not on the net), INPUT (no surface to fit), MEMORY. */
batten_status net_fairing_open(batten_fairing *fairing, const batten_fair_options *options,
                               net_fairing *out);
void net_fairing_close(net_fairing *n);

/* The search with these weights; borrows. */
batten_net_problem net_fairing_problem(const net_fairing *n, double w1, double w2);

/* Searches, y [count][rows][columns]; INCOMPLETE: one met its limit. Errors: INPUT (one is refused), those of
 * batten_net_search_batch(). */
batten_status net_fairing_search(net_fairing *n, size_t count, const batten_net_problem *problems,
                                 double *y, batten_search_result *results);

/* fairing_conclude() of one of them. */
batten_status net_fairing_conclude(net_fairing *n, const batten_net_problem *problem, double *y,
                                   batten_search_result *result);

/* Puts y of the poles into the faired surface. */
void net_fairing_put(net_fairing *n, const double *y);

/* Whether a node takes its half-breadth from the surface. A profile zero stays. */
bool net_fairing_moves(const net_fairing *n, size_t node);

/* How far the faired surface lies from the fitted one at these nodes. */
typedef struct net_change {
	double rms_m, max_m;
} net_change;
net_change net_fairing_change(const net_fairing *n);

#endif
