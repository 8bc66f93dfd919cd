/* What the tests that hold surfaces against the oracle share: drawn nets of any order, with
 * repeated knots, free and clamped ends, rational and not. */
#ifndef BATTEN_TESTS_SURFACE_FIXTURE_H
#define BATTEN_TESTS_SURFACE_FIXTURE_H

#include "batten.h"

#include "oracle/oracle_bspline.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { POLES_MOST = 16, KNOTS_MOST = 24 };

typedef struct drawn {
	double knots_u[KNOTS_MOST], knots_v[KNOTS_MOST];
	double poles[POLES_MOST * POLES_MOST * 3], weights[POLES_MOST * POLES_MOST];
	batten_surface_net net;
} drawn;

/* splitmix64 */
static inline uint64_t draw(uint64_t *seed)
{
	uint64_t z = *seed += 0x9e3779b97f4a7c15U;
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
	return z ^ (z >> 31);
}

static inline double draw_real(uint64_t *seed, double from, double to)
{
	return from + (to - from) * (double)(draw(seed) >> 11) * 0x1p-53;
}

/* Knots with steps of 0.2 to 1, inside the range repeated up to order - 1 times; the ends repeated
 * order times or free. Returns the number of poles. */
static inline size_t draw_knots(uint64_t *seed, size_t order, double *knots)
{
	size_t count = order + draw(seed) % 7, times = 1;
	bool clamped = draw(seed) % 2;
	knots[0] = draw_real(seed, -2, 2);
	for (size_t i = 1; i < count + order; i++) {
		bool edge = i == order || i == count; /* no empty span begins or ends the range */
		bool inside = i > order && i < count;
		bool step = edge || (inside ? times + 1 >= order || draw(seed) % 3 > 0 : !clamped);
		knots[i] = knots[i - 1] + (step ? draw_real(seed, 0.2, 1) : 0);
		times = step ? 1 : times + 1;
	}
	return count;
}

/* Poles that bend and twist but do not fold: by whole numbers along and up, moved by jitter, y by
 * as much as 2. */
static inline void draw_poles(uint64_t *seed, drawn *d)
{
	for (size_t j = 0; j < d->net.count_v; j++) {
		for (size_t i = 0; i < d->net.count_u; i++) {
			size_t pole = j * d->net.count_u + i;
			d->poles[3 * pole] = (double)i + draw_real(seed, -0.3, 0.3);
			d->poles[3 * pole + 1] = draw_real(seed, 0, 2);
			d->poles[3 * pole + 2] = (double)j + draw_real(seed, -0.3, 0.3);
			d->weights[pole] = draw_real(seed, 0.5, 2);
		}
	}
}

static inline void draw_net(uint64_t *seed, size_t order_u, size_t order_v, bool rational,
                            drawn *out)
{
	batten_surface_net *net = &out->net;
	*net = (batten_surface_net){ .order_u = order_u, .order_v = order_v };
	net->count_u = draw_knots(seed, order_u, out->knots_u);
	net->count_v = draw_knots(seed, order_v, out->knots_v);
	net->knots_u = out->knots_u;
	net->knots_v = out->knots_v;
	net->poles_m = out->poles;
	net->weights = rational ? out->weights : NULL;
	draw_poles(seed, out);
}

static inline oracle_surface as_oracle(const batten_surface_net *net)
{
	return (oracle_surface){ net->order_u, net->order_v, net->count_u, net->count_v,
		                     net->knots_u, net->knots_v, net->poles_m, net->weights };
}

static inline batten_context *open_context(void)
{
	batten_context *context = NULL;
	assert_int_equal(batten_context_create(NULL, &context), BATTEN_OK);
	return context;
}

/* A place in the range: its beginning, its end, one of the knots in it, or anywhere. */
static inline double draw_place(uint64_t *seed, size_t order, size_t count, const double *knots)
{
	switch (draw(seed) % 8) {
	case 0:
		return knots[order - 1];
	case 1:
		return knots[count];
	case 2:
		return knots[order - 1 + draw(seed) % (count - order + 2)];
	default:
		return draw_real(seed, knots[order - 1], knots[count]);
	}
}

#endif
