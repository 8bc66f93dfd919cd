/* What `batten measure` is asked for, and of what. */
#ifndef BATTEN_CLI_MEASURE_JOB_H
#define BATTEN_CLI_MEASURE_JOB_H

#include "cli.h"

enum { MEASURE_DRAFTS_MOST = 64 };

typedef struct measure_job {
	cli_common common;
	const char *path, *quadrature, *drafts_text, *out;
	double displacement_t; /* NaN: not given */
	unsigned curves_of_form, bonjean;
	bool section_areas;
	batten_hydrostatics_options options;
	size_t draft_count; /* 0: the hull's own */
	double drafts_m[MEASURE_DRAFTS_MOST];
	/* one of them: */
	batten_hull *hull;
	batten_surface *surface;
	const char *name;
	double lowest_m, highest_m; /* highest NaN: not known */
} measure_job;

/* Reads the hull or the surface, and finds the drafts. Messages are printed. */
batten_status measure_open(measure_job *job, batten_context *context);
void measure_close(measure_job *job);

/* The name of the rule, as the report has it. */
const char *measure_rule(const measure_job *job);

batten_status measure_hydrostatics(const measure_job *job, batten_context *context, size_t count,
                                   const double *drafts_m, batten_hydrostatics *out);

/* Curves of form, Bonjean's curves, section area curves, or a table over the drafts: to standard output
 * or to the file asked for. */
batten_status measure_table(const measure_job *job, batten_context *context);

#endif
