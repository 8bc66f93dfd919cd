/* One hull as a block of the page: see report_hulls_write(). */
#ifndef BATTEN_REPORT_HULL_BLOCK_H
#define BATTEN_REPORT_HULL_BLOCK_H

#include "report/sweep.h"

#include <stdio.h>

/* before_y_m [waterlines][stations] may be NULL. name is the design's id, or "parent". *scale_per_m
 * gets the curvature scale that suits the hull. Errors: INPUT, IO, MEMORY. */
batten_status hull_block_write(const report_sweep *sweep, const batten_hull *hull,
                               const double *before_y_m, const char *name, FILE *stream,
                               double *scale_per_m);

#endif
