/* One half of a hull as triangles between smooth lines through its table. */
#ifndef BATTEN_PICTURE_MESH_H
#define BATTEN_PICTURE_MESH_H

#include "picture/surface_lines.h"

/* As the vertex shader reads it. */
typedef struct picture_vertex {
	float position[3]; /* m, port side */
	float normal[3];   /* outward, of length 1 */
	float value;       /* of the field */
	float known;       /* 1: coloured by value, 0: grey */
	float grid[2];     /* station and waterline number, whole on the lines of the table */
} picture_vertex;

typedef struct picture_mesh {
	batten_context *context;
	size_t vertex_count, index_count;
	picture_vertex *vertices;
	uint32_t *indices;      /* three a triangle, clockwise seen from the water */
	double low[3], high[3]; /* box of the half hull */
} picture_mesh;

/* Errors: MEMORY, INPUT (no two neighbouring lines share a place: there is no surface). */
batten_status picture_mesh_create(batten_context *context, const batten_hull *hull,
                                  const picture_field *field, picture_mesh **out);
void picture_mesh_destroy(picture_mesh *mesh);

#endif
