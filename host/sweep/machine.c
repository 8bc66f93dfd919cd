/* What runs the stages. */
#include "sweep/stages.h"

#include "hydrostatics/offsets_batch.h"

int sweep_machine_device_f64(const sweep_machine *machine)
{
	batten_device device;
	if (machine->device < 0)
		return machine->device;
	const batten_status status = batten_device_describe(machine->context, (size_t)machine->device,
	                                                    &device);
	return status == BATTEN_OK && !device.has_f64 ? BATTEN_DEVICE_REFERENCE : machine->device;
}

double *sweep_machine_room(sweep_machine *machine, const sweep_block *block, size_t count)
{
	const size_t array = block->capacity * block->nodes_each * sizeof(double);
	if (machine->room_size < count * array) {
		batten_release(machine->context, machine->room);
		machine->room = batten_allocate(machine->context, count, array);
		machine->room_size = machine->room ? count * array : 0;
	}
	return machine->room;
}

void sweep_machine_destroy(sweep_machine *machine)
{
	if (machine->context)
		batten_release(machine->context, machine->room);
	offsets_batch_destroy(machine->afloat);
	sweep_crew_destroy(&machine->crew);
	*machine = (sweep_machine){ 0 };
}
