/* Status, context, allocator, log: what every other room of host/ stands on. */
#ifndef BATTEN_CORE_CONTEXT_H
#define BATTEN_CORE_CONTEXT_H

#include "batten.h"

#include <pthread.h>
#include <stdarg.h>

struct device_system;
struct batch_engine;

struct batten_context {
	batten_context_options options; /* allocate, release and threads are always set */
	char *cache_directory;          /* owned copy, or NULL for the default */
	pthread_mutex_t error_lock;     /* workers fail in their own threads */
	char error[1024];
	struct device_system *devices; /* OpenCL, opened at first use; owned by host/device */
	struct batch_engine *engines;  /* kernels built so far; owned by host/batch */
	struct batten_context *mate;   /* see below; NULL before it is asked for */
};

/* A context with the same options, for another thread that computes meanwhile. It has its own error, devices
 * and kernels, which are made and tested once: it stays until the context ends. It does not log. Its mate is
 * one for a third thread. NULL: MEMORY. */
batten_context *batten_context_mate(batten_context *context);

/* Memory of the context, zeroed. NULL when count * size overflows, exceeds max_memory or memory is
 * out; the error is then set. count or size 0 gives a valid pointer. */
void *batten_allocate(batten_context *context, size_t count, size_t size);
void batten_release(batten_context *context, void *memory);
char *batten_copy_text(batten_context *context, const char *text);

/* Records one line as the last error and returns status. */
batten_status batten_fail(batten_context *context, batten_status status, const char *format, ...)
	__attribute__((format(printf, 3, 4)));
batten_status batten_fail_memory(batten_context *context);

void batten_log(batten_context *context, batten_log_level level, const char *format, ...)
	__attribute__((format(printf, 3, 4)));

/* Wall seconds since some fixed moment. */
double batten_wall_seconds(void);

#endif
