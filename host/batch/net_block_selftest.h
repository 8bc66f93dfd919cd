/* The known-answer test of the block search's kernel for nets: small searches whose every bit the C path knows. */
#ifndef BATTEN_BATCH_NET_BLOCK_SELFTEST_H
#define BATTEN_BATCH_NET_BLOCK_SELFTEST_H

#include "batch/engine.h"
#include "batch/net_plan.h"

/* Searches with the fairness, orders and Gauss points of the plan. Fills the engine's test: compared, different,
 * run_s and message. Errors: DEVICE, KERNEL, MEMORY. */
batten_status net_block_selftest_run(batch_engine *engine, const net_plan *plan);

#endif
