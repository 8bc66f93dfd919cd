/* The hulls whose geometry goes into the page. */
#ifndef BATTEN_REPORT_HULLS_H
#define BATTEN_REPORT_HULLS_H

#include "report/sweep.h"

#include <stdio.h>

/* Which of the kept geometries: the plan's best ones. */
typedef struct report_choice {
	char *ids; /* a query for their ids, SQLite's memory */
	size_t most;
} report_choice;

/* most 0 takes the plan's number, 1000 where it names none. Errors: INPUT, MEMORY. */
batten_status report_choice_make(const report_sweep *sweep, size_t most, report_choice *out);
void report_choice_release(report_choice *choice);

typedef struct report_hulls {
	size_t count;
	double scale_per_m; /* of the curvature colours: what suits half of the hulls */
} report_hulls;

/* Writes one block "batten-hull-ID" a hull, and "batten-hull-parent": a JSON object with numbers, and
 * arrays [waterlines][stations] as base64: y_m (f32, NaN outside the hull), mean curvature (i16,
 * 32767 of curvature_limit_per_m, convex positive, -32768 where there is none), before_m (i16 likewise:
 * before fairing less y_m). Errors: INPUT (naming the design), IO, MEMORY. */
batten_status report_hulls_write(const report_sweep *sweep, const report_choice *choice,
                                 FILE *stream, report_hulls *out);

/* The quantities of a hull's rows of "hydrostatics", in their order; NULL beyond. */
const char *report_hydrostatics_name(size_t i);

#endif
