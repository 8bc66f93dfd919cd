/* batten.h, one part of it: lines plans, curvature maps and charts. */
#ifndef BATTEN_PICTURE_H
#define BATTEN_PICTURE_H

#include "base.h"
#include "curve.h"
#include "fairing.h"
#include "hull.h"
#include "hydrostatics.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Pictures
 * --------------------------------------------------------------------------------------------- */

typedef struct batten_picture_options {
	size_t struct_size;
	unsigned width, height; /* pixels, 64..8192; 1600 x 900 */
	const char *title;      /* NULL takes the hull's name */
	double scale_per_m; /* curvature at the ends of the colour scale; 0 takes it from the hull */
} batten_picture_options;
BATTEN_API void batten_picture_options_default(batten_picture_options *options);

/* The curvature at the ends of the colour scale that suits a hull (1/m). */
BATTEN_API batten_status batten_picture_scale(batten_context *context, const batten_hull *hull,
                                              double *scale_per_m);

/* Curvature map of the whole hull as PNG, drawn by Vulkan. driver (128 bytes) gets the name of what
 * drew it and may be NULL. Errors: DEVICE (no Vulkan driver), USAGE (an option out of its range), INPUT
 * (nothing to draw), IO, MEMORY, INTERNAL. */
BATTEN_API batten_status batten_picture_curvature(batten_context *context, const batten_hull *hull,
                                                  const batten_picture_options *options,
                                                  const char *path, char *driver);

/* Body plan and waterlines before (may be NULL) and after as SVG. Errors: INPUT (nothing to draw), IO,
 * MEMORY. */
BATTEN_API batten_status batten_picture_lines(batten_context *context, const batten_hull *before,
                                              const batten_hull *after, const char *path);

/* Hulls side by side. Arrays borrowed for the call. */
typedef struct batten_comparison {
	const char *title;
	size_t hull_count;               /* 1..8 */
	const batten_hull *const *hulls; /* the first lies pale under the lines of the others */
	const char *const *labels;
	size_t row_count; /* 0..40 */
	const char *const *row_names;
	const double *values; /* [row_count][hull_count]; NaN is a dash */
} batten_comparison;

/* One sheet as SVG: of each hull its body plan, its waterlines and a flat map of its mean curvature, on
 * one scale, and under them a table. Errors: USAGE (counts), INPUT (nothing to draw), IO, MEMORY. */
BATTEN_API batten_status batten_picture_comparison(batten_context *context,
                                                   const batten_comparison *comparison,
                                                   const char *path);

/* Curves through or near the same points, with their porcupines, and the curvature of each over its
 * arc length, as SVG (Letcher 3.3). count 1..8, all of one dimension. Errors: USAGE, IO, MEMORY. */
BATTEN_API batten_status batten_picture_curves(batten_context *context, const batten_points *points,
                                               size_t count, const batten_curve *const *curves,
                                               const char *path);

/* A front: fairness over the root mean square change, as SVG. count 2 or more. Errors: USAGE, IO,
 * MEMORY. */
BATTEN_API batten_status batten_picture_front(batten_context *context, const char *name,
                                              size_t count, const batten_front_point *points,
                                              const char *path);

/* Curves of form: draft upwards, every quantity on one scale of 0 to 10 by a power of ten that the
 * legend states (Letcher 11.1). count >= 2 rows of ascending draft. Errors: USAGE, IO, MEMORY. */
BATTEN_API batten_status batten_picture_curves_of_form(batten_context *context, const char *name,
                                                       size_t count,
                                                       const batten_hydrostatics *rows,
                                                       const char *path);

/* Bonjean's curves on the profile: at each section its area up to each height, to the right of it.
 * areas_m2 [height_count][section_count], both counts >= 2, x and heights ascending. */
BATTEN_API batten_status batten_picture_bonjean(batten_context *context, const char *name,
                                                size_t section_count, const double *x_m,
                                                size_t height_count, const double *heights_m,
                                                const double *areas_m2, const char *path);

/* Section area curves at curve_count drafts: counts[curve] points each, one after the other in x_m
 * and area_m2. */
BATTEN_API batten_status batten_picture_section_areas(batten_context *context, const char *name,
                                                      size_t curve_count, const double *drafts_m,
                                                      const size_t *counts, const double *x_m,
                                                      const double *area_m2, const char *path);

#ifdef __cplusplus
}
#endif

#endif
