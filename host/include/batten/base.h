/* batten.h, one part of it: what every call has in common: status, version, context. */
#ifndef BATTEN_BASE_H
#define BATTEN_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define BATTEN_API __attribute__((visibility("default")))
#else
#define BATTEN_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Status
 * --------------------------------------------------------------------------------------------- */

/* Every status, its number and the exit code of the program that goes with it. */
#define BATTEN_STATUS_LIST(X)                                                                      \
	X(OK, 0, 0, "done")                                                                            \
	X(INCOMPLETE, 1, 1, "done, but some hulls failed or did not converge")                         \
	X(USAGE, 2, 2, "an argument is out of its range")                                              \
	X(INPUT, 3, 3, "the input is invalid")                                                         \
	X(DEVICE, 4, 4, "the device asked for is absent or lost")                                      \
	X(KERNEL, 5, 5, "a kernel did not build or failed its self-test")                              \
	X(IO, 6, 6, "input/output error")                                                              \
	X(MISSING, 7, 6, "a required package is missing")                                              \
	X(INTERNAL, 70, 70, "internal error")                                                          \
	X(MEMORY, 71, 70, "out of memory")                                                             \
	X(INTERRUPTED, 75, 75, "interrupted")

typedef enum batten_status {
#define BATTEN_STATUS_ENTRY(name, number, exit_code, text) BATTEN_##name = (number),
	BATTEN_STATUS_LIST(BATTEN_STATUS_ENTRY)
#undef BATTEN_STATUS_ENTRY
} batten_status;

/* One line of English for a status; never NULL. */
BATTEN_API const char *batten_status_text(batten_status status);

/* The exit code a program should end with for a status. */
BATTEN_API int batten_status_exit_code(batten_status status);

/* "MAJOR.MINOR.PATCH" of the library that is linked in. */
BATTEN_API const char *batten_version(void);

/* ------------------------------------------------------------------------------------------------
 * Context: allocator, log, last error, threads
 * --------------------------------------------------------------------------------------------- */

typedef struct batten_context batten_context;

typedef enum batten_log_level {
	BATTEN_LOG_ERROR,
	BATTEN_LOG_WARNING,
	BATTEN_LOG_INFORMATION,
} batten_log_level;

typedef struct batten_context_options {
	size_t struct_size; /* set by batten_context_options_default() */
	/* Memory; NULL takes malloc and free. allocate may return NULL. Called from any thread. */
	void *(*allocate)(size_t size, void *user);
	void (*release)(void *memory, void *user);
	void *allocate_user;
	/* Talk: called with one line without a newline; NULL is silent. */
	void (*log)(batten_log_level level, const char *line, void *user);
	void *log_user;
	/* Threads of the plain C path and of CPU devices; 0 takes the affinity mask of the process, or
	 * SLURM_CPUS_PER_TASK where that is set. Range 0..4096. */
	unsigned threads;
	/* Most bytes of one allocation on the host; larger ones fail, batches are cut to fit. 0 sets no
	 * limit. */
	size_t max_memory;
	/* Folder for compiled kernels; NULL takes $XDG_CACHE_HOME/batten or ~/.cache/batten. When it
	 * cannot be written, a private folder under $TMPDIR is used. */
	const char *cache_directory;
} batten_context_options;

BATTEN_API void batten_context_options_default(batten_context_options *options);

/* options may be NULL. Errors: USAGE, MEMORY. */
BATTEN_API batten_status batten_context_create(const batten_context_options *options,
                                               batten_context **out);
BATTEN_API void batten_context_destroy(batten_context *context);

/* The message of the last failure in this context: one line, "" before the first. Valid until the
 * next failure. */
BATTEN_API const char *batten_context_error(const batten_context *context);

#ifdef __cplusplus
}
#endif

#endif
