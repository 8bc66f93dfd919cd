/* Waterlines as the points their splines go through. */
#include "hydrostatics/section.h"
#include "variation/variation.h"

batten_status variation_line_create(batten_context *context, size_t count, variation_line *out)
{
	*out = (variation_line){ 0 };
	out->x_m = batten_allocate(context, count, 2 * sizeof *out->x_m);
	out->breaks = batten_allocate(context, count, 1);
	if (!out->x_m || !out->breaks) {
		variation_line_destroy(context, out);
		return BATTEN_MEMORY;
	}
	out->y_m = out->x_m + count;
	return BATTEN_OK;
}

void variation_line_destroy(batten_context *context, variation_line *line)
{
	batten_release(context, line->x_m);
	batten_release(context, line->breaks);
	*line = (variation_line){ 0 };
}

static void add_point(variation_line *line, double x_m, double y_m)
{
	line->x_m[line->count] = x_m;
	line->y_m[line->count] = y_m;
	line->count++;
}

/* The points of the hull, and the empty cells between and beyond them as 0; beyond an end off the
 * grid there is nothing. Lines of long layouts are their points and nothing else. */
static void take_points(const batten_hull *hull, const hull_line *points, variation_line *line)
{
	const bool listed = hull->layout != HULL_LAYOUT_GRID;
	line->ends_aft = listed || (points->count > 0 && points->place[0] == SIZE_MAX);
	line->ends_fore = listed || (points->count > 0 && points->place[points->count - 1] == SIZE_MAX);
	size_t next = 0;
	for (size_t s = 0; s < hull->station_count; s++) {
		while (next < points->count && points->along_m[next] < hull->x_m[s]) {
			add_point(line, points->along_m[next], points->value_m[next]);
			next++;
		}
		const bool aft = next == 0, fore = next == points->count;
		if (next < points->count && points->place[next] == s) {
			add_point(line, hull->x_m[s], points->value_m[next]);
			next++;
		} else if (!listed && !(aft && line->ends_aft) && !(fore && line->ends_fore)) {
			add_point(line, hull->x_m[s], 0);
		}
	}
	for (; next < points->count; next++)
		add_point(line, points->along_m[next], points->value_m[next]);
}

batten_status variation_line_take(batten_context *context, const batten_hull *hull, size_t number,
                                  variation_line *out)
{
	hull_line points;
	batten_status status = hull_line_collect(hull, true, number, true, &points);
	if (status != BATTEN_OK)
		return status;
	status = variation_line_create(context, points.count + hull->station_count, out);
	if (status == BATTEN_OK) {
		take_points(hull, &points, out);
		section_mark_knuckles(hull, true, number, out->count, out->x_m, out->breaks);
	}
	hull_line_release(hull, &points);
	return status;
}

batten_status variation_line_curve(batten_context *context, const variation_line *line, curve *out)
{
	const batten_status status = curve_create(context, line->count, line->x_m, line->y_m,
	                                          line->breaks, SPLINE_NATURAL, out);
	return status == BATTEN_USAGE ? BATTEN_INPUT : status;
}
