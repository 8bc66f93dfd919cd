#include "geometry/grid_energies.h"

#include "core/runs.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#undef SHARED_FUNCTION
#define SHARED_FUNCTION INLINED
#include "shared/graph_variation.h"

enum { REACH = 2 };

/* ---- which nodes count ---- */

static bool is_near(const uint8_t *at, ptrdiff_t row)
{
	for (ptrdiff_t n = -1; n <= 1; n++)
		for (ptrdiff_t k = -1; k <= 1; k++)
			if (at[n * row + k] == BATTEN_NODE_OUTSIDE)
				return false;
	return true;
}

static bool is_wide(const uint8_t *at, ptrdiff_t row)
{
	return at[-REACH] != BATTEN_NODE_OUTSIDE && at[REACH] != BATTEN_NODE_OUTSIDE &&
	       at[-REACH * row] != BATTEN_NODE_OUTSIDE && at[REACH * row] != BATTEN_NODE_OUTSIDE;
}

static void mark(const batten_hull *hull, grid_counted *counted)
{
	const size_t nx = hull->station_count, nz = hull->waterline_count;
	for (size_t j = 1; j + 1 < nz; j++)
		for (size_t i = 1; i + 1 < nx; i++) {
			const size_t node = j * nx + i;
			const bool inner = i >= REACH && i + REACH < nx && j >= REACH && j + REACH < nz;
			const bool near = is_near(hull->nodes + node, (ptrdiff_t)nx);
			const bool wide = near && inner && is_wide(hull->nodes + node, (ptrdiff_t)nx);
			counted->near[node] = near ? 1.0 : 0.0;
			counted->wide[node] = wide ? 1.0 : 0.0;
			counted->near_count += near;
			counted->wide_count += wide;
		}
}

batten_status grid_counted_create(batten_context *context, const batten_hull *hull,
                                  grid_counted *out)
{
	const size_t nodes = hull_node_count(hull);
	grid_counted counted = { .near = batten_allocate(context, nodes, 2 * sizeof(double)) };
	if (!counted.near)
		return BATTEN_MEMORY;
	counted.wide = counted.near + nodes;
	mark(hull, &counted);
	*out = counted;
	return BATTEN_OK;
}

void grid_counted_destroy(batten_context *context, grid_counted *counted)
{
	batten_release(context, counted->near);
	*counted = (grid_counted){ 0 };
}

/* ---- nodes ---- */

/* What each place in the runs has added. */
typedef struct energy_sums {
	double bending[RUN_LENGTH], mean[RUN_LENGTH], gauss[RUN_LENGTH], variation[RUN_LENGTH];
} energy_sums;

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

/* The third difference along x, whose weights stand side by side; along z it is difference_third(). */
INLINED double third_along_x(const grid_stencils *stencils, size_t station, const double *y)
{
	double sum = 0.0;
	for (ptrdiff_t k = 0; k < STENCIL_THIRD; k++)
		sum += stencils->third_x[k][station] * (y[k - 1] - y[k - 2]);
	return sum;
}

INLINED graph_third third_of(const grid_stencils *stencils, const grid_stencil *z, node_stencil w,
                             size_t station, const double *y, ptrdiff_t row)
{
	double along_x[3], along_z[3];
	for (ptrdiff_t n = 0; n < 3; n++) {
		const double *line = y + (n - 1) * row, *column = y + (n - 1);
		along_x[n] = stencil_second(w.x[2], w.x[3], line[-1], line[0], line[1]);
		along_z[n] = stencil_second(w.z[2], w.z[3], column[-row], column[0], column[row]);
	}
	return (graph_third){
		.y_xxx = third_along_x(stencils, station, y),
		.y_xxz = stencil_first(w.z[0], w.z[1], along_x[0], along_x[1], along_x[2]),
		.y_xzz = stencil_first(w.x[0], w.x[1], along_z[0], along_z[1], along_z[2]),
		.y_zzz = difference_third(&z->third, y, row),
	};
}

/* A run of `count` nodes, those from `done` on; wide: the table goes on two rows below and above. */
INLINED void work_run(const batten_hull *hull, const grid_stencils *stencils,
                      const grid_counted *counted, size_t waterline, size_t station, size_t done,
                      size_t count, bool wide, energy_sums *sums)
{
	static const double place[RUN_LENGTH] = { 0, 1, 2, 3, 4, 5, 6, 7 };
	const ptrdiff_t row = (ptrdiff_t)hull->station_count;
	const size_t first = waterline * hull->station_count + station;
	const double *y = hull->y_m + first;
	const double *near = counted->near + first, *far = counted->wide + first;
	const double from = (double)done;
	const grid_stencils along = *stencils;
	const grid_stencil z = stencils->z[waterline];
	double bending[RUN_LENGTH], mean[RUN_LENGTH], gauss[RUN_LENGTH], variation[RUN_LENGTH];
	RUN_LOOP
	for (size_t l = 0; l < count; l++) {
		const node_stencil w = stencil_of(&along, &z, station + l);
		const node_slopes d = slopes_of(w, row_at(y + l - row), row_at(y + l), row_at(y + l + row));
		const node_tangent t = tangent_of(GRID_BENDING, d.y_x, d.y_z);
		const double cell = along.cell_x_m[station + l] * z.cell_m;
		const double twice = (t.across * d.y_xx - t.twice_product * d.y_xz) + t.along * d.y_zz;
		const double product = d.y_xx * d.y_zz - d.y_xz * d.y_xz;
		const double bent = bending_of(t, d.y_xx, d.y_xz, d.y_zz);
		const bool here = (near[l] > 0) & (place[l] >= from);
		const bool bends = here & (bent > 0);
		bending[l] = bends ? bent * cell : 0.0;
		mean[l] = here ? 0.25 * (twice * twice) * (t.inverse * t.inverse) * t.root * cell : 0.0;
		gauss[l] = here ? fabs(product) * t.inverse * t.root * cell : 0.0;
		variation[l] = 0.0;
		if (wide) {
			const graph_third third = third_of(&along, &z, w, station + l, y + l, row);
			const double varied = graph_variation_of(d, third, t) * cell;
			const bool varies = (far[l] > 0) & (place[l] >= from);
			variation[l] = varies ? varied : 0.0;
		}
	}
	RUN_LOOP
	for (size_t l = 0; l < count; l++) {
		sums->bending[l] += bending[l];
		sums->mean[l] += mean[l];
		sums->gauss[l] += gauss[l];
		sums->variation[l] += variation[l];
	}
}

INLINED void work_row(const batten_hull *hull, const grid_stencils *stencils,
                      const grid_counted *counted, size_t waterline, bool wide, energy_sums *sums)
{
	const size_t end = hull->station_count - 1;
	if (end < 1 + RUN_LENGTH) {
		work_run(hull, stencils, counted, waterline, 1, 0, end - 1, wide, sums);
		return;
	}
	for (size_t i = 1, next = 1; next < end; i = run_after(i, end)) {
		work_run(hull, stencils, counted, waterline, i, next - i, RUN_LENGTH, wide, sums);
		next = i + RUN_LENGTH;
	}
}

INLINED void work_rows(const batten_hull *hull, const grid_stencils *stencils,
                       const grid_counted *counted, energy_sums *sums)
{
	const size_t nz = hull->waterline_count;
	for (size_t j = 1; j + 1 < nz; j++)
		if (j >= REACH && j + REACH < nz)
			work_row(hull, stencils, counted, j, true, sums);
		else
			work_row(hull, stencils, counted, j, false, sums);
}

RUNS_FUNCTION(add_rows, work_rows,
              (const batten_hull *hull, const grid_stencils *stencils, const grid_counted *counted,
               energy_sums *sums),
              (hull, stencils, counted, sums))

grid_energies grid_energies_of(const batten_hull *hull, const grid_stencils *stencils,
                               const grid_counted *counted)
{
	energy_sums sums = { 0 };
	grid_energies total = { 0 };
	if (counted->near_count > 0)
		add_rows(hull, stencils, counted, &sums);
	else
		total = (grid_energies){ NAN, NAN, NAN, NAN };
	if (counted->wide_count == 0)
		total.variation_per_m2 = NAN;
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		total.bending += sums.bending[l];
		total.mean += sums.mean[l];
		total.gauss += sums.gauss[l];
		total.variation_per_m2 += sums.variation[l];
	}
	return total;
}
