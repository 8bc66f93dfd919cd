/* What searches over grids and over control nets have in common at their beginning and their end. */
#ifndef BATTEN_BATCH_SEARCH_RESULT_H
#define BATTEN_BATCH_SEARCH_RESULT_H

#include "core/context.h"
#include "shared/block_layout.h"
#include "shared/search_layout.h"

/* The weights of search number `which`. */
typedef struct search_weights {
	double w1, w2;
	size_t which;
} search_weights;

/* Numbers of searches, those of like stiffness side by side: they end after about as many iterations,
 * so that few lanes run idle. Sorts weights. */
void search_order(search_weights *weights, size_t count, size_t *order);

/* What a search's outcome means. */
batten_search_result search_result_of(const batten_search_options *options, double half_beam_m,
                                      const double values[SEARCH_OUTCOME_COUNT]);
/* That of a block search, whose objective has so many terms, each probed so often an iteration. */
batten_search_result search_result_of_block(const double values[BLOCK_OUTCOME_COUNT],
                                            unsigned probes, size_t terms);
batten_search_result search_result_refused(const char *fault);

/* Part of the lanes' turns in which they had a search, whose iterations are so many in all; without turns, on the C
 * path, 1: it has one lane, always at work. 0: not known. */
double search_lane_use(uint64_t iterations, uint64_t lane_turns);

/* OK, or an error that names the first search refused or at its limit. Errors: INCOMPLETE. */
batten_status search_results_judge(batten_context *context, size_t count,
                                   const batten_search_result *results);

/* An objective in its parts, each with its weight. */
typedef struct search_objective {
	double fairness, closeness;
} search_objective;
double search_objective_whole(search_objective sum);

/* What a certificate tells of it; the rest is 0, the gap not known. varies: fairness is the variation of
 * curvature, which h^2 makes a number. */
batten_certificate search_objective_told(search_objective sum, double w1, double w2,
                                         double half_beam_m, bool varies);

#endif
