/* Where a sweep puts its designs: number of the design in, values of the parameters out. The values of
 * design i depend on the plan, its seed and i alone. */
#ifndef BATTEN_SWEEP_SAMPLING_H
#define BATTEN_SWEEP_SAMPLING_H

#include "core/context.h"
#include "sweep/sobol.h"

enum {
	SAMPLING_PARAMETERS_MOST = SOBOL_DIMENSIONS,
	SAMPLING_NAME_MOST = 63, /* bytes of a parameter's name */
};

/* One swept parameter: a range, evenly spaced levels of it, or a list. */
typedef struct sampling_parameter {
	char name[SAMPLING_NAME_MOST + 1];
	double from, to;
	bool logarithmic;
	uint64_t level_count; /* 0: any value of the range */
	double *levels;       /* the list, or NULL: levels evenly spaced over the range, both ends in */
} sampling_parameter;

typedef enum sampling_method {
	SAMPLING_GRID,   /* every combination of levels, the last parameter fastest */
	SAMPLING_LATIN,  /* Latin hypercube, one point in each of count strata of every parameter */
	SAMPLING_SOBOL,  /* Joe and Kuo's numbers, Owen's scrambling */
	SAMPLING_RANDOM, /* independent and uniform */
	SAMPLING_ROWS,   /* values given one by one */
} sampling_method;

typedef struct sweep_sampling {
	sampling_method method;
	bool scramble; /* of SOBOL */
	uint64_t seed, count;
	size_t parameter_count;
	sampling_parameter *parameters;     /* [parameter_count] */
	double *rows;                       /* ROWS: [count][parameter_count] */
	uint32_t (*directions)[SOBOL_BITS]; /* SOBOL: [parameter_count] */
} sweep_sampling;

/* Makes the tables that the method needs, once all else is set. Errors: MEMORY. */
batten_status sampling_prepare(batten_context *context, sweep_sampling *sampling);
void sampling_release(batten_context *context, sweep_sampling *sampling);

/* How many designs a grid of these parameters has; false when it is beyond 2^62 or one has no levels. */
bool sampling_grid_count(const sweep_sampling *sampling, uint64_t *count);

/* Values of design i < count, [parameter_count]. */
void sampling_values(const sweep_sampling *sampling, uint64_t i, double *values);

#endif
