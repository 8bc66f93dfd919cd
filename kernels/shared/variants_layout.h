/* How a batch of hulls on one table lies in memory: the same numbers for the host, the C path and the
 * kernel. A hull is a row of parameters of a parent, or the half-breadths themselves. Value v of lane
 * l is number v * lanes + l. N is the number of nodes, waterlines times stations. */
#ifndef BATTEN_SHARED_VARIANTS_LAYOUT_H
#define BATTEN_SHARED_VARIANTS_LAYOUT_H

/* What becomes of the parent (VARIANTS_METHOD). */
#define VARIANTS_GIVEN 0 /* no parent: half-breadths are given */
#define VARIANTS_SWING 1
#define VARIANTS_HALVES 2 /* one minus prismatic, Lackenby */

/* Integers all hulls share: sizes, then where each table begins. */
enum {
	VARIANTS_STATIONS,
	VARIANTS_WATERLINES,
	VARIANTS_DRAFTS, /* asked for; the draft of the targets is one more, the last */
	VARIANTS_METHOD,
	VARIANTS_ONCE,        /* 1: one pass of the formulas */
	VARIANTS_TURNS,       /* most trials of a row; 0 to work them off however long */
	VARIANTS_BEFORE_BODY, /* stations before the parallel body of the parent */
	VARIANTS_WITHIN_BODY, /* stations within it; that amidships, where there is no body */
	VARIANTS_LISTED,      /* 1: points listed, so that empty cells are no gap */
	VARIANTS_AT_X,        /* [stations] */
	VARIANTS_AT_Z,        /* [2][waterlines]: places, inverse distances to the next */
	VARIANTS_AT_ENDS,     /* [waterlines][4]: aft x y, fore x y of ends off the table, or NONE */
	VARIANTS_AT_NODES,    /* [N]: VARIANTS_NODE_... */
	VARIANTS_AT_PARENT,   /* [N]: its half-breadths */
	VARIANTS_AT_MIDDLE,   /* [waterlines]: half-breadth amidships */
	VARIANTS_AT_SHIFT,    /* [stations][3]: what the level and the linear term move; 1 fore */
	VARIANTS_AT_FORMULA,  /* VARIANTS_FORMULA_... */
	VARIANTS_AT_DRAFTS, /* [drafts + 1][4]: draft, waterline at or below it, part of the way up, near */
	VARIANTS_AT_SECTIONS, /* [drafts + 1][waterlines][3][waterlines]: see variants_forms.h */
	VARIANTS_AT_BENDS,    /* [waterlines][4][waterlines]: eliminated rows of a section's spline */
	VARIANTS_AT_RULES, /* [drafts + 1][5][7]: Gauss points of a whole interval, of each draft's */
	VARIANTS_SHAPE_SIZE
};

/* Lists of a waterline with '?' nodes, at lists[waterline] (0: none of them): number of known stations,
 * these; number of unknown ones, and of each its station and the known one before it, by number. */

/* When a node of a variant is a point of the hull beside those with y > 0 (host/variation/sections.c). */
#define VARIANTS_NODE_BESIDE 1 /* next to a positive one, or below it */
#define VARIANTS_NODE_ALWAYS 2
#define VARIANTS_NODE_UNKNOWN 4 /* added: '?', filled again */

/* No such length. */
#define VARIANTS_NONE 1e30

/* Numbers of the formulas (host/variation/shift.c): each half has its own. */
enum {
	VARIANTS_HALF_PARALLEL,
	VARIANTS_HALF_LENGTH,
	VARIANTS_HALF_FULLNESS,
	VARIANTS_HALF_LEVER,       /* of its change of fullness */
	VARIANTS_HALF_BODY_LEVER,  /* of its change of parallel body */
	VARIANTS_HALF_BY_FULLNESS, /* level = by_fullness * change + by_body * body */
	VARIANTS_HALF_BY_BODY,
	VARIANTS_HALF_LINEAR, /* linear = linear * (change - level * (1 - fullness)) */
	VARIANTS_HALF_COUNT
};
enum {
	VARIANTS_FORMULA_AFT = 0,
	VARIANTS_FORMULA_FORE = VARIANTS_HALF_COUNT,
	VARIANTS_FORMULA_FULLNESS = 2 * VARIANTS_HALF_COUNT,
	VARIANTS_FORMULA_CENTRE,
	VARIANTS_FORMULA_MIDDLE,      /* x amidships, of the span */
	VARIANTS_FORMULA_LEAST_BODY,  /* a shorter parallel body is none */
	VARIANTS_FORMULA_ALWAYS_BODY, /* 1: the parent has a parallel body */
	VARIANTS_FORMULA_SWING,       /* factor of a swing by one percent */
	VARIANTS_FORMULA_SLOPE_LEAST, /* of the curve that swings, for one metre of factor */
	VARIANTS_FORMULA_SLOPE_MOST,
	VARIANTS_FORMULA_LEAST,     /* half-breadths below are rounding */
	VARIANTS_FORMULA_LENGTH,    /* LBP */
	VARIANTS_FORMULA_AMIDSHIPS, /* x amidships, of LBP */
	VARIANTS_FORMULA_PARENT_CP,
	VARIANTS_FORMULA_PARENT_LCB,
	VARIANTS_FORMULA_NEAR, /* two x are the same within this */
	VARIANTS_FORMULA_COUNT
};

/* What a row asks for. */
enum {
	VARIANTS_ASK_FULLNESS, /* percent of Cp */
	VARIANTS_ASK_CENTRE,   /* percent of LBP */
	VARIANTS_ASK_BODY_AFT, /* parts of the half */
	VARIANTS_ASK_BODY_FORE,
	VARIANTS_ASK_COUNT
};

/* How it ended. */
#define VARIANTS_END_GOOD 0
#define VARIANTS_END_FOLDED 1     /* no trial gave a hull */
#define VARIANTS_END_MISSED 2     /* the iteration came to nothing */
#define VARIANTS_END_UNFINISHED 3 /* out of turns */
#define VARIANTS_END_IRREGULAR 4  /* a hull with gaps, which the host takes */

/* What is known of a hull at a draft, as struct hydrostatics of the host. */
enum {
	VARIANTS_VOLUME,
	VARIANTS_MOMENT_X,
	VARIANTS_MOMENT_Z,
	VARIANTS_WETTED,
	VARIANTS_TRANSOM,
	VARIANTS_MIDSHIP, /* NONE where no section stands amidships */
	VARIANTS_LARGEST,
	VARIANTS_WATERLINE_LENGTH, /* NONE where there is no waterline */
	VARIANTS_WATERLINE_BREADTH,
	VARIANTS_PLANE_AREA,
	VARIANTS_PLANE_MOMENT,
	VARIANTS_PLANE_TRANSVERSE,
	VARIANTS_PLANE_LONGITUDINAL,
	VARIANTS_FORM_COUNT
};

/* What is known of a row, before its forms at each draft. */
enum {
	VARIANTS_OUT_END,
	VARIANTS_OUT_TURNS,
	VARIANTS_OUT_OFF, /* largest residual */
	VARIANTS_OUT_CP,
	VARIANTS_OUT_LCB,
	VARIANTS_OUT_HALF_BEAM,
	VARIANTS_OUT_COUNT
};

/* Of a station at a draft, while it is worked. */
enum {
	VARIANTS_PART_AREA, /* both sides; below 0: dry */
	VARIANTS_PART_MOMENT,
	VARIANTS_PART_GIRTH,
	VARIANTS_PART_BREADTH,
	VARIANTS_PART_COUNT
};

/* Rows of room for one line: places, inverse widths, pivots, factors, values, second derivatives; of rows that
 * are not-a-knot what eliminates the one below and what their right side is scaled by. */
enum {
	VARIANTS_LINE_AT,
	VARIANTS_LINE_STEP,
	VARIANTS_LINE_PIVOT,
	VARIANTS_LINE_FACTOR,
	VARIANTS_LINE_VALUE,
	VARIANTS_LINE_BEND,
	VARIANTS_LINE_BELOW,
	VARIANTS_LINE_SCALE,
	VARIANTS_LINE_ROWS
};

/* Reals of a group's room, without those of its work-items: half-breadths, nodes, bends (then slopes),
 * ends of waterlines, where sections begin, where the hull's edge is, parts of stations, moved
 * stations, flags of lines that are irregular, forms. */
#define VARIANTS_SLOTS(stations) ((stations) + 2)
#define VARIANTS_ROOM(stations, waterlines, drafts)                                                \
	(2 * (waterlines) * (stations) + (waterlines)*VARIANTS_SLOTS(stations) + 4 * (waterlines) +    \
	 2 * (stations) + ((drafts) + 1) * VARIANTS_PART_COUNT * (stations) +                          \
	 4 * VARIANTS_SLOTS(stations) + (waterlines) + (stations) +                                    \
	 ((drafts) + 1) * (1 + VARIANTS_FORM_COUNT))
/* Reals of a work-item. */
#define VARIANTS_ITEM_SLOTS(stations, waterlines)                                                  \
	((stations) > (waterlines) ? VARIANTS_SLOTS(stations) : VARIANTS_SLOTS(waterlines))
#define VARIANTS_ITEM_ROOM(stations, waterlines)                                                   \
	(VARIANTS_LINE_ROWS * VARIANTS_ITEM_SLOTS(stations, waterlines))

#endif
