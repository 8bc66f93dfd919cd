/* Searches on the plain C path: the packed problem of host/batch through the body of each precision. */
#ifndef BATTEN_BATCH_SEARCH_REFERENCE_H
#define BATTEN_BATCH_SEARCH_REFERENCE_H

#include "batch/search_pack.h"

/* Room for one search at a time in the plan's precision. */
typedef struct search_reference {
	const search_plan *plan;
	void *stencils, *arrays, *scratch;
} search_reference;

batten_status search_reference_create(const search_plan *plan, search_reference *out);
void search_reference_release(search_reference *search);

/* Number `which` of the plan's problems: y_m of its nodes and its result. */
void search_reference_run(search_reference *search, const batten_search_problem *problems,
                          size_t which, double *y_m, batten_search_result *result);

#endif
