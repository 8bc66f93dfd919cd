#include "geometry/grid_variation.h"

#include "core/difference.h"
#include "hull/hull.h"

#include <math.h>
#include <stdlib.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/grid_energy.h"
#include "shared/surface_variation.h"

enum { REACH = 2 };

static bool counts(const batten_hull *hull, size_t waterline, size_t station)
{
	if (waterline < REACH || waterline + REACH >= hull->waterline_count || station < REACH ||
	    station + REACH >= hull->station_count)
		return false;
	for (int j = -REACH; j <= REACH; j++)
		for (int i = abs(j) - REACH; i <= REACH - abs(j); i++) {
			const size_t line = (size_t)((ptrdiff_t)waterline + j);
			const size_t place = (size_t)((ptrdiff_t)station + i);
			if (hull->nodes[line * hull->station_count + place] == BATTEN_NODE_OUTSIDE)
				return false;
		}
	return true;
}

static double second_of(const double w[STENCIL_SIZE], const double *y, ptrdiff_t step)
{
	return stencil_second(w[2], w[3], y[-step], y[0], y[step]);
}

/* The third derivatives of the graph as those of the surface (x, y, z) by u = x and v = z. */
static surface_third third_of(const batten_hull *hull, size_t waterline, size_t station)
{
	const double *x = hull->x_m + station;
	const double *z = hull->z_m + waterline;
	const ptrdiff_t row = (ptrdiff_t)hull->station_count;
	const double *y = hull->y_m + (ptrdiff_t)waterline * row + (ptrdiff_t)station;
	double w_x[STENCIL_SIZE];
	double w_z[STENCIL_SIZE];
	difference_weights(x, w_x);
	difference_weights(z, w_z);
	return (surface_third){
		.uuu = { .y = difference_third(x, y, 1) },
		.uuv = { .y = stencil_first(w_z[0], w_z[1], second_of(w_x, y - row, 1),
		                            second_of(w_x, y, 1), second_of(w_x, y + row, 1)) },
		.uvv = { .y = stencil_first(w_x[0], w_x[1], second_of(w_z, y - 1, row),
		                            second_of(w_z, y, row), second_of(w_z, y + 1, row)) },
		.vvv = { .y = difference_third(z, y, row) },
	};
}

static surface_jet jet_of(const grid_curvature *grid, size_t node)
{
	return (surface_jet){
		.u = { .x = 1.0, .y = grid->y_x[node] },
		.v = { .y = grid->y_z[node], .z = 1.0 },
		.uu = { .y = grid->y_xx_per_m[node] },
		.uv = { .y = grid->y_xz_per_m[node] },
		.vv = { .y = grid->y_zz_per_m[node] },
	};
}

double grid_variation_sum(const batten_hull *hull, const grid_curvature *grid)
{
	double sum = 0.0;
	bool any = false;
	for (size_t j = 0; j < hull->waterline_count; j++)
		for (size_t i = 0; i < hull->station_count; i++) {
			if (!counts(hull, j, i))
				continue;
			const size_t node = j * hull->station_count + i;
			const surface_jet jet = jet_of(grid, node);
			const surface_variation found = surface_variation_of(jet, third_of(hull, j, i),
			                                                     surface_shape_of(jet, 0.0));
			sum += found.density * grid->area_m2[node];
			any = true;
		}
	return any ? sum : NAN;
}
