/* Draws meshes off screen by Vulkan. One renderer (instance, device, pipeline) serves any number of
 * pictures of any size. */
#ifndef BATTEN_PICTURE_RENDERER_H
#define BATTEN_PICTURE_RENDERER_H

#include "picture/colour_map.h"
#include "picture/mesh.h"

typedef struct picture_renderer picture_renderer;

/* A rectangle of the picture and what is seen in it. */
typedef struct picture_view {
	uint32_t left, top, width, height; /* pixels */
	float clip_from_hull[16];          /* column by column; Vulkan's clip space */
	float light[3];                    /* direction to the light, of length 1 */
} picture_view;

typedef struct picture_scene {
	uint32_t width, height;
	const picture_mesh *mesh; /* drawn twice in each view: as it is and mirrored in y = 0 */
	const picture_view *views;
	size_t view_count;
	const picture_colour_map *colours;
	double scale_per_m; /* field value at the ends of the colours, > 0 */
	float background[3];
	float line_width_px, line_strength; /* lines along stations and waterlines */
	float shading;                      /* part of the light that the shading may take away */
} picture_scene;

/* Errors: as vulkan_device_open(), DEVICE, MEMORY. */
batten_status picture_renderer_create(batten_context *context, picture_renderer **out);
/* rgba: width * height * 4 bytes, first row on top. The same scene gives the same bytes on one
 * driver. Errors: DEVICE, MEMORY, INTERNAL (the validation layer complained). */
batten_status picture_renderer_draw(picture_renderer *renderer, const picture_scene *scene,
                                    uint8_t *rgba);
/* What draws; valid as long as the renderer. */
const char *picture_renderer_name(const picture_renderer *renderer);
void picture_renderer_destroy(picture_renderer *renderer);

#endif
