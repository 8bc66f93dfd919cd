/* How many poles the net of a hull gets when nobody says. */
#ifndef BATTEN_FAIRING_NET_SIZE_H
#define BATTEN_FAIRING_NET_SIZE_H

#include "hull/hull.h"

/* Fills count_u and count_v where they are 0. With a and b the numbers of points on the longest
 * waterline and section and n the number of all, line ends and profile points included: 0.8 a poles
 * along the hull and 0.7 b from keel to deck, rounded up; those from keel to deck, then those along
 * the hull, as many fewer as it takes to have no more than 0.7 n. At least the order each, at most
 * NET_SIZE_MOST. '?' cells are no points. Errors: MEMORY. */
batten_status net_size_choose(const batten_hull *hull, batten_fit_options *fit);

enum { NET_SIZE_MOST = 32 };

#endif
