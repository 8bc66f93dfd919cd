/* The multilevel search, and the textbook's, which differs in its kernel: one queue of searches, one
 * worker a device, or the C path's threads. */
#include "batch/search_batch.h"
#include "batch/search_engine.h"
#include "batch/search_reference.h"
#include "batch/search_result.h"
#include "batch/workers.h"

typedef struct batch {
	batch_work work; /* first: the callbacks get it */
	search_plan *plan;
	const search_call *call;
} batch;

static batten_status open_engine(batch_work *work, size_t index, const batten_device *device,
                                 batch_engine **out)
{
	const batch *b = (const batch *)work;
	const search_shape shape = search_shape_choose(b->plan, index, device);
	search_engine *engine = NULL;
	const batten_status status = search_engine_open(work->context, &shape, &engine, NULL);
	if (status == BATTEN_OK)
		*out = search_engine_base(engine);
	return status;
}

static size_t block_of(const batch_work *work, const batch_engine *engine)
{
	return search_engine_block((const search_engine *)engine, ((const batch *)work)->plan);
}

static batten_status run_block(batch_work *work, batch_engine *engine, const size_t *which,
                               size_t count)
{
	const batch *b = (const batch *)work;
	return search_engine_run((search_engine *)engine, b->plan, b->call->problems, which, count,
	                         b->call->y_m, b->call->results);
}

static batten_status run_on_reference(batch_work *work)
{
	const batch *b = (const batch *)work;
	search_reference reference = { 0 };
	batten_status status = search_reference_create(b->plan, &reference);
	size_t which = 0;
	while (status == BATTEN_OK && work_queue_take(&work->queue, 1, &which) == 1)
		search_reference_run(&reference, b->call->problems, which,
		                     b->call->y_m +
		                         which * b->plan->station_count * b->plan->waterline_count,
		                     &b->call->results[which]);
	search_reference_release(&reference);
	return status;
}

/* Two probes a direction and iteration, and what the searches counted beyond, wide levels among it; the
 * textbook search counts all. */
static void count_probes(const batch *b)
{
	const int narrow = b->plan->level_count - search_plan_wide_levels(b->plan);
	for (size_t p = 0; p < b->call->count; p++)
		if (b->call->results[p].end != BATTEN_SEARCH_REFUSED)
			b->call->results[p].probes += 2 * (uint64_t)b->call->results[p].iterations *
			                              search_problem_directions(b->plan, &b->call->problems[p],
			                                                        0, narrow);
}

batten_status multilevel_batch_run(const search_call *call, batten_run *run)
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
	if (status == BATTEN_OK)
		b.plan->penalties = call->penalties;
	if (status == BATTEN_OK && call->count > 0)
		status = search_batch_work(call, b.plan, &b.work, run);
	if (status == BATTEN_OK && call->count > 0 &&
	    call->options->algorithm != BATTEN_ALGORITHM_TEXTBOOK)
		count_probes(&b);
	search_plan_destroy(b.plan);
	return status;
}
