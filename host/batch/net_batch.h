/* A batch of searches over control nets through all that can run it. */
#ifndef BATTEN_BATCH_NET_BATCH_H
#define BATTEN_BATCH_NET_BATCH_H

#include "batch/net_plan.h"

/* Runs the items without a fault; fills the plan's y_m and results. Errors: USAGE, DEVICE, KERNEL,
 * MEMORY. */
batten_status net_batch_run(net_plan *plan, batten_run *run);

#endif
