/* A batch of hulls made ready for fairing passes: the program that all share and the half-breadths of
 * each. Whoever knows hulls and splines writes the program; here it is only numbers. */
#ifndef BATTEN_BATCH_PASS_PLAN_H
#define BATTEN_BATCH_PASS_PLAN_H

#include "core/context.h"
#include "shared/pass_layout.h"

/* The numbers of kernels/shared/pass_layout.h, in doubles; owned by their maker. */
typedef struct pass_program_numbers {
	int32_t shape[PASS_SHAPE_SIZE]; /* iterations are the plan's */
	size_t row_count, term_count, line_count, point_count;
	int32_t *operations, *row_first, *row_target, *term_index, *line_first, *point_from, *point_to;
	double *term_factor, *point_along;
	double *constants;
} pass_program_numbers;

typedef struct pass_plan {
	batten_context *context;
	const pass_program_numbers *program;
	unsigned iterations;
	int device;
	batten_precision precision;
	unsigned lanes, work_group; /* 0 chooses */
	size_t count;
	const double *y_m; /* [count][values] */
	double *out_m;     /* the same, another piece of memory */
	int32_t *refused;  /* [count], 0 before: 1 where a hull has a number that is no length */
} pass_plan;

/* Lanes and work-items in the ranges of the public options. Errors: USAGE. */
batten_status pass_plan_check(const pass_plan *plan);

size_t pass_plan_values(const pass_plan *plan);

/* Reals of a hull's state where work_items share it, those beside it included. */
size_t pass_plan_state(const pass_plan *plan, size_t work_items);

/* Terms of rows, x of points and constants in the precision of the plan; released by
 * pass_tables_release(). */
typedef struct pass_tables {
	int32_t shape[PASS_SHAPE_SIZE];
	void *term_factor, *point_along, *constants;
} pass_tables;
batten_status pass_tables_create(const pass_plan *plan, pass_tables *out);
void pass_tables_release(const pass_plan *plan, pass_tables *tables);

#endif
