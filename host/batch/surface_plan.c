#include "batch/surface_plan.h"

batten_status surface_plan_check(const surface_plan *plan)
{
	if (plan->precision != BATTEN_F64 && plan->precision != BATTEN_F32)
		return batten_fail(plan->context, BATTEN_USAGE, "precision %d: f64 or f32 is expected",
		                   (int)plan->precision);
	if (plan->lanes > 16 || (plan->lanes & (plan->lanes - 1)) != 0 || plan->work_group > 1024)
		return batten_fail(
			plan->context, BATTEN_USAGE,
			"%u lanes in a work-group of %u: 1, 2, 4, 8 or 16 lanes and at most 1024 "
			"work-items are expected",
			plan->lanes, plan->work_group);
	return BATTEN_OK;
}

size_t surface_plan_values(const surface_plan *plan)
{
	switch (plan->output) {
	case SURFACE_OUTPUT_POSITION:
		return SURFACE_POSITION_COUNT;
	case SURFACE_OUTPUT_CURVATURE:
		return SURFACE_CURVATURE_COUNT;
	case SURFACE_OUTPUT_EVERYTHING:
		return SURFACE_EVERYTHING_COUNT;
	default:
		return SURFACE_SUM_COUNT;
	}
}

size_t surface_plan_line_size(const surface_plan *plan)
{
	const size_t samples = SURFACE_SUMS(plan->output) ? 1 : plan->u.count;
	return samples * surface_plan_values(plan);
}

size_t surface_plan_number(const surface_plan *plan)
{
	return plan->floats ? sizeof(float) : sizeof(double);
}

size_t surface_plan_dimension(const surface_plan *plan)
{
	return plan->rational ? 4 : 3;
}

size_t surface_plan_derivatives(const surface_plan *plan)
{
	return SURFACE_DERIVATIVES(plan->output);
}
