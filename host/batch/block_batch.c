/* The block search: one queue of searches, one worker a device, or the C path's threads. */
#include "batch/block_engine.h"
#include "batch/block_reference.h"
#include "batch/search_batch.h"
#include "batch/search_result.h"

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	search_plan *plan;
	const search_call *call;
	pthread_mutex_t lock; /* of what follows */
	uint64_t lane_turns;
} batch;

static batten_status open_engine(batch_work *work, size_t index, const batten_device *device,
                                 batch_engine **out)
{
	return block_engine_open(((const batch *)work)->plan, index, device, out, NULL);
}

static size_t block_of(const batch_work *work, const batch_engine *engine)
{
	return block_engine_block(engine, ((const batch *)work)->plan);
}

static batten_status run_block(batch_work *work, batch_engine *engine, const size_t *which,
                               size_t count)
{
	batch *b = (batch *)work;
	uint64_t turns = 0;
	const batten_status status = block_engine_run(engine, b->plan, b->call->problems, which, count,
	                                              b->call->y_m, b->call->results, &turns);
	(void)pthread_mutex_lock(&b->lock);
	b->lane_turns += turns;
	(void)pthread_mutex_unlock(&b->lock);
	return status;
}

static batten_status run_on_reference(batch_work *work)
{
	const batch *b = (const batch *)work;
	const search_call *call = b->call;
	block_reference reference = { 0 };
	batten_status status = block_reference_create(b->plan, &reference);
	size_t which = 0;
	while (status == BATTEN_OK && work_queue_take(&work->queue, 1, &which) == 1)
		block_reference_run(&reference, &call->problems[which],
		                    call->y_m + which * b->plan->station_count * b->plan->waterline_count,
		                    &call->results[which]);
	block_reference_release(&reference);
	return status;
}

static double lane_use(const batch *b)
{
	uint64_t used = 0;
	for (size_t p = 0; p < b->call->count; p++)
		used += b->call->results[p].iterations;
	return search_lane_use(used, b->lane_turns);
}

batten_status block_batch_run(const search_call *call, batten_run *run)
{
	batch b = { .work = { .context = call->context,
		                  .device = call->options->device,
		                  .open = open_engine,
		                  .block = block_of,
		                  .run = run_block,
		                  .run_reference = run_on_reference },
		        .call = call };
	batten_status status = search_plan_create(call->context, call->grid, call->count,
	                                          call->problems, call->options, &b.plan);
	if (status != BATTEN_OK || call->count == 0) {
		search_plan_destroy(b.plan);
		return status;
	}
	if (pthread_mutex_init(&b.lock, NULL) != 0)
		status = batten_fail(call->context, BATTEN_MEMORY, "no memory for a lock");
	if (status == BATTEN_OK) {
		status = search_batch_work(call, b.plan, &b.work, run);
		(void)pthread_mutex_destroy(&b.lock);
	}
	if (status == BATTEN_OK)
		run->lane_use = lane_use(&b);
	search_plan_destroy(b.plan);
	return status;
}
