/* How searches over control nets lie in memory: the same numbers for the host, the C path and the
 * kernel. Value v of lane l is number v * lanes + l. Settings and outcome: search_layout.h. */
#ifndef BATTEN_SHARED_NET_LAYOUT_H
#define BATTEN_SHARED_NET_LAYOUT_H

#include "search_layout.h"

enum { NET_ORDER_MOST = 8 };

/* What is to be low; the numbers of batten_fairness. */
#define NET_FAIRNESS_BENDING 0
#define NET_FAIRNESS_MEAN 1
#define NET_FAIRNESS_GAUSS 2
#define NET_FAIRNESS_VARIATION 3

/* What all searches of a launch share. */
enum {
	NET_SHAPE_COLUMNS, /* poles along u */
	NET_SHAPE_ROWS,    /* poles along v */
	NET_SHAPE_LENGTH,  /* samples along u */
	NET_SHAPE_LINES,   /* samples along v */
	NET_SHAPE_COLOURS,
	NET_SHAPE_ITERATIONS, /* at most */
	NET_SHAPE_SIZE
};

/* Arrays of a search, one value a pole each. */
enum {
	NET_ARRAY_Y, /* the way from the target: small numbers, so that f32 keeps their digits */
	NET_ARRAY_LOWER,
	NET_ARRAY_UPPER,
	NET_ARRAY_COUNT
};

/* Nets of working state: y, base, trial, moves of a second probe and the remembered ways. */
#define NET_STATE_COUNT (4 + NET_WAYS - 1)

/* Numbers of all of it: these, a sum a line of samples, two numbers a work-item. */
#define NET_STATE_NUMBERS(poles, lines, work_items)                                                \
	(NET_STATE_COUNT * (poles) + (lines) + 2 * (work_items))

/* One value a search each, beyond SEARCH_SETTING_COUNT. */
enum {
	NET_SETTING_ROUNDING = SEARCH_SETTING_COUNT, /* e^2 of sqrt(K^2 + e^2) */
	NET_SETTING_COUNT
};

/* One sample of the surface, the same throughout a search: derivatives of x, of z and of the target's
 * y by u, v, uu, uv, vv; then the weights of both integrals; then, where the variation of curvature
 * asks for them, the derivatives by uuu, uuv, uvv, vvv. */
enum {
	NET_SAMPLE_X = 0,
	NET_SAMPLE_Z = 5,
	NET_SAMPLE_TARGET = 10,
	NET_SAMPLE_FAIR = 15,  /* w1, made free of dimension; 0 where the start has no normal */
	NET_SAMPLE_CLOSE = 16, /* w2 |x_u z_v - x_v z_u| / h^4 */
	NET_SAMPLE_SIZE = 17,
	NET_SAMPLE_X_THIRD = 17,
	NET_SAMPLE_Z_THIRD = 21,
	NET_SAMPLE_TARGET_THIRD = 25,
	NET_SAMPLE_SIZE_THIRD = 29
};

/* What is kept of a sample while a search goes on: its term of the objective at y, that of the last probe; the
 * way from the target at y and its derivatives by u, v, uu, uv, vv, and uuu, uuv, uvv, vvv where the variation
 * of curvature asks for them. */
enum {
	NET_KEPT_TERM,
	NET_KEPT_FOUND,
	NET_KEPT_JET,
	NET_KEPT_SIZE = NET_KEPT_JET + 6,
	NET_KEPT_SIZE_THIRD = NET_KEPT_JET + 10
};

/* One sample of a direction in its table: `order` values of the basis and of its first, second and
 * third derivative, and the weight in an integral. */
#define NET_TABLE_SIZE(order) (4 * (order) + 1)

/* One direction of the search: its poles and the samples that see them, lines counted along v. */
enum {
	NET_DIRECTION_FIRST, /* of the members */
	NET_DIRECTION_END,
	NET_DIRECTION_COLUMN, /* the rectangle its poles lie in */
	NET_DIRECTION_COLUMN_END,
	NET_DIRECTION_ROW,
	NET_DIRECTION_ROW_END,
	NET_DIRECTION_LINE,
	NET_DIRECTION_LINE_END,
	NET_DIRECTION_SAMPLE,
	NET_DIRECTION_SAMPLE_END,
	NET_DIRECTION_SIZE
};

#endif
