#include "batch/block_selftest.h"

#include "batch/block_engine.h"
#include "batch/block_reference.h"
#include "batch/search_selftest.h"

static batten_status run_block(void *engine, const search_plan *plan,
                               const batten_search_problem *problems, const size_t *which,
                               size_t count, double *y_m, batten_search_result *results)
{
	return block_engine_run(engine, plan, problems, which, count, y_m, results, NULL);
}

static batten_status run_known(const search_plan *plan, const batten_search_problem *problems,
                               size_t which, double *y_m, batten_search_result *result)
{
	block_reference reference = { 0 };
	const batten_status status = block_reference_create(plan, &reference);
	if (status == BATTEN_OK)
		block_reference_run(&reference, &problems[which], y_m, result);
	block_reference_release(&reference);
	return status;
}

batten_status block_selftest_run(batch_engine *engine, const search_plan *plan,
                                 batten_selftest *result)
{
	const search_selftest_sides sides = { engine, run_block, run_known };
	batten_search_options options;
	batten_search_options_default(&options);
	options.algorithm = BATTEN_ALGORITHM_BLOCK;
	options.precision = engine->recipe.precision;
	options.analytic_slopes = plan->options.analytic_slopes;
	return search_selftest_compare(engine->context, &sides, &options, engine->recipe.lanes, result);
}
