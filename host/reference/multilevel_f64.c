#include "reference/multilevel.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define BATTEN_DOUBLE 1
#define MULTILEVEL_FUNCTION reference_multilevel_f64
#define GRID_FAIRNESS (s->fairness)
#define GRID_PENALTY (s->penalised)
#include "reference/multilevel_body.h"
