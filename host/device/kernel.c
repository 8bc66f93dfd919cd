#include "device/system.h"

#include "core/number.h"

#include <inttypes.h>

enum { ARGUMENTS_MOST = 256, VALUE_SIZE_MOST = 1024 };

batten_status device_kernel_create(device_program *program, const char *name, device_kernel **out)
{
	return device_kernel_branch(program->session, program, name, out);
}

batten_status device_kernel_branch(device_session *session, device_program *program,
                                   const char *name, device_kernel **out)
{
	const device_opencl *opencl = &session->system->opencl;
	device_kernel *kernel = device_session_allocate(session, 1, sizeof *kernel);
	if (!kernel)
		return BATTEN_MEMORY;
	*kernel = (device_kernel){ .session = session };
	batten_status status = BATTEN_OK;
	kernel->name = device_session_copy_text(session, name);
	if (!kernel->name)
		status = BATTEN_MEMORY;
	cl_int code = CL_SUCCESS;
	if (status == BATTEN_OK) {
		kernel->kernel = DEVICE_CREATE(opencl, &code, CreateKernel, program->program, name);
		if (!device_object_made(session->system, &code, kernel->kernel)) {
			kernel->kernel = NULL;
			status = device_session_fail_call(session, code, "clCreateKernel of %s in %s", name,
			                                  program->name);
		}
	}
	if (status == BATTEN_OK) {
		code = DEVICE_CALL(opencl, GetKernelWorkGroupInfo, kernel->kernel, session->entry->id,
		                   CL_KERNEL_WORK_GROUP_SIZE, sizeof kernel->group_limit,
		                   &kernel->group_limit, NULL);
		if (code != CL_SUCCESS)
			status = device_session_fail_call(session, code, "clGetKernelWorkGroupInfo of %s",
			                                  name);
	}
	if (status != BATTEN_OK) {
		device_kernel_destroy(kernel);
		return status;
	}
	*out = kernel;
	return BATTEN_OK;
}

void device_kernel_destroy(device_kernel *kernel)
{
	if (!kernel)
		return;
	device_session *session = kernel->session;
	if (kernel->kernel) {
		(void)session->system->opencl.ReleaseKernel(kernel->kernel);
		device_object_released(session->system);
	}
	batten_release(session->context, kernel->name);
	batten_release(session->context, kernel);
}

size_t device_kernel_group_limit(const device_kernel *kernel)
{
	return kernel->group_limit;
}

/* What a driver need not check: PoCL trusts sizes, and a wrong one ends the process. */
static batten_status check_launch(device_session *session, const device_kernel *kernel,
                                  const device_argument *arguments, size_t argument_count,
                                  size_t group_count, size_t group_size)
{
	size_t items = 0;
	uint64_t local = 0;
	if (group_count == 0 || group_size == 0 ||
	    !batten_size_multiply(group_count, group_size, &items) || group_size > kernel->group_limit)
		return device_session_fail(session, BATTEN_USAGE,
		                           "kernel %s: %zu groups of %zu work-items (1..%zu) are asked for",
		                           kernel->name, group_count, group_size, kernel->group_limit);
	if (kernel->session != session || argument_count > ARGUMENTS_MOST)
		return device_session_fail(session, BATTEN_USAGE,
		                           "kernel %s: of another session, or too many arguments (%zu)",
		                           kernel->name, argument_count);
	for (size_t i = 0; i < argument_count; i++) {
		const device_argument *argument = &arguments[i];
		bool good = argument->buffer ? argument->buffer->session == session
		                             : argument->size > 0 &&
		                                   (!argument->value || argument->size <= VALUE_SIZE_MOST);
		if (!argument->buffer && !argument->value)
			good = good && !__builtin_add_overflow(local, (uint64_t)argument->size, &local);
		if (!good)
			return device_session_fail(
				session, BATTEN_USAGE,
				"kernel %s, argument %zu: a buffer of another session, or of "
				"size %zu",
				kernel->name, i, argument->size);
	}
	if (local > session->entry->facts.local_memory_bytes)
		return device_session_fail(session, BATTEN_MEMORY,
		                           "kernel %s: %" PRIu64
		                           " bytes of local memory are asked for, %s has "
		                           "%" PRIu64,
		                           kernel->name, local, session->entry->facts.name,
		                           session->entry->facts.local_memory_bytes);
	return BATTEN_OK;
}

static batten_status set_argument(device_session *session, const device_kernel *kernel,
                                  cl_uint index, const device_argument *argument)
{
	const void *value = argument->buffer ? (const void *)&argument->buffer->memory
	                                     : argument->value;
	size_t size = argument->buffer ? sizeof argument->buffer->memory : argument->size;
	cl_int code = DEVICE_CALL(&session->system->opencl, SetKernelArg, kernel->kernel, index, size,
	                          value);
	if (code != CL_SUCCESS)
		return device_session_fail_call(session, code,
		                                "clSetKernelArg of %s, argument %u, %zu bytes",
		                                kernel->name, (unsigned)index, size);
	return BATTEN_OK;
}

batten_status device_launch(device_session *session, device_kernel *kernel,
                            const device_argument *arguments, size_t argument_count,
                            size_t group_count, size_t group_size)
{
	const device_opencl *opencl = &session->system->opencl;
	batten_status status = check_launch(session, kernel, arguments, argument_count, group_count,
	                                    group_size);
	for (size_t i = 0; i < argument_count && status == BATTEN_OK; i++)
		status = set_argument(session, kernel, (cl_uint)i, &arguments[i]);
	if (status != BATTEN_OK)
		return status;
	size_t items = group_count * group_size;
	cl_int code = DEVICE_CALL(opencl, EnqueueNDRangeKernel, session->queue, kernel->kernel, 1, NULL,
	                          &items, &group_size, 0, NULL, NULL);
	if (code != CL_SUCCESS)
		return device_session_fail_call(session, code,
		                                "clEnqueueNDRangeKernel of %s, %zu groups of %zu",
		                                kernel->name, group_count, group_size);
	/* So that a device starts at once while the host prepares another's work. */
	code = DEVICE_CALL(opencl, Flush, session->queue);
	if (code != CL_SUCCESS)
		return device_session_fail_call(session, code, "clFlush after %s", kernel->name);
	return BATTEN_OK;
}
