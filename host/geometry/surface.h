/* A hull as one tensor-product B-spline surface (thesis 3.2.3.2, Letcher 4.9-4.10).
 *
 * u runs along the hull (x), v along the girth from keel to deck. Half hull, y >= 0, metres, frame
 * ap-fwd. The range of u is [knots_u[order_u - 1], knots_u[count_u]], of v likewise; knots as in
 * bspline.h. */
#ifndef BATTEN_GEOMETRY_SURFACE_H
#define BATTEN_GEOMETRY_SURFACE_H

#include "core/context.h"
#include "geometry/bspline.h"

struct batten_surface {
	batten_context *context;
	char *name;                /* never NULL */
	size_t order_u, order_v;   /* 2..8 */
	size_t count_u, count_v;   /* poles; >= order */
	double *knots_u, *knots_v; /* count + order each, not decreasing */
	double *poles;             /* [count_v][count_u][3]: x, y, z */
	double *weights;           /* [count_v][count_u], > 0, or NULL: all 1 */
};

/* A surface of the given shape with clamped knots 0..1, poles at 0 and weights 1 (where rational),
 * for the caller to fill; surface_check() afterwards. NULL name is "". Destroyed by
 * batten_surface_destroy(). Errors: USAGE (an order or a count out of its range), MEMORY. */
batten_status surface_allocate(batten_context *context, const char *name, size_t order_u,
                               size_t order_v, size_t count_u, size_t count_v, bool rational,
                               struct batten_surface **out);

/* Orders, counts, knots, finite poles, weights > 0. One line says what is wrong. Errors: USAGE. */
batten_status surface_check(const struct batten_surface *surface);

/* As batten_surface_evaluate, up to highest <= 3 derivatives in all: d[i][j] for i + j <= highest,
 * the others are 0. */
typedef double surface_jet[BSPLINE_DERIVATIVES_MOST + 1][BSPLINE_DERIVATIVES_MOST + 1][3];
void surface_evaluate(const struct batten_surface *surface, double u, double v, size_t highest,
                      surface_jet d);

#endif
