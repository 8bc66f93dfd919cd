/* The ends of the lines of a table: what fit_outline makes the profile of. */
#ifndef BATTEN_GEOMETRY_FIT_ENDS_H
#define BATTEN_GEOMETRY_FIT_ENDS_H

#include "geometry/fit.h"

enum { FIT_AFT, FIT_FORWARD };

/* First and last point of every waterline that has any. Where sections are listed point by point,
 * waterlines do not have all of theirs: they end at the first and the last section that reach
 * them, and the feet of the sections and points of stem and stern have ends too. z ascends; y is NaN
 * where it is not given. */
struct fit_ends {
	size_t count;
	double *z, *x[2], *y[2]; /* [FIT_AFT], [FIT_FORWARD] */
};

/* Foot and top of every section, nodes and line ends, '?' included; NaN where it has no point. Where
 * waterlines are listed point by point, those that go past a section without a point there count as
 * well, with an infinite y. */
struct fit_sections {
	double *low, *low_y, *high;
};

/* The ends of the waterlines alone. fit_ends_release() whatever is returned; *ends is all 0 before.
 * Errors: MEMORY. */
batten_status fit_ends_create(const batten_hull *hull, struct fit_ends *ends);
void fit_ends_release(batten_context *context, struct fit_ends *ends);

/* What sections that are listed point by point add to the ends. */
void fit_ends_extend(const batten_hull *hull, const struct fit_sections *sections,
                     struct fit_ends *ends);

/* As fit_ends_create(). */
batten_status fit_sections_create(const batten_hull *hull, const struct fit_ends *ends,
                                  struct fit_sections *out);
void fit_sections_release(batten_context *context, struct fit_sections *sections);

#endif
