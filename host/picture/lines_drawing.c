#include "picture/lines_drawing.h"

#include "picture/surface_lines.h"

#include <math.h>

/* A line and how it comes on paper. Of very many points only every so manieth is drawn. */
enum { POINT_LIMIT = 512 };
typedef struct drawn_line {
	const batten_hull *hull;
	const hull_line *points;
	bool waterline;
	const lines_plan *plan;
	size_t stride;
} drawn_line;

typedef struct paper_point {
	double x, y;
} paper_point;

static paper_point point_of(const drawn_line *line, size_t i)
{
	double along = line->points->along_m[i];
	double breadth = line->points->value_m[i];
	const lines_plan *plan = line->plan;
	double right = line->waterline ? along : breadth;
	double high = line->waterline ? breadth : along;
	return (paper_point){ plan->origin_x + plan->across * right, plan->origin_y - plan->up * high };
}

static double distance(paper_point a, paper_point b)
{
	return hypot(b.x - a.x, b.y - a.y);
}

/* Direction of the curve at b between a and c, a vector per unit of length: that of the parabola
 * through the three with the chords' lengths as parameter. It does not mind vertical tangents, as
 * at the keel of a full section. */
static paper_point direction_at(paper_point a, paper_point b, paper_point c)
{
	double before = distance(a, b);
	double after = distance(b, c);
	if (before <= 0.0 || after <= 0.0)
		return (paper_point){ 0.0, 0.0 };
	double wa = after / (before * (before + after));
	double wc = before / (after * (before + after));
	return (paper_point){ wa * (b.x - a.x) + wc * (c.x - b.x),
		                  wa * (b.y - a.y) + wc * (c.y - b.y) };
}

/* Direction at the end a of the chord a-b, given that at b: the same parabola. */
static paper_point direction_at_end(paper_point a, paper_point b, paper_point at_b)
{
	double length = distance(a, b);
	if (length <= 0.0)
		return (paper_point){ 0.0, 0.0 };
	return (paper_point){ 2.0 * (b.x - a.x) / length - at_b.x,
		                  2.0 * (b.y - a.y) / length - at_b.y };
}

static size_t step_from(const drawn_line *line, size_t i, size_t last)
{
	return last - i < line->stride ? last : i + line->stride;
}

/* The curve through points first..last, without holes. */
static void trace_run(cairo_t *cairo, const drawn_line *line, size_t first, size_t last)
{
	paper_point here = point_of(line, first);
	cairo_move_to(cairo, here.x, here.y);
	paper_point direction = { 0.0, 0.0 };
	for (size_t i = first; i < last;) {
		size_t next_i = step_from(line, i, last);
		paper_point next = point_of(line, next_i);
		double length = distance(here, next);
		if (i == first && next_i == last) {
			cairo_line_to(cairo, next.x, next.y);
			return;
		}
		paper_point at_next = { 0.0, 0.0 };
		if (next_i < last)
			at_next = direction_at(here, next, point_of(line, step_from(line, next_i, last)));
		else
			at_next = direction_at_end(here, next, direction);
		if (i == first)
			direction = direction_at_end(here, next, at_next);
		double third = length / 3.0;
		cairo_curve_to(cairo, here.x + third * direction.x, here.y + third * direction.y,
		               next.x - third * at_next.x, next.y - third * at_next.y, next.x, next.y);
		here = next;
		direction = at_next;
		i = next_i;
	}
}

static void draw_curves(cairo_t *cairo, const drawn_line *line, const lines_style *style)
{
	size_t first = 0;
	for (size_t i = 0; i < line->points->count; i++) {
		bool last = i + 1 == line->points->count;
		if (!last && !picture_hole_after(line->hull, line->points, i))
			continue;
		if (i > first)
			trace_run(cairo, line, first, i);
		first = i + 1;
	}
	cairo_set_line_width(cairo, style->width);
	cairo_stroke(cairo);
}

/* Dots are strokes of no length with round ends: few bytes each in an SVG. */
static void draw_points(cairo_t *cairo, const drawn_line *line, size_t number,
                        const lines_style *style)
{
	for (size_t i = 0; i < line->points->count; i++) {
		size_t place = line->points->place[i];
		size_t stations = line->hull->station_count;
		if (place != SIZE_MAX) {
			size_t node = line->waterline ? number * stations + place : place * stations + number;
			if (line->hull->nodes[node] != BATTEN_NODE_GIVEN)
				continue;
		}
		paper_point at = point_of(line, i);
		cairo_move_to(cairo, at.x, at.y);
		cairo_line_to(cairo, at.x, at.y);
	}
	cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_width(cairo, style->points);
	cairo_stroke(cairo);
}

batten_status lines_draw_line(cairo_t *cairo, const batten_hull *hull, bool waterline,
                              size_t number, const lines_plan *plan, const lines_style *style)
{
	hull_line points = { 0 };
	batten_status status = hull_line_collect(hull, waterline, number, true, &points);
	if (status != BATTEN_OK)
		return status;
	drawn_line line = { hull, &points, waterline, plan, 1 + points.count / (POINT_LIMIT + 1) };
	cairo_set_source_rgb(cairo, style->ink.red, style->ink.green, style->ink.blue);
	cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
	if (points.count > 0) {
		draw_curves(cairo, &line, style);
		if (style->points > 0.0 && line.stride == 1)
			draw_points(cairo, &line, number, style);
	}
	hull_line_release(hull, &points);
	return BATTEN_OK;
}

batten_status lines_find_ends(const batten_hull *hull, bool waterline, size_t line, bool *any,
                              line_ends *ends)
{
	hull_line points = { 0 };
	batten_status status = hull_line_collect(hull, waterline, line, true, &points);
	if (status != BATTEN_OK)
		return status;
	*any = points.count > 0;
	if (*any) {
		size_t last = points.count - 1;
		*ends = (line_ends){ points.along_m[0], points.value_m[0], points.along_m[last],
			                 points.value_m[last] };
	}
	hull_line_release(hull, &points);
	return BATTEN_OK;
}
