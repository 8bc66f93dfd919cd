/* The part of a net search's objective that holds it close to the target: a parabola, whose inverse turns
 * what pulls at the poles into a shift of the target that pulls alike. */
#ifndef BATTEN_BATCH_NET_CLOSENESS_H
#define BATTEN_BATCH_NET_CLOSENESS_H

#include "batch/net_plan.h"

/* Of a sound item: the parabola has the slopes at the ways, [count][v][u] each. Slopes of poles that move
 * together add up; a way is 0 of a pole that is fixed or sees nothing of closeness. Errors: INPUT (closeness does not tell the poles apart), MEMORY. */
batten_status net_closeness_invert(const net_plan *plan, size_t which, size_t count,
                                   const double *slopes, double *ways);

#endif
