/* A hull whose points are moved in space: what deform.c and deform_sections.c share. */
#ifndef BATTEN_VARIATION_DEFORM_H
#define BATTEN_VARIATION_DEFORM_H

#include "variation/variation.h"

/* A waterline after the move: points in space. */
struct moved_line {
	variation_line shape; /* x_m, y_m moved */
	double *z_m;
	size_t *place; /* station of each point, SIZE_MAX off the grid */
};

struct deformation {
	batten_context *context;
	const batten_hull *parent;
	const variation_map *map;
	batten_hull *variant;
	double near_x_m, near_z_m;
	bool stations_move, waterlines_move;
	struct moved_line *lines; /* [waterlines] */
	double *y_m, *z_m;        /* sections at the variant's stations, [waterlines][stations]; NaN */
	size_t crossed, cut_off;  /* points beyond the centreplane, sections beyond the table */
};

/* INPUT: the map folds the hull there. */
batten_status deformation_fail_fold(const struct deformation *work, double x_m, double z_m);

/* Whether a point of a waterline is one of the hull, not an empty cell that reads as 0. */
bool deformation_is_hull(const struct deformation *work, size_t waterline, size_t place);

/* Points of the sections at the variant's stations: y_m, z_m. Errors: INPUT, MEMORY. */
batten_status deformation_cut_lines(const struct deformation *work);

/* The half-breadths of the variant. Errors: INPUT, MEMORY. */
batten_status deformation_take_sections(struct deformation *work);

#endif
