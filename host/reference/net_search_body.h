/* Body of host/reference/net_search_f64.c and _f32.c, compiled once per precision: the includer
 * defines BATTEN_DOUBLE and NET_SEARCH_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#include "shared/dialect.h"

#include "reference/inlined.h"
#define NET_FAIRNESS (s->fairness)
#define NET_ORDER_U (s->order_u)
#define NET_ORDER_V (s->order_v)
#include "shared/net_energy.h"
/* The objective first: moves call it. */
#define SEARCH_WAYS NET_WAYS
#include "shared/search_ways.h"
/* The course last: it calls the pattern move. */
#include "shared/search_driver.h"

INLINED void work_search(const reference_net_search *shared, const scalar *tables,
                         const scalar *heights, const scalar *samples, scalar *arrays,
                         const scalar *settings, scalar *outcome, scalar *kept, scalar *scratch)
{
	const int32_t *shape = shared->shape;
	const int nodes = shape[NET_SHAPE_COLUMNS] * shape[NET_SHAPE_ROWS];
	scalar *sums = scratch + NET_STATE_COUNT * (size_t)nodes;
	const search_state s = {
		.nodes = nodes,
		.columns = shape[NET_SHAPE_COLUMNS],
		.lines = shape[NET_SHAPE_LINES],
		.length = shape[NET_SHAPE_LENGTH],
		.colour_count = shape[NET_SHAPE_COLOURS],
		.order_u = shared->order_u,
		.order_v = shared->order_v,
		.fairness = shared->fairness,
		.y = scratch,
		.base = scratch + nodes,
		.trial = scratch + 2 * (size_t)nodes,
		.lower = arrays + NET_ARRAY_LOWER * nodes,
		.upper = arrays + NET_ARRAY_UPPER * nodes,
		.first_u = shared->first_u,
		.first_v = shared->first_v,
		.table_u = tables,
		.table_v = tables + shape[NET_SHAPE_LENGTH] * NET_TABLE_SIZE(shared->order_u),
		.colours = shared->colours,
		.directions = shared->directions,
		.members = shared->members,
		.heights = heights,
		.samples = samples,
		.moves = scratch + 2 * (size_t)nodes,
		.ways = scratch + 4 * (size_t)nodes,
		.sums = sums,
		.gathered = sums + shape[NET_SHAPE_LINES],
		.kept = kept,
		.rounding = settings[NET_SETTING_ROUNDING],
	};
	search_run(&s, shape[NET_SHAPE_ITERATIONS], settings, arrays, outcome);
}

WITH_FMA_WHERE_THERE_IS(NET_SEARCH_FUNCTION, work_search,
                        (const reference_net_search *shared, const scalar *tables,
                         const scalar *heights, const scalar *samples, scalar *arrays,
                         const scalar *settings, scalar *outcome, scalar *kept, scalar *scratch),
                        (shared, tables, heights, samples, arrays, settings, outcome, kept,
                         scratch))
