#include "batch/pass_reference.h"

#include "reference/fairing_pass.h"

#include <string.h>

batten_status pass_reference_create(const pass_plan *plan, pass_reference *out)
{
	pass_reference r = { .plan = plan };
	batten_status status = pass_tables_create(plan, &r.tables);
	if (status != BATTEN_OK)
		return status;
	r.state = batten_allocate(plan->context, pass_plan_state(plan, 1),
	                          plan->precision == BATTEN_F64 ? sizeof(double) : sizeof(float));
	if (!r.state) {
		pass_reference_release(&r);
		return BATTEN_MEMORY;
	}
	*out = r;
	return BATTEN_OK;
}

void pass_reference_release(pass_reference *reference)
{
	if (!reference->plan)
		return;
	pass_tables_release(reference->plan, &reference->tables);
	batten_release(reference->plan->context, reference->state);
	*reference = (pass_reference){ 0 };
}

void pass_reference_run(pass_reference *reference, size_t which)
{
	const pass_plan *plan = reference->plan;
	const pass_program_numbers *program = plan->program;
	const pass_tables *tables = &reference->tables;
	const reference_fairing_pass shared = {
		.shape = tables->shape,
		.operations = program->operations,
		.row_first = program->row_first,
		.row_target = program->row_target,
		.term_index = program->term_index,
		.line_first = program->line_first,
		.point_from = program->point_from,
		.point_to = program->point_to,
	};
	const size_t values = pass_plan_values(plan);
	const size_t constants = (size_t)program->shape[PASS_SHAPE_CONSTANTS];
	const double *y = plan->y_m + which * values;
	double *out = plan->out_m + which * values;
	const size_t begin = program->shape[PASS_SHAPE_STRETCHES] ? PASS_STRETCH : 0;
	if (plan->precision == BATTEN_F64) {
		double *state = (double *)reference->state + begin;
		memcpy(state, y, values * sizeof *state);
		memcpy(state + values, tables->constants, constants * sizeof *state);
		plan->refused[which] = !reference_fairing_pass_f64(&shared, tables->term_factor,
		                                                   tables->point_along, state);
		memcpy(out, state, values * sizeof *state);
		return;
	}
	float *state = (float *)reference->state + begin;
	for (size_t n = 0; n < values; n++)
		state[n] = (float)y[n];
	memcpy(state + values, tables->constants, constants * sizeof *state);
	plan->refused[which] = !reference_fairing_pass_f32(&shared, tables->term_factor,
	                                                   tables->point_along, state);
	for (size_t n = 0; n < values; n++)
		out[n] = (double)state[n];
}
