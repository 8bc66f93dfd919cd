#include "fairing/measure_room.h"

#include "fairing/grid_lines.h"
#include "fairing/grid_noise.h"
#include "fairing/noise.h"
#include "geometry/grid_energies.h"

#include <math.h>
#include <string.h>

struct measure_room {
	batten_context *context;
	batten_hull
		*table; /* coordinates and nodes that the rest is made for; NULL before the first hull */
	bool knows_nodes; /* what follows the stencils is that of the table's nodes */
	grid_stencils stencils;
	grid_counted counted;
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

static void forget_nodes(measure_room *room)
{
	for (size_t k = 0; k < 2; k++) {
		grid_lines_destroy(room->lines[k]);
		room->lines[k] = NULL;
	}
	grid_noise_destroy(room->noise);
	room->noise = NULL;
	grid_counted_destroy(room->context, &room->counted);
	room->knows_nodes = false;
}

static void forget_table(measure_room *room)
{
	forget_nodes(room);
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
	forget_nodes(room);
	memcpy(room->table->nodes, hull->nodes, size);
	for (size_t k = 0; k < 2 && lines_are_of_grid(hull) && status == BATTEN_OK; k++)
		status = grid_lines_create(room->context, hull, k == 0, &room->lines[k]);
	if (status == BATTEN_OK && grid_noise_fits(hull))
		status = grid_noise_create(room->context, hull, &room->noise);
	if (status == BATTEN_OK)
		status = grid_counted_create(room->context, hull, &room->counted);
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

static void take_energies(const measure_room *room, const batten_hull *hull, batten_measures *out)
{
	const grid_energies energies = grid_energies_of(hull, &room->stencils, &room->counted);
	out->energy_bending = energies.bending;
	out->energy_mean = energies.mean;
	out->energy_gauss = energies.gauss;
	out->energy_mvc_per_m2 = energies.variation_per_m2;
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
