/* batten surface --contours. */
#ifndef BATTEN_CLI_SURFACE_CONTOURS_H
#define BATTEN_CLI_SURFACE_CONTOURS_H

#include "batten.h"

/* Most levels of a request. */
enum { CONTOURS_MOST = 1000 };

/* A value of the surface and where it is cut. */
typedef struct contour_level {
	batten_surface_value value;
	double level;
} contour_level;

/* "x=8,z=0.5,gauss=0": names of BATTEN_SURFACE_VALUE_LIST and finite levels; levels has CONTOURS_MOST
 * entries. False for anything else. */
bool surface_contours_read(const char *text, contour_level *levels, size_t *count);

/* Writes the lines of the surface at these levels, a row a point, as a table (.csv or .json), found over a
 * mesh of u_count x v_count parameters. Errors: those of batten_surface_contour() and
 * batten_table_write(); MEMORY without a message. */
batten_status surface_contours_write(batten_context *context, const batten_surface *surface,
                                     size_t u_count, size_t v_count, const contour_level *levels,
                                     size_t count, const char *path);

#endif
