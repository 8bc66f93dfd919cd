#include "hydrostatics/section.h"

#include <math.h>

/* Points of a section while it is put together. */
typedef struct section_points {
	size_t first, count; /* the points are first .. first + count - 1 */
	double *z, *y, *y_x;
	unsigned char *breaks;
} section_points;

void section_mark_knuckles(const batten_hull *hull, bool waterline, size_t line, size_t count,
                           const double *along_m, unsigned char *breaks)
{
	const double *table = waterline ? hull->x_m : hull->z_m;
	size_t table_count = waterline ? hull->station_count : hull->waterline_count;
	/* hull_knuckle_between() takes a knuckle within 1e-9 of the table for one at the end */
	double near = 4e-9 * (table[table_count - 1] - table[0]);
	for (size_t i = 0; i + 1 < count; i++) {
		double here = along_m[i], next = along_m[i + 1];
		breaks[i] = CURVE_SMOOTH;
		if (hull_knuckle_between(hull, waterline, line, here, here))
			breaks[i] |= CURVE_BREAK_AT;
		if (hull_knuckle_between(hull, waterline, line, here + near, next - near))
			breaks[i] |= CURVE_BREAK_AFTER;
	}
}

/* Marks knuckles and gaps at and between points first .. first + count - 1 of a line. */
static void mark_breaks(const batten_hull *hull, bool waterline, size_t line,
                        const hull_line *points, size_t first, size_t count, unsigned char *breaks)
{
	section_mark_knuckles(hull, waterline, line, count, points->along_m + first, breaks);
	for (size_t i = 0; i + 1 < count; i++)
		if (points->gap[first + i + 1])
			breaks[i] |= CURVE_BREAK_AFTER;
}

/* Drops zeros that stand before another zero, at both ends: the hull begins and ends at the one
 * next to a positive half-breadth. A line of zeros only is kept. */
static void trim_zeros(const hull_line *points, size_t *first, size_t *count)
{
	size_t begin = 0, end = points->count;
	while (begin + 1 < end && points->value_m[begin] <= 0 && points->value_m[begin + 1] <= 0)
		begin++;
	if (begin + 1 >= end) {
		*first = 0;
		*count = points->count;
		return;
	}
	while (end > begin + 1 && points->value_m[end - 1] <= 0 && points->value_m[end - 2] <= 0)
		end--;
	*first = begin;
	*count = end - begin;
}

/* The slopes y_x of one waterline at its nodes, and its ends. */
static batten_status take_waterline(section_source *source, size_t line)
{
	const batten_hull *hull = source->hull;
	hull_line points;
	batten_status status = hull_line_collect(hull, true, line, true, &points);
	if (status != BATTEN_OK)
		return status;
	size_t first = 0, count = 0;
	curve shape = { 0 };
	unsigned char *breaks = batten_allocate(hull->context, points.count, 1);
	if (!breaks)
		status = BATTEN_MEMORY;
	if (status == BATTEN_OK && points.count > 0) {
		trim_zeros(&points, &first, &count);
		const double *x = points.along_m + first, *y = points.value_m + first;
		source->ends[line] = (section_ends){ x[0], y[0], x[count - 1], y[count - 1] };
		mark_breaks(hull, true, line, &points, first, count, breaks);
		status = curve_create(hull->context, count, x, y, breaks, SPLINE_NOT_A_KNOT, &shape);
		for (size_t i = first; status == BATTEN_OK && count > 1 && i < first + count; i++)
			if (points.place[i] != SIZE_MAX)
				source->slopes[line * hull->station_count + points.place[i]] = curve_slope(
					&shape, points.along_m[i]);
		curve_destroy(&shape);
	}
	batten_release(hull->context, breaks);
	hull_line_release(hull, &points);
	return status;
}

batten_status section_source_create(batten_context *context, const batten_hull *hull,
                                    section_source *out)
{
	section_source source = { .hull = hull };
	size_t nodes = hull_node_count(hull);
	source.ends = batten_allocate(context, hull->waterline_count, sizeof *source.ends);
	source.slopes = batten_allocate(context, nodes, sizeof *source.slopes);
	batten_status status = source.ends && source.slopes ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t i = 0; status == BATTEN_OK && i < nodes; i++)
		source.slopes[i] = NAN;
	for (size_t j = 0; status == BATTEN_OK && j < hull->waterline_count; j++) {
		source.ends[j] = (section_ends){ NAN, NAN, NAN, NAN };
		status = take_waterline(&source, j);
	}
	if (status != BATTEN_OK) {
		section_source_destroy(&source);
		return status;
	}
	*out = source;
	return BATTEN_OK;
}

void section_source_destroy(section_source *source)
{
	if (!source->hull)
		return;
	batten_release(source->hull->context, source->slopes);
	batten_release(source->hull->context, source->ends);
	*source = (section_source){ 0 };
}

section_ends section_ends_at(const section_source *source, double z_m)
{
	const batten_hull *hull = source->hull;
	size_t line = hull_waterline_at(hull, z_m);
	if (line != SIZE_MAX)
		return source->ends[line];
	section_ends none = { NAN, NAN, NAN, NAN };
	for (size_t j = 0; j + 1 < hull->waterline_count; j++) {
		double below = hull->z_m[j], above = hull->z_m[j + 1];
		if (z_m < below || z_m > above)
			continue;
		const section_ends *a = &source->ends[j], *b = &source->ends[j + 1];
		double part = (z_m - below) / (above - below);
		return (section_ends){ a->aft_x_m + part * (b->aft_x_m - a->aft_x_m),
			                   a->aft_y_m + part * (b->aft_y_m - a->aft_y_m),
			                   a->fore_x_m + part * (b->fore_x_m - a->fore_x_m),
			                   a->fore_y_m + part * (b->fore_y_m - a->fore_y_m) };
	}
	return none;
}

/* Where the edge of the hull crosses station x between waterline line, which reaches the station,
 * and the one below it, which ends in a profile point before it; NaN where the hull has a flat
 * bottom there instead. y and z are the section's two lowest points. */
static double edge_height(const section_source *source, double x_m, size_t line, size_t count,
                          const double *z, const double *y)
{
	if (line == 0 || line == SIZE_MAX)
		return NAN;
	const section_ends *below = &source->ends[line - 1], *here = &source->ends[line];
	double low = source->hull->z_m[line - 1], high = source->hull->z_m[line];
	bool aft = x_m<below->aft_x_m, fore = x_m> below->fore_x_m;
	if (!aft && !fore)
		return NAN;
	double end_x = aft ? below->aft_x_m : below->fore_x_m;
	double end_y = aft ? below->aft_y_m : below->fore_y_m;
	double here_x = aft ? here->aft_x_m : here->fore_x_m;
	double here_y = aft ? here->aft_y_m : here->fore_y_m;
	if (end_y > 0)
		return NAN;
	if (here_y <= 0 && here_x != end_x)
		return low + (high - low) * ((x_m - end_x) / (here_x - end_x));
	/* the waterline here ends in a full section: the section itself goes on to the centreplane */
	if (count < 2 || !(y[1] > y[0]))
		return low;
	return fmax(low, z[0] - y[0] * (z[1] - z[0]) / (y[1] - y[0]));
}

static void copy_points(const section_source *source, size_t station, const hull_line *line,
                        section_points *out)
{
	size_t first = 0, count = 0;
	trim_zeros(line, &first, &count);
	/* entry 0 is kept free for the edge of the hull */
	for (size_t i = 0; i < count; i++) {
		size_t place = line->place[first + i];
		out->z[i + 1] = line->along_m[first + i];
		out->y[i + 1] = line->value_m[first + i];
		out->y_x[i + 1] = place == SIZE_MAX
		                      ? NAN
		                      : source->slopes[place * source->hull->station_count + station];
	}
	mark_breaks(source->hull, false, station, line, first, count, out->breaks + 1);
	out->first = 1;
	out->count = count;
	size_t lowest = line->place[first];
	if (out->y[1] > 0) {
		double edge = edge_height(source, source->hull->x_m[station], lowest, count, out->z + 1,
		                          out->y + 1);
		if (edge < out->z[1]) {
			out->z[0] = edge;
			out->y[0] = 0;
			out->y_x[0] = NAN;
			/* straight to the first node, which may be near and far out: no spline bends so */
			out->breaks[0] = CURVE_BREAK_AFTER;
			out->first = 0;
			out->count = count + 1;
		}
	}
}

/* A point off the grid takes the slope along x of the nearest point of the section that has one. */
static void fill_slopes(section_points *points)
{
	size_t first = points->first, end = first + points->count;
	for (size_t i = end; i-- > first;)
		if (isnan(points->y_x[i]) && i + 1 < end)
			points->y_x[i] = points->y_x[i + 1];
	for (size_t i = first; i < end; i++)
		if (isnan(points->y_x[i]))
			points->y_x[i] = i > first ? points->y_x[i - 1] : 0;
}

static batten_status make_curves(batten_context *context, section_points *points,
                                 struct section *out)
{
	size_t first = points->first;
	fill_slopes(points);
	const double *z = points->z + first, *y = points->y + first;
	struct section made = { .point_count = points->count,
		                    .x_m = out->x_m,
		                    .lowest_m = z[0],
		                    .highest_m = z[points->count - 1],
		                    .flat_m = y[0] > 0 ? y[0] : 0 };
	batten_status status = curve_create(context, points->count, z, y, points->breaks + first,
	                                    SPLINE_NOT_A_KNOT, &made.shape);
	if (status == BATTEN_OK)
		status = curve_create(context, points->count, z, points->y_x + first,
		                      points->breaks + first, SPLINE_NOT_A_KNOT, &made.slopes);
	if (status != BATTEN_OK) {
		section_destroy(&made);
		return status;
	}
	*out = made;
	return BATTEN_OK;
}

batten_status section_create(const section_source *source, size_t station, struct section *out)
{
	const batten_hull *hull = source->hull;
	batten_context *context = hull->context;
	hull_line line;
	batten_status status = hull_line_collect(hull, false, station, true, &line);
	if (status != BATTEN_OK)
		return status;
	struct section made = { .x_m = hull->x_m[station] };
	section_points points = { 0 };
	double *memory = batten_allocate(context, line.count + 1, 3 * sizeof *memory);
	points.breaks = batten_allocate(context, line.count + 1, 1);
	if (!memory || !points.breaks) {
		status = BATTEN_MEMORY;
	} else if (line.count > 0) {
		points.z = memory;
		points.y = points.z + line.count + 1;
		points.y_x = points.y + line.count + 1;
		copy_points(source, station, &line, &points);
		status = make_curves(context, &points, &made);
	}
	batten_release(context, points.breaks);
	batten_release(context, memory);
	hull_line_release(hull, &line);
	if (status == BATTEN_OK)
		*out = made;
	return status;
}

void section_destroy(struct section *section)
{
	curve_destroy(&section->shape);
	curve_destroy(&section->slopes);
	section->point_count = 0;
}

/* Integral of sqrt(1 + y_x^2 + y_z^2) dz at the nodes of a rule. Trapezoids go with the polygon
 * through the nodes: at a flat keel y_z is as good as infinite, the length of a chord never is. */
static double half_girth(const struct section *section, batten_quadrature rule,
                         const curve_nodes *nodes)
{
	double sum = 0;
	if (rule != BATTEN_QUADRATURE_TRAPEZOID) {
		for (size_t i = 0; i < nodes->count; i++) {
			double y_z = curve_slope(&section->shape, nodes->at[i]);
			double y_x = curve_value(&section->slopes, nodes->at[i]);
			sum += nodes->weight[i] * sqrt(1 + y_x * y_x + y_z * y_z);
		}
		return sum;
	}
	for (size_t i = 0; i + 1 < nodes->count; i++) {
		double height = nodes->at[i + 1] - nodes->at[i];
		double breadth = nodes->value[i + 1] - nodes->value[i];
		double y_x = 0.5 * (curve_value_straight(&section->slopes, nodes->at[i]) +
		                    curve_value_straight(&section->slopes, nodes->at[i + 1]));
		sum += sqrt((1 + y_x * y_x) * height * height + breadth * breadth);
	}
	return sum;
}

batten_status section_immerse(const struct section *section, double draft_m, batten_quadrature rule,
                              section_immersed *out)
{
	section_immersed made = { 0 };
	double near = 1e-9 * (fabs(draft_m) + section->highest_m - section->lowest_m);
	made.wet = section->point_count > 0 && section->lowest_m <= draft_m + near;
	made.reaches = made.wet && section->highest_m >= draft_m - near;
	if (!made.wet) {
		*out = made;
		return BATTEN_OK;
	}
	double top = fmin(draft_m, section->highest_m);
	curve_nodes nodes;
	batten_status status = curve_quadrature(&section->shape, rule, section->lowest_m, top,
	                                        "section at x =", section->x_m, &nodes);
	if (status != BATTEN_OK)
		return status;
	made.area_m2 = 2 * curve_nodes_moment(&nodes, 0);
	made.moment_m3 = 2 * curve_nodes_moment(&nodes, 1);
	made.girth_m = 2 * (section->flat_m + half_girth(section, rule, &nodes));
	if (made.reaches) {
		bool straight = rule == BATTEN_QUADRATURE_TRAPEZOID;
		double y = straight ? curve_value_straight(&section->shape, top)
		                    : curve_value(&section->shape, top);
		made.half_breadth_m = fmax(y, 0);
	}
	curve_nodes_release(section->shape.context, &nodes);
	*out = made;
	return BATTEN_OK;
}
