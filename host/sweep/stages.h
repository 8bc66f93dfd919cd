/* The stages of a sweep. Each takes a block that the one before it has left, and is the one place that
 * knows how its work is done; what fails for one design stays with that design. */
#ifndef BATTEN_SWEEP_STAGES_H
#define BATTEN_SWEEP_STAGES_H

#include "sweep/block.h"

/* What runs the stages. */
typedef struct sweep_machine {
	batten_context *context;
	sweep_crew crew;
	int device;     /* as in batten_search_options */
	batten_run run; /* of the last search that a device or the C path ran for a group of designs */
	void *room;     /* what stages work in; kept from part to part */
	size_t room_size;
	struct offsets_batch
		*afloat; /* hydrostatics on the parent's table; NULL before the first part */
} sweep_machine;

/* Room of count arrays of half-breadths, with what was in it last. NULL: MEMORY. */
double *sweep_machine_room(sweep_machine *machine, const sweep_block *block, size_t count);

void sweep_machine_destroy(sweep_machine *machine);

/* What runs batches in f64: the device, or the C path where it has none. */
int sweep_machine_device_f64(const sweep_machine *machine);

/* Varies the parent: designs get their hull, or VARY_FAILED. Errors: MEMORY. */
batten_status sweep_stage_vary(sweep_machine *machine, sweep_block *block);

/* Fairs every variant by its offsets: designs get faired half-breadths and their search, or
 * FAIR_FAILED or NOT_CONVERGED. Errors: DEVICE, KERNEL, MEMORY. */
batten_status sweep_stage_fair(sweep_machine *machine, sweep_block *block);

/* Measures what came out and judges it: MEASURE_FAILED, REJECTED. Errors: MEMORY. */
batten_status sweep_stage_measure(sweep_machine *machine, sweep_block *block);

#endif
