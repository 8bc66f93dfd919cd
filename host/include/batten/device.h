/* batten.h, one part of it: the devices of the machine and the batches on them. */
#ifndef BATTEN_DEVICE_H
#define BATTEN_DEVICE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Devices
 * --------------------------------------------------------------------------------------------- */

#define BATTEN_DEVICE_AUTO (-1)      /* every device that equals the C path bit for bit, else C */
#define BATTEN_DEVICE_REFERENCE (-2) /* the plain C path */

typedef enum batten_precision { BATTEN_F64, BATTEN_F32 } batten_precision;

typedef struct batten_device {
	char name[128], platform[128], driver[64], version[64];
	bool is_cpu, has_f64, has_correct_f32; /* correctly rounded division and square root */
	unsigned compute_units;
	uint64_t global_memory_bytes, local_memory_bytes, max_allocation_bytes;
	unsigned max_work_group;
} batten_device;

/* Number of OpenCL devices; 0 without any OpenCL (never an error: *reason then says why, valid as
 * batten_context_error() is; reason may be NULL). */
BATTEN_API size_t batten_device_count(batten_context *context, const char **reason);

/* Errors: DEVICE (no such index). */
BATTEN_API batten_status batten_device_describe(batten_context *context, size_t index,
                                                batten_device *out);

typedef enum batten_selftest_result {
	BATTEN_SELFTEST_EQUAL,     /* bit for bit as the C path */
	BATTEN_SELFTEST_DIFFERENT, /* runs, with other last bits */
	BATTEN_SELFTEST_FAILED,    /* wrong, or does not build or run */
	BATTEN_SELFTEST_ABSENT,    /* the device has no such precision */
} batten_selftest_result;

typedef struct batten_selftest {
	char kernel[32];
	batten_precision precision;
	batten_selftest_result result;
	size_t compared,
		different; /* numbers compared with the C path, and how many differ in any bit */
	double build_s, run_s;
	char message[256]; /* one line when it failed */
} batten_selftest;

/* The name of a kernel, numbered from 0; NULL beyond the last. */
BATTEN_API const char *batten_device_kernel_name(size_t number);

/* Runs a kernel, or with NULL every one, on a small known problem against the C path. results is the caller's,
 * capacity entries long; *count gets the number of tests. Errors: DEVICE, MEMORY, USAGE (no such kernel). */
BATTEN_API batten_status batten_device_selftest(batten_context *context, size_t index,
                                                const char *kernel, batten_selftest *results,
                                                size_t capacity, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
