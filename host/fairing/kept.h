/* Measures of the hull that a search keeps within a tolerance. */
#ifndef BATTEN_FAIRING_KEPT_H
#define BATTEN_FAIRING_KEPT_H

#include "fairing/fairing.h"
#include "fairing/space.h"

/* What is asked of the end of a search: quantity and tolerance of each measure to keep, the gap to polish
 * to. Errors: USAGE. */
batten_status fairing_end_check(batten_context *context, const batten_fair_options *options);

/* y is where a search of the space ended. Where a measure is kept and lies beyond its tolerance there, y
 * becomes the least of the same objective with all of them within; then *shifted, target_m (the caller's, a
 * number a variable) carries the multipliers, and *result is the last search, with iterations and probes of
 * all. Fills kept, kept_count and kept_rounds of the fairing. Errors: INPUT (measures that the bounds, or
 * each other, do not let be met: names them), those of the space. */
batten_status fairing_keep(batten_fairing *fairing, const batten_fair_options *options,
                           const fairing_space *space, double *target_m, bool *shifted, double *y,
                           batten_search_result *result);

#endif
