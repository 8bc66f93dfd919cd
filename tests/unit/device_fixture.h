/* What the tests of the OpenCL layer share: a kernel with a known result, a context, a folder. */
#ifndef BATTEN_TESTS_DEVICE_FIXTURE_H
#define BATTEN_TESTS_DEVICE_FIXTURE_H

#include "device/device.h"
#include "device/folder.h"
#include "device/system.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { COUNT = 1000, GROUP = 8 };

/* Local memory as an argument, plain values, and a sum of products that a contracted multiply-add
 * would change. */
static const char source[] =
	"#pragma OPENCL FP_CONTRACT OFF\n"
	"#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n"
	"__kernel void add(__global const double *a, __global const double *b, __global double *c,\n"
	"                  __local double *row, double factor, uint count)\n"
	"{\n"
	"	size_t i = get_global_id(0);\n"
	"	size_t last = get_local_size(0) - 1;\n"
	"	row[get_local_id(0)] = i < count ? a[i] : 0.0;\n"
	"	barrier(CLK_LOCAL_MEM_FENCE);\n"
	"	double other = row[last - get_local_id(0)];\n"
	"	if (i < count)\n"
	"		c[i] = sqrt(a[i] * factor + b[i]) / (other * b[i] + 1.0);\n"
	"}\n";

typedef struct place {
	char folder[64]; /* all this test writes */
	char cache[96];
} place;

static inline void add_in_c(const double *a, const double *b, double factor, double *c)
{
	for (size_t i = 0; i < COUNT; i++) {
		double other = a[i - i % GROUP + (GROUP - 1 - i % GROUP)];
		c[i] = sqrt(a[i] * factor + b[i]) / (other * b[i] + 1.0);
	}
}

static inline batten_context *make_context(const char *cache, unsigned threads)
{
	batten_context_options options;
	batten_context_options_default(&options);
	options.cache_directory = cache;
	options.threads = threads;
	batten_context *context = NULL;
	return batten_context_create(&options, &context) == BATTEN_OK ? context : NULL;
}

/* Builds, launches, reads; true when the numbers equal the C code's bit for bit. */
static inline bool runs(device_session *session, const char *text, double factor, bool *from_cache)
{
	double a[COUNT], b[COUNT], expected[COUNT], found[COUNT];
	for (size_t i = 0; i < COUNT; i++) {
		a[i] = 1.0 + 0.37 * (double)i;
		b[i] = 1.0 / (1.0 + (double)i);
	}
	add_in_c(a, b, factor, expected);
	memset(found, 0, sizeof found);
	uint32_t count = COUNT;
	device_program *program = NULL;
	device_kernel *kernel = NULL;
	device_buffer *buffers[3] = { NULL };
	double seconds = -1;
	bool good = device_program_build(session, "add", text, NULL, &program, from_cache, &seconds) ==
	                BATTEN_OK &&
	            seconds > 0 && device_kernel_create(program, "add", &kernel) == BATTEN_OK &&
	            device_kernel_group_limit(kernel) >= GROUP &&
	            device_buffer_create(session, sizeof a, a, &buffers[0]) == BATTEN_OK &&
	            device_buffer_create(session, sizeof b, b, &buffers[1]) == BATTEN_OK &&
	            device_buffer_create(session, sizeof found, NULL, &buffers[2]) == BATTEN_OK;
	if (good) {
		const device_argument arguments[] = {
			{ .buffer = buffers[0] },
			{ .buffer = buffers[1] },
			{ .buffer = buffers[2] },
			{ .size = GROUP * sizeof(double) },
			{ .size = sizeof factor, .value = &factor },
			{ .size = sizeof count, .value = &count },
		};
		good = device_launch(session, kernel, arguments, 6, (COUNT + GROUP - 1) / GROUP, GROUP) ==
		           BATTEN_OK &&
		       device_finish(session) == BATTEN_OK &&
		       device_buffer_read(buffers[2], sizeof found, found) == BATTEN_OK;
	}
	if (!good)
		(void)fprintf(stderr, "%s\n", device_session_error(session));
	for (size_t i = 0; i < 3; i++)
		device_buffer_destroy(buffers[i]);
	device_kernel_destroy(kernel);
	device_program_destroy(program);
	return good && memcmp(expected, found, sizeof found) == 0;
}

static inline char *text_of(const char *format, ...) __attribute__((format(printf, 1, 2)));
static inline char *text_of(const char *format, ...)
{
	char *text = NULL;
	va_list arguments;
	va_start(arguments, format);
	int length = vasprintf(&text, format, arguments);
	va_end(arguments);
	assert_true(length >= 0);
	return text;
}

static inline size_t count_entries(const char *folder)
{
	DIR *stream = opendir(folder);
	size_t count = 0;
	assert_non_null(stream);
	while (readdir(stream))
		count++;
	assert_int_equal(closedir(stream), 0);
	return count - 2; /* . and .. */
}

static inline int make_place(void **state)
{
	place *here = calloc(1, sizeof *here);
	assert_non_null(here);
	(void)snprintf(here->folder, sizeof here->folder, "/tmp/batten-test.XXXXXX");
	assert_non_null(mkdtemp(here->folder));
	(void)snprintf(here->cache, sizeof here->cache, "%s/cache", here->folder);
	/* PoCL's own cache, unless the tests of a run share one. */
	char *pocl = text_of("%s/pocl", here->folder);
	assert_int_equal(setenv("POCL_CACHE_DIR", pocl, 0), 0);
	free(pocl);
	*state = here;
	return 0;
}

static inline int remove_place(void **state)
{
	place *here = *state;
	device_folder_remove(here->folder);
	bool removed = access(here->folder, F_OK) != 0;
	free(here);
	return removed ? 0 : 1;
}

#endif
