/* Gauss and Legendre's quadrature. */
#ifndef BATTEN_CORE_GAUSS_H
#define BATTEN_CORE_GAUSS_H

#include <stddef.h>

enum { GAUSS_POINTS_MOST = 16 };

/* Nodes, ascending, and weights over -1..1 of 1..GAUSS_POINTS_MOST points: exact for polynomials of
 * degree 2 count - 1. */
void gauss_points(size_t count, double *nodes, double *weights);

#endif
