#include "picture/lines_page.h"

#include "core/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LISTED_LIMIT = 8 };

static void draw_header(const lines_page *page)
{
	char title[256];
	paper_clean_text(page->after->name, title, sizeof title);
	paper_text style = { .x = 40.0,
		                 .y = 54.0,
		                 .size = 34.0,
		                 .width = 1500.0,
		                 .bold = true,
		                 .ink = { 0.10, 0.12, 0.15 } };
	paper_write(page->cairo, &style, title);
	char lbp[BATTEN_NUMBER_SIZE];
	char draft[BATTEN_NUMBER_SIZE];
	char line[192];
	(void)snprintf(line, sizeof line, "lines plan \u00b7 L %s m, T %s m \u00b7 frame ap-fwd, m",
	               batten_number_write(lbp, page->after->lbp_m),
	               batten_number_write(draft, page->after->draft_m));
	lines_page_text(page, 40.0, 88.0, 21.0, PAPER_LEFT, line);
}

static void draw_sample(const lines_page *page, double x, double y, paper_ink ink, double width)
{
	cairo_set_source_rgb(page->cairo, ink.red, ink.green, ink.blue);
	cairo_set_line_width(page->cairo, width);
	cairo_set_line_cap(page->cairo, CAIRO_LINE_CAP_BUTT);
	cairo_move_to(page->cairo, x, y - 7.0);
	cairo_line_to(page->cairo, x + 56.0, y - 7.0);
	cairo_stroke(page->cairo);
}

/* Where a moved point lies, from where and to where it moved. */
static void moved_text(const lines_page *page, size_t node, char *out, size_t size)
{
	const lines_box *box = &page->box;
	const batten_hull *after = page->after;
	char x[BATTEN_NUMBER_SIZE], z[BATTEN_NUMBER_SIZE];
	char from[BATTEN_NUMBER_SIZE], to[BATTEN_NUMBER_SIZE];
	lines_page_number(after->x_m[node % after->station_count], box->x_high - box->x_low, x,
	                  sizeof x);
	lines_page_number(after->z_m[node / after->station_count], box->z_high - box->z_low, z,
	                  sizeof z);
	lines_page_number(page->before->y_m[node], box->half_beam, from, sizeof from);
	lines_page_number(after->y_m[node], box->half_beam, to, sizeof to);
	(void)snprintf(out, size, "x %s, z %s: y %s \u2192 %s", x, z, from, to);
}

static double draw_moved(const lines_page *page, double left, double y)
{
	size_t count = 0;
	for (size_t node = 0; page->before && node < hull_node_count(page->after); node++)
		count += lines_page_moved(page, node);
	if (count == 0)
		return y;
	cairo_set_source_rgb(page->cairo, lines_ink_moved.red, lines_ink_moved.green,
	                     lines_ink_moved.blue);
	cairo_set_line_width(page->cairo, 2.0);
	cairo_new_sub_path(page->cairo);
	cairo_arc(page->cairo, left + 28.0, y - 7.0, 9.0, 0.0, 6.283185307179586);
	cairo_stroke(page->cairo);
	char line[256];
	(void)snprintf(line, sizeof line, "moved more than 1 %% of the half-beam: %zu", count);
	lines_page_text(page, left + 70.0, y, 19.0, PAPER_LEFT, line);
	size_t listed = 0;
	for (size_t node = 0; listed < count && listed < LISTED_LIMIT; node++) {
		if (!lines_page_moved(page, node))
			continue;
		listed++;
		y += 27.0;
		moved_text(page, node, line, sizeof line);
		lines_page_text(page, left + 70.0, y, 17.0, PAPER_LEFT, line);
	}
	if (count > LISTED_LIMIT) {
		y += 27.0;
		(void)snprintf(line, sizeof line, "and %zu more", count - LISTED_LIMIT);
		lines_page_text(page, left + 70.0, y, 17.0, PAPER_LEFT, line);
	}
	return y + 34.0;
}

/* A bar of a round length, in the scale of a plan. */
static void draw_scale_bar(const lines_page *page, const lines_plan *plan, double left, double y,
                           double longest, const char *what)
{
	double most = longest / fabs(plan->across);
	double power = pow(10.0, floor(log10(most)));
	double length = most >= 5.0 * power ? 5.0 * power : most >= 2.0 * power ? 2.0 * power : power;
	double wide = length * fabs(plan->across);
	cairo_set_source_rgb(page->cairo, lines_ink_text.red, lines_ink_text.green,
	                     lines_ink_text.blue);
	cairo_set_line_width(page->cairo, 2.0);
	cairo_set_line_cap(page->cairo, CAIRO_LINE_CAP_BUTT);
	cairo_move_to(page->cairo, left, y - 13.0);
	cairo_line_to(page->cairo, left, y - 1.0);
	cairo_move_to(page->cairo, left, y - 7.0);
	cairo_line_to(page->cairo, left + wide, y - 7.0);
	cairo_move_to(page->cairo, left + wide, y - 13.0);
	cairo_line_to(page->cairo, left + wide, y - 1.0);
	cairo_stroke(page->cairo);
	char number[BATTEN_NUMBER_SIZE];
	char line[128];
	lines_page_number(length, length, number, sizeof number);
	(void)snprintf(line, sizeof line, "%s m, %s", number, what);
	lines_page_text(page, left + wide + 14.0, y, 19.0, PAPER_LEFT, line);
}

void lines_page_draw_legend(const lines_page *page)
{
	draw_header(page);
	double left = 1010.0;
	double y = 160.0;
	if (page->before) {
		draw_sample(page, left, y, lines_ink_before, 3.4);
		lines_page_text(page, left + 70.0, y, 19.0, PAPER_LEFT, "before");
		y += 34.0;
	}
	draw_sample(page, left, y, lines_ink_after, 1.1);
	cairo_set_line_cap(page->cairo, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_width(page->cairo, 3.6);
	cairo_move_to(page->cairo, left + 28.0, y - 7.0);
	cairo_line_to(page->cairo, left + 28.0, y - 7.0);
	cairo_stroke(page->cairo);
	lines_page_text(page, left + 70.0, y, 19.0, PAPER_LEFT,
	                page->before ? "after; dots: points of the table"
	                             : "hull; dots: points of the table");
	y = draw_moved(page, left, y + 34.0);
	draw_scale_bar(page, &page->fore, left, y, 180.0, "body plan");
	y += 34.0;
	draw_scale_bar(page, &page->half, left, y, 180.0, "lengthwise below");
}
