#include "batch/surface_engine.h"

#include "batch/surface_launch.h"
#include "batch/surface_selftest.h"
#include "kernels/kernel_sources.h"

#include <stdio.h>

/* Most groups of lanes a run packs at a time. */
enum { BLOCK_GROUPS = 16 };

bool surface_engine_returns_doubles(const batten_device *device, const surface_plan *plan)
{
	return plan->precision == BATTEN_F64 || (!plan->floats && device->is_cpu && device->has_f64);
}

static batten_status run_selftest(batch_engine *engine, const void *plan)
{
	return surface_selftest_run(engine, plan);
}

batten_status surface_engine_open(const surface_plan *plan, size_t index,
                                  const batten_device *device, batch_engine **out,
                                  batten_selftest *result)
{
	batch_engine_recipe recipe = { .kernel = "surface_grid",
		                           .source = kernel_source_surface_grid,
		                           .device = index,
		                           .precision = plan->precision,
		                           .lanes = plan->lanes,
		                           .work_group = plan->work_group };
	batch_engine_shape_choose(device, recipe.precision, &recipe.lanes, &recipe.work_group);
	(void)snprintf(recipe.options, sizeof recipe.options,
	               "-DSURFACE_OUTPUT=%d -DORDER_U=%zu -DORDER_V=%zu -DRATIONAL=%d -DOUT_DOUBLE=%d",
	               plan->output, plan->u.order, plan->v.order, plan->rational,
	               surface_engine_returns_doubles(device, plan));
	return batch_engine_open(plan->context, &recipe, run_selftest, plan, out, result);
}

size_t surface_engine_block(const batch_engine *engine, const surface_plan *plan)
{
	(void)plan;
	return (size_t)BLOCK_GROUPS * engine->recipe.lanes;
}

/* Surfaces that lie side by side are run together: their values are one piece of the caller's
 * memory. */
batten_status surface_engine_run(batch_engine *engine, const surface_plan *plan,
                                 const size_t *which, size_t count)
{
	batten_status status = BATTEN_OK;
	for (size_t begin = 0, end = 0; begin < count && status == BATTEN_OK; begin = end) {
		for (end = begin + 1; end < count && which[end] == which[end - 1] + 1;)
			end++;
		status = surface_launch_run(engine, plan, which[begin], end - begin);
	}
	return status;
}
