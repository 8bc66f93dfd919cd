#include "batch/work_queue.h"

#include <string.h>

batten_status work_queue_create(batten_context *context, const size_t *order, size_t count,
                                work_queue *out)
{
	work_queue queue = { .order = order, .count = count };
	queue.returned = batten_allocate(context, count, sizeof *queue.returned);
	if (!queue.returned)
		return BATTEN_MEMORY;
	if (pthread_mutex_init(&queue.lock, NULL) != 0) {
		batten_release(context, queue.returned);
		return batten_fail_memory(context);
	}
	*out = queue;
	return BATTEN_OK;
}

void work_queue_release(batten_context *context, work_queue *queue)
{
	if (!queue->returned)
		return;
	(void)pthread_mutex_destroy(&queue->lock);
	batten_release(context, queue->returned);
	*queue = (work_queue){ 0 };
}

size_t work_queue_take(work_queue *queue, size_t most, size_t *taken)
{
	(void)pthread_mutex_lock(&queue->lock);
	size_t count = 0;
	while (count < most && queue->returned_count > 0)
		taken[count++] = queue->returned[--queue->returned_count];
	while (count < most && queue->next < queue->count)
		taken[count++] = queue->order[queue->next++];
	(void)pthread_mutex_unlock(&queue->lock);
	return count;
}

void work_queue_give_back(work_queue *queue, const size_t *taken, size_t count)
{
	(void)pthread_mutex_lock(&queue->lock);
	memcpy(queue->returned + queue->returned_count, taken, count * sizeof *taken);
	queue->returned_count += count;
	(void)pthread_mutex_unlock(&queue->lock);
}
