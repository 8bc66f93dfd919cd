#include "geometry/bspline_refine.h"

#include <math.h>
#include <string.h>

batten_status bspline_poles_check(batten_context *context, size_t count, size_t dimension,
                                  const double *poles, const double *weights)
{
	for (size_t i = 0; i < count * dimension; i++)
		if (!(fabs(poles[i]) <= BSPLINE_POLE_LARGEST))
			return batten_fail(context, BATTEN_USAGE,
			                   "coordinate %zu of pole %zu is not finite or beyond %g",
			                   i % dimension + 1, i / dimension + 1, BSPLINE_POLE_LARGEST);
	for (size_t i = 0; i < count && weights; i++)
		if (!(weights[i] >= BSPLINE_WEIGHT_SMALLEST && weights[i] <= BSPLINE_WEIGHT_LARGEST))
			return batten_fail(context, BATTEN_USAGE, "weight %zu: found %g, expected %g..%g",
			                   i + 1, weights[i], BSPLINE_WEIGHT_SMALLEST, BSPLINE_WEIGHT_LARGEST);
	return BATTEN_OK;
}

size_t bspline_homogeneous_width(size_t dimension, const double *weights)
{
	return weights ? dimension + 1 : dimension;
}

void bspline_to_homogeneous(size_t count, size_t dimension, const double *poles,
                            const double *weights, double *to)
{
	if (!weights) {
		memcpy(to, poles, count * dimension * sizeof *to);
		return;
	}
	for (size_t i = 0; i < count; i++) {
		for (size_t j = 0; j < dimension; j++)
			*to++ = weights[i] * poles[i * dimension + j];
		*to++ = weights[i];
	}
}

void bspline_from_homogeneous(size_t count, size_t dimension, const double *from, double *poles,
                              double *weights)
{
	if (!weights) {
		memcpy(poles, from, count * dimension * sizeof *poles);
		return;
	}
	for (size_t i = 0; i < count; i++, from += dimension + 1) {
		weights[i] = from[dimension];
		for (size_t j = 0; j < dimension; j++)
			poles[i * dimension + j] = from[j] / weights[i];
	}
}

void bspline_rows_reverse(size_t count, size_t width, double *rows)
{
	for (size_t i = 0; i < count / 2; i++) {
		for (size_t j = 0; j < width; j++) {
			double number = rows[i * width + j];
			rows[i * width + j] = rows[(count - 1 - i) * width + j];
			rows[(count - 1 - i) * width + j] = number;
		}
	}
}

static void map_pole(size_t dimension, const double *matrix, const double *shift,
                     const double *pole, double *to)
{
	for (size_t row = 0; row < dimension; row++) {
		double sum = shift[row];
		for (size_t column = 0; column < dimension; column++)
			sum += matrix[row * dimension + column] * pole[column];
		to[row] = sum;
	}
}

batten_status bspline_poles_map(batten_context *context, size_t count, size_t dimension,
                                const double *matrix, const double *shift, double *poles)
{
	double mapped[3];
	for (size_t i = 0; i < count; i++) {
		map_pole(dimension, matrix, shift, poles + i * dimension, mapped);
		for (size_t j = 0; j < dimension; j++)
			if (!(fabs(mapped[j]) <= BSPLINE_POLE_LARGEST))
				return batten_fail(context, BATTEN_USAGE,
				                   "the map takes pole %zu out of the finite or beyond %g", i + 1,
				                   BSPLINE_POLE_LARGEST);
	}
	for (size_t i = 0; i < count; i++) {
		map_pole(dimension, matrix, shift, poles + i * dimension, mapped);
		memcpy(poles + i * dimension, mapped, dimension * sizeof *poles);
	}
	return BATTEN_OK;
}
