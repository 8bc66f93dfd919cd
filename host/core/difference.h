/* Differences over uneven coordinates: one direction of an offset table. */
#ifndef BATTEN_CORE_DIFFERENCE_H
#define BATTEN_CORE_DIFFERENCE_H

#include <stddef.h>

/* Half the sum of the spacings to both neighbours; half a spacing at the ends. */
double difference_cell(const double *at, size_t count, size_t i);

/* Weights of the first and second derivative at at[0] of the parabola through three neighbours: with
 * d = y[0] - y[-1] and e = y[1] - y[0], w[0] d + w[1] e and w[3] e - w[2] d. */
void difference_weights(const double *at, double w[4]);

/* Weights of the third derivative at at[0] of the polynomial of degree 4 through five neighbours: of the
 * four differences from one to the next, which are exact where neighbours are close. */
typedef struct difference_quartic {
	double weight[4];
} difference_quartic;
difference_quartic difference_quartic_of(const double *at);

/* That derivative; the values are step apart in y. */
static inline double difference_third(const difference_quartic *quartic, const double *y,
                                      ptrdiff_t step)
{
	double sum = 0.0;
	for (ptrdiff_t k = 0; k < 4; k++)
		sum += quartic->weight[k] * (y[(k - 1) * step] - y[(k - 2) * step]);
	return sum;
}

#endif
