/* Who works through a batch: one thread a device, or the threads of the C path. A batch of whatever
 * kind says how an engine is opened and how a block of its items is run. */
#ifndef BATTEN_BATCH_WORKERS_H
#define BATTEN_BATCH_WORKERS_H

#include "batch/engine.h"
#include "batch/work_queue.h"

typedef struct batch_work {
	batten_context *context;
	int device;       /* as in the options of a batch */
	work_queue queue; /* of what is to be done */
	size_t worker_count;
	/* Makes the kernel ready on a device. */
	batten_status (*open)(struct batch_work *work, size_t index, const batten_device *device,
	                      batch_engine **out);
	/* Items a full launch has, a multiple of the lanes. */
	size_t (*block)(const struct batch_work *work, const batch_engine *engine);
	/* Runs the items whose numbers stand in which[0..count). */
	batten_status (*run)(struct batch_work *work, batch_engine *engine, const size_t *which,
	                     size_t count);
	/* Takes items from the queue and runs them on the C path until none is left. */
	batten_status (*run_reference)(struct batch_work *work);
} batch_work;

/* Works the queue off and tells what ran it. Errors: USAGE (no such device), DEVICE, KERNEL, MEMORY. */
batten_status batch_work_run(batch_work *work, batten_run *run);

/* The same over items 0 .. count - 1 in their order, with a queue of its own. run may be NULL, and is
 * written when all went well. Errors: as batch_work_run(). */
batten_status batch_work_run_all(batch_work *work, size_t count, batten_run *run);

/* Adds what ran a batch to what ran those before it: strict when all were, the first warning, seconds in
 * all, lanes of use by them. What is added to is zero but for strict at first. */
void batch_run_add(batten_run *total, const batten_run *run);

#endif
