/* A search on a shipped hull, as the library and as the oracle see it. */
#ifndef BATTEN_TESTS_SEARCH_CASE_H
#define BATTEN_TESTS_SEARCH_CASE_H

#include "batten.h"

#include "oracle/oracle.h"

typedef struct search_case {
	batten_context *context;
	batten_hull *hull;
	size_t nodes;
	double half_beam_m;
	double *lower_m, *upper_m;
	batten_grid grid;
} search_case;

/* Reads data/hulls/NAME.csv; offsets above 0 may move by part half-beams and stay in 0 .. 1.2 h.
 * Misprints are replaced first where smoothed is set. Fails the test when anything goes wrong. */
search_case search_case_open(const char *name, double part, bool smoothed);
void search_case_close(search_case *c);

/* The problem with weights w1 and w2. */
batten_search_problem search_case_problem(const search_case *c, double w1, double w2);
oracle_problem search_case_oracle(const search_case *c, double w1, double w2);

/* A number a node, all 0; to be freed. */
double *search_case_room(const search_case *c);

/* The certificate of an end, which is sound. */
batten_certificate search_case_certify(const search_case *c, const batten_search_problem *problem,
                                       const batten_search_options *options, const double *y);

/* A run that ends where it ends. */
batten_search_result search_case_run(const search_case *c, const batten_search_problem *problem,
                                     const batten_search_options *options, double *y);

/* Root mean square of y - y0 over the offsets above 0. */
double search_case_rms(const search_case *c, const double *y);

#endif
