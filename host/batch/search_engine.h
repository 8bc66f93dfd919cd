/* The search kernel made ready on one device in one shape, known to equal the C path or not. */
#ifndef BATTEN_BATCH_SEARCH_ENGINE_H
#define BATTEN_BATCH_SEARCH_ENGINE_H

#include "batch/engine.h"
#include "batch/search_plan.h"

/* What tells one build of the kernel from another. */
typedef struct search_shape {
	size_t device;
	batten_precision precision;
	unsigned lanes, work_group;
	bool global_state; /* the grid's state does not fit the device's local memory */
	int fairness;      /* GRID_BENDING ... */
	bool textbook;     /* that kernel, else multilevel */
	bool penalised;    /* its objective has an interior penalty */
} search_shape;

typedef struct search_engine search_engine;

/* The shape that suits a device and a plan; the plan's lanes and work_group where they are set. */
search_shape search_shape_choose(const search_plan *plan, size_t index,
                                 const batten_device *device);

/* Builds the kernel and runs its self-test, or finds the engine this context already has. On failure
 * result (may be NULL) still tells what happened. Errors: DEVICE, KERNEL, MEMORY. */
batten_status search_engine_open(batten_context *context, const search_shape *shape,
                                 search_engine **out, batten_selftest *result);

batch_engine *search_engine_base(search_engine *e);
const search_shape *search_engine_shape(const search_engine *e);
bool search_engine_is_strict(const search_engine *e);

/* Searches one launch should have, so that every compute unit has work and memory stays bounded. */
size_t search_engine_block(const search_engine *engine, const search_plan *plan);

/* Runs the problems whose numbers stand in which[0..count); results and y_m are those of the batch. */
batten_status search_engine_run(search_engine *engine, const search_plan *plan,
                                const batten_search_problem *problems, const size_t *which,
                                size_t count, double *y_m, batten_search_result *results);

#endif
