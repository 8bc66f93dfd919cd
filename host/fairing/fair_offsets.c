/* Fairing by the offsets of the table themselves (thesis 7.1-7.2). */
#include "fairing/box.h"
#include "fairing/discrepancy.h"
#include "fairing/fairing.h"
#include "fairing/kept.h"

#include <math.h>

/* Root mean square change over the variables whose half-breadth is given: what happens to a '?' cell
 * is no change of the data. */
static double rms_change(const batten_hull *smoothed, const fairing_box *box, const double *y)
{
	double sum = 0.0;
	size_t count = 0;
	for (size_t n = 0; n < hull_node_count(smoothed); n++)
		if (box->lower_m[n] < box->upper_m[n] && smoothed->nodes[n] == BATTEN_NODE_GIVEN) {
			sum += (y[n] - smoothed->y_m[n]) * (y[n] - smoothed->y_m[n]);
			count++;
		}
	return count > 0 ? sqrt(sum / (double)count) : 0.0;
}

/* Number of the search whose weight is taken. */
static size_t choose(const batten_fairing *fairing, const fairing_box *box, const double *y,
                     size_t count)
{
	const size_t nodes = hull_node_count(fairing->smoothed);
	double changes[DISCREPANCY_RATIOS];
	for (size_t i = 0; i < count; i++)
		changes[i] = rms_change(fairing->smoothed, box, y + i * nodes);
	return discrepancy_choose(count, changes, fairing->facts.noise_m);
}

static void take(batten_fairing *fairing, const fairing_box *box, const double *y)
{
	batten_hull *faired = fairing->faired;
	const size_t nodes = hull_node_count(faired);
	for (size_t n = 0; n < nodes; n++) {
		if (faired->nodes[n] == BATTEN_NODE_OUTSIDE)
			continue;
		faired->y_m[n] = y[n];
		if (box->lower_m[n] < box->upper_m[n] &&
		    (y[n] <= box->lower_m[n] || y[n] >= box->upper_m[n]))
			fairing->facts.at_limit_count++;
	}
	fairing->facts.variable_count = box->variable_count;
	fairing->facts.rms_change_m = rms_change(fairing->smoothed, box, y);
}

/* Of the search that is taken: what it is to keep, its certificate, its end. Objectives are those of the
 * problem as it was, without multipliers. */
static batten_status conclude(batten_fairing *fairing, const batten_fair_options *options,
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

static batten_status search(batten_fairing *fairing, const batten_fair_options *options,
                            const fairing_box *box)
{
	batten_context *context = fairing->context;
	const batten_hull *hull = fairing->smoothed;
	const size_t nodes = hull_node_count(hull);
	const size_t count = options->weights_given ? 1 : DISCREPANCY_RATIOS;
	batten_search_problem problems[DISCREPANCY_RATIOS];
	batten_search_result results[DISCREPANCY_RATIOS];
	batten_search_options chosen_search = options->search;
	chosen_search.fairness = options->fairness;
	for (size_t i = 0; i < count; i++)
		problems[i] = fairing_problem(hull, box, options->weights_given ? options->w1 : 1.0,
		                              options->weights_given ? options->w2 : discrepancy_ratio(i));
	double *y = batten_allocate(context, count, nodes * sizeof *y);
	if (!y)
		return BATTEN_MEMORY;
	const batten_grid grid = { hull->station_count, hull->waterline_count, hull->x_m, hull->z_m };
	batten_status status = batten_search_batch(context, &grid, count, problems, &chosen_search, y,
	                                           results, &fairing->run);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE) {
		const size_t chosen = options->weights_given ? 0 : choose(fairing, box, y, count);
		const batten_status concluded = conclude(fairing, options, box, &chosen_search,
		                                         problems[chosen], y + chosen * nodes,
		                                         &results[chosen]);
		if (concluded != BATTEN_OK)
			status = concluded;
		fairing->result = results[chosen];
		fairing->facts.w1 = problems[chosen].w1;
		fairing->facts.w2 = problems[chosen].w2;
		take(fairing, box, y + chosen * nodes);
	}
	batten_release(context, y);
	return status;
}

batten_status fair_offsets(batten_fairing *fairing, const batten_fair_options *options)
{
	fairing_box box = { 0 };
	batten_status status = fairing_box_create(fairing->context, fairing->smoothed, options,
	                                          fairing->locked, fairing->facts.max_distance_m, &box);
	if (status == BATTEN_OK)
		status = search(fairing, options, &box);
	fairing_box_release(fairing->context, &box);
	return status;
}
