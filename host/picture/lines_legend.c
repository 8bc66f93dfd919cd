#include "picture/lines_page.h"

#include "core/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LISTED_LIMIT = 8 };

static bool same_table(const batten_hull *a, const batten_hull *b)
{
	if (a->station_count != b->station_count || a->waterline_count != b->waterline_count)
		return false;
	return memcmp(a->x_m, b->x_m, a->station_count * sizeof *a->x_m) == 0 &&
	       memcmp(a->z_m, b->z_m, a->waterline_count * sizeof *a->z_m) == 0;
}

bool lines_page_moved(const lines_page *page, size_t n, moved_point *out)
{
	const batten_hull *before = page->before;
	const batten_hull *after = page->after;
	if (!before || !same_table(before, after))
		return false;
	double least = lines_moved_part * batten_hull_half_beam_m(before) * (1.0 + 1e-9);
	for (size_t node = 0; node < hull_node_count(after); node++) {
		if (before->nodes[node] != BATTEN_NODE_GIVEN || after->nodes[node] != BATTEN_NODE_GIVEN ||
		    !(fabs(after->y_m[node] - before->y_m[node]) > least))
			continue;
		if (n-- > 0)
			continue;
		*out = (moved_point){ node % after->station_count, node / after->station_count,
			                  before->y_m[node], after->y_m[node] };
		return true;
	}
	return false;
}

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

static double draw_moved(const lines_page *page, double left, double y)
{
	moved_point point;
	size_t count = 0;
	while (lines_page_moved(page, count, &point))
		count++;
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
	for (size_t n = 0; n < LISTED_LIMIT && lines_page_moved(page, n, &point); n++) {
		char x[BATTEN_NUMBER_SIZE], z[BATTEN_NUMBER_SIZE];
		char from[BATTEN_NUMBER_SIZE], to[BATTEN_NUMBER_SIZE];
		const lines_box *box = &page->box;
		lines_page_number(page->after->x_m[point.station], box->x_high - box->x_low, x, sizeof x);
		lines_page_number(page->after->z_m[point.waterline], box->z_high - box->z_low, z, sizeof z);
		lines_page_number(point.from_m, box->half_beam, from, sizeof from);
		lines_page_number(point.to_m, box->half_beam, to, sizeof to);
		(void)snprintf(line, sizeof line, "x %s, z %s: y %s \u2192 %s", x, z, from, to);
		y += 27.0;
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
