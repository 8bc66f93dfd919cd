/* Finds the cell of a node again, for a message: read once more from the table's first row. */
#include "io/offsets_frame.h"
#include "io/offsets_parts.h"

static batten_status fail_here(const struct offsets_scan *scan, const struct offsets_cell *cell)
{
	return offsets_fail(scan, cell, "two given half-breadths on its waterline or its section");
}

static batten_status fail_in_grid(struct offsets_scan *scan, const batten_hull *hull,
                                  size_t station, size_t waterline)
{
	bool mirrored = offsets_frame_is_mirrored(hull->frame);
	size_t column = 1 + (mirrored ? hull->station_count - 1 - station : station);
	for (size_t row = 0; row <= waterline; row++)
		(void)offsets_next_row(scan);
	struct offsets_cell cell = { "", 0, 1 };
	for (size_t i = 0; i <= column; i++)
		(void)offsets_next_cell(scan, &cell);
	return fail_here(scan, &cell);
}

static batten_status fail_in_list(struct offsets_scan *scan, const batten_hull *hull,
                                  size_t station, size_t waterline)
{
	bool waterlines = hull->layout == HULL_LAYOUT_LONG_WATERLINES;
	struct offsets_cell cells[4] = { { "", 0, 1 }, { "", 0, 1 }, { "", 0, 1 }, { "", 0, 1 } };
	while (offsets_next_row(scan)) {
		for (size_t i = 0; i < 4; i++)
			(void)offsets_next_cell(scan, &cells[i]);
		double x = 0;
		double z = 0;
		(void)batten_number_read(cells[waterlines ? 2 : 1].text, cells[waterlines ? 2 : 1].length,
		                         &x);
		(void)batten_number_read(cells[waterlines ? 1 : 2].text, cells[waterlines ? 1 : 2].length,
		                         &z);
		if (offsets_x_in(hull, x) == hull->x_m[station] &&
		    offsets_z_in(hull, z) == hull->z_m[waterline])
			break;
	}
	return fail_here(scan, &cells[3]);
}

batten_status offsets_fail_unfillable(const struct offsets_scan *table, const batten_hull *hull,
                                      size_t node)
{
	struct offsets_scan scan = *table;
	size_t station = node % hull->station_count;
	size_t waterline = node / hull->station_count;
	if (hull->layout == HULL_LAYOUT_GRID)
		return fail_in_grid(&scan, hull, station, waterline);
	return fail_in_list(&scan, hull, station, waterline);
}
