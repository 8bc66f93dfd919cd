/* One fairing, and the two ways to search it: over the offsets of the table, or over the control net
 * of a surface fitted to them. */
#ifndef BATTEN_FAIRING_FAIRING_H
#define BATTEN_FAIRING_FAIRING_H

#include "hull/hull.h"

struct batten_fairing {
	batten_context *context;
	batten_hull *input, *smoothed, *faired;
	uint8_t *locked; /* [waterlines][stations]: 1 where no offset may change */
	batten_replacement *replacements;
	size_t replacement_count;
	batten_search_result result;
	batten_certificate certificate; /* of result, with offsets */
	batten_run run;
	batten_fairing_facts facts;
	batten_surface *fitted_surface, *faired_surface; /* NULL with offsets */
	batten_fairing_net net;
};

/* The search over a fairing that is prepared: smoothed, faired (a copy of it), locked, and of the
 * facts noise_m and max_distance_m are there. What they write: the given half-breadths of faired,
 * result, run and the other facts. Return BATTEN_INCOMPLETE when a search met its limit, the chosen
 * one or another. */
batten_status fair_offsets(batten_fairing *fairing, const batten_fair_options *options);
batten_status fair_net(batten_fairing *fairing, const batten_fair_options *options);

#endif
