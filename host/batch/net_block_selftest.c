#include "batch/net_block_selftest.h"

#include "batch/net_block_engine.h"
#include "batch/net_block_reference.h"
#include "batch/net_selftest.h"

static batten_status run(batch_engine *engine, const net_plan *plan, const size_t *which,
                         size_t count)
{
	return net_block_engine_run(engine, plan, which, count, NULL);
}

static batten_status run_known(const net_plan *plan)
{
	net_block_reference reference = { 0 };
	const batten_status status = net_block_reference_create(plan, &reference);
	for (size_t p = 0; p < plan->count && status == BATTEN_OK; p++)
		net_block_reference_run(&reference, p);
	net_block_reference_release(&reference);
	return status;
}

batten_status net_block_selftest_run(batch_engine *engine, const net_plan *plan)
{
	static const net_selftest_sides sides = { run, run_known };
	/* The directions as the kernel was built for them. */
	net_block_shape shape;
	net_plan turned = *plan;
	const batten_status status = net_block_shape_of(plan, &shape);
	if (status != BATTEN_OK)
		return status;
	turned.u = *shape.u;
	turned.v = *shape.v;
	return net_selftest_compare(engine, &turned, &sides);
}
