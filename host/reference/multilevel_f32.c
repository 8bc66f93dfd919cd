#include "reference/multilevel.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define BATTEN_DOUBLE 0
#define MULTILEVEL_FUNCTION reference_multilevel_f32
#define GRID_FAIRNESS (s->fairness)
#define GRID_PENALTY (s->penalised)
#include "reference/multilevel_body.h"
