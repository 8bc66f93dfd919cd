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
	batten_mesh *mesh;
	const char *name;
	double lowest_m, highest_m;   /* highest NaN: not known */
	double aftmost_m, foremost_m; /* not of a hull */
	/* several surfaces, all else without them */
	const char **paths;
	size_t path_count;
	int device;
} measure_job;

/* Whether a path has that ending, in small letters or capitals, with a name before it. */
bool measure_ends_in(const char *path, const char *ending);

/* Reads the hull, the surface or the mesh, and finds the drafts. Messages are printed. */
batten_status measure_open(measure_job *job, batten_context *context);
void measure_close(measure_job *job);

/* The name of the rule, as the report has it. */
const char *measure_rule(const measure_job *job);

batten_status measure_hydrostatics(const measure_job *job, batten_context *context, size_t count,
                                   const double *drafts_m, batten_hydrostatics *out);

/* Areas of sections up to heights, areas_m2 [height_count][count]; of a hull those of its stations. */
batten_status measure_sections(const measure_job *job, batten_context *context, size_t count,
                               const double *x_m, size_t height_count, const double *heights_m,
                               double *areas_m2);

/* The hydrostatics of several surfaces of one topology, a row a surface and draft. Returns INCOMPLETE
 * where some have none. */
batten_status measure_many(const measure_job *job, batten_context *context);

/* A table to standard output or to the file asked for. across: names down, rows across. */
batten_status measure_put_table(const measure_job *job, batten_context *context,
                                const batten_table *table, bool across);

/* Curves of form, Bonjean's curves, section area curves, or a table over the drafts: to standard output
 * or to the file asked for. */
batten_status measure_table(const measure_job *job, batten_context *context);

#endif
