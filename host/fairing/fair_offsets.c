/* Fairing by the offsets of the table themselves (thesis 7.1-7.2). */
#include "fairing/box.h"
#include "fairing/discrepancy.h"
#include "fairing/fairing.h"
#include "fairing/offset_space.h"

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
	batten_status status = offset_space_search(fairing, count, problems, &chosen_search, y,
	                                           results);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE) {
		const size_t chosen = options->weights_given ? 0 : choose(fairing, box, y, count);
		offset_space one = { fairing, box, &chosen_search, problems[chosen], NULL };
		const batten_status concluded = offset_space_conclude(&one, options, y + chosen * nodes,
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
