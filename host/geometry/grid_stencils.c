#include "geometry/grid_stencils.h"

enum { NUMBERS_X = 9 };

static grid_stencil stencil_at(const double *at_m, size_t count, size_t i)
{
	grid_stencil stencil = { .cell_m = difference_cell(at_m, count, i) };
	if (i >= 1 && i + 1 < count)
		difference_weights(at_m + i, stencil.weight);
	if (i >= 2 && i + 2 < count)
		stencil.third = difference_quartic_of(at_m + i);
	return stencil;
}

static void lay_along_x(const double *x_m, grid_stencils *stencils)
{
	for (size_t i = 0; i < stencils->station_count; i++) {
		const grid_stencil stencil = stencil_at(x_m, stencils->station_count, i);
		for (size_t k = 0; k < 4; k++) {
			stencils->weight_x[k][i] = stencil.weight[k];
			stencils->third_x[k][i] = stencil.third.weight[k];
		}
		stencils->cell_x_m[i] = stencil.cell_m;
	}
}

batten_status grid_stencils_create(batten_context *context, size_t station_count, const double *x_m,
                                   size_t waterline_count, const double *z_m, grid_stencils *out)
{
	grid_stencils stencils = { .station_count = station_count, .waterline_count = waterline_count };
	double *along_x = batten_allocate(context, station_count, NUMBERS_X * sizeof *along_x);
	stencils.cell_x_m = along_x; /* first of them: what is released */
	stencils.z = batten_allocate(context, waterline_count, sizeof *stencils.z);
	if (!along_x || !stencils.z) {
		grid_stencils_destroy(context, &stencils);
		return BATTEN_MEMORY;
	}
	for (size_t k = 0; k < 4; k++) {
		stencils.weight_x[k] = along_x + (1 + k) * station_count;
		stencils.third_x[k] = along_x + (5 + k) * station_count;
	}
	lay_along_x(x_m, &stencils);
	for (size_t j = 0; j < waterline_count; j++)
		stencils.z[j] = stencil_at(z_m, waterline_count, j);
	*out = stencils;
	return BATTEN_OK;
}

void grid_stencils_destroy(batten_context *context, grid_stencils *stencils)
{
	batten_release(context, stencils->cell_x_m);
	batten_release(context, stencils->z);
	*stencils = (grid_stencils){ 0 };
}
