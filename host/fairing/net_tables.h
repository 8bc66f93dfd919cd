/* Knots turned into the tables that searches over control nets work with. */
#ifndef BATTEN_FAIRING_NET_TABLES_H
#define BATTEN_FAIRING_NET_TABLES_H

#include "batch/net_plan.h"
#include "geometry/surface_batch.h"

/* The basis up to its third derivative at points Gauss points of every span that is not empty, with
 * their weights. net_tables_release() afterwards. Errors: MEMORY. */
batten_status net_tables_create(batten_context *context, size_t order, size_t poles,
                                const double *knots, size_t points, net_samples *out);
void net_tables_release(batten_context *context, net_samples *samples);

#endif
