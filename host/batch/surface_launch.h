/* Surfaces that follow each other, on one device: what is packed, launched and given back. */
#ifndef BATTEN_BATCH_SURFACE_LAUNCH_H
#define BATTEN_BATCH_SURFACE_LAUNCH_H

#include "batch/surface_engine.h"

/* Works the surfaces number first .. first + count - 1 of the plan. Errors: DEVICE, KERNEL, MEMORY. */
batten_status surface_launch_run(const batch_engine *engine, const surface_plan *plan, size_t first,
                                 size_t count);

#endif
