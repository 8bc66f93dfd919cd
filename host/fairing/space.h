/* What a search moves, be it the offsets of a table or the poles of a net: all that keeping measures and
 * judging the end of a search know of it. */
#ifndef BATTEN_FAIRING_SPACE_H
#define BATTEN_FAIRING_SPACE_H

#include "batten.h"

/* y: one number a variable. Functions get `of` and return the errors of what they call. */
typedef struct fairing_space {
	void *of;
	const char *variables; /* the word for them */
	size_t count;
	const double *start_m;           /* what closeness is to, and where what is kept is measured */
	const double *lower_m, *upper_m; /* equal where a variable stays or moves with another */

	/* Moves a variable of y, and those that move with it. */
	void (*move)(const void *of, double *y, size_t variable, double way_m);

	/* Hydrostatics of `count` hulls, y [count][variables], which may be completed. The plain C path, whatever
	 * searches: the same on all. */
	batten_status (*measure)(void *of, size_t count, double *y, batten_hydrostatics *found);

	/* How far closeness alone lets the variables go for a slope, [count][variables] each: the inverse of its
	 * second derivatives. A slope is that of a variable with all that move with it. */
	batten_status (*yield)(void *of, size_t count, const double *slopes, double *ways);

	/* The same of the whole objective about its end y, what is held left out; *known false: it tells nothing
	 * there. NULL: not known. */
	batten_status (*answer)(void *of, const double *target_m, const double *y, size_t count,
	                        const double *slopes, double *ways, bool *known);

	/* Searches on from y, close to the target; in f64. Within a limit of iterations is OK. */
	batten_status (*search)(void *of, const double *target_m, double *y,
	                        batten_search_result *result, batten_run *run);

	/* Judges y, or polishes it to a gap above 0. target_m NULL: start_m. */
	batten_status (*certify)(void *of, const double *target_m, double gap, double *y,
	                         batten_certificate *certificate);
} fairing_space;

#endif
