#include "batch/net_block_reference.h"

#include "batch/engine.h"
#include "reference/net_block.h"

static bool allocate(net_block_reference *r)
{
	batten_context *context = r->plan->context;
	const size_t number = batch_engine_number_size(r->plan->options.precision);
	const size_t poles = net_plan_poles(r->plan);
	r->tables = batten_allocate(context, net_block_table_count(&r->shape), number);
	r->input = batten_allocate(context, poles, BLOCK_INPUT_COUNT * number);
	r->scratch = batten_allocate(context, net_block_state_numbers(&r->shape, true), number);
	r->followers = batten_allocate(context, r->shape.followers + 1, 2 * sizeof *r->followers);
	r->rooms = batten_allocate(context, poles, sizeof *r->rooms);
	return r->tables && r->input && r->scratch && r->followers && r->rooms;
}

batten_status net_block_reference_create(const net_plan *plan, net_block_reference *out)
{
	net_block_reference r = { .plan = plan };
	const batten_status status = net_block_shape_of(plan, &r.shape);
	if (status != BATTEN_OK)
		return status;
	if (!allocate(&r)) {
		net_block_reference_release(&r);
		return BATTEN_MEMORY;
	}
	net_block_pack_tables(plan, &r.shape, r.tables);
	net_block_pack_followers(plan, r.followers);
	*out = r;
	return BATTEN_OK;
}

void net_block_reference_release(net_block_reference *reference)
{
	if (!reference->plan)
		return;
	batten_context *context = reference->plan->context;
	batten_release(context, reference->tables);
	batten_release(context, reference->input);
	batten_release(context, reference->scratch);
	batten_release(context, reference->followers);
	batten_release(context, reference->rooms);
	*reference = (net_block_reference){ 0 };
}

void net_block_reference_run(net_block_reference *reference, size_t which)
{
	const net_plan *plan = reference->plan;
	const net_block_shape *shape = &reference->shape;
	int32_t numbers[NET_BLOCK_SHAPE_SIZE] = { 0 };
	net_block_pack_shape(plan, shape, true, numbers);
	const reference_net_block shared = { .order_u = (int)shape->u->order,
		                                 .order_v = (int)shape->v->order,
		                                 .points_u = (int)shape->u->points,
		                                 .points_v = (int)shape->v->points,
		                                 .fairness = plan->fairness,
		                                 .shape = numbers,
		                                 .first_u = shape->u->first,
		                                 .first_v = shape->v->first,
		                                 .follower = reference->followers };
	union {
		double f64[BLOCK_SETTING_COUNT];
		float f32[BLOCK_SETTING_COUNT];
	} settings;
	union {
		double f64[BLOCK_OUTCOME_COUNT];
		float f32[BLOCK_OUTCOME_COUNT];
	} outcome;
	net_block_pack(plan, which, reference->input, &settings, reference->rooms);
	if (plan->options.precision == BATTEN_F64)
		reference_net_block_f64(&shared, reference->tables, reference->input, settings.f64,
		                        outcome.f64, reference->scratch);
	else
		reference_net_block_f32(&shared, reference->tables, reference->input, settings.f32,
		                        outcome.f32, reference->scratch);
	net_block_unpack(plan, which, reference->input, &outcome);
}
