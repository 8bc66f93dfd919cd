/* What comes after a search: measures kept, a polish, a certificate. */
#ifndef BATTEN_FAIRING_CONCLUDE_H
#define BATTEN_FAIRING_CONCLUDE_H

#include "fairing/fairing.h"
#include "fairing/space.h"

/* y and *result: the end of a search of the space; both become those of what is to be kept. Fills certificate
 * and what was kept of the fairing. Objectives are those without multipliers. Errors: as fairing_keep(),
 * MEMORY. */
batten_status fairing_conclude(batten_fairing *fairing, const batten_fair_options *options,
                               const fairing_space *space, double *y, batten_search_result *result);

#endif
