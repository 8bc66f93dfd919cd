/* What fairing may do to a hull: its locks, the variables of the search and their bounds. */
#ifndef BATTEN_FAIRING_BOX_H
#define BATTEN_FAIRING_BOX_H

#include "hull/hull.h"

/* No half-breadth goes beyond this part of the half-beam. */
#define FAIRING_HALF_BEAM_LIMIT 1.2

/* The distance limit is kept a hair inside, so that rounding never reports a change beyond it. */
#define FAIRING_LIMIT_MARGIN (1.0 - 1e-12)

typedef struct fairing_box {
	double *lower_m, *upper_m; /* [waterlines][stations]; equal where nothing moves */
	double *closeness_weight;  /* 0 at '?' cells: there is no half-breadth to stay close to */
	size_t variable_count;
	double half_beam_m; /* of the smoothed hull */
} fairing_box;

/* 1 at each node that a lock of the options holds, [waterlines][stations], released by the caller.
 * Errors: USAGE (a lock that is not on the table), MEMORY. */
batten_status fairing_locks_create(batten_context *context, const batten_hull *hull,
                                   const batten_fair_options *options, uint8_t **out);

/* Variables are the positive offsets and the '?' cells that no lock holds; profile zeros stay. Bounds:
 * 0 <= y <= 1.2 h, |y - smoothed| <= distance, and the lower and upper hulls of the options. locked may
 * be NULL.
 * Errors: USAGE (a bound that is not on the table), INPUT (bounds that exclude each other, naming the
 * offset and the two), MEMORY. */
batten_status fairing_box_create(batten_context *context, const batten_hull *smoothed,
                                 const batten_fair_options *options, const uint8_t *locked,
                                 double distance_m, fairing_box *out);

/* The same into arrays that are there, as half_beam_m is. */
batten_status fairing_box_fill(batten_context *context, const batten_hull *smoothed,
                               const batten_fair_options *options, const uint8_t *locked,
                               double distance_m, fairing_box *box);

/* The search that fairs the hull with these weights; borrows hull and box. */
batten_search_problem fairing_problem(const batten_hull *smoothed, const fairing_box *box,
                                      double w1, double w2);
void fairing_box_release(batten_context *context, fairing_box *box);

#endif
