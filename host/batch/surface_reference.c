#include "batch/surface_reference.h"

#include "batch/engine.h"
#include "batch/surface_pack.h"
#include "reference/surface_grid.h"

batten_status surface_reference_create(const surface_plan *plan, surface_reference *out)
{
	batten_context *context = plan->context;
	const size_t number = batch_engine_number_size(plan->precision);
	surface_reference r = { .plan = plan };
	r.table_u = batten_allocate(context, 1, surface_pack_table_size(plan, &plan->u));
	r.table_v = batten_allocate(context, 1, surface_pack_table_size(plan, &plan->v));
	r.net = batten_allocate(context, surface_pack_net_count(plan), number);
	r.scratch = batten_allocate(context, plan->u.poles, 16 * number);
	r.out = batten_allocate(context, plan->v.count, surface_plan_line_size(plan) * number);
	if (!r.table_u || !r.table_v || !r.net || !r.scratch || !r.out) {
		surface_reference_release(&r);
		return BATTEN_MEMORY;
	}
	surface_pack_table(plan, &plan->u, r.table_u);
	surface_pack_table(plan, &plan->v, r.table_v);
	*out = r;
	return BATTEN_OK;
}

void surface_reference_release(surface_reference *reference)
{
	if (!reference->plan)
		return;
	batten_context *context = reference->plan->context;
	batten_release(context, reference->table_u);
	batten_release(context, reference->table_v);
	batten_release(context, reference->net);
	batten_release(context, reference->scratch);
	batten_release(context, reference->out);
	*reference = (surface_reference){ 0 };
}

void surface_reference_run(surface_reference *reference, size_t which)
{
	const surface_plan *plan = reference->plan;
	const reference_surface_grid shared = {
		.output = plan->output,
		.order_u = (int)plan->u.order,
		.order_v = (int)plan->v.order,
		.rational = plan->rational,
		.lines = (int)plan->v.count,
		.segments = (int)(plan->u.count / plan->segment_length),
		.segment_length = (int)plan->segment_length,
		.columns = (int)plan->u.poles,
		.column_length = (int)plan->v.poles,
		.first_v = plan->v.first,
		.first_u = plan->u.first,
		.light = { plan->light[0], plan->light[1], plan->light[2] },
	};
	double least_area = 0.0;
	float least_area_f32 = 0.0f;
	void *least = plan->precision == BATTEN_F64 ? (void *)&least_area : (void *)&least_area_f32;
	surface_pack_net(plan, &plan->items[which], 0, 1, reference->net, least);
	if (plan->precision == BATTEN_F64)
		reference_surface_grid_f64(&shared, reference->table_v, reference->table_u, reference->net,
		                           least_area, reference->out, reference->scratch);
	else
		reference_surface_grid_f32(&shared, reference->table_v, reference->table_u, reference->net,
		                           least_area_f32, reference->out, reference->scratch);
	const size_t line_bytes = surface_plan_line_size(plan) *
	                          batch_engine_number_size(plan->precision);
	for (size_t k = 0; k < plan->v.count; k++) {
		const char *line = (const char *)reference->out + k * line_bytes;
		if (SURFACE_SUMS(plan->output)) {
			surface_add_sums(plan, which, k, 0, 1, line);
		} else {
			surface_take_line(plan, which, k, line, plan->precision == BATTEN_F64, 1,
			                  surface_plan_values(plan));
			surface_mark_line(plan, which, k, true);
		}
	}
}
