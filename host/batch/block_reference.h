/* Block searches on the plain C path: the packed problem through the body of each precision. */
#ifndef BATTEN_BATCH_BLOCK_REFERENCE_H
#define BATTEN_BATCH_BLOCK_REFERENCE_H

#include "batch/block_pack.h"

/* Room for one search at a time in the plan's precision. */
typedef struct block_reference {
	const search_plan *plan;
	void *stencils, *input, *scratch;
} block_reference;

batten_status block_reference_create(const search_plan *plan, block_reference *out);
void block_reference_release(block_reference *search);

/* One problem: y_m of its nodes and its result. */
void block_reference_run(block_reference *search, const batten_search_problem *problem, double *y_m,
                         batten_search_result *result);

#endif
