/* The multilevel pattern search over the y of control nets (Hooke and Jeeves; thesis 7.2), whole
 * searches in one launch.
 *
 * A work-group runs BATTEN_LANES searches side by side, one a lane of `real`; its work-items share
 * the directions of each colour. On a CPU: many lanes, one work-item. On a GPU: several searches abreast
 * (dialect.h), many work-items each. Every direction and every sum is worked in one fixed order by one work-item, so the
 * shape does not change a bit of the result.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, STATE (local, or global for nets whose state does
 * not fit local memory), NET_FAIRNESS, NET_ORDER_U, NET_ORDER_V; bending of a bicubic net where they are
 * not. */
#if !defined(NET_FAIRNESS)
#define NET_FAIRNESS 0
#define NET_ORDER_U 4
#define NET_ORDER_V 4
#endif
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/net_energy.h"
/* The objective first: moves call it. */
#define SEARCH_WAYS NET_WAYS
#include "shared/search_ways.h"
/* The course last: it calls the pattern move. */
#include "shared/search_driver.h"

/* shape: NET_SHAPE_SIZE numbers. tables: NET_TABLE_SIZE numbers a sample along u, then along v. samples
 * [group][line][sample][NET_SAMPLE_SIZE], arrays [group][NET_ARRAY_COUNT][poles], settings
 * [group][NET_SETTING_COUNT], outcome [group][SEARCH_OUTCOME_COUNT], kept [group][line][sample][NET_KEPT_SIZE], like
 * the samples too much for local memory, room [group][NET_STATE_NUMBERS], all of real. */
kernel void net_search(global const int *shape, global const int *first_u,
                       global const int *first_v, global const int *colours,
                       global const int *directions, global const int *members,
                       global const scalar *heights, global const scalar *tables,
                       global const real *samples, global real *arrays, global const real *settings,
                       global real *outcome, global real *kept, STATE real *room, local int *vote)
{
	search_state s;
	s.columns = shape[NET_SHAPE_COLUMNS];
	s.nodes = s.columns * shape[NET_SHAPE_ROWS];
	s.length = shape[NET_SHAPE_LENGTH];
	s.lines = shape[NET_SHAPE_LINES];
	s.colour_count = shape[NET_SHAPE_COLOURS];
	s.wide_colours = 0;
	s.wide_probes = SPREAD(LITERAL(0.0));
	global stored *own = OWN_GLOBAL(arrays, NET_ARRAY_COUNT * s.nodes);
	global const stored *set = OWN_GLOBAL(settings, NET_SETTING_COUNT);
	s.y = OWN_STATE(room, NET_STATE_NUMBERS(s.nodes, s.lines, WORK_ITEMS));
	s.base = s.y + s.nodes;
	s.trial = s.y + 2 * s.nodes;
	s.moves = s.trial;
	s.ways = s.y + 4 * s.nodes;
	s.vote = vote;
	s.sums = s.y + NET_STATE_COUNT * s.nodes;
	s.gathered = s.sums + s.lines;
	s.lower = own + NET_ARRAY_LOWER * s.nodes;
	s.upper = own + NET_ARRAY_UPPER * s.nodes;
	s.first_u = first_u;
	s.first_v = first_v;
	s.table_u = tables;
	s.table_v = tables + s.length * NET_TABLE_SIZE(NET_ORDER_U);
	s.colours = colours;
	s.directions = directions;
	s.members = members;
	s.heights = heights;
	s.samples = OWN_GLOBAL(samples, (size_t)(s.lines * s.length) * NET_SAMPLE_NUMBERS);
	s.kept = OWN_GLOBAL(kept, (size_t)(s.lines * s.length) * NET_KEPT_NUMBERS);
	s.rounding = AT(set[NET_SETTING_ROUNDING]);
	search_run(&s, shape[NET_SHAPE_ITERATIONS], set, own,
	           OWN_GLOBAL(outcome, SEARCH_OUTCOME_COUNT));
}
