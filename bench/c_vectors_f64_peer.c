/* surface_grid.cl in f64, compiled as C. */
#define BATTEN_DOUBLE 1
#define OUT_DOUBLE 1
#define PRECISION(name) name##_f64
#include "c_vectors_body.h"
