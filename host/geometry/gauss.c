#include "geometry/gauss.h"

#include <math.h>

/* By Newton's method on the Legendre polynomial; the weights are 2 / ((1 - x^2) P'^2). */
void gauss_points(size_t count, double *nodes, double *weights)
{
	const double pi = acos(-1.0);
	for (size_t n = 0; n < count; n++) {
		double x = -cos(pi * ((double)n + 0.75) / ((double)count + 0.5));
		double slope = 1.0;
		for (int turn = 0; turn < 8; turn++) {
			double before = 1.0;
			double here = x;
			for (size_t degree = 2; degree <= count; degree++) {
				const double d = (double)degree;
				const double next = ((2.0 * d - 1.0) * x * here - (d - 1.0) * before) / d;
				before = here;
				here = next;
			}
			slope = (double)count * (x * here - before) / (x * x - 1.0);
			x -= here / slope;
		}
		nodes[n] = x;
		weights[n] = 2.0 / ((1.0 - x * x) * slope * slope);
	}
}
