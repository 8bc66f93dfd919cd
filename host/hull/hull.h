/* What a hull is inside: an offset table with a mask, line ends off the grid, profile points and
 * knuckles. Metres, frame ap-fwd. */
#ifndef BATTEN_HULL_HULL_H
#define BATTEN_HULL_HULL_H

#include "core/context.h"

/* Lengths beyond these are refused, so that no difference quotient of a hull can overflow. */
#define HULL_LARGEST_M 1e6
#define HULL_SMALLEST_STEP_M 1e-9

enum {
	HULL_LINES_MOST = 4096, /* stations, waterlines, points of a line, profile points, knuckles */
	HULL_TEXT_MOST = 4000,  /* bytes of a name, source or label */
};

typedef enum hull_unit { HULL_UNIT_M, HULL_UNIT_MM, HULL_UNIT_FT } hull_unit;
typedef enum hull_frame {
	HULL_FRAME_AP_FWD,    /* origin AP, baseline; x forward, z up: the frame inside */
	HULL_FRAME_MID_FWD,   /* origin amidships, baseline; x forward */
	HULL_FRAME_FP_AFT,    /* origin FP, baseline; x aft */
	HULL_FRAME_GHS,       /* origin amidships, baseline; x aft (starboard positive: half kept) */
	HULL_FRAME_WATERLINE, /* origin amidships, waterline at the draft; x forward */
} hull_frame;
typedef enum hull_layout {
	HULL_LAYOUT_GRID,            /* table of waterlines against stations */
	HULL_LAYOUT_LONG_WATERLINES, /* rows waterline,z,x,y */
	HULL_LAYOUT_LONG_STATIONS,   /* rows station,x,z,y */
} hull_layout;

/* A point of one waterline (or section) that is not on the grid. */
typedef struct hull_line_end {
	bool on_waterline; /* else on a station */
	size_t line;       /* waterline or station number */
	double along_m;    /* x on a waterline, z on a station */
	double y_m;
} hull_line_end;

typedef enum hull_profile_kind {
	HULL_PROFILE_STEM,
	HULL_PROFILE_STERN,
	HULL_PROFILE_KEEL,
	HULL_PROFILE_DECK,
} hull_profile_kind;
typedef struct hull_profile_point {
	hull_profile_kind kind;
	double x_m, y_m, z_m;
} hull_profile_point;

typedef struct hull_knuckle {
	bool on_waterline; /* the line it breaks: a waterline, else a station */
	double x_m, z_m;
} hull_knuckle;

struct batten_hull {
	batten_context *context; /* whose memory it is */
	char *name, *source;     /* never NULL */
	hull_unit unit;
	hull_frame frame;
	hull_layout layout;
	double lbp_m, draft_m, depth_m; /* depth NaN when not given */
	size_t station_count, waterline_count;
	double *x_m, *z_m; /* ascending */
	double *y_m;       /* [waterline][station]; 0 outside, filled where unknown */
	uint8_t *nodes;    /* batten_node, as y_m */
	char **labels;     /* long layouts: label of each waterline (station), else NULL */
	size_t end_count, profile_count, knuckle_count;
	hull_line_end *ends; /* sorted by on_waterline, line, along */
	hull_profile_point *profile;
	hull_knuckle *knuckles; /* sorted by on_waterline, line, place along it; on the line exactly */
};

/* A hull without name, source, labels or points, all nodes outside. NULL when memory is out. */
batten_hull *hull_allocate(batten_context *context, size_t station_count, size_t waterline_count);

/* A copy of a name, source or label as the offsets file can carry it: without blanks around it and
 * without commas at its end. *out NULL when it is too long, not UTF-8 or has control characters:
 * USAGE. */
batten_status hull_clean_text(batten_context *context, const char *text, size_t length, char **out);

/* Number of leading bytes that are UTF-8 text without control characters (tabs allowed). */
size_t hull_text_length(const char *text, size_t length);

/* One line of a hull as points in ascending order. */
typedef struct hull_line {
	size_t count;
	double *along_m; /* x or z */
	double *value_m; /* half-breadth */
	/* grid number along the line of each point (station or waterline), SIZE_MAX off the grid */
	size_t *place;
	/* 1 where empty cells of a grid lie between the point before and this one: no difference is
	 * taken across. Lines of long layouts, whose points are listed, have none. */
	uint8_t *gap;
} hull_line;

/* Points of a waterline (or section): nodes given (with_unknown: filled '?' too), line ends, and
 * the profile points that lie on it. Released by hull_line_release. */
batten_status hull_line_collect(const batten_hull *hull, bool waterline, size_t line,
                                bool with_unknown, hull_line *out);
void hull_line_release(const batten_hull *hull, hull_line *line);

/* Fills the '?' nodes from the given ones (batten.h, BATTEN_NODE_UNKNOWN), never below 0. *filled
 * gets their number. Errors: INPUT (a node whose waterline and section have fewer than two given
 * points each; nothing is filled), MEMORY. */
batten_status hull_fill_unknown(batten_hull *hull, size_t *filled);

/* Node number of the first '?' that cannot be filled, or SIZE_MAX. Errors: MEMORY. */
batten_status hull_find_unfillable(const batten_hull *hull, size_t *node);

/* Puts a knuckle on the line it names: false when there is no such line. */
bool hull_knuckle_snap(const batten_hull *hull, hull_knuckle *knuckle);
void hull_knuckle_sort(batten_hull *hull);

/* True between along a and along b (a < b) of a line when a knuckle of that line lies in (a, b) or
 * at either end. */
bool hull_knuckle_between(const batten_hull *hull, bool waterline, size_t line, double a, double b);

size_t hull_node_count(const batten_hull *hull);

/* The widest node that is given, 0 without one. */
double hull_widest_node_m(size_t count, const uint8_t *nodes, const double *y_m);

/* Whether both have the same stations and waterlines, to the bit. */
bool hull_same_table(const batten_hull *a, const batten_hull *b);
const char *hull_unit_text(hull_unit unit);
const char *hull_frame_text(hull_frame frame);

/* Number of the station at x (waterline at z) within 1e-9 of the length (depth) of the table, or
 * SIZE_MAX. */
size_t hull_station_at(const batten_hull *hull, double x_m);
size_t hull_waterline_at(const batten_hull *hull, double z_m);

#endif
