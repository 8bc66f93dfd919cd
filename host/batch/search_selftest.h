/* The search kernels' known-answer test: small searches whose every bit the C path knows. */
#ifndef BATTEN_BATCH_SEARCH_SELFTEST_H
#define BATTEN_BATCH_SEARCH_SELFTEST_H

#include "batch/search_engine.h"

/* The kernel of an algorithm, and its C path. */
typedef struct search_selftest_sides {
	void *engine;
	batten_status (*run)(void *engine, const search_plan *plan,
	                     const batten_search_problem *problems, const size_t *which, size_t count,
	                     double *y_m, batten_search_result *results);
	batten_status (*run_known)(const search_plan *plan, const batten_search_problem *problems,
	                           size_t which, double *y_m, batten_search_result *result);
} search_selftest_sides;

/* Runs both on small searches with these options; fills result as below. */
batten_status search_selftest_compare(batten_context *context, const search_selftest_sides *sides,
                                      const batten_search_options *options, unsigned lanes,
                                      batten_selftest *result);

/* Fills result, compared, different, run_s and message. Errors: DEVICE, KERNEL, MEMORY. */
batten_status search_selftest_run(search_engine *engine, batten_selftest *result);

#endif
