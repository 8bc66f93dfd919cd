/* Measures of the hull that a search over offsets keeps within a tolerance. */
#ifndef BATTEN_FAIRING_KEPT_H
#define BATTEN_FAIRING_KEPT_H

#include "fairing/box.h"
#include "fairing/fairing.h"

/* What is asked of the end of a search: quantity and tolerance of each measure to keep, the gap to polish
 * to. Errors: USAGE. */
batten_status fairing_end_check(batten_context *context, const batten_fair_options *options);

/* y is where the search of the problem ended. Where a measure is kept and lies beyond its tolerance
 * there, y becomes the least of the same objective with all of them within; *problem then carries the
 * multipliers, in a target of the caller's, [waterlines][stations], and *result the last search, with
 * iterations and probes of all. Fills kept, kept_count and kept_rounds of the fairing. Errors: INPUT
 * (measures that the bounds, or each other, do not let be met: names them), those of the searches. */
batten_status fairing_keep(batten_fairing *fairing, const batten_fair_options *options,
                           const fairing_box *box, const batten_search_options *search,
                           double *target_m, batten_search_problem *problem, double *y,
                           batten_search_result *result);

#endif
