#include "batch/net_reference.h"

#include "batch/engine.h"
#include "reference/net_search.h"

batten_status net_reference_create(const net_plan *plan, net_reference *out)
{
	batten_context *context = plan->context;
	const size_t number = batch_engine_number_size(plan->options.precision);
	const size_t poles = net_plan_poles(plan);
	net_reference r = { .plan = plan };
	r.tables = batten_allocate(context, net_pack_table_count(plan), number);
	r.heights = batten_allocate(context, plan->directions.member_count + 1, number);
	r.samples = batten_allocate(context, net_pack_sample_count(plan), number);
	r.arrays = batten_allocate(context, poles, NET_ARRAY_COUNT * number);
	r.kept = batten_allocate(context, net_pack_kept_count(plan), number);
	r.scratch = batten_allocate(context, NET_STATE_NUMBERS(poles, plan->v.count, 1), number);
	r.rooms = batten_allocate(context, poles, sizeof *r.rooms);
	if (!r.tables || !r.heights || !r.samples || !r.arrays || !r.kept || !r.scratch || !r.rooms) {
		net_reference_release(&r);
		return BATTEN_MEMORY;
	}
	net_pack_tables(plan, r.tables);
	net_pack_heights(plan, r.heights);
	*out = r;
	return BATTEN_OK;
}

void net_reference_release(net_reference *reference)
{
	if (!reference->plan)
		return;
	batten_context *context = reference->plan->context;
	batten_release(context, reference->tables);
	batten_release(context, reference->heights);
	batten_release(context, reference->samples);
	batten_release(context, reference->arrays);
	batten_release(context, reference->kept);
	batten_release(context, reference->scratch);
	batten_release(context, reference->rooms);
	*reference = (net_reference){ 0 };
}

void net_reference_run(net_reference *reference, size_t which)
{
	const net_plan *plan = reference->plan;
	const net_directions *d = &plan->directions;
	int32_t shape[NET_SHAPE_SIZE];
	net_pack_shape(plan, shape);
	const reference_net_search shared = { .order_u = (int)plan->u.order,
		                                  .order_v = (int)plan->v.order,
		                                  .fairness = plan->fairness,
		                                  .shape = shape,
		                                  .first_u = plan->u.first,
		                                  .first_v = plan->v.first,
		                                  .colours = d->colours,
		                                  .directions = d->directions,
		                                  .members = d->members };
	union {
		double f64[NET_SETTING_COUNT];
		float f32[NET_SETTING_COUNT];
	} settings;
	union {
		double f64[SEARCH_OUTCOME_COUNT];
		float f32[SEARCH_OUTCOME_COUNT];
	} outcome;
	net_pack(plan, which, 0, 1, reference->samples, reference->arrays, &settings, reference->rooms);
	if (plan->options.precision == BATTEN_F64)
		reference_net_search_f64(&shared, reference->tables, reference->heights, reference->samples,
		                         reference->arrays, settings.f64, outcome.f64, reference->kept,
		                         reference->scratch);
	else
		reference_net_search_f32(&shared, reference->tables, reference->heights, reference->samples,
		                         reference->arrays, settings.f32, outcome.f32, reference->kept,
		                         reference->scratch);
	net_unpack(plan, which, 0, 1, reference->arrays, &outcome, reference->rooms);
}
