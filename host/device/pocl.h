/* PoCL, the OpenCL of processors: what its process must have before the first OpenCL call. */
#ifndef BATTEN_DEVICE_POCL_H
#define BATTEN_DEVICE_POCL_H

#include <stdbool.h>

/* Sets POCL_CACHE_DIR and POCL_MAX_PTHREAD_COUNT of the process where the user has not, or not to
 * something that works. False when no folder can be written: then OpenCL must not be started. One
 * caller at a time. */
bool device_pocl_prepare(unsigned threads);

/* Whether a platform of this name is PoCL. */
bool device_pocl_is(const char *platform);

/* Whether the system tells about its processors and memory; without it PoCL aborts the process. */
bool device_pocl_sees_machine(void);

/* Whether the linker that PoCL runs can be found. */
bool device_pocl_has_linker(void);

#endif
