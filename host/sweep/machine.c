/* What runs the stages. */
#include "sweep/stages.h"

void sweep_machine_lock(const sweep_machine *machine)
{
	if (machine->device_lock)
		(void)pthread_mutex_lock(machine->device_lock);
}

void sweep_machine_unlock(const sweep_machine *machine)
{
	if (machine->device_lock)
		(void)pthread_mutex_unlock(machine->device_lock);
}

int sweep_machine_device_f64(const sweep_machine *machine)
{
	batten_device device;
	if (machine->device < 0)
		return machine->device;
	const batten_status status = batten_device_describe(machine->context, (size_t)machine->device,
	                                                    &device);
	return status == BATTEN_OK && !device.has_f64 ? BATTEN_DEVICE_REFERENCE : machine->device;
}
