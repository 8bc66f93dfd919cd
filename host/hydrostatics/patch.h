/* A B-spline surface as a boundary that is integrated over: knot lines, Gauss points, and the
 * waterline that cuts its spans. */
#ifndef BATTEN_HYDROSTATICS_PATCH_H
#define BATTEN_HYDROSTATICS_PATCH_H

#include "core/gauss.h"
#include "geometry/surface.h"
#include "hydrostatics/hydrostatics.h"

struct patch {
	batten_context *context;
	const struct batten_surface *surface;
	size_t points; /* Gauss points a span and direction */
	double nodes[GAUSS_POINTS_MOST], weights[GAUSS_POINTS_MOST]; /* over 0..1 */
	size_t u_count, v_count;                                     /* spans that are not empty */
	double *u, *v;                                               /* knot lines, spans + 1 each */
	double *breaks; /* of one span of u, as many as patch_roots() finds on all lines of v */
	double lowest_m, highest_m, foremost_m, aftmost_m, half_beam_m;
};

/* Gauss points of an interval; 0 takes the default of batten_hydrostatics_options. */
size_t patch_points(size_t order_u, size_t order_v, size_t points);

/* points as patch_points(). The surface is borrowed.
 * Errors: USAGE, MEMORY. */
batten_status patch_create(batten_context *context, const struct batten_surface *surface,
                           size_t points, struct patch *out);
void patch_destroy(struct patch *patch);

/* A function of one parameter. */
typedef double patch_function(const void *closure, double t);

/* Where a function changes from <= 0 to > 0 or back between a and b, ascending, as far as samples
 * tell it. */
enum { PATCH_ROOTS_MOST = 8 };
size_t patch_roots(patch_function *function, const void *closure, double a, double b,
                   double roots[PATCH_ROOTS_MOST]);

/* Largest value of a function between a and b, where it has one maximum. */
double patch_largest(patch_function *function, const void *closure, double a, double b, double *at);

/* How far above a draft a point still counts as below it. */
double patch_draft_edge(const struct patch *patch, double draft_m);

/* Visits the Gauss points below the draft along v, at one u. */
typedef void patch_visit(void *closure, double u, double v, double weight);
void patch_along_v(const struct patch *patch, double u, double draft_m, patch_visit *visit,
                   void *closure);

/* Volume, moments, waterplane, wetted surface and transoms; the others are left 0. */
void patch_integrate(const struct patch *patch, double draft_m, hydrostatics *out);

/* Length and half-breadth of the waterline. */
void patch_waterline(const struct patch *patch, double draft_m, hydrostatics *out);

/* Area of the section at x below a draft, both sides; 0 where there is none. */
double patch_section_area(const struct patch *patch, double x_m, double draft_m);

/* Breaks of span i of u where the waterline crosses knot lines of v, ascending. */
size_t patch_breaks(const struct patch *patch, size_t i, double draft_m);

#endif
