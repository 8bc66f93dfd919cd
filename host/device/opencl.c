#include "device/opencl.h"

#include "device/device.h"

#include <dlfcn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The one mutable state of this file, and it is of the process on purpose: a test that wants call n to
 * fail cannot know which session, or thread, makes it. Zero outside tests. */
static atomic_ulong call_to_fail;
static atomic_ulong calls_counted;

unsigned long device_fail_call(unsigned long n)
{
	atomic_store(&call_to_fail, 0);
	unsigned long counted = atomic_exchange(&calls_counted, 0);
	atomic_store(&call_to_fail, n);
	return counted;
}

bool device_opencl_fails(void)
{
	unsigned long target = atomic_load_explicit(&call_to_fail, memory_order_relaxed);
	if (target == 0)
		return false;
	return atomic_fetch_add(&calls_counted, 1) + 1 == target;
}

static void *find_function(void *library, const char *name, char *reason, size_t size)
{
	void *address = dlsym(library, name);
	if (!address)
		(void)snprintf(reason, size, "the OpenCL library has no %s", name);
	return address;
}

static bool find_functions(device_opencl *opencl, char *reason, size_t size)
{
	/* ISO C has no conversion from dlsym's pointer to a function's; POSIX says the bytes agree. */
	void *address = NULL;
#define FIND_FUNCTION(name)                                                                        \
	address = find_function(opencl->library, "cl" #name, reason, size);                            \
	if (!address)                                                                                  \
		return false;                                                                              \
	memcpy(&opencl->name, &address, sizeof address);
	DEVICE_OPENCL_FUNCTIONS(FIND_FUNCTION)
#undef FIND_FUNCTION
	return true;
}

bool device_opencl_open(device_opencl *out, char *reason, size_t size)
{
	const char *name = getenv("BATTEN_OPENCL_LIBRARY");
	if (!name || name[0] == '\0')
		name = "libOpenCL.so.1";
	/* RTLD_NODELETE: drivers leave threads and exit handlers behind, so their code must stay. */
	device_opencl opencl = { .library = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE) };
	if (!opencl.library) {
		const char *cause = dlerror();
		(void)snprintf(reason, size, "the OpenCL library cannot be opened: %s",
		               cause ? cause : name);
		return false;
	}
	if (!find_functions(&opencl, reason, size)) {
		device_opencl_close(&opencl);
		return false;
	}
	*out = opencl;
	return true;
}

void device_opencl_close(device_opencl *opencl)
{
	if (opencl->library)
		(void)dlclose(opencl->library);
	*opencl = (device_opencl){ 0 };
}

#define DEVICE_OPENCL_CODES(X)                                                                     \
	X(CL_SUCCESS)                                                                                  \
	X(CL_DEVICE_NOT_FOUND)                                                                         \
	X(CL_DEVICE_NOT_AVAILABLE)                                                                     \
	X(CL_COMPILER_NOT_AVAILABLE)                                                                   \
	X(CL_MEM_OBJECT_ALLOCATION_FAILURE)                                                            \
	X(CL_OUT_OF_RESOURCES)                                                                         \
	X(CL_OUT_OF_HOST_MEMORY)                                                                       \
	X(CL_PROFILING_INFO_NOT_AVAILABLE)                                                             \
	X(CL_MEM_COPY_OVERLAP)                                                                         \
	X(CL_IMAGE_FORMAT_MISMATCH)                                                                    \
	X(CL_IMAGE_FORMAT_NOT_SUPPORTED)                                                               \
	X(CL_BUILD_PROGRAM_FAILURE)                                                                    \
	X(CL_MAP_FAILURE)                                                                              \
	X(CL_MISALIGNED_SUB_BUFFER_OFFSET)                                                             \
	X(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST)                                                \
	X(CL_COMPILE_PROGRAM_FAILURE)                                                                  \
	X(CL_LINKER_NOT_AVAILABLE)                                                                     \
	X(CL_LINK_PROGRAM_FAILURE)                                                                     \
	X(CL_DEVICE_PARTITION_FAILED)                                                                  \
	X(CL_KERNEL_ARG_INFO_NOT_AVAILABLE)                                                            \
	X(CL_INVALID_VALUE)                                                                            \
	X(CL_INVALID_DEVICE_TYPE)                                                                      \
	X(CL_INVALID_PLATFORM)                                                                         \
	X(CL_INVALID_DEVICE)                                                                           \
	X(CL_INVALID_CONTEXT)                                                                          \
	X(CL_INVALID_QUEUE_PROPERTIES)                                                                 \
	X(CL_INVALID_COMMAND_QUEUE)                                                                    \
	X(CL_INVALID_HOST_PTR)                                                                         \
	X(CL_INVALID_MEM_OBJECT)                                                                       \
	X(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR)                                                          \
	X(CL_INVALID_IMAGE_SIZE)                                                                       \
	X(CL_INVALID_SAMPLER)                                                                          \
	X(CL_INVALID_BINARY)                                                                           \
	X(CL_INVALID_BUILD_OPTIONS)                                                                    \
	X(CL_INVALID_PROGRAM)                                                                          \
	X(CL_INVALID_PROGRAM_EXECUTABLE)                                                               \
	X(CL_INVALID_KERNEL_NAME)                                                                      \
	X(CL_INVALID_KERNEL_DEFINITION)                                                                \
	X(CL_INVALID_KERNEL)                                                                           \
	X(CL_INVALID_ARG_INDEX)                                                                        \
	X(CL_INVALID_ARG_VALUE)                                                                        \
	X(CL_INVALID_ARG_SIZE)                                                                         \
	X(CL_INVALID_KERNEL_ARGS)                                                                      \
	X(CL_INVALID_WORK_DIMENSION)                                                                   \
	X(CL_INVALID_WORK_GROUP_SIZE)                                                                  \
	X(CL_INVALID_WORK_ITEM_SIZE)                                                                   \
	X(CL_INVALID_GLOBAL_OFFSET)                                                                    \
	X(CL_INVALID_EVENT_WAIT_LIST)                                                                  \
	X(CL_INVALID_EVENT)                                                                            \
	X(CL_INVALID_OPERATION)                                                                        \
	X(CL_INVALID_GL_OBJECT)                                                                        \
	X(CL_INVALID_BUFFER_SIZE)                                                                      \
	X(CL_INVALID_MIP_LEVEL)                                                                        \
	X(CL_INVALID_GLOBAL_WORK_SIZE)                                                                 \
	X(CL_INVALID_PROPERTY)                                                                         \
	X(CL_INVALID_IMAGE_DESCRIPTOR)                                                                 \
	X(CL_INVALID_COMPILER_OPTIONS)                                                                 \
	X(CL_INVALID_LINKER_OPTIONS)                                                                   \
	X(CL_INVALID_DEVICE_PARTITION_COUNT)                                                           \
	X(CL_PLATFORM_NOT_FOUND_KHR)

const char *device_opencl_name(cl_int code)
{
	switch (code) {
#define CODE_CASE(name)                                                                            \
	case name:                                                                                     \
		return #name;
		DEVICE_OPENCL_CODES(CODE_CASE)
#undef CODE_CASE
	default:
		return NULL;
	}
}

batten_status device_opencl_status(cl_int code)
{
	switch (code) {
	case CL_OUT_OF_HOST_MEMORY:
	case CL_MEM_OBJECT_ALLOCATION_FAILURE:
		return BATTEN_MEMORY;
	case CL_BUILD_PROGRAM_FAILURE:
	case CL_COMPILE_PROGRAM_FAILURE:
	case CL_LINK_PROGRAM_FAILURE:
	case CL_INVALID_BINARY:
	case CL_INVALID_BUILD_OPTIONS:
	case CL_INVALID_PROGRAM_EXECUTABLE:
	case CL_INVALID_KERNEL_NAME:
	case CL_INVALID_KERNEL_DEFINITION:
	case CL_INVALID_ARG_INDEX:
	case CL_INVALID_ARG_VALUE:
	case CL_INVALID_ARG_SIZE:
	case CL_INVALID_KERNEL_ARGS:
		return BATTEN_KERNEL;
	default:
		return BATTEN_DEVICE;
	}
}
