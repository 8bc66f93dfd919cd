/* The long layouts: one row a point, rows of a line together. Coordinates that two or more lines
 * share become the grid, all other points are line ends (hull.h). */
#include "io/offsets_frame.h"

#include "core/number.h"
#include "io/offsets_parts.h"

#include <stdlib.h>
#include <string.h>

struct point {
	double along_m, y_m;
	size_t line; /* in the order of the file */
	bool unknown;
	size_t file_line, file_column; /* of the half-breadth */
};

struct line {
	char *label;
	struct offsets_coordinate at;
	size_t point_count;
};

/* The table as it grows. */
struct list {
	batten_hull frame;
	bool waterlines; /* else stations */
	size_t cell_count;
	size_t line_count, line_capacity, point_count, point_capacity;
	struct line *lines;
	struct point *points;
	struct offsets_coordinate along; /* of the last point */
	/* coordinates shared by lines, ascending */
	size_t shared_count;
	double *shared_m;
};

static void release_list(batten_context *context, struct list *list)
{
	for (size_t i = 0; i < list->line_count; i++)
		batten_release(context, list->lines[i].label);
	batten_release(context, list->lines);
	batten_release(context, list->points);
	batten_release(context, list->shared_m);
}

/* ------------------------------------------------------------------------------------------------
 * Rows
 * --------------------------------------------------------------------------------------------- */

static batten_status read_heading(struct offsets_scan *scan, struct list *list)
{
	struct offsets_cell cell;
	(void)offsets_next_cell(scan, &cell);
	list->waterlines = offsets_cell_is(&cell, "waterline");
	if (!list->waterlines && !offsets_cell_is(&cell, "station"))
		return offsets_fail(scan, &cell, "the row 'waterline,z,x,y' or 'station,x,z,y'");
	list->cell_count = offsets_count_cells(scan);
	const char *const names[] = { list->waterlines ? "z" : "x", list->waterlines ? "x" : "z", "y" };
	for (size_t i = 0; i < 3; i++) {
		if (!offsets_next_cell(scan, &cell))
			return offsets_fail_at(scan, scan->line, scan->row_length + 1,
			                       "found the end of the row, expected '%s'", names[i]);
		if (!offsets_cell_is(&cell, names[i]))
			return offsets_fail(scan, &cell, "'%s'", names[i]);
	}
	return offsets_expect_no_more(scan);
}

static batten_status begin_line(struct offsets_scan *scan, struct list *list,
                                const struct offsets_cell *label, const struct offsets_cell *at)
{
	const char *what = list->waterlines ? "waterline" : "station";
	struct line *last = list->line_count > 0 ? &list->lines[list->line_count - 1] : NULL;
	struct line line = { 0 };
	batten_status status = offsets_read_coordinate(scan, at, &list->frame, !list->waterlines,
	                                               last ? &last->at : NULL, &line.at);
	if (status != BATTEN_OK)
		return status;
	if (last && label->length > 0 && offsets_cell_is(label, last->label))
		return offsets_fail(scan, label, "another label than that of the %s before", what);
	if (label->length > 0 && label->text[0] == '#')
		return offsets_fail(scan, label, "a label that does not begin as a comment does");
	if (list->line_count == HULL_LINES_MOST)
		return offsets_fail(scan, at, "at most %d %ss", HULL_LINES_MOST, what);
	if (list->line_count == list->line_capacity) {
		size_t capacity = list->line_capacity > 0 ? 2 * list->line_capacity : 32;
		struct line *lines = offsets_grow(scan->context, list->lines, list->line_count, capacity,
		                                  sizeof *lines);
		if (!lines)
			return BATTEN_MEMORY;
		list->lines = lines;
		list->line_capacity = capacity;
	}
	status = offsets_read_text(scan, label, &line.label);
	if (status == BATTEN_OK)
		list->lines[list->line_count++] = line;
	return status;
}

/* Goes on with the last line or begins another. *out is NULL on failure. */
static batten_status choose_line(struct offsets_scan *scan, struct list *list,
                                 const struct offsets_cell *label, const struct offsets_cell *at,
                                 struct line **out)
{
	double value = 0;
	*out = NULL;
	batten_status status = offsets_read_number(
		scan, at, list->waterlines ? "a number for z" : "a number for x", &value);
	if (status != BATTEN_OK)
		return status;
	struct line *last = list->line_count > 0 ? &list->lines[list->line_count - 1] : NULL;
	if (!last || value != last->at.value) {
		status = begin_line(scan, list, label, at);
		if (status == BATTEN_OK && list->line_count > 0)
			*out = &list->lines[list->line_count - 1];
		return status;
	}
	if (!offsets_cell_is(label, last->label))
		return offsets_fail(scan, label, "the label of the row before, which has the same %s",
		                    list->waterlines ? "z" : "x");
	*out = last;
	return BATTEN_OK;
}

static batten_status add_point(struct offsets_scan *scan, struct list *list, struct line *line,
                               const struct offsets_cell *along, const struct offsets_cell *y)
{
	if (line->point_count == HULL_LINES_MOST)
		return offsets_fail(scan, along, "at most %d points on a line", HULL_LINES_MOST);
	batten_status status = offsets_read_coordinate(scan, along, &list->frame, list->waterlines,
	                                               line->point_count > 0 ? &list->along : NULL,
	                                               &list->along);
	if (status != BATTEN_OK)
		return status;
	struct point point = { .along_m = list->along.metres,
		                   .line = list->line_count - 1,
		                   .unknown = offsets_cell_is(y, "?"),
		                   .file_line = scan->line,
		                   .file_column = y->column };
	if (!point.unknown)
		status = offsets_read_half_breadth(scan, y, &list->frame, &point.y_m);
	if (status != BATTEN_OK)
		return status;
	if (list->point_count == list->point_capacity) {
		size_t capacity = list->point_capacity > 0 ? 2 * list->point_capacity : 256;
		struct point *points = offsets_grow(scan->context, list->points, list->point_count,
		                                    capacity, sizeof *points);
		if (!points)
			return BATTEN_MEMORY;
		list->points = points;
		list->point_capacity = capacity;
	}
	list->points[list->point_count++] = point;
	line->point_count++;
	return BATTEN_OK;
}

static batten_status read_rows(struct offsets_scan *scan, struct list *list)
{
	while (offsets_next_row(scan) && !offsets_is_extra(scan)) {
		batten_status status = offsets_check_width(scan, list->cell_count);
		if (status != BATTEN_OK)
			return status;
		struct offsets_cell label, at, along, y;
		(void)offsets_next_cell(scan, &label);
		(void)offsets_next_cell(scan, &at);
		(void)offsets_next_cell(scan, &along);
		(void)offsets_next_cell(scan, &y);
		struct line *line = NULL;
		status = choose_line(scan, list, &label, &at, &line);
		if (line)
			status = add_point(scan, list, line, &along, &y);
		if (status == BATTEN_OK)
			status = offsets_expect_no_more(scan);
		if (status != BATTEN_OK)
			return status;
	}
	if (list->line_count < 2)
		return offsets_fail_at(scan, scan->line, 1, "found %zu line%s up to here, expected 2 to %d",
		                       list->line_count, list->line_count == 1 ? "" : "s", HULL_LINES_MOST);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * The grid
 * --------------------------------------------------------------------------------------------- */

/* No line has a coordinate twice, so what occurs twice occurs on two lines. */
static batten_status find_shared(const struct offsets_scan *scan, struct list *list)
{
	size_t count = list->point_count;
	double *all = batten_allocate(scan->context, count, sizeof *all);
	if (!all)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < count; i++)
		all[i] = list->points[i].along_m;
	qsort(all, count, sizeof *all, batten_number_compare);
	size_t shared = 0;
	for (size_t i = 0; i < count;) {
		size_t next = i + 1;
		while (next < count && all[next] == all[i])
			next++;
		if (next - i >= 2)
			all[shared++] = all[i];
		i = next;
	}
	list->shared_m = all;
	list->shared_count = shared;
	if (shared < 2 || shared > HULL_LINES_MOST)
		return offsets_fail_at(
			scan, scan->line, 1,
			"found %zu values of %s that two lines or more share, expected 2 to %d", shared,
			list->waterlines ? "x" : "z", HULL_LINES_MOST);
	return BATTEN_OK;
}

/* Place of a coordinate in the grid, SIZE_MAX where no other line shares it. */
static size_t find_place(const struct list *list, double along_m)
{
	const double *found = bsearch(&along_m, list->shared_m, list->shared_count,
	                              sizeof *list->shared_m, batten_number_compare);
	return found ? (size_t)(found - list->shared_m) : SIZE_MAX;
}

static batten_status check_spacing(const struct offsets_scan *scan, const struct list *list)
{
	for (size_t i = 1; i < list->shared_count; i++) {
		if (list->shared_m[i] - list->shared_m[i - 1] >= HULL_SMALLEST_STEP_M)
			continue;
		size_t first = 0;
		while (list->points[first].along_m != list->shared_m[i])
			first++;
		return offsets_fail_at(
			scan, list->points[first].file_line, 1,
			"found %.17g m, and %.17g m on another line, expected the same or %g m "
			"between",
			list->shared_m[i], list->shared_m[i - 1], HULL_SMALLEST_STEP_M);
	}
	return BATTEN_OK;
}

/* Number inside of a line of the file: stations turn round where x runs aft. */
static size_t inner_line(const struct list *list, size_t line)
{
	bool mirrored = !list->waterlines && offsets_frame_is_mirrored(list->frame.frame);
	return mirrored ? list->line_count - 1 - line : line;
}

static int compare_ends(const void *a, const void *b)
{
	const hull_line_end *p = a;
	const hull_line_end *q = b;
	if (p->line != q->line)
		return p->line < q->line ? -1 : 1;
	return (p->along_m > q->along_m) - (p->along_m < q->along_m);
}

static batten_status place_points(const struct offsets_scan *scan, const struct list *list,
                                  batten_hull *hull)
{
	for (size_t i = 0; i < list->point_count; i++) {
		const struct point *point = &list->points[i];
		size_t line = inner_line(list, point->line);
		size_t place = find_place(list, point->along_m);
		if (place == SIZE_MAX) {
			if (point->unknown)
				return offsets_fail_at(scan, point->file_line, point->file_column,
				                       "found '?' where no other line has a point, expected a "
				                       "half-breadth");
			hull->ends[hull->end_count++] = (hull_line_end){ list->waterlines, line, point->along_m,
				                                             point->y_m };
			continue;
		}
		size_t node = list->waterlines ? line * hull->station_count + place
		                               : place * hull->station_count + line;
		hull->y_m[node] = point->y_m;
		hull->nodes[node] = point->unknown ? BATTEN_NODE_UNKNOWN : BATTEN_NODE_GIVEN;
	}
	if (hull->end_count > 1)
		qsort(hull->ends, hull->end_count, sizeof *hull->ends, compare_ends);
	return BATTEN_OK;
}

static size_t count_ends(const struct list *list)
{
	size_t count = 0;
	for (size_t i = 0; i < list->point_count; i++)
		count += find_place(list, list->points[i].along_m) == SIZE_MAX;
	return count;
}

static batten_status make_hull(const struct offsets_scan *scan, struct list *list,
                               batten_hull **out)
{
	size_t lines = list->line_count;
	size_t places = list->shared_count;
	batten_hull *hull = hull_allocate(scan->context, list->waterlines ? places : lines,
	                                  list->waterlines ? lines : places);
	if (!hull)
		return BATTEN_MEMORY;
	hull->layout = list->waterlines ? HULL_LAYOUT_LONG_WATERLINES : HULL_LAYOUT_LONG_STATIONS;
	double *along_lines = list->waterlines ? hull->z_m : hull->x_m;
	double *along_places = list->waterlines ? hull->x_m : hull->z_m;
	memcpy(along_places, list->shared_m, places * sizeof *along_places);
	batten_status status = BATTEN_MEMORY;
	hull->ends = batten_allocate(scan->context, count_ends(list), sizeof *hull->ends);
	hull->labels = batten_allocate(scan->context, lines, sizeof *hull->labels);
	if (hull->ends && hull->labels) {
		for (size_t i = 0; i < lines; i++) {
			along_lines[inner_line(list, i)] = list->lines[i].at.metres;
			/* The hull takes the labels over. */
			hull->labels[inner_line(list, i)] = list->lines[i].label;
			list->lines[i].label = NULL;
		}
		status = place_points(scan, list, hull);
	}
	if (status != BATTEN_OK) {
		batten_hull_destroy(hull);
		return status;
	}
	*out = hull;
	return BATTEN_OK;
}

batten_status offsets_read_long(struct offsets_scan *scan, const struct offsets_header *header,
                                batten_hull **out)
{
	struct list list = { .frame = offsets_header_hull(header) };
	batten_status status = read_heading(scan, &list);
	if (status == BATTEN_OK)
		status = read_rows(scan, &list);
	if (status == BATTEN_OK)
		status = find_shared(scan, &list);
	if (status == BATTEN_OK)
		status = check_spacing(scan, &list);
	if (status == BATTEN_OK)
		status = make_hull(scan, &list, out);
	release_list(scan->context, &list);
	return status;
}
