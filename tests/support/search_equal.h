/* Whole searches on a device against the plain C path, bit for bit. */
#ifndef BATTEN_TESTS_SEARCH_EQUAL_H
#define BATTEN_TESTS_SEARCH_EQUAL_H

#include "support/search_case.h"

#include "batch/search_engine.h"

enum { EQUAL_COUNT = 19 }; /* searches of a case: two groups of eight lanes and some */

/* Weights w2/w1 from 10 to 4e6, one a search. */
void search_equal_problems(const search_case *c, batten_search_problem problems[EQUAL_COUNT]);

/* Runs them in the shape given, and on the C path; fails the test on the first bit that differs. */
void search_equal_check(const search_case *c, const search_shape *shape);

/* Whole runs of a batch with interior penalties, every round, on device 0 in this shape and on the C path. */
void search_equal_penalised(const search_case *c, batten_precision precision, unsigned lanes,
                            unsigned work_group);

/* Fails unless two ends of a batch are the same. */
void search_equal_compare(const search_case *c, const double *y,
                          const batten_search_result *results, const double *known_y,
                          const batten_search_result *known);

#endif
