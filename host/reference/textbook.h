/* The textbook pattern search in plain C, one search at a time: kernels/shared/textbook.h, as the kernel
 * runs it. Arguments and layout are those of multilevel.h. */
#ifndef BATTEN_REFERENCE_TEXTBOOK_H
#define BATTEN_REFERENCE_TEXTBOOK_H

#include "reference/multilevel.h"

void reference_textbook_f64(const reference_multilevel *plan, const double *stencils,
                            double *arrays, const double *settings, double *outcome,
                            double *scratch);
void reference_textbook_f32(const reference_multilevel *plan, const float *stencils, float *arrays,
                            const float *settings, float *outcome, float *scratch);

#endif
