/* The OpenCL library, opened at run time: one table of its functions, the names of its codes, and the
 * hook by which a test makes any one call fail. */
#ifndef BATTEN_DEVICE_OPENCL_H
#define BATTEN_DEVICE_OPENCL_H

#include "batten.h"

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>
#include <CL/cl_ext.h>

/* Every function that is called, in the order of first use. */
#define DEVICE_OPENCL_FUNCTIONS(X)                                                                 \
	X(GetPlatformIDs)                                                                              \
	X(GetPlatformInfo)                                                                             \
	X(GetDeviceIDs)                                                                                \
	X(GetDeviceInfo)                                                                               \
	X(CreateContext)                                                                               \
	X(ReleaseContext)                                                                              \
	X(CreateCommandQueue)                                                                          \
	X(ReleaseCommandQueue)                                                                         \
	X(CreateProgramWithSource)                                                                     \
	X(CreateProgramWithBinary)                                                                     \
	X(BuildProgram)                                                                                \
	X(GetProgramInfo)                                                                              \
	X(GetProgramBuildInfo)                                                                         \
	X(ReleaseProgram)                                                                              \
	X(CreateKernel)                                                                                \
	X(GetKernelWorkGroupInfo)                                                                      \
	X(ReleaseKernel)                                                                               \
	X(CreateBuffer)                                                                                \
	X(ReleaseMemObject)                                                                            \
	X(EnqueueWriteBuffer)                                                                          \
	X(EnqueueReadBuffer)                                                                           \
	X(EnqueueMapBuffer)                                                                            \
	X(EnqueueUnmapMemObject)                                                                       \
	X(SetKernelArg)                                                                                \
	X(EnqueueNDRangeKernel)                                                                        \
	X(Flush)                                                                                       \
	X(Finish)

/* Constant once device_opencl_open() has filled it. */
typedef struct device_opencl {
	void *library;
#define DEVICE_OPENCL_FIELD(name) __typeof__(&cl##name) name;
	DEVICE_OPENCL_FUNCTIONS(DEVICE_OPENCL_FIELD)
#undef DEVICE_OPENCL_FIELD
} device_opencl;

/* Opens $BATTEN_OPENCL_LIBRARY, else libOpenCL.so.1. False with one line in reason[size]. */
bool device_opencl_open(device_opencl *out, char *reason, size_t size);
void device_opencl_close(device_opencl *opencl);

/* "CL_OUT_OF_RESOURCES"; NULL for a code that OpenCL 1.2 does not know. */
const char *device_opencl_name(cl_int code);
/* What a code of a failed call means to batten. */
batten_status device_opencl_status(cl_int code);

/* Counts a call where a test asked for it; true: this one is to fail. */
bool device_opencl_fails(void);

/* A call that returns its code, and one that returns an object and puts its code in *code. Calls that
 * release are made directly: they are neither counted nor failed. */
#define DEVICE_CALL(opencl, name, ...)                                                             \
	(device_opencl_fails() ? CL_OUT_OF_RESOURCES : (opencl)->name(__VA_ARGS__))
#define DEVICE_CREATE(opencl, code, name, ...)                                                     \
	(device_opencl_fails() ? (*(code) = CL_OUT_OF_RESOURCES, NULL)                                 \
	                       : (opencl)->name(__VA_ARGS__, (code)))

#endif
