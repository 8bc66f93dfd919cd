#include "fairing/conclude.h"

#include "fairing/kept.h"

batten_status fairing_conclude(batten_fairing *fairing, const batten_fair_options *options,
                               const fairing_box *box, const batten_search_options *search,
                               batten_search_problem problem, double *y,
                               batten_search_result *result)
{
	batten_context *context = fairing->context;
	const batten_hull *hull = fairing->smoothed;
	const batten_grid grid = { hull->station_count, hull->waterline_count, hull->x_m, hull->z_m };
	const batten_search_problem plain = problem;
	const double objective_start = result->objective_start;
	double *target = NULL;
	batten_status status = BATTEN_OK;
	if (options->keep_count > 0) {
		target = batten_allocate(context, hull_node_count(hull), sizeof *target);
		status = target ? fairing_keep(fairing, options, box, search, target, &problem, y, result)
		                : BATTEN_MEMORY;
	}
	batten_certificate *certificate = &fairing->certificate;
	if (status == BATTEN_OK)
		status = options->polish_gap > 0.0
		             ? batten_search_polish_batch(context, &grid, 1, &problem, search,
		                                          options->polish_gap, y, certificate)
		             : batten_search_certify_batch(context, &grid, 1, &problem, search, y,
		                                           certificate);
	if (status == BATTEN_OK && certificate->steps > 0) {
		result->objective_end = certificate->objective;
		if (certificate->gap_estimate <= options->polish_gap)
			result->end = BATTEN_SEARCH_CONVERGED;
	}
	if (status == BATTEN_OK && problem.target_m != plain.target_m) {
		batten_certificate of_plain;
		status = batten_search_certify_batch(context, &grid, 1, &plain, search, y, &of_plain);
		certificate->gap_estimate *= certificate->objective / of_plain.objective;
		certificate->objective = of_plain.objective;
		result->objective_start = objective_start;
		result->objective_end = of_plain.objective;
	}
	fairing->certified = status == BATTEN_OK;
	batten_release(context, target);
	return status;
}
