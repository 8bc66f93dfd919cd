/* Parts of a sweep on their way through the stages. Each worker takes a part through all of them with a
 * share of the threads and queues of its own on the devices, so that none waits for another; meanwhile
 * those that are done are stored. Parts come out in the order they went in. */
#ifndef BATTEN_SWEEP_PIPELINE_H
#define BATTEN_SWEEP_PIPELINE_H

#include "sweep/stages.h"

#include <pthread.h>

/* Beside the parts at work one is stored and one waits for the worker that is done first. */
enum { PIPELINE_WORKERS_MOST = 8, PIPELINE_PARTS_MOST = PIPELINE_WORKERS_MOST + 2 };

typedef enum pipeline_state { PART_FREE, PART_WAITS, PART_IN_WORK, PART_DONE } pipeline_state;

typedef struct pipeline_part {
	sweep_block block;
	pipeline_state state;
	batten_status status;
} pipeline_part;

/* Wall seconds of each stage, all workers together. */
typedef struct pipeline_seconds {
	double vary, fair, measure;
} pipeline_seconds;

typedef struct pipeline_worker {
	struct sweep_pipeline *pipeline;
	sweep_machine machine;
	pthread_t thread;
	bool started;
} pipeline_worker;

typedef struct sweep_pipeline {
	const sweep_plan *plan;
	size_t part_count, worker_count;
	pipeline_part parts[PIPELINE_PARTS_MOST];
	pipeline_worker workers[PIPELINE_WORKERS_MOST];
	pthread_mutex_t lock; /* of what follows and of the parts' states */
	pthread_cond_t changed;
	size_t oldest,
		next; /* running numbers of parts: the first that is not stored, the next to begin */
	bool ended;
	pipeline_seconds seconds;
	char device[sizeof((batten_run *)0)->device];
} sweep_pipeline;

typedef struct pipeline_shape {
	size_t workers; /* 1..PIPELINE_WORKERS_MOST */
	size_t designs; /* under way at a time, at most */
	bool in_turns;  /* one part alone, by all threads, but as large as it would be else */
} pipeline_shape;

/* The pipeline stays where it is made. Errors: MEMORY. */
batten_status sweep_pipeline_create(const sweep_plan *plan, int device, const pipeline_shape *shape,
                                    sweep_pipeline *pipeline);
void sweep_pipeline_destroy(sweep_pipeline *pipeline);

/* Designs of a part. */
size_t sweep_pipeline_part(const sweep_pipeline *pipeline);

/* Whether a part can begin, and whether one is under way. */
bool sweep_pipeline_has_room(const sweep_pipeline *pipeline);
bool sweep_pipeline_is_busy(const sweep_pipeline *pipeline);

/* Begins designs first to first + count - 1. */
void sweep_pipeline_begin(sweep_pipeline *pipeline, uint64_t first, size_t count);

/* Waits for the oldest part; its block stays until it is dropped. Errors: those of the stages. */
batten_status sweep_pipeline_wait(sweep_pipeline *pipeline, sweep_block **out);
void sweep_pipeline_drop(sweep_pipeline *pipeline);

#endif
