/* Upright hydrostatics of a hull from its offsets (Letcher 9-11; README.md says how). */
#ifndef BATTEN_HYDROSTATICS_HYDROSTATICS_H
#define BATTEN_HYDROSTATICS_HYDROSTATICS_H

#include "hull/hull.h"

/* Moulded, both sides, below one draft; x from the aft perpendicular, z from the baseline. */
typedef struct hydrostatics {
	double volume_m3;
	double volume_moment_x_m4, volume_moment_z_m4;
	double wetted_surface_m2; /* transom left out */
	double midship_area_m2;   /* NaN when no section stands amidships */
	double max_section_area_m2;
	/* of the waterplane; length and half-breadth NaN where the hull has no waterline there */
	double waterline_length_m, waterline_half_breadth_m;
	double waterplane_area_m2, waterplane_moment_x_m3;
	double transverse_second_moment_m4;   /* about the centreplane */
	double longitudinal_second_moment_m4; /* about x = 0 */
} hydrostatics;

/* Errors: USAGE (the draft is not within the table), INPUT (Simpson's conditions), MEMORY. */
batten_status hydrostatics_calculate(batten_context *context, const batten_hull *hull,
                                     double draft_m, batten_quadrature rule, hydrostatics *out);

/* The measures that follow from it; those of fairness are NaN. */
void hydrostatics_measures(const batten_hull *hull, double draft_m, double density_t_per_m3,
                           const hydrostatics *body, batten_measures *out);

#endif
