/* The hats of the block search (shared/block_hats.h): which grids have how many, what they are at the
 * nodes of a line, which searches want them. */
#ifndef BATTEN_BATCH_BLOCK_HATS_H
#define BATTEN_BATCH_BLOCK_HATS_H

#include "batch/block_pack.h"

/* Hats of a line of the grid: one span as long as the lines are apart, at least two nodes, at most
 * 32 spans a line. */
size_t block_hat_count(const search_plan *plan);

/* BLOCK_HAT_SIZE numbers a node of a line. */
void block_hat_values(const search_plan *plan, double *values);

/* What a search does in an iteration: hats of a line, 0: none; rounds (shared/block_rounds.h), 0: none. Where the
 * energy couples lines more than closeness holds them, hats and rounds; where it does less, but some, rounds.
 * It depends on the problem and the grid alone. */
typedef struct block_course {
	size_t hats, rounds;
} block_course;
block_course block_course_of(const search_plan *plan, const batten_search_problem *problem);

#endif
