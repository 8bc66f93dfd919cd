/* The block search's kernel made ready on one device in one shape, known to equal the C path or not. */
#ifndef BATTEN_BATCH_BLOCK_ENGINE_H
#define BATTEN_BATCH_BLOCK_ENGINE_H

#include "batch/engine.h"
#include "batch/search_plan.h"

/* Builds the kernel for what the plan asks and runs its self-test, or finds the engine this context
 * already has. On failure result (may be NULL) still tells what happened. Errors: DEVICE, KERNEL,
 * MEMORY. */
batten_status block_engine_open(const search_plan *plan, size_t index, const batten_device *device,
                                batch_engine **out, batten_selftest *result);

/* Searches one launch should have, so that every compute unit has work and memory stays bounded. */
size_t block_engine_block(const batch_engine *engine, const search_plan *plan);

/* Runs the problems whose numbers stand in which[0..count); results and y_m are those of the batch.
 * lane_turns, may be NULL, is added the iterations that the lanes went through, idle or not. */
batten_status block_engine_run(batch_engine *engine, const search_plan *plan,
                               const batten_search_problem *problems, const size_t *which,
                               size_t count, double *y_m, batten_search_result *results,
                               uint64_t *lane_turns);

#endif
