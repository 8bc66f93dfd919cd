/* The non-dominated ones of many points: no other is at least as good in every objective and better in
 * one. */
#ifndef BATTEN_SWEEP_FRONT_H
#define BATTEN_SWEEP_FRONT_H

#include "core/context.h"

/* values [count][objectives], less is better, none NaN; on_front [count] gets 1 or 0. Equal points are on
 * the front together. Time: count log count for one or two objectives; for more, count times the size
 * of the front at worst. Errors: MEMORY. */
batten_status sweep_front_find(batten_context *context, size_t count, size_t objectives,
                               const double *values, uint8_t *on_front);

#endif
