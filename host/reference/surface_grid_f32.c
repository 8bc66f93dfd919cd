/* The plain C path of kernels/surface_grid.cl in f32. */
#include "reference/surface_grid.h"

#define BATTEN_DOUBLE 0
#define SURFACE_GRID_FUNCTION reference_surface_grid_f32
#include "reference/surface_grid_body.h"
