#include "geometry/grid_curvature.h"

#include "core/runs.h"
#include "hull/hull.h"

#include <math.h>
#include <string.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#undef SHARED_FUNCTION
#define SHARED_FUNCTION INLINED
#include "shared/grid_energy.h"

enum { ARRAY_COUNT = 9 };

/* ---- which nodes have curvatures of their own ---- */

static void mark_own_nodes(const batten_hull *hull, grid_curvature *grid)
{
	const size_t row = hull->station_count;
	size_t own = 0;
	for (size_t j = 1; j + 1 < hull->waterline_count; j++)
		for (size_t i = 1; i + 1 < row; i++) {
			const uint8_t *at = hull->nodes + j * row + i;
			bool all = true;
			for (size_t n = 0; n < 3; n++) {
				const uint8_t *line = at - row + n * row;
				all = all & (line[-1] != BATTEN_NODE_OUTSIDE) & (line[0] != BATTEN_NODE_OUTSIDE) &
				      (line[1] != BATTEN_NODE_OUTSIDE);
			}
			grid->origin[j * row + i] = all ? GRID_CURVATURE_OWN : GRID_CURVATURE_NONE;
			own += all;
		}
	grid->own_count = own;
}

/* ---- their curvatures ---- */

/* What is found at the nodes of a run, in the order of the arrays of a grid_curvature. */
typedef struct run_values {
	double y_x[RUN_LENGTH], y_z[RUN_LENGTH], y_xx[RUN_LENGTH], y_xz[RUN_LENGTH], y_zz[RUN_LENGTH];
	double mean[RUN_LENGTH], gauss[RUN_LENGTH], bending[RUN_LENGTH], area[RUN_LENGTH];
} run_values;

INLINED node_row row_at(const double *y)
{
	return (node_row){ .aft = y[-1], .here = y[0], .fore = y[1] };
}

INLINED node_stencil stencil_of(const grid_stencils *stencils, const grid_stencil *z,
                                size_t station)
{
	node_stencil stencil;
	for (size_t k = 0; k < STENCIL_SIZE; k++) {
		stencil.x[k] = stencils->weight_x[k][station];
		stencil.z[k] = z->weight[k];
	}
	return stencil;
}

/* Mean and Gauss curvature of a graph and its area element (Letcher 4.2-4.3), by the outward normal
 * (-y_x, 1, -y_z): with it a convex hull has y_xx, y_zz < 0. */
INLINED void take_curvatures(node_slopes d, double cell_x, double cell_z, size_t l, run_values *out)
{
	const double square = 1.0 + d.y_x * d.y_x + d.y_z * d.y_z;
	const double root = sqrt(square);
	const double twice_mean = ((1.0 + d.y_z * d.y_z) * d.y_xx - 2.0 * d.y_x * d.y_z * d.y_xz +
	                           (1.0 + d.y_x * d.y_x) * d.y_zz) /
	                          (square * root);
	const double gauss = (d.y_xx * d.y_zz - d.y_xz * d.y_xz) / (square * square);
	const double bending = twice_mean * twice_mean - 2.0 * gauss;
	out->mean[l] = 0.5 * twice_mean;
	out->gauss[l] = gauss;
	out->bending[l] = bending > 0.0 ? bending : 0.0;
	out->area[l] = root * cell_x * cell_z;
}

/* count: at most RUN_LENGTH. */
INLINED void work_run(const batten_hull *hull, const grid_stencils *stencils, size_t waterline,
                      size_t station, size_t count, run_values *out)
{
	const size_t row = hull->station_count;
	const double *y = hull->y_m + waterline * row + station;
	const grid_stencil z = stencils->z[waterline];
	RUN_LOOP
	for (size_t l = 0; l < count; l++) {
		const node_slopes d = slopes_of(stencil_of(stencils, &z, station + l), row_at(y + l - row),
		                                row_at(y + l), row_at(y + l + row));
		out->y_x[l] = d.y_x;
		out->y_z[l] = d.y_z;
		out->y_xx[l] = d.y_xx;
		out->y_xz[l] = d.y_xz;
		out->y_zz[l] = d.y_zz;
		take_curvatures(d, stencils->cell_x_m[station + l], z.cell_m, l, out);
	}
}

/* Nothing where a node has no curvature of its own. */
INLINED void put_values(const double *value, const double *own, size_t count, double *restrict to)
{
	RUN_LOOP
	for (size_t l = 0; l < count; l++)
		to[l] = own[l] > 0 ? value[l] : 0.0;
}

INLINED void put_run(const run_values *run, size_t node, size_t count, const grid_curvature *grid)
{
	double own[RUN_LENGTH];
	RUN_LOOP
	for (size_t l = 0; l < count; l++)
		own[l] = grid->origin[node + l] == GRID_CURVATURE_OWN ? 1.0 : 0.0;
	put_values(run->y_x, own, count, grid->y_x + node);
	put_values(run->y_z, own, count, grid->y_z + node);
	put_values(run->y_xx, own, count, grid->y_xx_per_m + node);
	put_values(run->y_xz, own, count, grid->y_xz_per_m + node);
	put_values(run->y_zz, own, count, grid->y_zz_per_m + node);
	put_values(run->mean, own, count, grid->mean_per_m + node);
	put_values(run->gauss, own, count, grid->gauss_per_m2 + node);
	put_values(run->bending, own, count, grid->bending_per_m2 + node);
	put_values(run->area, own, count, grid->area_m2 + node);
}

INLINED void work_rows(const batten_hull *hull, const grid_stencils *stencils, grid_curvature *grid)
{
	const size_t end = hull->station_count - 1;
	run_values run;
	for (size_t j = 1; j + 1 < hull->waterline_count; j++) {
		const size_t node = j * hull->station_count;
		if (end < 1 + RUN_LENGTH) {
			work_run(hull, stencils, j, 1, end - 1, &run);
			put_run(&run, node + 1, end - 1, grid);
			continue;
		}
		for (size_t i = 1, next = 1; next < end; i = run_after(i, end)) {
			work_run(hull, stencils, j, i, RUN_LENGTH, &run);
			put_run(&run, node + i, RUN_LENGTH, grid);
			next = i + RUN_LENGTH;
		}
	}
}

RUNS_FUNCTION(take_rows, work_rows,
              (const batten_hull *hull, const grid_stencils *stencils, grid_curvature *grid),
              (hull, stencils, grid))

/* OWN nodes of a hull, and nothing borrowed. */
static void fill(const batten_hull *hull, const grid_stencils *stencils, grid_curvature *grid)
{
	if (hull->station_count < 3 || hull->waterline_count < 3)
		return;
	mark_own_nodes(hull, grid);
	take_rows(hull, stencils, grid);
}

/* ---- what their neighbours borrow, for pictures ---- */

/* The nearest OWN node found so far for every node. */
typedef struct lender {
	size_t node;
	double distance_m;
} lender;

/* One walk along a waterline or section: count nodes from first, stride apart in the arrays, step
 * apart in coordinate. Each node is offered the last OWN node passed since the hull's edge. */
static void offer_along(const batten_hull *hull, const grid_curvature *grid, size_t first,
                        size_t count, ptrdiff_t stride, const double *coordinate, ptrdiff_t step,
                        lender *lenders)
{
	size_t last = SIZE_MAX;
	double at = 0.0;
	for (size_t k = 0; k < count; k++) {
		size_t node = (size_t)((ptrdiff_t)first + (ptrdiff_t)k * stride);
		double here = coordinate[(ptrdiff_t)k * step];
		if (hull->nodes[node] == BATTEN_NODE_OUTSIDE) {
			last = SIZE_MAX;
		} else if (grid->origin[node] == GRID_CURVATURE_OWN) {
			last = node;
			at = here;
		} else if (last != SIZE_MAX && fabs(here - at) < lenders[node].distance_m) {
			lenders[node] = (lender){ .node = last, .distance_m = fabs(here - at) };
		}
	}
}

/* Ties go to the node below, then above, aft, forward: the order of the walks. */
static batten_status borrow_at_edges(batten_context *context, const batten_hull *hull,
                                     grid_curvature *grid)
{
	size_t stations = hull->station_count;
	size_t waterlines = hull->waterline_count;
	size_t count = hull_node_count(hull);
	lender *lenders = batten_allocate(context, count, sizeof *lenders);
	if (!lenders)
		return BATTEN_MEMORY;
	for (size_t node = 0; node < count; node++)
		lenders[node] = (lender){ .node = SIZE_MAX, .distance_m = INFINITY };
	const double *top = hull->z_m + waterlines - 1;
	const double *bow = hull->x_m + stations - 1;
	ptrdiff_t row = (ptrdiff_t)stations;
	for (size_t i = 0; i < stations; i++) {
		offer_along(hull, grid, i, waterlines, row, hull->z_m, 1, lenders);
		offer_along(hull, grid, count - stations + i, waterlines, -row, top, -1, lenders);
	}
	for (size_t j = 0; j < waterlines; j++) {
		offer_along(hull, grid, j * stations, stations, 1, hull->x_m, 1, lenders);
		offer_along(hull, grid, (j + 1) * stations - 1, stations, -1, bow, -1, lenders);
	}
	for (size_t node = 0; node < count; node++) {
		size_t from = lenders[node].node;
		if (from == SIZE_MAX)
			continue;
		grid->origin[node] = GRID_CURVATURE_BORROWED;
		grid->mean_per_m[node] = grid->mean_per_m[from];
		grid->gauss_per_m2[node] = grid->gauss_per_m2[from];
		grid->bending_per_m2[node] = grid->bending_per_m2[from];
	}
	batten_release(context, lenders);
	return BATTEN_OK;
}

/* With all nodes NONE. */
static batten_status allocate(batten_context *context, size_t station_count, size_t waterline_count,
                              grid_curvature **out)
{
	const size_t count = station_count * waterline_count;
	grid_curvature *grid = batten_allocate(context, 1, sizeof *grid);
	if (!grid)
		return BATTEN_MEMORY;
	grid->station_count = station_count;
	grid->waterline_count = waterline_count;
	grid->origin = batten_allocate(context, count, 1);
	double *block = batten_allocate(context, count, ARRAY_COUNT * sizeof *block);
	grid->y_x = block; /* first of the block: what is released */
	if (!grid->origin || !block) {
		grid_curvature_destroy(context, grid);
		return BATTEN_MEMORY;
	}
	double **arrays[ARRAY_COUNT] = {
		&grid->y_x,        &grid->y_z,        &grid->y_xx_per_m,   &grid->y_xz_per_m,
		&grid->y_zz_per_m, &grid->mean_per_m, &grid->gauss_per_m2, &grid->bending_per_m2,
		&grid->area_m2,
	};
	for (size_t k = 0; k < ARRAY_COUNT; k++)
		*arrays[k] = block + k * count;
	*out = grid;
	return BATTEN_OK;
}

batten_status grid_curvature_create(batten_context *context, const batten_hull *hull,
                                    grid_curvature **out)
{
	grid_curvature *grid = NULL;
	grid_stencils stencils;
	batten_status status = grid_stencils_create(context, hull->station_count, hull->x_m,
	                                            hull->waterline_count, hull->z_m, &stencils);
	if (status != BATTEN_OK)
		return status;
	status = allocate(context, hull->station_count, hull->waterline_count, &grid);
	if (status == BATTEN_OK) {
		fill(hull, &stencils, grid);
		status = borrow_at_edges(context, hull, grid);
	}
	if (status == BATTEN_OK) {
		*out = grid;
		grid = NULL;
	}
	grid_stencils_destroy(context, &stencils);
	grid_curvature_destroy(context, grid);
	return status;
}

void grid_curvature_destroy(batten_context *context, grid_curvature *grid)
{
	if (!grid)
		return;
	batten_release(context, grid->origin);
	batten_release(context, grid->y_x);
	batten_release(context, grid);
}
