#include "geometry/surface.h"

#include "geometry/bspline_refine.h"
#include "hull/hull.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

static batten_status allocate_arrays(struct batten_surface *surface, bool rational)
{
	batten_context *context = surface->context;
	size_t poles = surface->count_u * surface->count_v;
	surface->knots_u = batten_allocate(context, surface->count_u + surface->order_u,
	                                   sizeof(double));
	surface->knots_v = batten_allocate(context, surface->count_v + surface->order_v,
	                                   sizeof(double));
	surface->poles = batten_allocate(context, poles, 3 * sizeof(double));
	if (rational)
		surface->weights = batten_allocate(context, poles, sizeof(double));
	if (!surface->knots_u || !surface->knots_v || !surface->poles ||
	    (rational && !surface->weights))
		return BATTEN_MEMORY;
	bspline_knots_clamped(surface->order_u, surface->count_u, surface->knots_u);
	bspline_knots_clamped(surface->order_v, surface->count_v, surface->knots_v);
	for (size_t i = 0; i < poles && rational; i++)
		surface->weights[i] = 1;
	return BATTEN_OK;
}

batten_status surface_allocate(batten_context *context, const char *name, size_t order_u,
                               size_t order_v, size_t count_u, size_t count_v, bool rational,
                               struct batten_surface **out)
{
	*out = NULL;
	batten_status status = bspline_shape_check(context, "direction u", order_u, count_u);
	if (status == BATTEN_OK)
		status = bspline_shape_check(context, "direction v", order_v, count_v);
	if (status != BATTEN_OK)
		return status;
	struct batten_surface *surface = batten_allocate(context, 1, sizeof *surface);
	if (!surface)
		return BATTEN_MEMORY;
	surface->context = context;
	surface->order_u = order_u;
	surface->order_v = order_v;
	surface->count_u = count_u;
	surface->count_v = count_v;
	status = hull_clean_text(context, name ? name : "", name ? strlen(name) : 0, &surface->name);
	if (status == BATTEN_OK)
		status = allocate_arrays(surface, rational);
	if (status == BATTEN_OK)
		*out = surface;
	else
		batten_surface_destroy(surface);
	return status;
}

void batten_surface_destroy(batten_surface *surface)
{
	if (!surface)
		return;
	batten_context *context = surface->context;
	batten_release(context, surface->name);
	batten_release(context, surface->knots_u);
	batten_release(context, surface->knots_v);
	batten_release(context, surface->poles);
	batten_release(context, surface->weights);
	batten_release(context, surface);
}

batten_status surface_check(const struct batten_surface *surface)
{
	batten_context *context = surface->context;
	batten_status status = bspline_knots_check(context, "knots_u", surface->order_u,
	                                           surface->count_u, surface->knots_u);
	if (status == BATTEN_OK)
		status = bspline_knots_check(context, "knots_v", surface->order_v, surface->count_v,
		                             surface->knots_v);
	if (status == BATTEN_OK)
		status = bspline_poles_check(context, surface->count_u * surface->count_v, 3,
		                             surface->poles, surface->weights);
	return status;
}

batten_status batten_surface_create(batten_context *context, const batten_surface_net *net,
                                    batten_surface **out)
{
	struct batten_surface *surface;
	*out = NULL;
	if (!net->poles_m)
		return batten_fail(context, BATTEN_USAGE, "a surface without poles");
	batten_status status = surface_allocate(context, net->name, net->order_u, net->order_v,
	                                        net->count_u, net->count_v, net->weights, &surface);
	if (status != BATTEN_OK)
		return status;
	size_t poles = net->count_u * net->count_v;
	if (net->knots_u)
		memcpy(surface->knots_u, net->knots_u, (net->count_u + net->order_u) * sizeof(double));
	if (net->knots_v)
		memcpy(surface->knots_v, net->knots_v, (net->count_v + net->order_v) * sizeof(double));
	memcpy(surface->poles, net->poles_m, 3 * poles * sizeof(double));
	if (net->weights)
		memcpy(surface->weights, net->weights, poles * sizeof(double));
	status = surface_check(surface);
	if (status == BATTEN_OK)
		*out = surface;
	else
		batten_surface_destroy(surface);
	return status;
}

batten_status batten_surface_clone(batten_context *context, const batten_surface *surface,
                                   batten_surface **out)
{
	batten_surface_net net = batten_surface_describe(surface);
	return batten_surface_create(context, &net, out);
}

batten_surface_net batten_surface_describe(const batten_surface *surface)
{
	return (batten_surface_net){ .name = surface->name,
		                         .order_u = surface->order_u,
		                         .order_v = surface->order_v,
		                         .count_u = surface->count_u,
		                         .count_v = surface->count_v,
		                         .knots_u = surface->knots_u,
		                         .knots_v = surface->knots_v,
		                         .poles_m = surface->poles,
		                         .weights = surface->weights };
}

void batten_surface_range(const batten_surface *surface, batten_direction direction, double *first,
                          double *last)
{
	bool along_u = direction == BATTEN_DIRECTION_U;
	const double *knots = along_u ? surface->knots_u : surface->knots_v;
	*first = knots[(along_u ? surface->order_u : surface->order_v) - 1];
	*last = knots[along_u ? surface->count_u : surface->count_v];
}

/* ------------------------------------------------------------------------------------------------
 * Evaluation
 * --------------------------------------------------------------------------------------------- */

typedef double basis_rows[BSPLINE_DERIVATIVES_MOST + 1][BSPLINE_ORDER_MOST];

/* Derivatives by u of one row of the net, homogeneous: sums[derivative]. Without weights the fourth
 * number stays 0. */
static void sum_row(const struct batten_surface *surface, size_t first_pole,
                    const basis_rows basis_u, size_t highest, double sums[4][4])
{
	memset(sums, 0, 16 * sizeof sums[0][0]);
	for (size_t j = 0; j < surface->order_u; j++) {
		const double *pole = surface->poles + 3 * (first_pole + j);
		double weight = surface->weights ? surface->weights[first_pole + j] : 1;
		for (size_t d = 0; d <= highest; d++) {
			double part = basis_u[d][j] * weight;
			for (size_t c = 0; c < 3; c++)
				sums[d][c] += part * pole[c];
			sums[d][3] += surface->weights ? part : 0;
		}
	}
}

/* One derivative of p = a / w from those of a and w and the lower ones of p (Leibniz). */
static void divide_by_weight(const double a[4][4][4], size_t i, size_t j, surface_jet d)
{
	static const double binomial[4][4] = {
		{ 1, 0, 0, 0 }, { 1, 1, 0, 0 }, { 1, 2, 1, 0 }, { 1, 3, 3, 1 }
	};
	for (size_t c = 0; c < 3; c++) {
		double sum = a[i][j][c];
		for (size_t k = 0; k <= i; k++)
			for (size_t l = 0; l <= j; l++)
				if (k + l > 0)
					sum -= binomial[i][k] * binomial[j][l] * a[k][l][3] * d[i - k][j - l][c];
		d[i][j][c] = sum / a[0][0][3];
	}
}

void surface_evaluate(const struct batten_surface *surface, double u, double v, size_t highest,
                      surface_jet d)
{
	size_t span_u = bspline_span(surface->order_u, surface->count_u, surface->knots_u, u);
	size_t span_v = bspline_span(surface->order_v, surface->count_v, surface->knots_v, v);
	basis_rows basis_u;
	basis_rows basis_v;
	double a[4][4][4] = { { { 0 } } };
	double sums[4][4];
	bspline_basis_derivatives(surface->order_u, surface->knots_u, span_u, u, highest, basis_u);
	bspline_basis_derivatives(surface->order_v, surface->knots_v, span_v, v, highest, basis_v);
	for (size_t row = 0; row < surface->order_v; row++) {
		size_t line = span_v + 1 - surface->order_v + row;
		size_t first = line * surface->count_u + span_u + 1 - surface->order_u;
		sum_row(surface, first, basis_u, highest, sums);
		for (size_t i = 0; i <= highest; i++)
			for (size_t j = 0; i + j <= highest; j++)
				for (size_t c = 0; c < 4; c++)
					a[i][j][c] += basis_v[j][row] * sums[i][c];
	}
	memset(d, 0, sizeof(surface_jet));
	for (size_t i = 0; i <= highest; i++) {
		for (size_t j = 0; i + j <= highest; j++) {
			if (surface->weights)
				divide_by_weight(a, i, j, d);
			else
				memcpy(d[i][j], a[i][j], sizeof d[i][j]);
		}
	}
}

batten_status batten_surface_evaluate(const batten_surface *surface, double u, double v,
                                      batten_surface_point *out)
{
	if (!isfinite(u) || !isfinite(v))
		return batten_fail(surface->context, BATTEN_USAGE,
		                   "the parameters of a point of a surface are not finite");
	surface_evaluate(surface, u, v, BSPLINE_DERIVATIVES_MOST, out->derivative);
	return BATTEN_OK;
}
