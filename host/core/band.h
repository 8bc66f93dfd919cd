/* Symmetric positive definite systems with a band. */
#ifndef BATTEN_CORE_BAND_H
#define BATTEN_CORE_BAND_H

#include <stddef.h>

/* The lower band lies in rows: a[row * (width + 1) + width] is the diagonal, width places before it the
 * others. Returns count, or the first row whose pivot is rounding or negative. */
size_t band_factor(size_t count, size_t width, double *a);
void band_solve(size_t count, size_t width, const double *factor, double *x);

#endif
