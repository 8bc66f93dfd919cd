/* batten_search_batch: which algorithm runs a batch. */
#include "batch/search_batch.h"

#include "batch/search_plan.h"
#include "batch/search_result.h"

/* Each algorithm's way to run a batch; NULL: this version lacks it. */
typedef batten_status search_algorithm_run(const search_call *call, batten_run *run);
static search_algorithm_run *const algorithms[] = {
	[BATTEN_ALGORITHM_TEXTBOOK] = multilevel_batch_run,
	[BATTEN_ALGORITHM_MULTILEVEL] = multilevel_batch_run,
	[BATTEN_ALGORITHM_BLOCK] = NULL,
};
enum { ALGORITHM_COUNT = sizeof algorithms / sizeof algorithms[0] };

/* What runs the batch; BATTEN_ALGORITHM_AUTO in the options is replaced by what it takes. */
static batten_status choose(batten_context *context, batten_search_options *options,
                            search_algorithm_run **run)
{
	if (options->algorithm == BATTEN_ALGORITHM_AUTO)
		options->algorithm = BATTEN_ALGORITHM_MULTILEVEL;
	*run = (size_t)options->algorithm < ALGORITHM_COUNT ? algorithms[options->algorithm] : NULL;
	if (!*run)
		return batten_fail(context, BATTEN_USAGE,
		                   "search algorithm %s: auto, multilevel or textbook is expected",
		                   batten_search_algorithm_text(options->algorithm));
	return BATTEN_OK;
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
		status = choose(context, &chosen, &algorithm);
	if (status != BATTEN_OK)
		return status;
	const search_call call = { context, grid, count, problems, &chosen, y_m, results };
	status = algorithm(&call, &told);
	if (status != BATTEN_OK)
		return status;
	for (size_t p = 0; p < count; p++)
		results[p].algorithm = chosen.algorithm;
	if (run)
		*run = told;
	return search_results_judge(context, count, results);
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
