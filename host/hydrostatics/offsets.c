/* The public hydrostatics of offset tables. */
#include "core/number.h"
#include "hydrostatics/quantities.h"

#include <math.h>
#include <string.h>

/* A hull with its sections, and the rule they are integrated by. */
struct offsets_form {
	hydrostatics_sections sections;
	batten_quadrature rule;
};

static batten_status calculate(const floating_body *body, double draft_m, hydrostatics *out)
{
	const struct offsets_form *form = body->form;
	return hydrostatics_calculate(body->context, &form->sections, draft_m, form->rule, out);
}

static batten_status open_form(batten_context *context, const batten_hull *hull,
                               const batten_hydrostatics_options *options,
                               batten_hydrostatics_options *chosen, struct offsets_form *form,
                               floating_body *body)
{
	batten_status status = quantities_options(context, options, chosen);
	if (status != BATTEN_OK)
		return status;
	form->rule = chosen->quadrature;
	*body = (floating_body){ .context = context,
		                     .form = form,
		                     .lbp_m = hull->lbp_m,
		                     .half_beam_m = batten_hull_half_beam_m(hull),
		                     .lowest_m = hull->z_m[0],
		                     .highest_m = hull->z_m[hull->waterline_count - 1],
		                     .calculate = calculate,
		                     .float_at = calculate };
	return hydrostatics_sections_create(context, hull, &form->sections);
}

batten_status batten_hull_hydrostatics(batten_context *context, const batten_hull *hull,
                                       const batten_hydrostatics_options *options, size_t count,
                                       const double *drafts_m, batten_hydrostatics *out)
{
	struct offsets_form form;
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, hull, options, &chosen, &form, &body);
	if (status != BATTEN_OK)
		return status;
	status = quantities_over_drafts(&body, &chosen, count, drafts_m, out);
	hydrostatics_sections_destroy(context, &form.sections);
	return status;
}

batten_status batten_hull_draft_at(batten_context *context, const batten_hull *hull,
                                   const batten_hydrostatics_options *options,
                                   double displacement_t, double *draft_m)
{
	struct offsets_form form;
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, hull, options, &chosen, &form, &body);
	if (status != BATTEN_OK)
		return status;
	status = quantities_draft_at(&body, &chosen, displacement_t, draft_m);
	hydrostatics_sections_destroy(context, &form.sections);
	return status;
}

batten_status batten_hull_section_areas(batten_context *context, const batten_hull *hull,
                                        const batten_hydrostatics_options *options, size_t count,
                                        const double *heights_m, double *areas_m2)
{
	struct offsets_form form;
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, hull, options, &chosen, &form, &body);
	if (status != BATTEN_OK)
		return status;
	const size_t stations = hull->station_count;
	size_t places = 0;
	const bool fits = batten_size_multiply(count, stations, &places);
	double *made = batten_allocate(context, fits ? places : SIZE_MAX, sizeof *made);
	if (!made) {
		hydrostatics_sections_destroy(context, &form.sections);
		return BATTEN_MEMORY;
	}
	for (size_t k = 0; k < count && status == BATTEN_OK; k++) {
		status = quantities_check_draft(context, body.lowest_m, body.highest_m, heights_m[k]);
		for (size_t i = 0; i < stations && status == BATTEN_OK; i++) {
			section_immersed immersed;
			status = section_immerse(&form.sections.sections[i], fmin(heights_m[k], body.highest_m),
			                         form.rule, &immersed);
			if (status == BATTEN_OK)
				made[k * stations + i] = immersed.area_m2;
		}
	}
	if (status == BATTEN_OK)
		memcpy(areas_m2, made, places * sizeof *made);
	batten_release(context, made);
	hydrostatics_sections_destroy(context, &form.sections);
	return status;
}

batten_status batten_hull_area_curve(batten_context *context, const batten_hull *hull,
                                     const batten_hydrostatics_options *options, double draft_m,
                                     double *x_m, double *area_m2, size_t *count)
{
	struct offsets_form form;
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, hull, options, &chosen, &form, &body);
	if (status != BATTEN_OK)
		return status;
	status = hydrostatics_area_curve(context, &form.sections, draft_m, form.rule, x_m, area_m2,
	                                 count);
	hydrostatics_sections_destroy(context, &form.sections);
	return status;
}
