#include "device/system.h"

#include "device/pocl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLATFORMS_MOST = 64, DEVICES_MOST = 256, TEXT_SIZE = 1024 };

/* Starting OpenCL changes the environment and loads the drivers of the process, so contexts of two
 * threads take turns: of the process like what it guards. */
static pthread_mutex_t start_lock = PTHREAD_MUTEX_INITIALIZER;

static void give_reason(device_system *system, const char *what, const char *call, cl_int code)
{
	const char *name = device_opencl_name(code);
	(void)snprintf(system->reason, sizeof system->reason, "%s: %s: %s (%d)", what, call,
	               name ? name : "unknown code", (int)code);
}

/* One line of plain ASCII without blanks around it: drivers pad names, and nothing they say may break
 * a terminal or a report. */
static void clean_text(char *out, size_t size, const char *text)
{
	while (*text == ' ')
		text++;
	size_t length = 0;
	for (; text[length] && length + 1 < size; length++) {
		unsigned char letter = (unsigned char)text[length];
		out[length] = text[length];
		if (letter < 0x20 || letter > 0x7e)
			out[length] = letter > 0x7e ? '?' : ' ';
	}
	while (length > 0 && out[length - 1] == ' ')
		length--;
	out[length] = '\0';
}

/* The facts of one device while they are asked for: the first failure stays. */
typedef struct inquiry {
	const device_opencl *opencl;
	cl_device_id id;
	cl_int code;
} inquiry;

static void ask(inquiry *asked, cl_device_info what, void *answer, size_t size)
{
	if (asked->code == CL_SUCCESS)
		asked->code = DEVICE_CALL(asked->opencl, GetDeviceInfo, asked->id, what, size, answer,
		                          NULL);
}

static void ask_text(inquiry *asked, cl_device_info what, char *out, size_t size)
{
	char text[TEXT_SIZE] = "";
	ask(asked, what, text, sizeof text - 1);
	clean_text(out, size, text);
}

static unsigned ask_unsigned(inquiry *asked, cl_device_info what)
{
	cl_uint answer = 0;
	ask(asked, what, &answer, sizeof answer);
	return answer;
}

static uint64_t ask_wide(inquiry *asked, cl_device_info what)
{
	cl_ulong answer = 0;
	ask(asked, what, &answer, sizeof answer);
	return answer;
}

static bool ask_f64(inquiry *asked)
{
	cl_device_fp_config answer = 0;
	ask(asked, CL_DEVICE_DOUBLE_FP_CONFIG, &answer, sizeof answer);
	if (asked->code == CL_INVALID_VALUE) { /* what a device without doubles may say */
		asked->code = CL_SUCCESS;
		answer = 0;
	}
	return answer != 0;
}

static cl_int describe(const device_opencl *opencl, device_entry *entry, const char *platform,
                       bool *usable)
{
	inquiry asked = { .opencl = opencl, .id = entry->id, .code = CL_SUCCESS };
	batten_device *facts = &entry->facts;
	(void)snprintf(facts->platform, sizeof facts->platform, "%s", platform);
	ask_text(&asked, CL_DEVICE_NAME, facts->name, sizeof facts->name);
	ask_text(&asked, CL_DRIVER_VERSION, facts->driver, sizeof facts->driver);
	ask_text(&asked, CL_DEVICE_VERSION, facts->version, sizeof facts->version);
	cl_device_type type = ask_wide(&asked, CL_DEVICE_TYPE);
	facts->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
	facts->has_f64 = ask_f64(&asked);
	cl_device_fp_config single = ask_wide(&asked, CL_DEVICE_SINGLE_FP_CONFIG);
	facts->has_correct_f32 = (single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0 &&
	                         (single & CL_FP_DENORM) != 0;
	facts->compute_units = ask_unsigned(&asked, CL_DEVICE_MAX_COMPUTE_UNITS);
	facts->global_memory_bytes = ask_wide(&asked, CL_DEVICE_GLOBAL_MEM_SIZE);
	facts->local_memory_bytes = ask_wide(&asked, CL_DEVICE_LOCAL_MEM_SIZE);
	facts->max_allocation_bytes = ask_wide(&asked, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
	size_t group = 0;
	ask(&asked, CL_DEVICE_MAX_WORK_GROUP_SIZE, &group, sizeof group);
	facts->max_work_group = group < UINT32_MAX ? (unsigned)group : UINT32_MAX;
	*usable = ask_unsigned(&asked, CL_DEVICE_AVAILABLE) != 0 &&
	          ask_unsigned(&asked, CL_DEVICE_COMPILER_AVAILABLE) != 0;
	return asked.code;
}

/* Appends the devices of one platform. False only when memory is out. */
static bool list_devices(batten_context *context, device_system *system, cl_platform_id platform,
                         const char *name, const cl_device_id *ids, size_t count)
{
	device_entry *entries = batten_allocate(context, system->count + count,
	                                        sizeof *system->entries);
	if (!entries)
		return false;
	if (system->count > 0)
		memcpy(entries, system->entries, system->count * sizeof *entries);
	batten_release(context, system->entries);
	system->entries = entries;
	for (size_t i = 0; i < count; i++) {
		device_entry *entry = &entries[system->count];
		*entry = (device_entry){ .platform = platform, .id = ids[i] };
		bool usable = false;
		cl_int code = describe(&system->opencl, entry, name, &usable);
		if (code != CL_SUCCESS)
			give_reason(system, name, "clGetDeviceInfo", code);
		else if (!usable)
			(void)snprintf(system->reason, sizeof system->reason,
			               "%s: %s is not available or has no compiler", name, entry->facts.name);
		else
			system->count++;
	}
	return true;
}

static bool list_platform(batten_context *context, device_system *system, cl_platform_id platform)
{
	const device_opencl *opencl = &system->opencl;
	char text[TEXT_SIZE] = "";
	char name[sizeof system->entries->facts.platform];
	cl_int code = DEVICE_CALL(opencl, GetPlatformInfo, platform, CL_PLATFORM_NAME, sizeof text - 1,
	                          text, NULL);
	if (code != CL_SUCCESS) {
		give_reason(system, "an OpenCL platform has no name", "clGetPlatformInfo", code);
		return true;
	}
	clean_text(name, sizeof name, text);
	if (device_pocl_is(name) && !device_pocl_sees_machine()) {
		(void)snprintf(system->reason, sizeof system->reason,
		               "%s: /sys, which it reads the processors from, is not mounted", name);
		return true;
	}
	/* PoCL links what it compiled by running ld, and aborts the process when there is none. */
	if (device_pocl_is(name) && !device_pocl_has_linker()) {
		(void)snprintf(system->reason, sizeof system->reason,
		               "%s: the linker ld, which it needs, is not in PATH", name);
		return true;
	}
	cl_device_id ids[DEVICES_MOST];
	cl_uint count = 0;
	code = DEVICE_CALL(opencl, GetDeviceIDs, platform, CL_DEVICE_TYPE_ALL, DEVICES_MOST, ids,
	                   &count);
	if (code != CL_SUCCESS || count == 0) {
		give_reason(system, name, "clGetDeviceIDs", code);
		return true;
	}
	return list_devices(context, system, platform, name, ids,
	                    count < DEVICES_MOST ? count : DEVICES_MOST);
}

static void list_platforms(batten_context *context, device_system *system)
{
	cl_platform_id platforms[PLATFORMS_MOST];
	cl_uint count = 0;
	cl_int code = DEVICE_CALL(&system->opencl, GetPlatformIDs, PLATFORMS_MOST, platforms, &count);
	if (code != CL_SUCCESS || count == 0) {
		give_reason(system, "no OpenCL driver is installed", "clGetPlatformIDs", code);
		return;
	}
	if (count > PLATFORMS_MOST)
		count = PLATFORMS_MOST;
	for (cl_uint i = 0; i < count; i++) {
		if (!list_platform(context, system, platforms[i]))
			(void)snprintf(system->reason, sizeof system->reason, "out of memory");
	}
	if (system->reason[0] && system->count > 0)
		batten_log(context, BATTEN_LOG_WARNING, "a device is left out: %s", system->reason);
}

static void start(batten_context *context, device_system *system)
{
	if (!device_pocl_prepare(context->options.threads)) {
		(void)snprintf(
			system->reason, sizeof system->reason,
			"OpenCL is not started: no folder for compiled kernels can be written (neither "
			"POCL_CACHE_DIR, the user's cache nor under TMPDIR)");
		return;
	}
	if (device_opencl_open(&system->opencl, system->reason, sizeof system->reason))
		list_platforms(context, system);
}

device_system *device_system_of(batten_context *context)
{
	if (context->devices)
		return context->devices;
	device_system *system = batten_allocate(context, 1, sizeof *system);
	if (!system)
		return NULL;
	atomic_init(&system->live, 0);
	(void)pthread_mutex_lock(&start_lock);
	start(context, system);
	(void)pthread_mutex_unlock(&start_lock);
	context->devices = system;
	return system;
}

void device_system_destroy(batten_context *context, device_system *system)
{
	if (!system)
		return;
	device_cache_close(context, &system->cache);
	device_opencl_close(&system->opencl);
	batten_release(context, system->entries);
	batten_release(context, system);
}

size_t device_count(batten_context *context, const char **reason)
{
	device_system *system = device_system_of(context);
	if (reason)
		*reason = !system ? "out of memory" : system->count == 0 ? system->reason : "";
	return system ? system->count : 0;
}

batten_status device_describe(batten_context *context, size_t index, batten_device *out)
{
	device_system *system = device_system_of(context);
	if (!system)
		return batten_fail_memory(context);
	if (index >= system->count)
		return batten_fail(context, BATTEN_DEVICE, "device %zu: %s", index,
		                   system->count == 0 ? system->reason : "there is no such index");
	*out = system->entries[index].facts;
	return BATTEN_OK;
}

size_t device_live_objects(const batten_context *context)
{
	return context->devices ? atomic_load(&context->devices->live) : 0;
}

bool device_object_made(device_system *system, cl_int *code, const void *object)
{
	if (*code == CL_SUCCESS && !object)
		*code = CL_OUT_OF_HOST_MEMORY; /* a driver that says neither */
	if (*code != CL_SUCCESS)
		return false;
	(void)atomic_fetch_add(&system->live, 1);
	return true;
}

void device_object_released(device_system *system)
{
	(void)atomic_fetch_sub(&system->live, 1);
}
