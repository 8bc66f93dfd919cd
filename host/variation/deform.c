/* A hull whose points are moved in space, on a table again.
 *
 * Every waterline is moved as a line in space and cut by the stations' planes, which gives points of
 * the sections; these are taken at the heights of the waterlines. Both by the splines used elsewhere:
 * natural along the ship, not-a-knot along the sections, broken at knuckles. Where a station or a
 * waterline moves as one, it does so in the table, and nothing is taken between points. */
#include "variation/deform.h"

#include <math.h>
#include <stdio.h>

/* Places this near, in parts of the table's length or height, are one. */
#define NEAR_PART 1e-11

/* ------------------------------------------------------------------------------------------------
 * The map
 * --------------------------------------------------------------------------------------------- */

/* Where a point of the hull goes; the centreplane stays. */
static void move_point(struct deformation *work, double x_m, double y_m, double z_m, double out[3])
{
	const double place[3] = { x_m, y_m, z_m };
	work->map->move(work->map->user, place, out);
	work->crossed += y_m > 0 && out[1] < 0;
	out[1] = y_m > 0 ? fmax(out[1], 0) : 0;
}

/* Determinant of the derivatives of the map, by differences that lead away from the table's edges. */
static double determinant(const struct deformation *work, const double place[3])
{
	const batten_hull *hull = work->parent;
	const double middle[3] = { 0.5 * (hull->x_m[0] + hull->x_m[hull->station_count - 1]), INFINITY,
		                       0.5 * (hull->z_m[0] + hull->z_m[hull->waterline_count - 1]) };
	const double step = 1e-6 * hull->draft_m;
	double at[3], by[3][3];
	work->map->move(work->map->user, place, at);
	for (size_t c = 0; c < 3; c++) {
		double beside[3] = { place[0], place[1], place[2] }, moved[3];
		const double d = place[c] < middle[c] ? step : -step;
		beside[c] += d;
		work->map->move(work->map->user, beside, moved);
		for (size_t i = 0; i < 3; i++)
			by[i][c] = (moved[i] - at[i]) / d;
	}
	return by[0][0] * (by[1][1] * by[2][2] - by[1][2] * by[2][1]) -
	       by[0][1] * (by[1][0] * by[2][2] - by[1][2] * by[2][0]) +
	       by[0][2] * (by[1][0] * by[2][1] - by[1][1] * by[2][0]);
}

batten_status deformation_fail_fold(const struct deformation *work, double x_m, double z_m)
{
	return batten_fail(work->context, BATTEN_INPUT,
	                   "%s: about x = %.4g m, z = %.4g m the map would fold the hull",
	                   work->parent->name, x_m, z_m);
}

/* At every point of the hull, halfway to the centreplane and in it. */
static batten_status check_fold(const struct deformation *work)
{
	const batten_hull *hull = work->parent;
	for (size_t i = 0; i < hull_node_count(hull); i++)
		for (int k = 0; k <= 2 && hull->nodes[i] != BATTEN_NODE_OUTSIDE; k++) {
			const double place[3] = { hull->x_m[i % hull->station_count], 0.5 * k * hull->y_m[i],
				                      hull->z_m[i / hull->station_count] };
			const double size = determinant(work, place);
			if (!isfinite(size))
				return batten_fail(work->context, BATTEN_INPUT,
				                   "%s: the map takes x = %.4g m, z = %.4g m to no place",
				                   hull->name, place[0], place[2]);
			if (!(size > 0))
				return deformation_fail_fold(work, place[0], place[2]);
		}
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Waterlines in space
 * --------------------------------------------------------------------------------------------- */

static batten_status move_line(struct deformation *work, size_t number)
{
	const batten_hull *hull = work->parent;
	struct moved_line *line = &work->lines[number];
	variation_line *shape = &line->shape;
	batten_status status = variation_line_take(work->context, hull, number, shape);
	if (status != BATTEN_OK)
		return status;
	line->z_m = batten_allocate(work->context, shape->count, sizeof *line->z_m);
	line->place = batten_allocate(work->context, shape->count, sizeof *line->place);
	if (!line->z_m || !line->place)
		return BATTEN_MEMORY;
	size_t station = 0;
	for (size_t i = 0; i < shape->count; i++) {
		const double x = shape->x_m[i];
		while (station < hull->station_count && hull->x_m[station] < x)
			station++;
		line->place[i] = station < hull->station_count && hull->x_m[station] <= x ? station
		                                                                          : SIZE_MAX;
		double moved[3];
		move_point(work, x, shape->y_m[i], hull->z_m[number], moved);
		shape->x_m[i] = moved[0];
		shape->y_m[i] = moved[1];
		line->z_m[i] = moved[2];
		if (i > 0 && !(moved[0] > shape->x_m[i - 1]))
			return deformation_fail_fold(work, x, hull->z_m[number]);
	}
	return BATTEN_OK;
}

bool deformation_is_hull(const struct deformation *work, size_t waterline, size_t place)
{
	return place == SIZE_MAX ||
	       work->parent->nodes[waterline * work->parent->station_count + place] !=
	           BATTEN_NODE_OUTSIDE;
}

/* Least and largest of the moved coordinate over the points of the hull on each station (along) or
 * on each waterline: spread[2 i], spread[2 i + 1]; the least above the largest without points. */
static void take_spread(const struct deformation *work, bool along, double *spread)
{
	const size_t count = along ? work->parent->station_count : work->parent->waterline_count;
	for (size_t i = 0; i < count; i++) {
		spread[2 * i] = INFINITY;
		spread[2 * i + 1] = -INFINITY;
	}
	for (size_t w = 0; w < work->parent->waterline_count; w++) {
		const struct moved_line *line = &work->lines[w];
		for (size_t i = 0; i < line->shape.count; i++) {
			const size_t number = along ? line->place[i] : w;
			const double value = along ? line->shape.x_m[i] : line->z_m[i];
			if (number == SIZE_MAX || !deformation_is_hull(work, w, line->place[i]))
				continue;
			spread[2 * number] = fmin(spread[2 * number], value);
			spread[2 * number + 1] = fmax(spread[2 * number + 1], value);
		}
	}
}

/* Where the stations (waterlines) stand afterwards: *as_one where each of them moves as one. */
static batten_status place_table(const struct deformation *work, bool along, bool *as_one)
{
	const batten_hull *hull = work->parent;
	const size_t count = along ? hull->station_count : hull->waterline_count;
	double *table = along ? work->variant->x_m : work->variant->z_m;
	const double near = along ? work->near_x_m : work->near_z_m;
	double *spread = batten_allocate(work->context, count, 2 * sizeof *spread);
	if (!spread)
		return BATTEN_MEMORY;
	take_spread(work, along, spread);
	*as_one = true;
	for (size_t i = 0; i < count; i++)
		*as_one = *as_one && !(spread[2 * i + 1] - spread[2 * i] > near);
	for (size_t i = 0; *as_one && i < count; i++) {
		const double place[3] = { along ? hull->x_m[i] : 0.5 * hull->lbp_m, 0,
			                      along ? hull->draft_m : hull->z_m[i] };
		double moved[3];
		work->map->move(work->map->user, place, moved);
		table[i] = spread[2 * i] <= spread[2 * i + 1] ? spread[2 * i] : moved[along ? 0 : 2];
	}
	batten_release(work->context, spread);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Points off the grid
 * --------------------------------------------------------------------------------------------- */

static void move_extras(struct deformation *work)
{
	const batten_hull *parent = work->parent;
	batten_hull *variant = work->variant;
	double moved[3];
	for (size_t i = 0; i < parent->end_count; i++) {
		const hull_line_end *end = &parent->ends[i];
		move_point(work, end->along_m, end->y_m, parent->z_m[end->line], moved);
		variant->ends[i].along_m = moved[0];
		variant->ends[i].y_m = moved[1];
	}
	for (size_t i = 0; i < parent->profile_count; i++) {
		const hull_profile_point *point = &parent->profile[i];
		move_point(work, point->x_m, point->y_m, point->z_m, moved);
		variant->profile[i] = (hull_profile_point){ point->kind, moved[0], moved[1], moved[2] };
	}
	/* A knuckle stays on its line. */
	for (size_t i = 0; i < parent->knuckle_count; i++) {
		hull_knuckle *knuckle = &variant->knuckles[i];
		const size_t station = hull_station_at(parent, knuckle->x_m);
		const size_t waterline = hull_waterline_at(parent, knuckle->z_m);
		const bool known = station != SIZE_MAX && waterline != SIZE_MAX;
		const double y = known ? parent->y_m[waterline * parent->station_count + station] : 0;
		move_point(work, knuckle->x_m, y, knuckle->z_m, moved);
		if (knuckle->on_waterline && waterline != SIZE_MAX)
			*knuckle = (hull_knuckle){ true, moved[0], variant->z_m[waterline] };
		else if (station != SIZE_MAX)
			*knuckle = (hull_knuckle){ false, variant->x_m[station], moved[2] };
	}
	hull_knuckle_sort(variant);
}

static batten_status check_ends(const struct deformation *work)
{
	for (size_t i = 0; i < work->parent->end_count; i++)
		if (!work->waterlines_move || !work->parent->ends[i].on_waterline)
			return batten_fail(work->context, BATTEN_INPUT,
			                   "%s: its lines end off the grid, and the map takes these ends off "
			                   "their lines; a table of layout grid is expected",
			                   work->parent->name);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * The whole
 * --------------------------------------------------------------------------------------------- */

static batten_status deform(struct deformation *work)
{
	const batten_hull *parent = work->parent;
	const size_t nodes = hull_node_count(parent);
	work->lines = batten_allocate(work->context, parent->waterline_count, sizeof *work->lines);
	work->y_m = batten_allocate(work->context, nodes, 2 * sizeof *work->y_m);
	if (!work->lines || !work->y_m)
		return BATTEN_MEMORY;
	work->z_m = work->y_m + nodes;
	batten_status status = check_fold(work);
	for (size_t w = 0; w < parent->waterline_count && status == BATTEN_OK; w++)
		status = move_line(work, w);
	if (status == BATTEN_OK)
		status = place_table(work, true, &work->stations_move);
	if (status == BATTEN_OK)
		status = place_table(work, false, &work->waterlines_move);
	if (status == BATTEN_OK)
		status = check_ends(work);
	if (status == BATTEN_OK)
		status = deformation_cut_lines(work);
	if (status != BATTEN_OK)
		return status;
	move_extras(work);
	return deformation_take_sections(work);
}

static void report(const struct deformation *work, batten_vary_outcome *outcome)
{
	if (work->crossed > 0)
		(void)snprintf(outcome->warning, sizeof outcome->warning,
		               "%zu points would cross the centreplane and lie in it", work->crossed);
	else if (work->cut_off > 0)
		(void)snprintf(outcome->warning, sizeof outcome->warning,
		               "%zu sections go beyond the topmost waterline of the table, which ends them",
		               work->cut_off);
}

batten_status variation_deform(batten_context *context, const batten_hull *parent,
                               const variation_map *map, batten_hull **out,
                               batten_vary_outcome *outcome)
{
	const double *x = parent->x_m, *z = parent->z_m;
	struct deformation work = {
		.context = context,
		.parent = parent,
		.map = map,
		.near_x_m = NEAR_PART * (x[parent->station_count - 1] - x[0]),
		.near_z_m = NEAR_PART * (z[parent->waterline_count - 1] - z[0]),
	};
	batten_status status = batten_hull_clone(context, parent, &work.variant);
	if (status == BATTEN_OK)
		status = deform(&work);
	for (size_t w = 0; work.lines && w < parent->waterline_count; w++) {
		variation_line_destroy(context, &work.lines[w].shape);
		batten_release(context, work.lines[w].z_m);
		batten_release(context, work.lines[w].place);
	}
	batten_release(context, work.lines);
	batten_release(context, work.y_m);
	if (status != BATTEN_OK) {
		batten_hull_destroy(work.variant);
		return status;
	}
	report(&work, outcome);
	*out = work.variant;
	return BATTEN_OK;
}
