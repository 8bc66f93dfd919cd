/* The upright hydrostatics among the measures by name (Letcher 10.2, 11.1). */
#include "hydrostatics/hydrostatics.h"

#include <math.h>

/* A measure that would be divided by nothing does not exist. */
static double ratio(double of, double by)
{
	return by > 0 ? of / by : NAN;
}

static void take_dimensions(const batten_hull *hull, double draft_m, const hydrostatics *body,
                            batten_measures *out)
{
	out->lbp_m = hull->lbp_m;
	out->draft_m = draft_m;
	out->half_beam_m = batten_hull_half_beam_m(hull);
	out->beam_max_m = 2 * out->half_beam_m;
	out->lwl_m = body->waterline_length_m;
	out->beam_wl_m = 2 * body->waterline_half_breadth_m;
}

static void take_volume(const hydrostatics *body, double density_t_per_m3, batten_measures *out)
{
	out->volume_m3 = body->volume_m3;
	out->displacement_t = density_t_per_m3 * body->volume_m3;
	out->wetted_surface_m2 = body->wetted_surface_m2;
	out->midship_area_m2 = body->midship_area_m2;
	out->max_section_area_m2 = body->max_section_area_m2;
	out->xcb_from_ap_m = ratio(body->volume_moment_x_m4, body->volume_m3);
	out->lcb_pct_lbp_fwd = 100 * (out->xcb_from_ap_m - 0.5 * out->lbp_m) / out->lbp_m;
	out->kb_m = ratio(body->volume_moment_z_m4, body->volume_m3);
}

static void take_waterplane(const hydrostatics *body, double density_t_per_m3, batten_measures *out)
{
	double area = body->waterplane_area_m2;
	out->waterplane_area_m2 = area;
	out->tpc_t_per_cm = density_t_per_m3 * area / 100;
	out->xcf_from_ap_m = ratio(body->waterplane_moment_x_m3, area);
	out->lcf_pct_lbp_fwd = 100 * (out->xcf_from_ap_m - 0.5 * out->lbp_m) / out->lbp_m;
	out->i_t_m4 = body->transverse_second_moment_m4;
	out->i_l_m4 = body->longitudinal_second_moment_m4 -
	              ratio(body->waterplane_moment_x_m3 * body->waterplane_moment_x_m3, area);
	out->bmt_m = ratio(out->i_t_m4, out->volume_m3);
	out->bml_m = ratio(out->i_l_m4, out->volume_m3);
	out->kmt_m = out->kb_m + out->bmt_m;
	out->kml_m = out->kb_m + out->bml_m;
}

/* L = lbp_m, B = beam_wl_m. */
static void take_coefficients(batten_measures *out)
{
	double length = out->lbp_m, beam_draft = out->beam_wl_m * out->draft_m;
	out->cb = ratio(out->volume_m3, length * beam_draft);
	out->cp = ratio(out->volume_m3, length * out->midship_area_m2);
	out->cm = ratio(out->midship_area_m2, beam_draft);
	out->cwp = ratio(out->waterplane_area_m2, length * out->beam_wl_m);
	out->cv = ratio(1000 * out->volume_m3, length * length * length);
	out->cws = ratio(out->wetted_surface_m2, sqrt(out->volume_m3 * length));
}

void hydrostatics_measures(const batten_hull *hull, double draft_m, double density_t_per_m3,
                           const hydrostatics *body, batten_measures *out)
{
	/* The struct is an array of doubles in the order of the names (batten.h). */
	double *values = (double *)out;
	for (size_t i = 0; i < BATTEN_MEASURE_COUNT; i++)
		values[i] = NAN;
	take_dimensions(hull, draft_m, body, out);
	take_volume(body, density_t_per_m3, out);
	take_waterplane(body, density_t_per_m3, out);
	take_coefficients(out);
}
