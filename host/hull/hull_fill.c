/* Half-breadths for the '?' nodes of a hull, from the given points of their lines. */
#include "core/spline.h"
#include "hull/hull.h"

#include <math.h>

static size_t node_of(const batten_hull *hull, bool waterline, size_t line, size_t place)
{
	return waterline ? line * hull->station_count + place : place * hull->station_count + line;
}

static bool has_unknown(const batten_hull *hull, bool waterline, size_t line)
{
	size_t count = waterline ? hull->station_count : hull->waterline_count;
	for (size_t i = 0; i < count; i++)
		if (hull->nodes[node_of(hull, waterline, line, i)] == BATTEN_NODE_UNKNOWN)
			return true;
	return false;
}

/* Whether a line has two given points, enough for a spline. *enough is set for lines with '?'. */
static batten_status check_line(const batten_hull *hull, bool waterline, size_t line, bool *enough)
{
	*enough = false;
	if (!has_unknown(hull, waterline, line))
		return BATTEN_OK;
	hull_line points;
	batten_status status = hull_line_collect(hull, waterline, line, false, &points);
	if (status == BATTEN_OK) {
		*enough = points.count >= 2;
		hull_line_release(hull, &points);
	}
	return status;
}

/* Flags of the lines that can fill: waterlines first, then stations. NULL when memory is out. */
static batten_status check_lines(const batten_hull *hull, bool **out)
{
	size_t waterlines = hull->waterline_count;
	bool *enough = batten_allocate(hull->context, waterlines + hull->station_count, sizeof *enough);
	if (!enough)
		return BATTEN_MEMORY;
	batten_status status = BATTEN_OK;
	for (size_t i = 0; status == BATTEN_OK && i < waterlines; i++)
		status = check_line(hull, true, i, &enough[i]);
	for (size_t i = 0; status == BATTEN_OK && i < hull->station_count; i++)
		status = check_line(hull, false, i, &enough[waterlines + i]);
	if (status != BATTEN_OK) {
		batten_release(hull->context, enough);
		return status;
	}
	*out = enough;
	return BATTEN_OK;
}

static size_t first_unfillable(const batten_hull *hull, const bool *enough)
{
	for (size_t w = 0; w < hull->waterline_count; w++)
		for (size_t s = 0; s < hull->station_count; s++)
			if (hull->nodes[w * hull->station_count + s] == BATTEN_NODE_UNKNOWN && !enough[w] &&
			    !enough[hull->waterline_count + s])
				return w * hull->station_count + s;
	return SIZE_MAX;
}

batten_status hull_find_unfillable(const batten_hull *hull, size_t *node)
{
	bool *enough = NULL;
	batten_status status = check_lines(hull, &enough);
	if (status != BATTEN_OK)
		return status;
	*node = first_unfillable(hull, enough);
	batten_release(hull->context, enough);
	return BATTEN_OK;
}

/* Fills the '?' nodes of one line; those of a section only where the waterline could not. */
static batten_status fill_line(batten_hull *hull, bool waterline, size_t line, const bool *enough,
                               size_t *filled)
{
	hull_line points;
	batten_status status = hull_line_collect(hull, waterline, line, false, &points);
	if (status != BATTEN_OK)
		return status;
	struct spline spline;
	status = spline_create(hull->context, points.count, points.along_m, points.value_m,
	                       SPLINE_NATURAL, &spline);
	hull_line_release(hull, &points);
	if (status != BATTEN_OK)
		return status;
	const double *along = waterline ? hull->x_m : hull->z_m;
	size_t count = waterline ? hull->station_count : hull->waterline_count;
	for (size_t i = 0; i < count; i++) {
		size_t node = node_of(hull, waterline, line, i);
		if (hull->nodes[node] != BATTEN_NODE_UNKNOWN || (!waterline && enough[i]))
			continue;
		double value = spline_value(&spline, along[i]);
		hull->y_m[node] = value > 0 ? fmin(value, HULL_LARGEST_M) : 0;
		++*filled;
	}
	spline_destroy(&spline);
	return BATTEN_OK;
}

static batten_status fill_lines(batten_hull *hull, const bool *enough, size_t *filled)
{
	for (size_t w = 0; w < hull->waterline_count; w++) {
		if (!enough[w])
			continue;
		batten_status status = fill_line(hull, true, w, enough, filled);
		if (status != BATTEN_OK)
			return status;
	}
	for (size_t s = 0; s < hull->station_count; s++) {
		if (!enough[hull->waterline_count + s])
			continue;
		batten_status status = fill_line(hull, false, s, enough, filled);
		if (status != BATTEN_OK)
			return status;
	}
	return BATTEN_OK;
}

batten_status hull_fill_unknown(batten_hull *hull, size_t *filled)
{
	*filled = 0;
	bool *enough = NULL;
	batten_status status = check_lines(hull, &enough);
	if (status != BATTEN_OK)
		return status;
	size_t node = first_unfillable(hull, enough);
	if (node != SIZE_MAX)
		status = batten_fail(hull->context, BATTEN_INPUT,
		                     "found '?' at x %g m, z %g m, expected two given half-breadths on its "
		                     "waterline or section",
		                     hull->x_m[node % hull->station_count],
		                     hull->z_m[node / hull->station_count]);
	else
		status = fill_lines(hull, enough, filled);
	batten_release(hull->context, enough);
	return status;
}
