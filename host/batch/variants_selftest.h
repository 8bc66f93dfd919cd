/* The known-answer test of the kernel of hulls on one table: small hulls whose every bit the C path
 * knows. */
#ifndef BATTEN_BATCH_VARIANTS_SELFTEST_H
#define BATTEN_BATCH_VARIANTS_SELFTEST_H

#include "batch/variants_engine.h"

/* Tests the engine with variants and with half-breadths that are given; fills engine->test. Errors:
 * DEVICE, KERNEL, MEMORY. */
batten_status variants_selftest_run(batch_engine *engine);

#endif
