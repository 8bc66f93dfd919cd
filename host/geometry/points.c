#include "geometry/points.h"

#include <math.h>
#include <string.h>

size_t points_find_repeated(size_t dimension, size_t count, const double *points)
{
	for (size_t i = 1; i < count; i++) {
		double square = 0;
		for (size_t c = 0; c < dimension; c++) {
			double step = points[i * dimension + c] - points[(i - 1) * dimension + c];
			square += step * step;
		}
		if (!(sqrt(square) >= HULL_SMALLEST_STEP_M))
			return i;
	}
	return count;
}

static batten_status check_points(batten_context *context, size_t dimension, size_t count,
                                  const double *points_m)
{
	if (dimension < 2 || dimension > 3)
		return batten_fail(context, BATTEN_USAGE, "points of dimension %zu, expected 2 or 3",
		                   dimension);
	if (count < 2 || count > HULL_LINES_MOST)
		return batten_fail(context, BATTEN_USAGE, "%zu points, expected 2..%d", count,
		                   (int)HULL_LINES_MOST);
	for (size_t i = 0; i < count * dimension; i++)
		if (!(fabs(points_m[i]) <= HULL_LARGEST_M))
			return batten_fail(context, BATTEN_USAGE, "point %zu is not finite or beyond %g m",
			                   i / dimension + 1, HULL_LARGEST_M);
	size_t repeated = points_find_repeated(dimension, count, points_m);
	if (repeated < count)
		return batten_fail(context, BATTEN_USAGE, "point %zu repeats the one before it",
		                   repeated + 1);
	return BATTEN_OK;
}

batten_status batten_points_create(batten_context *context, const char *name, size_t dimension,
                                   size_t count, const double *points_m, batten_points **out)
{
	*out = NULL;
	batten_status status = check_points(context, dimension, count, points_m);
	if (status != BATTEN_OK)
		return status;
	batten_points *points = batten_allocate(context, 1, sizeof *points);
	if (!points)
		return BATTEN_MEMORY;
	*points = (batten_points){ .context = context, .dimension = dimension, .count = count };
	points->name = batten_copy_text(context, name ? name : "");
	points->source = batten_copy_text(context, "");
	points->m = batten_allocate(context, count * dimension, sizeof *points->m);
	if (!points->name || !points->source || !points->m) {
		batten_points_destroy(points);
		return BATTEN_MEMORY;
	}
	memcpy(points->m, points_m, count * dimension * sizeof *points_m);
	*out = points;
	return BATTEN_OK;
}

void batten_points_destroy(batten_points *points)
{
	if (!points)
		return;
	batten_release(points->context, points->name);
	batten_release(points->context, points->source);
	batten_release(points->context, points->m);
	batten_release(points->context, points);
}

const char *batten_points_name(const batten_points *points)
{
	return points->name;
}

const char *batten_points_source(const batten_points *points)
{
	return points->source;
}

const char *batten_points_unit(const batten_points *points)
{
	return hull_unit_text(points->unit);
}

size_t batten_points_dimension(const batten_points *points)
{
	return points->dimension;
}

size_t batten_points_count(const batten_points *points)
{
	return points->count;
}

const double *batten_points_m(const batten_points *points)
{
	return points->m;
}
