/* How block searches over control nets lie in memory, beyond block_layout.h: the same numbers for the host, the C
 * path and the kernel. u is the direction of the net with more poles, whatever the surface calls it, so that the
 * table of the parabola is a narrow band: pole k of column i is number i * rows + k. */
#ifndef BATTEN_SHARED_NET_BLOCK_LAYOUT_H
#define BATTEN_SHARED_NET_BLOCK_LAYOUT_H

#include "block_layout.h"
#include "net_layout.h"

/* What all searches of a launch share. */
enum {
	NET_BLOCK_COLUMNS, /* poles along u */
	NET_BLOCK_ROWS,    /* poles along v */
	NET_BLOCK_COUNT_U, /* samples */
	NET_BLOCK_COUNT_V,
	NET_BLOCK_BAND,  /* numbers of a row of the table */
	NET_BLOCK_SLOTS, /* lines of samples kept: of a span where a group is one work-item, or all */
	NET_BLOCK_FOLLOWERS, /* poles that go with another */
	NET_BLOCK_ITERATIONS,
	NET_BLOCK_COUNT,
	NET_BLOCK_SHARE,
	NET_BLOCK_SHAPE_SIZE
};

/* A sample of the surface while a search goes on: derivatives of x and z by u and v; how much y_u and y_v count
 * in n.by_uu, n.by_uv and n.by_vv, n = by_v x by_u; those of the target's y; the weights of both integrals. */
enum {
	NET_BLOCK_XU,
	NET_BLOCK_XV,
	NET_BLOCK_ZU,
	NET_BLOCK_ZV,
	NET_BLOCK_UU, /* of y_u, then of y_v */
	NET_BLOCK_UV = NET_BLOCK_UU + 2,
	NET_BLOCK_VV = NET_BLOCK_UV + 2,
	NET_BLOCK_TARGET = NET_BLOCK_VV + 2,   /* u, v, uu, uv, vv */
	NET_BLOCK_ROOT = NET_BLOCK_TARGET + 5, /* of twice the weight of fairness; 0: no normal */
	NET_BLOCK_CLOSE,
	NET_BLOCK_SAMPLE
};

/* Probes at a sample: the energy, four near by, three far away. */
enum { NET_BLOCK_PROBES = 8 };

/* What they tell of it: how much y_u, y_v, y_uu, y_uv and y_vv, as far as they count, change each of the numbers
 * whose squares the energy is, the last of them first; slopes along these derivatives; slope and curvature of
 * closeness. */
enum {
	NET_BLOCK_LAST,
	NET_BLOCK_MIDDLE = NET_BLOCK_LAST + 5,
	NET_BLOCK_FIRST = NET_BLOCK_MIDDLE + 4,
	NET_BLOCK_SLOPE = NET_BLOCK_FIRST + 3,
	NET_BLOCK_CLOSE_SLOPE = NET_BLOCK_SLOPE + 5,
	NET_BLOCK_CLOSE_CURVATURE,
	NET_BLOCK_PROBED
};

/* The same numbers, changed by a column of poles that a sample sees: by its value, its first and its second
 * derivative by v; and how closeness changes. */
enum {
	NET_BLOCK_COLUMN_LAST,
	NET_BLOCK_COLUMN_MIDDLE = NET_BLOCK_COLUMN_LAST + 3,
	NET_BLOCK_COLUMN_FIRST = NET_BLOCK_COLUMN_MIDDLE + 2,
	NET_BLOCK_COLUMN_CLOSE = NET_BLOCK_COLUMN_FIRST + 2,
	NET_BLOCK_COLUMN_SIZE
};

enum { NET_POINTS_MOST = 16 }; /* samples a span and direction */

/* Numbers of a line that is worked: columns taken together along v; probes of a span and what its columns change;
 * slopes of the columns; pairs of columns. */
#define NET_BLOCK_LINE_NUMBERS(columns, order_u, points_u)                                         \
	(3 * (columns) + NET_BLOCK_PROBED * (points_u) +                                               \
	 NET_BLOCK_COLUMN_SIZE * (points_u) * (order_u) + 3 * (columns) + 9 * (columns) * (order_u))

/* Numbers of a search's state in one lane: of poles, samples, lines that are worked; sums, BLOCK_SUM_COUNT a column and
 * one a line of samples; what lanes say. */
#define NET_BLOCK_STATE_NUMBERS(columns, rows, count_u, count_v, band, slots, order_u, points_u)   \
	((BLOCK_STATE_COUNT + (band) + 1) * (columns) * (rows) +                                       \
	 NET_BLOCK_SAMPLE * (count_u) * (count_v) +                                                    \
	 (slots)*NET_BLOCK_LINE_NUMBERS(columns, order_u, points_u) + BLOCK_SUM_COUNT * (columns) +    \
	 (count_v) + BLOCK_LANE_NUMBERS)

#endif
