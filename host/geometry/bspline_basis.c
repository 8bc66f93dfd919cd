#include "geometry/bspline.h"

size_t bspline_span(size_t order, size_t count, const double *knots, double t)
{
	size_t low = order - 1;
	size_t high = count;
	while (high - low > 1) {
		size_t middle = low + (high - low) / 2;
		if (knots[middle] <= t)
			low = middle;
		else
			high = middle;
	}
	return low;
}

/* The recurrence of Cox and de Boor, by rising order. Function j of order k is the one that begins
 * at knot span - k + 1 + j. Its denominators hold the span, so they are never 0. */
void bspline_basis(size_t order, const double *knots, size_t span, double t, double *values)
{
	values[0] = 1;
	for (size_t k = 2; k <= order; k++) {
		double carried = 0;
		for (size_t j = 0; j + 1 < k; j++) {
			double left = knots[span + 2 - k + j];
			double right = knots[span + 1 + j];
			double part = values[j] / (right - left);
			values[j] = carried + (right - t) * part;
			carried = (t - left) * part;
		}
		values[k - 1] = carried;
	}
}

/* One differentiation: from order k (k functions) to order k + 1, in place. */
static void differentiate(size_t k, const double *knots, size_t span, double *values)
{
	double carried = 0;
	for (size_t j = 0; j < k; j++) {
		double part = (double)k * values[j] / (knots[span + 1 + j] - knots[span + 1 - k + j]);
		values[j] = carried - part;
		carried = part;
	}
	values[k] = carried;
}

void bspline_basis_derivatives(size_t order, const double *knots, size_t span, double t,
                               size_t highest,
                               double rows[BSPLINE_DERIVATIVES_MOST + 1][BSPLINE_ORDER_MOST])
{
	for (size_t d = 0; d <= highest; d++) {
		for (size_t j = 0; j < BSPLINE_ORDER_MOST; j++)
			rows[d][j] = 0;
		if (d >= order)
			continue;
		bspline_basis(order - d, knots, span, t, rows[d]);
		for (size_t k = order - d; k < order; k++)
			differentiate(k, knots, span, rows[d]);
	}
}
