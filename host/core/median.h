/* Values by their place in ascending order. */
#ifndef BATTEN_CORE_MEDIAN_H
#define BATTEN_CORE_MEDIAN_H

#include <stddef.h>

/* Median of the count > 0 least of total values, none NaN: of an even number the mean of both in the middle.
 * room: 2 total values. */
double median_of_least(const double *list, size_t total, size_t count, double *room);

#endif
