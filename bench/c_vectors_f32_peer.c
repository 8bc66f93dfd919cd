/* surface_grid.cl in f32, compiled as C. */
#define BATTEN_DOUBLE 0
#define OUT_DOUBLE 0
#define PRECISION(name) name##_f32
#include "c_vectors_body.h"
