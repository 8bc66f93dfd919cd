#include "sweep/sampling.h"
#include "sweep/log_scale.h"
#include "sweep/random.h"

#include <string.h>

#define COUNT_MOST ((uint64_t)1 << 62)

batten_status sampling_prepare(batten_context *context, sweep_sampling *sampling)
{
	if (sampling->method != SAMPLING_SOBOL)
		return BATTEN_OK;
	sampling->directions = batten_allocate(context, sampling->parameter_count,
	                                       sizeof *sampling->directions);
	if (!sampling->directions)
		return BATTEN_MEMORY;
	for (size_t p = 0; p < sampling->parameter_count; p++)
		sobol_directions((unsigned)p, sampling->directions[p]);
	return BATTEN_OK;
}

void sampling_release(batten_context *context, sweep_sampling *sampling)
{
	for (size_t p = 0; sampling->parameters && p < sampling->parameter_count; p++)
		batten_release(context, sampling->parameters[p].levels);
	batten_release(context, sampling->parameters);
	batten_release(context, sampling->rows);
	batten_release(context, sampling->directions);
	memset(sampling, 0, sizeof *sampling);
}

bool sampling_grid_count(const sweep_sampling *sampling, uint64_t *count)
{
	uint64_t product = 1;
	for (size_t p = 0; p < sampling->parameter_count; p++) {
		const uint64_t levels = sampling->parameters[p].level_count;
		if (levels == 0 || product > COUNT_MOST / levels)
			return false;
		product *= levels;
	}
	*count = product;
	return true;
}

static double between(const sampling_parameter *parameter, double part)
{
	if (parameter->logarithmic)
		return log_scale_between(parameter->from, parameter->to, part);
	return part >= 1.0 ? parameter->to : parameter->from + part * (parameter->to - parameter->from);
}

static double level(const sampling_parameter *parameter, uint64_t number)
{
	if (parameter->levels)
		return parameter->levels[number];
	const uint64_t last = parameter->level_count - 1;
	return between(parameter, last > 0 ? (double)number / (double)last : 0.0);
}

/* A place in [0, 1) as a value: levels have equal shares of it. */
static double value_at(const sampling_parameter *parameter, double unit)
{
	if (parameter->level_count == 0)
		return between(parameter, unit);
	const uint64_t number = (uint64_t)(unit * (double)parameter->level_count);
	return level(parameter, number < parameter->level_count ? number : parameter->level_count - 1);
}

static void grid_values(const sweep_sampling *sampling, uint64_t i, double *values)
{
	for (size_t p = sampling->parameter_count; p-- > 0;) {
		const sampling_parameter *parameter = &sampling->parameters[p];
		values[p] = level(parameter, i % parameter->level_count);
		i /= parameter->level_count;
	}
}

static double unit_of(const sweep_sampling *sampling, uint64_t i, uint32_t dimension)
{
	if (sampling->method == SAMPLING_SOBOL) {
		uint32_t coordinate = sobol_coordinate(sampling->directions[dimension], (uint32_t)i);
		if (!sampling->scramble)
			return coordinate * 0x1p-32;
		coordinate = sobol_scramble(sampling->seed, dimension, coordinate);
		/* The bits beyond the 32nd are scrambled ones too; half of them are set on average. */
		return (coordinate + 0.5) * 0x1p-32;
	}
	const double random = sweep_random_unit(sampling->seed, i, dimension);
	if (sampling->method == SAMPLING_RANDOM)
		return random;
	const uint64_t stratum = sweep_permuted(sampling->seed, dimension, sampling->count, i);
	return ((double)stratum + random) / (double)sampling->count;
}

void sampling_values(const sweep_sampling *sampling, uint64_t i, double *values)
{
	const size_t count = sampling->parameter_count;
	if (sampling->method == SAMPLING_GRID) {
		grid_values(sampling, i, values);
	} else if (sampling->method == SAMPLING_ROWS) {
		memcpy(values, sampling->rows + i * count, count * sizeof *values);
	} else {
		for (size_t p = 0; p < count; p++)
			values[p] = value_at(&sampling->parameters[p], unit_of(sampling, i, (uint32_t)p));
	}
}
