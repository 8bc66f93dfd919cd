/* A parent made ready: its waterlines as points, section areas, load waterline, hydrostatics. */
#include "hydrostatics/hydrostatics.h"
#include "hydrostatics/section.h"
#include "variation/variation.h"

#include <math.h>
#include <stdio.h>

/* Two sections are one parallel body when their half-breadths agree within this part of h. */
#define PARALLEL_PART 1e-9

batten_status variation_measure(batten_context *context, const batten_hull *hull,
                                batten_measures *out)
{
	batten_hydrostatics body;
	const batten_status status = batten_hull_hydrostatics(context, hull, NULL, 1, &hull->draft_m,
	                                                      &body);
	if (status != BATTEN_OK)
		return status == BATTEN_USAGE ? BATTEN_INPUT : status;
#define NONE(name, text) .name = NAN,
	*out = (batten_measures){ BATTEN_MEASURE_LIST(NONE) };
#undef NONE
#define TAKE(name, text) out->name = body.name;
	BATTEN_FORM_LIST(TAKE)
#undef TAKE
	return BATTEN_OK;
}

batten_status variation_mark_source(batten_hull *variant)
{
	char source[HULL_TEXT_MOST + 1];
	const int length = snprintf(source, sizeof source, "%s%svaried by batten %s", variant->source,
	                            variant->source[0] ? "; " : "", batten_version());
	if (length < 0 || (size_t)length >= sizeof source)
		return BATTEN_OK; /* no room left for it */
	char *copy = batten_copy_text(variant->context, source);
	if (!copy)
		return BATTEN_MEMORY;
	batten_release(variant->context, variant->source);
	variant->source = copy;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Areas and the load waterline
 * --------------------------------------------------------------------------------------------- */

static batten_status immerse(const section_source *source, size_t station, double draft_m,
                             section_immersed *out)
{
	struct section section;
	batten_status status = section_create(source, station, &section);
	if (status != BATTEN_OK)
		return status;
	status = section_immerse(&section, draft_m, BATTEN_QUADRATURE_SPLINE, out);
	section_destroy(&section);
	return status;
}

static batten_status take_curves(variation_parent *parent)
{
	const batten_hull *hull = parent->hull;
	const size_t count = hull->station_count;
	section_source source = { 0 };
	double *areas = batten_allocate(parent->context, count, 2 * sizeof *areas);
	if (!areas)
		return BATTEN_MEMORY;
	double *breadths = areas + count;
	batten_status status = section_source_create(parent->context, hull, &source);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		section_immersed immersed = { 0 };
		status = immerse(&source, i, hull->draft_m, &immersed);
		areas[i] = immersed.area_m2;
		breadths[i] = immersed.half_breadth_m;
	}
	section_source_destroy(&source);
	if (status == BATTEN_OK)
		status = spline_create(parent->context, count, hull->x_m, areas, SPLINE_NATURAL,
		                       &parent->areas);
	if (status == BATTEN_OK)
		status = spline_create(parent->context, count, hull->x_m, breadths, SPLINE_NATURAL,
		                       &parent->waterline);
	batten_release(parent->context, areas);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * Amidships
 * --------------------------------------------------------------------------------------------- */

static batten_status take_middle(const variation_parent *parent)
{
	for (size_t w = 0; w < parent->hull->waterline_count; w++) {
		variation_line *line = &parent->lines[w];
		const double x = parent->span.middle_m;
		if (line->count < 2 || (line->ends_aft && x < line->x_m[0]) ||
		    (line->ends_fore && x > line->x_m[line->count - 1]))
			continue;
		curve shape;
		const batten_status status = variation_line_curve(parent->context, line, &shape);
		if (status != BATTEN_OK)
			return status;
		line->middle_m = fmax(curve_value(&shape, x), 0);
		curve_destroy(&shape);
	}
	return BATTEN_OK;
}

static bool is_parallel(const batten_hull *hull, size_t a, size_t b)
{
	const double near = PARALLEL_PART * batten_hull_half_beam_m(hull);
	for (size_t w = 0; w < hull->waterline_count; w++) {
		const size_t row = w * hull->station_count;
		if ((hull->nodes[row + a] == BATTEN_NODE_OUTSIDE) !=
		        (hull->nodes[row + b] == BATTEN_NODE_OUTSIDE) ||
		    !(fabs(hull->y_m[row + a] - hull->y_m[row + b]) <= near))
			return false;
	}
	return true;
}

/* The parallel body: the sections about amidships that are all alike. */
static void find_parallel(const batten_hull *hull, variation_span *span)
{
	size_t nearest = 0;
	for (size_t s = 1; s < hull->station_count; s++)
		if (fabs(hull->x_m[s] - span->middle_m) < fabs(hull->x_m[nearest] - span->middle_m))
			nearest = s;
	size_t first = nearest, last = nearest;
	while (first > 0 && is_parallel(hull, first - 1, nearest))
		first--;
	while (last + 1 < hull->station_count && is_parallel(hull, last + 1, nearest))
		last++;
	if (first == last || hull->x_m[first] > span->middle_m || hull->x_m[last] < span->middle_m)
		return;
	span->parallel_aft = (span->middle_m - hull->x_m[first]) / (span->middle_m - span->aft_m);
	span->parallel_fore = (hull->x_m[last] - span->middle_m) / (span->fore_m - span->middle_m);
}

/* A section with an empty cell between two points is open there: nobody knows what would be moved. Lists
 * of points have no empty cells. */
static batten_status check_closed(const variation_parent *parent, size_t station)
{
	const batten_hull *hull = parent->hull;
	size_t open = SIZE_MAX;
	bool begun = false;
	for (size_t w = 0; w < hull->waterline_count && hull->layout == HULL_LAYOUT_GRID; w++) {
		const bool outside = hull->nodes[w * hull->station_count + station] == BATTEN_NODE_OUTSIDE;
		if (outside && begun && open == SIZE_MAX)
			open = w;
		if (!outside && open != SIZE_MAX)
			return batten_fail(parent->context, BATTEN_INPUT,
			                   "%s: its section at x = %g m is open, without a half-breadth at "
			                   "z = %g m; a closed one is expected",
			                   hull->name, hull->x_m[station], hull->z_m[open]);
		begun = begun || !outside;
	}
	return BATTEN_OK;
}

static batten_status check_sections(const variation_parent *parent)
{
	const batten_hull *hull = parent->hull;
	for (size_t i = 0; i < hull->end_count; i++)
		if (!hull->ends[i].on_waterline)
			return batten_fail(parent->context, BATTEN_INPUT,
			                   "%s: its sections have points off the grid, which cannot be moved "
			                   "along the ship; a table of waterlines is expected",
			                   hull->name);
	for (size_t i = 0; i < hull->station_count; i++) {
		const batten_status status = check_closed(parent, i);
		if (status != BATTEN_OK)
			return status;
	}
	const double middle = 0.5 * hull->lbp_m;
	if (!(hull->x_m[0] < middle && hull->x_m[hull->station_count - 1] > middle))
		return batten_fail(parent->context, BATTEN_INPUT,
		                   "%s: its stations go from x = %g to %g m and amidships is at %g m; "
		                   "stations on both sides of it are expected",
		                   hull->name, hull->x_m[0], hull->x_m[hull->station_count - 1], middle);
	return BATTEN_OK;
}

static batten_status check_fullness(const variation_parent *parent)
{
	const char *name = parent->hull->name;
	const double area = spline_value(&parent->areas, parent->span.middle_m);
	double most = 0;
	for (size_t i = 0; i < parent->areas.count; i++)
		most = fmax(most, parent->areas.y[i]);
	if (!(area > 0.5 * most))
		return batten_fail(parent->context, BATTEN_INPUT,
		                   "%s: its section amidships has an area of %g m2, the largest %g m2; a "
		                   "full section amidships is expected",
		                   name, area, most);
	if (!(spline_value(&parent->waterline, parent->span.middle_m) > 0))
		return batten_fail(parent->context, BATTEN_INPUT,
		                   "%s: no waterline amidships at the draft of %g m", name,
		                   parent->hull->draft_m);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

batten_status variation_parent_create(batten_context *context, const batten_hull *hull,
                                      variation_parent *out)
{
	*out = (variation_parent){ .context = context, .hull = hull };
	batten_status status = variation_measure(context, hull, &out->measures);
	if (status == BATTEN_OK && !(out->measures.volume_m3 > 0))
		status = batten_fail(context, BATTEN_INPUT, "%s: no volume below its draft of %g m",
		                     hull->name, hull->draft_m);
	return status;
}

void variation_parent_destroy(variation_parent *parent)
{
	for (size_t w = 0; parent->lines && w < parent->hull->waterline_count; w++)
		variation_line_destroy(parent->context, &parent->lines[w]);
	batten_release(parent->context, parent->lines);
	spline_destroy(&parent->areas);
	spline_destroy(&parent->waterline);
	*parent = (variation_parent){ 0 };
}

batten_status variation_parent_sections(variation_parent *parent, bool thesis)
{
	const batten_hull *hull = parent->hull;
	batten_status status = check_sections(parent);
	if (status != BATTEN_OK)
		return status;
	parent->span = (variation_span){ .aft_m = hull->x_m[0],
		                             .middle_m = 0.5 * hull->lbp_m,
		                             .fore_m = hull->x_m[hull->station_count - 1] };
	parent->lines = batten_allocate(parent->context, hull->waterline_count, sizeof *parent->lines);
	if (!parent->lines)
		return BATTEN_MEMORY;
	if (thesis) {
		status = variation_thesis_sections(parent);
	} else {
		find_parallel(hull, &parent->span);
		for (size_t w = 0; w < hull->waterline_count && status == BATTEN_OK; w++)
			status = variation_line_take(parent->context, hull, w, &parent->lines[w]);
		if (status == BATTEN_OK)
			status = take_middle(parent);
		if (status == BATTEN_OK)
			status = take_curves(parent);
	}
	return status == BATTEN_OK ? check_fullness(parent) : status;
}
