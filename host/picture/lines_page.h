/* The page of a lines plan: body plan, half-breadth plan, profile, legend. */
#ifndef BATTEN_PICTURE_LINES_PAGE_H
#define BATTEN_PICTURE_LINES_PAGE_H

#include "picture/lines_drawing.h"

#define LINES_PAGE_WIDTH 1600.0
#define LINES_PAGE_HEIGHT 1270.0

/* The table's extent. */
typedef struct lines_box {
	double x_low, x_high, z_low, z_high, half_beam;
} lines_box;

typedef struct lines_page {
	batten_context *context;
	cairo_t *cairo;
	const batten_hull *before; /* NULL, or drawn pale under after */
	const batten_hull *after;
	lines_box box;
	lines_plan fore, aft; /* the two sides of the body plan */
	lines_plan half;      /* half-breadth plan */
	lines_plan profile;
	size_t station_stride, waterline_stride; /* of a large table not every line is drawn */
	bool compared;                           /* before and after are on one table */
} lines_page;

extern const paper_ink lines_ink_after, lines_ink_before, lines_ink_grid, lines_ink_text,
	lines_ink_moved;
extern const double lines_moved_part; /* of the half-beam */

/* Nothing, and what a hull's lines add to it, their ends off the table included. Errors: MEMORY. */
lines_box lines_box_empty(void);
batten_status lines_box_add(const batten_hull *hull, lines_box *box);

/* Takes the box and places the plans. Errors: MEMORY, INPUT (no point at all). */
batten_status lines_page_lay_out(lines_page *page);
batten_status lines_page_draw_plans(const lines_page *page);
void lines_page_draw_legend(const lines_page *page);

/* Whether a node's half-breadth moved by more than lines_moved_part; false where the hulls cannot
 * be compared. */
bool lines_page_moved(const lines_page *page, size_t node);

/* A number in shortest form, rounded to a ten-thousandth of the first digit of extent. */
void lines_page_number(double value_m, double extent_m, char *out, size_t size);
void lines_page_text(const lines_page *page, double x, double y, double size, paper_anchor anchor,
                     const char *text);

#endif
