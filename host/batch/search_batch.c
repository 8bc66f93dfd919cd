/* batten_search_batch: one queue of searches, one worker a device, or the C path's threads. */
#include "batch/search_engine.h"
#include "batch/search_queue.h"
#include "batch/search_reference.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct batch {
	batten_context *context;
	search_plan *plan;
	const batten_search_problem *problems;
	double *y_m;
	batten_search_result *results;
	search_queue queue;
	size_t worker_count;
} batch;

/* One thread: a device, or (engine NULL) the C path. */
typedef struct worker {
	batch *batch;
	search_engine *engine;
	pthread_t thread;
	bool started;
	batten_status status;
} worker;

static batten_status run_on_reference(batch *b)
{
	search_reference reference = { 0 };
	batten_status status = search_reference_create(b->plan, &reference);
	size_t which = 0;
	while (status == BATTEN_OK && search_queue_take(&b->queue, 1, &which) == 1)
		search_reference_run(&reference, &b->problems[which],
		                     b->y_m + which * b->plan->station_count * b->plan->waterline_count,
		                     &b->results[which]);
	search_reference_release(&reference);
	return status;
}

/* A full launch, but no more than this worker's share of the batch: a small batch is split over the
 * devices too. */
static size_t block_size(const batch *b, const search_engine *engine)
{
	const size_t lanes = search_engine_shape(engine)->lanes;
	const size_t share = (b->queue.count + b->worker_count - 1) / b->worker_count;
	const size_t whole = (share + lanes - 1) / lanes * lanes;
	const size_t full = search_engine_block(engine, b->plan);
	return whole < full ? whole : full;
}

static batten_status run_on_device(batch *b, search_engine *engine)
{
	const size_t most = block_size(b, engine);
	size_t *which = batten_allocate(b->context, most, sizeof *which);
	batten_status status = which ? BATTEN_OK : BATTEN_MEMORY;
	while (status == BATTEN_OK) {
		const size_t count = search_queue_take(&b->queue, most, which);
		if (count == 0)
			break;
		status = search_engine_run(engine, b->plan, b->problems, which, count, b->y_m, b->results);
		if (status != BATTEN_OK)
			search_queue_give_back(&b->queue, which, count);
	}
	batten_release(b->context, which);
	return status;
}

static void *work(void *argument)
{
	worker *w = argument;
	w->status = w->engine ? run_on_device(w->batch, w->engine) : run_on_reference(w->batch);
	return NULL;
}

/* Runs the workers, the first of them in this thread. A thread that cannot be started leaves its
 * share to the others. */
static void run_workers(worker *workers, size_t count)
{
	for (size_t w = 1; w < count; w++)
		workers[w].started = pthread_create(&workers[w].thread, NULL, work, &workers[w]) == 0;
	if (count > 0)
		(void)work(&workers[0]);
	for (size_t w = 1; w < count; w++)
		if (workers[w].started)
			(void)pthread_join(workers[w].thread, NULL);
}

static void add_warning(batten_search_run *run, const char *text)
{
	const size_t used = strlen(run->warning);
	(void)snprintf(run->warning + used, sizeof run->warning - used, "%s%s", used ? "; " : "", text);
}

static void add_device(batten_search_run *run, const char *name)
{
	const size_t used = strlen(run->device);
	(void)snprintf(run->device + used, sizeof run->device - used, "%s%s", used ? " + " : "", name);
}

static batten_status add_engine(batch *b, size_t index, worker *workers, size_t *count,
                                batten_search_run *run)
{
	batten_device device;
	search_engine *engine = NULL;
	batten_status status = batten_device_describe(b->context, index, &device);
	if (status != BATTEN_OK)
		return status;
	const search_shape shape = search_shape_choose(b->plan, index, &device);
	status = search_engine_open(b->context, &shape, &engine, NULL);
	if (status != BATTEN_OK)
		return status;
	workers[*count] = (worker){ .batch = b, .engine = engine };
	++*count;
	add_device(run, device.name);
	run->strict = run->strict && search_engine_is_strict(engine);
	return BATTEN_OK;
}

/* Every device that equals the C path bit for bit; one that does not is left out with a warning. */
static void add_strict_devices(batch *b, worker *workers, size_t *count, batten_search_run *run)
{
	const char *reason = NULL;
	const size_t devices = batten_device_count(b->context, &reason);
	if (devices == 0)
		add_warning(run, reason);
	for (size_t i = 0; i < devices; i++) {
		batten_search_run trial = { .strict = true };
		const batten_status status = add_engine(b, i, workers, count, &trial);
		if (status != BATTEN_OK) {
			add_warning(run, batten_context_error(b->context));
		} else if (!trial.strict) {
			--*count;
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

static void add_reference(batch *b, size_t searches, worker *workers, size_t *count,
                          batten_search_run *run)
{
	size_t threads = b->context->options.threads;
	if (threads > searches)
		threads = searches ? searches : 1;
	for (size_t t = 0; t < threads; t++) {
		workers[*count] = (worker){ .batch = b };
		++*count;
	}
	add_device(run, "reference");
}

static batten_status choose_workers(batch *b, worker *workers, size_t *count,
                                    batten_search_run *run)
{
	const int device = b->plan->options.device;
	if (device >= 0)
		return add_engine(b, (size_t)device, workers, count, run);
	if (device == BATTEN_DEVICE_AUTO)
		add_strict_devices(b, workers, count, run);
	if (*count == 0)
		add_reference(b, b->queue.count, workers, count, run);
	return BATTEN_OK;
}

/* What devices gave back is finished by the C path when the choice was automatic. */
static batten_status finish(batch *b, worker *workers, size_t count, batten_search_run *run)
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
	if (b->plan->options.device >= 0)
		return first;
	add_warning(run, batten_context_error(b->context));
	/* A sound device may have finished what a failing one gave back before it ended. */
	if (b->queue.returned_count == 0 && b->queue.next == b->queue.count)
		return BATTEN_OK;
	add_device(run, "reference");
	worker last = { .batch = b };
	(void)work(&last);
	return last.status;
}

static int compare_ratios(const void *left, const void *right, void *problems)
{
	const batten_search_problem *p = problems;
	const size_t a = *(const size_t *)left;
	const size_t b = *(const size_t *)right;
	/* w2/w1 without dividing: w1 may be 0. */
	const double ratio_a = p[a].w2 * p[b].w1;
	const double ratio_b = p[b].w2 * p[a].w1;
	if (ratio_a != ratio_b)
		return ratio_a < ratio_b ? -1 : 1;
	return a < b ? -1 : a > b;
}

/* The sound problems, those of like stiffness side by side: they end after about as many iterations,
 * so that few lanes run idle. */
static size_t order_problems(const batch *b, size_t count, size_t *order)
{
	size_t sound = 0;
	for (size_t p = 0; p < count; p++) {
		const char *fault = search_problem_fault(b->plan, &b->problems[p]);
		if (fault) {
			b->results[p] = (batten_search_result){ .end = BATTEN_SEARCH_REFUSED };
			(void)snprintf(b->results[p].message, sizeof b->results[p].message, "%s", fault);
		} else {
			order[sound++] = p;
		}
	}
	qsort_r(order, sound, sizeof *order, compare_ratios, (void *)b->problems);
	return sound;
}

/* Two probes a direction and iteration, and what the searches counted beyond. */
static batten_status count_probes(const batch *b, size_t count)
{
	uint8_t *scratch = batten_allocate(b->context, b->plan->station_count,
	                                   b->plan->waterline_count);
	if (!scratch)
		return BATTEN_MEMORY;
	for (size_t p = 0; p < count; p++)
		if (b->results[p].end != BATTEN_SEARCH_REFUSED)
			b->results[p].probes += 2 * (uint64_t)b->results[p].iterations *
			                        search_problem_directions(b->plan, &b->problems[p], scratch);
	batten_release(b->context, scratch);
	return BATTEN_OK;
}

static batten_status run_on_workers(batch *b, worker *workers, size_t count, batten_search_run *run)
{
	batten_status status = choose_workers(b, workers, &b->worker_count, run);
	if (status == BATTEN_OK) {
		const double begun = batten_wall_seconds();
		run_workers(workers, b->worker_count);
		status = finish(b, workers, b->worker_count, run);
		run->seconds = batten_wall_seconds() - begun;
	}
	if (status == BATTEN_OK)
		status = count_probes(b, count);
	return status;
}

static batten_status run_batch(batch *b, size_t count, batten_search_run *run)
{
	/* As many as there may be: one a device, or one a thread of the C path. */
	const bool on_devices = b->plan->options.device != BATTEN_DEVICE_REFERENCE;
	const size_t devices = on_devices ? batten_device_count(b->context, NULL) : 0;
	const size_t threads = b->context->options.threads;
	const size_t most = devices > threads ? devices : threads;
	worker *workers = batten_allocate(b->context, most, sizeof *workers);
	size_t *order = batten_allocate(b->context, count, sizeof *order);
	batten_status status = workers && order ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = search_queue_create(b->context, order, order_problems(b, count, order), &b->queue);
	if (status == BATTEN_OK)
		status = run_on_workers(b, workers, count, run);
	search_queue_release(b->context, &b->queue);
	batten_release(b->context, order);
	batten_release(b->context, workers);
	return status;
}

batten_status batten_search_batch(batten_context *context, const batten_grid *grid, size_t count,
                                  const batten_search_problem *problems,
                                  const batten_search_options *options, double *y_m,
                                  batten_search_result *results, batten_search_run *run)
{
	batch b = { .context = context, .problems = problems, .y_m = y_m, .results = results };
	batten_search_run told = { .strict = true };
	batten_status status = search_plan_create(context, grid, count, problems, options, &b.plan);
	if (status != BATTEN_OK)
		return status;
	if (count > 0)
		status = run_batch(&b, count, &told);
	search_plan_destroy(b.plan);
	if (status != BATTEN_OK)
		return status;
	if (run)
		*run = told;
	for (size_t p = 0; p < count; p++)
		if (results[p].end == BATTEN_SEARCH_REFUSED || results[p].end == BATTEN_SEARCH_LIMIT)
			return batten_fail(context, BATTEN_INCOMPLETE, "search %zu of %zu: %s%s%s", p, count,
			                   batten_search_end_text(results[p].end),
			                   results[p].message[0] ? ": " : "", results[p].message);
	return BATTEN_OK;
}

batten_status batten_device_selftest(batten_context *context, size_t index,
                                     batten_selftest *results, size_t capacity, size_t *count)
{
	batten_device device;
	const batten_status status = batten_device_describe(context, index, &device);
	if (status != BATTEN_OK)
		return status;
	static const batten_precision precisions[] = { BATTEN_F64, BATTEN_F32 };
	const double x[] = { 0.0, 1.0, 2.0 };
	const batten_grid grid = { 3, 3, x, x };
	*count = sizeof precisions / sizeof precisions[0];
	for (size_t t = 0; t < *count && t < capacity; t++) {
		batten_search_options options;
		batten_search_options_default(&options);
		options.precision = precisions[t];
		search_plan *plan = NULL;
		search_engine *engine = NULL;
		const batten_status made = search_plan_create(context, &grid, 0, NULL, &options, &plan);
		if (made != BATTEN_OK)
			return made;
		const search_shape shape = search_shape_choose(plan, index, &device);
		search_plan_destroy(plan);
		const batten_status opened = search_engine_open(context, &shape, &engine, &results[t]);
		if (opened == BATTEN_MEMORY)
			return opened;
	}
	return BATTEN_OK;
}
