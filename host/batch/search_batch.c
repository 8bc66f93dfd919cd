/* batten_search_batch: which algorithm runs a batch. */
#include "batch/search_batch.h"

#include "batch/search_result.h"

/* Each algorithm's way to run a batch; NULL: this version lacks it. */
typedef batten_status search_algorithm_run(const search_call *call, batten_run *run);
static search_algorithm_run *const algorithms[] = {
	[BATTEN_ALGORITHM_TEXTBOOK] = multilevel_batch_run,
	[BATTEN_ALGORITHM_MULTILEVEL] = multilevel_batch_run,
	[BATTEN_ALGORITHM_BLOCK] = block_batch_run,
};
enum { ALGORITHM_COUNT = sizeof algorithms / sizeof algorithms[0] };

/* What runs the batch; BATTEN_ALGORITHM_AUTO in the options is replaced by what it takes. */
static batten_status choose(batten_context *context, batten_search_options *options,
                            search_algorithm_run **run)
{
	options->algorithm = search_options_algorithm(options);
	*run = (size_t)options->algorithm < ALGORITHM_COUNT ? algorithms[options->algorithm] : NULL;
	if (!*run)
		return batten_fail(context, BATTEN_USAGE,
		                   "search algorithm %s: auto, textbook, multilevel or block is expected",
		                   batten_search_algorithm_text(options->algorithm));
	if (options->algorithm == BATTEN_ALGORITHM_BLOCK && !search_options_plain(options))
		return batten_fail(
			context, BATTEN_USAGE,
			"the block search knows bending with weights 1 and 1, not %s with %g and %g: "
			"multilevel or auto is expected",
			batten_fairness_text(options->fairness), options->longitudinal_weight,
			options->transverse_weight);
	if (options->interior_penalty && options->algorithm != BATTEN_ALGORITHM_MULTILEVEL)
		return batten_fail(
			context, BATTEN_USAGE,
			"the %s search keeps the box by moves that end at it: multilevel or auto is "
			"expected with an interior penalty",
			batten_search_algorithm_text(options->algorithm));
	if (options->interior_penalty)
		*run = penalty_batch_run;
	return BATTEN_OK;
}

/* The sound problems in the order they are handed out. */
static size_t order_problems(const search_call *call, const search_plan *plan,
                             search_weights *weights, size_t *order)
{
	size_t sound = 0;
	for (size_t p = 0; p < call->count; p++) {
		const batten_search_problem *problem = &call->problems[p];
		const char *fault = search_problem_fault(plan, problem);
		if (fault)
			call->results[p] = search_result_refused(fault);
		else
			weights[sound++] = (search_weights){ problem->w1, problem->w2, p };
	}
	search_order(weights, sound, order);
	return sound;
}

batten_status search_batch_work(const search_call *call, const search_plan *plan, batch_work *work,
                                batten_run *run)
{
	batten_context *context = call->context;
	size_t *order = batten_allocate(context, call->count, sizeof *order);
	search_weights *weights = batten_allocate(context, call->count, sizeof *weights);
	batten_status status = order && weights ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		const size_t sound = order_problems(call, plan, weights, order);
		status = work_queue_create(context, order, sound, &work->queue);
	}
	if (status == BATTEN_OK)
		status = batch_work_run(work, run);
	work_queue_release(context, &work->queue);
	batten_release(context, weights);
	batten_release(context, order);
	return status;
}

batten_status batten_search_batch(batten_context *context, const batten_grid *grid, size_t count,
                                  const batten_search_problem *problems,
                                  const batten_search_options *options, double *y_m,
                                  batten_search_result *results, batten_run *run)
{
	batten_run told = { .strict = true };
	batten_search_options chosen;
	search_algorithm_run *algorithm = NULL;
	batten_status status = search_options_check(context, options, &chosen);
	if (status == BATTEN_OK)
		status = search_grid_check(context, grid);
	if (status == BATTEN_OK)
		status = choose(context, &chosen, &algorithm);
	if (status != BATTEN_OK)
		return status;
	const search_call call = { .context = context,
		                       .grid = grid,
		                       .count = count,
		                       .problems = problems,
		                       .options = &chosen,
		                       .y_m = y_m,
		                       .results = results };
	status = algorithm(&call, &told);
	if (status != BATTEN_OK)
		return status;
	for (size_t p = 0; p < count; p++)
		results[p].algorithm = chosen.algorithm;
	if (run)
		*run = told;
	return search_results_judge(context, count, results);
}

const char *batten_fairness_text(batten_fairness fairness)
{
	switch (fairness) {
	case BATTEN_FAIRNESS_BENDING:
		return "bending";
	case BATTEN_FAIRNESS_MEAN:
		return "mean";
	case BATTEN_FAIRNESS_GAUSS:
		return "gauss";
	case BATTEN_FAIRNESS_VARIATION:
		return "mvc";
	}
	return "unknown";
}

const char *batten_search_algorithm_text(batten_search_algorithm algorithm)
{
	switch (algorithm) {
	case BATTEN_ALGORITHM_AUTO:
		return "auto";
	case BATTEN_ALGORITHM_TEXTBOOK:
		return "textbook";
	case BATTEN_ALGORITHM_MULTILEVEL:
		return "multilevel";
	case BATTEN_ALGORITHM_BLOCK:
		return "block";
	}
	return "unknown";
}
