/* A batch of surfaces through all that can run it: one queue, one worker a device, or the C path. */
#ifndef BATTEN_BATCH_SURFACE_BATCH_H
#define BATTEN_BATCH_SURFACE_BATCH_H

#include "batch/surface_plan.h"

/* Fills the plan's values and singular. Errors: USAGE, DEVICE, KERNEL, MEMORY. */
batten_status surface_batch_run(const surface_plan *plan, batten_run *run);

#endif
