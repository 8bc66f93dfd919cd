/* The lines of hulls that are nothing but their grid, side by side: what of their fairness and inflections
 * depends on the table and its nodes alone, once for all hulls that share both. */
#ifndef BATTEN_FAIRING_GRID_LINES_H
#define BATTEN_FAIRING_GRID_LINES_H

#include "fairing/lines.h"

typedef struct grid_lines grid_lines;

/* Of a hull whose lines are of its grid; waterlines, else sections. *out NULL where it would not pay, for
 * very large tables and where empty cells break lines into many pieces: those are worked line by line.
 * Errors: MEMORY. */
batten_status grid_lines_create(batten_context *context, const batten_hull *hull, bool waterlines,
                                grid_lines **out);
void grid_lines_destroy(grid_lines *table);

/* What lines_of_hull() gives for a hull of the same table and nodes, by its half-breadths. Works in the
 * table's own memory: one thread at a time. */
lines_sum grid_lines_sum(grid_lines *table, const double *y_m);

#endif
