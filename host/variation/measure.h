/* Many variants of a parent made and measured: what the device and the host share, and tables of a
 * parent for the device (shared/variants_layout.h). */
#ifndef BATTEN_VARIATION_MEASURE_H
#define BATTEN_VARIATION_MEASURE_H

#include "batch/variants_plan.h"
#include "variation/variation.h"

/* A batch and what it stands on. */
typedef struct measure_task {
	batten_context *context;
	const batten_hull *parent;
	batten_vary_options options; /* what rows of numbers have in common; of the device, all rows */
	batten_hydrostatics_options hydrostatics;
	batten_batch_options batch;
	const batten_variants *v;
	size_t nodes, draft_count; /* drafts of a variant: the variants' own without a list */
} measure_task;

/* All that is asked of a row. */
batten_vary_options measure_row_options(const measure_task *task, size_t which);

/* The place of the quantities of a row; NULL where they are not asked for. */
batten_hydrostatics *measure_forms_of(const measure_task *task, size_t which);

/* A row without a variant: its numbers NaN, its nodes OUTSIDE. The reason is the caller's to write. */
void measure_leave_empty(const measure_task *task, size_t which, batten_status status);

/* Rows which[0..count) varied and measured by the threads of the context, everything of them written.
 * Failing rows are no error. Errors: MEMORY. */
batten_status measure_on_host(const measure_task *task, size_t count, const size_t *which);

/* Whether the kernel knows the method and can take variants of this parent. */
bool variation_tables_fit(const batten_hull *parent, const batten_vary_options *options);

/* Fills what depends on parent and method, beside what hydrostatics fills; the plan may get lists.
 * Errors: INPUT (nothing left to move), MEMORY. */
batten_status variation_tables_fill(const variation_parent *parent,
                                    const batten_vary_options *options, variants_plan *plan);

/* Of rows that the plan's device found out of reach: which parts of what they ask for, towards the parent's
 * other side and towards what is asked, still give variants; parts [count][2] <= 0 and >= 0, NaN where the
 * parent itself gives none. asked [count][VARIANTS_ASK_COUNT]. The plan's rows and results are replaced.
 * Errors: those of a batch. */
batten_status measure_reach(variants_plan *plan, size_t count, const double *asked, double *parts);

#endif
