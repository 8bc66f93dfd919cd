/* The fairing pass kernel made ready on one device in one shape, known to equal the C path or not. */
#ifndef BATTEN_BATCH_PASS_ENGINE_H
#define BATTEN_BATCH_PASS_ENGINE_H

#include "batch/engine.h"
#include "batch/pass_plan.h"

/* Builds the kernel for the plan's precision, lanes and work-group (those that suit the device where
 * the plan has 0) and runs its self-test, or finds the engine this context already has. On failure
 * result (may be NULL) still tells what happened. Errors: DEVICE, KERNEL, MEMORY. */
batten_status pass_engine_open(const pass_plan *plan, size_t index, const batten_device *device,
                               batch_engine **out, batten_selftest *result);

/* Hulls a run should have: enough for every compute unit, in bounded memory. */
size_t pass_engine_block(const batch_engine *engine, const pass_plan *plan);

/* Works the hulls whose numbers stand in which[0..count). Errors: DEVICE, KERNEL, MEMORY. */
batten_status pass_engine_run(batch_engine *engine, const pass_plan *plan, const size_t *which,
                              size_t count);

#endif
