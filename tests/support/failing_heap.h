/* Memory that fails on demand: every allocation of a call fails once, and the call must say so, keep
 * nothing and crash nowhere. */
#ifndef BATTEN_TESTS_FAILING_HEAP_H
#define BATTEN_TESTS_FAILING_HEAP_H

#include "batten.h"

#include <stdatomic.h>
#include <stdbool.h>

typedef struct failing_heap {
	atomic_size_t live;  /* allocations not released */
	atomic_size_t count; /* allocations asked for since it was set to 0 */
	size_t fail_at;      /* the number of the one that fails, from 1; 0 for none */
	bool fail_on;        /* every one after it fails too */
} failing_heap;

/* A context on the heap, which must outlive it. */
batten_context *failing_heap_context(failing_heap *heap);

/* Calls until it succeeds, first with the first allocation failing, alone and then with all after it,
 * next with the second, and so on (sanitizers: every other with all after it). Each failure must be MEMORY, say so, and leave nothing alive; the
 * success must be the call that no allocation failed. Returns how many allocations failed. */
typedef batten_status (*failing_heap_call)(batten_context *context, void *user);
size_t failing_heap_each(failing_heap *heap, batten_context *context, failing_heap_call call,
                         void *user);

/* Destroys the context; nothing may be left. */
void failing_heap_close(failing_heap *heap, batten_context *context);

#endif
