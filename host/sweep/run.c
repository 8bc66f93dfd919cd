/* batten_sweep_run: blocks of designs through the stages, and into the database while the next block is
 * computed. */
#include "sweep/stages.h"
#include "sweep/store.h"

#include <stdio.h>
#include <string.h>

enum { BLOCK_DEFAULT = 256, BLOCK_ON_DEVICE = 4096, BLOCK_MOST = 65536 };

void batten_sweep_options_default(batten_sweep_options *options)
{
	*options = (batten_sweep_options){
		.struct_size = sizeof *options, .device = BATTEN_DEVICE_AUTO, .shard = 1, .shard_count = 1
	};
}

/* Storing a block, in a thread of its own. */
struct writer {
	sweep_store *store;
	sweep_block *block; /* NULL: idle */
	pthread_t thread;
	bool in_thread;
	batten_status status;
	double seconds; /* spent in storing */
};

struct sweep {
	const sweep_plan *plan;
	batten_sweep_options options;
	sweep_machine machine;
	sweep_store store;
	sweep_block blocks[2]; /* one is computed while the other is stored */
	struct writer writer;
	batten_sweep_progress progress;
	double begun;
};

/* ---- storing beside computing ---- */

static void *write_block(void *argument)
{
	struct writer *writer = argument;
	const double begun = batten_wall_seconds();
	writer->status = sweep_store_write(writer->store, writer->block);
	writer->seconds += batten_wall_seconds() - begun;
	return NULL;
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

/* Waits until the block that is being stored is, and tells. */
static batten_status wait_for_writer(struct sweep *sweep)
{
	struct writer *writer = &sweep->writer;
	if (!writer->block)
		return BATTEN_OK;
	if (writer->in_thread)
		(void)pthread_join(writer->thread, NULL);
	if (writer->status == BATTEN_OK)
		count_block(sweep, writer->block);
	writer->block = NULL;
	batten_sweep_progress *progress = &sweep->progress;
	progress->store_s = writer->seconds;
	progress->seconds = batten_wall_seconds() - sweep->begun;
	(void)snprintf(progress->device, sizeof progress->device, "%s", sweep->machine.run.device);
	if (writer->status == BATTEN_OK && sweep->options.progress)
		sweep->options.progress(progress, sweep->options.user);
	return writer->status;
}

static batten_status hand_over(struct sweep *sweep, sweep_block *block)
{
	const batten_status status = wait_for_writer(sweep);
	if (status != BATTEN_OK)
		return status;
	struct writer *writer = &sweep->writer;
	writer->store = &sweep->store;
	writer->block = block;
	writer->in_thread = pthread_create(&writer->thread, NULL, write_block, writer) == 0;
	if (!writer->in_thread)
		(void)write_block(writer);
	return BATTEN_OK;
}

/* ---- computing ---- */

static batten_status timed(batten_status (*stage)(sweep_machine *, sweep_block *),
                           struct sweep *sweep, sweep_block *block, double *seconds)
{
	const double begun = batten_wall_seconds();
	const batten_status status = stage(&sweep->machine, block);
	*seconds += batten_wall_seconds() - begun;
	return status;
}

static batten_status compute(struct sweep *sweep, sweep_block *block)
{
	batten_sweep_progress *progress = &sweep->progress;
	batten_status status = timed(sweep_stage_vary, sweep, block, &progress->vary_s);
	if (status == BATTEN_OK && sweep->plan->fairs)
		status = timed(sweep_stage_fair, sweep, block, &progress->fair_s);
	if (status == BATTEN_OK)
		status = timed(sweep_stage_measure, sweep, block, &progress->measure_s);
	return status;
}

static bool is_stopped(const struct sweep *sweep)
{
	return sweep->options.stop && sweep->options.stop(sweep->options.user);
}

static batten_status run_blocks(struct sweep *sweep)
{
	const uint64_t end = sweep->store.shard.end;
	uint64_t next = sweep->store.next;
	batten_status status = BATTEN_OK;
	for (size_t b = 0; next < end && status == BATTEN_OK && !is_stopped(sweep); b = 1 - b) {
		sweep_block *block = &sweep->blocks[b];
		const uint64_t left = end - next;
		sweep_block_begin(block, next, left < block->capacity ? (size_t)left : block->capacity);
		status = compute(sweep, block);
		if (status == BATTEN_OK)
			status = hand_over(sweep, block);
		next += block->count;
	}
	/* What was computed before an error or a stop is stored all the same. */
	const batten_status stored = wait_for_writer(sweep);
	if (status == BATTEN_OK)
		status = stored;
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

/* Designs of a block: enough to fill what computes, few enough to show progress. */
static size_t choose_block(const struct sweep *sweep)
{
	batten_context *context = sweep->plan->context;
	const uint64_t designs = sweep->store.shard.end - sweep->store.shard.first;
	size_t block = sweep->options.block;
	if (block == 0) {
		const int index = sweep->options.device >= 0 ? sweep->options.device : 0;
		batten_device device;
		const bool on_device = sweep->options.device != BATTEN_DEVICE_REFERENCE &&
		                       batten_device_count(context, NULL) > (size_t)index &&
		                       batten_device_describe(context, (size_t)index, &device) ==
		                           BATTEN_OK &&
		                       !device.is_cpu;
		block = on_device ? BLOCK_ON_DEVICE : BLOCK_DEFAULT;
	}
	return block < designs ? block : designs > 0 ? (size_t)designs : 1;
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
	const store_run run = { .device = sweep->machine.run.device,
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
	const size_t block = choose_block(sweep);
	batten_status status = count_stored(sweep);
	for (size_t b = 0; b < 2 && status == BATTEN_OK; b++)
		status = sweep_block_create(sweep->plan, block, &sweep->blocks[b]);
	if (status == BATTEN_OK)
		status = run_blocks(sweep);
	if (status == BATTEN_OK)
		status = sweep_store_complete(&sweep->store);
	status = end_run(sweep, status);
	for (size_t b = 0; b < 2; b++)
		sweep_block_destroy(&sweep->blocks[b]);
	return status;
}

static batten_status run_plan(const sweep_plan *plan, const char *path,
                              const batten_sweep_options *options, batten_sweep_progress *out)
{
	struct sweep sweep = { .plan = plan,
		                   .options = *options,
		                   .begun = batten_wall_seconds(),
		                   .machine = { .context = plan->context, .device = options->device } };
	const sweep_shard shard = sweep_shard_of(plan->sampling.count, options->shard,
	                                         options->shard_count);
	const store_opening opening = { options->resume, options->journal };
	batten_status status = check_size(plan, options);
	if (status == BATTEN_OK)
		status = sweep_crew_create(plan->context, &sweep.machine.crew);
	if (status == BATTEN_OK)
		status = sweep_store_open(plan, &shard, path, &opening, &sweep.store);
	if (status == BATTEN_OK)
		status = run_opened(&sweep);
	sweep_store_close(&sweep.store);
	sweep_crew_destroy(&sweep.machine.crew);
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
