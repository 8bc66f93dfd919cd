#include "core/gauss.h"
#include "geometry/surface_batch.h"
#include "geometry/surface_quadrature.h"

#include <string.h>

static batten_status allocate(batten_context *context, size_t order, size_t rows, size_t poles,
                              size_t count, surface_samples *out)
{
	surface_samples samples = { .order = order, .rows = rows, .poles = poles, .count = count };
	samples.first = batten_allocate(context, count, sizeof *samples.first);
	samples.table = batten_allocate(context, count,
	                                SURFACE_TABLE_SIZE(rows, order) * sizeof(double));
	if (!samples.first || !samples.table) {
		surface_samples_release(context, &samples);
		return BATTEN_MEMORY;
	}
	*out = samples;
	return BATTEN_OK;
}

void surface_samples_release(batten_context *context, surface_samples *samples)
{
	batten_release(context, samples->first);
	batten_release(context, samples->table);
	samples->first = NULL;
	samples->table = NULL;
}

static void fill(const double *knots, size_t span, double t, double weight, size_t n,
                 surface_samples *samples)
{
	const size_t order = samples->order;
	double rows[BSPLINE_DERIVATIVES_MOST + 1][BSPLINE_ORDER_MOST];
	double *table = samples->table + n * SURFACE_TABLE_SIZE(samples->rows, order);
	bspline_basis_derivatives(order, knots, span, t, samples->rows - 1, rows);
	for (size_t d = 0; d < samples->rows; d++)
		memcpy(table + d * order, rows[d], order * sizeof *table);
	table[samples->rows * order] = weight;
	samples->first[n] = (int32_t)(span + 1 - order);
}

batten_status surface_samples_check(batten_context *context, const char *what, size_t count)
{
	enum { SAMPLES_MOST = 65536 };
	if (count >= 1 && count <= SAMPLES_MOST)
		return BATTEN_OK;
	return batten_fail(context, BATTEN_USAGE, "%zu samples along %s: 1 to %d are expected", count,
	                   what, SAMPLES_MOST);
}

batten_status surface_samples_at(batten_context *context, const char *what, size_t order,
                                 size_t poles, const double *knots, size_t count,
                                 const double *parameters, surface_samples *out)
{
	enum { TABLE_ROWS = 3 };
	const double first = knots[order - 1];
	const double last = knots[poles];
	batten_status status = surface_samples_check(context, what, count);
	if (status != BATTEN_OK)
		return status;
	for (size_t n = 0; n < count; n++)
		if (!(parameters[n] >= first && parameters[n] <= last))
			return batten_fail(context, BATTEN_USAGE, "sample %zu: %s is %g, %g to %g is expected",
			                   n, what, parameters[n], first, last);
	status = allocate(context, order, TABLE_ROWS, poles, count, out);
	for (size_t n = 0; n < count && status == BATTEN_OK; n++)
		fill(knots, bspline_span(order, poles, knots, parameters[n]), parameters[n], 1.0, n, out);
	return status;
}

batten_status surface_samples_gauss(batten_context *context, size_t order, size_t rows,
                                    size_t poles, const double *knots, size_t points,
                                    surface_samples *out)
{
	double nodes[GAUSS_POINTS_MOST];
	double weights[GAUSS_POINTS_MOST];
	if (points < 1 || points > GAUSS_POINTS_MOST)
		return batten_fail(context, BATTEN_USAGE, "%zu Gauss points a span: 1 to %d are expected",
		                   points, GAUSS_POINTS_MOST);
	gauss_points(points, nodes, weights);
	size_t spans = 0;
	for (size_t span = order - 1; span < poles; span++)
		spans += knots[span] < knots[span + 1];
	const batten_status status = allocate(context, order, rows, poles, spans * points, out);
	size_t n = 0;
	for (size_t span = order - 1; span < poles && status == BATTEN_OK; span++) {
		if (!(knots[span] < knots[span + 1]))
			continue;
		const double half = 0.5 * (knots[span + 1] - knots[span]);
		for (size_t p = 0; p < points; p++, n++)
			fill(knots, span, knots[span] + half * (1.0 + nodes[p]), half * weights[p], n, out);
	}
	return status;
}
