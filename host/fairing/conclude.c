#include "fairing/conclude.h"

#include "fairing/kept.h"

batten_status fairing_conclude(batten_fairing *fairing, const batten_fair_options *options,
                               const fairing_space *space, double *y, batten_search_result *result)
{
	batten_context *context = fairing->context;
	batten_certificate *certificate = &fairing->certificate;
	const double objective_start = result->objective_start;
	bool shifted = false;
	double *target = NULL;
	batten_status status = BATTEN_OK;
	if (options->keep_count > 0) {
		target = batten_allocate(context, space->count, sizeof *target);
		status = target ? fairing_keep(fairing, options, space, target, &shifted, y, result)
		                : BATTEN_MEMORY;
	}
	if (status == BATTEN_OK)
		status = space->certify(space->of, shifted ? target : NULL, options->polish_gap, y,
		                        certificate);
	if (status == BATTEN_OK && certificate->steps > 0) {
		result->objective_end = certificate->objective;
		if (certificate->gap_estimate <= options->polish_gap)
			result->end = BATTEN_SEARCH_CONVERGED;
	}
	if (status == BATTEN_OK && shifted) {
		batten_certificate of_plain;
		status = space->certify(space->of, NULL, 0.0, y, &of_plain);
		certificate->gap_estimate *= certificate->objective / of_plain.objective;
		certificate->objective = of_plain.objective;
		certificate->closeness_m4 = of_plain.closeness_m4;
		result->objective_start = objective_start;
		result->objective_end = of_plain.objective;
	}
	fairing->certified = status == BATTEN_OK;
	batten_release(context, target);
	return status;
}
