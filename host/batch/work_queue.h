/* The queue of a batch: workers take blocks of work from it and give back what they could not
 * finish. */
#ifndef BATTEN_BATCH_WORK_QUEUE_H
#define BATTEN_BATCH_WORK_QUEUE_H

#include "core/context.h"

#include <pthread.h>

typedef struct work_queue {
	pthread_mutex_t lock;
	const size_t *order; /* the searches, in the order they are handed out */
	size_t count, next;
	size_t *returned; /* given back by workers that failed; handed out first */
	size_t returned_count;
} work_queue;

/* order is borrowed. Errors: MEMORY. */
batten_status work_queue_create(batten_context *context, const size_t *order, size_t count,
                                work_queue *out);
void work_queue_release(batten_context *context, work_queue *queue);

/* Takes up to most searches into taken; 0 when none is left. */
size_t work_queue_take(work_queue *queue, size_t most, size_t *taken);
void work_queue_give_back(work_queue *queue, const size_t *taken, size_t count);

#endif
