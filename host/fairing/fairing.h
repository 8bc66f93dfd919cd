/* One fairing, and the ways to it: a search over the offsets of the table or over the control net of a
 * surface fitted to them, or passes of forward or inverse fairing. */
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
	bool certified;                 /* by a search */
	batten_certificate certificate; /* of result */
	batten_run run;
	batten_fairing_facts facts;
	batten_kept kept[BATTEN_KEEP_LIMIT];
	size_t kept_count;
	unsigned kept_rounds;
	batten_surface *fitted_surface, *faired_surface; /* NULL with offsets */
	batten_fairing_net net;
	batten_fairing_row *rows; /* of forward and inverse methods */
	size_t row_count;
	batten_fairing_pass pass;
};

/* Checks hull and options; makes locked, input, smoothed and faired (both the same), and of the facts
 * noise_m and max_distance_m. Errors: those of batten_hull_fair but for the search's. */
batten_status fairing_prepare(batten_fairing *fairing, const batten_hull *hull,
                              const batten_fair_options *options);

/* The search over a fairing that is prepared. What they write: the given half-breadths of faired,
 * result, run and the other facts. Return BATTEN_INCOMPLETE when a search met its limit, the chosen
 * one or another. */
batten_status fair_offsets(batten_fairing *fairing, const batten_fair_options *options);
batten_status fair_net(batten_fairing *fairing, const batten_fair_options *options);

/* Forward and inverse methods over the same: writes the half-breadths and line ends of faired, run,
 * rows and pass. */
batten_status fair_pass(batten_fairing *fairing, const batten_fair_options *options);

/* The method and the options that are its own, or another's. Errors: USAGE. */
batten_status fair_pass_check(batten_context *context, const batten_fair_options *options);

#endif
