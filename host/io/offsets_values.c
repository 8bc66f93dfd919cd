/* The numbers of a table: coordinates and half-breadths. */
#include "io/offsets_frame.h"
#include "io/offsets_parts.h"

#include <math.h>
#include <string.h>

batten_status offsets_read_coordinate(const struct offsets_scan *scan,
                                      const struct offsets_cell *cell, const batten_hull *frame,
                                      bool along_x, const struct offsets_coordinate *previous,
                                      struct offsets_coordinate *out)
{
	const char *what = along_x ? "x" : "z";
	struct offsets_coordinate read = { 0 };
	batten_status status = offsets_read_number(
		scan, cell, along_x ? "a number for x" : "a number for z", &read.value);
	if (status != BATTEN_OK)
		return status;
	read.metres = along_x ? offsets_x_in(frame, read.value) : offsets_z_in(frame, read.value);
	if (!(fabs(read.metres) <= HULL_LARGEST_M))
		return offsets_fail(scan, cell, "%s within %g m", what, HULL_LARGEST_M);
	if (previous) {
		if (read.value == previous->value)
			return offsets_fail(scan, cell, "each %s once, it repeats the one before it", what);
		/* Where x runs aft the metres inside fall while those of the file rise. */
		if (read.value < previous->value)
			return offsets_fail(scan, cell, "%s in ascending order, beyond %.10g", what,
			                    previous->value);
		if (!(fabs(read.metres - previous->metres) >= HULL_SMALLEST_STEP_M))
			return offsets_fail(scan, cell, "%s at least %g m beyond %.10g", what,
			                    HULL_SMALLEST_STEP_M, previous->value);
	}
	*out = read;
	return BATTEN_OK;
}

batten_status offsets_read_half_breadth(const struct offsets_scan *scan,
                                        const struct offsets_cell *cell, const batten_hull *frame,
                                        double *out_m)
{
	double value = 0;
	batten_status status = offsets_read_number(scan, cell, "a half-breadth", &value);
	if (status != BATTEN_OK)
		return status;
	double metres = offsets_length_in(frame, value);
	if (!(metres >= 0 && metres <= HULL_LARGEST_M))
		return offsets_fail(scan, cell, "a half-breadth of 0 or more, up to %g m", HULL_LARGEST_M);
	*out_m = metres;
	return BATTEN_OK;
}

batten_status offsets_check_width(const struct offsets_scan *scan, size_t cell_count)
{
	size_t found = offsets_count_cells(scan);
	if (found == cell_count)
		return BATTEN_OK;
	/* The first cell too many, or the end of the row. */
	struct offsets_scan row = *scan;
	struct offsets_cell cell = { scan->row, 0, scan->row_length + 1 };
	row.place = 0;
	for (size_t i = 0; found > cell_count && i <= cell_count; i++)
		(void)offsets_next_cell(&row, &cell);
	return offsets_fail_at(scan, scan->line, cell.column,
	                       "found %zu cells, expected %zu as in the first row of the table%s",
	                       found, cell_count, found > cell_count ? " (a decimal comma?)" : "");
}

batten_status offsets_read_text(const struct offsets_scan *scan, const struct offsets_cell *cell,
                                char **out)
{
	if (cell->length > HULL_TEXT_MOST)
		return offsets_fail_at(scan, scan->line, cell->column,
		                       "found a text of %zu bytes, expected %d at most", cell->length,
		                       HULL_TEXT_MOST);
	return hull_clean_text(scan->context, cell->text, cell->length, out);
}

batten_status offsets_expect_no_more(struct offsets_scan *scan)
{
	struct offsets_cell cell;
	while (offsets_next_cell(scan, &cell))
		if (cell.length > 0)
			return offsets_fail(scan, &cell, "the end of the row");
	return BATTEN_OK;
}

void *offsets_grow(batten_context *context, void *array, size_t used, size_t capacity, size_t size)
{
	void *larger = batten_allocate(context, capacity, size);
	if (!larger)
		return NULL;
	if (used > 0)
		memcpy(larger, array, used * size);
	batten_release(context, array);
	return larger;
}
