/* The diverging colour map of curvature. */
#ifndef BATTEN_PICTURE_COLOUR_MAP_H
#define BATTEN_PICTURE_COLOUR_MAP_H

#include "core/context.h"

enum { PICTURE_COLOUR_COUNT = 257 }; /* odd: the middle entry is the neutral colour of 0 */

typedef struct picture_colour_map {
	float rgba[PICTURE_COLOUR_COUNT][4]; /* sRGB, 0..1; from -1 (blue) over 0 to 1 (red) */
} picture_colour_map;

void picture_colour_map_fill(picture_colour_map *map);

/* The colour of value, clamped to -1..1, by linear interpolation of the entries, as the shader
 * does. */
void picture_colour_map_look_up(const picture_colour_map *map, double value, double rgb[3]);

#endif
