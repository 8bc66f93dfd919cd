/* Surfaces, boxes and weights of a batch of searches over control nets made into its plan. */
#ifndef BATTEN_FAIRING_NET_PROBLEM_H
#define BATTEN_FAIRING_NET_PROBLEM_H

#include "batch/net_plan.h"

typedef struct net_problems {
	net_plan plan; /* y_m and results: the caller's */
	size_t *leader;
	double *targets; /* [count][v][u] */
} net_problems;

/* problems are borrowed until net_problems_close(), which is to be called whatever comes back. Errors:
 * USAGE, MEMORY. */
batten_status net_problems_open(batten_context *context, size_t count,
                                const batten_net_problem *problems,
                                const batten_net_options *options, net_problems *out);
void net_problems_close(net_problems *p);

/* The ways that slopes meet in closeness alone, [count][v][u] each (net_closeness.h), and how the free poles
 * about an end y_m answer to them (net_certifier_answer()), in double. Errors: those of net_problems_open(),
 * INPUT (the problem's fault; poles that closeness does not tell apart). */
batten_status net_problem_yield(batten_context *context, const batten_net_problem *problem,
                                const batten_net_options *options, size_t count,
                                const double *slopes, double *ways);
batten_status net_problem_answer(batten_context *context, const batten_net_problem *problem,
                                 const batten_net_options *options, const double *y_m, size_t count,
                                 const double *slopes, double *ways, bool *known);

#endif
