/* The block search over control nets, whole searches in one launch: bending or the mean curvature.
 *
 * A work-group works a range of the searches, BATTEN_LANES of them at a time, one a lane of `real`; its work-items
 * share the lines of samples, then the columns of the net. On a CPU: many lanes, one work-item. On a GPU: several
 * searches abreast (dialect.h), many work-items each. Every line and every sum is worked in one fixed order by one
 * work-item, so the shape does not change a bit of the result; the C path is the same source.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, NET_FAIRNESS, NET_ORDER_U, NET_ORDER_V, NET_POINTS_U,
 * NET_POINTS_V; bending of a bicubic net where they are not. */
#if !defined(NET_FAIRNESS)
#define NET_FAIRNESS 0
#define NET_ORDER_U 4
#define NET_ORDER_V 4
#define NET_POINTS_U 4
#define NET_POINTS_V 4
#endif
#define BATTEN_DIALECT_OPENCL
/* The state of a net is more than local memory has. */
#undef STATE
#define STATE global
#undef STATE_IS_GLOBAL
#define STATE_IS_GLOBAL
#include "shared/dialect.h"
/* What is called from several places PoCL would call, and what those places know beforehand, how many rows or pairs are
 * worked together, it would look up. */
#if defined(BATTEN_ALONE)
#undef SHARED_FUNCTION
#define SHARED_FUNCTION static inline __attribute__((always_inline))
#endif
#include "shared/net_block_tables.h"
/* The course last: it calls these. */
#include "shared/block_lanes.h"

/* shape: NET_BLOCK_SHAPE_SIZE numbers. tables: NET_TABLE_SIZE a sample along u, then along v. inputs, settings,
 * outcomes: as block_memory has them. Group g works searches g * share up to count, and so does lane g of all where
 * searches stand abreast; turns[g]: how many iterations its lanes went through. room: NET_BLOCK_STATE_NUMBERS a
 * search. */
kernel void net_block(global const int *shape, global const int *first_u, global const int *first_v,
                      global const int *follower, global const scalar *tables,
                      global const scalar *inputs, global const scalar *settings,
                      global scalar *outcomes, global scalar *ends, global int *turns,
                      global real *room, local int *vote)
{
	const int group = QUEUE_NUMBER;
	block_state s;
	s.lines = shape[NET_BLOCK_COLUMNS];
	s.length = shape[NET_BLOCK_ROWS];
	s.nodes = s.lines * s.length;
	s.count_u = shape[NET_BLOCK_COUNT_U];
	s.count_v = shape[NET_BLOCK_COUNT_V];
	s.band = shape[NET_BLOCK_BAND];
	s.slots = shape[NET_BLOCK_SLOTS];
	s.followers = shape[NET_BLOCK_FOLLOWERS];
	s.first_u = first_u;
	s.first_v = first_v;
	s.follower = follower;
	s.table_u = tables;
	s.table_v = s.table_u + s.count_u * NET_TABLE_SIZE(NET_ORDER_U);
	s.arrays = OWN_STATE(room,
	                     NET_BLOCK_STATE_NUMBERS((size_t)s.lines, s.length, s.count_u, s.count_v,
	                                             s.band, s.slots, NET_ORDER_U, NET_POINTS_U));
	s.rows = s.arrays + BLOCK_STATE_COUNT * s.nodes;
	s.bottom = s.rows + s.band * s.nodes;
	s.samples = s.bottom + s.nodes;
	s.work = s.samples + NET_BLOCK_SAMPLE * (s.count_u * s.count_v);
	s.vote = vote;
	s.sums = s.work + s.slots * NET_BLOCK_LINE_NUMBERS(s.lines, NET_ORDER_U, NET_POINTS_U);
	s.terms = s.sums + BLOCK_SUM_COUNT * s.lines;
	block_memory m;
	m.inputs = inputs;
	m.settings = settings;
	m.outcomes = outcomes;
	m.ends = ends;
	m.ends_apart = s.nodes;
	m.lanes = s.terms + s.count_v;
	block_queue q;
	q.next = group * shape[NET_BLOCK_SHARE];
	q.end = min(q.next + shape[NET_BLOCK_SHARE], shape[NET_BLOCK_COUNT]);
	block_run(&s, &m, &q, shape[NET_BLOCK_ITERATIONS]);
	if (WORK_ITEM == 0)
		turns[group] = q.turns;
}
