#include "geometry/surface_quadrature.h"

#include <math.h>

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
