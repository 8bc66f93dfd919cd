/* The lines of a hull as pieces between knuckles and gaps, every point by its place in the state of a
 * fairing pass: the nodes of the table, then the line ends off it, then profile points as constants. */
#ifndef BATTEN_FAIRING_PASS_LINES_H
#define BATTEN_FAIRING_PASS_LINES_H

#include "hull/hull.h"

typedef struct pass_piece {
	size_t line;         /* waterline or station */
	size_t first, count; /* of the points */
} pass_piece;

/* All pieces of one direction with two points or more. */
typedef struct pass_lines {
	batten_context *context;
	size_t piece_count, point_count;
	pass_piece *pieces;
	double *along_m;
	size_t *place; /* in the state */
} pass_lines;

/* Values of a hull: nodes and line ends. */
size_t pass_value_count(const batten_hull *hull);
/* Most constants its lines need. */
size_t pass_constant_count(const batten_hull *hull);

/* Collects waterlines or sections; profile points take the next constants, counted in *constant_count.
 * Errors: INPUT (a profile point behind the end of its line), MEMORY. */
batten_status pass_lines_collect(const batten_hull *hull, bool waterlines, double *constants,
                                 size_t *constant_count, pass_lines *out);

/* A single line of count points as one piece whose places are 0..count-1. */
batten_status pass_lines_single(batten_context *context, size_t count, const double *along,
                                pass_lines *out);
void pass_lines_release(pass_lines *lines);

#endif
