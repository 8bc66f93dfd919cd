/* Measuring hull after hull: what those on one table share is worked once, and all of them in the same
 * memory. */
#ifndef BATTEN_FAIRING_MEASURE_ROOM_H
#define BATTEN_FAIRING_MEASURE_ROOM_H

#include "hull/hull.h"

typedef struct measure_room measure_room;

/* Empty: it takes the table of each hull as it comes. One thread at a time. Errors: MEMORY. */
batten_status measure_room_create(batten_context *context, measure_room **out);
void measure_room_destroy(measure_room *room);

/* The measures of a hull that are not hydrostatics: fairness, inflections, noise, energies. Errors:
 * MEMORY. */
batten_status measure_room_fairness(measure_room *room, const batten_hull *hull,
                                    batten_measures *out);

/* batten_hull_closeness() of two hulls that have one table and the same nodes. */
batten_status measure_room_closeness(measure_room *room, const batten_hull *hull,
                                     const batten_hull *reference, batten_closeness *out);

#endif
