/* batten.h, one part of it: the pattern search over control nets, many at a time. */
#ifndef BATTEN_NET_H
#define BATTEN_NET_H

#include "base.h"
#include "search.h"
#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * The pattern search over the control net of a surface, many at a time
 * --------------------------------------------------------------------------------------------- */

/* One search: the y of the poles of a surface. Minimises
 *     F = w1 * integral of fairness dA + w2 * integral of (y - target)^2 |x_u z_v - x_v z_u| du dv / h^4
 * by Gauss quadrature over every knot span, lower <= y <= upper; a pole with lower == upper is
 * fixed. x, z and the knots stay. Points where the start has no normal count nothing in the first
 * integral, whatever the search does. Arrays are [count_v][count_u], as in batten_surface_net. */
typedef struct batten_net_problem {
	const batten_surface *start; /* without weights; y is clamped into the box */
	const double *target_y_m;    /* poles of the surface to stay close to; NULL: those of start */
	const double *lower_y_m, *upper_y_m; /* lower <= upper, finite, within 1e9 m */
	double w1, w2;                       /* dimensionless, as in batten_search_problem */
	double half_beam_m;                  /* h, > 0 */
} batten_net_problem;

typedef struct batten_net_options {
	size_t struct_size;
	/* first_step 0.01, else as its own default; AUTO takes BLOCK for bending and mean, else, and where the net's
	 * table is too large (about 4000 poles in a square), MULTILEVEL */
	batten_search_options search;
	batten_fairness fairness; /* BATTEN_FAIRNESS_BENDING */
	unsigned gauss_points;    /* a knot span and direction, 1..16; 0 takes the order */
	/* [count_v][count_u], the same for the whole batch: index (row * count_u + column) of the pole
	 * that a pole moves with, both by the same distance, which stays in the boxes of both; its own
	 * index: the pole is free or leads. NULL: all are free. An edge keeps its tangents when the row
	 * beside it moves with it. */
	const size_t *leader;
} batten_net_options;
BATTEN_API void batten_net_options_default(batten_net_options *options);

/* Runs count searches over surfaces of one topology (orders, counts and knots; without weights; at
 * most 65536 poles) by the block search or the multilevel one (kernels/README.md). y_m is the caller's,
 * [count][count_v][count_u]; results [count]; options and run may be NULL. The result of a search
 * does not depend on the others, on their order or number, nor (when strict) on what ran it.
 * Returns INCOMPLETE when a search was refused (then its y_m is not written) or met its limit.
 * Errors: USAGE (options, BLOCK where it does not apply, a leader that is out of range or follows another, surfaces of different
 * topology or with weights), DEVICE, KERNEL, MEMORY. */
BATTEN_API batten_status batten_net_search_batch(batten_context *context, size_t count,
                                                 const batten_net_problem *problems,
                                                 const batten_net_options *options, double *y_m,
                                                 batten_search_result *results, batten_run *run);

/* Judges the ends of count searches, as batten_search_certify_batch() does those over offsets: free are the
 * poles that are not fixed, nor held at a bound by the gradient; those that move together are one.
 * fairness of a certificate is the integral of fairness dA. Problems, options and y_m as given to and by
 * batten_net_search_batch(). Returns INCOMPLETE when a problem is invalid or y not finite (its numbers
 * are NaN, message says why). Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_net_certify_batch(batten_context *context, size_t count,
                                                  const batten_net_problem *problems,
                                                  const batten_net_options *options,
                                                  const double *y_m,
                                                  batten_certificate *certificates);

/* Goes on from the ends y_m, in double, until the gap estimate of each is at most `gap` (above 0), as
 * batten_search_polish_batch() does. */
BATTEN_API batten_status batten_net_polish_batch(batten_context *context, size_t count,
                                                 const batten_net_problem *problems,
                                                 const batten_net_options *options, double gap,
                                                 double *y_m, batten_certificate *certificates);

#ifdef __cplusplus
}
#endif

#endif
