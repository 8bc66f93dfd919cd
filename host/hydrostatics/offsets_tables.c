#include "hydrostatics/offsets_tables.h"

#include "core/gauss.h"

#include <math.h>

enum { POINTS = 5 };

/* ------------------------------------------------------------------------------------------------
 * What fits
 * --------------------------------------------------------------------------------------------- */

/* The first or last station of a waterline that is on the hull; SIZE_MAX without one. */
static size_t outermost(const batten_hull *hull, size_t waterline, bool aft)
{
	const uint8_t *nodes = hull->nodes + waterline * hull->station_count;
	for (size_t i = 0; i < hull->station_count; i++) {
		const size_t station = aft ? i : hull->station_count - 1 - i;
		if (nodes[station] != BATTEN_NODE_OUTSIDE)
			return station;
	}
	return SIZE_MAX;
}

/* Which end of its waterline a point off the grid is: 0 aft, 1 fore, 2 none. */
static int side_of(const batten_hull *hull, const hull_line_end *end)
{
	const size_t first = outermost(hull, end->line, true);
	const size_t last = outermost(hull, end->line, false);
	if (!end->on_waterline || first == SIZE_MAX)
		return 2;
	if (end->along_m < hull->x_m[first])
		return 0;
	return end->along_m > hull->x_m[last] ? 1 : 2;
}

bool offsets_tables_fit(const batten_hull *hull, batten_quadrature rule, size_t draft_count)
{
	if (rule != BATTEN_QUADRATURE_SPLINE || hull->knuckle_count > 0 ||
	    hull->waterline_count > VARIANTS_LINES_MOST || hull->station_count > VARIANTS_LINES_MOST ||
	    draft_count > VARIANTS_DRAFTS_MOST)
		return false;
	for (size_t i = 0; i < hull->profile_count; i++)
		if (hull_waterline_at(hull, hull->profile[i].z_m) != SIZE_MAX ||
		    hull_station_at(hull, hull->profile[i].x_m) != SIZE_MAX)
			return false;
	for (size_t i = 0; i < hull->end_count; i++) {
		const int side = side_of(hull, &hull->ends[i]);
		/* sorted: two at one end follow each other */
		if (side == 2 || (i > 0 && hull->ends[i - 1].line == hull->ends[i].line &&
		                  side_of(hull, &hull->ends[i - 1]) == side))
			return false;
	}
	return true;
}

/* ------------------------------------------------------------------------------------------------
 * Tables
 * --------------------------------------------------------------------------------------------- */

static void fill_places(const batten_hull *hull, variants_plan *plan)
{
	double *x = variants_plan_table(plan, VARIANTS_AT_X);
	double *z = variants_plan_table(plan, VARIANTS_AT_Z);
	double *ends = variants_plan_table(plan, VARIANTS_AT_ENDS);
	double *formula = variants_plan_table(plan, VARIANTS_AT_FORMULA);
	for (size_t i = 0; i < hull->station_count; i++)
		x[i] = hull->x_m[i];
	for (size_t k = 0; k < hull->waterline_count; k++) {
		z[k] = hull->z_m[k];
		if (k + 1 < hull->waterline_count)
			z[hull->waterline_count + k] = 1 / (hull->z_m[k + 1] - hull->z_m[k]);
	}
	for (size_t i = 0; i < hull->end_count; i++) {
		double *end = ends + 4 * hull->ends[i].line + 2 * side_of(hull, &hull->ends[i]);
		end[0] = hull->ends[i].along_m;
		end[1] = hull->ends[i].y_m;
	}
	plan->shape[VARIANTS_LISTED] = hull->layout == HULL_LAYOUT_LONG_WATERLINES;
	formula[VARIANTS_FORMULA_LENGTH] = hull->lbp_m;
	formula[VARIANTS_FORMULA_AMIDSHIPS] = 0.5 * hull->lbp_m;
	formula[VARIANTS_FORMULA_NEAR] = 1e-9 * (x[hull->station_count - 1] - x[0]);
}

/* Where a draft lies among the waterlines. */
static void fill_draft(const batten_hull *hull, double draft_m, double *row)
{
	const double top = hull->z_m[hull->waterline_count - 1];
	const double draft = fmin(draft_m, top);
	size_t line = hull_waterline_at(hull, draft);
	double part = 0;
	if (line == SIZE_MAX) {
		line = 0;
		while (line + 2 < hull->waterline_count && hull->z_m[line + 1] <= draft)
			line++;
		part = (draft - hull->z_m[line]) / (hull->z_m[line + 1] - hull->z_m[line]);
	}
	row[0] = draft;
	row[1] = (double)line;
	row[2] = part;
	row[3] = 1e-9 * (fabs(draft) + top);
}

/* The Gauss points of part of an interval: weights of values and second derivatives at its ends, for
 * value and slope, and of the sum. */
static void fill_rule(double part, double *rule)
{
	double nodes[POINTS], weights[POINTS];
	gauss_points(POINTS, nodes, weights);
	for (size_t g = 0; g < POINTS; g++, rule += 7) {
		const double u = part * (0.5 + 0.5 * nodes[g]);
		rule[0] = 1 - u;
		rule[1] = u;
		rule[2] = u * (1 - u) * (2 - u) / 6;
		rule[3] = u * (1 - u) * (1 + u) / 6;
		rule[4] = -(2 - 6 * u + 3 * u * u) / 6;
		rule[5] = -(1 - 3 * u * u) / 6;
		rule[6] = 0.5 * part * weights[g];
	}
}

/* What one half-breadth adds to area, moment (both sides) and half-breadth of a section below each
 * draft: those of the spline that is 1 there and 0 at the other points from waterline `first` on. */
static batten_status fill_cardinal(const batten_hull *hull, const struct spline_rule *rule,
                                   size_t first, size_t point, size_t draft_count,
                                   const double *drafts, double *unit, double *sections)
{
	const size_t lines = hull->waterline_count, count = lines - first;
	struct spline spline = { 0 };
	for (size_t k = 0; k < count; k++)
		unit[k] = first + k == point ? 1 : 0;
	if (count >= 2) {
		const batten_status status = spline_create(hull->context, count, hull->z_m + first, unit,
		                                           SPLINE_NOT_A_KNOT, &spline);
		if (status != BATTEN_OK)
			return status;
	}
	for (size_t d = 0; d < draft_count; d++) {
		const double low = hull->z_m[first], top = fmax(drafts[4 * d], low);
		double *weights = sections + (d * lines + first) * 3 * lines + point;
		weights[2 * lines] = count >= 2 ? spline_value(&spline, top) : 1;
		if (count < 2 || !(top > low))
			continue;
		weights[0] = 2 * spline_integral_by(rule, &spline, low, top, 0, 1);
		weights[lines] = 2 * spline_integral_by(rule, &spline, low, top, 1, 1);
	}
	spline_destroy(&spline);
	return BATTEN_OK;
}

/* The rows of a section's not-a-knot spline eliminated: scale of the right side, factor, the entry
 * above the diagonal, its inverse (core/spline.c; three points: the parabola). */
static void fill_bends(const batten_hull *hull, size_t first, double *rows)
{
	const size_t lines = hull->waterline_count;
	const double *z = hull->z_m;
	double before_above = 0, before_inverse = 0;
	for (size_t k = first + 1; k + 1 < lines; k++) {
		const bool begins = k == first + 1, ends = k + 2 == lines;
		const double below = z[k] - z[k - 1], above = z[k + 1] - z[k], both = below + above;
		const double inside = begins ? above : below;
		const bool one = begins != ends;
		const double diagonal = begins && ends ? 3 * both : one ? both + inside : 2 * both;
		const double factor = begins ? 0 : (ends ? below - above : below) * before_inverse;
		rows[k] = 6 * (one ? inside / both : 1);
		rows[lines + k] = factor;
		rows[2 * lines + k] = ends ? 0 : begins ? above - below : above;
		rows[3 * lines + k] = 1 / (diagonal - factor * before_above);
		before_above = rows[2 * lines + k];
		before_inverse = rows[3 * lines + k];
	}
}

batten_status offsets_tables_fill(const batten_hull *hull, const double *drafts_m, double target_m,
                                  variants_plan *plan)
{
	const size_t lines = hull->waterline_count;
	const size_t asked = (size_t)plan->shape[VARIANTS_DRAFTS];
	const size_t count = asked + (isnan(target_m) ? 0 : 1);
	double *drafts = variants_plan_table(plan, VARIANTS_AT_DRAFTS);
	double *rules = variants_plan_table(plan, VARIANTS_AT_RULES);
	double *unit = batten_allocate(hull->context, lines, sizeof *unit);
	if (!unit)
		return BATTEN_MEMORY;
	fill_places(hull, plan);
	fill_rule(1, rules);
	for (size_t d = 0; d < count; d++) {
		fill_draft(hull, d < asked ? drafts_m[d] : target_m, drafts + 4 * d);
		if (d < asked)
			fill_rule(drafts[4 * d + 2], rules + 35 * (d + 1));
	}
	batten_status status = BATTEN_OK;
	struct spline_rule rule;
	spline_rule_of(&rule);
	for (size_t first = 0; first < lines && status == BATTEN_OK; first++) {
		fill_bends(hull, first, variants_plan_table(plan, VARIANTS_AT_BENDS) + 4 * first * lines);
		for (size_t point = first; point < lines && status == BATTEN_OK; point++)
			status = fill_cardinal(hull, &rule, first, point, count, drafts, unit,
			                       variants_plan_table(plan, VARIANTS_AT_SECTIONS));
	}
	batten_release(hull->context, unit);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * Quantities
 * --------------------------------------------------------------------------------------------- */

void offsets_tables_take(const batten_hull *hull, const batten_hydrostatics_options *options,
                         size_t draft_count, const double *drafts_m, const double *outcome,
                         batten_hydrostatics *out)
{
	const floating_body body = { .context = hull->context,
		                         .lbp_m = hull->lbp_m,
		                         .half_beam_m = outcome[VARIANTS_OUT_HALF_BEAM] };
	for (size_t d = 0; d < draft_count; d++) {
		const double *form = outcome + VARIANTS_OUT_COUNT + d * VARIANTS_FORM_COUNT;
		const double midship = form[VARIANTS_MIDSHIP];
		const hydrostatics made = {
			.volume_m3 = form[VARIANTS_VOLUME],
			.volume_moment_x_m4 = form[VARIANTS_MOMENT_X],
			.volume_moment_z_m4 = form[VARIANTS_MOMENT_Z],
			.wetted_surface_m2 = form[VARIANTS_WETTED],
			.transom_area_m2 = form[VARIANTS_TRANSOM],
			.midship_area_m2 = midship < VARIANTS_NONE ? midship : NAN,
			.max_section_area_m2 = form[VARIANTS_LARGEST],
			.waterline_length_m = form[VARIANTS_WATERLINE_LENGTH],
			.waterline_half_breadth_m = form[VARIANTS_WATERLINE_BREADTH],
			.waterplane_area_m2 = form[VARIANTS_PLANE_AREA],
			.waterplane_moment_x_m3 = form[VARIANTS_PLANE_MOMENT],
			.transverse_second_moment_m4 = form[VARIANTS_PLANE_TRANSVERSE],
			.longitudinal_second_moment_m4 = form[VARIANTS_PLANE_LONGITUDINAL],
			.volume_mismatch_pct = NAN,
		};
		quantities_take(&body, &made, drafts_m[d], options, &out[d]);
	}
}
