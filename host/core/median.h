/* Values by their place in ascending order. */
#ifndef BATTEN_CORE_MEDIAN_H
#define BATTEN_CORE_MEDIAN_H

#include <stddef.h>

/* How many of total values, none NaN, are below a limit. */
size_t values_below(const double *list, size_t total, double limit);

/* Median of the count > 0 least of total values, none NaN, those finite: of an even number the mean of both
 * in the middle. */
double median_of_least(const double *list, size_t total, size_t count);

#endif
