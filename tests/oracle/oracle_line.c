/* Lines of the oracle: second differences from the parabola through three points, and cubic splines
 * from all 4 (n - 1) coefficients of their cubics at once. */
#include "oracle_internal.h"

#include <math.h>
#include <stdlib.h>

bool oracle_line_second_differences(size_t count, const double *along, const double *value,
                                    long double *out)
{
	for (size_t i = 0; i < count; i++) {
		out[i] = 0;
		if (i == 0 || i + 1 == count)
			continue;
		long double matrix[9], right[3];
		for (size_t k = 0; k < 3; k++) {
			long double at = (long double)along[i + k - 1] - along[i];
			matrix[k * 3] = 1;
			matrix[k * 3 + 1] = at;
			matrix[k * 3 + 2] = at * at;
			right[k] = value[i + k - 1];
		}
		if (!oracle_solve(3, matrix, right))
			return false;
		out[i] = 2 * right[2];
	}
	return true;
}

long double oracle_line_fairness(size_t count, const double *along, const double *value)
{
	long double *second = oracle_reals(count);
	long double sum = 0;
	if (!second || !oracle_line_second_differences(count, along, value, second))
		sum = nanl("");
	for (size_t i = 0; second && i < count; i++)
		sum += second[i] * second[i];
	free(second);
	return sum;
}

/* Adds the derivative of the given order at u = 0 or 1 of cubic `piece`, whose coefficients belong
 * to the powers of u = (at - along[piece]) / length, times a factor, to a row of equations. */
static void add_derivative(long double *row, size_t piece, int order, int end, long double length,
                           long double factor)
{
	for (int power = order; power < 4; power++) {
		long double coefficient = factor;
		for (int k = 0; k < order; k++)
			coefficient *= (long double)(power - k) / length;
		if (power == order || end == 1)
			row[piece * 4 + (size_t)power] += coefficient;
	}
}

/* One of the two conditions left open by points, slopes and second derivatives. */
static void add_end(long double *row, long double *right, const double *along, size_t pieces,
                    bool is_last, oracle_condition condition)
{
	size_t piece = is_last ? pieces - 1 : 0;
	long double length = (long double)along[piece + 1] - along[piece];
	if (condition.end != ORACLE_JOINED) {
		*right = condition.end == ORACLE_FREE ? 0 : condition.value;
		add_derivative(row, piece, condition.end == ORACLE_SLOPE ? 1 : 2, is_last, length, 1);
	} else if (pieces == 1) {
		add_derivative(row, piece, 3, 0, length, 1);
	} else {
		size_t before = is_last ? pieces - 2 : 0;
		add_derivative(row, before, 3, 1, (long double)along[before + 1] - along[before], 1);
		add_derivative(row, before + 1, 3, 0, (long double)along[before + 2] - along[before + 1],
		               -1);
	}
}

static void add_ends(long double *matrix, long double *right, size_t unknowns, size_t row,
                     const double *along, size_t pieces, const oracle_condition ends[2])
{
	const oracle_condition free_end = { ORACLE_FREE, 0 };
	bool joined = ends[0].end == ORACLE_JOINED && ends[1].end == ORACLE_JOINED;
	for (size_t e = 0; e < 2; e++) {
		long double *here = &matrix[(row + e) * unknowns];
		if (joined && pieces == 2) /* both conditions are one: let the cubics be parabolas */
			add_derivative(here, e, 3, 0, (long double)along[e + 1] - along[e], 1);
		else
			add_end(here, &right[row + e], along, pieces, e == 1,
			        joined && pieces == 1 ? free_end : ends[e]);
	}
}

/* Coefficients, four a piece; NULL on failure. */
static long double *fit_spline(size_t count, const double *along, const double *value,
                               const oracle_condition ends[2])
{
	if (count < 2 || count > 500)
		return NULL;
	size_t pieces = count - 1, unknowns = 4 * pieces, row = 0;
	long double *matrix = oracle_reals(unknowns * unknowns);
	long double *right = oracle_reals(unknowns);
	bool ok = matrix && right;
	for (size_t k = 0; ok && k < pieces; k++) {
		long double length = (long double)along[k + 1] - along[k];
		ok = length > 0;
		right[row] = value[k];
		add_derivative(&matrix[row++ * unknowns], k, 0, 0, length, 1);
		right[row] = value[k + 1];
		add_derivative(&matrix[row++ * unknowns], k, 0, 1, length, 1);
		for (int order = 1; k + 1 < pieces && order <= 2; order++, row++) {
			long double next = (long double)along[k + 2] - along[k + 1];
			add_derivative(&matrix[row * unknowns], k, order, 1, length, 1);
			add_derivative(&matrix[row * unknowns], k + 1, order, 0, next, -1);
		}
	}
	if (ok)
		add_ends(matrix, right, unknowns, row, along, pieces, ends);
	ok = ok && oracle_solve(unknowns, matrix, right);
	free(matrix);
	if (!ok) {
		free(right);
		return NULL;
	}
	return right;
}

static oracle_condition condition_of(oracle_ends ends)
{
	return (oracle_condition){ ends == ORACLE_NATURAL ? ORACLE_FREE : ORACLE_JOINED, 0 };
}

bool oracle_spline(size_t count, const double *along, const double *value, oracle_ends ends,
                   double at, long double out[3])
{
	return oracle_spline_mixed(count, along, value, condition_of(ends), condition_of(ends), at,
	                           out);
}

bool oracle_spline_mixed(size_t count, const double *along, const double *value,
                         oracle_condition first, oracle_condition last, double at,
                         long double out[3])
{
	const oracle_condition ends[2] = { first, last };
	long double *cubics = fit_spline(count, along, value, ends);
	if (!cubics)
		return false;
	size_t piece = 0;
	while (piece + 2 < count && at >= along[piece + 1])
		piece++;
	long double length = (long double)along[piece + 1] - along[piece];
	long double u = ((long double)at - along[piece]) / length;
	const long double *c = &cubics[piece * 4];
	out[0] = c[0] + c[1] * u + c[2] * u * u + c[3] * u * u * u;
	out[1] = (c[1] + 2 * c[2] * u + 3 * c[3] * u * u) / length;
	out[2] = (2 * c[2] + 6 * c[3] * u) / (length * length);
	free(cubics);
	return true;
}

long double oracle_spline_integral(size_t count, const double *along, const double *value,
                                   oracle_ends ends, double a, double b)
{
	const oracle_condition both[2] = { condition_of(ends), condition_of(ends) };
	long double *cubics = fit_spline(count, along, value, both);
	if (!cubics || !(a >= along[0] && a <= b && b <= along[count - 1])) {
		free(cubics);
		return nanl("");
	}
	long double sum = 0;
	for (size_t piece = 0; piece + 1 < count; piece++) {
		long double length = (long double)along[piece + 1] - along[piece];
		long double from = fmaxl(a, along[piece]), to = fminl(b, along[piece + 1]);
		if (!(to > from))
			continue;
		long double u = (from - along[piece]) / length, v = (to - along[piece]) / length;
		for (int power = 0; power < 4; power++)
			sum += cubics[piece * 4 + (size_t)power] * length / (power + 1) *
			       (powl(v, power + 1) - powl(u, power + 1));
	}
	free(cubics);
	return sum;
}
