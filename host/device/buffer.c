#include "device/system.h"

#include <inttypes.h>
#include <string.h>

static void release(device_buffer *buffer)
{
	device_session *session = buffer->session;
	if (buffer->memory) {
		(void)session->system->opencl.ReleaseMemObject(buffer->memory);
		device_object_released(session->system);
	}
	batten_release(session->context, buffer);
}

static batten_status create(device_session *session, cl_mem_flags flags, size_t size, void *memory,
                            device_buffer **out)
{
	uint64_t most = session->entry->facts.max_allocation_bytes;
	if (size == 0)
		return device_session_fail(session, BATTEN_USAGE, "a buffer of 0 bytes is asked for");
	if (size > most)
		return device_session_fail(session, BATTEN_MEMORY,
		                           "%s: a buffer of %zu bytes is asked for, the most is %" PRIu64,
		                           session->entry->facts.name, size, most);
	device_buffer *buffer = device_session_allocate(session, 1, sizeof *buffer);
	if (!buffer)
		return BATTEN_MEMORY;
	*buffer = (device_buffer){ .session = session,
		                       .size = size,
		                       .room = flags & CL_MEM_USE_HOST_PTR ? 0 : size };
	batten_status status = BATTEN_OK;
	cl_int code = CL_SUCCESS;
	buffer->memory = DEVICE_CREATE(&session->system->opencl, &code, CreateBuffer,
	                               session->environment, flags, size, memory);
	if (!device_object_made(session->system, &code, buffer->memory)) {
		buffer->memory = NULL;
		status = device_session_fail_call(session, code, "clCreateBuffer of %zu bytes", size);
	}
	if (status != BATTEN_OK) {
		release(buffer);
		return status;
	}
	*out = buffer;
	return BATTEN_OK;
}

/* Memory that was let go and is large enough, but not four times as large; NULL: there is none. */
static device_buffer *take_spare(device_session *session, size_t size)
{
	for (size_t i = 0; i < session->spare_count; i++) {
		device_buffer *spare = session->spares[i];
		if (spare->room < size || spare->room / 4 > size)
			continue;
		session->spare_count--;
		memmove(&session->spares[i], &session->spares[i + 1],
		        (session->spare_count - i) * sizeof session->spares[0]);
		spare->size = size;
		return spare;
	}
	return NULL;
}

static batten_status create_on_device(device_session *session, size_t size, const void *initial,
                                      device_buffer **out)
{
	device_buffer *buffer = take_spare(session, size);
	batten_status status = BATTEN_OK;
	if (!buffer)
		status = create(session, CL_MEM_READ_WRITE, size, NULL, &buffer);
	if (status == BATTEN_MEMORY && session->spare_count > 0) {
		device_session_drop_spares(session);
		status = create(session, CL_MEM_READ_WRITE, size, NULL, &buffer);
	}
	if (status == BATTEN_OK && initial)
		status = device_buffer_write(buffer, size, initial);
	if (status == BATTEN_OK)
		*out = buffer;
	else if (buffer)
		release(buffer);
	return status;
}

batten_status device_buffer_create(device_session *session, size_t size, const void *initial,
                                   device_buffer **out)
{
	if (!session->entry->facts.is_cpu)
		return create_on_device(session, size, initial, out);
	/* Copied at once, on a CPU by this thread: a command of the queue would wake another and wait for it.
	 * OpenCL takes a pointer that it could write through; this flag rules that out. */
	const cl_mem_flags copied = initial ? CL_MEM_COPY_HOST_PTR : 0;
	void *from = NULL;
	memcpy(&from, &initial, sizeof from);
	return create(session, CL_MEM_READ_WRITE | copied, size, from, out);
}

batten_status device_buffer_wrap(device_session *session, size_t size, void *memory,
                                 device_buffer **out)
{
	return create(session, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, size, memory, out);
}

/* Its bits come to the host when this is done. */
static batten_status enqueue_settling(device_buffer *buffer)
{
	device_session *session = buffer->session;
	const device_opencl *opencl = &session->system->opencl;
	cl_int code = CL_SUCCESS;
	void *mapped = DEVICE_CREATE(opencl, &code, EnqueueMapBuffer, session->queue, buffer->memory,
	                             CL_FALSE, CL_MAP_READ, 0, buffer->size, 0, NULL, NULL);
	if (code != CL_SUCCESS || !mapped)
		return device_session_fail_call(session, code, "clEnqueueMapBuffer of %zu bytes",
		                                buffer->size);
	code = DEVICE_CALL(opencl, EnqueueUnmapMemObject, session->queue, buffer->memory, mapped, 0,
	                   NULL, NULL);
	if (code != CL_SUCCESS)
		return device_session_fail_call(session, code, "clEnqueueUnmapMemObject");
	return BATTEN_OK;
}

batten_status device_buffers_settle(device_buffer *const *buffers, size_t count)
{
	batten_status status = BATTEN_OK;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		status = enqueue_settling(buffers[i]);
	return status == BATTEN_OK ? device_finish(buffers[0]->session) : status;
}

void device_session_drop_spares(device_session *session)
{
	while (session->spare_count > 0)
		release(session->spares[--session->spare_count]);
}

void device_buffer_destroy(device_buffer *buffer)
{
	if (!buffer)
		return;
	device_session *session = buffer->session;
	if (session->entry->facts.is_cpu || buffer->room == 0) {
		release(buffer);
		return;
	}
	if (session->spare_count == SPARES_MOST) {
		release(session->spares[0]);
		session->spare_count--;
		memmove(&session->spares[0], &session->spares[1],
		        session->spare_count * sizeof session->spares[0]);
	}
	session->spares[session->spare_count++] = buffer;
}

static batten_status check_size(const device_buffer *buffer, size_t size, const char *what)
{
	if (size > 0 && size <= buffer->size)
		return BATTEN_OK;
	return device_session_fail(buffer->session, BATTEN_USAGE,
	                           "%s of %zu bytes of a buffer of %zu bytes", what, size,
	                           buffer->size);
}

batten_status device_buffer_write(device_buffer *buffer, size_t size, const void *from)
{
	device_session *session = buffer->session;
	batten_status status = check_size(buffer, size, "a write");
	if (status != BATTEN_OK)
		return status;
	cl_int code = DEVICE_CALL(&session->system->opencl, EnqueueWriteBuffer, session->queue,
	                          buffer->memory, CL_TRUE, 0, size, from, 0, NULL, NULL);
	if (code != CL_SUCCESS)
		return device_session_fail_call(session, code, "clEnqueueWriteBuffer of %zu bytes", size);
	return BATTEN_OK;
}

batten_status device_buffer_read(device_buffer *buffer, size_t size, void *to)
{
	device_session *session = buffer->session;
	batten_status status = check_size(buffer, size, "a read");
	if (status != BATTEN_OK)
		return status;
	cl_int code = DEVICE_CALL(&session->system->opencl, EnqueueReadBuffer, session->queue,
	                          buffer->memory, CL_TRUE, 0, size, to, 0, NULL, NULL);
	if (code != CL_SUCCESS)
		return device_session_fail_call(session, code, "clEnqueueReadBuffer of %zu bytes", size);
	return BATTEN_OK;
}
