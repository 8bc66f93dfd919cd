/* The multilevel pattern search in plain C, one search at a time: the twin of kernels/multilevel.cl,
 * equal to it bit for bit. Arguments and layout are the kernel's (shared/search_layout.h), with one
 * lane. */
#ifndef BATTEN_REFERENCE_MULTILEVEL_H
#define BATTEN_REFERENCE_MULTILEVEL_H

#include <stddef.h>
#include <stdint.h>

typedef struct reference_multilevel {
	int stations, waterlines, level_count, iteration_limit;
	int fairness;          /* GRID_BENDING ... */
	int penalised;         /* whether the objective has an interior penalty */
	const int32_t *levels; /* SEARCH_LEVEL_SIZE each */
	const int32_t *centres;
} reference_multilevel;

/* scratch has room for SEARCH_STATE_NUMBERS of one work-item. */
void reference_multilevel_f64(const reference_multilevel *plan, const double *stencils,
                              double *arrays, const double *settings, double *outcome,
                              double *scratch);
void reference_multilevel_f32(const reference_multilevel *plan, const float *stencils,
                              float *arrays, const float *settings, float *outcome, float *scratch);
/* The same for GRID_BENDING without a penalty, faster. */
void reference_multilevel_bending_f64(const reference_multilevel *plan, const double *stencils,
                                      double *arrays, const double *settings, double *outcome,
                                      double *scratch);
void reference_multilevel_bending_f32(const reference_multilevel *plan, const float *stencils,
                                      float *arrays, const float *settings, float *outcome,
                                      float *scratch);

#endif
