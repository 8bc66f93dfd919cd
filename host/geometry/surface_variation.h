/* The variation of curvature over a whole surface (Moreton and Sequin 1992; Letcher 4.5). */
#ifndef BATTEN_GEOMETRY_SURFACE_VARIATION_H
#define BATTEN_GEOMETRY_SURFACE_VARIATION_H

#include "core/context.h"

typedef struct surface_variation_sum {
	double per_m2;   /* integral of ((dk1/de1)^2 + (dk2/de2)^2) dA */
	size_t left_out; /* points without a normal, or where k1 and k2 are alike: they count nothing */
} surface_variation_sum;

/* By Gauss quadrature, points of them (1..16) a knot span and direction; 0 takes the order of the
 * direction + 1. Errors: USAGE. */
batten_status surface_variation_integrate(batten_context *context, const batten_surface *surface,
                                          size_t points, surface_variation_sum *out);

#endif
