#include "fairing/pass_lines.h"

#include "fairing/lines.h"

#include <string.h>

size_t pass_value_count(const batten_hull *hull)
{
	return hull_node_count(hull) + hull->end_count;
}

size_t pass_constant_count(const batten_hull *hull)
{
	/* A profile point may lie on a waterline and on a section. */
	return 2 * hull->profile_count;
}

static size_t line_count(const batten_hull *hull, bool waterlines)
{
	return waterlines ? hull->waterline_count : hull->station_count;
}

/* Number of the line end at a place of a line, or SIZE_MAX: then it is a profile point. */
static size_t find_end(const batten_hull *hull, bool waterline, size_t line, double along)
{
	for (size_t e = 0; e < hull->end_count; e++) {
		const hull_line_end *end = &hull->ends[e];
		if (end->on_waterline == waterline && end->line == line && end->along_m == along)
			return e;
	}
	return SIZE_MAX;
}

/* A stem or stern within its waterline, a keel or deck within its section, would bend the line back. */
static batten_status check_profile(const batten_hull *hull, bool waterline, size_t line,
                                   const hull_line *points, size_t p)
{
	static const char *const names[] = { "stem", "stern", "keel", "deck" };
	const double at = waterline ? hull->z_m[line] : hull->x_m[line];
	for (size_t i = 0; i < hull->profile_count; i++) {
		const hull_profile_point *point = &hull->profile[i];
		const bool first = point->kind == HULL_PROFILE_STERN || point->kind == HULL_PROFILE_KEEL;
		const bool of_waterline = point->kind == HULL_PROFILE_STEM ||
		                          point->kind == HULL_PROFILE_STERN;
		const double along = waterline ? point->x_m : point->z_m;
		const size_t on = waterline ? hull_waterline_at(hull, point->z_m)
		                            : hull_station_at(hull, point->x_m);
		if (of_waterline != waterline || on != line || along != points->along_m[p] ||
		    p == (first ? 0 : points->count - 1))
			continue;
		return batten_fail(hull->context, BATTEN_INPUT,
		                   "%s: the %s point at x = %g m, z = %g m lies behind the end of the %s "
		                   "at %g m, which goes on to %g m: expected beyond it",
		                   hull->name, names[point->kind], point->x_m, point->z_m,
		                   waterline ? "waterline" : "section", at,
		                   points->along_m[first ? 0 : points->count - 1]);
	}
	return BATTEN_OK;
}

/* Place of point p of a line in the state. */
static batten_status place_point(const batten_hull *hull, bool waterline, size_t line,
                                 const hull_line *points, size_t p, double *constants,
                                 size_t *constant_count, size_t *place)
{
	const size_t on_grid = points->place[p];
	if (on_grid != SIZE_MAX) {
		*place = waterline ? line * hull->station_count + on_grid
		                   : on_grid * hull->station_count + line;
		return BATTEN_OK;
	}
	const size_t end = find_end(hull, waterline, line, points->along_m[p]);
	if (end != SIZE_MAX) {
		*place = hull_node_count(hull) + end;
		return BATTEN_OK;
	}
	*place = pass_value_count(hull) + *constant_count;
	constants[(*constant_count)++] = points->value_m[p];
	return check_profile(hull, waterline, line, points, p);
}

static batten_status add_line(const batten_hull *hull, bool waterline, size_t line,
                              const hull_line *points, double *constants, size_t *constant_count,
                              pass_lines *out)
{
	const size_t base = out->point_count;
	for (size_t p = 0; p < points->count; p++) {
		out->along_m[base + p] = points->along_m[p];
		const batten_status status = place_point(hull, waterline, line, points, p, constants,
		                                         constant_count, &out->place[base + p]);
		if (status != BATTEN_OK)
			return status;
	}
	out->point_count += points->count;
	for (size_t first = 0, next = 0; first < points->count; first = next) {
		const size_t last = lines_piece_end(hull, waterline, line, points, first, &next);
		if (last > first)
			out->pieces[out->piece_count++] = (pass_piece){ line, base + first, last - first + 1 };
	}
	return BATTEN_OK;
}

static batten_status allocate(batten_context *context, size_t points, pass_lines *out)
{
	*out = (pass_lines){ .context = context };
	out->pieces = batten_allocate(context, points, sizeof *out->pieces);
	out->along_m = batten_allocate(context, points, sizeof *out->along_m);
	out->place = batten_allocate(context, points, sizeof *out->place);
	if (out->pieces && out->along_m && out->place)
		return BATTEN_OK;
	pass_lines_release(out);
	return BATTEN_MEMORY;
}

batten_status pass_lines_collect(const batten_hull *hull, bool waterlines, double *constants,
                                 size_t *constant_count, pass_lines *out)
{
	/* Nodes, ends and profile points lie on one line of a direction each. */
	batten_status status = allocate(hull->context, pass_value_count(hull) + hull->profile_count,
	                                out);
	for (size_t l = 0; l < line_count(hull, waterlines) && status == BATTEN_OK; l++) {
		hull_line points;
		status = hull_line_collect(hull, waterlines, l, false, &points);
		if (status != BATTEN_OK)
			break;
		status = add_line(hull, waterlines, l, &points, constants, constant_count, out);
		hull_line_release(hull, &points);
	}
	if (status != BATTEN_OK)
		pass_lines_release(out);
	return status;
}

batten_status pass_lines_single(batten_context *context, size_t count, const double *along,
                                pass_lines *out)
{
	const batten_status status = allocate(context, count, out);
	if (status != BATTEN_OK)
		return status;
	memcpy(out->along_m, along, count * sizeof *along);
	for (size_t p = 0; p < count; p++)
		out->place[p] = p;
	out->point_count = count;
	out->pieces[0] = (pass_piece){ 0, 0, count };
	out->piece_count = 1;
	return BATTEN_OK;
}

void pass_lines_release(pass_lines *lines)
{
	if (lines->context) {
		batten_release(lines->context, lines->pieces);
		batten_release(lines->context, lines->along_m);
		batten_release(lines->context, lines->place);
	}
	*lines = (pass_lines){ 0 };
}
