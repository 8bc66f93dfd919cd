/* Values by their place in ascending order. */
#ifndef BATTEN_CORE_MEDIAN_H
#define BATTEN_CORE_MEDIAN_H

#include <stddef.h>

/* Median of the count > 0 least of total values, none NaN, those finite: of an even number the mean of both
 * in the middle. guess: where it may be, any number; the nearer, the sooner it is found. */
double median_of_least(const double *list, size_t total, size_t count, double guess);

#endif
