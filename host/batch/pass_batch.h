/* A batch of hulls through all that can run a fairing pass: one queue, one worker a device, or the C
 * path. */
#ifndef BATTEN_BATCH_PASS_BATCH_H
#define BATTEN_BATCH_PASS_BATCH_H

#include "batch/pass_plan.h"

/* Fills the plan's out_m. Errors: USAGE, DEVICE, KERNEL, MEMORY. */
batten_status pass_batch_run(const pass_plan *plan, batten_run *run);

#endif
