/* NLopt's LD_LBFGS on the searches over control nets, in the module of nlopt_peer.h: bending energy and closeness with
 * their gradient in plain C. */
#ifndef BATTEN_BENCH_NLOPT_NET_PEER_H
#define BATTEN_BENCH_NLOPT_NET_PEER_H

#include "wigley_net.h"

/* The objective of a hull of the case at y[WIGLEY_NET_POLES], and its gradient by each pole. */
typedef double nlopt_net_objective_function(const wigley_net *w, size_t hull, const double *y,
                                            double *gradient);
__attribute__((visibility("default"))) nlopt_net_objective_function nlopt_net_objective;

/* As nlopt_peer_search(). */
typedef double nlopt_net_search_function(const wigley_net *w, size_t hull, double stop, double *y);
__attribute__((visibility("default"))) nlopt_net_search_function nlopt_net_search;

#endif
