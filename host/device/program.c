#include "device/system.h"

#include "device/pocl.h"

#include <stdio.h>
#include <string.h>

enum { LOG_SIZE_MOST = 16 << 20, BINARY_SIZE_MOST = 256 << 20 };

void device_program_destroy(device_program *program)
{
	if (!program)
		return;
	device_session *session = program->session;
	if (program->program) {
		(void)session->system->opencl.ReleaseProgram(program->program);
		device_object_released(session->system);
	}
	batten_release(session->context, program->name);
	batten_release(session->context, program);
}

/* Copies the line that contains mark, or the first that is not blank when mark is NULL. */
static bool copy_line(const char *log, const char *mark, char *out, size_t size)
{
	const char *found = mark ? strstr(log, mark) : log + strspn(log, " \t\r\n");
	if (!found || *found == '\0')
		return false;
	while (found > log && found[-1] != '\n')
		found--;
	size_t length = strcspn(found, "\r\n");
	if (length >= size)
		length = size - 1;
	for (size_t i = 0; i < length; i++)
		out[i] = (unsigned char)found[i] < 0x20 ? ' ' : found[i];
	out[length] = '\0';
	return true;
}

/* The line of the build log that says what is wrong. */
static void read_log(device_session *session, cl_program program, char *out, size_t size)
{
	const device_opencl *opencl = &session->system->opencl;
	size_t length = 0;
	(void)snprintf(out, size, "no build log");
	cl_int code = DEVICE_CALL(opencl, GetProgramBuildInfo, program, session->entry->id,
	                          CL_PROGRAM_BUILD_LOG, 0, NULL, &length);
	if (code != CL_SUCCESS || length == 0 || length > LOG_SIZE_MOST)
		return;
	char *log = batten_allocate(session->context, length + 1, 1);
	if (!log)
		return;
	code = DEVICE_CALL(opencl, GetProgramBuildInfo, program, session->entry->id,
	                   CL_PROGRAM_BUILD_LOG, length, log, NULL);
	if (code == CL_SUCCESS && !copy_line(log, "error:", out, size) &&
	    !copy_line(log, "error", out, size))
		(void)copy_line(log, NULL, out, size);
	batten_release(session->context, log);
}

static void drop(device_program *program)
{
	if (!program->program)
		return;
	(void)program->session->system->opencl.ReleaseProgram(program->program);
	device_object_released(program->session->system);
	program->program = NULL;
}

static cl_int build(device_program *program, const char *options)
{
	device_session *session = program->session;
	return DEVICE_CALL(&session->system->opencl, BuildProgram, program->program, 1,
	                   &session->entry->id, options, NULL, NULL);
}

/* A binary that the driver refuses for whatever reason is as good as none. */
static bool load(device_program *program, const device_cache_key *key, const char *options)
{
	device_session *session = program->session;
	unsigned char *binary = NULL;
	size_t length = 0;
	if (!device_cache_load(session->context, &session->system->cache, key, &binary, &length))
		return false;
	const unsigned char *binaries = binary;
	cl_int accepted = CL_SUCCESS;
	cl_int code = CL_SUCCESS;
	program->program = DEVICE_CREATE(&session->system->opencl, &code, CreateProgramWithBinary,
	                                 session->environment, 1, &session->entry->id, &length,
	                                 &binaries, &accepted);
	batten_release(session->context, binary);
	if (!device_object_made(session->system, &code, program->program)) {
		program->program = NULL;
		return false;
	}
	if (accepted == CL_SUCCESS && build(program, options) == CL_SUCCESS)
		return true;
	drop(program);
	return false;
}

static batten_status compile(device_program *program, const char *source, const char *options)
{
	device_session *session = program->session;
	size_t length = strlen(source);
	cl_int code = CL_SUCCESS;
	program->program = DEVICE_CREATE(&session->system->opencl, &code, CreateProgramWithSource,
	                                 session->environment, 1, &source, &length);
	if (!device_object_made(session->system, &code, program->program)) {
		program->program = NULL;
		return device_session_fail_call(session, code, "clCreateProgramWithSource of %s, %zu bytes",
		                                program->name, length);
	}
	code = build(program, options);
	if (code == CL_SUCCESS)
		return BATTEN_OK;
	if (code != CL_BUILD_PROGRAM_FAILURE)
		return device_session_fail_call(session, code, "clBuildProgram of %s", program->name);
	char line[300];
	read_log(session, program->program, line, sizeof line);
	return device_session_fail(session, BATTEN_KERNEL, "%s does not build on %s: %s", program->name,
	                           session->entry->facts.name, line);
}

/* Stores the binary for the next process; without one it only takes longer.
 *
 * Not on PoCL. Asked for a binary, PoCL 3.1 first compiles every kernel for work-groups of any size:
 * measured with kernels/multilevel.cl (f64, 8 lanes) 32 to 42 s on one busy core, where the build
 * takes 0.7 s and the launch with groups of one work-item another 0.6 s. It keeps a cache of its own,
 * by group size, from which a second process has its program in 0.08 s against 0.01 s from a binary;
 * and a binary read before a launch lacks the code of that group size (0.17 s again at the first
 * launch of a small kernel). So there is nothing to win. */
static void store(device_program *program, const device_cache_key *key)
{
	device_session *session = program->session;
	if (device_pocl_is(session->entry->facts.platform))
		return;
	const device_opencl *opencl = &session->system->opencl;
	size_t length = 0;
	cl_int code = DEVICE_CALL(opencl, GetProgramInfo, program->program, CL_PROGRAM_BINARY_SIZES,
	                          sizeof length, &length, NULL);
	if (code != CL_SUCCESS || length == 0 || length > BINARY_SIZE_MOST)
		return;
	unsigned char *binary = batten_allocate(session->context, length, 1);
	if (!binary)
		return;
	code = DEVICE_CALL(opencl, GetProgramInfo, program->program, CL_PROGRAM_BINARIES, sizeof binary,
	                   &binary, NULL);
	if (code == CL_SUCCESS)
		device_cache_store(&session->system->cache, key, binary, length);
	batten_release(session->context, binary);
}

static batten_status build_or_load(device_program *program, const char *name, const char *source,
                                   const char *options, bool *from_cache)
{
	static const char dialect[] = "-cl-std=CL1.2 ";
	device_session *session = program->session;
	program->name = device_session_copy_text(session, name);
	size_t size = sizeof dialect + strlen(options);
	char *all = device_session_allocate(session, size, 1);
	batten_status status = program->name && all ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		(void)snprintf(all, size, "%s%s", dialect, options);
		device_cache_key key = device_cache_key_of(&session->entry->facts, source, all);
		*from_cache = load(program, &key, all);
		if (!*from_cache)
			status = compile(program, source, all);
		if (status == BATTEN_OK && !*from_cache)
			store(program, &key);
	}
	batten_release(session->context, all);
	return status;
}

batten_status device_program_build(device_session *session, const char *name, const char *source,
                                   const char *options, device_program **out, bool *from_cache,
                                   double *seconds)
{
	double begin = batten_wall_seconds();
	bool cached = false;
	device_program *program = device_session_allocate(session, 1, sizeof *program);
	if (!program)
		return BATTEN_MEMORY;
	*program = (device_program){ .session = session };
	batten_status status = build_or_load(program, name, source, options ? options : "", &cached);
	if (status != BATTEN_OK) {
		device_program_destroy(program);
		return status;
	}
	*out = program;
	if (from_cache)
		*from_cache = cached;
	if (seconds)
		*seconds = batten_wall_seconds() - begin;
	return BATTEN_OK;
}
