/* A front, over what its points are: batches of searches that differ in what closeness counts. */
#ifndef BATTEN_FAIRING_FRONT_H
#define BATTEN_FAIRING_FRONT_H

#include "fairing/fairing.h"

typedef struct front {
	batten_fairing *fairing; /* prepared */
	const batten_fair_options *options;
	size_t count;
	batten_front_point *points; /* with their ratios, 0 else */
	batten_search_result *results;
	batten_certificate *certificates;
} front;

/* Search every point: fill results, certificates and, of the points, closeness, kept and surface. Within a limit
 * of iterations is OK. */
batten_status front_offsets(const front *f);
batten_status front_net(const front *f);

/* Whether points are concluded one by one: something is to be kept, or they are to be polished. */
bool front_concludes(const front *f);

/* What was just concluded, as the certificate and the kept measures of a point. */
void front_take_concluded(const front *f, size_t point);

#endif
