#include "batch/pass_batch.h"

#include "batch/pass_engine.h"
#include "batch/pass_reference.h"
#include "batch/workers.h"

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	const pass_plan *plan;
} batch;

static batten_status open_engine(batch_work *work, size_t index, const batten_device *device,
                                 batch_engine **out)
{
	return pass_engine_open(((const batch *)work)->plan, index, device, out, NULL);
}

static size_t block_of(const batch_work *work, const batch_engine *engine)
{
	return pass_engine_block(engine, ((const batch *)work)->plan);
}

static batten_status run_block(batch_work *work, batch_engine *engine, const size_t *which,
                               size_t count)
{
	return pass_engine_run(engine, ((const batch *)work)->plan, which, count);
}

static batten_status run_on_reference(batch_work *work)
{
	pass_reference reference = { 0 };
	batten_status status = pass_reference_create(((const batch *)work)->plan, &reference);
	size_t which = 0;
	while (status == BATTEN_OK && work_queue_take(&work->queue, 1, &which) == 1)
		pass_reference_run(&reference, which);
	pass_reference_release(&reference);
	return status;
}

batten_status pass_batch_run(const pass_plan *plan, batten_run *run)
{
	batch b = { .work = { .context = plan->context,
		                  .device = plan->device,
		                  .open = open_engine,
		                  .block = block_of,
		                  .run = run_block,
		                  .run_reference = run_on_reference },
		        .plan = plan };
	const batten_status status = pass_plan_check(plan);
	return status == BATTEN_OK ? batch_work_run_all(&b.work, plan->count, run) : status;
}
