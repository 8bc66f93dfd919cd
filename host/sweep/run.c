/* batten_sweep_run: designs through the pipeline, and into the database while the next are computed. */
#include "sweep/pipeline.h"
#include "sweep/store.h"

#include <stdio.h>
#include <string.h>

/* Designs of a part, most of a block, and bytes of half-breadths that are worked at once: a design has
 * about this many arrays of them in its stages. */
enum {
	PART_DEFAULT = 512,
	PART_ON_DEVICE = 4096,
	BLOCK_MOST = 65536,
	BLOCK_BYTES = 256 << 20,
	ARRAYS_A_DESIGN = 24
};

void batten_sweep_options_default(batten_sweep_options *options)
{
	*options = (batten_sweep_options){
		.struct_size = sizeof *options, .device = BATTEN_DEVICE_AUTO, .shard = 1, .shard_count = 1
	};
}

struct sweep {
	const sweep_plan *plan;
	batten_sweep_options options;
	sweep_store store;
	sweep_pipeline pipeline;
	batten_sweep_progress progress;
	double begun;
};

/* ---- designs ---- */

static void tell(struct sweep *sweep)
{
	batten_sweep_progress *progress = &sweep->progress;
	sweep_pipeline *pipeline = &sweep->pipeline;
	progress->seconds = batten_wall_seconds() - sweep->begun;
	(void)pthread_mutex_lock(&pipeline->lock);
	progress->vary_s = pipeline->seconds.vary;
	progress->fair_s = pipeline->seconds.fair;
	progress->measure_s = pipeline->seconds.measure;
	memcpy(progress->device, pipeline->device, sizeof progress->device);
	(void)pthread_mutex_unlock(&pipeline->lock);
	if (sweep->options.progress)
		sweep->options.progress(progress, sweep->options.user);
}

static void count_block(struct sweep *sweep, const sweep_block *block)
{
	batten_sweep_progress *progress = &sweep->progress;
	for (size_t i = 0; i < block->count; i++) {
		const sweep_status status = block->designs[i].status;
		progress->not_converged += status == SWEEP_NOT_CONVERGED;
		progress->rejected += status == SWEEP_REJECTED;
		progress->failed += status == SWEEP_VARY_FAILED || status == SWEEP_FAIR_FAILED ||
		                    status == SWEEP_MEASURE_FAILED;
	}
	progress->stored += block->count;
}

/* Stores the oldest part that is under way. */
static batten_status store_oldest(struct sweep *sweep)
{
	sweep_block *block = NULL;
	batten_status status = sweep_pipeline_wait(&sweep->pipeline, &block);
	if (status != BATTEN_OK)
		return status;
	const double begun = batten_wall_seconds();
	status = sweep_store_write(&sweep->store, block);
	sweep->progress.store_s += batten_wall_seconds() - begun;
	if (status == BATTEN_OK) {
		count_block(sweep, block);
		tell(sweep);
	}
	sweep_pipeline_drop(&sweep->pipeline);
	return status;
}

static void begin_part(struct sweep *sweep)
{
	sweep_pipeline *pipeline = &sweep->pipeline;
	const size_t part = sweep_pipeline_part(pipeline);
	const uint64_t left = sweep->store.shard.end - sweep->progress.begun;
	const size_t count = left < part ? (size_t)left : part;
	const uint64_t first = sweep->progress.begun;
	/* Told before the work is begun: what a kill may lose is never more than was told. */
	sweep->progress.begun += count;
	tell(sweep);
	sweep_pipeline_begin(pipeline, first, count);
}

static bool is_stopped(const struct sweep *sweep)
{
	return sweep->options.stop && sweep->options.stop(sweep->options.user);
}

static batten_status run_parts(struct sweep *sweep)
{
	const uint64_t end = sweep->store.shard.end;
	batten_status status = BATTEN_OK;
	bool stopped = false;
	sweep->progress.begun = sweep->store.next;
	while (status == BATTEN_OK) {
		while (sweep_pipeline_has_room(&sweep->pipeline) && sweep->progress.begun < end &&
		       !(stopped = stopped || is_stopped(sweep)))
			begin_part(sweep);
		/* What is under way at a stop is stored all the same. */
		if (!sweep_pipeline_is_busy(&sweep->pipeline))
			break;
		status = store_oldest(sweep);
	}
	if (status == BATTEN_OK && sweep->store.next < end)
		status = batten_fail(sweep->plan->context, BATTEN_INTERRUPTED,
		                     "%s: stopped with %llu of %llu designs stored",
		                     sweep->store.database.path,
		                     (unsigned long long)(sweep->store.next - sweep->store.shard.first),
		                     (unsigned long long)(end - sweep->store.shard.first));
	return status;
}

/* ---- before and after ---- */

static batten_status check_options(batten_context *context, const batten_sweep_options *options)
{
	if (options->struct_size != sizeof *options)
		return batten_fail(context, BATTEN_USAGE,
		                   "sweep options: not filled by batten_sweep_options_default()");
	if (options->shard < 1 || options->shard > options->shard_count ||
	    options->shard_count > 1000000)
		return batten_fail(
			context, BATTEN_USAGE,
			"shard %llu of %llu: expected 1 to the number of shards, at most 1000000",
			(unsigned long long)options->shard, (unsigned long long)options->shard_count);
	if (options->block > BLOCK_MOST)
		return batten_fail(context, BATTEN_USAGE, "blocks of %zu designs, expected 1 to %d",
		                   options->block, BLOCK_MOST);
	return BATTEN_OK;
}

static batten_status check_size(const sweep_plan *plan, const batten_sweep_options *options)
{
	if (plan->sampling.count <= BATTEN_SWEEP_LARGE || options->large)
		return BATTEN_OK;
	return batten_fail(
		plan->context, BATTEN_USAGE,
		"the plan has %llu designs: if more than %u are meant, ask for them by --yes",
		(unsigned long long)plan->sampling.count, BATTEN_SWEEP_LARGE);
}

/* Whether what computes is no processor of the host. */
static bool is_on_device(const struct sweep *sweep)
{
	batten_context *context = sweep->plan->context;
	const int index = sweep->options.device >= 0 ? sweep->options.device : 0;
	batten_device device;
	return sweep->options.device != BATTEN_DEVICE_REFERENCE &&
	       batten_device_count(context, NULL) > (size_t)index &&
	       batten_device_describe(context, (size_t)index, &device) == BATTEN_OK && !device.is_cpu;
}

/* A worker a thread; two keep a device busy. Designs under way at a time: enough to fill what computes, few
 * enough to show progress. */
static pipeline_shape choose_shape(const struct sweep *sweep)
{
	const uint64_t designs = sweep->store.shard.end - sweep->store.shard.first;
	const size_t threads = sweep->plan->context->options.threads;
	const bool on_device = is_on_device(sweep);
	const size_t workers_most = on_device ? 2 : PIPELINE_WORKERS_MOST;
	pipeline_shape shape = { .in_turns = sweep->options.stages_take_turns };
	shape.workers = threads < workers_most ? threads : workers_most;
	size_t block = sweep->options.block;
	if (block == 0) {
		const size_t bytes = hull_node_count(sweep->plan->parent) * ARRAYS_A_DESIGN *
		                     sizeof(double);
		const size_t most = BLOCK_BYTES / bytes > 0 ? BLOCK_BYTES / bytes : 1;
		block = (shape.workers + 2) * (on_device ? PART_ON_DEVICE : PART_DEFAULT);
		block = block < most ? block : most;
	}
	shape.designs = block < designs ? block : designs > 0 ? (size_t)designs : 1;
	return shape;
}

/* What earlier runs stored, counted again. */
static batten_status count_stored(struct sweep *sweep)
{
	static const struct {
		const char *sql;
		size_t offset;
	} counts[] = {
		{ "SELECT count(*) FROM designs", offsetof(batten_sweep_progress, stored) },
		{ "SELECT count(*) FROM designs WHERE status = 'not_converged'",
		  offsetof(batten_sweep_progress, not_converged) },
		{ "SELECT count(*) FROM designs WHERE status = 'rejected'",
		  offsetof(batten_sweep_progress, rejected) },
		{ "SELECT count(*) FROM designs WHERE status LIKE '%failed'",
		  offsetof(batten_sweep_progress, failed) },
	};
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < sizeof counts / sizeof counts[0] && status == BATTEN_OK; i++) {
		int64_t count = 0;
		status = database_whole(&sweep->store.database, counts[i].sql, &count);
		const uint64_t value = (uint64_t)count;
		memcpy((char *)&sweep->progress + counts[i].offset, &value, sizeof value);
	}
	sweep->progress.first = sweep->store.shard.first;
	sweep->progress.end = sweep->store.shard.end;
	sweep->progress.stored_before = sweep->progress.stored;
	return status;
}

/* The row of the run; its own error counts only where there was none before. */
static batten_status end_run(struct sweep *sweep, batten_status status)
{
	sweep->progress.seconds = batten_wall_seconds() - sweep->begun;
	const store_run run = { .device = sweep->progress.device,
		                    .exit = batten_status_text(status),
		                    .threads = sweep->plan->context->options.threads,
		                    .seconds = sweep->progress.seconds,
		                    .designs_done = sweep->progress.stored -
		                                    sweep->progress.stored_before };
	if (status == BATTEN_OK)
		return sweep_store_end_run(&sweep->store, &run);
	if (status == BATTEN_INTERRUPTED) {
		char reason[256];
		(void)snprintf(reason, sizeof reason, "%s", batten_context_error(sweep->plan->context));
		if (sweep_store_end_run(&sweep->store, &run) != BATTEN_OK)
			return batten_fail(sweep->plan->context, status, "%s", reason);
	}
	return status;
}

static batten_status run_opened(struct sweep *sweep)
{
	batten_status status = count_stored(sweep);
	const pipeline_shape shape = choose_shape(sweep);
	if (status == BATTEN_OK)
		status = sweep_pipeline_create(sweep->plan, sweep->options.device, &shape,
		                               &sweep->pipeline);
	if (status == BATTEN_OK)
		status = run_parts(sweep);
	sweep_pipeline_destroy(&sweep->pipeline);
	if (status == BATTEN_OK)
		status = sweep_store_complete(&sweep->store);
	return end_run(sweep, status);
}

static batten_status run_plan(const sweep_plan *plan, const char *path,
                              const batten_sweep_options *options, batten_sweep_progress *out)
{
	struct sweep sweep = { .plan = plan, .options = *options, .begun = batten_wall_seconds() };
	const sweep_shard shard = sweep_shard_of(plan->sampling.count, options->shard,
	                                         options->shard_count);
	const store_opening opening = { options->resume, options->journal };
	batten_status status = check_size(plan, options);
	if (status == BATTEN_OK)
		status = sweep_store_open(plan, &shard, path, &opening, &sweep.store);
	if (status == BATTEN_OK)
		status = run_opened(&sweep);
	sweep_store_close(&sweep.store);
	*out = sweep.progress;
	return status;
}

batten_status batten_sweep_run(batten_context *context, const char *plan_path,
                               const char *database_path, const batten_sweep_options *options,
                               batten_sweep_progress *out)
{
	batten_sweep_options chosen;
	batten_sweep_options_default(&chosen);
	if (options)
		chosen = *options;
	sweep_plan *plan = NULL;
	batten_sweep_progress progress = { 0 };
	batten_status status = check_options(context, &chosen);
	if (status == BATTEN_OK)
		status = sweep_plan_read(context, plan_path, &plan);
	if (status == BATTEN_OK)
		status = run_plan(plan, database_path, &chosen, &progress);
	sweep_plan_destroy(plan);
	if (out && (status == BATTEN_OK || status == BATTEN_INTERRUPTED))
		*out = progress;
	if (status == BATTEN_OK && progress.failed + progress.not_converged > 0)
		return batten_fail(context, BATTEN_INCOMPLETE,
		                   "%llu designs failed and %llu did not converge: their rows say why",
		                   (unsigned long long)progress.failed,
		                   (unsigned long long)progress.not_converged);
	return status;
}
