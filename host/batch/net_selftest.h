/* The net search kernel's known-answer test: small searches whose every bit the C path knows. */
#ifndef BATTEN_BATCH_NET_SELFTEST_H
#define BATTEN_BATCH_NET_SELFTEST_H

#include "batch/engine.h"
#include "batch/net_plan.h"

/* Searches with the fairness and orders of the plan. Fills the engine's test: compared, different,
 * run_s and message. Errors: DEVICE, KERNEL, MEMORY. */
batten_status net_selftest_run(batch_engine *engine, const net_plan *plan);

#endif
