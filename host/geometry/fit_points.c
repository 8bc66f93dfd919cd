/* The points a surface is fitted to, with their parameters: u runs from the stern line to the stem
 * line at the height of the point, v from the foot of its section to its top. */
#include "geometry/fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Lines with fewer points than this part of the longest do not say where the knots go. */
static const double least_part = 0.5;

void fit_points_destroy(struct fit_points *points)
{
	batten_release(points->context, points->point);
	batten_release(points->context, points->mark);
	batten_release(points->context, points->crease[0]);
	batten_release(points->context, points->crease[1]);
	memset(points, 0, sizeof *points);
}

/* Part of the way from first to last, in 0..1; ends that are not apart are met at 0. */
static double part_of(double value, double first, double last)
{
	const double range = last - first;
	if (!(range > 0.0))
		return 0.0;
	const double part = (value - first) / range;
	return part < 0.0 ? 0.0 : part > 1.0 ? 1.0 : part;
}

static struct fit_point point_at(const struct fit_outline *outline, const double place[3])
{
	struct fit_point point = { .station = SIZE_MAX, .waterline = SIZE_MAX };
	const double x = place[0];
	const double aft = fit_line_value(&outline->stern, place[2]);
	const double forward = fit_line_value(&outline->stem, place[2]);
	const double low = fit_line_value(&outline->low, x);
	const double high = fit_line_value(&outline->high, x);
	memcpy(point.place, place, sizeof point.place);
	point.u = part_of(x, aft, forward);
	point.v = part_of(place[2], low, high);
	point.on_u = point.u == 0.0 || point.u == 1.0;
	point.on_v = point.v == 0.0 || point.v == 1.0;
	return point;
}

static void add_point(struct fit_points *points, const struct fit_outline *outline,
                      const double place[3], size_t station, size_t waterline, bool given)
{
	struct fit_point *point = &points->point[points->count++];
	*point = point_at(outline, place);
	point->station = station;
	point->waterline = waterline;
	point->given = given;
	points->given_count += given;
}

static void add_all(const batten_hull *hull, const struct fit_outline *outline,
                    struct fit_points *points)
{
	for (size_t w = 0; w < hull->waterline_count; w++)
		for (size_t s = 0; s < hull->station_count; s++) {
			const size_t node = w * hull->station_count + s;
			if (hull->nodes[node] == BATTEN_NODE_GIVEN)
				add_point(points, outline,
				          (const double[]){ hull->x_m[s], hull->y_m[node], hull->z_m[w] }, s, w,
				          true);
		}
	for (size_t i = 0; i < hull->end_count; i++) {
		const hull_line_end *end = &hull->ends[i];
		const double x = end->on_waterline ? end->along_m : hull->x_m[end->line];
		const double z = end->on_waterline ? hull->z_m[end->line] : end->along_m;
		add_point(points, outline, (const double[]){ x, end->y_m, z },
		          end->on_waterline ? SIZE_MAX : end->line,
		          end->on_waterline ? end->line : SIZE_MAX, true);
	}
	for (size_t i = 0; i < hull->profile_count; i++) {
		const hull_profile_point *at = &hull->profile[i];
		add_point(points, outline, (const double[]){ at->x_m, at->y_m, at->z_m }, SIZE_MAX,
		          SIZE_MAX, true);
	}
	for (size_t i = 0; i < outline->closed_count; i++)
		add_point(points, outline,
		          (const double[]){ outline->closed_x[i], 0.0, outline->closed_z[i] },
		          hull_station_at(hull, outline->closed_x[i]), SIZE_MAX, false);
	for (size_t i = 0; i < hull->knuckle_count; i++)
		points->mark[i] = point_at(
			outline, (const double[]){ hull->knuckles[i].x_m, 0.0, hull->knuckles[i].z_m });
}

batten_status fit_points_create(const batten_hull *hull, const struct fit_outline *outline,
                                enum fit_girth girth, struct fit_points *out)
{
	memset(out, 0, sizeof *out);
	out->context = hull->context;
	const size_t most = hull->station_count * hull->waterline_count + hull->end_count +
	                    hull->profile_count + outline->closed_count;
	out->point = batten_allocate(hull->context, most, sizeof *out->point);
	out->mark = batten_allocate(hull->context, hull->knuckle_count, sizeof *out->mark);
	for (size_t d = 0; d < 2; d++)
		out->crease[d] = batten_allocate(hull->context, hull->knuckle_count, sizeof(double));
	if (!out->point || !out->mark || !out->crease[0] || !out->crease[1]) {
		fit_points_destroy(out);
		return BATTEN_MEMORY;
	}
	add_all(hull, outline, out);
	batten_status status = BATTEN_OK;
	if (girth == FIT_GIRTH_CHORD)
		status = fit_girth_by_chords(hull, out, outline);
	if (status == BATTEN_OK)
		status = fit_knuckles_straighten(hull, out);
	if (status != BATTEN_OK)
		fit_points_destroy(out);
	return status;
}

static int compare(const void *a, const void *b)
{
	const double x = *(const double *)a;
	const double y = *(const double *)b;
	return (x > y) - (x < y);
}

/* Numbers of the points by station (by waterline): those of line i are order[start[i]] up to
 * order[start[i + 1]]. */
batten_status fit_points_by_line(const struct fit_points *points, bool waterline, size_t lines,
                                 size_t **start, size_t **order)
{
	size_t *first = batten_allocate(points->context, lines + 2, sizeof *first);
	size_t *sorted = batten_allocate(points->context, points->count, sizeof *sorted);
	*start = first;
	*order = sorted;
	if (!first || !sorted)
		return BATTEN_MEMORY;
	for (int pass = 0; pass < 2; pass++) {
		for (size_t p = 0; p < points->count; p++) {
			const struct fit_point *point = &points->point[p];
			const size_t line = waterline ? point->waterline : point->station;
			if (line == SIZE_MAX)
				continue;
			if (pass == 0)
				first[line + 2]++;
			else
				sorted[first[line + 1]++] = p;
		}
		for (size_t i = 2; pass == 0 && i < lines + 2; i++)
			first[i] += first[i - 1];
	}
	return BATTEN_OK;
}

/* Where the points of a section lie along v (of a waterline along u), as the mean over the lines
 * with the more points: each line's parameters read at equal parts of its number of points. Returns
 * the number of points of the longest line, 0 without one of two points. out and line have room for
 * it. */
static size_t spread(const struct fit_points *points, bool waterline, size_t lines,
                     const size_t *start, const size_t *order, double *out, double *line)
{
	size_t longest = 0;
	for (size_t i = 0; i < lines; i++)
		if (start[i + 1] - start[i] > longest)
			longest = start[i + 1] - start[i];
	if (longest < 2)
		return 0;
	size_t used = 0;
	for (size_t i = 0; i < lines; i++) {
		const size_t count = start[i + 1] - start[i];
		if (count < 2 || (double)count < least_part * (double)longest)
			continue;
		used++;
		for (size_t k = 0; k < count; k++) {
			const struct fit_point *point = &points->point[order[start[i] + k]];
			line[k] = waterline ? point->u : point->v;
		}
		qsort(line, count, sizeof *line, compare);
		for (size_t k = 0; k < longest; k++) {
			const double at = (double)(k * (count - 1)) / (double)(longest - 1);
			const size_t before = at < (double)(count - 1) ? (size_t)at : count - 2;
			out[k] += line[before] + (at - (double)before) * (line[before + 1] - line[before]);
		}
	}
	for (size_t k = 0; k < longest; k++)
		out[k] /= (double)used;
	out[0] = 0.0;
	out[longest - 1] = 1.0;
	return longest;
}

static batten_status choose_knots(const struct fit_points *points, bool waterline, size_t lines,
                                  size_t poles, size_t order, double *knots)
{
	batten_context *context = points->context;
	size_t *start = NULL;
	size_t *sorted = NULL;
	double *parameter = NULL;
	batten_status status = fit_points_by_line(points, waterline, lines, &start, &sorted);
	if (status == BATTEN_OK) {
		parameter = batten_allocate(context, 2 * points->count, sizeof *parameter);
		status = parameter ? BATTEN_OK : BATTEN_MEMORY;
	}
	if (status == BATTEN_OK) {
		const size_t count = spread(points, waterline, lines, start, sorted, parameter,
		                            parameter + points->count);
		status = count < poles
		             ? batten_fail(context, BATTEN_INPUT,
		                           "found %zu points on the longest %s, expected at least %zu: one "
		                           "for each pole",
		                           count, waterline ? "waterline" : "section", poles)
		         : points->crease_count[!waterline] > 0
		             ? fit_knuckles_knots(context, waterline ? "waterline" : "section", points,
		                                  !waterline, order, poles, count, parameter, knots)
		             : bspline_knots_spread(context, order, poles, count, parameter, knots);
	}
	batten_release(context, start);
	batten_release(context, sorted);
	batten_release(context, parameter);
	return status;
}

batten_status fit_points_knots(const batten_hull *hull, const struct fit_points *points,
                               struct batten_surface *surface)
{
	const size_t poles = surface->count_u * surface->count_v;
	if (points->given_count < poles)
		return batten_fail(hull->context, BATTEN_INPUT,
		                   "%s: found %zu points, expected at least %zu: one for each pole",
		                   hull->name, points->given_count, poles);
	const batten_status status = choose_knots(points, true, hull->waterline_count, surface->count_u,
	                                          surface->order_u, surface->knots_u);
	return status != BATTEN_OK ? status
	                           : choose_knots(points, false, hull->station_count, surface->count_v,
	                                          surface->order_v, surface->knots_v);
}
