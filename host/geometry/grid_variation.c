#include "geometry/grid_variation.h"

#include "core/runs.h"
#include "hull/hull.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#undef SHARED_FUNCTION
#define SHARED_FUNCTION INLINED
#include "shared/grid_energy.h"
#include "shared/surface_variation.h"

enum { REACH = 2 };

typedef struct grid_variation {
	double sum;
	size_t count; /* of nodes that count */
} grid_variation;

/* Whether a node counts, at - 2 rows to at + 2 rows being in the table: the 3 x 3 nodes around it are on
 * the hull, as are those two steps away. */
INLINED bool counts(const grid_curvature *grid, const uint8_t *nodes, size_t node)
{
	const size_t row = grid->station_count;
	return (grid->origin[node] == GRID_CURVATURE_OWN) &
	       (nodes[node - REACH] != BATTEN_NODE_OUTSIDE) &
	       (nodes[node + REACH] != BATTEN_NODE_OUTSIDE) &
	       (nodes[node - REACH * row] != BATTEN_NODE_OUTSIDE) &
	       (nodes[node + REACH * row] != BATTEN_NODE_OUTSIDE);
}

INLINED double second_of(const double w[STENCIL_SIZE], const double *y, ptrdiff_t step)
{
	return stencil_second(w[2], w[3], y[-step], y[0], y[step]);
}

/* The third derivatives of the graph as those of the surface (x, y, z) by u = x and v = z. y: at the
 * node, row numbers a row. */
INLINED surface_third third_of(const grid_stencil *x, const grid_stencil *z, const double *y,
                               ptrdiff_t row)
{
	const double *w_x = x->weight;
	const double *w_z = z->weight;
	return (surface_third){
		.uuu = { .y = difference_third(&x->third, y, 1) },
		.uuv = { .y = stencil_first(w_z[0], w_z[1], second_of(w_x, y - row, 1),
		                            second_of(w_x, y, 1), second_of(w_x, y + row, 1)) },
		.uvv = { .y = stencil_first(w_x[0], w_x[1], second_of(w_z, y - 1, row),
		                            second_of(w_z, y, row), second_of(w_z, y + 1, row)) },
		.vvv = { .y = difference_third(&z->third, y, row) },
	};
}

INLINED surface_jet jet_of(const grid_curvature *grid, size_t node)
{
	return (surface_jet){
		.u = { .x = 1.0, .y = grid->y_x[node] },
		.v = { .y = grid->y_z[node], .z = 1.0 },
		.uu = { .y = grid->y_xx_per_m[node] },
		.uv = { .y = grid->y_xz_per_m[node] },
		.vv = { .y = grid->y_zz_per_m[node] },
	};
}

INLINED grid_stencil stencil_at(const grid_stencils *stencils, size_t station)
{
	grid_stencil x;
	for (size_t k = 0; k < 4; k++) {
		x.weight[k] = stencils->weight_x[k][station];
		x.third.weight[k] = stencils->third_x[k][station];
	}
	return x;
}

/* What the nodes of a run add; count: at most RUN_LENGTH. */
INLINED void work_run(const batten_hull *hull, const grid_stencils *stencils,
                      const grid_curvature *grid, size_t waterline, size_t station, size_t count,
                      double *restrict out)
{
	const ptrdiff_t row = (ptrdiff_t)hull->station_count;
	const size_t first = waterline * hull->station_count + station;
	const double *y = hull->y_m + first;
	const grid_stencils along = *stencils;
	const grid_stencil z = stencils->z[waterline];
	const grid_curvature at = *grid;
	RUN_LOOP
	for (size_t l = 0; l < count; l++) {
		const grid_stencil x = stencil_at(&along, station + l);
		const surface_jet jet = jet_of(&at, first + l);
		const surface_third third = third_of(&x, &z, y + l, row);
		out[l] = surface_variation_of(jet, third, surface_shape_of(jet, 0.0)).density *
		         at.area_m2[first + l];
	}
}

/* The sum over a row, in the order of its nodes: of the run's only those from the station next on. */
INLINED void add_run(const batten_hull *hull, const grid_curvature *grid, const double *values,
                     size_t node, size_t done, size_t count, grid_variation *total)
{
	for (size_t l = done; l < count; l++) {
		const bool here = counts(grid, hull->nodes, node + l);
		total->sum += here ? values[l] : 0.0;
		total->count += here;
	}
}

INLINED void work_rows(const batten_hull *hull, const grid_stencils *stencils,
                       const grid_curvature *grid, grid_variation *total)
{
	const size_t end = hull->station_count - REACH;
	double values[RUN_LENGTH];
	for (size_t j = REACH; j + REACH < hull->waterline_count; j++) {
		const size_t node = j * hull->station_count;
		if (end < REACH + RUN_LENGTH) {
			work_run(hull, stencils, grid, j, REACH, end - REACH, values);
			add_run(hull, grid, values, node + REACH, 0, end - REACH, total);
			continue;
		}
		for (size_t i = REACH, next = REACH; next < end; i = run_after(i, end)) {
			work_run(hull, stencils, grid, j, i, RUN_LENGTH, values);
			add_run(hull, grid, values, node + i, next - i, RUN_LENGTH, total);
			next = i + RUN_LENGTH;
		}
	}
}

RUNS_FUNCTION(add_rows, work_rows,
              (const batten_hull *hull, const grid_stencils *stencils, const grid_curvature *grid,
               grid_variation *total),
              (hull, stencils, grid, total))

double grid_variation_sum(const batten_hull *hull, const grid_stencils *stencils,
                          const grid_curvature *grid)
{
	grid_variation total = { 0 };
	if (hull->station_count > 2 * REACH && hull->waterline_count > 2 * REACH)
		add_rows(hull, stencils, grid, &total);
	return total.count > 0 ? total.sum : NAN;
}
