/* The sections of a hull whose waterlines were moved in space. */
#include "hydrostatics/section.h"
#include "variation/deform.h"

#include <math.h>

/* The point of a moved waterline in the plane of a station, if there is one. */
static void cut_line(const struct deformation *work, size_t number, const curve *breadth,
                     const curve *height)
{
	const batten_hull *variant = work->variant;
	const struct moved_line *line = &work->lines[number];
	const size_t count = line->shape.count, row = number * variant->station_count;
	size_t next = 0;
	for (size_t s = 0; s < variant->station_count; s++) {
		const double x = variant->x_m[s];
		work->y_m[row + s] = work->z_m[row + s] = NAN;
		while (next < count && line->shape.x_m[next] < x - work->near_x_m)
			next++;
		if (next < count && line->shape.x_m[next] <= x + work->near_x_m) {
			work->y_m[row + s] = line->shape.y_m[next];
			work->z_m[row + s] = line->z_m[next];
		} else if (next > 0 && next < count &&
		           (variant->layout == HULL_LAYOUT_GRID || deformation_is_hull(work, number, s))) {
			work->y_m[row + s] = fmax(curve_value(breadth, x), 0);
			work->z_m[row + s] = curve_value(height, x);
		}
	}
}

batten_status deformation_cut_lines(const struct deformation *work)
{
	batten_status status = BATTEN_OK;
	for (size_t w = 0; w < work->parent->waterline_count && status == BATTEN_OK; w++) {
		const struct moved_line *line = &work->lines[w];
		variation_line height = line->shape;
		height.y_m = line->z_m;
		curve breadths = { 0 }, heights = { 0 };
		if (line->shape.count > 0)
			status = variation_line_curve(work->context, &line->shape, &breadths);
		if (line->shape.count > 0 && status == BATTEN_OK)
			status = variation_line_curve(work->context, &height, &heights);
		if (status == BATTEN_OK)
			cut_line(work, w, &breadths, &heights);
		curve_destroy(&heights);
		curve_destroy(&breadths);
	}
	return status;
}

/* The points of one section, from the zero below the first positive half-breadth on. */
struct section_points {
	size_t count, first; /* first: the one the hull begins with */
	double *y_m, *z_m;
	unsigned char *breaks;
	double floor_m; /* height of the keel under a flat bottom; NaN without one */
};

static batten_status collect(const struct deformation *work, size_t station,
                             struct section_points *out)
{
	const batten_hull *parent = work->parent;
	const size_t stations = parent->station_count;
	double *along = out->z_m; /* heights of the parent first, for its knuckles */
	size_t lowest = SIZE_MAX;
	out->count = out->first = 0;
	for (size_t w = 0; w < parent->waterline_count; w++) {
		if (isnan(work->y_m[w * stations + station]))
			continue;
		lowest = lowest == SIZE_MAX ? w : lowest;
		along[out->count++] = parent->z_m[w];
	}
	section_mark_knuckles(parent, false, station, out->count, along, out->breaks);
	out->count = 0;
	for (size_t w = 0; w < parent->waterline_count; w++) {
		const double y = work->y_m[w * stations + station], z = work->z_m[w * stations + station];
		if (isnan(y))
			continue;
		if (out->count > 0 && !(z > out->z_m[out->count - 1]))
			return deformation_fail_fold(work, parent->x_m[station], parent->z_m[w]);
		out->y_m[out->count] = y;
		out->z_m[out->count] = z;
		out->count++;
	}
	while (out->first + 1 < out->count && out->y_m[out->first] <= 0 &&
	       out->y_m[out->first + 1] <= 0)
		out->first++;
	out->floor_m = NAN;
	if (out->count > 0 && out->first == 0 && out->y_m[0] > 0) {
		const double place[3] = { parent->x_m[station], 0, parent->z_m[lowest] };
		double moved[3];
		work->map->move(work->map->user, place, moved);
		out->floor_m = moved[2];
		if (out->floor_m > out->z_m[0] + work->near_z_m)
			return batten_fail(work->context, BATTEN_INPUT,
			                   "%s: at x = %.4g m the floor would fall below the keel",
			                   parent->name, parent->x_m[station]);
	}
	return BATTEN_OK;
}

/* Half-breadth of a section at a height; NaN above it, and below it where lines are listed. */
static double breadth_at(const struct deformation *work, const struct section_points *points,
                         const curve *shape, double z_m)
{
	const size_t first = points->first, last = points->count - 1;
	const bool listed = work->variant->layout != HULL_LAYOUT_GRID;
	for (size_t i = 0; i < points->count; i++)
		if (fabs(points->z_m[i] - z_m) <= work->near_z_m)
			return points->y_m[i];
	if (z_m > points->z_m[last])
		return NAN;
	if (z_m >= points->z_m[first])
		return fmax(curve_value(shape, z_m), 0);
	if (z_m >= points->floor_m)
		return points->y_m[first] * (z_m - points->floor_m) /
		       (points->z_m[first] - points->floor_m);
	return listed && z_m < points->z_m[0] ? NAN : 0;
}

static batten_status take_section(struct deformation *work, struct section_points *points,
                                  size_t station, double *y_m)
{
	const size_t stations = work->variant->station_count;
	const double *table = work->variant->z_m;
	batten_status status = collect(work, station, points);
	if (status != BATTEN_OK)
		return status;
	for (size_t w = 0; w < work->variant->waterline_count; w++)
		y_m[w * stations + station] = work->y_m[w * stations + station];
	if (work->waterlines_move || points->count == 0)
		return BATTEN_OK;
	work->cut_off += points->z_m[points->count - 1] >
	                 table[work->variant->waterline_count - 1] + work->near_z_m;
	curve shape;
	const size_t first = points->first;
	status = curve_create(work->context, points->count - first, points->z_m + first,
	                      points->y_m + first, points->breaks + first, SPLINE_NOT_A_KNOT, &shape);
	if (status != BATTEN_OK)
		return status == BATTEN_USAGE ? BATTEN_INPUT : status;
	for (size_t w = 0; w < work->variant->waterline_count; w++)
		y_m[w * stations + station] = breadth_at(work, points, &shape, table[w]);
	curve_destroy(&shape);
	return BATTEN_OK;
}

batten_status deformation_take_sections(struct deformation *work)
{
	const size_t lines = work->parent->waterline_count;
	batten_context *context = work->context;
	struct section_points points = {
		.y_m = batten_allocate(context, lines, sizeof(double)),
		.z_m = batten_allocate(context, lines, sizeof(double)),
		.breaks = batten_allocate(context, lines, 1),
	};
	double *y = batten_allocate(context, hull_node_count(work->variant), sizeof *y);
	batten_status status = points.y_m && points.z_m && points.breaks && y ? BATTEN_OK
	                                                                      : BATTEN_MEMORY;
	for (size_t s = 0; s < work->variant->station_count && status == BATTEN_OK; s++)
		status = take_section(work, &points, s, y);
	if (status == BATTEN_OK)
		status = variation_check_size(work->variant);
	if (status == BATTEN_OK)
		status = variation_set_offsets(work->variant, y);
	batten_release(context, y);
	batten_release(context, points.breaks);
	batten_release(context, points.z_m);
	batten_release(context, points.y_m);
	return status;
}
