#include "support/failing_heap.h"

#include "support/cases.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void *allocate(size_t size, void *user)
{
	failing_heap *heap = user;
	const size_t number = atomic_fetch_add(&heap->count, 1) + 1;
	if (number == heap->fail_at || (heap->fail_on && number > heap->fail_at))
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

static batten_status call_short(failing_heap *heap, batten_context *context, failing_heap_call call,
                                void *user)
{
	const size_t before = heap->live;
	heap->count = 0;
	const batten_status status = call(context, user);
	assert_int_equal(heap->live, before);
	assert_int_equal(status, heap->count >= heap->fail_at ? BATTEN_MEMORY : BATTEN_OK);
	if (status == BATTEN_MEMORY)
		assert_non_null(strstr(batten_context_error(context), "out of memory"));
	return status;
}

size_t failing_heap_each(failing_heap *heap, batten_context *context, failing_heap_call call,
                         void *user)
{
	for (heap->fail_at = 1; call_short(heap, context, call, user) != BATTEN_OK; heap->fail_at++) {
		heap->fail_on = true;
		if (heap->fail_at % CASES(1, 2) == 0)
			assert_int_equal(call_short(heap, context, call, user), BATTEN_MEMORY);
		heap->fail_on = false;
	}
	const size_t failed = heap->fail_at - 1;
	heap->fail_at = 0;
	return failed;
}

void failing_heap_close(failing_heap *heap, batten_context *context)
{
	batten_context_destroy(context);
	assert_int_equal(heap->live, 0);
}
