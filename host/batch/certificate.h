/* How near a minimum a search's end is: gradient and Newton decrement of its objective, by exact
 * derivatives in double whatever the search was run in. */
#ifndef BATTEN_BATCH_CERTIFICATE_H
#define BATTEN_BATCH_CERTIFICATE_H

#include "batch/search_plan.h"

/* Room for one problem at a time. */
typedef struct certifier {
	const search_plan *plan; /* in f64 */
	const batten_search_problem *problem;
	double rounding;  /* an offset this part of its amount from a bound is at it */
	double inside;    /* and one this part of its box's width */
	double *arrays;   /* SEARCH_ARRAY_COUNT * node_count, as search_pack.h lays them out */
	double *gradient; /* a number a node */
	size_t *number;   /* of the unknown at a node, SIZE_MAX where there is none */
	size_t *order;    /* nodes of the grid, the shorter direction running first */
	double *step;     /* a node: y less this is the minimum of the parabola */
} certifier;

/* Of searches in a precision, with an interior penalty or not. Errors: MEMORY. */
batten_status certifier_create(const search_plan *plan, batten_precision precision,
                               bool interior_penalty, certifier *out);
void certifier_release(certifier *c);

/* The objective at y_m of the problem, which is sound. */
double certifier_objective(certifier *c, const batten_search_problem *problem, const double *y_m);

/* y_m: of the problem, which is sound. Errors: MEMORY. */
batten_status certifier_run(certifier *c, const batten_search_problem *problem, const double *y_m,
                            batten_certificate *out);

/* Goes on from y_m by Newton steps until the gap estimate is at most `gap`. Errors: MEMORY. */
batten_status certifier_polish(certifier *c, const batten_search_problem *problem, double gap,
                               double *y_m, batten_certificate *out);

#endif
