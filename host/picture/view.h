/* Where the hull is seen from. */
#ifndef BATTEN_PICTURE_VIEW_H
#define BATTEN_PICTURE_VIEW_H

#include "picture/renderer.h"

/* Pixels of the picture. */
typedef struct picture_rectangle {
	double left, top, width, height;
} picture_rectangle;

/* A side view drawn to scale: where its hull lies in the picture. */
typedef struct profile_scale {
	double pixels_per_m;  /* lengthwise */
	double exaggeration;  /* heights are drawn this many times larger */
	double x_left, z_top; /* pixels of x = 0 and z = 0 */
} profile_scale;

/* Whole exaggeration of heights, 1 to 4, with which a slender hull fills the rectangle best. */
profile_scale picture_profile_fit(const picture_mesh *mesh, const picture_rectangle *rectangle);

/* From starboard, bow to the right, without perspective. */
picture_view picture_profile_view(const picture_mesh *mesh, const picture_rectangle *rectangle,
                                  const profile_scale *scale);

/* With perspective, as large as fits: azimuth from right ahead to starboard, elevation above the
 * horizon, in degrees. */
picture_view picture_perspective_view(const picture_mesh *mesh, const picture_rectangle *rectangle,
                                      double azimuth, double elevation);

#endif
