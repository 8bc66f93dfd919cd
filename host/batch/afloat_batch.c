#include "batch/afloat_batch.h"

#include "batch/afloat_engine.h"
#include "batch/workers.h"
#include "reference/surface_hydrostatics.h"

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	const afloat_plan *plan;
} batch;

static batten_status open_engine(batch_work *work, size_t index, const batten_device *device,
                                 batch_engine **out)
{
	return afloat_engine_open(((const batch *)work)->plan, index, device, out, NULL);
}

static size_t block_of(const batch_work *work, const batch_engine *engine)
{
	return afloat_engine_block(engine, ((const batch *)work)->plan);
}

static batten_status run_block(batch_work *work, batch_engine *engine, const size_t *which,
                               size_t count)
{
	return afloat_engine_run(engine, ((const batch *)work)->plan, which, count);
}

void afloat_reference_run(const afloat_plan *plan, size_t which, double *poles, double *out,
                          double *room)
{
	afloat_pack(plan, which, 0, 1, poles);
	reference_surface_hydrostatics(plan->shape, plan->lists, plan->tables, poles, out, room);
}

static batten_status run_on_reference(batch_work *work)
{
	const afloat_plan *plan = ((const batch *)work)->plan;
	const size_t net = afloat_plan_net(plan), outcome = afloat_plan_outcome(plan);
	double *poles = batten_allocate(plan->context, net + afloat_plan_room(plan, 1), sizeof *poles);
	if (!poles)
		return BATTEN_MEMORY;
	size_t which = 0;
	while (work_queue_take(&work->queue, 1, &which) == 1)
		afloat_reference_run(plan, which, poles, plan->out + which * outcome, poles + net);
	batten_release(plan->context, poles);
	return BATTEN_OK;
}

batten_status afloat_batch_run(const afloat_plan *plan, batten_run *run)
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
