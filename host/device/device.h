/* OpenCL: the library opened at run time, its devices, programs with a cache of binaries, buffers and
 * launches. Nothing here knows what a kernel computes.
 *
 * Threads: device_count, device_describe and device_session_open are called from the thread of the
 * context. A session is then used by one thread at a time, any thread; it records its own error. */
#ifndef BATTEN_DEVICE_DEVICE_H
#define BATTEN_DEVICE_DEVICE_H

#include "core/context.h"

typedef struct device_system device_system;
typedef struct device_session device_session; /* one device: OpenCL context, in-order queue */
typedef struct device_program device_program;
typedef struct device_kernel device_kernel;
typedef struct device_buffer device_buffer;

/* Devices of all platforms; opens libOpenCL at the first call. 0 with a reason when there is none. */
size_t device_count(batten_context *context, const char **reason);
batten_status device_describe(batten_context *context, size_t index, batten_device *out);
void device_system_destroy(batten_context *context, device_system *system);

batten_status device_session_open(batten_context *context, size_t index, device_session **out);
/* A session of the same device for another thread, with a queue of its own, to be closed before the one it is
 * of: their kernels may run at the same time. */
batten_status device_session_branch(device_session *of, device_session **out);
void device_session_close(device_session *session);
/* The last failure of the session: one line that names the OpenCL call and its symbolic code. */
const char *device_session_error(const device_session *session);
const batten_device *device_session_device(const device_session *session);

/* Builds source with options, or loads the binary of an earlier build from the cache: the key hashes
 * source, options, device, driver and the version of batten. A binary that does not load is rebuilt.
 * from_cache and seconds may be NULL. Errors: KERNEL (the first line of the build log that names an
 * error), DEVICE, MEMORY. */
batten_status device_program_build(device_session *session, const char *name, const char *source,
                                   const char *options, device_program **out, bool *from_cache,
                                   double *seconds);
void device_program_destroy(device_program *program);

batten_status device_kernel_create(device_program *program, const char *name, device_kernel **out);
/* The same for a branch of the program's session. */
batten_status device_kernel_branch(device_session *session, device_program *program,
                                   const char *name, device_kernel **out);
void device_kernel_destroy(device_kernel *kernel);
/* Most work-items of a group this kernel can run with on its device. */
size_t device_kernel_group_limit(const device_kernel *kernel);

/* A buffer on the device; initial may be NULL (contents undefined), else size bytes are copied. A device that is no
 * CPU takes memory that a buffer of the session was destroyed with: there, new memory takes longer than a launch. */
batten_status device_buffer_create(device_session *session, size_t size, const void *initial,
                                   device_buffer **out);
/* A buffer that is the caller's own memory, which is to outlive it: kernels of a CPU write there with
 * no copy made. What they wrote may be read after device_buffers_settle(). */
batten_status device_buffer_wrap(device_session *session, size_t size, void *memory,
                                 device_buffer **out);
/* Waits, once for all of count >= 1 buffers of one session. */
batten_status device_buffers_settle(device_buffer *const *buffers, size_t count);
void device_buffer_destroy(device_buffer *buffer);
batten_status device_buffer_write(device_buffer *buffer, size_t size, const void *from);
batten_status device_buffer_read(device_buffer *buffer, size_t size, void *to); /* waits */

/* One argument of a kernel: a buffer, local memory of size bytes, or a plain value. */
typedef struct device_argument {
	device_buffer *buffer; /* or NULL */
	size_t size;           /* of local memory or of the value */
	const void *value;     /* NULL with buffer NULL: local memory */
} device_argument;

/* Sets the arguments and enqueues group_count groups of group_size work-items; does not wait. */
batten_status device_launch(device_session *session, device_kernel *kernel,
                            const device_argument *arguments, size_t argument_count,
                            size_t group_count, size_t group_size);
batten_status device_finish(device_session *session);

/* For tests: makes OpenCL call number n (1 first, counted from here, over all sessions of this
 * context's process) fail with CL_OUT_OF_RESOURCES; 0 ends it. Returns the calls counted so far. */
unsigned long device_fail_call(unsigned long n);

/* For tests: OpenCL objects the sessions of the context hold now. */
size_t device_live_objects(const batten_context *context);

#endif
