/* The terms of a search over a control net with their exact first and second derivatives, from the
 * fundamental forms of the surface (Letcher 4.4): what a certificate is made of. Takes nothing from the
 * formulas a search probes. */
#ifndef BATTEN_BATCH_NET_TERMS_H
#define BATTEN_BATCH_NET_TERMS_H

#include "batch/jet.h"
#include "batch/net_plan.h"

/* Poles one sample sees, and derivatives of y by them that a term depends on: by u, v, uu, uv, vv, and
 * for the variation of curvature by uuu, uuv, uvv, vvv. */
enum {
	NET_PATCH_POLES = NET_ORDER_MOST * NET_ORDER_MOST,
	NET_TERM_VARIABLES = 5,
	NET_TERM_VARIABLES_MOST = 9
};

/* What the poles count in y and its derivatives at a sample. */
typedef struct net_patch {
	size_t count;
	int variables;
	size_t poles[NET_PATCH_POLES];
	double at[NET_PATCH_POLES];
	double weight[NET_TERM_VARIABLES_MOST][NET_PATCH_POLES];
} net_patch;

void net_patch_of(const net_plan *plan, size_t line, size_t sample, net_patch *out);

/* Fairness times dA / (du dv) by the derivatives of y. fairness: NET_FAIRNESS_...; sample: packed in f64, one lane (net_layout.h); way:
 * those of y less target. rounding: of |K|, as net_layout.h has it. A constant 0 where the variation of
 * curvature is not known. */
jet net_density_of(int fairness, const double *sample, const double way[NET_TERM_VARIABLES_MOST],
                   double rounding);

#endif
