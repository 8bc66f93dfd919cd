#include "reference/multilevel.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define BATTEN_DOUBLE 1
#define MULTILEVEL_FUNCTION reference_multilevel_bending_f64
#define GRID_FAIRNESS GRID_BENDING
#define GRID_PENALTY 0
#include "reference/multilevel_body.h"
