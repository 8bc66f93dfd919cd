#include "geometry/surface_quadrature.h"

/* Compared rather than by fmin() and fmax(), which are calls: all poles of every batch pass here. */
/* Chains that do not wait for each other: a minimum takes four times as long to come as to begin. */
enum { CHAINS = 4 };

static surface_range range_with(surface_range range, double number)
{
	range.least = number < range.least ? number : range.least;
	range.most = number > range.most ? number : range.most;
	return range;
}

surface_range surface_range_of(const double *numbers, size_t count)
{
	surface_range ranges[CHAINS];
	for (size_t c = 0; c < CHAINS; c++)
		ranges[c] = (surface_range){ numbers[0], numbers[0] };
	size_t n = 0;
	for (; n + CHAINS <= count; n += CHAINS)
		for (size_t c = 0; c < CHAINS; c++)
			ranges[c] = range_with(ranges[c], numbers[n + c]);
	for (; n < count; n++)
		ranges[0] = range_with(ranges[0], numbers[n]);
	for (size_t c = 1; c < CHAINS; c++)
		ranges[0] = range_with(range_with(ranges[0], ranges[c].least), ranges[c].most);
	return ranges[0];
}

surface_box surface_box_of(const batten_surface_net *net)
{
	surface_box box;
	for (size_t c = 0; c < 3; c++)
		box.along[c] = (surface_range){ net->poles_m[c], net->poles_m[c] };
	for (size_t n = 1; n < net->count_u * net->count_v; n++)
		for (size_t c = 0; c < 3; c++)
			box.along[c] = range_with(box.along[c], net->poles_m[3 * n + c]);
	return box;
}

double surface_net_area(const batten_surface_net *net, const surface_box *box)
{
	double square = 0.0;
	for (size_t c = 0; c < 3; c++) {
		const double side = box->along[c].most - box->along[c].least;
		square += side * side;
	}
	return square / ((net->knots_u[net->count_u] - net->knots_u[net->order_u - 1]) *
	                 (net->knots_v[net->count_v] - net->knots_v[net->order_v - 1]));
}
