/* Triangles as a boundary that is integrated over, clipped at the waterline (Letcher 9.4). Plain
 * arrays in, no allocation. */
#ifndef BATTEN_HYDROSTATICS_MESH_H
#define BATTEN_HYDROSTATICS_MESH_H

#include "hydrostatics/hydrostatics.h"

#include <stdint.h>

/* An edge of one triangle only, as it runs in it. */
typedef struct mesh_edge {
	uint32_t from, to, triangle;
} mesh_edge;

typedef struct mesh_arrays {
	const double *vertices;    /* [vertices][3]: x, y, z */
	const uint32_t *triangles; /* [triangles][3], counter-clockwise seen from the water */
	size_t vertex_count, triangle_count;
	bool half;             /* y >= 0 only: everything counts twice */
	const mesh_edge *open; /* edges of one triangle, those in y = 0 left out where half */
	size_t open_count;
	double aftmost_m, foremost_m, lowest_m, highest_m;
} mesh_arrays;

/* Everything but sections. A transom is a loop of open edges in the plane of either end. */
void mesh_integrate(const mesh_arrays *mesh, double draft_m, hydrostatics *out);

/* Area of the section just aft of x below a draft, both sides. */
double mesh_section_area(const mesh_arrays *mesh, double x_m, double draft_m);

#endif
