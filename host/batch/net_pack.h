/* Searches over control nets packed lane by lane, in the precision of the plan: what a device or the
 * C path reads and writes. Value v of lane l is number v * lanes + l. */
#ifndef BATTEN_BATCH_NET_PACK_H
#define BATTEN_BATCH_NET_PACK_H

#include "batch/net_plan.h"

void net_pack_shape(const net_plan *plan, int32_t shape[NET_SHAPE_SIZE]);

/* Tables along u, then along v; heights of the members. */
size_t net_pack_table_count(const net_plan *plan);
void net_pack_tables(const net_plan *plan, void *tables);
void net_pack_heights(const net_plan *plan, void *heights);

/* Numbers of one search's samples. */
size_t net_pack_sample_count(const net_plan *plan);

/* Numbers kept of one search's samples while it goes on. */
size_t net_pack_kept_count(const net_plan *plan);

/* Writes search `which` into a lane of samples, arrays [NET_ARRAY_COUNT][poles][lanes] and settings
 * [NET_SETTING_COUNT][lanes], all zero before. A lane left at zero is idle. rooms has one a pole. */
void net_pack(const net_plan *plan, size_t which, size_t lane, size_t lanes, void *samples,
              void *arrays, void *settings, net_room *rooms);

/* A number as it is packed. */
double net_pack_rounded(const net_plan *plan, double value);

/* Takes where the leader of a pole of a search ended, its way from the target as it is packed, into the plan's
 * y_m. */
void net_pack_take(const net_plan *plan, size_t which, size_t pole, double way);

/* Takes a lane's end into the plan's y_m and results. */
void net_unpack(const net_plan *plan, size_t which, size_t lane, size_t lanes, const void *y,
                const void *outcome, net_room *rooms);

#endif
