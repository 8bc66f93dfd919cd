/* The block search over a control net in plain C, one search at a time: what kernels/net_block.cl does, equal to it
 * bit for bit. Layout is the kernel's (shared/net_block_layout.h), with one lane. */
#ifndef BATTEN_REFERENCE_NET_BLOCK_H
#define BATTEN_REFERENCE_NET_BLOCK_H

#include <stdint.h>

/* What all searches of a batch share, beyond the tables. */
typedef struct reference_net_block {
	int order_u, order_v, points_u, points_v, fairness;
	const int32_t *shape; /* NET_BLOCK_SHAPE_SIZE */
	const int32_t *first_u, *first_v, *follower;
} reference_net_block;

/* tables as the kernel has them; input [BLOCK_INPUT_COUNT][poles], settings [BLOCK_SETTING_COUNT], outcome
 * [BLOCK_OUTCOME_COUNT]; scratch has
 * room for NET_BLOCK_STATE_NUMBERS. The end of the search takes the place of its start. */
void reference_net_block_f64(const reference_net_block *shared, const double *tables, double *input,
                             const double *settings, double *outcome, double *scratch);
void reference_net_block_f32(const reference_net_block *shared, const float *tables, float *input,
                             const float *settings, float *outcome, float *scratch);

#endif
