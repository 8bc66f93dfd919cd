/* Surfaces on the plain C path, in the layout of host/batch. */
#ifndef BATTEN_BATCH_SURFACE_REFERENCE_H
#define BATTEN_BATCH_SURFACE_REFERENCE_H

#include "batch/surface_plan.h"

/* Room for one surface at a time. */
typedef struct surface_reference {
	const surface_plan *plan;
	void *table_u, *table_v, *net, *out, *scratch;
} surface_reference;

batten_status surface_reference_create(const surface_plan *plan, surface_reference *out);
void surface_reference_release(surface_reference *reference);
/* Works surface number `which` of the plan. */
void surface_reference_run(surface_reference *reference, size_t which);

#endif
