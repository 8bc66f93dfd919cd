/* Tables of a parent for batches of its variants (shared/variants_layout.h). */
#ifndef BATTEN_VARIATION_MEASURE_H
#define BATTEN_VARIATION_MEASURE_H

#include "batch/variants_plan.h"
#include "variation/variation.h"

/* Whether the kernel knows the method and can take variants of this parent. */
bool variation_tables_fit(const batten_hull *parent, const batten_vary_options *options);

/* Fills what depends on parent and method, beside what hydrostatics fills; the plan may get lists.
 * Errors: INPUT (nothing left to move), MEMORY. */
batten_status variation_tables_fill(const variation_parent *parent,
                                    const batten_vary_options *options, variants_plan *plan);

#endif
