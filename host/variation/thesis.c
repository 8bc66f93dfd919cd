/* The thesis's own table of a parent (2.3): 21 sections half a station apart by natural splines along
 * the waterlines, and section areas from six waterlines. */
#include "variation/variation.h"

#include <math.h>

enum { SECTIONS = 21, AREA_LINES = 6 };

/* A waterline stands for a height when it is this near, in parts of the draft. */
#define NEAR_PART 1e-3

/* Stations whose section has a '?' are none of the table; what is given there counts as it is. */
static bool is_whole(const batten_hull *hull, size_t station)
{
	for (size_t w = 0; w < hull->waterline_count; w++)
		if (hull->nodes[w * hull->station_count + station] == BATTEN_NODE_UNKNOWN)
			return false;
	return true;
}

static batten_status spline_of(const variation_parent *parent, size_t waterline, struct spline *out)
{
	const batten_hull *hull = parent->hull;
	variation_line line;
	batten_status status = variation_line_create(parent->context, hull->station_count, &line);
	if (status != BATTEN_OK)
		return status;
	for (size_t s = 0; s < hull->station_count; s++)
		if (is_whole(hull, s)) {
			line.x_m[line.count] = hull->x_m[s];
			line.y_m[line.count] = hull->y_m[waterline * hull->station_count + s];
			line.count++;
		}
	status = spline_create(parent->context, line.count, line.x_m, line.y_m, SPLINE_NATURAL, out);
	variation_line_destroy(parent->context, &line);
	return status == BATTEN_USAGE ? BATTEN_INPUT : status;
}

static batten_status resample(const variation_parent *parent, size_t waterline, variation_line *out)
{
	const batten_hull *hull = parent->hull;
	struct spline spline;
	batten_status status = spline_of(parent, waterline, &spline);
	if (status != BATTEN_OK)
		return status;
	status = variation_line_create(parent->context, SECTIONS, out);
	for (size_t i = 0; status == BATTEN_OK && i < SECTIONS; i++) {
		out->x_m[i] = hull->lbp_m * (double)i / (SECTIONS - 1);
		const size_t station = hull_station_at(hull, out->x_m[i]);
		const size_t node = waterline * hull->station_count + station;
		const bool given = station != SIZE_MAX && hull->nodes[node] == BATTEN_NODE_GIVEN;
		out->y_m[i] = given ? hull->y_m[node] : fmax(spline_value(&spline, out->x_m[i]), 0);
		out->count = i + 1;
	}
	if (status == BATTEN_OK)
		out->middle_m = out->y_m[SECTIONS / 2];
	spline_destroy(&spline);
	return status;
}

/* The waterline at a part of the draft, or SIZE_MAX. */
static size_t line_at(const batten_hull *hull, double part)
{
	for (size_t w = 0; w < hull->waterline_count; w++)
		if (fabs(hull->z_m[w] - part * hull->draft_m) <= NEAR_PART * hull->draft_m)
			return w;
	return SIZE_MAX;
}

static batten_status check(const variation_parent *parent, size_t lines[AREA_LINES])
{
	const batten_hull *hull = parent->hull;
	if (hull->end_count > 0 || hull_station_at(hull, 0) != 0 ||
	    hull_station_at(hull, hull->lbp_m) != hull->station_count - 1)
		return batten_fail(parent->context, BATTEN_INPUT,
		                   "%s: the thesis's procedure expects a table without line ends whose "
		                   "stations go from x = 0 to the length of %g m",
		                   hull->name, hull->lbp_m);
	for (size_t k = 0; k < AREA_LINES; k++) {
		lines[k] = line_at(hull, 0.2 * (double)k);
		if (lines[k] == SIZE_MAX)
			return batten_fail(parent->context, BATTEN_INPUT,
			                   "%s: the thesis's procedure expects a waterline at %g of the draft",
			                   hull->name, 0.2 * (double)k);
	}
	return BATTEN_OK;
}

/* Twice the integral of the not-a-knot spline over the six waterlines. */
static batten_status area_of(const variation_parent *parent, const size_t lines[AREA_LINES],
                             size_t section, double *area_m2)
{
	double z[AREA_LINES], y[AREA_LINES];
	for (size_t k = 0; k < AREA_LINES; k++) {
		z[k] = parent->hull->z_m[lines[k]];
		y[k] = parent->lines[lines[k]].y_m[section];
	}
	struct spline spline;
	const batten_status status = spline_create(parent->context, AREA_LINES, z, y, SPLINE_NOT_A_KNOT,
	                                           &spline);
	if (status != BATTEN_OK)
		return status;
	*area_m2 = 2 * spline_integral(&spline, z[0], z[AREA_LINES - 1], 0, 1);
	spline_destroy(&spline);
	return BATTEN_OK;
}

batten_status variation_thesis_sections(variation_parent *parent)
{
	size_t lines[AREA_LINES] = { 0 };
	batten_status status = check(parent, lines);
	for (size_t w = 0; w < parent->hull->waterline_count && status == BATTEN_OK; w++)
		status = resample(parent, w, &parent->lines[w]);
	double areas[SECTIONS] = { 0 };
	for (size_t i = 0; i < SECTIONS && status == BATTEN_OK; i++)
		status = area_of(parent, lines, i, &areas[i]);
	if (status != BATTEN_OK)
		return status;
	const variation_line *load = &parent->lines[lines[AREA_LINES - 1]];
	status = spline_create(parent->context, SECTIONS, load->x_m, areas, SPLINE_NATURAL,
	                       &parent->areas);
	if (status == BATTEN_OK)
		status = spline_create(parent->context, SECTIONS, load->x_m, load->y_m, SPLINE_NATURAL,
		                       &parent->waterline);
	return status;
}
