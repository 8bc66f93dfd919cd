/* The block search kernel's known-answer test: small searches whose every bit the C path knows. */
#ifndef BATTEN_BATCH_BLOCK_SELFTEST_H
#define BATTEN_BATCH_BLOCK_SELFTEST_H

#include "batch/engine.h"
#include "batch/search_plan.h"

/* With the slopes the plan asks for. Fills result, compared, different, run_s and message. Errors:
 * DEVICE, KERNEL, MEMORY. */
batten_status block_selftest_run(batch_engine *engine, const search_plan *plan,
                                 batten_selftest *result);

#endif
