#include "batch/pass_engine.h"

#include "batch/pass_launch.h"
#include "batch/pass_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>

/* Most bytes of half-breadths read by one launch: enough to hide it, in bounded memory. */
enum { BLOCK_BYTES = 64 << 20 };

static bool is_of_stretches(const pass_plan *plan)
{
	return plan->program->shape[PASS_SHAPE_STRETCHES] != 0;
}

static batten_status run_selftest(batch_engine *engine, const void *plan)
{
	return pass_selftest_run(engine, is_of_stretches(plan));
}

batten_status pass_engine_open(const pass_plan *plan, size_t index, const batten_device *device,
                               batch_engine **out, batten_selftest *result)
{
	const bool stretches = is_of_stretches(plan);
	batch_engine_recipe recipe = { .kernel = stretches ? "fairing_stretches" : "fairing_pass",
		                           .source = stretches ? kernel_source_fairing_stretches
		                                               : kernel_source_fairing_pass,
		                           .device = index,
		                           .precision = plan->precision,
		                           .lanes = plan->lanes,
		                           .work_group = plan->work_group };
	/* Two vectors of f64: what hulls share is loaded once, and neither waits for the other. */
	if (recipe.lanes == 0 && device->is_cpu && !stretches)
		recipe.lanes = 16;
	batch_engine_shape_choose(device, recipe.precision, &recipe.lanes, &recipe.work_group);
	(void)snprintf(recipe.options, sizeof recipe.options, "-DNUMBER_DOUBLE=%d",
	               pass_launch_in_doubles(device, recipe.precision));
	return batch_engine_open(plan->context, &recipe, run_selftest, plan, out, result);
}

size_t pass_engine_block(const batch_engine *engine, const pass_plan *plan)
{
	const size_t hull_bytes = (pass_plan_values(plan) + 1) * sizeof(double);
	const size_t limit = batch_engine_launch_bytes(engine, BLOCK_BYTES);
	const size_t together = is_of_stretches(plan) ? 1 : engine->recipe.lanes;
	const size_t groups = limit / hull_bytes / together;
	return (groups ? groups : 1) * together;
}

/* Hulls that lie side by side are run together: their half-breadths are one piece of the caller's
 * memory. */
batten_status pass_engine_run(batch_engine *engine, const pass_plan *plan, const size_t *which,
                              size_t count)
{
	batten_status status = BATTEN_OK;
	for (size_t begin = 0, end = 0; begin < count && status == BATTEN_OK; begin = end) {
		for (end = begin + 1; end < count && which[end] == which[end - 1] + 1;)
			end++;
		status = pass_launch_run(engine, plan, which[begin], end - begin);
	}
	return status;
}
