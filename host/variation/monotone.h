/* A monotone function through points: cubics with slopes limited so that no interval turns back (F. N.
 * Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17, 1980), or straight lines; straight beyond its
 * ends. */
#ifndef BATTEN_VARIATION_MONOTONE_H
#define BATTEN_VARIATION_MONOTONE_H

#include "core/context.h"

struct monotone {
	batten_context *context;
	size_t count;
	double *from, *to, *slope; /* one allocation, from first */
	bool straight;             /* chords in place of cubics */
	double origin;             /* taken off every value */
};

/* count >= 2 points, ascending both ways. Errors: MEMORY. */
batten_status monotone_create(batten_context *context, size_t count, const double *from,
                              const double *to, bool straight, struct monotone *out);
void monotone_destroy(struct monotone *map);

/* user points to a struct monotone. */
double monotone_value(double at, const void *user);

#endif
