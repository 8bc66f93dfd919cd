/* Searches packed for the block search, in the precision of the plan: what a device or the C path reads
 * and writes (shared/block_layout.h). */
#ifndef BATTEN_BATCH_BLOCK_PACK_H
#define BATTEN_BATCH_BLOCK_PACK_H

#include "batch/search_plan.h"
#include "shared/block_layout.h"

/* Which way the lines run, and how many there are of how many nodes. */
typedef struct block_lines_shape {
	bool along_x;
	size_t lines, length;
} block_lines_shape;
block_lines_shape block_lines_of(const search_plan *plan);

/* Stencils of the lines, then of the nodes of a line, then of their hats: (lines + length) * STENCIL_SIZE
 * + length * BLOCK_HAT_SIZE numbers. Errors: MEMORY. */
size_t block_stencil_count(const search_plan *plan);
batten_status block_pack_stencils(const search_plan *plan, void *stencils);

/* input [BLOCK_INPUT_COUNT][nodes] and settings [BLOCK_SETTING_COUNT] of a search. */
void block_pack(const search_plan *plan, const batten_search_problem *problem, void *input,
                void *settings);

/* Takes a search's end, which stands where its start was: y_m of the nodes on the hull (the others get the start) and the result. */
void block_unpack(const search_plan *plan, const batten_search_problem *problem, const void *input,
                  const void *outcome, double *y_m, batten_search_result *result);

#endif
