#include "geometry/surface_quadrature.h"

#include <math.h>

/* By Newton's method on the Legendre polynomial P; the weights are 2 / ((1 - x^2) P'^2). */
void surface_gauss_points(size_t count, double *nodes, double *weights)
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

double surface_net_area(const batten_surface *surface)
{
	const batten_surface_net net = batten_surface_describe(surface);
	double square = 0.0;
	for (size_t c = 0; c < 3; c++) {
		double least = net.poles_m[c];
		double most = least;
		for (size_t n = 1; n < net.count_u * net.count_v; n++) {
			least = fmin(least, net.poles_m[3 * n + c]);
			most = fmax(most, net.poles_m[3 * n + c]);
		}
		square += (most - least) * (most - least);
	}
	return square / ((net.knots_u[net.count_u] - net.knots_u[net.order_u - 1]) *
	                 (net.knots_v[net.count_v] - net.knots_v[net.order_v - 1]));
}
