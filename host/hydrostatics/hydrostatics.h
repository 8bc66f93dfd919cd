/* Upright hydrostatics of a hull from its offsets (Letcher 9-11; README.md says how). */
#ifndef BATTEN_HYDROSTATICS_HYDROSTATICS_H
#define BATTEN_HYDROSTATICS_HYDROSTATICS_H

#include "hydrostatics/section.h"

/* Moulded, both sides, below one draft; x from the aft perpendicular, z from the baseline. Moments
 * are carried, divided last: quantities.h. */
typedef struct hydrostatics {
	double volume_m3;
	double volume_moment_x_m4, volume_moment_z_m4;
	double wetted_surface_m2; /* transom left out */
	double transom_area_m2;   /* both ends */
	double midship_area_m2;   /* NaN when no section stands amidships */
	double max_section_area_m2;
	/* of the waterplane; length and half-breadth NaN where the hull has no waterline there */
	double waterline_length_m, waterline_half_breadth_m;
	double waterplane_area_m2, waterplane_moment_x_m3;
	double transverse_second_moment_m4;   /* about the centreplane */
	double longitudinal_second_moment_m4; /* about x = 0 */
	double volume_mismatch_pct;           /* NaN for offsets */
} hydrostatics;

/* The sections of a hull, made once for any number of drafts. The hull is borrowed. */
typedef struct hydrostatics_sections {
	section_source source;
	struct section *sections; /* [stations] */
} hydrostatics_sections;

/* Errors: MEMORY. */
batten_status hydrostatics_sections_create(batten_context *context, const batten_hull *hull,
                                           hydrostatics_sections *out);
void hydrostatics_sections_destroy(batten_context *context, hydrostatics_sections *sections);

/* Errors: USAGE (the draft is not within the table), INPUT (Simpson's conditions), MEMORY. */
batten_status hydrostatics_calculate(batten_context *context, const hydrostatics_sections *sections,
                                     double draft_m, batten_quadrature rule, hydrostatics *out);

/* The curve of section areas at one draft as it is integrated, its ends beyond the stations
 * included: x and area have room for stations + 2. Errors: as hydrostatics_calculate(). */
batten_status hydrostatics_area_curve(batten_context *context,
                                      const hydrostatics_sections *sections, double draft_m,
                                      batten_quadrature rule, double *x_m, double *area_m2,
                                      size_t *count);

#endif
