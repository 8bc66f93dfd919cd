/* A batch of surfaces afloat on whatever there is to run it. */
#ifndef BATTEN_BATCH_AFLOAT_BATCH_H
#define BATTEN_BATCH_AFLOAT_BATCH_H

#include "batch/afloat_plan.h"

/* Surface `which` on the plain C path; poles and room are the caller's, afloat_plan_net() and
 * afloat_plan_room() of one work-item, out is afloat_plan_outcome(). */
void afloat_reference_run(const afloat_plan *plan, size_t which, double *poles, double *out,
                          double *room);

/* All of them. run may be NULL. Errors: USAGE (no such device), DEVICE, KERNEL, MEMORY. */
batten_status afloat_batch_run(const afloat_plan *plan, batten_run *run);

#endif
