/* Gauss and Legendre's quadrature. */
#ifndef BATTEN_GEOMETRY_GAUSS_H
#define BATTEN_GEOMETRY_GAUSS_H

#include <stddef.h>

enum { GAUSS_POINTS_MOST = 16 };

/* Nodes, ascending, and weights of count <= GAUSS_POINTS_MOST points over -1..1. */
void gauss_points(size_t count, double *nodes, double *weights);

#endif
