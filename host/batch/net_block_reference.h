/* Block searches over control nets on the plain C path: a packed search through the body of each precision. */
#ifndef BATTEN_BATCH_NET_BLOCK_REFERENCE_H
#define BATTEN_BATCH_NET_BLOCK_REFERENCE_H

#include "batch/net_block_pack.h"

/* Room for one search at a time in the plan's precision. */
typedef struct net_block_reference {
	const net_plan *plan;
	net_block_shape shape;
	void *tables, *input, *scratch;
	int32_t *followers;
	net_room *rooms;
} net_block_reference;

batten_status net_block_reference_create(const net_plan *plan, net_block_reference *out);
void net_block_reference_release(net_block_reference *reference);

/* Runs search number `which` of the plan. */
void net_block_reference_run(net_block_reference *reference, size_t which);

#endif
