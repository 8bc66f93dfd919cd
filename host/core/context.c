#include "core/context.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* What higher rooms keep in a context; declared here so that it can end without their headers. */
void device_system_destroy(batten_context *context, struct device_system *system);
void batch_engines_destroy(batten_context *context, struct batch_engine *first);

static void *allocate_from_heap(size_t size, void *user)
{
	(void)user;
	return malloc(size);
}

static void release_to_heap(void *memory, void *user)
{
	(void)user;
	free(memory);
}

const char *batten_status_text(batten_status status)
{
	switch (status) {
#define BATTEN_STATUS_CASE(name, number, exit_code, text)                                          \
	case BATTEN_##name:                                                                            \
		return text;
		BATTEN_STATUS_LIST(BATTEN_STATUS_CASE)
#undef BATTEN_STATUS_CASE
	}
	return "unknown status";
}

int batten_status_exit_code(batten_status status)
{
	switch (status) {
#define BATTEN_STATUS_CASE(name, number, exit_code, text)                                          \
	case BATTEN_##name:                                                                            \
		return exit_code;
		BATTEN_STATUS_LIST(BATTEN_STATUS_CASE)
#undef BATTEN_STATUS_CASE
	}
	return 70;
}

const char *batten_version(void)
{
	return BATTEN_VERSION;
}

/* Slurm gives a task fewer processors than the node has; the affinity mask alone misses that where
 * cgroups do not bind. */
static unsigned threads_of_machine(void)
{
	const char *slurm = getenv("SLURM_CPUS_PER_TASK");
	if (slurm) {
		long count = strtol(slurm, NULL, 10);
		if (count >= 1 && count <= 4096)
			return (unsigned)count;
	}
	cpu_set_t mask;
	if (sched_getaffinity(0, sizeof mask, &mask) == 0) {
		int count = CPU_COUNT(&mask);
		if (count >= 1)
			return (unsigned)count;
	}
	return 1;
}

void batten_context_options_default(batten_context_options *options)
{
	*options = (batten_context_options){ .struct_size = sizeof *options };
}

batten_status batten_context_create(const batten_context_options *options, batten_context **out)
{
	batten_context_options chosen;
	batten_context_options_default(&chosen);
	if (options) {
		if (options->struct_size != sizeof chosen || options->threads > 4096 ||
		    !options->allocate != !options->release)
			return BATTEN_USAGE;
		chosen = *options;
	}
	if (!chosen.allocate) {
		chosen.allocate = allocate_from_heap;
		chosen.release = release_to_heap;
	}
	if (chosen.threads == 0)
		chosen.threads = threads_of_machine();
	batten_context *context = chosen.allocate(sizeof *context, chosen.allocate_user);
	if (!context)
		return BATTEN_MEMORY;
	*context = (batten_context){ .options = chosen };
	if (pthread_mutex_init(&context->error_lock, NULL) != 0) {
		chosen.release(context, chosen.allocate_user);
		return BATTEN_MEMORY;
	}
	if (chosen.cache_directory) {
		context->cache_directory = batten_copy_text(context, chosen.cache_directory);
		if (!context->cache_directory) {
			batten_context_destroy(context);
			return BATTEN_MEMORY;
		}
	}
	context->options.cache_directory = context->cache_directory;
	*out = context;
	return BATTEN_OK;
}

void batten_context_destroy(batten_context *context)
{
	while (context) {
		batten_context *mate = context->mate;
		batch_engines_destroy(context, context->engines);
		device_system_destroy(context, context->devices);
		batten_release(context, context->cache_directory);
		(void)pthread_mutex_destroy(&context->error_lock);
		context->options.release(context, context->options.allocate_user);
		context = mate;
	}
}

batten_context *batten_context_mate(batten_context *context)
{
	batten_context_options options = context->options;
	options.log = NULL;
	if (!context->mate && batten_context_create(&options, &context->mate) != BATTEN_OK)
		(void)batten_fail_memory(context);
	return context->mate;
}

const char *batten_context_error(const batten_context *context)
{
	return context ? context->error : "no context";
}

void *batten_allocate(batten_context *context, size_t count, size_t size)
{
	size_t total = 0;
	bool fits = !__builtin_mul_overflow(count, size, &total) && total <= SIZE_MAX / 2;
	size_t limit = context->options.max_memory;
	if (fits && limit > 0 && total > limit) {
		(void)batten_fail(context, BATTEN_MEMORY, "%zu bytes are asked for, the limit is %zu",
		                  total, limit);
		return NULL;
	}
	/* The heap knows which of its pages are zero already. */
	const bool zeroed = context->options.allocate == allocate_from_heap;
	void *memory = NULL;
	if (fits && zeroed)
		memory = calloc(total ? total : 1, 1);
	else if (fits)
		memory = context->options.allocate(total ? total : 1, context->options.allocate_user);
	if (!memory) {
		(void)batten_fail(context, BATTEN_MEMORY, "out of memory: %zu times %zu bytes", count,
		                  size);
		return NULL;
	}
	if (!zeroed)
		memset(memory, 0, total ? total : 1);
	return memory;
}

void batten_release(batten_context *context, void *memory)
{
	if (memory)
		context->options.release(memory, context->options.allocate_user);
}

char *batten_copy_text(batten_context *context, const char *text)
{
	size_t length = strlen(text);
	char *copy = batten_allocate(context, length + 1, 1);
	if (copy)
		memcpy(copy, text, length);
	return copy;
}

batten_status batten_fail(batten_context *context, batten_status status, const char *format, ...)
{
	/* The arguments may point into the old message. */
	char line[sizeof context->error];
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(line, sizeof line, format, arguments);
	va_end(arguments);
	/* One line, whatever a file or a path contains. */
	for (char *c = line; *c; c++)
		if ((unsigned char)*c < 0x20 || *c == 0x7f)
			*c = '?';
	(void)pthread_mutex_lock(&context->error_lock);
	memcpy(context->error, line, sizeof line);
	(void)pthread_mutex_unlock(&context->error_lock);
	return status;
}

batten_status batten_fail_memory(batten_context *context)
{
	return batten_fail(context, BATTEN_MEMORY, "out of memory");
}

void batten_log(batten_context *context, batten_log_level level, const char *format, ...)
{
	if (!context->options.log)
		return;
	char line[1024];
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(line, sizeof line, format, arguments);
	va_end(arguments);
	context->options.log(level, line, context->options.log_user);
}

double batten_wall_seconds(void)
{
	struct timespec now = { 0 };
	(void)clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
