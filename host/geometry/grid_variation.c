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

/* What the differences at a station, or at a waterline, take from the coordinates. */
typedef struct place {
	double w[STENCIL_SIZE];
	difference_quartic quartic;
} place;

static place *places_along(batten_context *context, const double *at, size_t count)
{
	place *places = batten_allocate(context, count, sizeof *places);
	for (size_t i = REACH; places && i + REACH < count; i++) {
		difference_weights(at + i, places[i].w);
		places[i].quartic = difference_quartic_of(at + i);
	}
	return places;
}

/* The third derivatives of the graph as those of the surface (x, y, z) by u = x and v = z. */
static surface_third third_of(const batten_hull *hull, const place *x, const place *z,
                              size_t waterline, size_t station)
{
	const double *w_x = x->w;
	const double *w_z = z->w;
	const ptrdiff_t row = (ptrdiff_t)hull->station_count;
	const double *y = hull->y_m + (ptrdiff_t)waterline * row + (ptrdiff_t)station;
	return (surface_third){
		.uuu = { .y = difference_third(&x->quartic, y, 1) },
		.uuv = { .y = stencil_first(w_z[0], w_z[1], second_of(w_x, y - row, 1),
		                            second_of(w_x, y, 1), second_of(w_x, y + row, 1)) },
		.uvv = { .y = stencil_first(w_x[0], w_x[1], second_of(w_z, y - 1, row),
		                            second_of(w_z, y, row), second_of(w_z, y + 1, row)) },
		.vvv = { .y = difference_third(&z->quartic, y, row) },
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

static double sum_over(const batten_hull *hull, const grid_curvature *grid, const place *along_x,
                       const place *along_z)
{
	double sum = 0.0;
	bool any = false;
	for (size_t j = 0; j < hull->waterline_count; j++)
		for (size_t i = 0; i < hull->station_count; i++) {
			if (!counts(hull, j, i))
				continue;
			const size_t node = j * hull->station_count + i;
			const surface_jet jet = jet_of(grid, node);
			const surface_third third = third_of(hull, &along_x[i], &along_z[j], j, i);
			sum += surface_variation_of(jet, third, surface_shape_of(jet, 0.0)).density *
			       grid->area_m2[node];
			any = true;
		}
	return any ? sum : NAN;
}

batten_status grid_variation_sum(batten_context *context, const batten_hull *hull,
                                 const grid_curvature *grid, double *out)
{
	place *along_x = places_along(context, hull->x_m, hull->station_count);
	place *along_z = places_along(context, hull->z_m, hull->waterline_count);
	const bool there = along_x && along_z;
	if (there)
		*out = sum_over(hull, grid, along_x, along_z);
	batten_release(context, along_x);
	batten_release(context, along_z);
	return there ? BATTEN_OK : BATTEN_MEMORY;
}
