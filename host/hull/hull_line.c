/* The lines of a hull: a waterline or a section as points in ascending order. */
#include "hull/hull.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------------------------------------
 * Places on the grid
 * --------------------------------------------------------------------------------------------- */

static double tolerance(const double *values, size_t count)
{
	return 1e-9 * (values[count - 1] - values[0]);
}

/* Number of values below value, in ascending values. */
static size_t count_below(const double *values, size_t count, double value)
{
	size_t low = 0;
	size_t high = count;
	while (low < high) {
		size_t middle = low + (high - low) / 2;
		if (values[middle] < value)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

static size_t nearest_within(const double *values, size_t count, double value)
{
	size_t above = count_below(values, count, value);
	size_t nearest = SIZE_MAX;
	double distance = tolerance(values, count);
	if (above < count && values[above] - value <= distance) {
		nearest = above;
		distance = values[above] - value;
	}
	if (above > 0 && value - values[above - 1] <= distance)
		nearest = above - 1;
	return nearest;
}

size_t hull_station_at(const batten_hull *hull, double x_m)
{
	return nearest_within(hull->x_m, hull->station_count, x_m);
}

size_t hull_waterline_at(const batten_hull *hull, double z_m)
{
	return nearest_within(hull->z_m, hull->waterline_count, z_m);
}

/* ------------------------------------------------------------------------------------------------
 * Points of a line
 * --------------------------------------------------------------------------------------------- */

/* A line ends by on_waterline, then line: number of ends before those of the line. */
static size_t ends_before(const batten_hull *hull, bool waterline, size_t line)
{
	size_t low = 0;
	size_t high = hull->end_count;
	while (low < high) {
		size_t middle = low + (high - low) / 2;
		const hull_line_end *end = &hull->ends[middle];
		bool before = end->on_waterline != waterline ? !end->on_waterline : end->line < line;
		if (before)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

static void add_point(hull_line *line, double along, double value, size_t place)
{
	line->along_m[line->count] = along;
	line->value_m[line->count] = value;
	line->place[line->count] = place;
	line->count++;
}

/* Puts a point off the grid where it belongs; a point that is there already stays as it is. */
static void insert_point(hull_line *line, double along, double value, double same)
{
	size_t at = count_below(line->along_m, line->count, along);
	if (at < line->count && line->along_m[at] - along <= same)
		return;
	if (at > 0 && along - line->along_m[at - 1] <= same)
		return;
	size_t moved = line->count - at;
	memmove(line->along_m + at + 1, line->along_m + at, moved * sizeof *line->along_m);
	memmove(line->value_m + at + 1, line->value_m + at, moved * sizeof *line->value_m);
	memmove(line->place + at + 1, line->place + at, moved * sizeof *line->place);
	line->along_m[at] = along;
	line->value_m[at] = value;
	line->place[at] = SIZE_MAX;
	line->count++;
}

/* Grid nodes and line ends, merged. */
static void add_listed_points(const batten_hull *hull, bool waterline, size_t line,
                              bool with_unknown, size_t first_end, size_t end_count, hull_line *out)
{
	const double *along = waterline ? hull->x_m : hull->z_m;
	size_t count = waterline ? hull->station_count : hull->waterline_count;
	size_t next = first_end;
	size_t last = first_end + end_count;
	for (size_t i = 0; i < count; i++) {
		size_t node = waterline ? line * hull->station_count + i : i * hull->station_count + line;
		for (; next < last && hull->ends[next].along_m < along[i]; next++)
			add_point(out, hull->ends[next].along_m, hull->ends[next].y_m, SIZE_MAX);
		if (hull->nodes[node] == BATTEN_NODE_GIVEN ||
		    (with_unknown && hull->nodes[node] == BATTEN_NODE_UNKNOWN))
			add_point(out, along[i], hull->y_m[node], i);
	}
	for (; next < last; next++)
		add_point(out, hull->ends[next].along_m, hull->ends[next].y_m, SIZE_MAX);
}

static void add_profile_points(const batten_hull *hull, bool waterline, size_t line, hull_line *out)
{
	const double *grid = waterline ? hull->x_m : hull->z_m;
	double same = waterline ? tolerance(hull->x_m, hull->station_count)
	                        : tolerance(hull->z_m, hull->waterline_count);
	for (size_t i = 0; i < hull->profile_count; i++) {
		const hull_profile_point *point = &hull->profile[i];
		size_t on = waterline ? hull_waterline_at(hull, point->z_m)
		                      : hull_station_at(hull, point->x_m);
		if (on != line)
			continue;
		double along = waterline ? point->x_m : point->z_m;
		size_t at = waterline ? hull_station_at(hull, along) : hull_waterline_at(hull, along);
		insert_point(out, at != SIZE_MAX ? grid[at] : along, point->y_m, same);
	}
}

/* A gap is an empty cell strictly between two neighbouring points of the line. */
static void mark_gaps(const batten_hull *hull, bool waterline, size_t line, hull_line *out)
{
	bool listed = waterline ? hull->layout == HULL_LAYOUT_LONG_WATERLINES
	                        : hull->layout == HULL_LAYOUT_LONG_STATIONS;
	if (listed)
		return;
	const double *along = waterline ? hull->x_m : hull->z_m;
	size_t count = waterline ? hull->station_count : hull->waterline_count;
	size_t i = 0;
	for (size_t p = 0; p < out->count; p++) {
		for (; i < count && along[i] < out->along_m[p]; i++) {
			size_t node = waterline ? line * hull->station_count + i
			                        : i * hull->station_count + line;
			if (p > 0 && along[i] > out->along_m[p - 1] && hull->nodes[node] == BATTEN_NODE_OUTSIDE)
				out->gap[p] = 1;
		}
	}
}

batten_status hull_line_collect(const batten_hull *hull, bool waterline, size_t line,
                                bool with_unknown, hull_line *out)
{
	*out = (hull_line){ 0 };
	size_t first_end = ends_before(hull, waterline, line);
	size_t end_count = ends_before(hull, waterline, line + 1) - first_end;
	size_t most = (waterline ? hull->station_count : hull->waterline_count) + end_count +
	              hull->profile_count;
	out->along_m = batten_allocate(hull->context, most, sizeof *out->along_m);
	out->value_m = batten_allocate(hull->context, most, sizeof *out->value_m);
	out->place = batten_allocate(hull->context, most, sizeof *out->place);
	out->gap = batten_allocate(hull->context, most, sizeof *out->gap);
	if (!out->along_m || !out->value_m || !out->place || !out->gap) {
		hull_line_release(hull, out);
		return BATTEN_MEMORY;
	}
	add_listed_points(hull, waterline, line, with_unknown, first_end, end_count, out);
	add_profile_points(hull, waterline, line, out);
	mark_gaps(hull, waterline, line, out);
	return BATTEN_OK;
}

void hull_line_release(const batten_hull *hull, hull_line *line)
{
	batten_release(hull->context, line->along_m);
	batten_release(hull->context, line->value_m);
	batten_release(hull->context, line->place);
	batten_release(hull->context, line->gap);
	*line = (hull_line){ 0 };
}

/* ------------------------------------------------------------------------------------------------
 * Knuckles
 * --------------------------------------------------------------------------------------------- */

static double knuckle_line(const hull_knuckle *knuckle)
{
	return knuckle->on_waterline ? knuckle->z_m : knuckle->x_m;
}

static double knuckle_along(const hull_knuckle *knuckle)
{
	return knuckle->on_waterline ? knuckle->x_m : knuckle->z_m;
}

static int compare_knuckles(const void *a, const void *b)
{
	const hull_knuckle *p = a;
	const hull_knuckle *q = b;
	if (p->on_waterline != q->on_waterline)
		return p->on_waterline ? 1 : -1;
	if (knuckle_line(p) != knuckle_line(q))
		return knuckle_line(p) < knuckle_line(q) ? -1 : 1;
	if (knuckle_along(p) != knuckle_along(q))
		return knuckle_along(p) < knuckle_along(q) ? -1 : 1;
	return 0;
}

bool hull_knuckle_snap(const batten_hull *hull, hull_knuckle *knuckle)
{
	size_t line = knuckle->on_waterline ? hull_waterline_at(hull, knuckle->z_m)
	                                    : hull_station_at(hull, knuckle->x_m);
	if (line == SIZE_MAX)
		return false;
	if (knuckle->on_waterline)
		knuckle->z_m = hull->z_m[line];
	else
		knuckle->x_m = hull->x_m[line];
	return true;
}

void hull_knuckle_sort(batten_hull *hull)
{
	if (hull->knuckle_count > 1)
		qsort(hull->knuckles, hull->knuckle_count, sizeof *hull->knuckles, compare_knuckles);
}

bool hull_knuckle_between(const batten_hull *hull, bool waterline, size_t line, double a, double b)
{
	if (hull->knuckle_count == 0)
		return false;
	double same = waterline ? tolerance(hull->x_m, hull->station_count)
	                        : tolerance(hull->z_m, hull->waterline_count);
	hull_knuckle wanted = { .on_waterline = waterline };
	wanted.x_m = waterline ? a - same : hull->x_m[line];
	wanted.z_m = waterline ? hull->z_m[line] : a - same;
	size_t low = 0;
	size_t high = hull->knuckle_count;
	while (low < high) {
		size_t middle = low + (high - low) / 2;
		if (compare_knuckles(&hull->knuckles[middle], &wanted) < 0)
			low = middle + 1;
		else
			high = middle;
	}
	if (low == hull->knuckle_count)
		return false;
	const hull_knuckle *found = &hull->knuckles[low];
	return found->on_waterline == waterline && knuckle_line(found) == knuckle_line(&wanted) &&
	       knuckle_along(found) <= b + same;
}
