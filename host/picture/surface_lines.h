/* The lines of a hull's surface as smooth curves through the points of the table: what the mesh is
 * spun between. For display only; nothing is measured on them. */
#ifndef BATTEN_PICTURE_SURFACE_LINES_H
#define BATTEN_PICTURE_SURFACE_LINES_H

#include "hull/hull.h"

/* A number at each node of the table, and whether there is one. [waterlines][stations] */
typedef struct picture_field {
	const double *value;
	const uint8_t *known; /* not 0: known */
} picture_field;

/* One waterline (or section). All arrays have count entries; slopes are derivatives along the
 * line. */
typedef struct surface_line {
	size_t count;
	double *along_m, *y_m, *slope;
	double *value, *value_slope; /* of the field; points without one take the nearest of the line */
	bool has_value;
	bool *open_after; /* no hull between this point and the next */
} surface_line;

typedef struct surface_lines {
	batten_context *context;
	const batten_hull *hull; /* borrowed */
	bool waterlines;         /* lines are waterlines (along x); else sections (along z) */
	size_t count;
	const double *across_m; /* z (or x) of the lines */
	surface_line *lines;
} surface_lines;

/* What a line is at one place. */
typedef struct line_sample {
	bool covered; /* the line has hull there; the rest is 0 where not */
	double y_m, slope;
	double value;
	double known; /* 1 or 0 */
} line_sample;

/* Lines are waterlines, sections where the hull's layout is long by stations. Errors: MEMORY. */
batten_status surface_lines_create(batten_context *context, const batten_hull *hull,
                                   const picture_field *field, surface_lines **out);
void surface_lines_destroy(surface_lines *lines);

/* No hull between points i and i + 1 of a line: nodes left empty there. In a long layout every line
 * lists its own points, so that nodes missing within it are no holes. */
bool picture_hole_after(const batten_hull *hull, const hull_line *points, size_t i);

line_sample surface_line_at(const surface_line *line, double along_m);

/* Slopes across line number k at a place it covers, from its neighbours there: y and field. */
void surface_slope_across(const surface_lines *lines, size_t k, double along_m, double *slope,
                          double *value_slope);

/* Value of the cubic over 0 <= t <= 1 with these ends; slopes are per unit of t. */
double picture_hermite(double from, double to, double from_slope, double to_slope, double t);
double picture_hermite_slope(double from, double to, double from_slope, double to_slope, double t);
/* Takes from the slopes of a cubic between two half-breadths what would carry it below 0. */
void picture_keep_positive(double from, double to, double *from_slope, double *to_slope);

#endif
