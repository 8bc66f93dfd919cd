#include "fairing/net_tables.h"

#include "core/gauss.h"

#include <string.h>

static void fill(const double *knots, size_t span, double t, double weight, size_t n,
                 net_samples *samples)
{
	const size_t order = samples->order;
	double rows[BSPLINE_DERIVATIVES_MOST + 1][BSPLINE_ORDER_MOST];
	double *table = samples->table + n * NET_TABLE_SIZE(order);
	bspline_basis_derivatives(order, knots, span, t, BSPLINE_DERIVATIVES_MOST, rows);
	for (size_t d = 0; d <= BSPLINE_DERIVATIVES_MOST; d++)
		memcpy(table + d * order, rows[d], order * sizeof *table);
	table[NET_TABLE_SIZE(order) - 1] = weight;
	samples->first[n] = (int32_t)(span + 1 - order);
}

batten_status net_tables_create(batten_context *context, size_t order, size_t poles,
                                const double *knots, size_t points, net_samples *out)
{
	double nodes[GAUSS_POINTS_MOST];
	double weights[GAUSS_POINTS_MOST];
	net_samples samples = { .order = order, .poles = poles, .points = points };
	gauss_points(points, nodes, weights);
	for (size_t span = order - 1; span < poles; span++)
		samples.count += knots[span] < knots[span + 1] ? points : 0;
	samples.first = batten_allocate(context, samples.count, sizeof *samples.first);
	samples.table = batten_allocate(context, samples.count, NET_TABLE_SIZE(order) * sizeof(double));
	if (!samples.first || !samples.table) {
		net_tables_release(context, &samples);
		return BATTEN_MEMORY;
	}
	size_t n = 0;
	for (size_t span = order - 1; span < poles; span++) {
		const double half = 0.5 * (knots[span + 1] - knots[span]);
		for (size_t p = 0; p < points && half > 0.0; p++, n++)
			fill(knots, span, knots[span] + half * (1.0 + nodes[p]), half * weights[p], n,
			     &samples);
	}
	*out = samples;
	return BATTEN_OK;
}

void net_tables_release(batten_context *context, net_samples *samples)
{
	batten_release(context, samples->first);
	batten_release(context, samples->table);
	*samples = (net_samples){ 0 };
}
