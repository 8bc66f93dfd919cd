/* The offsets of a table as what a search moves. */
#ifndef BATTEN_FAIRING_OFFSET_SPACE_H
#define BATTEN_FAIRING_OFFSET_SPACE_H

#include "fairing/box.h"
#include "fairing/fairing.h"

/* Searches the offsets, y [count][waterlines][stations]; INCOMPLETE: one met its limit. Errors: INPUT (one is
 * refused), those of batten_search_batch(). */
batten_status offset_space_search(batten_fairing *fairing, size_t count,
                                  const batten_search_problem *problems,
                                  const batten_search_options *how, double *y,
                                  batten_search_result *results);

/* One search of a table; borrows all but the last. */
typedef struct offset_space {
	batten_fairing *fairing;
	const fairing_box *box;
	const batten_search_options *search;
	batten_search_problem problem;
	batten_hull *hull; /* scratch */
} offset_space;

/* fairing_conclude() of the search; what is called scratch is of no use to the caller. */
batten_status offset_space_conclude(offset_space *space, const batten_fair_options *options,
                                    double *y, batten_search_result *result);

#endif
