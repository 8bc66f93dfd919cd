/* Integrals below a draft turned into quantities by name, and the same over drafts, whatever the
 * hull is given by. */
#ifndef BATTEN_HYDROSTATICS_QUANTITIES_H
#define BATTEN_HYDROSTATICS_QUANTITIES_H

#include "hydrostatics/hydrostatics.h"

/* A hull that can be put into the water at any draft. */
typedef struct floating_body {
	batten_context *context;
	const void *form;
	double lbp_m, half_beam_m, lowest_m, highest_m; /* drafts lie above lowest, up to highest */
	/* Everything below a draft; volume and waterplane only, which the search for a draft needs. */
	batten_status (*calculate)(const struct floating_body *body, double draft_m, hydrostatics *out);
	batten_status (*float_at)(const struct floating_body *body, double draft_m, hydrostatics *out);
} floating_body;

/* Fills what no options given means, and checks. Errors: USAGE. */
batten_status quantities_options(batten_context *context,
                                 const batten_hydrostatics_options *options,
                                 batten_hydrostatics_options *out);

/* The length of a form that states none: as asked for, else up to its foremost point. what names the
 * form. Errors: USAGE (that point is not before the aft perpendicular). */
batten_status quantities_length(batten_context *context, const char *what,
                                const batten_hydrostatics_options *options, double foremost_m,
                                double *lbp_m);

/* A draft within the table, from lowest (left out) to highest. Errors: USAGE. */
batten_status quantities_check_draft(batten_context *context, double lowest_m, double highest_m,
                                     double draft_m);

void quantities_take(const floating_body *body, const hydrostatics *integrals, double draft_m,
                     const batten_hydrostatics_options *options, batten_hydrostatics *out);

/* What is also a measure, the others NaN. */
batten_measures quantities_as_measures(const batten_hydrostatics *found);

/* count drafts; out untouched on failure. Errors: those of calculate, USAGE, MEMORY. */
batten_status quantities_over_drafts(const floating_body *body,
                                     const batten_hydrostatics_options *options, size_t count,
                                     const double *drafts_m, batten_hydrostatics *out);

/* Errors: those of float_at, USAGE (out of reach). */
batten_status quantities_draft_at(const floating_body *body,
                                  const batten_hydrostatics_options *options, double displacement_t,
                                  double *draft_m);

/* Hulls that have a section everywhere: its area below a draft, both sides. */
typedef batten_status quantities_section(const void *form, double x_m, double draft_m,
                                         double *area_m2);

/* As batten_surface_section_areas(). */
batten_status quantities_sections(const floating_body *body, quantities_section *section,
                                  size_t section_count, const double *x_m, size_t height_count,
                                  const double *heights_m, double *areas_m2);

/* The sections amidships (NaN where the hull is not there) and the largest, of a hull that reaches from
 * aft to fore: a grid of them, then the golden section. */
batten_status quantities_main_sections(const floating_body *body, quantities_section *section,
                                       double draft_m, double aft_m, double fore_m,
                                       hydrostatics *out);

#endif
