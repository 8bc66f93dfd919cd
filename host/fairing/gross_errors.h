/* Smoothing (thesis 4.5): gross errors of single offsets, found and replaced before fairing. */
#ifndef BATTEN_FAIRING_GROSS_ERRORS_H
#define BATTEN_FAIRING_GROSS_ERRORS_H

#include "hull/hull.h"

/* Replaces the gross errors of a hull, save at the nodes marked in locked ([waterlines][stations], or
 * NULL: none). An offset is one when, on a line through it,
 *   - its second difference and its two neighbours' alternate in sign, the neighbours' not small: the
 *     mark of one wrong value, which a knuckle does not leave;
 *   - it lies further from the cubic through its two neighbours on either side than
 *     GROSS_ERROR_SCALE times the median of that distance on the line, and than 0.5 % of the
 *     half-beam;
 * and on the line that crosses there it is off to the same side by more than the usual distance too
 * (where that line has no two neighbours on either side, the first line must show it twice as
 * strongly). It is replaced by the cubic spline through the rest of the line that showed it most.
 * The worst of a neighbourhood is replaced first and the rest looked at anew, since an error spoils
 * its neighbours' differences. '?' cells, profile zeros (a 0 amid positive offsets is none), line ends
 * and points beside a knuckle are never replaced.
 *
 * *replacements (released by the caller) and *count list what was done, in order of station and
 * waterline. Errors: MEMORY. */
batten_status gross_errors_replace(batten_hull *hull, const uint8_t *locked,
                                   batten_replacement **replacements, size_t *count);

#endif
