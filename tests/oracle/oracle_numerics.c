/* Dense linear algebra and extrapolation of the oracle. */
#include "oracle_internal.h"

#include <math.h>
#include <stdlib.h>

long double *oracle_reals(size_t count)
{
	return calloc(count > 0 ? count : 1, sizeof(long double));
}

static size_t find_pivot(size_t n, const long double *matrix, size_t column)
{
	size_t best = column;
	for (size_t row = column + 1; row < n; row++)
		if (fabsl(matrix[row * n + column]) > fabsl(matrix[best * n + column]))
			best = row;
	return best;
}

static void swap_rows(size_t n, long double *matrix, long double *right, size_t a, size_t b)
{
	for (size_t column = 0; column < n; column++) {
		long double kept = matrix[a * n + column];
		matrix[a * n + column] = matrix[b * n + column];
		matrix[b * n + column] = kept;
	}
	long double kept = right[a];
	right[a] = right[b];
	right[b] = kept;
}

bool oracle_solve(size_t n, long double *matrix, long double *right)
{
	for (size_t k = 0; k < n; k++) {
		size_t pivot = find_pivot(n, matrix, k);
		if (!(fabsl(matrix[pivot * n + k]) > 0))
			return false;
		if (pivot != k)
			swap_rows(n, matrix, right, pivot, k);
		for (size_t row = k + 1; row < n; row++) {
			long double factor = matrix[row * n + k] / matrix[k * n + k];
			if (!(fabsl(factor) > 0))
				continue;
			for (size_t column = k; column < n; column++)
				matrix[row * n + column] -= factor * matrix[k * n + column];
			right[row] -= factor * right[k];
		}
	}
	for (size_t k = n; k-- > 0;) {
		for (size_t column = k + 1; column < n; column++)
			right[k] -= matrix[k * n + column] * right[column];
		right[k] /= matrix[k * n + k];
	}
	return true;
}

bool oracle_cholesky(size_t n, long double *matrix, size_t *first)
{
	for (size_t i = 0; i < n; i++) {
		long double *row = &matrix[i * n];
		first[i] = 0;
		while (first[i] < i && !(fabsl(row[first[i]]) > 0))
			first[i]++;
		for (size_t j = first[i]; j < i; j++) {
			const long double *other = &matrix[j * n];
			for (size_t k = first[i] > first[j] ? first[i] : first[j]; k < j; k++)
				row[j] -= row[k] * other[k];
			row[j] /= other[j];
		}
		long double before = row[i];
		for (size_t k = first[i]; k < i; k++)
			row[i] -= row[k] * row[k];
		/* A pivot that has lost all its digits says nothing about its sign. */
		if (!(row[i] > 1e-17L * fabsl(before)))
			return false;
		row[i] = sqrtl(row[i]);
	}
	return true;
}

void oracle_cholesky_solve(size_t n, const long double *factor, const size_t *first,
                           long double *right)
{
	for (size_t i = 0; i < n; i++) {
		for (size_t k = first[i]; k < i; k++)
			right[i] -= factor[i * n + k] * right[k];
		right[i] /= factor[i * n + i];
	}
	for (size_t i = n; i-- > 0;) {
		right[i] /= factor[i * n + i];
		for (size_t k = first[i]; k < i; k++)
			right[k] -= factor[i * n + k] * right[i];
	}
}

long double oracle_extrapolate(long double column[ORACLE_LEVELS])
{
	long double power = 1;
	for (int order = 1; order < ORACLE_LEVELS; order++) {
		power *= 4;
		for (int k = ORACLE_LEVELS - 1; k >= order; k--)
			column[k] += (column[k] - column[k - 1]) / (power - 1);
	}
	return column[ORACLE_LEVELS - 1];
}
