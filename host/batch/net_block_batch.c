#include "batch/net_block_batch.h"

#include "batch/net_block_engine.h"
#include "batch/net_block_reference.h"
#include "batch/search_result.h"
#include "batch/workers.h"

#include <pthread.h>

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	const net_plan *plan;
	pthread_mutex_t lock; /* of what follows */
	uint64_t lane_turns;
} batch;

static batten_status open_engine(batch_work *work, size_t index, const batten_device *device,
                                 batch_engine **out)
{
	return net_block_engine_open(((const batch *)work)->plan, index, device, out, NULL);
}

static size_t block_of(const batch_work *work, const batch_engine *engine)
{
	(void)work;
	return net_block_engine_block(engine);
}

static batten_status run_block(batch_work *work, batch_engine *engine, const size_t *which,
                               size_t count)
{
	batch *b = (batch *)work;
	uint64_t turns = 0;
	const batten_status status = net_block_engine_run(engine, b->plan, which, count, &turns);
	(void)pthread_mutex_lock(&b->lock);
	b->lane_turns += turns;
	(void)pthread_mutex_unlock(&b->lock);
	return status;
}

static batten_status run_on_reference(batch_work *work)
{
	net_block_reference reference = { 0 };
	batten_status status = net_block_reference_create(((const batch *)work)->plan, &reference);
	size_t which = 0;
	while (status == BATTEN_OK && work_queue_take(&work->queue, 1, &which) == 1)
		net_block_reference_run(&reference, which);
	net_block_reference_release(&reference);
	return status;
}

static double lane_use(const batch *b, const size_t *which, size_t count)
{
	uint64_t used = 0;
	for (size_t p = 0; p < count; p++)
		used += b->plan->results[which[p]].iterations;
	return search_lane_use(used, b->lane_turns);
}

batten_status net_block_batch_run(net_plan *plan, const size_t *which, size_t count,
                                  batten_run *run)
{
	batch b = { .work = { .context = plan->context,
		                  .device = plan->options.device,
		                  .open = open_engine,
		                  .block = block_of,
		                  .run = run_block,
		                  .run_reference = run_on_reference },
		        .plan = plan };
	if (pthread_mutex_init(&b.lock, NULL) != 0)
		return batten_fail(plan->context, BATTEN_MEMORY, "no memory for a lock");
	batten_status status = work_queue_create(plan->context, which, count, &b.work.queue);
	if (status == BATTEN_OK)
		status = batch_work_run(&b.work, run);
	if (status == BATTEN_OK)
		run->lane_use = lane_use(&b, which, count);
	work_queue_release(plan->context, &b.work.queue);
	(void)pthread_mutex_destroy(&b.lock);
	return status;
}
