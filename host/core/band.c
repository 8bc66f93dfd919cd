/* Cholesky factor of a banded matrix, in one fixed order whatever the machine. */
#include "core/band.h"

#include <math.h>

/* Pivots below this part of the diagonal have lost all but a few digits. */
static const double least_pivot = 1e-11;

size_t band_factor(size_t count, size_t width, double *a)
{
	const size_t stride = width + 1;
	for (size_t row = 0; row < count; row++) {
		const size_t first = row > width ? row - width : 0;
		double *this_row = a + row * stride + width - row; /* this_row[column] */
		for (size_t column = first; column <= row; column++) {
			const double *other = a + column * stride + width - column;
			const size_t other_first = column > width ? column - width : 0;
			double sum = this_row[column];
			for (size_t k = first > other_first ? first : other_first; k < column; k++)
				sum -= this_row[k] * other[k];
			if (column < row)
				this_row[column] = sum / other[column];
			else if (sum > least_pivot * this_row[row] && isfinite(sum))
				this_row[row] = sqrt(sum);
			else
				return row;
		}
	}
	return count;
}

void band_solve(size_t count, size_t width, const double *factor, double *x)
{
	const size_t stride = width + 1;
	for (size_t row = 0; row < count; row++) {
		const double *this_row = factor + row * stride + width - row;
		double sum = x[row];
		for (size_t k = row > width ? row - width : 0; k < row; k++)
			sum -= this_row[k] * x[k];
		x[row] = sum / this_row[row];
	}
	for (size_t row = count; row-- > 0;) {
		const double *this_row = factor + row * stride + width - row;
		x[row] /= this_row[row];
		for (size_t k = row > width ? row - width : 0; k < row; k++)
			x[k] -= this_row[k] * x[row];
	}
}
