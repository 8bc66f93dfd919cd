#include "hydrostatics/quantities.h"

#include "core/gauss.h"
#include "core/number.h"

#include <math.h>
#include <string.h>

static const char *const names[] = {
#define HYDROSTATICS_NAME(name, text) #name,
	BATTEN_HYDROSTATICS_LIST(HYDROSTATICS_NAME)
#undef HYDROSTATICS_NAME
};
static const char *const texts[] = {
#define HYDROSTATICS_TEXT(name, text) text,
	BATTEN_HYDROSTATICS_LIST(HYDROSTATICS_TEXT)
#undef HYDROSTATICS_TEXT
};

const char *batten_hydrostatics_name(size_t i)
{
	return i < BATTEN_HYDROSTATICS_COUNT ? names[i] : NULL;
}

const char *batten_hydrostatics_text(size_t i)
{
	return i < BATTEN_HYDROSTATICS_COUNT ? texts[i] : NULL;
}

void batten_hydrostatics_options_default(batten_hydrostatics_options *options)
{
	*options = (batten_hydrostatics_options){ .struct_size = sizeof *options,
		                                      .quadrature = BATTEN_QUADRATURE_SPLINE,
		                                      .density_t_per_m3 = 1.025,
		                                      .kg_m = NAN };
}

batten_status quantities_options(batten_context *context,
                                 const batten_hydrostatics_options *options,
                                 batten_hydrostatics_options *out)
{
	batten_hydrostatics_options_default(out);
	if (!options)
		return BATTEN_OK;
	if (options->struct_size != sizeof *options)
		return batten_fail(
			context, BATTEN_USAGE,
			"hydrostatics options: not filled by batten_hydrostatics_options_default()");
	if (!isfinite(options->density_t_per_m3) || options->density_t_per_m3 <= 0)
		return batten_fail(context, BATTEN_USAGE, "density %g t/m3: expected a positive number",
		                   options->density_t_per_m3);
	if (options->quadrature != BATTEN_QUADRATURE_SPLINE &&
	    options->quadrature != BATTEN_QUADRATURE_SIMPSON &&
	    options->quadrature != BATTEN_QUADRATURE_TRAPEZOID)
		return batten_fail(context, BATTEN_USAGE, "quadrature %d: no such rule",
		                   (int)options->quadrature);
	if (isinf(options->kg_m))
		return batten_fail(context, BATTEN_USAGE, "kg %g m: expected a finite height",
		                   options->kg_m);
	if (!isfinite(options->lbp_m) || options->lbp_m < 0)
		return batten_fail(context, BATTEN_USAGE, "lbp %g m: expected a positive number",
		                   options->lbp_m);
	if (options->gauss_points > GAUSS_POINTS_MOST)
		return batten_fail(context, BATTEN_USAGE, "%u Gauss points a span: 1 to %d are expected",
		                   options->gauss_points, GAUSS_POINTS_MOST);
	*out = *options;
	return BATTEN_OK;
}

batten_status quantities_length(batten_context *context, const char *what,
                                const batten_hydrostatics_options *options, double foremost_m,
                                double *lbp_m)
{
	*lbp_m = options->lbp_m > 0 ? options->lbp_m : foremost_m;
	if (*lbp_m > 0)
		return BATTEN_OK;
	return batten_fail(context, BATTEN_USAGE,
	                   "a %s that ends at x = %g m, not before the aft perpendicular: its lbp was "
	                   "expected",
	                   what, *lbp_m);
}

batten_status quantities_check_draft(batten_context *context, double lowest_m, double highest_m,
                                     double draft_m)
{
	if (!(draft_m > lowest_m && draft_m <= highest_m + 1e-9 * (highest_m - lowest_m)))
		return batten_fail(context, BATTEN_USAGE,
		                   "draft %g m: the hull goes from %g to %g m, expected a draft within it",
		                   draft_m, lowest_m, highest_m);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * From integrals to quantities
 * --------------------------------------------------------------------------------------------- */

/* A quantity that would be divided by nothing does not exist. */
static double ratio(double of, double by)
{
	return by > 0 ? of / by : NAN;
}

static void take_volume(const hydrostatics *integrals, double density_t_per_m3,
                        batten_hydrostatics *out)
{
	out->volume_m3 = integrals->volume_m3;
	out->displacement_t = density_t_per_m3 * integrals->volume_m3;
	out->wetted_surface_m2 = integrals->wetted_surface_m2;
	out->transom_area_m2 = integrals->transom_area_m2;
	out->midship_area_m2 = integrals->midship_area_m2;
	out->max_section_area_m2 = integrals->max_section_area_m2;
	out->volume_mismatch_pct = integrals->volume_mismatch_pct;
	out->xcb_from_ap_m = ratio(integrals->volume_moment_x_m4, integrals->volume_m3);
	out->lcb_pct_lbp_fwd = 100 * (out->xcb_from_ap_m - 0.5 * out->lbp_m) / out->lbp_m;
	out->kb_m = ratio(integrals->volume_moment_z_m4, integrals->volume_m3);
}

static void take_waterplane(const hydrostatics *integrals, double density_t_per_m3,
                            batten_hydrostatics *out)
{
	double area = integrals->waterplane_area_m2, moment = integrals->waterplane_moment_x_m3;
	out->waterplane_area_m2 = area;
	out->tpc_t_per_cm = density_t_per_m3 * area / 100;
	out->xcf_from_ap_m = ratio(moment, area);
	out->lcf_pct_lbp_fwd = 100 * (out->xcf_from_ap_m - 0.5 * out->lbp_m) / out->lbp_m;
	out->i_t_m4 = integrals->transverse_second_moment_m4;
	out->i_l_m4 = integrals->longitudinal_second_moment_m4 - ratio(moment * moment, area);
	out->bmt_m = ratio(out->i_t_m4, out->volume_m3);
	out->bml_m = ratio(out->i_l_m4, out->volume_m3);
	out->kmt_m = out->kb_m + out->bmt_m;
	out->kml_m = out->kb_m + out->bml_m;
}

/* L = lbp_m, B = beam_wl_m. */
static void take_coefficients(batten_hydrostatics *out)
{
	double length = out->lbp_m, beam_draft = out->beam_wl_m * out->draft_m;
	out->cb = ratio(out->volume_m3, length * beam_draft);
	out->cp = ratio(out->volume_m3, length * out->midship_area_m2);
	out->cm = ratio(out->midship_area_m2, beam_draft);
	out->cwp = ratio(out->waterplane_area_m2, length * out->beam_wl_m);
	out->cv = ratio(1000 * out->volume_m3, length * length * length);
	out->cws = ratio(out->wetted_surface_m2, sqrt(out->volume_m3 * length));
}

void quantities_take(const floating_body *body, const hydrostatics *integrals, double draft_m,
                     const batten_hydrostatics_options *options, batten_hydrostatics *out)
{
	batten_hydrostatics made = { .lbp_m = body->lbp_m, .draft_m = draft_m };
	made.half_beam_m = body->half_beam_m;
	made.beam_max_m = 2 * made.half_beam_m;
	made.lwl_m = integrals->waterline_length_m;
	made.beam_wl_m = 2 * integrals->waterline_half_breadth_m;
	take_volume(integrals, options->density_t_per_m3, &made);
	take_waterplane(integrals, options->density_t_per_m3, &made);
	take_coefficients(&made);
	made.gmt_m = made.kmt_m - options->kg_m;
	made.gml_m = made.kml_m - options->kg_m;
	made.mt1cm_t_m_per_cm = made.displacement_t * made.gml_m / (100 * made.lbp_m);
	*out = made;
}

batten_measures quantities_as_measures(const batten_hydrostatics *found)
{
	batten_measures made;
	double *numbers = (double *)&made;
	for (size_t i = 0; i < sizeof made / sizeof *numbers; i++)
		numbers[i] = NAN;
#define TAKE_QUANTITY(name, text) made.name = found->name;
	BATTEN_FORM_LIST(TAKE_QUANTITY)
#undef TAKE_QUANTITY
	return made;
}

/* ------------------------------------------------------------------------------------------------
 * Over drafts
 * --------------------------------------------------------------------------------------------- */

batten_status quantities_over_drafts(const floating_body *body,
                                     const batten_hydrostatics_options *options, size_t count,
                                     const double *drafts_m, batten_hydrostatics *out)
{
	batten_hydrostatics *made = batten_allocate(body->context, count, sizeof *made);
	batten_status status = made ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		hydrostatics integrals;
		status = quantities_check_draft(body->context, body->lowest_m, body->highest_m,
		                                drafts_m[i]);
		if (status == BATTEN_OK)
			status = body->calculate(body, drafts_m[i], &integrals);
		if (status == BATTEN_OK)
			quantities_take(body, &integrals, drafts_m[i], options, &made[i]);
	}
	if (status == BATTEN_OK && count > 0)
		memcpy(out, made, count * sizeof *made);
	batten_release(body->context, made);
	return status;
}

batten_status quantities_draft_at(const floating_body *body,
                                  const batten_hydrostatics_options *options, double displacement_t,
                                  double *draft_m)
{
	enum { TURNS = 200 };
	const double target = displacement_t / options->density_t_per_m3;
	double low = body->lowest_m, high = body->highest_m, draft = high;
	hydrostatics here;
	batten_status status = body->float_at(body, high, &here);
	if (status != BATTEN_OK)
		return status;
	double full = here.volume_m3 * options->density_t_per_m3;
	if (!(displacement_t > 0 && displacement_t <= full * (1 + 1e-12)))
		return batten_fail(
			body->context, BATTEN_USAGE,
			"displacement %g t: the hull displaces up to %.9g t, at a draft of %g m, "
			"expected one above 0 within it",
			displacement_t, full, high);
	for (int turn = 0; turn < TURNS && status == BATTEN_OK; turn++) {
		double over = here.volume_m3 - target;
		if (fabs(over) <= 1e-14 * target || high - low <= 1e-15 * fabs(high))
			break;
		if (over > 0)
			high = draft;
		else
			low = draft;
		double next = draft - over / here.waterplane_area_m2;
		draft = next > low && next < high ? next : 0.5 * (low + high);
		status = body->float_at(body, draft, &here);
	}
	if (status == BATTEN_OK)
		*draft_m = draft;
	return status;
}

batten_status quantities_sections(const floating_body *body, quantities_section *section,
                                  size_t section_count, const double *x_m, size_t height_count,
                                  const double *heights_m, double *areas_m2)
{
	size_t count = 0;
	if (!batten_size_multiply(section_count, height_count, &count))
		return batten_fail_memory(body->context);
	double *made = batten_allocate(body->context, count, sizeof *made);
	batten_status status = made ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t i = 0; i < section_count && status == BATTEN_OK; i++)
		if (!isfinite(x_m[i]))
			status = batten_fail(body->context, BATTEN_USAGE,
			                     "section %zu: its x is not a finite number", i);
	for (size_t k = 0; k < height_count && status == BATTEN_OK; k++) {
		status = quantities_check_draft(body->context, body->lowest_m, body->highest_m,
		                                heights_m[k]);
		for (size_t i = 0; i < section_count && status == BATTEN_OK; i++)
			status = section(body->form, x_m[i], heights_m[k], &made[k * section_count + i]);
	}
	if (status == BATTEN_OK && count > 0)
		memcpy(areas_m2, made, count * sizeof *made);
	batten_release(body->context, made);
	return status;
}

static batten_status largest_section(quantities_section *section, const void *form, double draft_m,
                                     double aft_m, double fore_m, double *area_m2)
{
	enum { PARTS = 16, TURNS = 24 };
	const double golden = 0.61803398874989484820, step = (fore_m - aft_m) / PARTS;
	double largest = 0, at = aft_m, here = 0;
	batten_status status = BATTEN_OK;
	for (int i = 0; i <= PARTS && status == BATTEN_OK; i++) {
		status = section(form, aft_m + step * i, draft_m, &here);
		if (status == BATTEN_OK && here > largest) {
			largest = here;
			at = aft_m + step * i;
		}
	}
	double a = fmax(aft_m, at - step), b = fmin(fore_m, at + step);
	for (int turn = 0; turn < TURNS && status == BATTEN_OK; turn++) {
		double inner = b - golden * (b - a), outer = a + golden * (b - a), beyond = 0;
		status = section(form, inner, draft_m, &here);
		if (status == BATTEN_OK)
			status = section(form, outer, draft_m, &beyond);
		if (here > beyond)
			b = outer;
		else
			a = inner;
		largest = fmax(largest, fmax(here, beyond));
	}
	if (status == BATTEN_OK)
		*area_m2 = largest;
	return status;
}

batten_status quantities_main_sections(const floating_body *body, quantities_section *section,
                                       double draft_m, double aft_m, double fore_m,
                                       hydrostatics *out)
{
	const double amidships = 0.5 * body->lbp_m;
	const bool there = amidships >= aft_m && amidships <= fore_m;
	double midship = NAN;
	double largest = 0;
	batten_status status = BATTEN_OK;
	if (there)
		status = section(body->form, amidships, draft_m, &midship);
	if (status == BATTEN_OK)
		status = largest_section(section, body->form, draft_m, aft_m, fore_m, &largest);
	if (status != BATTEN_OK)
		return status;
	out->midship_area_m2 = midship;
	out->max_section_area_m2 = there ? fmax(largest, midship) : largest;
	return BATTEN_OK;
}
