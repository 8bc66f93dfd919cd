#include "wigley_net.h"

#include <stdlib.h>

void wigley_net_release(wigley_net *w)
{
	for (size_t h = 0; w->surfaces && h < w->count; h++)
		batten_surface_destroy(w->surfaces[h]);
	free(w->surfaces);
	free(w->poles);
	free(w->y);
	free(w->known_y);
	free(w->problems);
	free(w->results);
	free(w->known);
}

/* The mean of a pole's inner knots. */
static double place_of(int pole, int poles)
{
	double sum = 0.0;
	for (int d = 1; d <= WIGLEY_NET_DEGREE; d++)
		sum += wigley_net_knot(pole + d, poles);
	return sum / WIGLEY_NET_DEGREE;
}

static batten_status make_surface(const bench_settings *settings, uint32_t state, double *poles,
                                  double *upper, batten_surface **out)
{
	for (int n = 0; n < WIGLEY_NET_POLES; n++) {
		const double u = place_of(n % WIGLEY_NET_COLUMNS, WIGLEY_NET_COLUMNS);
		const double v = place_of(n / WIGLEY_NET_COLUMNS, WIGLEY_NET_ROWS);
		const double form = 0.8 * 4.0 * u * (1.0 - u) * v * (2.0 - v);
		const bool inside = n % WIGLEY_NET_COLUMNS > 0 &&
		                    n % WIGLEY_NET_COLUMNS < WIGLEY_NET_COLUMNS - 1 &&
		                    n >= WIGLEY_NET_COLUMNS;
		state = state * 1664525u + 1013904223u;
		const double y = form + 0.02 * ((double)(state >> 8) / (1u << 24) - 0.5);
		poles[3 * n] = 16.0 * u;
		poles[3 * n + 1] = !inside || y < 0.0 ? 0.0 : y > 0.8 ? 0.8 : y;
		poles[3 * n + 2] = v;
		upper[n] = inside ? 0.8 : 0.0;
	}
	const batten_surface_net net = { .order_u = WIGLEY_NET_DEGREE + 1,
		                             .order_v = WIGLEY_NET_DEGREE + 1,
		                             .count_u = WIGLEY_NET_COLUMNS,
		                             .count_v = WIGLEY_NET_ROWS,
		                             .poles_m = poles };
	return batten_surface_create(settings->context, &net, out);
}

batten_status wigley_net_create(const bench_settings *settings, size_t count, double w2,
                                wigley_net *w)
{
	batten_status status = BATTEN_OK;
	*w = (wigley_net){ .count = count };
	w->surfaces = calloc(count, sizeof(batten_surface *));
	w->poles = calloc(count * WIGLEY_NET_POLES, 3 * sizeof *w->poles);
	w->y = calloc(count * WIGLEY_NET_POLES, sizeof *w->y);
	w->known_y = calloc(count * WIGLEY_NET_POLES, sizeof *w->known_y);
	w->problems = calloc(count, sizeof *w->problems);
	w->results = calloc(count, sizeof *w->results);
	w->known = calloc(count, sizeof *w->known);
	if (!w->surfaces || !w->poles || !w->y || !w->known_y || !w->problems || !w->results ||
	    !w->known)
		return BATTEN_MEMORY;
	for (size_t h = 0; h < count && status == BATTEN_OK; h++) {
		status = make_surface(settings, 2654435761u * (uint32_t)(h + 1),
		                      w->poles + h * 3 * WIGLEY_NET_POLES, w->upper, &w->surfaces[h]);
		w->problems[h] = (batten_net_problem){ .start = w->surfaces[h],
			                                   .lower_y_m = w->lower,
			                                   .upper_y_m = w->upper,
			                                   .w1 = 1.0,
			                                   .w2 = w2,
			                                   .half_beam_m = 0.8 };
	}
	return status;
}
