/* Body of host/reference/net_block_f64.c and _f32.c, compiled once per precision: the includer defines
 * BATTEN_DOUBLE and NET_BLOCK_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#define BATTEN_LANES 1
#include "shared/dialect.h"

#include "reference/inlined.h"
#define NET_FAIRNESS (s->fairness)
#define NET_ORDER_U (s->order_u)
#define NET_ORDER_V (s->order_v)
#define NET_POINTS_U (s->points_u)
#define NET_POINTS_V (s->points_v)
#include "shared/net_block_tables.h"
/* The course last: it calls these. */
#include "shared/block_lanes.h"

INLINED void work_search(const reference_net_block *shared, const scalar *tables, scalar *input,
                         const scalar *settings, scalar *outcome, scalar *scratch)
{
	const int32_t *shape = shared->shape;
	const int nodes = shape[NET_BLOCK_COLUMNS] * shape[NET_BLOCK_ROWS];
	const int count_u = shape[NET_BLOCK_COUNT_U], count_v = shape[NET_BLOCK_COUNT_V];
	const size_t places = (size_t)nodes;
	const scalar *table_v = tables + count_u * NET_TABLE_SIZE(shared->order_u);
	scalar *rows = scratch + BLOCK_STATE_COUNT * places;
	scalar *bottom = rows + (size_t)shape[NET_BLOCK_BAND] * places;
	scalar *samples = bottom + places;
	scalar *work = samples + NET_BLOCK_SAMPLE * (size_t)count_u * (size_t)count_v;
	scalar *sums = work + (size_t)shape[NET_BLOCK_SLOTS] *
	                          (size_t)NET_BLOCK_LINE_NUMBERS(shape[NET_BLOCK_COLUMNS],
	                                                         shared->order_u, shared->points_u);
	scalar *terms = sums + BLOCK_SUM_COUNT * shape[NET_BLOCK_COLUMNS];
	const block_state s = {
		.lines = shape[NET_BLOCK_COLUMNS],
		.length = shape[NET_BLOCK_ROWS],
		.nodes = nodes,
		.count_u = count_u,
		.count_v = count_v,
		.band = shape[NET_BLOCK_BAND],
		.slots = shape[NET_BLOCK_SLOTS],
		.followers = shape[NET_BLOCK_FOLLOWERS],
		.fairness = shared->fairness,
		.order_u = shared->order_u,
		.order_v = shared->order_v,
		.points_u = shared->points_u,
		.points_v = shared->points_v,
		.first_u = shared->first_u,
		.first_v = shared->first_v,
		.follower = shared->follower,
		.table_u = tables,
		.table_v = table_v,
		.arrays = scratch,
		.rows = rows,
		.bottom = bottom,
		.samples = samples,
		.work = work,
		.sums = sums,
		.terms = terms,
	};
	const block_memory m = { .inputs = input,
		                     .ends = input,
		                     .settings = settings,
		                     .outcomes = outcome,
		                     .lanes = terms + count_v };
	block_queue q = { .next = 0, .end = 1 };
	block_run(&s, &m, &q, shape[NET_BLOCK_ITERATIONS]);
}

WITH_FMA_WHERE_THERE_IS(NET_BLOCK_FUNCTION, work_search,
                        (const reference_net_block *shared, const scalar *tables, scalar *input,
                         const scalar *settings, scalar *outcome, scalar *scratch),
                        (shared, tables, input, settings, outcome, scratch))
