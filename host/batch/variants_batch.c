#include "batch/variants_batch.h"

#include "batch/variants_engine.h"
#include "batch/workers.h"
#include "reference/hull_variants.h"

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	const variants_plan *plan;
} batch;

static batten_status open_engine(batch_work *work, size_t index, const batten_device *device,
                                 batch_engine **out)
{
	return variants_engine_open(((const batch *)work)->plan, index, device, out, NULL);
}

static size_t block_of(const batch_work *work, const batch_engine *engine)
{
	return variants_engine_block(engine, ((const batch *)work)->plan);
}

static batten_status run_block(batch_work *work, batch_engine *engine, const size_t *which,
                               size_t count)
{
	return variants_engine_run(engine, ((const batch *)work)->plan, which, count);
}

void variants_reference_run(const variants_plan *plan, size_t which, double *room, double *y,
                            double *out)
{
	double asked[VARIANTS_ASK_COUNT];
	variants_pack(plan, which, 0, 1, asked, y);
	reference_hull_variants(plan->shape, plan->lists, plan->tables, asked, y, out, room);
	variants_unpack(plan, which, 0, 1, y, out);
}

static batten_status run_on_reference(batch_work *work)
{
	const variants_plan *plan = ((const batch *)work)->plan;
	const size_t nodes = variants_plan_nodes(plan), outcome = variants_plan_outcome(plan);
	double *room = batten_allocate(plan->context, variants_plan_room(plan, 1) + nodes + outcome,
	                               sizeof *room);
	if (!room)
		return BATTEN_MEMORY;
	double *y = room + variants_plan_room(plan, 1);
	size_t which = 0;
	while (work_queue_take(&work->queue, 1, &which) == 1)
		variants_reference_run(plan, which, room, y, y + nodes);
	batten_release(plan->context, room);
	return BATTEN_OK;
}

batten_status variants_batch_run(const variants_plan *plan, batten_run *run)
{
	batch b = { .work = { .context = plan->context,
		                  .device = plan->device,
		                  .open = open_engine,
		                  .block = block_of,
		                  .run = run_block,
		                  .run_reference = run_on_reference },
		        .plan = plan };
	return batch_work_run_all(&b.work, plan->count, run);
}
