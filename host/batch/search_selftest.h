/* The search kernel's known-answer test: small searches whose every bit the C path knows. */
#ifndef BATTEN_BATCH_SEARCH_SELFTEST_H
#define BATTEN_BATCH_SEARCH_SELFTEST_H

#include "batch/search_engine.h"

/* Fills result, compared, different, run_s and message. Errors: DEVICE, KERNEL, MEMORY. */
batten_status search_selftest_run(search_engine *engine, batten_selftest *result);

#endif
