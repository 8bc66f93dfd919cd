#include "batch/pass_plan.h"

#include <string.h>

batten_status pass_plan_check(const pass_plan *plan)
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

size_t pass_plan_values(const pass_plan *plan)
{
	return (size_t)plan->program->shape[PASS_SHAPE_VALUES];
}

size_t pass_plan_state(const pass_plan *plan, size_t work_items)
{
	const int32_t *shape = plan->program->shape;
	const int32_t room = PASS_FIT_ROOM(shape[PASS_SHAPE_FIT_ORDER], shape[PASS_SHAPE_VERTICES],
	                                   shape[PASS_SHAPE_FIT_POINTS]);
	const size_t state = (size_t)shape[PASS_SHAPE_STATE];
	if (shape[PASS_SHAPE_STRETCHES]) /* every state begins where a vector of any width may */
		return (state + 3 * (size_t)PASS_STRETCH - 1) / PASS_STRETCH * PASS_STRETCH;
	return state + work_items * (size_t)room;
}

/* A copy in the precision of the plan, with room for one number at least. */
static void *convert(const pass_plan *plan, size_t count, const double *from)
{
	const bool f64 = plan->precision == BATTEN_F64;
	void *to = batten_allocate(plan->context, count + 1, f64 ? sizeof(double) : sizeof(float));
	if (to && f64 && count > 0)
		memcpy(to, from, count * sizeof *from);
	for (size_t n = 0; to && !f64 && n < count; n++)
		((float *)to)[n] = (float)from[n];
	return to;
}

batten_status pass_tables_create(const pass_plan *plan, pass_tables *out)
{
	const pass_program_numbers *program = plan->program;
	*out = (pass_tables){ 0 };
	memcpy(out->shape, program->shape, sizeof out->shape);
	out->shape[PASS_SHAPE_ITERATIONS] = (int32_t)plan->iterations;
	out->term_factor = convert(plan, program->term_count, program->term_factor);
	out->point_along = convert(plan, program->point_count, program->point_along);
	out->constants = convert(plan, (size_t)program->shape[PASS_SHAPE_CONSTANTS],
	                         program->constants);
	if (out->term_factor && out->point_along && out->constants)
		return BATTEN_OK;
	pass_tables_release(plan, out);
	return BATTEN_MEMORY;
}

void pass_tables_release(const pass_plan *plan, pass_tables *tables)
{
	batten_release(plan->context, tables->term_factor);
	batten_release(plan->context, tables->point_along);
	batten_release(plan->context, tables->constants);
	*tables = (pass_tables){ 0 };
}
