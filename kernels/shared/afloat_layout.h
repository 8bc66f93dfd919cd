/* How a batch of surfaces of one topology and what they measure afloat lie in memory: the same numbers
 * for the host, the C path and the kernel. Value v of lane l is number v * lanes + l. */
#ifndef BATTEN_SHARED_AFLOAT_LAYOUT_H
#define BATTEN_SHARED_AFLOAT_LAYOUT_H

/* Largest order of a basis. */
#define AFLOAT_ORDER_MOST 8

/* The two directions of a surface: along the hull and along the girth. */
#define AFLOAT_U 0
#define AFLOAT_V 1

/* Integers all surfaces share: sizes, then where each table begins. Of each direction u comes first. */
enum {
	AFLOAT_ORDER,                     /* [2] */
	AFLOAT_COUNT = AFLOAT_ORDER + 2,  /* [2] poles */
	AFLOAT_SPANS = AFLOAT_COUNT + 2,  /* [2] that are not empty */
	AFLOAT_POINTS = AFLOAT_SPANS + 2, /* Gauss points of an interval */
	AFLOAT_DRAFTS,
	AFLOAT_DIMENSION,                      /* 3: x, y, z; 4: homogeneous, with the weight */
	AFLOAT_AT_FIRST,                       /* [2], in the list: [spans] first pole of each span */
	AFLOAT_AT_LINES = AFLOAT_AT_FIRST + 2, /* [2]: [spans + 1] knot lines */
	AFLOAT_AT_BASES = AFLOAT_AT_LINES + 2, /* [2]: [spans][power][order], in s = -0.5 .. 0.5 */
	AFLOAT_AT_EDGES = AFLOAT_AT_BASES +
	                  2,                  /* [2]: [spans][2][order], where a span begins and ends */
	AFLOAT_AT_RULE = AFLOAT_AT_EDGES + 2, /* [2][points]: Gauss points over 0..1, weights */
	AFLOAT_AT_DRAFTS,                     /* [drafts] */
	AFLOAT_AT_LENGTH, /* the length between perpendiculars; 0: up to the foremost point */
	AFLOAT_SHAPE_SIZE
};

/* What is known of a surface whatever the draft. */
enum {
	AFLOAT_LOWEST,
	AFLOAT_HIGHEST,
	AFLOAT_AFTMOST,
	AFLOAT_FOREMOST,
	AFLOAT_HALF_BEAM,
	AFLOAT_OUT_COUNT
};

/* And at each draft: sums over the half hull with the normal by_v x by_u as it comes. */
enum {
	AFLOAT_VOLUME_X, /* three forms of one volume */
	AFLOAT_VOLUME_Y,
	AFLOAT_VOLUME_Z,
	AFLOAT_MOMENT_X,
	AFLOAT_MOMENT_Z,
	AFLOAT_PLANE,
	AFLOAT_PLANE_X,
	AFLOAT_PLANE_XX,
	AFLOAT_PLANE_YY,
	AFLOAT_WETTED,
	AFLOAT_TRANSOM,
	AFLOAT_SUM_COUNT,
	AFLOAT_LINE_AFT = AFLOAT_SUM_COUNT, /* of the waterline; AFLOAT_NONE where there is none */
	AFLOAT_LINE_FORE,
	AFLOAT_LINE_HALF_BREADTH,
	AFLOAT_MIDSHIP, /* AFLOAT_NONE where the hull does not reach */
	AFLOAT_LARGEST,
	AFLOAT_FORM_COUNT
};

/* No such number: -AFLOAT_FAR of the kernel. */
#define AFLOAT_NONE (-1e30)

/* Numbers known of a surface. */
#define AFLOAT_OUTCOME(drafts) (AFLOAT_OUT_COUNT + (drafts)*AFLOAT_FORM_COUNT)
/* Room of a work-item: a row of poles with its derivative, bounds of the spans. */
#define AFLOAT_ROW(count_u, count_v) (8 * ((count_u) > (count_v) ? (count_u) : (count_v)))
#define AFLOAT_ROOM(count_u, count_v) (AFLOAT_ROW(count_u, count_v) + 2 * ((count_u) + (count_v)))

#endif
