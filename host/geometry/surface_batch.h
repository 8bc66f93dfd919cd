/* Parameters of a batch of surfaces turned into the tables that host/batch works with. */
#ifndef BATTEN_GEOMETRY_SURFACE_BATCH_H
#define BATTEN_GEOMETRY_SURFACE_BATCH_H

#include "batch/surface_plan.h"
#include "geometry/surface.h"

/* What all surfaces of a batch agree in, found in the first of them. */
typedef struct surface_topology {
	size_t order_u, order_v, count_u, count_v;
	const double *knots_u, *knots_v;
	bool rational;
} surface_topology;

/* Errors: USAGE (no surface, or one that differs from the first). */
batten_status surface_topology_of(batten_context *context, size_t count,
                                  const batten_surface *const *surfaces, surface_topology *out);

/* What keeps another surface out of a batch with the first; NULL where nothing does. */
const char *surface_unlike(const batten_surface *first, const batten_surface *other);

/* The options given or the defaults, the light a unit vector. Errors: USAGE. */
batten_status surface_batch_options_check(batten_context *context,
                                          const batten_surface_batch_options *given,
                                          batten_surface_batch_options *chosen);

/* The number of samples along "u" or "v". Errors: USAGE. */
batten_status surface_samples_check(batten_context *context, const char *what, size_t count);

/* The basis at parameters of one direction; what ("u") stands for it in messages.
 * surface_samples_release() afterwards. Errors: USAGE (outside the range), MEMORY. */
batten_status surface_samples_at(batten_context *context, const char *what, size_t order,
                                 size_t poles, const double *knots, size_t count,
                                 const double *parameters, surface_samples *out);

/* The same at points Gauss points of every span that is not empty, with their weights, in `rows` rows
 * of derivatives (SURFACE_TABLE_ROWS). */
batten_status surface_samples_gauss(batten_context *context, size_t order, size_t rows,
                                    size_t poles, const double *knots, size_t points,
                                    surface_samples *out);
void surface_samples_release(batten_context *context, surface_samples *samples);

#endif
