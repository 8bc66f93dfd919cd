/* A search over a control net, as the library and as the oracle see it. */
#ifndef BATTEN_TESTS_NET_CASE_H
#define BATTEN_TESTS_NET_CASE_H

#include "batten.h"

#include "oracle/oracle_net.h"

#include <stdint.h>

typedef struct net_case {
	batten_context *context;
	batten_surface *surface;
	batten_surface_net net;
	oracle_surface exact;
	size_t poles;
	double half_beam_m;
	double *target, *lower, *upper; /* target: the start's y */
} net_case;

/* Wigley's hull as a bicubic net of 16 x 10 poles, L 16, B 1.6, D 1 m, every y > 0 off by up to
 * 0.01 m; or a net of 13 x 13 poles fitted to npl_parent. Poles in the centreplane are fixed, the
 * others may move by `part` half-beams. Fails the test when anything goes wrong. */
net_case net_case_wigley(double part);
net_case net_case_noisy(uint32_t seed, double noise_m,
                        double part); /* the same, off by other numbers */
net_case net_case_npl(double part);
void net_case_close(net_case *c);

batten_net_problem net_case_problem(const net_case *c, double w1, double w2);
oracle_net_problem net_case_oracle(const net_case *c, oracle_fairness fairness, double w1,
                                   double w2);

#endif
