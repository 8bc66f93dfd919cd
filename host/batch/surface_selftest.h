/* The surface kernel's known-answer test: small surfaces whose every bit the C path knows. */
#ifndef BATTEN_BATCH_SURFACE_SELFTEST_H
#define BATTEN_BATCH_SURFACE_SELFTEST_H

#include "batch/surface_engine.h"

/* Tests the engine with the output, the orders and the kind of the plan; fills engine->test.
 * Errors: DEVICE, KERNEL, MEMORY. */
batten_status surface_selftest_run(batch_engine *engine, const surface_plan *plan);

#endif
