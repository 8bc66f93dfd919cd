/* The kernel of surfaces afloat made ready on one device in one shape, known to equal the C path or not. */
#ifndef BATTEN_BATCH_AFLOAT_ENGINE_H
#define BATTEN_BATCH_AFLOAT_ENGINE_H

#include "batch/afloat_plan.h"
#include "batch/engine.h"

/* Builds the kernel for the plan's lanes and work-group (those that suit the device where the plan has
 * 0) and runs its self-test, or finds the engine this context already has. On failure result (may be
 * NULL) still tells what happened. Errors: DEVICE, KERNEL, MEMORY. */
batten_status afloat_engine_open(const afloat_plan *plan, size_t index, const batten_device *device,
                                 batch_engine **out, batten_selftest *result);

/* Surfaces a launch should have: enough for every compute unit, in bounded memory. */
size_t afloat_engine_block(const batch_engine *engine, const afloat_plan *plan);

/* Works the surfaces whose numbers stand in which[0..count). Errors: DEVICE, KERNEL, MEMORY. */
batten_status afloat_engine_run(batch_engine *engine, const afloat_plan *plan, const size_t *which,
                                size_t count);

#endif
