#include "core/difference.h"

double difference_cell(const double *at, size_t count, size_t i)
{
	const double below = i > 0 ? at[i] - at[i - 1] : 0.0;
	const double above = i + 1 < count ? at[i + 1] - at[i] : 0.0;
	return 0.5 * (below + above);
}

void difference_weights(const double *at, double w[4])
{
	const double below = at[0] - at[-1];
	const double above = at[1] - at[0];
	w[0] = above / (below * (below + above));
	w[1] = below / (above * (below + above));
	w[2] = 2.0 / (below * (below + above));
	w[3] = 2.0 / (above * (below + above));
}

/* Newton's form: 6 [0 1 2 3] + 6 [0 1 2 3 4] times the sum of the distances from the first four. */
static double third_of(const double *at, const double value[5])
{
	double table[5];
	double cubic = 0.0;
	for (ptrdiff_t i = 0; i < 5; i++)
		table[i] = value[i];
	for (ptrdiff_t degree = 1; degree < 5; degree++) {
		for (ptrdiff_t first = 0; first + degree < 5; first++)
			table[first] = (table[first + 1] - table[first]) /
			               (at[first + degree - 2] - at[first - 2]);
		cubic = degree == 3 ? table[0] : cubic;
	}
	const double away = (at[0] - at[-2]) + (at[0] - at[-1]) + (at[0] - at[1]);
	return 6.0 * (cubic + away * table[0]);
}

difference_quartic difference_quartic_of(const double *at)
{
	difference_quartic quartic;
	for (ptrdiff_t k = 0; k < 4; k++) {
		/* One where the difference k is: a step. */
		double step[5];
		for (ptrdiff_t i = 0; i < 5; i++)
			step[i] = i > k ? 1.0 : 0.0;
		quartic.weight[k] = third_of(at, step);
	}
	return quartic;
}
