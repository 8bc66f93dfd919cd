/* Reads a line file (data/README.md describes the format). */
#include "core/file.h"
#include "geometry/points.h"
#include "io/offsets_frame.h"
#include "io/offsets_keys.h"
#include "io/offsets_parts.h"

#include <math.h>
#include <string.h>

/* 4096 points at full precision have about 0.3 MB; comments may follow. */
static const size_t largest_file = (size_t)16 << 20;

enum key { KEY_NAME, KEY_UNIT, KEY_SOURCE, KEY_COUNT };
static const char *const key_names[KEY_COUNT] = { "name", "unit", "source" };
static const char *const coordinates[3] = { "x", "y", "z" };

static batten_status read_text(const struct offsets_scan *scan, const struct offsets_key *key,
                               char **out)
{
	struct offsets_scan place = *scan;
	place.line = key->line;
	if (key->line == 0)
		return hull_clean_text(scan->context, "", 0, out);
	return offsets_read_text(&place, &key->cell, out);
}

static batten_status read_header(struct offsets_scan *scan, batten_points *points)
{
	struct offsets_key keys[KEY_COUNT] = { 0 };
	batten_status status = offsets_keys_collect(scan, key_names, KEY_COUNT, keys);
	if (status == BATTEN_OK)
		status = offsets_keys_refuse_late(scan, key_names, KEY_COUNT);
	if (status == BATTEN_OK)
		status = read_text(scan, &keys[KEY_NAME], &points->name);
	if (status == BATTEN_OK)
		status = read_text(scan, &keys[KEY_SOURCE], &points->source);
	const struct offsets_cell *unit = &keys[KEY_UNIT].cell;
	struct offsets_scan place = *scan;
	place.line = keys[KEY_UNIT].line;
	if (status == BATTEN_OK && place.line > 0 &&
	    !offsets_unit_named(unit->text, unit->length, &points->unit))
		status = offsets_fail(&place, unit, "a unit: m, mm or ft");
	return status;
}

/* Cells of the row without the empty ones that spreadsheets append. */
static size_t count_filled(const struct offsets_scan *scan)
{
	struct offsets_scan row = *scan;
	struct offsets_cell cell;
	size_t filled = 0;
	row.place = 0;
	for (size_t i = 1; offsets_next_cell(&row, &cell); i++)
		if (cell.length > 0)
			filled = i;
	return filled;
}

/* The heading x,y or x,y,z; a row of numbers tells the dimension as well. */
static batten_status read_heading(struct offsets_scan *scan, batten_points *points, bool *heading)
{
	struct offsets_scan row = *scan;
	struct offsets_cell cell = { scan->row, 0, 1 };
	double number = 0;
	points->dimension = count_filled(scan);
	row.place = 0;
	(void)offsets_next_cell(&row, &cell);
	*heading = cell.length > 0 && !batten_number_read(cell.text, cell.length, &number) &&
	           strchr("+-.0123456789", cell.text[0]) == NULL;
	if (points->dimension < 2 || points->dimension > 3)
		return offsets_fail_at(scan, scan->line, 1,
		                       "found %zu cells, expected x,y or x,y,z, with decimal points",
		                       points->dimension);
	for (size_t c = 0; c < points->dimension && *heading; c++) {
		if (!offsets_cell_is(&cell, coordinates[c]))
			return offsets_fail(scan, &cell, "the heading x,y or x,y,z, or a point");
		(void)offsets_next_cell(&row, &cell);
	}
	return BATTEN_OK;
}

static batten_status read_point(struct offsets_scan *scan, batten_points *points)
{
	const batten_hull frame = { .unit = points->unit };
	double *m = points->m + points->count * points->dimension;
	size_t found = count_filled(scan);
	if (points->count == HULL_LINES_MOST)
		return offsets_fail_at(scan, scan->line, 1, "found more points, expected at most %d",
		                       (int)HULL_LINES_MOST);
	if (found != points->dimension)
		return offsets_fail_at(
			scan, scan->line, 1, "found %zu cells, expected %zu as in the first row%s", found,
			points->dimension, found > points->dimension ? " (a decimal comma?)" : "");
	for (size_t c = 0; c < points->dimension; c++) {
		struct offsets_cell cell;
		double value = 0;
		char expected[] = "a number for x";
		expected[sizeof expected - 2] = *coordinates[c];
		(void)offsets_next_cell(scan, &cell);
		batten_status status = offsets_read_number(scan, &cell, expected, &value);
		if (status != BATTEN_OK)
			return status;
		m[c] = offsets_length_in(&frame, value);
		if (!(fabs(m[c]) <= HULL_LARGEST_M))
			return offsets_fail(scan, &cell, "%s within %g m", coordinates[c], HULL_LARGEST_M);
	}
	if (points->count > 0 && points_find_repeated(points->dimension, 2, m - points->dimension) == 1)
		return offsets_fail_at(scan, scan->line, 1,
		                       "found the point before it again, expected one at least %g m away",
		                       HULL_SMALLEST_STEP_M);
	points->count++;
	return BATTEN_OK;
}

static batten_status read_table(struct offsets_scan *scan, batten_points *points)
{
	bool heading = false;
	batten_status status = read_heading(scan, points, &heading);
	if (status != BATTEN_OK)
		return status;
	points->m = batten_allocate(scan->context, HULL_LINES_MOST, 3 * sizeof *points->m);
	if (!points->m)
		return BATTEN_MEMORY;
	bool more = !heading || offsets_next_row(scan);
	for (; more && status == BATTEN_OK; more = status == BATTEN_OK && offsets_next_row(scan))
		status = read_point(scan, points);
	if (status == BATTEN_OK && points->count < 2)
		return offsets_fail_at(scan, scan->line, 1,
		                       "found the end after %zu point%s, expected two or more",
		                       points->count, points->count == 1 ? "" : "s");
	return status;
}

batten_status batten_points_parse(batten_context *context, const char *name, const char *text,
                                  size_t length, batten_points **out)
{
	*out = NULL;
	struct offsets_scan scan = { 0 };
	batten_points *points = batten_allocate(context, 1, sizeof *points);
	if (!points)
		return BATTEN_MEMORY;
	points->context = context;
	batten_status status = offsets_scan_begin(context, name, text, length, "points, one x,y a row",
	                                          &scan);
	if (status == BATTEN_OK)
		status = read_header(&scan, points);
	if (status == BATTEN_OK)
		status = read_table(&scan, points);
	if (status != BATTEN_OK) {
		batten_points_destroy(points);
		return status;
	}
	*out = points;
	return BATTEN_OK;
}

batten_status batten_points_read(batten_context *context, const char *path, batten_points **out)
{
	*out = NULL;
	char *text = NULL;
	size_t length = 0;
	batten_status status = batten_file_read(context, path, largest_file, &text, &length);
	if (status == BATTEN_OK)
		status = batten_points_parse(context, path, text, length, out);
	batten_release(context, text);
	return status;
}
