#include "picture/lines_page.h"

#include "core/number.h"

#include <math.h>
#include <stdio.h>

const paper_ink lines_ink_after = { 0.08, 0.20, 0.36 };
const paper_ink lines_ink_before = { 0.96, 0.66, 0.45 };
const paper_ink lines_ink_grid = { 0.84, 0.86, 0.88 };
const paper_ink lines_ink_text = { 0.27, 0.30, 0.34 };
const paper_ink lines_ink_moved = { 0.80, 0.10, 0.10 };

static const double label_size = 16.0;

/* Rings drawn at most. */
enum { RING_LIMIT = 200 };

/* True when place is at least gap away from the last label; then it becomes the last. */
static bool has_room(double *last, double place, double gap)
{
	if (fabs(place - *last) < gap)
		return false;
	*last = place;
	return true;
}

void lines_page_number(double value_m, double extent_m, char *out, size_t size)
{
	char number[BATTEN_NUMBER_SIZE];
	double power = pow(10.0, 4.0 - floor(log10(fmax(extent_m, 1e-9))));
	double rounded = round(value_m * power) / power;
	(void)snprintf(out, size, "%s", batten_number_write(number, rounded + 0.0));
}

void lines_page_text(const lines_page *page, double x, double y, double size, paper_anchor anchor,
                     const char *text)
{
	paper_text style = { .x = x, .y = y, .size = size, .anchor = anchor, .ink = lines_ink_text };
	paper_write(page->cairo, &style, text);
}

/* ------------------------------------------------------------------------------------------------
 * Grids and labels
 * --------------------------------------------------------------------------------------------- */

static void set_ink(const lines_page *page, paper_ink ink, double width)
{
	cairo_set_source_rgb(page->cairo, ink.red, ink.green, ink.blue);
	cairo_set_line_width(page->cairo, width);
	cairo_set_line_cap(page->cairo, CAIRO_LINE_CAP_BUTT);
}

static void trace_segment(const lines_page *page, double x1, double y1, double x2, double y2)
{
	cairo_move_to(page->cairo, x1, y1);
	cairo_line_to(page->cairo, x2, y2);
}

/* Horizontal lines at the waterlines with their heights on the left. */
static void draw_heights(const lines_page *page, const lines_plan *plan, double left, double right)
{
	const batten_hull *hull = page->after;
	double last = -INFINITY;
	for (size_t j = 0; j < hull->waterline_count; j += page->waterline_stride) {
		double y = plan->origin_y - plan->up * hull->z_m[j];
		set_ink(page, lines_ink_grid, 0.8);
		trace_segment(page, left, y, right, y);
		cairo_stroke(page->cairo);
		char number[BATTEN_NUMBER_SIZE];
		lines_page_number(hull->z_m[j], page->box.z_high - page->box.z_low, number, sizeof number);
		if (has_room(&last, y, 18.0))
			lines_page_text(page, left - 8.0, y + 5.5, label_size, PAPER_RIGHT, number);
	}
}

/* Vertical lines at the stations with their places below. */
static void draw_stations(const lines_page *page, const lines_plan *plan, double top, double bottom)
{
	const batten_hull *hull = page->after;
	double last = -INFINITY;
	for (size_t i = 0; i < hull->station_count; i += page->station_stride) {
		double x = plan->origin_x + plan->across * hull->x_m[i];
		set_ink(page, lines_ink_grid, 0.8);
		trace_segment(page, x, top, x, bottom);
		cairo_stroke(page->cairo);
		char number[BATTEN_NUMBER_SIZE];
		lines_page_number(hull->x_m[i], page->box.x_high - page->box.x_low, number, sizeof number);
		if (has_room(&last, x, 62.0))
			lines_page_text(page, x, bottom + 20.0, label_size, PAPER_CENTRE, number);
	}
}

static void draw_caption(const lines_page *page, const lines_plan *plan, double y, const char *text)
{
	lines_page_text(page, plan->frame.left + 0.5 * plan->frame.width, y, 20.0, PAPER_CENTRE, text);
}

static void draw_ring(const lines_page *page, double x, double y)
{
	set_ink(page, lines_ink_moved, 2.0);
	cairo_new_sub_path(page->cairo);
	cairo_arc(page->cairo, x, y, 9.0, 0.0, 6.283185307179586);
	cairo_stroke(page->cairo);
}

/* ------------------------------------------------------------------------------------------------
 * Body plan
 * --------------------------------------------------------------------------------------------- */

/* The station nearest to amidships of those drawn: it is drawn on both sides. */
static size_t midship_station(const lines_page *page, const batten_hull *hull)
{
	size_t best = 0;
	for (size_t i = 0; i < hull->station_count; i += page->station_stride)
		if (fabs(hull->x_m[i] - 0.5 * hull->lbp_m) < fabs(hull->x_m[best] - 0.5 * hull->lbp_m))
			best = i;
	return best;
}

static batten_status draw_sections(const lines_page *page, const batten_hull *hull,
                                   const lines_style *style)
{
	size_t middle = midship_station(page, hull);
	batten_status status = BATTEN_OK;
	for (size_t i = 0; status == BATTEN_OK && i < hull->station_count; i += page->station_stride) {
		if (i >= middle)
			status = lines_draw_line(page->cairo, hull, false, i, &page->fore, style);
		if (status == BATTEN_OK && i <= middle)
			status = lines_draw_line(page->cairo, hull, false, i, &page->aft, style);
	}
	return status;
}

/* The place of each section, at its upper end, from the end of the ship towards amidships. */
static batten_status label_sections(const lines_page *page, bool fore)
{
	const batten_hull *hull = page->after;
	size_t middle = midship_station(page, hull);
	size_t count = fore ? hull->station_count - middle : middle + 1;
	const lines_plan *plan = fore ? &page->fore : &page->aft;
	double last = -INFINITY;
	for (size_t k = 0; k < count; k++) {
		size_t i = fore ? hull->station_count - 1 - k : k;
		if (i % page->station_stride != 0)
			continue;
		bool any = false;
		line_ends ends;
		batten_status status = lines_find_ends(hull, false, i, &any, &ends);
		if (status != BATTEN_OK)
			return status;
		double x = plan->origin_x + plan->across * ends.last_y_m;
		if (!any || fabs(x - plan->origin_x) < 24.0 || !has_room(&last, x, 62.0))
			continue;
		char number[BATTEN_NUMBER_SIZE];
		lines_page_number(hull->x_m[i], page->box.x_high - page->box.x_low, number, sizeof number);
		double y = plan->origin_y - plan->up * ends.last_m;
		lines_page_text(page, x, y - 12.0, label_size, PAPER_CENTRE, number);
	}
	return BATTEN_OK;
}

static void ring_sections(const lines_page *page)
{
	const batten_hull *hull = page->after;
	size_t middle = midship_station(page, hull);
	size_t rings = 0;
	for (size_t node = 0; node < hull_node_count(hull) && rings < RING_LIMIT; node++) {
		if (!lines_page_moved(page, node))
			continue;
		size_t station = node % hull->station_count;
		double y = page->fore.origin_y - page->fore.up * hull->z_m[node / hull->station_count];
		const lines_plan *plan = station >= middle ? &page->fore : &page->aft;
		draw_ring(page, plan->origin_x + plan->across * hull->y_m[node], y);
		if (station == middle)
			draw_ring(page, page->aft.origin_x + page->aft.across * hull->y_m[node], y);
		rings++;
	}
}

static batten_status draw_body_plan(const lines_page *page)
{
	const lines_plan *plan = &page->fore;
	const lines_box *box = &page->box;
	double half = box->half_beam * plan->across;
	double bottom = plan->origin_y - plan->up * box->z_low;
	double top = plan->origin_y - plan->up * box->z_high;
	draw_heights(page, plan, plan->origin_x - half, plan->origin_x + half);
	set_ink(page, lines_ink_text, 1.0);
	trace_segment(page, plan->origin_x, top - 30.0, plan->origin_x, bottom);
	cairo_stroke(page->cairo);
	lines_style pale = { lines_ink_before, 3.4, 0.0 };
	lines_style dark = { lines_ink_after, 1.1, 3.6 };
	batten_status status = BATTEN_OK;
	if (page->before)
		status = draw_sections(page, page->before, &pale);
	if (status == BATTEN_OK)
		status = draw_sections(page, page->after, &dark);
	if (status == BATTEN_OK)
		status = label_sections(page, true);
	if (status == BATTEN_OK)
		status = label_sections(page, false);
	ring_sections(page);
	draw_caption(
		page, plan, bottom + 44.0,
		"body plan: fore sections right, aft left, midship on both; x above, z left, in m");
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * Half-breadth plan
 * --------------------------------------------------------------------------------------------- */

static batten_status draw_waterlines(const lines_page *page, const batten_hull *hull,
                                     const lines_style *style)
{
	batten_status status = BATTEN_OK;
	for (size_t j = 0; status == BATTEN_OK && j < hull->waterline_count;
	     j += page->waterline_stride)
		status = lines_draw_line(page->cairo, hull, true, j, &page->half, style);
	return status;
}

static bool station_has_ring(const lines_page *page, size_t station)
{
	for (size_t j = 0; j < page->after->waterline_count; j++)
		if (lines_page_moved(page, j * page->after->station_count + station))
			return true;
	return false;
}

static void ring_waterlines(const lines_page *page)
{
	const batten_hull *hull = page->after;
	const lines_plan *plan = &page->half;
	size_t rings = 0;
	for (size_t node = 0; node < hull_node_count(hull) && rings < RING_LIMIT; node++) {
		if (!lines_page_moved(page, node))
			continue;
		draw_ring(page, plan->origin_x + plan->across * hull->x_m[node % hull->station_count],
		          plan->origin_y - plan->up * hull->y_m[node]);
		rings++;
	}
}

/* The station to write the waterlines' heights at: where they lie far apart, about four fifths of
 * the way forward, and no ring is in the way. */
static size_t label_station(const lines_page *page)
{
	const batten_hull *hull = page->after;
	double wished = page->box.x_low + 0.82 * (page->box.x_high - page->box.x_low);
	size_t best = SIZE_MAX;
	for (size_t i = 0; i < hull->station_count; i++)
		if (!station_has_ring(page, i) &&
		    (best == SIZE_MAX || fabs(hull->x_m[i] - wished) < fabs(hull->x_m[best] - wished)))
			best = i;
	return best;
}

/* The height of some waterlines, written on the lines themselves. */
static void label_waterlines(const lines_page *page)
{
	const batten_hull *hull = page->after;
	const lines_plan *plan = &page->half;
	size_t station = label_station(page);
	if (station == SIZE_MAX)
		return;
	double x = plan->origin_x + plan->across * hull->x_m[station];
	double last = INFINITY;
	for (size_t j = 0; j < hull->waterline_count; j += page->waterline_stride) {
		size_t node = j * hull->station_count + station;
		double y = plan->origin_y - plan->up * hull->y_m[node];
		if (hull->nodes[node] == BATTEN_NODE_OUTSIDE || !has_room(&last, y, 24.0))
			continue;
		char number[BATTEN_NUMBER_SIZE];
		char text[BATTEN_NUMBER_SIZE + 8];
		lines_page_number(hull->z_m[j], page->box.z_high - page->box.z_low, number, sizeof number);
		(void)snprintf(text, sizeof text, "z %s", number);
		cairo_text_extents_t extents;
		cairo_set_font_size(page->cairo, 14.0);
		cairo_text_extents(page->cairo, text, &extents);
		cairo_set_source_rgb(page->cairo, 1.0, 1.0, 1.0);
		cairo_rectangle(page->cairo, x - 0.5 * extents.x_advance - 3.0, y - 8.0,
		                extents.x_advance + 6.0, 16.0);
		cairo_fill(page->cairo);
		lines_page_text(page, x, y + 5.0, 14.0, PAPER_CENTRE, text);
	}
}

static batten_status draw_half_breadths(const lines_page *page)
{
	const lines_plan *plan = &page->half;
	double top = plan->origin_y - plan->up * page->box.half_beam;
	draw_stations(page, plan, top, plan->origin_y);
	set_ink(page, lines_ink_text, 1.0);
	trace_segment(page, plan->origin_x + plan->across * page->box.x_low, plan->origin_y,
	              plan->origin_x + plan->across * page->box.x_high, plan->origin_y);
	cairo_stroke(page->cairo);
	lines_style pale = { lines_ink_before, 3.4, 0.0 };
	lines_style dark = { lines_ink_after, 1.1, 3.6 };
	batten_status status = BATTEN_OK;
	if (page->before)
		status = draw_waterlines(page, page->before, &pale);
	if (status == BATTEN_OK)
		status = draw_waterlines(page, page->after, &dark);
	label_waterlines(page);
	ring_waterlines(page);
	char caption[160];
	double times = plan->up / plan->across;
	if (times > 1.5)
		(void)snprintf(caption, sizeof caption,
		               "half-breadth plan: waterlines, half-breadths \u00d7 %d; x in m",
		               (int)lround(times));
	else
		(void)snprintf(caption, sizeof caption, "half-breadth plan: waterlines; x in m");
	draw_caption(page, plan, plan->origin_y + 48.0, caption);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * Profile
 * --------------------------------------------------------------------------------------------- */

/* Adds the first (or last) points of the lines to the outline, from the lowest line up or down. */
static batten_status trace_ends(const lines_page *page, bool first, bool upward)
{
	const batten_hull *hull = page->after;
	const lines_plan *plan = &page->profile;
	bool waterlines = hull->layout != HULL_LAYOUT_LONG_STATIONS;
	size_t count = waterlines ? hull->waterline_count : hull->station_count;
	for (size_t n = 0; n < count; n++) {
		size_t k = upward ? n : count - 1 - n;
		bool any = false;
		line_ends ends;
		batten_status status = lines_find_ends(hull, waterlines, k, &any, &ends);
		if (status != BATTEN_OK)
			return status;
		if (!any)
			continue;
		double along = first ? ends.first_m : ends.last_m;
		double x = waterlines ? along : hull->x_m[k];
		double z = waterlines ? hull->z_m[k] : along;
		cairo_line_to(page->cairo, plan->origin_x + plan->across * x,
		              plan->origin_y - plan->up * z);
	}
	return BATTEN_OK;
}

/* Down along the first points of the lines, up along their last ones. */
static batten_status draw_outline(const lines_page *page)
{
	cairo_new_path(page->cairo);
	batten_status status = trace_ends(page, true, false);
	if (status == BATTEN_OK)
		status = trace_ends(page, false, true);
	cairo_close_path(page->cairo);
	set_ink(page, lines_ink_after, 1.8);
	cairo_set_line_join(page->cairo, CAIRO_LINE_JOIN_ROUND);
	cairo_stroke(page->cairo);
	return status;
}

static void draw_draft(const lines_page *page)
{
	const lines_plan *plan = &page->profile;
	double y = plan->origin_y - plan->up * page->after->draft_m;
	double left = plan->origin_x + plan->across * page->box.x_low;
	double right = plan->origin_x + plan->across * page->box.x_high;
	const double dashes[] = { 10.0, 6.0 };
	set_ink(page, (paper_ink){ 0.15, 0.45, 0.75 }, 1.5);
	cairo_set_dash(page->cairo, dashes, 2, 0.0);
	trace_segment(page, left, y, right + 18.0, y);
	cairo_stroke(page->cairo);
	cairo_set_dash(page->cairo, NULL, 0, 0.0);
	lines_page_text(page, right + 22.0, y + 6.0, label_size, PAPER_LEFT, "T");
}

static batten_status draw_profile(const lines_page *page)
{
	const lines_plan *plan = &page->profile;
	const lines_box *box = &page->box;
	double bottom = plan->origin_y - plan->up * box->z_low;
	draw_stations(page, plan, plan->origin_y - plan->up * box->z_high, bottom);
	draw_heights(page, plan, plan->origin_x + plan->across * box->x_low,
	             plan->origin_x + plan->across * box->x_high);
	draw_draft(page);
	batten_status status = draw_outline(page);
	for (size_t i = 0; i < page->after->profile_count; i++) {
		const hull_profile_point *point = &page->after->profile[i];
		double x = plan->origin_x + plan->across * point->x_m;
		double y = plan->origin_y - plan->up * point->z_m;
		set_ink(page, lines_ink_after, 5.0);
		cairo_set_line_cap(page->cairo, CAIRO_LINE_CAP_ROUND);
		trace_segment(page, x, y, x, y);
		cairo_stroke(page->cairo);
	}
	char caption[160];
	double times = plan->up / plan->across;
	if (times > 1.5)
		(void)snprintf(caption, sizeof caption,
		               "profile: ends of the table, bow to the right, heights \u00d7 %d; x, z in m",
		               (int)lround(times));
	else
		(void)snprintf(caption, sizeof caption,
		               "profile: ends of the table, bow to the right; x, z in m");
	draw_caption(page, plan, bottom + 48.0, caption);
	return status;
}

batten_status lines_page_draw_plans(const lines_page *page)
{
	batten_status status = draw_body_plan(page);
	if (status == BATTEN_OK)
		status = draw_half_breadths(page);
	if (status == BATTEN_OK)
		status = draw_profile(page);
	return status;
}
