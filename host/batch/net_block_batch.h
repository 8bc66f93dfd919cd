/* A batch of searches over control nets by the block search, through all that can run it. */
#ifndef BATTEN_BATCH_NET_BLOCK_BATCH_H
#define BATTEN_BATCH_NET_BLOCK_BATCH_H

#include "batch/net_plan.h"

/* Runs the items without a fault; fills the plan's y_m and their results. Errors: USAGE, DEVICE, KERNEL, MEMORY. */
batten_status net_block_batch_run(net_plan *plan, const size_t *which, size_t count,
                                  batten_run *run);

#endif
