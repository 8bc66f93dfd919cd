#include "geometry/surface_quadrature.h"

/* Compared rather than by fmin() and fmax(), which are calls: all poles of every batch pass here. */
surface_range surface_range_of(const double *numbers, size_t count, size_t stride)
{
	surface_range range = { numbers[0], numbers[0] };
	for (size_t n = 1; n < count; n++) {
		const double number = numbers[n * stride];
		range.least = number < range.least ? number : range.least;
		range.most = number > range.most ? number : range.most;
	}
	return range;
}

double surface_net_area(const batten_surface *surface)
{
	const batten_surface_net net = batten_surface_describe(surface);
	double square = 0.0;
	for (size_t c = 0; c < 3; c++) {
		const surface_range range = surface_range_of(net.poles_m + c, net.count_u * net.count_v, 3);
		square += (range.most - range.least) * (range.most - range.least);
	}
	return square / ((net.knots_u[net.count_u] - net.knots_u[net.order_u - 1]) *
	                 (net.knots_v[net.count_v] - net.knots_v[net.order_v - 1]));
}
