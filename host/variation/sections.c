/* Sections moved along the ship, and the waterlines taken at the stations again. */
#include "variation/variation.h"

#include <math.h>

/* ------------------------------------------------------------------------------------------------
 * What the nodes of a variant are
 * --------------------------------------------------------------------------------------------- */

/* Whether a neighbour along the waterline, or the one above, has a positive half-breadth. */
static bool beside_positive(const batten_hull *hull, const double *y, size_t station,
                            size_t waterline)
{
	const size_t node = waterline * hull->station_count + station;
	return (station > 0 && y[node - 1] > 0) ||
	       (station + 1 < hull->station_count && y[node + 1] > 0) ||
	       (waterline + 1 < hull->waterline_count && y[node + hull->station_count] > 0);
}

static void take_offset(batten_hull *variant, const double *before, size_t node, double y)
{
	const size_t station = node % variant->station_count;
	const size_t waterline = node / variant->station_count;
	if (isnan(y)) {
		variant->nodes[node] = BATTEN_NODE_OUTSIDE;
		return;
	}
	if (variant->nodes[node] == BATTEN_NODE_UNKNOWN)
		return;
	if (y > 0) {
		variant->nodes[node] = BATTEN_NODE_GIVEN;
		return;
	}
	const bool was = beside_positive(variant, before, station, waterline);
	const bool is = beside_positive(variant, variant->y_m, station, waterline);
	if (is != was || before[node] > 0)
		variant->nodes[node] = is ? BATTEN_NODE_GIVEN : BATTEN_NODE_OUTSIDE;
}

batten_status variation_set_offsets(batten_hull *variant, const double *y_m)
{
	const double least = VARIATION_ZERO_PART * batten_hull_half_beam_m(variant);
	const size_t count = hull_node_count(variant);
	double *before = batten_allocate(variant->context, count, sizeof *before);
	if (!before)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < count; i++) {
		before[i] = variant->y_m[i];
		variant->y_m[i] = y_m[i] > least ? y_m[i] : 0;
	}
	for (size_t i = 0; i < count; i++)
		take_offset(variant, before, i, isnan(y_m[i]) ? NAN : variant->y_m[i]);
	batten_release(variant->context, before);
	size_t filled = 0;
	return hull_fill_unknown(variant, &filled);
}

/* ------------------------------------------------------------------------------------------------
 * The move
 * --------------------------------------------------------------------------------------------- */

/* The parallel body after the move takes the place of what stood within the one before. */
static bool within_body(const variation_shift *shift, double x_m)
{
	const variation_span *span = &shift->span;
	return shift->body &&
	       x_m >= span->middle_m - span->parallel_aft * (span->middle_m - span->aft_m) &&
	       x_m <= span->middle_m + span->parallel_fore * (span->fore_m - span->middle_m);
}

static void put_point(variation_line *moved, double x_m, double y_m, unsigned char breaks)
{
	moved->x_m[moved->count] = x_m;
	moved->y_m[moved->count] = y_m;
	moved->breaks[moved->count] = breaks;
	moved->count++;
}

static void put_body(const variation_shift *shift, const variation_line *line,
                     variation_line *moved)
{
	if (line->middle_m <= 0 && (line->ends_aft || line->ends_fore))
		return;
	const double least = 1e-9 * (shift->span.fore_m - shift->span.aft_m);
	if (!shift->body_open && shift->body_to_m > shift->body_from_m + least)
		put_point(moved, shift->body_from_m, line->middle_m, CURVE_SMOOTH);
	put_point(moved, shift->body_to_m, line->middle_m, CURVE_SMOOTH);
}

static void move_points(const variation_shift *shift, const variation_line *line,
                        variation_line *moved)
{
	bool body = shift->body;
	for (size_t i = 0; i < line->count; i++) {
		const double x = line->x_m[i];
		if (body && x >= shift->span.middle_m) {
			put_body(shift, line, moved);
			body = false;
		}
		if (!within_body(shift, x))
			put_point(moved, x + variation_shift_at(shift, x), line->y_m[i], line->breaks[i]);
	}
	moved->ends_aft = line->ends_aft;
	moved->ends_fore = line->ends_fore;
	moved->middle_m = line->middle_m;
}

/* Half-breadth of a moved waterline at a station; NaN where its ends leave nothing. */
static double value_at(const variation_shift *shift, const variation_line *moved,
                       const curve *shape, double x_m)
{
	if ((moved->ends_aft && x_m < moved->x_m[0]) ||
	    (moved->ends_fore && x_m > moved->x_m[moved->count - 1]))
		return NAN;
	if (shift->body && !shift->body_open && x_m >= shift->body_from_m && x_m <= shift->body_to_m)
		return moved->middle_m;
	return fmax(curve_value(shape, x_m), 0);
}

/* A station between the ends of a line of a long layout that has no point there. */
static bool is_unlisted(const batten_hull *hull, const variation_line *line, uint8_t node,
                        double x_m)
{
	return hull->layout != HULL_LAYOUT_GRID && node == BATTEN_NODE_OUTSIDE && line->count > 0 &&
	       x_m > line->x_m[0] && x_m < line->x_m[line->count - 1];
}

static batten_status move_line(const variation_parent *parent, const variation_shift *shift,
                               const variation_line *line, double *y_m)
{
	const batten_hull *hull = parent->hull;
	variation_line moved;
	batten_status status = variation_line_create(parent->context, line->count + 2, &moved);
	if (status != BATTEN_OK)
		return status;
	move_points(shift, line, &moved);
	curve shape = { 0 };
	if (moved.count >= 2)
		status = variation_line_curve(parent->context, &moved, &shape);
	const uint8_t *nodes = hull->nodes + (size_t)(line - parent->lines) * hull->station_count;
	for (size_t s = 0; s < hull->station_count && status == BATTEN_OK; s++)
		y_m[s] = moved.count >= 2 && !is_unlisted(hull, line, nodes[s], hull->x_m[s])
		             ? value_at(shift, &moved, &shape, hull->x_m[s])
		             : NAN;
	curve_destroy(&shape);
	variation_line_destroy(parent->context, &moved);
	return status;
}

/* Points off the grid go along, each on its own line. */
static void move_extras(const variation_shift *shift, batten_hull *variant)
{
	for (size_t i = 0; i < variant->end_count; i++)
		variant->ends[i].along_m += variation_shift_at(shift, variant->ends[i].along_m);
	for (size_t i = 0; i < variant->profile_count; i++)
		variant->profile[i].x_m += variation_shift_at(shift, variant->profile[i].x_m);
	for (size_t i = 0; i < variant->knuckle_count; i++)
		if (variant->knuckles[i].on_waterline)
			variant->knuckles[i].x_m += variation_shift_at(shift, variant->knuckles[i].x_m);
}

static batten_status move_chines(const batten_hull *parent, const variation_shift *shift,
                                 batten_hull *variant)
{
	double *moved = batten_allocate(parent->context, parent->station_count, sizeof *moved);
	if (!moved)
		return BATTEN_MEMORY;
	for (size_t s = 0; s < parent->station_count; s++)
		moved[s] = parent->x_m[s] + variation_shift_at(shift, parent->x_m[s]);
	const batten_status status = variation_carry_chines(parent, moved, parent->x_m, variant);
	batten_release(parent->context, moved);
	return status;
}

batten_status variation_move_sections(const variation_parent *parent, const variation_shift *shift,
                                      batten_hull *variant)
{
	const size_t stations = variant->station_count;
	double folds_m = 0;
	if (variation_shift_folds(shift, &folds_m))
		return batten_fail(parent->context, BATTEN_INPUT,
		                   "sections about x = %.4g m would run into each other", folds_m);
	double *y = batten_allocate(parent->context, hull_node_count(variant), sizeof *y);
	if (!y)
		return BATTEN_MEMORY;
	batten_status status = BATTEN_OK;
	for (size_t w = 0; w < variant->waterline_count && status == BATTEN_OK; w++)
		status = move_line(parent, shift, &parent->lines[w], y + w * stations);
	move_extras(shift, variant);
	if (status == BATTEN_OK)
		status = move_chines(parent->hull, shift, variant);
	if (status == BATTEN_OK)
		status = variation_set_offsets(variant, y);
	batten_release(parent->context, y);
	return status;
}
