/* batten surface --grid. */
#ifndef BATTEN_CLI_SURFACE_GRID_H
#define BATTEN_CLI_SURFACE_GRID_H

#include "batten.h"

/* count >= 2 parameters evenly over the range of a direction. */
void surface_grid_spread(const batten_surface *surface, batten_direction direction, size_t count,
                         double *at);

/* Writes everything that is known of the surface at u_count x v_count points, each 2 to 9999, evenly
 * spread over its parameters, a row a point, as a table (.csv or .json). Errors: those of
 * batten_surface_grid_batch() and batten_table_write(); MEMORY without a message. */
batten_status surface_grid_write(batten_context *context, const batten_surface *surface,
                                 size_t u_count, size_t v_count, const char *path);

#endif
