/* The surface kernel made ready on one device in one shape, known to equal the C path or not. */
#ifndef BATTEN_BATCH_SURFACE_ENGINE_H
#define BATTEN_BATCH_SURFACE_ENGINE_H

#include "batch/engine.h"
#include "batch/surface_plan.h"

/* Builds the kernel for the plan's output, orders, precision, lanes and work-group (those that suit
 * the device where the plan has 0) and runs its self-test, or finds the engine this context already
 * has. On failure result (may be NULL) still tells what happened. Errors: DEVICE, KERNEL, MEMORY. */
batten_status surface_engine_open(const surface_plan *plan, size_t index,
                                  const batten_device *device, batch_engine **out,
                                  batten_selftest *result);

/* Surfaces a run should have: enough for every compute unit, in bounded memory. */
size_t surface_engine_block(const batch_engine *engine, const surface_plan *plan);

/* Whether the kernel gives back doubles, or numbers of the precision: a CPU turns them into what the
 * caller wants where they are made, others have them travel as short as they are. */
bool surface_engine_returns_doubles(const batten_device *device, const surface_plan *plan);

/* Works the surfaces whose numbers stand in which[0..count). Errors: DEVICE, KERNEL, MEMORY. */
batten_status surface_engine_run(batch_engine *engine, const surface_plan *plan,
                                 const size_t *which, size_t count);

#endif
