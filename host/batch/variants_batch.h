/* A batch of hulls on one table through all that can run it: one queue, one worker a device, or the C
 * path. */
#ifndef BATTEN_BATCH_VARIANTS_BATCH_H
#define BATTEN_BATCH_VARIANTS_BATCH_H

#include "batch/variants_plan.h"

/* Fills the plan's out and found_y_m. Errors: USAGE, DEVICE, KERNEL, MEMORY. */
batten_status variants_batch_run(const variants_plan *plan, batten_run *run);

/* Row `which` on the C path, with room for it (variants_plan_room() of one) and a hull. */
void variants_reference_run(const variants_plan *plan, size_t which, double *room, double *y,
                            double *out);

#endif
