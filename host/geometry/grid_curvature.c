#include "geometry/grid_curvature.h"

#include "core/difference.h"
#include "hull/hull.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/grid_energy.h"

enum { ARRAY_COUNT = 9 };

/* The two tables of weights, STENCIL_SIZE a station and a waterline. */
typedef struct stencils {
	double *along_x, *along_z;
} stencils;

/* The weights of stencil_first() and stencil_second(). */
static double *weights_along(batten_context *context, const double *coordinate, size_t count)
{
	double *weights = batten_allocate(context, count, STENCIL_SIZE * sizeof *weights);
	if (!weights)
		return NULL;
	for (size_t i = 1; i + 1 < count; i++)
		difference_weights(coordinate + i, weights + STENCIL_SIZE * i);
	return weights;
}

static bool all_nine_on_hull(const batten_hull *hull, size_t waterline, size_t station)
{
	for (size_t j = waterline - 1; j <= waterline + 1; j++)
		for (size_t i = station - 1; i <= station + 1; i++)
			if (hull->nodes[j * hull->station_count + i] == BATTEN_NODE_OUTSIDE)
				return false;
	return true;
}

static node_row row_at(const batten_hull *hull, size_t waterline, size_t station)
{
	const double *y = hull->y_m + waterline * hull->station_count + station;
	return (node_row){ .aft = y[-1], .here = y[0], .fore = y[1] };
}

static void take_derivatives(const batten_hull *hull, const stencils *weights, size_t waterline,
                             size_t station, grid_curvature *grid)
{
	node_stencil stencil;
	for (size_t k = 0; k < STENCIL_SIZE; k++) {
		stencil.x[k] = weights->along_x[STENCIL_SIZE * station + k];
		stencil.z[k] = weights->along_z[STENCIL_SIZE * waterline + k];
	}
	node_slopes slopes = slopes_of(stencil, row_at(hull, waterline - 1, station),
	                               row_at(hull, waterline, station),
	                               row_at(hull, waterline + 1, station));
	size_t node = waterline * hull->station_count + station;
	grid->y_x[node] = slopes.y_x;
	grid->y_z[node] = slopes.y_z;
	grid->y_xx_per_m[node] = slopes.y_xx;
	grid->y_xz_per_m[node] = slopes.y_xz;
	grid->y_zz_per_m[node] = slopes.y_zz;
}

/* Mean and Gauss curvature of a graph and its area element (Letcher 4.2-4.3), by the outward normal
 * (-y_x, 1, -y_z): with it a convex hull has y_xx, y_zz < 0. */
static void take_curvatures(const batten_hull *hull, size_t waterline, size_t station,
                            grid_curvature *grid)
{
	size_t node = waterline * hull->station_count + station;
	double p = grid->y_x[node];
	double q = grid->y_z[node];
	double r = grid->y_xx_per_m[node];
	double s = grid->y_xz_per_m[node];
	double t = grid->y_zz_per_m[node];
	double square = 1.0 + p * p + q * q;
	double twice_mean = ((1.0 + q * q) * r - 2.0 * p * q * s + (1.0 + p * p) * t) /
	                    (square * sqrt(square));
	double mean = 0.5 * twice_mean;
	double gauss = (r * t - s * s) / (square * square);
	double bending = twice_mean * twice_mean - 2.0 * gauss;
	double cell_x = difference_cell(hull->x_m, hull->station_count, station);
	double cell_z = difference_cell(hull->z_m, hull->waterline_count, waterline);
	grid->mean_per_m[node] = mean;
	grid->gauss_per_m2[node] = gauss;
	grid->bending_per_m2[node] = bending > 0.0 ? bending : 0.0;
	grid->area_m2[node] = sqrt(square) * cell_x * cell_z;
}

static void take_own_nodes(const batten_hull *hull, const stencils *weights, grid_curvature *grid)
{
	for (size_t j = 1; j + 1 < hull->waterline_count; j++)
		for (size_t i = 1; i + 1 < hull->station_count; i++) {
			if (!all_nine_on_hull(hull, j, i))
				continue;
			take_derivatives(hull, weights, j, i, grid);
			take_curvatures(hull, j, i, grid);
			grid->origin[j * hull->station_count + i] = GRID_CURVATURE_OWN;
			grid->own_count++;
		}
}

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

static grid_curvature *allocate_grid(batten_context *context, const batten_hull *hull)
{
	size_t count = hull_node_count(hull);
	grid_curvature *grid = batten_allocate(context, 1, sizeof *grid);
	if (!grid)
		return NULL;
	grid->station_count = hull->station_count;
	grid->waterline_count = hull->waterline_count;
	grid->origin = batten_allocate(context, count, 1);
	double *block = batten_allocate(context, count, ARRAY_COUNT * sizeof *block);
	grid->y_x = block; /* first of the block: what is released */
	if (!grid->origin || !block) {
		grid_curvature_destroy(context, grid);
		return NULL;
	}
	double **arrays[ARRAY_COUNT] = {
		&grid->y_x,        &grid->y_z,        &grid->y_xx_per_m,   &grid->y_xz_per_m,
		&grid->y_zz_per_m, &grid->mean_per_m, &grid->gauss_per_m2, &grid->bending_per_m2,
		&grid->area_m2,
	};
	for (size_t k = 0; k < ARRAY_COUNT; k++)
		*arrays[k] = block + k * count;
	return grid;
}

batten_status grid_curvature_create(batten_context *context, const batten_hull *hull,
                                    grid_curvature **out)
{
	grid_curvature *grid = allocate_grid(context, hull);
	stencils weights = {
		.along_x = weights_along(context, hull->x_m, hull->station_count),
		.along_z = weights_along(context, hull->z_m, hull->waterline_count),
	};
	batten_status status = BATTEN_MEMORY;
	if (grid && weights.along_x && weights.along_z) {
		take_own_nodes(hull, &weights, grid);
		status = borrow_at_edges(context, hull, grid);
	}
	if (status == BATTEN_OK) {
		*out = grid;
		grid = NULL;
	}
	batten_release(context, weights.along_x);
	batten_release(context, weights.along_z);
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
