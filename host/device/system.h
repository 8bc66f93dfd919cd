/* What the files of this room share: the system (library, list of devices, cache) and the session. */
#ifndef BATTEN_DEVICE_SYSTEM_H
#define BATTEN_DEVICE_SYSTEM_H

#include "device/cache.h"
#include "device/device.h"
#include "device/opencl.h"

#include <stdatomic.h>

typedef struct device_entry {
	cl_platform_id platform;
	cl_device_id id;
	batten_device facts;
} device_entry;

/* Constant once made, but for the cache (opened with the first session, by the context's thread) and
 * the count of objects. */
struct device_system {
	device_opencl opencl;
	device_entry *entries;
	size_t count;
	char reason[512]; /* why a device, or all, are left out; "" */
	device_cache cache;
	bool cache_is_open;
	atomic_size_t live; /* OpenCL objects not yet released */
};

enum { SPARES_MOST = 16 }; /* a launch has 14 buffers at most */

struct device_session {
	batten_context *context;
	device_system *system;
	const device_entry *entry;
	cl_context environment;
	bool borrowed; /* the environment is another session's */
	cl_command_queue queue;
	device_buffer *spares[SPARES_MOST]; /* let go, the newest last; not on a CPU */
	size_t spare_count;
	char error[512];
};

struct device_buffer {
	device_session *session;
	cl_mem memory;
	size_t size; /* as asked for */
	size_t room; /* of the memory; 0: the caller's own */
};

struct device_program {
	device_session *session;
	cl_program program;
	char *name;
};

struct device_kernel {
	device_session *session;
	cl_kernel kernel;
	char *name;
	size_t group_limit;
};

/* The system of the context, made at the first call; NULL when memory is out. */
device_system *device_system_of(batten_context *context);

/* Records the failure of an OpenCL call, "clFinish" or "clCreateBuffer of 80 bytes", in the session and
 * returns the status of its code; or a failure of our own with its status. */
batten_status device_session_fail_call(device_session *session, cl_int code, const char *format,
                                       ...) __attribute__((format(printf, 3, 4)));
batten_status device_session_fail(device_session *session, batten_status status, const char *format,
                                  ...) __attribute__((format(printf, 3, 4)));

/* Memory of the context that records its failure in the session. */
void *device_session_allocate(device_session *session, size_t count, size_t size);
char *device_session_copy_text(device_session *session, const char *text);

/* Releases the buffers kept to be taken again. */
void device_session_drop_spares(device_session *session);

/* True when the call made an object, which is then counted. */
bool device_object_made(device_system *system, cl_int *code, const void *object);
void device_object_released(device_system *system);

#endif
