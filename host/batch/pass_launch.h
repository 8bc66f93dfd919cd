/* Hulls that follow each other, on one device: what is uploaded, launched and given back. */
#ifndef BATTEN_BATCH_PASS_LAUNCH_H
#define BATTEN_BATCH_PASS_LAUNCH_H

#include "batch/pass_engine.h"

/* Whether half-breadths come and go as doubles, or as numbers of the precision: a CPU turns them into
 * what it works with where it reads them, others have them travel as short as they are. */
bool pass_launch_in_doubles(const batten_device *device, batten_precision precision);

/* Works the hulls number first .. first + count - 1 of the plan. Errors: DEVICE, KERNEL, MEMORY. */
batten_status pass_launch_run(const batch_engine *engine, const pass_plan *plan, size_t first,
                              size_t count);

#endif
