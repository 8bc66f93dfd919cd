#include "batch/search_result.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static batten_search_end end_of(double moves, double step, double last_step)
{
	if (step > last_step)
		return BATTEN_SEARCH_LIMIT;
	return moves == 0.0 ? BATTEN_SEARCH_STATIONARY : BATTEN_SEARCH_CONVERGED;
}

batten_search_result search_result_of(const batten_search_options *options, double half_beam_m,
                                      const double values[SEARCH_OUTCOME_COUNT])
{
	const double last_step = options->last_step * half_beam_m;
	const double compared = options->precision == BATTEN_F64 ? last_step : (double)(float)last_step;
	batten_search_result result = {
		.end = end_of(values[SEARCH_OUTCOME_MOVES], values[SEARCH_OUTCOME_STEP], compared),
		.iterations = (unsigned)values[SEARCH_OUTCOME_ITERATIONS],
		.probes = ((uint64_t)values[SEARCH_OUTCOME_EXTRA_HIGH] << 20) +
		          (uint64_t)values[SEARCH_OUTCOME_EXTRA_LOW],
		.objective_start = values[SEARCH_OUTCOME_START],
		.objective_end = values[SEARCH_OUTCOME_END],
		.last_step_m = values[SEARCH_OUTCOME_STEP],
	};
	if (!isfinite(result.objective_start) || !isfinite(result.objective_end))
		result = search_result_refused("the objective is not finite");
	return result;
}

static batten_search_end block_end_of(const double values[BLOCK_OUTCOME_COUNT])
{
	if (values[BLOCK_OUTCOME_CONVERGED] == 0.0)
		return BATTEN_SEARCH_LIMIT;
	return values[BLOCK_OUTCOME_MOVES] == 0.0 ? BATTEN_SEARCH_STATIONARY : BATTEN_SEARCH_CONVERGED;
}

batten_search_result search_result_of_block(const double values[BLOCK_OUTCOME_COUNT],
                                            unsigned probes, size_t terms)
{
	const double worked = values[BLOCK_OUTCOME_ITERATIONS] * probes + values[BLOCK_OUTCOME_TRIALS];
	batten_search_result result = {
		.end = block_end_of(values),
		.iterations = (unsigned)values[BLOCK_OUTCOME_ITERATIONS],
		.probes = (uint64_t)worked * terms,
		.objective_start = values[BLOCK_OUTCOME_START],
		.objective_end = values[BLOCK_OUTCOME_END],
		.last_step_m = values[BLOCK_OUTCOME_STEP],
	};
	if (!isfinite(result.objective_start) || !isfinite(result.objective_end))
		result = search_result_refused("the objective is not finite");
	return result;
}

batten_search_result search_result_refused(const char *fault)
{
	batten_search_result result = { .end = BATTEN_SEARCH_REFUSED };
	(void)snprintf(result.message, sizeof result.message, "%s", fault);
	return result;
}

double search_lane_use(uint64_t iterations, uint64_t lane_turns)
{
	if (lane_turns == 0)
		return 1.0;
	return iterations > lane_turns ? 0.0 : (double)iterations / (double)lane_turns;
}

batten_status search_results_judge(batten_context *context, size_t count,
                                   const batten_search_result *results)
{
	for (size_t p = 0; p < count; p++)
		if (results[p].end == BATTEN_SEARCH_REFUSED || results[p].end == BATTEN_SEARCH_LIMIT)
			return batten_fail(context, BATTEN_INCOMPLETE, "search %zu of %zu: %s%s%s", p, count,
			                   batten_search_end_text(results[p].end),
			                   results[p].message[0] ? ": " : "", results[p].message);
	return BATTEN_OK;
}

double search_objective_whole(search_objective sum)
{
	return sum.fairness + sum.closeness;
}

batten_certificate search_objective_told(search_objective sum, double w1, double w2,
                                         double half_beam_m, bool varies)
{
	const double h2 = half_beam_m * half_beam_m;
	return (batten_certificate){
		.objective = search_objective_whole(sum),
		.fairness = w1 > 0.0 ? sum.fairness / (w1 * (varies ? h2 : 1.0)) : NAN,
		.closeness_m4 = w2 > 0.0 ? sum.closeness / w2 * (h2 * h2) : NAN,
		.gap_estimate = NAN,
	};
}

static int compare_ratios(const void *left, const void *right)
{
	const search_weights *a = left;
	const search_weights *b = right;
	/* w2/w1 without dividing: w1 may be 0. */
	const double ratio_a = a->w2 * b->w1;
	const double ratio_b = b->w2 * a->w1;
	if (ratio_a != ratio_b)
		return ratio_a < ratio_b ? -1 : 1;
	return a->which < b->which ? -1 : a->which > b->which;
}

void search_order(search_weights *weights, size_t count, size_t *order)
{
	qsort(weights, count, sizeof *weights, compare_ratios);
	for (size_t p = 0; p < count; p++)
		order[p] = weights[p].which;
}
