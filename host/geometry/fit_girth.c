/* v by the girth of the sections: bottoms that are nearly flat get their share of the parameter. */
#include "geometry/fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The points of one section from its foot up: part of its height, part of its girth. */
struct section {
	size_t count;
	double *height, *girth;
};

static int by_height(const void *a, const void *b)
{
	const struct fit_point *const *p = a;
	const struct fit_point *const *q = b;
	const double z[2] = { (*p)->place[2], (*q)->place[2] };
	return (z[0] > z[1]) - (z[0] < z[1]);
}

/* Girth at a part of the height; a section of one point or none has no say: the height itself. */
static double girth_at(const struct section *section, double height)
{
	const struct fit_line line = { section->count, section->height, section->girth };
	return section->count < 2 ? height : fit_line_value(&line, height);
}

static void measure_section(size_t count, const struct fit_point **sorted, struct section *out)
{
	qsort(sorted, count, sizeof *sorted, by_height);
	out->count = count;
	double girth = 0.0;
	for (size_t i = 0; i < count; i++) {
		const double *place = sorted[i]->place;
		if (i > 0)
			girth += hypot(place[1] - sorted[i - 1]->place[1], place[2] - sorted[i - 1]->place[2]);
		out->height[i] = sorted[i]->v;
		out->girth[i] = girth;
	}
	/* A section whose foot or top has no point keeps its parts of the height there. */
	const double first = count > 0 ? out->height[0] : 0.0;
	const double last = count > 0 ? out->height[count - 1] : 1.0;
	for (size_t i = 0; i < count; i++)
		out->girth[i] = girth > 0.0 ? first + (last - first) * out->girth[i] / girth
		                            : out->height[i];
}

/* The two stations beside x, and how far it is from the first to the second. */
static double beside(size_t count, const double *station_x, double x, size_t *before, size_t *after)
{
	size_t i = 0;
	while (i + 1 < count && station_x[i + 1] <= x)
		i++;
	*before = i;
	*after = i + 1 < count && x > station_x[i] ? i + 1 : i;
	return *after == *before ? 0.0 : (x - station_x[i]) / (station_x[i + 1] - station_x[i]);
}

static void move_points(const batten_hull *hull, const struct section *section, size_t count,
                        struct fit_point *points)
{
	for (size_t p = 0; p < count; p++) {
		struct fit_point *point = &points[p];
		if (point->on_v)
			continue;
		size_t before, after;
		const double part = beside(hull->station_count, hull->x_m, point->place[0], &before,
		                           &after);
		const double girth = girth_at(&section[before], point->v);
		point->v = girth + part * (girth_at(&section[after], point->v) - girth);
	}
}

batten_status fit_girth_by_chords(const batten_hull *hull, struct fit_points *points,
                                  const struct fit_outline *outline)
{
	const size_t station_count = hull->station_count;
	batten_context *context = outline->context;
	struct section *section = batten_allocate(context, station_count, sizeof *section);
	double *room = batten_allocate(context, 2 * points->count, sizeof *room);
	const struct fit_point **sorted = batten_allocate(context, points->count, sizeof *sorted);
	size_t *start = NULL;
	size_t *order = NULL;
	const bool all = section && room && sorted &&
	                 fit_points_by_line(points, false, station_count, &start, &order) == BATTEN_OK;
	if (all) {
		size_t used = 0;
		for (size_t s = 0; s < station_count; s++) {
			size_t count = 0;
			for (size_t p = start[s]; p < start[s + 1]; p++)
				sorted[count++] = &points->point[order[p]];
			section[s].height = room + used;
			section[s].girth = room + points->count + used;
			used += count;
			measure_section(count, sorted, &section[s]);
		}
		move_points(hull, section, points->count, points->point);
		move_points(hull, section, hull->knuckle_count, points->mark);
	}
	batten_release(context, section);
	batten_release(context, room);
	batten_release(context, (void *)sorted);
	batten_release(context, start);
	batten_release(context, order);
	return all ? BATTEN_OK : BATTEN_MEMORY;
}
