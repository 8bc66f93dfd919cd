/* Parent -> variant: what the methods share. Every method is a function of a prepared parent and a
 * few numbers; it keeps no state. */
#ifndef BATTEN_VARIATION_VARIATION_H
#define BATTEN_VARIATION_VARIATION_H

#include "core/spline.h"
#include "hull/hull.h"
#include "hydrostatics/curve.h"
#include "variation/shift.h"

/* One waterline as the points a natural spline goes through. Empty cells read as 0 up to the ends of
 * the table, unless the line ends off the grid. */
typedef struct variation_line {
	size_t count;
	double *x_m, *y_m;        /* one allocation, x first */
	unsigned char *breaks;    /* enum curve_break: knuckles at and after each point */
	bool ends_aft, ends_fore; /* at a point off the grid: nothing is hull beyond */
	double middle_m;          /* half-breadth amidships */
} variation_line;

/* What the methods that move sections need of a parent, made once for all of its variants. */
typedef struct variation_parent {
	batten_context *context;
	const batten_hull *hull;
	batten_measures measures; /* upright hydrostatics; fairness NaN */
	variation_line *lines;    /* [waterlines] */
	struct spline areas;      /* section areas below the draft, over x; absent: .count == 0 */
	struct spline waterline;  /* half-breadths at the draft, over x */
	variation_span span;
} variation_parent;

/* Hydrostatics only; the methods that move sections need variation_parent_sections() too. Errors:
 * INPUT (draft outside the table), MEMORY. */
batten_status variation_parent_create(batten_context *context, const batten_hull *hull,
                                      variation_parent *out);
/* thesis: 21 stations, areas from six waterlines (thesis.c). Errors: INPUT (no section amidships,
 * points of sections off the grid, no thesis table), MEMORY. */
batten_status variation_parent_sections(variation_parent *parent, bool thesis);
void variation_parent_destroy(variation_parent *parent);

/* Lines and areas the thesis's way. Errors: INPUT, MEMORY. */
batten_status variation_thesis_sections(variation_parent *parent);

/* Room for count points. Errors: MEMORY. */
batten_status variation_line_create(batten_context *context, size_t count, variation_line *out);
void variation_line_destroy(batten_context *context, variation_line *line);
/* A waterline of a hull. Errors: MEMORY. */
batten_status variation_line_take(batten_context *context, const batten_hull *hull, size_t number,
                                  variation_line *out);
/* The natural spline through the two or more points of a line, broken at its knuckles. Errors: INPUT
 * (points do not ascend), MEMORY. */
batten_status variation_line_curve(batten_context *context, const variation_line *line, curve *out);

/* Upright hydrostatics of a hull at its draft; fairness NaN. Errors: INPUT, MEMORY. */
batten_status variation_measure(batten_context *context, const batten_hull *hull,
                                batten_measures *out);

/* The parent's name with what was done, and its source saying so. Errors: MEMORY. */
batten_status variation_mark_source(batten_hull *variant);

/* Moves every section of the parent and takes the waterlines at the stations again: y, nodes, line
 * ends, profile points and knuckles of variant, a clone of the parent. Errors: INPUT (folded),
 * MEMORY. */
batten_status variation_move_sections(const variation_parent *parent, const variation_shift *shift,
                                      batten_hull *variant);

/* Heights of the knuckles of variant's stations, a clone of the parent: the sections of the parent
 * stand at at_m[] now, those of the variant are the ones at wanted_m[] (both [stations]). Knuckles
 * of neighbouring stations are one chine, counted from the keel. Errors: INPUT, MEMORY. */
batten_status variation_carry_chines(const batten_hull *parent, const double *at_m,
                                     const double *wanted_m, batten_hull *variant);

/* Moor's method (thesis 2.3.4): new curves of areas and of load waterline are asked for, and each
 * station gets the parent's section from the place of the same half body where area and breadth are
 * in the proportion asked for. */
typedef struct variation_moor {
	batten_context *context;
	const variation_parent *parent;
	struct spline areas, waterline; /* asked for */
} variation_moor;
batten_status variation_moor_create(const variation_parent *parent,
                                    const variation_shift *area_shift,
                                    const variation_shift *waterline_shift, variation_moor *out);
void variation_moor_destroy(variation_moor *moor);
/* The place for a station; *found false: no place has the proportion, the nearest is given. */
double variation_moor_place(const variation_moor *moor, double x_m, bool *found);
/* Errors: INPUT, MEMORY. *unmatched gets the number of stations without a place. */
batten_status variation_moor_apply(const variation_moor *moor, batten_hull *variant,
                                   size_t *unmatched);

/* Half-breadths below this part of the half-beam are rounding, and 0. */
#define VARIATION_ZERO_PART 1e-12

/* Sets half-breadths (as batten_hull_y_m(), NaN: outside) and what each node is then: the zeros next
 * to a positive offset are the profile, unless the parent has its zeros otherwise. Fills '?' nodes
 * again. Errors: INPUT, MEMORY. */
batten_status variation_set_offsets(batten_hull *variant, const double *y_m);

/* Makes one pass of the method of the options with its parameters p in place of what was asked for;
 * parameters of the formulas and warnings go to outcome. *out belongs to the caller. */
batten_status variation_build(const variation_parent *parent, const batten_vary_options *options,
                              const double *p, batten_hull **out, batten_vary_outcome *outcome);

/* A map of space: where a place of the half hull goes. */
typedef struct variation_map {
	void (*move)(const void *user, const double place_m[3], double moved_m[3]);
	const void *user;
} variation_map;

/* A hull whose points are moved in space, on a table again (deform.c). LBP, draft and baseline stay.
 * Errors: INPUT (the map folds, line ends off the grid that it takes off their lines), MEMORY. */
batten_status variation_deform(batten_context *context, const batten_hull *parent,
                               const variation_map *map, batten_hull **out,
                               batten_vary_outcome *outcome);

/* The methods that need no sections. */
batten_status variation_nonlinear(batten_context *context, const batten_hull *parent,
                                  const batten_vary_options *options, batten_hull **out,
                                  batten_vary_outcome *outcome);
batten_status variation_free_form(batten_context *context, const batten_hull *parent,
                                  const batten_vary_options *options, batten_hull **out,
                                  batten_vary_outcome *outcome);
batten_status variation_average(batten_context *context, const batten_hull *parent,
                                const batten_vary_options *options, batten_hull **out,
                                batten_vary_outcome *outcome);
batten_status variation_affine(batten_context *context, const batten_hull *parent,
                               const batten_vary_options *options, batten_hull **out);
batten_status variation_stretch(batten_context *context, const batten_hull *parent,
                                const batten_vary_options *options, batten_hull **out);

/* x goes through the points, by a monotone spline or by straight lines; the aft perpendicular stays
 * the origin. Errors: INPUT, MEMORY. */
batten_status variation_stretch_along(batten_context *context, const batten_hull *parent,
                                      size_t count, const double *from_m, const double *to_m,
                                      bool straight, batten_hull **out);

/* INPUT where a variant is no table that batten_hull_create() would take. */
batten_status variation_check_size(const batten_hull *variant);

/* A parent made ready, for the thesis's procedure and for ours, each when first needed. */
typedef struct variation_family {
	batten_context *context;
	const batten_hull *parent;
	variation_parent ready[3];
	bool made[3];
} variation_family;
/* As batten_hull_vary(); outcome is expected. */
batten_status variation_family_vary(variation_family *family, const batten_vary_options *options,
                                    batten_hull **out, batten_vary_outcome *outcome);
void variation_family_destroy(variation_family *family);

/* Numbers within their ranges, and everything there that the method takes. Errors: USAGE. */
batten_status variation_check_options(batten_context *context, const batten_vary_options *options);

/* Warns of changes that are fractions where percent is meant, perhaps; only of numbers the method takes. */
void variation_warn_of_size(const batten_vary_options *options, batten_vary_outcome *outcome);

/* Measures asked for, and the iteration that meets them (iterate.c). Errors as
 * batten_hull_vary(). */
batten_status variation_iterate(const variation_parent *parent, const batten_vary_options *options,
                                batten_hull **out, batten_vary_outcome *outcome);

#endif
