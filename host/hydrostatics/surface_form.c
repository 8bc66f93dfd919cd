/* The public hydrostatics of B-spline surfaces. */
#include "hydrostatics/patch.h"
#include "hydrostatics/quantities.h"

#include <math.h>
#include <string.h>

static batten_status float_at(const floating_body *body, double draft_m, hydrostatics *out)
{
	hydrostatics made = { 0 };
	patch_integrate(body->form, draft_m, &made);
	*out = made;
	return BATTEN_OK;
}

static batten_status section_of(const void *form, double x_m, double draft_m, double *area_m2)
{
	*area_m2 = patch_section_area(form, x_m, draft_m);
	return BATTEN_OK;
}

static batten_status calculate(const floating_body *body, double draft_m, hydrostatics *out)
{
	const struct patch *patch = body->form;
	hydrostatics made = { 0 };
	patch_integrate(patch, draft_m, &made);
	patch_waterline(patch, draft_m, &made);
	batten_status status = quantities_main_sections(body, section_of, draft_m, patch->aftmost_m,
	                                                patch->foremost_m, &made);
	if (status == BATTEN_OK)
		*out = made;
	return status;
}

/* patch_destroy() afterwards. */
static batten_status open_form(batten_context *context, const batten_surface *surface,
                               const batten_hydrostatics_options *options,
                               batten_hydrostatics_options *chosen, struct patch *patch,
                               floating_body *body)
{
	batten_status status = quantities_options(context, options, chosen);
	if (status == BATTEN_OK)
		status = patch_create(context, surface, chosen->gauss_points, patch);
	if (status != BATTEN_OK)
		return status;
	*body = (floating_body){ .context = context,
		                     .form = patch,
		                     .half_beam_m = patch->half_beam_m,
		                     .lowest_m = patch->lowest_m,
		                     .highest_m = patch->highest_m,
		                     .calculate = calculate,
		                     .float_at = float_at };
	status = quantities_length(context, "surface", chosen, patch->foremost_m, &body->lbp_m);
	if (status != BATTEN_OK)
		patch_destroy(patch);
	return status;
}

batten_status batten_surface_hydrostatics(batten_context *context, const batten_surface *surface,
                                          const batten_hydrostatics_options *options, size_t count,
                                          const double *drafts_m, batten_hydrostatics *out)
{
	struct patch patch;
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, surface, options, &chosen, &patch, &body);
	if (status != BATTEN_OK)
		return status;
	status = quantities_over_drafts(&body, &chosen, count, drafts_m, out);
	patch_destroy(&patch);
	return status;
}

batten_status batten_surface_draft_at(batten_context *context, const batten_surface *surface,
                                      const batten_hydrostatics_options *options,
                                      double displacement_t, double *draft_m)
{
	struct patch patch;
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, surface, options, &chosen, &patch, &body);
	if (status != BATTEN_OK)
		return status;
	status = quantities_draft_at(&body, &chosen, displacement_t, draft_m);
	patch_destroy(&patch);
	return status;
}

batten_status batten_surface_section_areas(batten_context *context, const batten_surface *surface,
                                           const batten_hydrostatics_options *options,
                                           size_t section_count, const double *x_m,
                                           size_t height_count, const double *heights_m,
                                           double *areas_m2)
{
	struct patch patch;
	floating_body body;
	batten_hydrostatics_options chosen;
	batten_status status = open_form(context, surface, options, &chosen, &patch, &body);
	if (status != BATTEN_OK)
		return status;
	status = quantities_sections(&body, section_of, section_count, x_m, height_count, heights_m,
	                             areas_m2);
	patch_destroy(&patch);
	return status;
}

batten_status batten_surface_measure(batten_context *context, const batten_surface *surface,
                                     const batten_hydrostatics_options *options, double draft_m,
                                     batten_measures *out)
{
	batten_hydrostatics found;
	batten_surface_energies energies;
	batten_surface_batch_options how;
	batten_surface_batch_options_default(&how);
	how.device = BATTEN_DEVICE_REFERENCE;
	how.variation = true;
	batten_status status = batten_surface_hydrostatics(context, surface, options, 1, &draft_m,
	                                                   &found);
	if (status == BATTEN_OK)
		status = batten_surface_energy_batch(context, 1, &surface, &how, &energies, NULL);
	if (status != BATTEN_OK)
		return status;
	batten_measures made = quantities_as_measures(&found);
	made.energy_bending = energies.bending;
	made.energy_mean = energies.mean;
	made.energy_gauss = energies.gauss;
	made.energy_mvc_per_m2 = energies.variation_per_m2;
	*out = made;
	return BATTEN_OK;
}
