/* The surface whose net is faired, as large as the offsets ask for when nobody says. */
#ifndef BATTEN_FAIRING_NET_FIT_H
#define BATTEN_FAIRING_NET_FIT_H

#include "hull/hull.h"

enum { NET_FIT_POLES_MOST = 32 }; /* along one direction, when nobody says */

/* Fits a surface to the hull, of options->count_u x count_v poles. Counts of 0 are chosen: with a and
 * b the points of the longest waterline and section and n all points (line ends and profile points
 * included, '?' cells not), at most 0.8 a poles along the hull, and from keel to deck 0.7 b, both
 * rounded up, but no more than 7/6 of those along the hull; as many fewer as it takes to have no
 * more than 0.7 n; at least the order each. Where both are chosen, 4/8, 5/8 ... 8/8 of these are
 * tried, and the first net that leaves no more than the noise is taken: a deviation of
 * noise * sqrt(1 - poles / n), or of rounding. Errors: as batten_hull_fit. */
batten_status net_fit(const batten_hull *hull, const batten_fit_options *options, double noise_m,
                      batten_surface **out, batten_fit_deviation *deviation);

#endif
