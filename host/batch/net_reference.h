/* Searches over control nets on the plain C path, in the layout of host/batch. */
#ifndef BATTEN_BATCH_NET_REFERENCE_H
#define BATTEN_BATCH_NET_REFERENCE_H

#include "batch/net_pack.h"

/* Room for one search at a time in the plan's precision. */
typedef struct net_reference {
	const net_plan *plan;
	void *tables, *heights, *samples, *arrays, *kept, *scratch;
	net_room *rooms;
} net_reference;

batten_status net_reference_create(const net_plan *plan, net_reference *out);
void net_reference_release(net_reference *reference);

/* Runs search number `which` of the plan. */
void net_reference_run(net_reference *reference, size_t which);

#endif
