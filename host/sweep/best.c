#include "sweep/best.h"

#include <math.h>

batten_status sweep_best_create(batten_context *context, size_t capacity, sweep_best *out)
{
	sweep_best best = { .context = context, .capacity = capacity };
	best.heap = batten_allocate(context, capacity, sizeof *best.heap);
	if (!best.heap)
		return BATTEN_MEMORY;
	*out = best;
	return BATTEN_OK;
}

void sweep_best_release(sweep_best *best)
{
	if (best->heap)
		batten_release(best->context, best->heap);
	*best = (sweep_best){ 0 };
}

static bool is_worse(best_entry a, best_entry b)
{
	return a.key > b.key || (a.key == b.key && a.id > b.id);
}

static void swap(best_entry *a, best_entry *b)
{
	const best_entry kept = *a;
	*a = *b;
	*b = kept;
}

static void sift_up(best_entry *heap, size_t i)
{
	for (; i > 0 && is_worse(heap[i], heap[(i - 1) / 2]); i = (i - 1) / 2)
		swap(&heap[i], &heap[(i - 1) / 2]);
}

static void sift_down(best_entry *heap, size_t count)
{
	for (size_t i = 0; 2 * i + 1 < count;) {
		size_t child = 2 * i + 1;
		child += child + 1 < count && is_worse(heap[child + 1], heap[child]);
		if (!is_worse(heap[child], heap[i]))
			return;
		swap(&heap[i], &heap[child]);
		i = child;
	}
}

bool sweep_best_offer(sweep_best *best, best_entry entry, uint64_t *dropped)
{
	*dropped = UINT64_MAX;
	if (isnan(entry.key) || best->capacity == 0)
		return false;
	if (best->count < best->capacity) {
		best->heap[best->count] = entry;
		sift_up(best->heap, best->count++);
		return true;
	}
	if (!is_worse(best->heap[0], entry))
		return false;
	*dropped = best->heap[0].id;
	best->heap[0] = entry;
	sift_down(best->heap, best->count);
	return true;
}
