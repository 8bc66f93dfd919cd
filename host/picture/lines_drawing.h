/* The lines of a hull drawn on paper: sections, waterlines, their points. */
#ifndef BATTEN_PICTURE_LINES_DRAWING_H
#define BATTEN_PICTURE_LINES_DRAWING_H

#include "hull/hull.h"
#include "picture/paper.h"
#include "picture/view.h"

/* Metres to paper: right of the origin and up from it. */
typedef struct lines_plan {
	picture_rectangle frame; /* what it is drawn in */
	double origin_x, origin_y;
	double across, up; /* units of the paper a metre; across < 0 draws to the left */
} lines_plan;

typedef struct lines_style {
	paper_ink ink;
	double width;  /* of the curves */
	double points; /* diameter of the dots at given points, 0: none */
} lines_style;

/* How one line lies in a plan: its place along runs up (sections) or to the right (waterlines), its
 * half-breadth the other way. */
batten_status lines_draw_line(cairo_t *cairo, const batten_hull *hull, bool waterline,
                              size_t number, const lines_plan *plan, const lines_style *style);

/* The two ends of a line: places and half-breadths. False: it has no point. */
typedef struct line_ends {
	double first_m, first_y_m, last_m, last_y_m;
} line_ends;
batten_status lines_find_ends(const batten_hull *hull, bool waterline, size_t line, bool *any,
                              line_ends *ends);

#endif
