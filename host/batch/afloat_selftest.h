/* Whether the kernel of surfaces afloat, as it stands ready on a device, equals the C path. */
#ifndef BATTEN_BATCH_AFLOAT_SELFTEST_H
#define BATTEN_BATCH_AFLOAT_SELFTEST_H

#include "batch/engine.h"

/* Fills the engine's test but for its end. Errors: DEVICE, KERNEL, MEMORY. */
batten_status afloat_selftest_run(batch_engine *engine);

#endif
