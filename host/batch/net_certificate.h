/* How near a minimum a search over a control net ended: gradient and Newton decrement of its objective,
 * by exact derivatives in double whatever the search was run in. */
#ifndef BATTEN_BATCH_NET_CERTIFICATE_H
#define BATTEN_BATCH_NET_CERTIFICATE_H

#include "batch/net_plan.h"

/* Room for one search at a time. Unknowns are the poles that others follow, or none. */
typedef struct net_certifier {
	net_plan plan;   /* of the searches, in f64 */
	double rounding; /* a pole this part of its amount from a bound is at it */
	const net_item *item;
	double rounded;   /* of |K|, net_density_of() */
	double *samples;  /* packed, one lane */
	double *arrays;   /* NET_ARRAY_COUNT * poles, packed beside them */
	net_room *rooms;  /* of the poles, from their starts */
	double *way;      /* y less target */
	double *gradient; /* a number a pole; those that follow count in their leader's */
	double *step;     /* a leader: y less this is the minimum of the parabola */
	size_t *number;   /* of the unknown a pole moves with, or none */
} net_certifier;

/* Errors: MEMORY; what is there is to be released all the same. */
batten_status net_certifier_create(const net_plan *plan, net_certifier *c);
void net_certifier_release(net_certifier *c);

/* y_m [v][u]: an end of item `which`, which is sound. Errors: MEMORY. */
batten_status net_certifier_run(net_certifier *c, size_t which, const double *y_m,
                                batten_certificate *out);

/* Goes on from y_m by Newton steps until the gap estimate is at most `gap`. Errors: MEMORY. */
batten_status net_certifier_polish(net_certifier *c, size_t which, double gap, double *y_m,
                                   batten_certificate *out);

/* How the free poles about an end of a sound item answer to slopes, [count][v][u] each: the inverse of the
 * Hessian times these. Slopes of poles that move together add up; what is held, also by the gradient, does not
 * answer. *known false, and nothing written: it is not positive definite. Errors: MEMORY. */
batten_status net_certifier_answer(net_certifier *c, size_t which, const double *y_m, size_t count,
                                   const double *slopes, double *ways, bool *known);

/* Judges the ends y_m [count][v][u] of the plan's items, on the threads of the C path; those with a fault
 * get its text. polished_m: NULL, or y_m, which then goes on until the gap estimate is at most `gap`.
 * Errors: MEMORY. */
batten_status net_certify(const net_plan *plan, const double *y_m, double gap, double *polished_m,
                          batten_certificate *certificates);

#endif
