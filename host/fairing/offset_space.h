/* The offsets of a table as what a search moves. */
#ifndef BATTEN_FAIRING_OFFSET_SPACE_H
#define BATTEN_FAIRING_OFFSET_SPACE_H

#include "fairing/box.h"
#include "fairing/fairing.h"
#include "fairing/space.h"

/* Searches the offsets, y [count][waterlines][stations]; INCOMPLETE: one met its limit. Errors: INPUT (one is
 * refused), those of batten_search_batch(). */
batten_status offset_space_search(batten_fairing *fairing, size_t count,
                                  const batten_search_problem *problems,
                                  const batten_search_options *how, double *y,
                                  batten_search_result *results);

/* One search of a table; borrows all but the last. */
typedef struct offset_space {
	const batten_fairing *fairing;
	const fairing_box *box;
	const batten_search_options *search;
	batten_search_problem problem;
	batten_hull *hull; /* scratch */
} offset_space;

/* The space of the search, valid as long as `space` is; offset_space_close() whatever comes back. Errors:
 * MEMORY. */
batten_status offset_space_open(offset_space *space, fairing_space *out);
void offset_space_close(offset_space *space);

#endif
