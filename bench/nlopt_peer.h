/* NLopt's LD_LBFGS on the searches of the Wigley case. A module of its own, so that the program does not
 * need NLopt. */
#ifndef BATTEN_BENCH_NLOPT_PEER_H
#define BATTEN_BENCH_NLOPT_PEER_H

#include "wigley_case.h"

/* Searches for the least objective of one hull of the case, until it is `stop` or less, or (stop
 * -HUGE_VAL) as far as it comes; begun again from its end where it stops before. Writes the best
 * offsets to y[WIGLEY_NODES] and returns their objective; NAN when memory is short. */
typedef double nlopt_peer_function(const wigley_case *w, size_t hull, double stop, double *y);
__attribute__((visibility("default"))) nlopt_peer_function nlopt_peer_search;

/* Algorithms that know values alone. */
typedef enum nlopt_peer_algorithm {
	NLOPT_PEER_PRAXIS, /* LN_PRAXIS */
	NLOPT_PEER_SBPLX,  /* LN_SBPLX */
} nlopt_peer_algorithm;

/* The same without gradients, for so many seconds at most; begun again from its end where it stops before. */
typedef double nlopt_peer_values_function(const wigley_case *w, size_t hull,
                                          nlopt_peer_algorithm algorithm, double stop,
                                          double seconds, double *y);
__attribute__((visibility("default"))) nlopt_peer_values_function nlopt_peer_search_values;

#endif
