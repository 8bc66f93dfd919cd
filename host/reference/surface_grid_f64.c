/* The plain C path of kernels/surface_grid.cl in f64. */
#include "reference/surface_grid.h"

#define BATTEN_DOUBLE 1
#define SURFACE_GRID_FUNCTION reference_surface_grid_f64
#include "reference/surface_grid_body.h"
