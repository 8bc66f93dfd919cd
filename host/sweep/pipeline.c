#include "sweep/pipeline.h"

#include <string.h>

/* ---- a part through the stages ---- */

typedef batten_status stage(sweep_machine *machine, sweep_block *block);

static batten_status timed(stage *work, sweep_machine *machine, sweep_block *block, double *seconds)
{
	const double begun = batten_wall_seconds();
	const batten_status status = work(machine, block);
	*seconds += batten_wall_seconds() - begun;
	return status;
}

static batten_status compute(sweep_machine *machine, sweep_block *block, pipeline_seconds *spent)
{
	batten_status status = timed(sweep_stage_vary, machine, block, &spent->vary);
	if (status == BATTEN_OK && block->plan->fairs)
		status = timed(sweep_stage_fair, machine, block, &spent->fair);
	if (status == BATTEN_OK)
		status = timed(sweep_stage_measure, machine, block, &spent->measure);
	return status;
}

/* ---- workers ---- */

static pipeline_part *part_of(sweep_pipeline *pipeline, size_t number)
{
	return &pipeline->parts[number % pipeline->part_count];
}

/* The oldest part that waits, NULL when there is none. */
static pipeline_part *waiting_part(sweep_pipeline *pipeline)
{
	for (size_t n = pipeline->oldest; n < pipeline->next; n++)
		if (part_of(pipeline, n)->state == PART_WAITS)
			return part_of(pipeline, n);
	return NULL;
}

/* With the lock held, which is let go meanwhile. */
static void work_on(sweep_pipeline *pipeline, sweep_machine *machine, pipeline_part *part)
{
	pipeline_seconds spent = { 0 };
	part->state = PART_IN_WORK;
	(void)pthread_mutex_unlock(&pipeline->lock);
	part->status = compute(machine, &part->block, &spent);
	if (part->status != BATTEN_OK)
		(void)batten_fail(pipeline->plan->context, part->status, "%s",
		                  batten_context_error(machine->context));
	(void)pthread_mutex_lock(&pipeline->lock);
	part->state = PART_DONE;
	pipeline->seconds.vary += spent.vary;
	pipeline->seconds.fair += spent.fair;
	pipeline->seconds.measure += spent.measure;
	if (machine->run.device[0])
		memcpy(pipeline->device, machine->run.device, sizeof pipeline->device);
	(void)pthread_cond_broadcast(&pipeline->changed);
}

static void *run_worker(void *argument)
{
	pipeline_worker *worker = argument;
	sweep_pipeline *pipeline = worker->pipeline;
	(void)pthread_mutex_lock(&pipeline->lock);
	while (!pipeline->ended) {
		pipeline_part *part = waiting_part(pipeline);
		if (part)
			work_on(pipeline, &worker->machine, part);
		else
			(void)pthread_cond_wait(&pipeline->changed, &pipeline->lock);
	}
	(void)pthread_mutex_unlock(&pipeline->lock);
	return NULL;
}

/* ---- parts in and out ---- */

size_t sweep_pipeline_part(const sweep_pipeline *pipeline)
{
	return pipeline->parts[0].block.capacity;
}

bool sweep_pipeline_has_room(const sweep_pipeline *pipeline)
{
	return pipeline->next - pipeline->oldest < pipeline->part_count;
}

bool sweep_pipeline_is_busy(const sweep_pipeline *pipeline)
{
	return pipeline->next > pipeline->oldest;
}

void sweep_pipeline_begin(sweep_pipeline *pipeline, uint64_t first, size_t count)
{
	pipeline_part *part = part_of(pipeline, pipeline->next);
	sweep_block_begin(&part->block, first, count);
	(void)pthread_mutex_lock(&pipeline->lock);
	part->state = PART_WAITS;
	pipeline->next++;
	(void)pthread_cond_broadcast(&pipeline->changed);
	(void)pthread_mutex_unlock(&pipeline->lock);
}

batten_status sweep_pipeline_wait(sweep_pipeline *pipeline, sweep_block **out)
{
	pipeline_part *part = part_of(pipeline, pipeline->oldest);
	(void)pthread_mutex_lock(&pipeline->lock);
	/* Where no thread could be started, this one works. */
	if (!pipeline->workers[0].started && part->state == PART_WAITS)
		work_on(pipeline, &pipeline->workers[0].machine, part);
	while (part->state != PART_DONE)
		(void)pthread_cond_wait(&pipeline->changed, &pipeline->lock);
	(void)pthread_mutex_unlock(&pipeline->lock);
	*out = &part->block;
	return part->status;
}

void sweep_pipeline_drop(sweep_pipeline *pipeline)
{
	(void)pthread_mutex_lock(&pipeline->lock);
	part_of(pipeline, pipeline->oldest)->state = PART_FREE;
	pipeline->oldest++;
	(void)pthread_mutex_unlock(&pipeline->lock);
}

/* ---- before and after ---- */

/* Workers share the threads; the first devices of a process are those of all its threads. */
static batten_status create_workers(sweep_pipeline *pipeline, int device)
{
	batten_context *context = pipeline->plan->context;
	const unsigned threads = context->options.threads;
	const unsigned workers = (unsigned)pipeline->worker_count;
	batten_status status = BATTEN_OK;
	if (device != BATTEN_DEVICE_REFERENCE)
		(void)batten_device_count(context, NULL);
	for (unsigned w = 0; w < workers && status == BATTEN_OK; w++) {
		pipeline_worker *worker = &pipeline->workers[w];
		context = batten_context_mate(context);
		if (!context)
			return BATTEN_MEMORY;
		context->options.threads = threads / workers + (w < threads % workers);
		*worker = (pipeline_worker){ .pipeline = pipeline,
			                         .machine = { .context = context, .device = device } };
		status = sweep_crew_create(context, &worker->machine.crew);
	}
	for (size_t w = 0; w < pipeline->worker_count && status == BATTEN_OK; w++) {
		pipeline_worker *worker = &pipeline->workers[w];
		worker->started = pthread_create(&worker->thread, NULL, run_worker, worker) == 0;
	}
	return status;
}

batten_status sweep_pipeline_create(const sweep_plan *plan, int device, const pipeline_shape *shape,
                                    sweep_pipeline *pipeline)
{
	*pipeline = (sweep_pipeline){ .plan = plan };
	if (pthread_mutex_init(&pipeline->lock, NULL) != 0 ||
	    pthread_cond_init(&pipeline->changed, NULL) != 0)
		return batten_fail_memory(plan->context);
	const size_t parts = shape->designs < shape->workers + 2 ? shape->designs : shape->workers + 2;
	const size_t part = shape->designs / parts;
	pipeline->part_count = shape->in_turns ? 1 : parts;
	pipeline->worker_count = pipeline->part_count < shape->workers ? pipeline->part_count
	                                                               : shape->workers;
	batten_status status = BATTEN_OK;
	for (size_t p = 0; p < pipeline->part_count && status == BATTEN_OK; p++)
		status = sweep_block_create(plan, part, &pipeline->parts[p].block);
	if (status == BATTEN_OK)
		status = create_workers(pipeline, device);
	if (status != BATTEN_OK)
		sweep_pipeline_destroy(pipeline);
	return status;
}

void sweep_pipeline_destroy(sweep_pipeline *pipeline)
{
	if (!pipeline->plan)
		return;
	(void)pthread_mutex_lock(&pipeline->lock);
	pipeline->ended = true;
	(void)pthread_cond_broadcast(&pipeline->changed);
	(void)pthread_mutex_unlock(&pipeline->lock);
	for (size_t w = 0; w < pipeline->worker_count; w++)
		if (pipeline->workers[w].started)
			(void)pthread_join(pipeline->workers[w].thread, NULL);
	/* Hulls in the blocks are of the crews' memory. */
	for (size_t p = 0; p < pipeline->part_count; p++)
		sweep_block_destroy(&pipeline->parts[p].block);
	for (size_t w = 0; w < pipeline->worker_count; w++)
		sweep_machine_destroy(&pipeline->workers[w].machine);
	(void)pthread_cond_destroy(&pipeline->changed);
	(void)pthread_mutex_destroy(&pipeline->lock);
	*pipeline = (sweep_pipeline){ 0 };
}
