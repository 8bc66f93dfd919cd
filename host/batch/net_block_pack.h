/* Searches over control nets packed for the block search, in the precision of the plan: what a device or the C path
 * reads and writes (shared/net_block_layout.h). */
#ifndef BATTEN_BATCH_NET_BLOCK_PACK_H
#define BATTEN_BATCH_NET_BLOCK_PACK_H

#include "batch/net_plan.h"
#include "shared/net_block_layout.h"

/* What all searches of a plan share. u is the direction with more poles. */
typedef struct net_block_shape {
	const net_samples *u, *v;
	size_t band, followers;
} net_block_shape;

/* Errors: MEMORY. */
batten_status net_block_shape_of(const net_plan *plan, net_block_shape *out);

/* Lines of samples kept, and numbers of a search's state; alone: it is worked by one work-item. */
size_t net_block_slots(const net_block_shape *shape, bool alone);
size_t net_block_state_numbers(const net_block_shape *shape, bool alone);

/* Whether the plan's searches are of a kind and size that the block search knows. Errors: MEMORY. */
batten_status net_block_knows(const net_plan *plan, bool *knows);

/* NET_BLOCK_ITERATIONS and those before it. */
void net_block_pack_shape(const net_plan *plan, const net_block_shape *shape, bool alone,
                          int32_t numbers[NET_BLOCK_SHAPE_SIZE]);

/* Pairs of a pole and the one it goes with, by their numbers in turn: shape->followers of them. */
void net_block_pack_followers(const net_plan *plan, int32_t *followers);

/* Tables along u, then along v. */
size_t net_block_table_count(const net_block_shape *shape);
void net_block_pack_tables(const net_plan *plan, const net_block_shape *shape, void *tables);

/* input [BLOCK_INPUT_COUNT][poles] and settings [BLOCK_SETTING_COUNT] of a search. rooms has one a pole. */
void net_block_pack(const net_plan *plan, size_t which, void *input, void *settings,
                    net_room *rooms);

/* Takes a search's end, which stands where its start was, into the plan's y_m and results. */
void net_block_unpack(const net_plan *plan, size_t which, const void *input, const void *outcome);

#endif
