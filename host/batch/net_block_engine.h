/* The block search's kernel for control nets made ready on one device in one shape, known to equal the C path or
 * not. */
#ifndef BATTEN_BATCH_NET_BLOCK_ENGINE_H
#define BATTEN_BATCH_NET_BLOCK_ENGINE_H

#include "batch/engine.h"
#include "batch/net_plan.h"

/* Builds the kernel for the plan's fairness, orders, Gauss points, precision, lanes and work-group (those that suit
 * the device where the plan has 0) and runs its self-test, or finds the engine this context already has. On
 * failure result (may be NULL) still tells what happened. Errors: DEVICE, KERNEL, MEMORY. */
batten_status net_block_engine_open(const net_plan *plan, size_t index, const batten_device *device,
                                    batch_engine **out, batten_selftest *result);

/* Searches one launch should have, so that every compute unit has work and memory stays bounded. */
size_t net_block_engine_block(const batch_engine *engine);

/* Runs the searches whose numbers stand in which[0..count). lane_turns, may be NULL, is added the iterations that
 * the lanes went through, idle or not. Errors: DEVICE, KERNEL, MEMORY. */
batten_status net_block_engine_run(batch_engine *engine, const net_plan *plan, const size_t *which,
                                   size_t count, uint64_t *lane_turns);

#endif
