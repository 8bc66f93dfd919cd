/* The plain C path of kernels/surface_grid.cl: one surface after another, the same bits. */
#ifndef BATTEN_REFERENCE_SURFACE_GRID_H
#define BATTEN_REFERENCE_SURFACE_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What the surfaces of a batch share; the meaning of each is the kernel's. */
typedef struct reference_surface_grid {
	int output; /* SURFACE_OUTPUT_... */
	int order_u, order_v, rational;
	int lines, segments, segment_length, columns, column_length;
	const int32_t *first_v, *first_u;
	double light[3]; /* rounded to the precision */
} reference_surface_grid;

/* scratch: 16 numbers a column of the net. */
void reference_surface_grid_f64(const reference_surface_grid *shared, const double *table_v,
                                const double *table_u, const double *net, double least_area,
                                double *out, double *scratch);
void reference_surface_grid_f32(const reference_surface_grid *shared, const float *table_v,
                                const float *table_u, const float *net, float least_area,
                                float *out, float *scratch);

#endif
