#include "batch/net_batch.h"

#include "batch/net_block_batch.h"
#include "batch/net_engine.h"
#include "batch/net_reference.h"
#include "batch/search_result.h"
#include "batch/workers.h"

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	const net_plan *plan;
} batch;

static batten_status open_engine(batch_work *work, size_t index, const batten_device *device,
                                 batch_engine **out)
{
	return net_engine_open(((const batch *)work)->plan, index, device, out, NULL);
}

static size_t block_of(const batch_work *work, const batch_engine *engine)
{
	return net_engine_block(engine, ((const batch *)work)->plan);
}

static batten_status run_block(batch_work *work, batch_engine *engine, const size_t *which,
                               size_t count)
{
	return net_engine_run(engine, ((const batch *)work)->plan, which, count);
}

static batten_status run_on_reference(batch_work *work)
{
	net_reference reference = { 0 };
	batten_status status = net_reference_create(((const batch *)work)->plan, &reference);
	size_t which = 0;
	while (status == BATTEN_OK && work_queue_take(&work->queue, 1, &which) == 1)
		net_reference_run(&reference, which);
	net_reference_release(&reference);
	return status;
}

/* Any searches of the batch can be side by side. */
static batten_status run_by_block(net_plan *plan, search_weights *weights, size_t *order,
                                  batten_run *run)
{
	size_t sound = 0;
	for (size_t p = 0; p < plan->count; p++)
		if (!plan->items[p].fault)
			weights[sound++] = (search_weights){ plan->items[p].w1, plan->items[p].w2, p };
	if (sound == 0)
		return BATTEN_OK;
	search_order(weights, sound, order);
	return net_block_batch_run(plan, order, sound, run);
}

/* The searches of one stretch share their directions. */
static batten_status run_stretch(net_plan *plan, int stretch, search_weights *weights,
                                 size_t *order, batten_run *run)
{
	batch b = { .work = { .context = plan->context,
		                  .device = plan->options.device,
		                  .open = open_engine,
		                  .block = block_of,
		                  .run = run_block,
		                  .run_reference = run_on_reference },
		        .plan = plan };
	size_t sound = 0;
	for (size_t p = 0; p < plan->count; p++)
		if (!plan->items[p].fault && plan->items[p].stretch == stretch)
			weights[sound++] = (search_weights){ plan->items[p].w1, plan->items[p].w2, p };
	if (sound == 0)
		return BATTEN_OK;
	search_order(weights, sound, order);
	batten_run told = { .strict = true };
	batten_status status = net_directions_create(plan, stretch, &plan->directions);
	if (status == BATTEN_OK)
		status = work_queue_create(plan->context, order, sound, &b.work.queue);
	if (status == BATTEN_OK)
		status = batch_work_run(&b.work, &told);
	work_queue_release(plan->context, &b.work.queue);
	net_directions_release(plan->context, &plan->directions);
	told.seconds += run->seconds;
	*run = told;
	return status;
}

batten_status net_batch_run(net_plan *plan, batten_run *run)
{
	batten_context *context = plan->context;
	size_t *order = batten_allocate(context, plan->count, sizeof *order);
	search_weights *weights = batten_allocate(context, plan->count, sizeof *weights);
	batten_status status = order && weights ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t p = 0; p < plan->count; p++)
		if (plan->items[p].fault)
			plan->results[p] = search_result_refused(plan->items[p].fault);
	if (status == BATTEN_OK && plan->block)
		status = run_by_block(plan, weights, order, run);
	for (int stretch = -NET_STRETCH_MOST;
	     stretch <= NET_STRETCH_MOST && !plan->block && status == BATTEN_OK; stretch++)
		status = run_stretch(plan, stretch, weights, order, run);
	batten_release(context, order);
	batten_release(context, weights);
	return status;
}
