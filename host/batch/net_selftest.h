/* The net search kernel's known-answer test: small searches whose every bit the C path knows. */
#ifndef BATTEN_BATCH_NET_SELFTEST_H
#define BATTEN_BATCH_NET_SELFTEST_H

#include "batch/engine.h"
#include "batch/net_plan.h"

/* How a search over nets is run by the engine, and by the C path. */
typedef struct net_selftest_sides {
	batten_status (*run)(batch_engine *engine, const net_plan *plan, const size_t *which,
	                     size_t count);
	batten_status (*run_known)(const net_plan *plan);
} net_selftest_sides;

/* Runs searches with the fairness, orders and Gauss points a span (0: two) of the plan on both sides; its u has no
 * fewer poles than v. Fills the engine's test: compared, different, run_s and message. Errors: DEVICE, KERNEL,
 * MEMORY. */
batten_status net_selftest_compare(batch_engine *engine, const net_plan *plan,
                                   const net_selftest_sides *sides);

/* Searches by the multilevel kernel with the fairness and orders of the plan. Fills the engine's test: compared, different,
 * run_s and message. Errors: DEVICE, KERNEL, MEMORY. */
batten_status net_selftest_run(batch_engine *engine, const net_plan *plan);

#endif
