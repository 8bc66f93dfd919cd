/* The noise of hulls that are nothing but their grid, all nodes known: lines side by side, what depends on
 * the table alone once for all hulls on it. */
#ifndef BATTEN_FAIRING_GRID_NOISE_H
#define BATTEN_FAIRING_GRID_NOISE_H

#include "hull/hull.h"

enum { NOISE_LEAST_ORDER = 4, NOISE_MOST_ORDER = 8, NOISE_LEAST_SAMPLES = 16 };

/* Median of magnitude of a normal variate of standard deviation 1. */
#define NOISE_NORMAL_MEDIAN 0.6744897501960817

/* Weights of the order-th divided difference of order + 1 points, divided by the root of the sum of their
 * squares. */
void noise_weights(size_t order, const double *along_m, double *weights);

typedef struct grid_noise grid_noise;

bool grid_noise_fits(const batten_hull *hull);

/* For hulls on this one's table. Errors: MEMORY. */
batten_status grid_noise_create(batten_context *context, const batten_hull *hull, grid_noise **out);
void grid_noise_destroy(grid_noise *noise);

/* The scales of noise.h along waterlines and along sections, infinite where there are too few differences.
 * Works in the memory of noise: one thread at a time. */
void grid_noise_scales(grid_noise *noise, const double *y_m, double along[2]);

#endif
