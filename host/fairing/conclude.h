/* What comes after a search over offsets: measures kept, a polish, a certificate. */
#ifndef BATTEN_FAIRING_CONCLUDE_H
#define BATTEN_FAIRING_CONCLUDE_H

#include "fairing/box.h"
#include "fairing/fairing.h"

/* y and *result: the end of the search of `problem` with the options `search`; both become those of what is to
 * be kept. Fills certificate and what was kept of the fairing. Objectives are those of the problem as it was,
 * without multipliers. Errors: as fairing_keep(), MEMORY. */
batten_status fairing_conclude(batten_fairing *fairing, const batten_fair_options *options,
                               const fairing_box *box, const batten_search_options *search,
                               batten_search_problem problem, double *y,
                               batten_search_result *result);

#endif
