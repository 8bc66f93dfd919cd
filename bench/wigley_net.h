/* The searches over control nets: noisy Wigley hulls as bicubic surfaces of 16 x 10 poles, L 16, B 1.6, D 1 m,
 * noise of the poles 0.01 m, 4 x 4 Gauss points a span, poles off the centreplane free in 0 .. B/2. */
#ifndef BATTEN_BENCH_WIGLEY_NET_H
#define BATTEN_BENCH_WIGLEY_NET_H

#include "bench.h"

enum {
	WIGLEY_NET_COLUMNS = 16,
	WIGLEY_NET_ROWS = 10,
	WIGLEY_NET_POLES = WIGLEY_NET_COLUMNS * WIGLEY_NET_ROWS,
	WIGLEY_NET_DEGREE = 3,
	WIGLEY_NET_GAUSS = 4 /* points a span */
};

typedef struct wigley_net {
	size_t count;
	double lower[WIGLEY_NET_POLES], upper[WIGLEY_NET_POLES];
	double *poles; /* [count][rows][columns] x, y, z */
	batten_surface **surfaces;
	double *y, *known_y;
	batten_net_problem *problems;
	batten_search_result *results, *known;
} wigley_net;

/* A knot, uniform over 0 .. 1 and clamped, of so many poles. */
static inline double wigley_net_knot(int number, int poles)
{
	const double knot = (double)(number - WIGLEY_NET_DEGREE) / (double)(poles - WIGLEY_NET_DEGREE);
	return knot < 0.0 ? 0.0 : knot > 1.0 ? 1.0 : knot;
}

/* w2 without dimension. Release it whatever comes back. */
batten_status wigley_net_create(const bench_settings *settings, size_t count, double w2,
                                wigley_net *w);
void wigley_net_release(wigley_net *w);

#endif
