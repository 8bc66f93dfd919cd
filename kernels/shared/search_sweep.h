/* Sweeps of a multilevel pattern search (Hooke and Jeeves; thesis 7.2) over its directions. Several searches
 * run side by side, one a lane; in OpenCL the work-items of a group share the directions of a colour.
 *
 * Defined before this is included:
 *   search_state       nodes; y, base, trial: STATE stored *; lower, upper: GLOBAL const stored *;
 *                      colour_count; wide_colours, those of them, the first, that wait for their turn
 *                      (multilevel.h), and wide_probes, a real, two for each of their directions
 *   void sweeps_begin(const search_state *)
 *                      what an iteration's moves need before the first
 *   real direction_explore(const search_state *, int colour, int direction, real h, real *extra)
 *                      an exploratory move along a direction, its parabola's bottom counted in extra;
 *                      returns the length of the step taken
 *   void colour_range(const search_state *, int colour, int *first, int *end)
 *                      directions of a colour, colours in the order they are worked
 *   void colour_end(const search_state *, int colour)
 *                      what is to be done behind a colour
 *   real whole_objective(const search_state *)
 *                      at trial, the same in every work-item */
#ifndef BATTEN_SHARED_SEARCH_SWEEP_H
#define BATTEN_SHARED_SEARCH_SWEEP_H

#include "dialect.h"
#include "multilevel.h"
#include "search_progress.h"

/* The directions of some colours. Returns the longest step this work-item took. */
SHARED_FUNCTION real search_sweep(const search_state *s, int first_colour, int end_colour, real h,
                                  real *extra)
{
	real longest = SPREAD(LITERAL(0.0));
	ROLLED
	for (int colour = first_colour; colour < end_colour; colour++) {
		int first = 0;
		int end = 0;
		colour_range(s, colour, &first, &end);
		ROLLED
		for (int d = first + WORK_ITEM; d < end; d += WORK_ITEMS) {
			const real length = direction_explore(s, colour, d, h, extra);
			longest = CHOOSE(length > longest, length, longest);
		}
		WAIT;
		colour_end(s, colour);
	}
	return longest;
}

/* The longest step and the number of probes of all work-items: a maximum and a sum of whole numbers,
 * so their order does not matter. */
SHARED_FUNCTION void search_gather(const search_state *s, real *longest, real *extra)
{
	STATE stored *gathered = s->gathered;
	AT(gathered[WORK_ITEM]) = *longest;
	AT(gathered[WORK_ITEMS + WORK_ITEM]) = *extra;
	WAIT;
	*extra = SPREAD(LITERAL(0.0));
	ROLLED
	for (int w = 0; w < WORK_ITEMS; w++) {
		*longest = CHOOSE(AT(gathered[w]) > *longest, AT(gathered[w]), *longest);
		*extra += AT(gathered[WORK_ITEMS + w]);
	}
	WAIT;
}

#endif
