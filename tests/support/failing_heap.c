#include "support/failing_heap.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void *allocate(size_t size, void *user)
{
	failing_heap *heap = user;
	if (atomic_fetch_add(&heap->count, 1) + 1 == heap->fail_at)
		return NULL;
	void *memory = malloc(size);
	if (memory)
		atomic_fetch_add(&heap->live, 1);
	return memory;
}

static void release(void *memory, void *user)
{
	failing_heap *heap = user;
	if (memory)
		atomic_fetch_sub(&heap->live, 1);
	free(memory);
}

batten_context *failing_heap_context(failing_heap *heap)
{
	batten_context_options options;
	batten_context_options_default(&options);
	options.allocate = allocate;
	options.release = release;
	options.allocate_user = heap;
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(&options, &context), BATTEN_OK);
	return context;
}

size_t failing_heap_each(failing_heap *heap, batten_context *context, failing_heap_call call,
                         void *user)
{
	const size_t before = heap->live;
	size_t failed = 0;
	for (;; failed++) {
		heap->count = 0;
		heap->fail_at = failed + 1;
		const batten_status status = call(context, user);
		heap->fail_at = 0;
		assert_int_equal(heap->live, before);
		if (status == BATTEN_OK)
			return failed;
		assert_int_equal(status, BATTEN_MEMORY);
		assert_non_null(strstr(batten_context_error(context), "out of memory"));
	}
}

void failing_heap_close(failing_heap *heap, batten_context *context)
{
	batten_context_destroy(context);
	assert_int_equal(heap->live, 0);
}
