/* The grid layout: one row a waterline, one column a station. */
#include "io/offsets_frame.h"
#include "io/offsets_parts.h"

/* The table as it grows, in the order of the file. */
struct grid {
	batten_hull frame;
	size_t station_count, waterline_count, capacity;
	size_t cell_count; /* of every row: z, the stations, empty columns as spreadsheets add them */
	double *x_m, *z_m, *y_m;
	uint8_t *nodes;
};

static void release_grid(batten_context *context, struct grid *grid)
{
	batten_release(context, grid->x_m);
	batten_release(context, grid->z_m);
	batten_release(context, grid->y_m);
	batten_release(context, grid->nodes);
}

/* ------------------------------------------------------------------------------------------------
 * The stations
 * --------------------------------------------------------------------------------------------- */

static batten_status read_stations(struct offsets_scan *scan, struct grid *grid)
{
	struct offsets_cell cell;
	struct offsets_coordinate previous = { 0 };
	(void)offsets_next_cell(scan, &cell);
	if (!offsets_cell_is(&cell, "z\\x"))
		return offsets_fail(scan, &cell, "'z\\x' and the stations, separated by commas");
	while (offsets_next_cell(scan, &cell)) {
		if (cell.length == 0) {
			batten_status status = offsets_expect_no_more(scan);
			if (status != BATTEN_OK)
				return status;
			break;
		}
		if (grid->station_count == HULL_LINES_MOST)
			return offsets_fail(scan, &cell, "at most %d stations", HULL_LINES_MOST);
		batten_status status = offsets_read_coordinate(
			scan, &cell, &grid->frame, true, grid->station_count > 0 ? &previous : NULL, &previous);
		if (status != BATTEN_OK)
			return status;
		grid->x_m[grid->station_count++] = previous.metres;
	}
	if (grid->station_count < 2)
		return offsets_fail_at(scan, scan->line, 1, "found %zu station%s, expected 2 to %d",
		                       grid->station_count, grid->station_count == 1 ? "" : "s",
		                       HULL_LINES_MOST);
	grid->cell_count = offsets_count_cells(scan);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * The waterlines
 * --------------------------------------------------------------------------------------------- */

static batten_status grow_grid(batten_context *context, struct grid *grid)
{
	size_t rows = grid->waterline_count;
	if (rows < grid->capacity)
		return BATTEN_OK;
	size_t capacity = grid->capacity > 0 ? 2 * grid->capacity : 32;
	size_t columns = grid->station_count;
	double *z_m = offsets_grow(context, grid->z_m, rows, capacity, sizeof *z_m);
	if (!z_m)
		return BATTEN_MEMORY;
	grid->z_m = z_m;
	double *y_m = offsets_grow(context, grid->y_m, rows, capacity, columns * sizeof *y_m);
	if (!y_m)
		return BATTEN_MEMORY;
	grid->y_m = y_m;
	uint8_t *nodes = offsets_grow(context, grid->nodes, rows, capacity, columns * sizeof *nodes);
	if (!nodes)
		return BATTEN_MEMORY;
	grid->nodes = nodes;
	grid->capacity = capacity;
	return BATTEN_OK;
}

/* The half-breadths of one row, y and nodes being its own. */
static batten_status read_half_breadths(struct offsets_scan *scan, const struct grid *grid,
                                        double *y_m, uint8_t *nodes)
{
	struct offsets_cell cell;
	for (size_t s = 0; s < grid->station_count; s++) {
		(void)offsets_next_cell(scan, &cell);
		nodes[s] = BATTEN_NODE_GIVEN;
		if (cell.length == 0) {
			nodes[s] = BATTEN_NODE_OUTSIDE;
		} else if (offsets_cell_is(&cell, "?")) {
			nodes[s] = BATTEN_NODE_UNKNOWN;
		} else {
			batten_status status = offsets_read_half_breadth(scan, &cell, &grid->frame, &y_m[s]);
			if (status != BATTEN_OK)
				return status;
		}
	}
	return offsets_expect_no_more(scan);
}

static batten_status read_waterline(struct offsets_scan *scan, struct grid *grid,
                                    struct offsets_coordinate *z)
{
	struct offsets_cell cell;
	size_t row = grid->waterline_count;
	(void)offsets_next_cell(scan, &cell);
	if (row == HULL_LINES_MOST)
		return offsets_fail(scan, &cell, "at most %d waterlines", HULL_LINES_MOST);
	batten_status status = offsets_check_width(scan, grid->cell_count);
	if (status == BATTEN_OK)
		status = offsets_read_coordinate(scan, &cell, &grid->frame, false, row > 0 ? z : NULL, z);
	if (status == BATTEN_OK)
		status = grow_grid(scan->context, grid);
	if (status != BATTEN_OK)
		return status;
	grid->z_m[row] = z->metres;
	grid->waterline_count++;
	return read_half_breadths(scan, grid, grid->y_m + row * grid->station_count,
	                          grid->nodes + row * grid->station_count);
}

/* ------------------------------------------------------------------------------------------------
 * The hull
 * --------------------------------------------------------------------------------------------- */

static batten_hull *hull_of_grid(batten_context *context, const struct grid *grid)
{
	size_t stations = grid->station_count;
	batten_hull *hull = hull_allocate(context, stations, grid->waterline_count);
	if (!hull)
		return NULL;
	bool mirrored = offsets_frame_is_mirrored(grid->frame.frame);
	for (size_t row = 0; row < grid->waterline_count; row++)
		hull->z_m[row] = grid->z_m[row];
	for (size_t s = 0; s < stations; s++) {
		size_t from = mirrored ? stations - 1 - s : s;
		hull->x_m[s] = grid->x_m[from];
		for (size_t row = 0; row < hull_node_count(hull); row += stations) {
			hull->y_m[row + s] = grid->y_m[row + from];
			hull->nodes[row + s] = grid->nodes[row + from];
		}
	}
	return hull;
}

static batten_status read_waterlines(struct offsets_scan *scan, struct grid *grid)
{
	struct offsets_coordinate z = { 0 };
	while (offsets_next_row(scan) && !offsets_is_extra(scan)) {
		batten_status status = read_waterline(scan, grid, &z);
		if (status != BATTEN_OK)
			return status;
	}
	if (grid->waterline_count < 2)
		return offsets_fail_at(
			scan, scan->line, 1, "found %zu waterline%s up to here, expected 2 to %d",
			grid->waterline_count, grid->waterline_count == 1 ? "" : "s", HULL_LINES_MOST);
	return BATTEN_OK;
}

batten_status offsets_read_grid(struct offsets_scan *scan, const struct offsets_header *header,
                                batten_hull **out)
{
	struct grid grid = { .frame = offsets_header_hull(header) };
	batten_hull *hull = NULL;
	batten_status status = BATTEN_MEMORY;
	grid.x_m = batten_allocate(scan->context, HULL_LINES_MOST, sizeof *grid.x_m);
	if (grid.x_m)
		status = read_stations(scan, &grid);
	if (status == BATTEN_OK)
		status = read_waterlines(scan, &grid);
	if (status == BATTEN_OK) {
		hull = hull_of_grid(scan->context, &grid);
		status = hull ? BATTEN_OK : BATTEN_MEMORY;
	}
	release_grid(scan->context, &grid);
	if (status != BATTEN_OK)
		return status;
	hull->layout = HULL_LAYOUT_GRID;
	*out = hull;
	return BATTEN_OK;
}
