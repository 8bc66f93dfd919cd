/* The fairing pass kernel against the C path on a small known batch. */
#ifndef BATTEN_BATCH_PASS_SELFTEST_H
#define BATTEN_BATCH_PASS_SELFTEST_H

#include "batch/pass_engine.h"

/* Fills the engine's test, with a pass of stretches or one without. Errors: DEVICE, MEMORY. */
batten_status pass_selftest_run(batch_engine *engine, bool stretches);

#endif
