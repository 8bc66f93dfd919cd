#include "fairing/measure_room.h"

#include "fairing/grid_lines.h"
#include "fairing/grid_noise.h"
#include "fairing/noise.h"
#include "geometry/grid_curvature.h"
#include "geometry/grid_variation.h"

#include <math.h>
#include <string.h>

struct measure_room {
	batten_context *context;
	batten_hull
		*table; /* coordinates and nodes that the rest is made for; NULL before the first hull */
	bool knows_nodes; /* lines and noise are those of the table's nodes */
	grid_stencils stencils;
	grid_curvature *grid;
	grid_lines
		*lines[2];     /* waterlines, sections; NULL where a hull's are to be worked one by one */
	grid_noise *noise; /* NULL likewise */
};

/* ---- what a table and its nodes give ---- */

batten_status measure_room_create(batten_context *context, measure_room **out)
{
	measure_room *room = batten_allocate(context, 1, sizeof *room);
	if (!room)
		return BATTEN_MEMORY;
	room->context = context;
	*out = room;
	return BATTEN_OK;
}

static void forget_lines(measure_room *room)
{
	for (size_t k = 0; k < 2; k++) {
		grid_lines_destroy(room->lines[k]);
		room->lines[k] = NULL;
	}
	grid_noise_destroy(room->noise);
	room->noise = NULL;
	room->knows_nodes = false;
}

static void forget_table(measure_room *room)
{
	forget_lines(room);
	grid_curvature_destroy(room->context, room->grid);
	room->grid = NULL;
	grid_stencils_destroy(room->context, &room->stencils);
	batten_hull_destroy(room->table);
	room->table = NULL;
}

void measure_room_destroy(measure_room *room)
{
	if (!room)
		return;
	forget_table(room);
	batten_release(room->context, room);
}

static batten_status take_table(measure_room *room, const batten_hull *hull)
{
	const size_t nx = hull->station_count;
	const size_t nz = hull->waterline_count;
	forget_table(room);
	batten_hull *table = hull_allocate(room->context, nx, nz);
	if (!table)
		return BATTEN_MEMORY;
	memcpy(table->x_m, hull->x_m, nx * sizeof *table->x_m);
	memcpy(table->z_m, hull->z_m, nz * sizeof *table->z_m);
	room->table = table;
	batten_status status = grid_stencils_create(room->context, nx, table->x_m, nz, table->z_m,
	                                            &room->stencils);
	if (status == BATTEN_OK)
		status = grid_curvature_allocate(room->context, nx, nz, &room->grid);
	if (status != BATTEN_OK)
		forget_table(room);
	return status;
}

static batten_status know_table(measure_room *room, const batten_hull *hull)
{
	return room->table && hull_same_table(room->table, hull) ? BATTEN_OK : take_table(room, hull);
}

static batten_status know_nodes(measure_room *room, const batten_hull *hull)
{
	const size_t size = hull_node_count(hull);
	batten_status status = know_table(room, hull);
	if (status != BATTEN_OK ||
	    (room->knows_nodes && memcmp(room->table->nodes, hull->nodes, size) == 0))
		return status;
	forget_lines(room);
	memcpy(room->table->nodes, hull->nodes, size);
	for (size_t k = 0; k < 2 && lines_are_of_grid(hull) && status == BATTEN_OK; k++)
		status = grid_lines_create(room->context, hull, k == 0, &room->lines[k]);
	if (status == BATTEN_OK && grid_noise_fits(hull))
		status = grid_noise_create(room->context, hull, &room->noise);
	room->knows_nodes = status == BATTEN_OK;
	return status;
}

/* ---- measures ---- */

static batten_status take_lines(const measure_room *room, const batten_hull *hull, bool waterlines,
                                lines_sum *out)
{
	grid_lines *lines = room->lines[waterlines ? 0 : 1];
	if (!lines || !lines_are_of_grid(hull))
		return lines_of_hull(hull, waterlines, out);
	*out = grid_lines_sum(lines, hull->y_m);
	return BATTEN_OK;
}

static batten_status take_noise(const measure_room *room, const batten_hull *hull, double *out)
{
	double along[2];
	if (!room->noise || !grid_noise_fits(hull))
		return noise_estimate(room->context, hull, out);
	grid_noise_scales(room->noise, hull->y_m, along);
	*out = noise_of_scales(along);
	return BATTEN_OK;
}

/* Where a node has no curvature of its own, its area is 0. */
static void take_energies(const measure_room *room, const batten_hull *hull, batten_measures *out)
{
	grid_curvature *grid = room->grid;
	grid_curvature_fill(hull, &room->stencils, grid);
	double bending = 0, mean = 0, gauss = 0;
	for (size_t i = 0; i < hull_node_count(hull); i++) {
		const double area = grid->area_m2[i];
		bending += grid->bending_per_m2[i] * area;
		mean += grid->mean_per_m[i] * grid->mean_per_m[i] * area;
		gauss += fabs(grid->gauss_per_m2[i]) * area;
	}
	const bool any = grid->own_count > 0;
	out->energy_bending = any ? bending : NAN;
	out->energy_mean = any ? mean : NAN;
	out->energy_gauss = any ? gauss : NAN;
	out->energy_mvc_per_m2 = grid_variation_sum(hull, &room->stencils, grid);
}

batten_status measure_room_fairness(measure_room *room, const batten_hull *hull,
                                    batten_measures *out)
{
	lines_sum waterlines, sections;
	batten_status status = know_nodes(room, hull);
	if (status == BATTEN_OK)
		status = take_lines(room, hull, true, &waterlines);
	if (status == BATTEN_OK)
		status = take_lines(room, hull, false, &sections);
	if (status == BATTEN_OK)
		status = take_noise(room, hull, &out->noise_m);
	if (status != BATTEN_OK)
		return status;
	out->fn_per_m2 = waterlines.fn_per_m2;
	out->fn_sections_per_m2 = sections.fn_per_m2;
	out->inflections = (double)(waterlines.inflections + sections.inflections);
	take_energies(room, hull, out);
	return BATTEN_OK;
}

batten_status measure_room_closeness(measure_room *room, const batten_hull *hull,
                                     const batten_hull *reference, batten_closeness *out)
{
	const batten_status status = know_table(room, hull);
	if (status != BATTEN_OK)
		return status;
	batten_closeness made = { 0 };
	double squares = 0, counted = 0;
	for (size_t j = 0, node = 0; j < hull->waterline_count; j++)
		for (size_t i = 0; i < hull->station_count; i++, node++) {
			/* Neither outside, nor a '?': what fills it is no offset that could move. */
			const bool given = hull->nodes[node] == BATTEN_NODE_GIVEN;
			const double y = hull->y_m[node];
			const double change = given ? y - reference->y_m[node] : 0.0;
			const bool counts = given && (y > 0 || reference->y_m[node] > 0);
			made.closeness_m4 += change * change * room->stencils.cell_x_m[i] *
			                     room->stencils.z[j].cell_m;
			made.cn_max_m = fabs(change) > made.cn_max_m ? fabs(change) : made.cn_max_m;
			squares += counts ? change * change : 0.0;
			counted += counts ? 1.0 : 0.0;
		}
	made.cn_rms_m = counted > 0 ? sqrt(squares / counted) : 0;
	const double half_beam = batten_hull_half_beam_m(reference);
	made.cn_pct = half_beam > 0 ? 100 * made.cn_max_m / half_beam : NAN;
	*out = made;
	return BATTEN_OK;
}
