#include "batch/workers.h"

#include <stdio.h>
#include <string.h>

/* Fewer items of a batch are not worth another hand. */
enum { HAND_ITEMS = 1024 };

static size_t hands_most(const batch_work *b)
{
	const size_t threads = b->context->options.threads;
	return threads < HANDS_MOST ? threads : HANDS_MOST;
}

/* One thread: a device, or (engine NULL) the C path. */
typedef struct worker {
	batch_work *batch;
	batch_engine *engine;
	pthread_t thread;
	bool started;
	batten_status status;
} worker;

/* A full launch, but no more than this worker's share of the batch: a small batch is split over the
 * devices too. */
static size_t block_size(const batch_work *b, const batch_engine *engine)
{
	const size_t lanes = engine->recipe.lanes;
	const size_t share = (b->queue.count + b->worker_count - 1) / b->worker_count;
	const size_t whole = (share + lanes - 1) / lanes * lanes;
	const size_t full = b->block(b, engine);
	return whole < full ? whole : full;
}

static batten_status run_on_device(batch_work *b, batch_engine *engine)
{
	const size_t most = block_size(b, engine);
	size_t *which = batten_allocate(b->context, most, sizeof *which);
	batten_status status = which ? BATTEN_OK : BATTEN_MEMORY;
	while (status == BATTEN_OK) {
		const size_t count = work_queue_take(&b->queue, most, which);
		if (count == 0)
			break;
		status = b->run(b, engine, which, count);
		if (status != BATTEN_OK)
			work_queue_give_back(&b->queue, which, count);
	}
	batten_release(b->context, which);
	return status;
}

static void *run_worker(void *argument)
{
	worker *w = argument;
	w->status = w->engine ? run_on_device(w->batch, w->engine) : w->batch->run_reference(w->batch);
	return NULL;
}

/* Runs the workers, the first of them in this thread. A thread that cannot be started leaves its
 * share to the others. */
static void run_workers(worker *workers, size_t count)
{
	for (size_t w = 1; w < count; w++)
		workers[w].started = pthread_create(&workers[w].thread, NULL, run_worker, &workers[w]) == 0;
	if (count > 0)
		(void)run_worker(&workers[0]);
	for (size_t w = 1; w < count; w++)
		if (workers[w].started)
			(void)pthread_join(workers[w].thread, NULL);
}

static void add_warning(batten_run *run, const char *text)
{
	const size_t used = strlen(run->warning);
	(void)snprintf(run->warning + used, sizeof run->warning - used, "%s%s", used ? "; " : "", text);
}

static void add_device(batten_run *run, const char *name)
{
	const size_t used = strlen(run->device);
	(void)snprintf(run->device + used, sizeof run->device - used, "%s%s", used ? " + " : "", name);
}

/* More threads for a device that is no CPU, as many as the batch and the threads allowed are enough for, and the
 * device has queues for. */
static void add_hands(const batch_work *b, batch_engine *engine, worker *workers, size_t *count)
{
	const size_t most = hands_most(b);
	for (size_t hand = 1; hand < most && hand < b->queue.count / HAND_ITEMS; hand++) {
		if (batch_engine_hand(engine, hand, &workers[*count].engine) != BATTEN_OK)
			return;
		++*count;
	}
}

static batten_status add_engine(batch_work *b, size_t index, worker *workers, size_t *count,
                                batten_run *run)
{
	batten_device device;
	batch_engine *engine = NULL;
	batten_status status = batten_device_describe(b->context, index, &device);
	if (status == BATTEN_OK)
		status = b->open(b, index, &device, &engine);
	if (status != BATTEN_OK)
		return status;
	workers[*count].engine = engine;
	++*count;
	add_device(run, device.name);
	run->strict = run->strict && batch_engine_is_strict(engine);
	if (!device.is_cpu)
		add_hands(b, engine, workers, count);
	return BATTEN_OK;
}

/* Every device that equals the C path bit for bit; one that does not is left out with a warning. */
static void add_strict_devices(batch_work *b, worker *workers, size_t *count, batten_run *run)
{
	const char *reason = NULL;
	const size_t devices = batten_device_count(b->context, &reason);
	if (devices == 0)
		add_warning(run, reason);
	for (size_t i = 0; i < devices; i++) {
		batten_run trial = { .strict = true };
		const size_t before = *count;
		const batten_status status = add_engine(b, i, workers, count, &trial);
		if (status != BATTEN_OK) {
			add_warning(run, batten_context_error(b->context));
		} else if (!trial.strict) {
			*count = before;
			char line[200];
			(void)snprintf(line, sizeof line,
			               "device %zu (%.100s) differs from the C path: not used", i,
			               trial.device);
			add_warning(run, line);
		} else {
			add_device(run, trial.device);
		}
	}
}

static void add_reference(batch_work *b, size_t items, worker *workers, size_t *count,
                          batten_run *run)
{
	size_t threads = b->context->options.threads;
	if (threads > items)
		threads = items ? items : 1;
	for (size_t t = 0; t < threads; t++) {
		workers[*count].engine = NULL;
		++*count;
	}
	add_device(run, "reference");
}

static batten_status choose_workers(batch_work *b, worker *workers, size_t *count, batten_run *run)
{
	const int device = b->device;
	if (device >= 0)
		return add_engine(b, (size_t)device, workers, count, run);
	if (device != BATTEN_DEVICE_AUTO && device != BATTEN_DEVICE_REFERENCE)
		return batten_fail(b->context, BATTEN_USAGE,
		                   "device %d: auto, reference or an index is expected", device);
	if (device == BATTEN_DEVICE_AUTO)
		add_strict_devices(b, workers, count, run);
	if (*count == 0)
		add_reference(b, b->queue.count, workers, count, run);
	return BATTEN_OK;
}

/* What devices gave back is finished by the C path when the choice was automatic. */
static batten_status finish(batch_work *b, worker *workers, size_t count, batten_run *run)
{
	batten_status first = BATTEN_OK;
	for (size_t w = 0; w < count; w++) {
		if (workers[w].status == BATTEN_OK)
			continue;
		/* A device short of memory is a device that failed; the host short of it is the end. */
		if (workers[w].status == BATTEN_MEMORY && !workers[w].engine)
			return BATTEN_MEMORY;
		first = workers[w].status;
	}
	if (first == BATTEN_OK)
		return BATTEN_OK;
	if (b->device >= 0)
		return first;
	add_warning(run, batten_context_error(b->context));
	/* A sound device may have finished what a failing one gave back before it ended. */
	if (b->queue.returned_count == 0 && b->queue.next == b->queue.count)
		return BATTEN_OK;
	add_device(run, "reference");
	worker last = { .batch = b };
	(void)run_worker(&last);
	return last.status;
}

static batten_status run_on(batch_work *work, worker *workers, batten_run *run)
{
	batten_status status = choose_workers(work, workers, &work->worker_count, run);
	if (status != BATTEN_OK)
		return status;
	const double begun = batten_wall_seconds();
	run_workers(workers, work->worker_count);
	status = finish(work, workers, work->worker_count, run);
	run->seconds = batten_wall_seconds() - begun;
	return status;
}

batten_status batch_work_run(batch_work *work, batten_run *run)
{
	/* As many as there may be: one a device, or one a thread of the C path. */
	const bool on_devices = work->device != BATTEN_DEVICE_REFERENCE;
	const size_t devices = on_devices ? batten_device_count(work->context, NULL) : 0;
	const size_t threads = work->context->options.threads;
	const size_t most = devices * HANDS_MOST > threads ? devices * HANDS_MOST : threads;
	worker *workers = batten_allocate(work->context, most, sizeof *workers);
	if (!workers)
		return BATTEN_MEMORY;
	for (size_t w = 0; w < most; w++)
		workers[w].batch = work;
	const batten_status status = run_on(work, workers, run);
	batten_release(work->context, workers);
	return status;
}

batten_status batch_work_run_all(batch_work *work, size_t count, batten_run *run)
{
	batten_run told = { .strict = true };
	size_t *order = batten_allocate(work->context, count, sizeof *order);
	if (!order)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < count; i++)
		order[i] = i;
	batten_status status = work_queue_create(work->context, order, count, &work->queue);
	if (status == BATTEN_OK && count > 0)
		status = batch_work_run(work, &told);
	work_queue_release(work->context, &work->queue);
	batten_release(work->context, order);
	if (status == BATTEN_OK && run)
		*run = told;
	return status;
}

void batch_run_add(batten_run *total, const batten_run *run)
{
	const batten_run before = *total;
	if (before.device[0] == '\0' || (before.warning[0] == '\0' && run->warning[0] != '\0'))
		*total = *run;
	total->strict = before.strict && run->strict;
	total->seconds = before.seconds + run->seconds;
	total->lane_use = total->seconds > 0.0
	                      ? (before.lane_use * before.seconds + run->lane_use * run->seconds) /
	                            total->seconds
	                      : run->lane_use;
}
