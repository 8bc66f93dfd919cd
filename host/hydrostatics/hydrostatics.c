#include "hydrostatics/quantities.h"

#include <math.h>
#include <string.h>

/* What runs along the ship at one draft. Every array has room for all stations and two ends. */
struct body {
	const hydrostatics_sections *sections;
	double draft_m;
	batten_quadrature rule;
	double near_m; /* two x are the same within this */
	/* curves of sections */
	size_t count;
	double *x, *area, *moment, *girth;
	/* the waterline */
	size_t waterline_count;
	double *waterline_x, *waterline_y;
};

batten_status hydrostatics_sections_create(batten_context *context, const batten_hull *hull,
                                           hydrostatics_sections *out)
{
	hydrostatics_sections made = { 0 };
	batten_status status = section_source_create(context, hull, &made.source);
	if (status != BATTEN_OK)
		return status;
	made.sections = batten_allocate(context, hull->station_count, sizeof *made.sections);
	if (!made.sections)
		status = BATTEN_MEMORY;
	for (size_t i = 0; i < hull->station_count && status == BATTEN_OK; i++)
		status = section_create(&made.source, i, &made.sections[i]);
	if (status == BATTEN_OK)
		*out = made;
	else
		hydrostatics_sections_destroy(context, &made);
	return status;
}

void hydrostatics_sections_destroy(batten_context *context, hydrostatics_sections *sections)
{
	const batten_hull *hull = sections->source.hull;
	for (size_t i = 0; sections->sections && i < hull->station_count; i++)
		section_destroy(&sections->sections[i]);
	batten_release(context, sections->sections);
	section_source_destroy(&sections->source);
	*sections = (hydrostatics_sections){ 0 };
}

static batten_status body_create(batten_context *context, const hydrostatics_sections *sections,
                                 double draft_m, batten_quadrature rule, struct body *out)
{
	const batten_hull *hull = sections->source.hull;
	size_t most = hull->station_count + 2;
	double length = hull->x_m[hull->station_count - 1] - hull->x_m[0];
	*out = (struct body){ .sections = sections,
		                  .draft_m = fmin(draft_m, hull->z_m[hull->waterline_count - 1]),
		                  .rule = rule,
		                  .near_m = 1e-9 * length };
	double *memory = batten_allocate(context, most, 6 * sizeof *memory);
	if (!memory)
		return BATTEN_MEMORY;
	out->x = memory;
	out->area = out->x + most;
	out->moment = out->area + most;
	out->girth = out->moment + most;
	out->waterline_x = out->girth + most;
	out->waterline_y = out->waterline_x + most;
	return BATTEN_OK;
}

static void add_section(struct body *body, double x_m, const section_immersed *immersed)
{
	body->x[body->count] = x_m;
	body->area[body->count] = immersed->area_m2;
	body->moment[body->count] = immersed->moment_m3;
	body->girth[body->count] = immersed->girth_m;
	body->count++;
}

static void add_waterline(struct body *body, double x_m, double y_m)
{
	body->waterline_x[body->waterline_count] = x_m;
	body->waterline_y[body->waterline_count] = y_m;
	body->waterline_count++;
}

/* The aftmost, or foremost, profile point of the hull below the draft; NaN without one. */
static double wetted_end(const struct body *body, bool aft)
{
	const batten_hull *hull = body->sections->source.hull;
	double end = NAN;
	for (size_t j = 0; j <= hull->waterline_count; j++) {
		bool at_draft = j == hull->waterline_count;
		if (!at_draft && hull->z_m[j] > body->draft_m)
			continue;
		section_ends ends = at_draft ? section_ends_at(&body->sections->source, body->draft_m)
		                             : body->sections->source.ends[j];
		double x = aft ? ends.aft_x_m : ends.fore_x_m, y = aft ? ends.aft_y_m : ends.fore_y_m;
		if (y <= 0)
			end = aft ? fmin(end, x) : fmax(end, x);
	}
	return end;
}

/* A dry section before the hull, or one more than the edge of the hull allows, adds nothing; one
 * between wet sections counts as zero. */
static batten_status take_section(struct body *body, size_t station, size_t *pending)
{
	section_immersed immersed;
	batten_status status = section_immerse(&body->sections->sections[station], body->draft_m,
	                                       body->rule, &immersed);
	if (status != BATTEN_OK)
		return status;
	const double *x = body->sections->source.hull->x_m;
	if (!immersed.wet) {
		*pending += body->count > 1; /* the first place is an end's */
		return BATTEN_OK;
	}
	for (; *pending > 0; (*pending)--)
		add_section(body, x[station - *pending], &(section_immersed){ 0 });
	add_section(body, x[station], &immersed);
	if (immersed.reaches)
		add_waterline(body, x[station], immersed.half_breadth_m);
	return BATTEN_OK;
}

/* Sections from aft to fore, and the ends of the hull beyond the last ones. */
static batten_status take_sections(struct body *body)
{
	const batten_hull *hull = body->sections->source.hull;
	double aft = wetted_end(body, true), fore = wetted_end(body, false);
	section_ends waterline = section_ends_at(&body->sections->source, body->draft_m);
	batten_status status = BATTEN_OK;
	size_t pending = 0;
	/* the aft ends take the first places; real_first() passes them over when a section stands there */
	add_section(body, aft, &(section_immersed){ 0 });
	add_waterline(body, waterline.aft_x_m, waterline.aft_y_m);
	for (size_t i = 0; i < hull->station_count && status == BATTEN_OK; i++)
		status = take_section(body, i, &pending);
	if (status != BATTEN_OK)
		return status;
	if (fore > body->x[body->count - 1] + body->near_m)
		add_section(body, fore, &(section_immersed){ 0 });
	if (waterline.fore_x_m > body->waterline_x[body->waterline_count - 1] + body->near_m)
		add_waterline(body, waterline.fore_x_m, waterline.fore_y_m);
	return BATTEN_OK;
}

/* Places past an aft end that is not one: NaN, or a section stands at it or before it. */
static size_t real_first(const double *x, size_t count, double near_m)
{
	return count > 1 && x[0] < x[1] - near_m ? 0 : 1;
}

static batten_status integrate(batten_context *context, const struct body *body, size_t first,
                               const double *value, curve *line, curve_nodes *nodes)
{
	size_t count = body->count - first;
	batten_status status = curve_create(context, count, body->x + first, value + first, NULL,
	                                    SPLINE_NATURAL, line);
	if (status != BATTEN_OK)
		return status;
	status = curve_quadrature(line, body->rule, body->x[first], body->x[body->count - 1],
	                          "sections up to z =", body->draft_m, nodes);
	if (status != BATTEN_OK)
		curve_destroy(line);
	return status;
}

static batten_status integrate_areas(batten_context *context, const struct body *body, size_t first,
                                     hydrostatics *out)
{
	curve line;
	curve_nodes nodes;
	batten_status status = integrate(context, body, first, body->area, &line, &nodes);
	if (status != BATTEN_OK)
		return status;
	out->volume_m3 = curve_nodes_moment(&nodes, 0);
	out->volume_moment_x_m4 = curve_nodes_moment(&nodes, 1);
	/* the hull ends in a full section at a transom, in none at a stem */
	out->transom_area_m2 = body->area[first];
	if (body->count - first > 1)
		out->transom_area_m2 += body->area[body->count - 1];
	for (size_t i = first; i < body->count; i++)
		out->max_section_area_m2 = fmax(out->max_section_area_m2, body->area[i]);
	double amidships = 0.5 * body->sections->source.hull->lbp_m;
	if (amidships >= body->x[first] && amidships <= body->x[body->count - 1])
		out->midship_area_m2 = body->rule == BATTEN_QUADRATURE_TRAPEZOID
		                           ? curve_value_straight(&line, amidships)
		                           : curve_value(&line, amidships);
	curve_nodes_release(context, &nodes);
	curve_destroy(&line);
	return BATTEN_OK;
}

static batten_status integrate_one(batten_context *context, const struct body *body, size_t first,
                                   const double *value, double *out)
{
	curve line;
	curve_nodes nodes;
	batten_status status = integrate(context, body, first, value, &line, &nodes);
	if (status != BATTEN_OK)
		return status;
	*out = curve_nodes_moment(&nodes, 0);
	curve_nodes_release(context, &nodes);
	curve_destroy(&line);
	return BATTEN_OK;
}

static batten_status integrate_waterplane(batten_context *context, const struct body *body,
                                          hydrostatics *out)
{
	size_t first = real_first(body->waterline_x, body->waterline_count, body->near_m);
	if (first >= body->waterline_count)
		return BATTEN_OK;
	size_t count = body->waterline_count - first;
	const double *x = body->waterline_x + first, *y = body->waterline_y + first;
	curve line;
	batten_status status = curve_create(context, count, x, y, NULL, SPLINE_NATURAL, &line);
	if (status != BATTEN_OK)
		return status;
	curve_nodes nodes;
	status = curve_quadrature(&line, body->rule, x[0], x[count - 1],
	                          "waterline at z =", body->draft_m, &nodes);
	curve_destroy(&line);
	if (status != BATTEN_OK)
		return status;
	out->waterplane_area_m2 = 2 * curve_nodes_moment(&nodes, 0);
	out->waterplane_moment_x_m3 = 2 * curve_nodes_moment(&nodes, 1);
	out->longitudinal_second_moment_m4 = 2 * curve_nodes_moment(&nodes, 2);
	out->transverse_second_moment_m4 = 2.0 / 3.0 * curve_nodes_cube(&nodes);
	out->waterline_length_m = x[count - 1] - x[0];
	out->waterline_half_breadth_m = 0;
	for (size_t i = 0; i < count; i++)
		out->waterline_half_breadth_m = fmax(out->waterline_half_breadth_m, y[i]);
	curve_nodes_release(context, &nodes);
	return BATTEN_OK;
}

/* Sections and waterline at a draft; batten_release() of body->x afterwards, whatever the status. */
static batten_status take_body(batten_context *context, const hydrostatics_sections *sections,
                               double draft_m, batten_quadrature rule, struct body *body)
{
	*body = (struct body){ 0 };
	const batten_hull *hull = sections->source.hull;
	batten_status status = quantities_check_draft(context, hull->z_m[0],
	                                              hull->z_m[hull->waterline_count - 1], draft_m);
	if (status == BATTEN_OK)
		status = body_create(context, sections, draft_m, rule, body);
	return status == BATTEN_OK ? take_sections(body) : status;
}

batten_status hydrostatics_calculate(batten_context *context, const hydrostatics_sections *sections,
                                     double draft_m, batten_quadrature rule, hydrostatics *out)
{
	hydrostatics made = { .midship_area_m2 = NAN,
		                  .waterline_length_m = NAN,
		                  .waterline_half_breadth_m = NAN,
		                  .volume_mismatch_pct = NAN };
	struct body body;
	batten_status status = take_body(context, sections, draft_m, rule, &body);
	size_t first = status == BATTEN_OK ? real_first(body.x, body.count, body.near_m) : 0;
	if (status == BATTEN_OK && first < body.count) {
		status = integrate_areas(context, &body, first, &made);
		if (status == BATTEN_OK)
			status = integrate_one(context, &body, first, body.moment, &made.volume_moment_z_m4);
		if (status == BATTEN_OK)
			status = integrate_one(context, &body, first, body.girth, &made.wetted_surface_m2);
	}
	if (status == BATTEN_OK)
		status = integrate_waterplane(context, &body, &made);
	batten_release(context, body.x);
	if (status == BATTEN_OK)
		*out = made;
	return status;
}

batten_status hydrostatics_area_curve(batten_context *context,
                                      const hydrostatics_sections *sections, double draft_m,
                                      batten_quadrature rule, double *x_m, double *area_m2,
                                      size_t *count)
{
	struct body body;
	batten_status status = take_body(context, sections, draft_m, rule, &body);
	if (status == BATTEN_OK) {
		size_t first = real_first(body.x, body.count, body.near_m);
		*count = body.count - first;
		memcpy(x_m, body.x + first, *count * sizeof *x_m);
		memcpy(area_m2, body.area + first, *count * sizeof *area_m2);
	}
	batten_release(context, body.x);
	return status;
}
