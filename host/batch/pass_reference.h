/* Fairing passes on the plain C path. */
#ifndef BATTEN_BATCH_PASS_REFERENCE_H
#define BATTEN_BATCH_PASS_REFERENCE_H

#include "batch/pass_plan.h"

/* Room for one hull at a time. */
typedef struct pass_reference {
	const pass_plan *plan;
	pass_tables tables;
	void *state;
} pass_reference;

batten_status pass_reference_create(const pass_plan *plan, pass_reference *out);
void pass_reference_release(pass_reference *reference);
/* Works hull number `which` of the plan. */
void pass_reference_run(pass_reference *reference, size_t which);

#endif
