/* What the hydrostatics of many hulls on one table share: weights of sections, rows of splines, Gauss
 * points, as the kernel wants them (shared/variants_layout.h), and what it finds made quantities. */
#ifndef BATTEN_HYDROSTATICS_OFFSETS_TABLES_H
#define BATTEN_HYDROSTATICS_OFFSETS_TABLES_H

#include "batch/variants_plan.h"
#include "hydrostatics/quantities.h"

/* Whether the kernel can take hulls on this table: no knuckles, points off the grid only beyond the ends
 * of waterlines, not too large; the default rule. Others go one by one. */
bool offsets_tables_fit(const batten_hull *hull, batten_quadrature rule, size_t draft_count);

/* Fills what depends on table and drafts; the plan is of that size. target_m is the draft of the
 * targets, NAN where there are none. Errors: MEMORY. */
batten_status offsets_tables_fill(const batten_hull *hull, const double *drafts_m, double target_m,
                                  variants_plan *plan);

/* The row's outcome (variants_plan_outcome() numbers) as quantities at the drafts. */
void offsets_tables_take(const batten_hull *hull, const batten_hydrostatics_options *options,
                         size_t draft_count, const double *drafts_m, const double *outcome,
                         batten_hydrostatics *out);

#endif
