#include "device/system.h"

#include <stdio.h>
#include <string.h>

const char *device_session_error(const device_session *session)
{
	return session->error;
}

const batten_device *device_session_device(const device_session *session)
{
	return &session->entry->facts;
}

batten_status device_session_fail(device_session *session, batten_status status, const char *format,
                                  ...)
{
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(session->error, sizeof session->error, format, arguments);
	va_end(arguments);
	return status;
}

batten_status device_session_fail_call(device_session *session, cl_int code, const char *format,
                                       ...)
{
	char call[256];
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(call, sizeof call, format, arguments);
	va_end(arguments);
	const char *name = device_opencl_name(code);
	return device_session_fail(session, device_opencl_status(code), "%s: %s: %s (%d)",
	                           session->entry->facts.name, call, name ? name : "unknown code",
	                           (int)code);
}

void *device_session_allocate(device_session *session, size_t count, size_t size)
{
	void *memory = batten_allocate(session->context, count, size);
	if (!memory)
		(void)device_session_fail(session, BATTEN_MEMORY, "out of memory: %zu times %zu bytes",
		                          count, size);
	return memory;
}

char *device_session_copy_text(device_session *session, const char *text)
{
	size_t length = strlen(text);
	char *copy = device_session_allocate(session, length + 1, 1);
	if (copy)
		memcpy(copy, text, length);
	return copy;
}

static batten_status start_queue(device_session *session)
{
	cl_int code = CL_SUCCESS;
	session->queue = DEVICE_CREATE(&session->system->opencl, &code, CreateCommandQueue,
	                               session->environment, session->entry->id, 0);
	if (device_object_made(session->system, &code, session->queue))
		return BATTEN_OK;
	session->queue = NULL;
	return device_session_fail_call(session, code, "clCreateCommandQueue");
}

static batten_status start(device_session *session)
{
	const device_opencl *opencl = &session->system->opencl;
	const device_entry *entry = session->entry;
	const cl_context_properties properties[] = { CL_CONTEXT_PLATFORM,
		                                         (cl_context_properties)entry->platform, 0 };
	cl_int code = CL_SUCCESS;
	session->environment = DEVICE_CREATE(opencl, &code, CreateContext, properties, 1, &entry->id,
	                                     NULL, NULL);
	if (!device_object_made(session->system, &code, session->environment)) {
		session->environment = NULL;
		return device_session_fail_call(session, code, "clCreateContext");
	}
	return start_queue(session);
}

batten_status device_session_branch(device_session *of, device_session **out)
{
	device_session *session = batten_allocate(of->context, 1, sizeof *session);
	if (!session)
		return BATTEN_MEMORY;
	*session = (device_session){ .context = of->context,
		                         .system = of->system,
		                         .entry = of->entry,
		                         .environment = of->environment,
		                         .borrowed = true };
	const batten_status status = start_queue(session);
	if (status != BATTEN_OK) {
		(void)batten_fail(of->context, status, "%s", session->error);
		device_session_close(session);
		return status;
	}
	*out = session;
	return BATTEN_OK;
}

batten_status device_session_open(batten_context *context, size_t index, device_session **out)
{
	device_system *system = device_system_of(context);
	if (!system)
		return batten_fail_memory(context);
	batten_device facts;
	batten_status status = device_describe(context, index, &facts);
	if (status != BATTEN_OK)
		return status;
	if (!system->cache_is_open) {
		device_cache_open(context, &system->cache);
		system->cache_is_open = true;
	}
	device_session *session = batten_allocate(context, 1, sizeof *session);
	if (!session)
		return BATTEN_MEMORY;
	*session = (device_session){ .context = context,
		                         .system = system,
		                         .entry = &system->entries[index] };
	status = start(session);
	if (status != BATTEN_OK) {
		(void)batten_fail(context, status, "%s", session->error);
		device_session_close(session);
		return status;
	}
	*out = session;
	return BATTEN_OK;
}

void device_session_close(device_session *session)
{
	if (!session)
		return;
	const device_opencl *opencl = &session->system->opencl;
	device_session_drop_spares(session);
	if (session->queue) {
		(void)opencl->ReleaseCommandQueue(session->queue);
		device_object_released(session->system);
	}
	if (session->environment && !session->borrowed) {
		(void)opencl->ReleaseContext(session->environment);
		device_object_released(session->system);
	}
	batten_release(session->context, session);
}

batten_status device_finish(device_session *session)
{
	cl_int code = DEVICE_CALL(&session->system->opencl, Finish, session->queue);
	if (code != CL_SUCCESS)
		return device_session_fail_call(session, code, "clFinish");
	return BATTEN_OK;
}
