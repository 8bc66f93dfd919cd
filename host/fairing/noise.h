/* The noise of a hull's offsets, from high-order divided differences. */
#ifndef BATTEN_FAIRING_NOISE_H
#define BATTEN_FAIRING_NOISE_H

#include "hull/hull.h"

/* Standard deviation of what is not smooth in the half-breadths (m); 0 where too few points are
 * given to tell (fewer than 16 differences of each order in both directions).
 *
 * The m-th divided difference of m + 1 neighbours, divided by the root of the sum of squares of its
 * weights, gives white noise of standard deviation s the standard deviation s, while of a smooth
 * form less and less is left as m grows; a polynomial of lower degree than m leaves nothing. For
 * each direction (waterlines, sections) and each m from 4 to 8 the scale of all such differences is
 * the median of their magnitudes / 0.6745, which a few gross errors or steep spots do not move. A
 * direction's noise is the least over m. The two directions n_x, n_z are joined to sqrt(2 / (1 /
 * n_x^2 + 1 / n_z^2)): their mean where they agree, as on white noise, and never more than 1.42
 * times the lesser where they do not, as on a coarse table, where one direction sees form and not
 * noise.
 *
 * Only positive half-breadths that are given count ('?' cells and profile zeros do not), in pieces
 * that no knuckle and no empty cell breaks. Errors: MEMORY. */
batten_status noise_estimate(batten_context *context, const batten_hull *hull, double *noise_m);

/* The same from the scales of both directions, infinite where there are too few differences. */
double noise_of_scales(const double along[2]);

#endif
