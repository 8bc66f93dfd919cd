/* Knuckle lines (Letcher 3.10, 4.4): knuckles of the sections join to lines along the hull, those of
 * the waterlines to lines up the girth. The parameters of the points are bent so that each such line
 * keeps one of them, where the knots are repeated order - 1 times: there the surface may have a
 * crease. */
#include "geometry/fit.h"

#include <math.h>
#include <string.h>

/* Parameters closer than this are one; a knuckle as close to an edge of the surface is on it. */
static const double same = 1e-6;

/* The knuckle lines across one direction: parameter of line k at the place of group g is
 * value[k * groups + g]. */
struct lines {
	size_t count, groups;
	double *at, *value;
};

static double parameter_of(const struct fit_point *point, bool along_v)
{
	return along_v ? point->v : point->u;
}

/* First mark after those of the same station (waterline) as mark i. */
static size_t group_end(const batten_hull *hull, bool on_waterline, size_t i)
{
	const hull_knuckle *first = &hull->knuckles[i];
	size_t end = i;
	while (end < hull->knuckle_count && hull->knuckles[end].on_waterline == on_waterline &&
	       (on_waterline ? hull->knuckles[end].z_m == first->z_m
	                     : hull->knuckles[end].x_m == first->x_m))
		end++;
	return end;
}

static batten_status fail_counts(const batten_hull *hull, bool on_waterline, double at,
                                 size_t found, double first_at, size_t expected)
{
	const char *line = on_waterline ? "waterline at z" : "station at x";
	return batten_fail(hull->context, BATTEN_INPUT,
	                   "%s: found %zu knuckles on the %s = %g m, expected %zu as on the %s = %g m: "
	                   "each belongs to one knuckle line",
	                   hull->name, found, line, at, expected, line, first_at);
}

/* The marks inside the surface, group by group, from the lowest (aftmost) on. */
static batten_status collect(const batten_hull *hull, const struct fit_points *points,
                             bool on_waterline, struct lines *out)
{
	size_t i = 0;
	while (i < hull->knuckle_count && hull->knuckles[i].on_waterline != on_waterline)
		i++;
	while (i < hull->knuckle_count && hull->knuckles[i].on_waterline == on_waterline) {
		const size_t end = group_end(hull, on_waterline, i);
		const double at = on_waterline ? hull->knuckles[i].z_m : hull->knuckles[i].x_m;
		size_t found = 0;
		double before = 0.0;
		for (; i < end; i++) {
			const double value = parameter_of(&points->mark[i], !on_waterline);
			if (value < same || value > 1.0 - same)
				continue; /* on an edge, where the surface ends anyway */
			if (value - before < same)
				return batten_fail(hull->context, BATTEN_INPUT,
				                   "%s: found two knuckles in one place at x = %g m, z = %g m",
				                   hull->name, hull->knuckles[i].x_m, hull->knuckles[i].z_m);
			before = value;
			/* Group after group for now. */
			out->value[out->groups * out->count + found++] = value;
			if (out->groups > 0 && found > out->count)
				return fail_counts(hull, on_waterline, at, found, out->at[0], out->count);
		}
		if (found == 0)
			continue;
		if (out->groups > 0 && found != out->count)
			return fail_counts(hull, on_waterline, at, found, out->at[0], out->count);
		out->count = found;
		out->at[out->groups++] = at;
	}
	return BATTEN_OK;
}

/* Turns value from [group][line] to [line][group]; room has as many places. */
static void turn(struct lines *lines, double *room)
{
	memcpy(room, lines->value, lines->groups * lines->count * sizeof *room);
	for (size_t g = 0; g < lines->groups; g++)
		for (size_t k = 0; k < lines->count; k++)
			lines->value[k * lines->groups + g] = room[g * lines->count + k];
}

static double line_at(const struct lines *lines, size_t k, double at)
{
	const struct fit_line line = { lines->groups, lines->at, lines->value + k * lines->groups };
	return fit_line_value(&line, at);
}

/* The point's parameter with every knuckle line brought to where it is to be; between the lines in
 * proportion. */
static void bend(const struct lines *lines, const double *crease, bool along_v,
                 struct fit_point *point)
{
	double *parameter = along_v ? &point->v : &point->u;
	const double place = point->place[along_v ? 0 : 2];
	if (*parameter <= 0.0 || *parameter >= 1.0)
		return;
	double low = 0.0, low_to = 0.0;
	for (size_t k = 0; k <= lines->count; k++) {
		const double high = k < lines->count ? line_at(lines, k, place) : 1.0;
		const double high_to = k < lines->count ? crease[k] : 1.0;
		if (k < lines->count && fabs(*parameter - high) <= 1e-3 * same) {
			*parameter = high_to;
			*(along_v ? &point->on_v : &point->on_u) = true;
			return;
		}
		if (*parameter < high) {
			*parameter = low_to + (high_to - low_to) * (*parameter - low) / (high - low);
			return;
		}
		low = high;
		low_to = high_to;
	}
}

static batten_status straighten(const batten_hull *hull, bool on_waterline, double *room,
                                struct fit_points *points)
{
	const size_t most = hull->knuckle_count;
	const bool along_v = !on_waterline;
	double *crease = points->crease[along_v];
	struct lines lines = { .at = room, .value = room + most };
	const batten_status status = collect(hull, points, on_waterline, &lines);
	if (status != BATTEN_OK || lines.count == 0)
		return status;
	turn(&lines, room + 2 * most);
	for (size_t k = 0; k < lines.count; k++) {
		double sum = 0.0;
		for (size_t g = 0; g < lines.groups; g++)
			sum += lines.value[k * lines.groups + g];
		crease[k] = sum / (double)lines.groups;
	}
	points->crease_count[along_v] = lines.count;
	for (size_t p = 0; p < points->count; p++)
		bend(&lines, crease, along_v, &points->point[p]);
	return BATTEN_OK;
}

batten_status fit_knuckles_straighten(const batten_hull *hull, struct fit_points *points)
{
	if (hull->knuckle_count == 0)
		return BATTEN_OK;
	double *room = batten_allocate(hull->context, 3 * hull->knuckle_count, sizeof *room);
	if (!room)
		return BATTEN_MEMORY;
	batten_status status = straighten(hull, false, room, points);
	if (status == BATTEN_OK)
		status = straighten(hull, true, room, points);
	batten_release(hull->context, room);
	return status;
}

bool fit_knuckles_crossed(const struct fit_points *points, bool along_v, double from, double to)
{
	for (size_t k = 0; k < points->crease_count[along_v]; k++) {
		const double crease = points->crease[along_v][k];
		if ((from < crease && to > crease) || (from > crease && to < crease))
			return true;
	}
	return false;
}

/* ------------------------------------------------------------------------------------------------
 * Knots
 * --------------------------------------------------------------------------------------------- */

/* One piece between two creases: its parameters, both ends among them, and its poles. */
struct piece {
	size_t count, poles;
	const double *parameter;
};

/* The parameters piece after piece into room. */
static void cut(size_t count, const double *parameters, size_t pieces, const double *crease,
                double *room, struct piece *piece)
{
	size_t used = 0, next = 0;
	for (size_t s = 0; s < pieces; s++) {
		const double first = s > 0 ? crease[s - 1] : parameters[0];
		const double last = s + 1 < pieces ? crease[s] : parameters[count - 1];
		piece[s].parameter = room + used;
		piece[s].count = 0;
		room[used + piece[s].count++] = first;
		for (; next < count && parameters[next] < last + same; next++)
			if (parameters[next] > first + same && parameters[next] < last - same)
				room[used + piece[s].count++] = parameters[next];
		room[used + piece[s].count++] = last;
		used += piece[s].count;
	}
}

/* Every piece takes the order; those left over go, one by one, where most points are without one. */
static batten_status share(batten_context *context, const char *line, size_t order, size_t poles,
                           size_t pieces, struct piece *piece)
{
	const size_t least = order + (pieces - 1) * (order - 1);
	if (poles < least)
		return batten_fail(context, BATTEN_INPUT,
		                   "found %zu poles along the %ss, expected at least %zu: %zu knuckle "
		                   "lines of %zu knots each cross them",
		                   poles, line, least, pieces - 1, order - 1);
	for (size_t s = 0; s < pieces; s++) {
		piece[s].poles = order;
		if (piece[s].count < order)
			return batten_fail(context, BATTEN_INPUT,
			                   "found %zu points of the longest %s beside a knuckle, expected at "
			                   "least %zu: the order",
			                   piece[s].count, line, order);
	}
	for (size_t left = poles - least; left > 0; left--) {
		size_t best = 0;
		for (size_t s = 1; s < pieces; s++)
			if (piece[s].count - piece[s].poles > piece[best].count - piece[best].poles)
				best = s;
		if (piece[best].count == piece[best].poles)
			return batten_fail(context, BATTEN_INPUT,
			                   "found no points for %zu of %zu poles along the %ss between the "
			                   "knuckles",
			                   left, poles, line);
		piece[best].poles++;
	}
	return BATTEN_OK;
}

static batten_status join(batten_context *context, size_t order, size_t pieces,
                          const struct piece *piece, double *room, double *knots)
{
	size_t used = 0;
	for (size_t s = 0; s < pieces; s++) {
		const size_t poles = piece[s].poles;
		const batten_status status = bspline_knots_spread(context, order, poles, piece[s].count,
		                                                  piece[s].parameter, room);
		if (status != BATTEN_OK)
			return status;
		/* The first knot of a piece after the first is there already, order - 1 times. */
		const size_t from = s > 0 ? order : 0;
		const size_t to = s + 1 < pieces ? poles + order - 1 : poles + order;
		memcpy(knots + used, room + from, (to - from) * sizeof *knots);
		used += to - from;
	}
	return BATTEN_OK;
}

batten_status fit_knuckles_knots(batten_context *context, const char *line,
                                 const struct fit_points *points, bool along_v, size_t order,
                                 size_t poles, size_t count, const double *parameters,
                                 double *knots)
{
	const size_t pieces = points->crease_count[along_v] + 1;
	struct piece *piece = batten_allocate(context, pieces, sizeof *piece);
	double *cut_room = batten_allocate(context, count + 2 * pieces, sizeof *cut_room);
	double *room = batten_allocate(context, poles + order, sizeof *room);
	batten_status status = piece && cut_room && room ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		cut(count, parameters, pieces, points->crease[along_v], cut_room, piece);
		status = share(context, line, order, poles, pieces, piece);
	}
	if (status == BATTEN_OK)
		status = join(context, order, pieces, piece, room, knots);
	batten_release(context, piece);
	batten_release(context, cut_room);
	batten_release(context, room);
	return status;
}
