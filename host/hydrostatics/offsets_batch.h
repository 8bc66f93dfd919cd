/* Hydrostatics of batch after batch of hulls on one table, at the same drafts: what these alone give is worked
 * once. */
#ifndef BATTEN_HYDROSTATICS_OFFSETS_BATCH_H
#define BATTEN_HYDROSTATICS_OFFSETS_BATCH_H

#include "hull/hull.h"

typedef struct offsets_batch offsets_batch;

/* Borrows the table. Errors: USAGE, MEMORY. */
batten_status offsets_batch_create(batten_context *context, const batten_hull *table,
                                   const batten_hydrostatics_options *options,
                                   const batten_batch_options *batch, size_t draft_count,
                                   const double *drafts_m, offsets_batch **out);

/* batten_hull_hydrostatics_batch() of count hulls. */
batten_status offsets_batch_run(offsets_batch *batch, size_t count, const double *y_m,
                                const uint8_t *nodes, batten_hydrostatics *out, batten_run *run);

/* NULL is nothing. */
void offsets_batch_destroy(offsets_batch *batch);

#endif
