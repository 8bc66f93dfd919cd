/* One section of a hull below its waterline: area, height of its centroid, girth. */
#ifndef BATTEN_HYDROSTATICS_SECTION_H
#define BATTEN_HYDROSTATICS_SECTION_H

#include "hull/hull.h"
#include "hydrostatics/curve.h"

/* Where each waterline of a hull begins and ends. NaN for a waterline without points. */
typedef struct section_ends {
	double aft_x_m, aft_y_m, fore_x_m, fore_y_m;
} section_ends;

/* Marks (enum curve_break, [count]) the knuckles of a line at and between so many places along it. */
void section_mark_knuckles(const batten_hull *hull, bool waterline, size_t line, size_t count,
                           const double *along_m, unsigned char *breaks);

/* What all sections of a hull are taken from: made once. */
typedef struct section_source {
	const batten_hull *hull;
	section_ends *ends; /* [waterlines] */
	double *slopes;     /* y_x at the nodes, [waterlines][stations]; NaN where there is none */
} section_source;
batten_status section_source_create(batten_context *context, const batten_hull *hull,
                                    section_source *out);
void section_source_destroy(section_source *source);

/* A section, all of it. From the last profile zero below its first positive half-breadth, or, where
 * the edge of the hull passes between two waterlines, from where it does (README.md). A section
 * without a positive half-breadth keeps all its points: it is the hull's edge itself. */
struct section {
	size_t point_count; /* 0: no section at this station */
	double x_m, lowest_m, highest_m;
	double flat_m; /* half-breadth of a flat bottom at lowest_m; 0 without one */
	curve shape;   /* y against z */
	curve slopes;  /* y_x against z */
};
batten_status section_create(const section_source *source, size_t station, struct section *out);
void section_destroy(struct section *section);

/* The part of a section below a height. Both sides. */
typedef struct section_immersed {
	bool wet, reaches;     /* begins below the draft; goes up to it */
	double area_m2;        /* 2 integral y dz */
	double moment_m3;      /* 2 integral y z dz */
	double girth_m;        /* 2 integral sqrt(1 + y_x^2 + y_z^2) dz, and the flat bottom */
	double half_breadth_m; /* at the draft, where the section reaches it */
} section_immersed;
batten_status section_immerse(const struct section *section, double draft_m, batten_quadrature rule,
                              section_immersed *out);

/* Points of the waterline at a height: every section that reaches it, and its ends between those of
 * the waterlines below and above, where they lie beyond the sections. NaN without points. */
section_ends section_ends_at(const section_source *source, double z_m);

#endif
