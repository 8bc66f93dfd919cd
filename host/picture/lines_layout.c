/* Where the plans of a lines plan lie, and what they show of the two hulls. */
#include "picture/lines_page.h"

#include <math.h>

const double lines_moved_part = 0.01;

/* Lines of one kind drawn at most. */
enum { LINE_LIMIT = 50 };

bool lines_page_moved(const lines_page *page, size_t node)
{
	if (!page->compared || page->before->nodes[node] != BATTEN_NODE_GIVEN ||
	    page->after->nodes[node] != BATTEN_NODE_GIVEN)
		return false;
	double least = lines_moved_part * page->box.half_beam * (1.0 + 1e-9);
	return fabs(page->after->y_m[node] - page->before->y_m[node]) > least;
}

lines_box lines_box_empty(void)
{
	return (lines_box){ INFINITY, -INFINITY, INFINITY, -INFINITY, 0.0 };
}

batten_status lines_box_add(const batten_hull *hull, lines_box *box)
{
	for (int kind = 0; kind < 2; kind++) {
		size_t count = kind ? hull->waterline_count : hull->station_count;
		for (size_t k = 0; k < count; k++) {
			bool any = false;
			line_ends ends;
			batten_status status = lines_find_ends(hull, kind == 1, k, &any, &ends);
			if (status != BATTEN_OK)
				return status;
			if (!any)
				continue;
			double *low = kind ? &box->x_low : &box->z_low;
			double *high = kind ? &box->x_high : &box->z_high;
			*low = fmin(*low, ends.first_m);
			*high = fmax(*high, ends.last_m);
		}
	}
	box->half_beam = fmax(box->half_beam, batten_hull_half_beam_m(hull));
	return BATTEN_OK;
}

static void place_body_plan(lines_page *page)
{
	const lines_box *box = &page->box;
	picture_rectangle frame = { 100.0, 150.0, 840.0, 410.0 };
	double height = fmax(box->z_high - box->z_low, 1e-9);
	double breadth = fmax(box->half_beam, 1e-9);
	double scale = fmin(frame.width / (2.0 * breadth), frame.height / height);
	double middle = frame.left + 0.5 * frame.width;
	double bottom = frame.top + 0.5 * (frame.height + height * scale);
	page->fore = (lines_plan){ frame, middle, bottom + box->z_low * scale, scale, scale };
	page->aft = page->fore;
	page->aft.across = -scale;
}

/* A plan with x to the right; what goes up may be drawn larger, a whole number of times. */
static lines_plan place_long_plan(const lines_box *box, picture_rectangle frame, double low,
                                  double high)
{
	double length = fmax(box->x_high - box->x_low, 1e-9);
	double tall = fmax(high - low, 1e-9);
	double scale = fmin(frame.width / length, frame.height / tall);
	double times = fmax(1.0, fmin(4.0, floor(frame.height / (tall * scale))));
	double middle = 0.5 * (box->x_low + box->x_high);
	return (lines_plan){
		.frame = frame,
		.origin_x = frame.left + 0.5 * frame.width - middle * scale,
		.origin_y = frame.top + 0.5 * (frame.height + tall * times * scale) + low * times * scale,
		.across = scale,
		.up = times * scale,
	};
}

batten_status lines_page_lay_out(lines_page *page)
{
	page->box = lines_box_empty();
	batten_status status = lines_box_add(page->after, &page->box);
	if (status == BATTEN_OK && page->before)
		status = lines_box_add(page->before, &page->box);
	if (status != BATTEN_OK)
		return status;
	lines_box *box = &page->box;
	if (!(box->x_low <= box->x_high && box->z_low <= box->z_high))
		return batten_fail(page->context, BATTEN_INPUT, "%s: no point to draw", page->after->name);
	page->compared = page->before && hull_same_table(page->before, page->after);
	page->station_stride = 1 + page->after->station_count / (LINE_LIMIT + 1);
	page->waterline_stride = 1 + page->after->waterline_count / (LINE_LIMIT + 1);
	place_body_plan(page);
	page->half = place_long_plan(box, (picture_rectangle){ 100.0, 655.0, 1440.0, 265.0 }, 0.0,
	                             box->half_beam);
	page->profile = place_long_plan(box, (picture_rectangle){ 100.0, 1015.0, 1440.0, 165.0 },
	                                box->z_low, box->z_high);
	return BATTEN_OK;
}
