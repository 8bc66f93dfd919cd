#include "geometry/bspline_refine.h"

#include <string.h>

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

static batten_status check_net(batten_context *context, const struct bspline_curve_net *net)
{
	if (net->dimension < 1 || net->dimension > 3)
		return batten_fail(context, BATTEN_USAGE, "a curve of dimension %zu, expected 1..3",
		                   net->dimension);
	if (!net->knots || !net->poles)
		return batten_fail(context, BATTEN_USAGE, "a curve without knots or poles");
	batten_status status = bspline_knots_check(context, "knots", net->order, net->count,
	                                           net->knots);
	if (status == BATTEN_OK)
		status = bspline_poles_check(context, net->count, net->dimension, net->poles, net->weights);
	return status;
}

static double *copy_numbers(batten_context *context, size_t count, const double *from)
{
	double *to = batten_allocate(context, count, sizeof *to);
	if (to)
		memcpy(to, from, count * sizeof *to);
	return to;
}

batten_status bspline_curve_create(batten_context *context, const struct bspline_curve_net *net,
                                   struct bspline_curve *out)
{
	*out = (struct bspline_curve){ 0 };
	batten_status status = check_net(context, net);
	if (status != BATTEN_OK)
		return status;
	struct bspline_curve curve = {
		.context = context, .order = net->order, .count = net->count, .dimension = net->dimension
	};
	curve.knots = copy_numbers(context, net->count + net->order, net->knots);
	curve.poles = copy_numbers(context, net->count * net->dimension, net->poles);
	if (net->weights)
		curve.weights = copy_numbers(context, net->count, net->weights);
	if (!curve.knots || !curve.poles || (net->weights && !curve.weights)) {
		bspline_curve_destroy(&curve);
		return BATTEN_MEMORY;
	}
	*out = curve;
	return BATTEN_OK;
}

void bspline_curve_destroy(struct bspline_curve *curve)
{
	if (curve->context) {
		batten_release(curve->context, curve->knots);
		batten_release(curve->context, curve->poles);
		batten_release(curve->context, curve->weights);
	}
	*curve = (struct bspline_curve){ 0 };
}

/* ------------------------------------------------------------------------------------------------
 * Evaluation
 * --------------------------------------------------------------------------------------------- */

/* Derivatives of p = a / w from those of a and w (Leibniz): w p' = a' - w' p and so on. a holds the
 * homogeneous point, its weight at place dimension, 4 numbers a derivative. */
static void divide_by_weight(size_t dimension, size_t highest, const double (*a)[4], double *values)
{
	static const double binomial[4][4] = {
		{ 1, 0, 0, 0 }, { 1, 1, 0, 0 }, { 1, 2, 1, 0 }, { 1, 3, 3, 1 }
	};
	for (size_t d = 0; d <= highest; d++) {
		for (size_t c = 0; c < dimension; c++) {
			double sum = a[d][c];
			for (size_t i = 1; i <= d; i++)
				sum -= binomial[d][i] * a[i][dimension] * values[(d - i) * dimension + c];
			values[d * dimension + c] = sum / a[0][dimension];
		}
	}
}

void bspline_curve_evaluate(const struct bspline_curve *curve, double t, size_t highest,
                            double *values)
{
	size_t dimension = curve->dimension;
	size_t span = bspline_span(curve->order, curve->count, curve->knots, t);
	double basis[BSPLINE_DERIVATIVES_MOST + 1][BSPLINE_ORDER_MOST];
	double a[BSPLINE_DERIVATIVES_MOST + 1][4] = { { 0 } };
	bspline_basis_derivatives(curve->order, curve->knots, span, t, highest, basis);
	for (size_t d = 0; d <= highest; d++) {
		for (size_t j = 0; j < curve->order; j++) {
			size_t pole = span + 1 - curve->order + j;
			double part = basis[d][j] * (curve->weights ? curve->weights[pole] : 1);
			for (size_t c = 0; c < dimension; c++)
				a[d][c] += part * curve->poles[pole * dimension + c];
			if (curve->weights)
				a[d][dimension] += part;
		}
	}
	if (curve->weights) {
		divide_by_weight(dimension, highest, a, values);
		return;
	}
	for (size_t d = 0; d <= highest; d++)
		memcpy(values + d * dimension, a[d], dimension * sizeof *values);
}

/* ------------------------------------------------------------------------------------------------
 * Changes in place
 * --------------------------------------------------------------------------------------------- */

/* Puts the rows in the place of the poles and takes them over; the curve stays when that fails. */
static batten_status replace_rows(struct bspline_curve *curve, struct bspline_rows *rows)
{
	struct bspline_curve next = *curve;
	next.knots = rows->knots;
	next.order = rows->order;
	next.count = rows->count;
	next.weights = NULL;
	next.poles = batten_allocate(curve->context, rows->count * curve->dimension, sizeof(double));
	if (curve->weights)
		next.weights = batten_allocate(curve->context, rows->count, sizeof *next.weights);
	if (!next.poles || (curve->weights && !next.weights)) {
		bspline_curve_destroy(&next);
		rows->knots = NULL;
		bspline_rows_release(curve->context, rows);
		return BATTEN_MEMORY;
	}
	bspline_from_homogeneous(rows->count, curve->dimension, rows->rows, next.poles, next.weights);
	rows->knots = NULL;
	bspline_rows_release(curve->context, rows);
	batten_status status = bspline_poles_check(curve->context, next.count, next.dimension,
	                                           next.poles, next.weights);
	struct bspline_curve old = status == BATTEN_OK ? *curve : next;
	if (status == BATTEN_OK)
		*curve = next;
	bspline_curve_destroy(&old);
	return status;
}

/* The curve as rows that own nothing but their rows. */
static batten_status make_rows(const struct bspline_curve *curve, struct bspline_rows *out)
{
	size_t width = bspline_homogeneous_width(curve->dimension, curve->weights);
	*out = (struct bspline_rows){
		.order = curve->order, .count = curve->count, .width = width, .knots = curve->knots
	};
	out->rows = batten_allocate(curve->context, curve->count * width, sizeof *out->rows);
	if (!out->rows)
		return BATTEN_MEMORY;
	bspline_to_homogeneous(curve->count, curve->dimension, curve->poles, curve->weights, out->rows);
	return BATTEN_OK;
}

batten_status bspline_curve_insert_knot(struct bspline_curve *curve, double t, size_t times)
{
	struct bspline_rows from;
	struct bspline_rows to;
	if (times == 0)
		return BATTEN_OK;
	batten_status status = make_rows(curve, &from);
	if (status != BATTEN_OK)
		return status;
	status = bspline_rows_insert(curve->context, &from, t, times, &to);
	batten_release(curve->context, from.rows);
	return status == BATTEN_OK ? replace_rows(curve, &to) : status;
}

batten_status bspline_curve_elevate(struct bspline_curve *curve, size_t times)
{
	struct bspline_rows from;
	struct bspline_rows to;
	if (times == 0)
		return BATTEN_OK;
	batten_status status = make_rows(curve, &from);
	if (status != BATTEN_OK)
		return status;
	status = bspline_rows_elevate(curve->context, &from, times, &to);
	batten_release(curve->context, from.rows);
	return status == BATTEN_OK ? replace_rows(curve, &to) : status;
}

void bspline_curve_reverse(struct bspline_curve *curve)
{
	bspline_knots_reverse(curve->order, curve->count, curve->knots);
	bspline_rows_reverse(curve->count, curve->dimension, curve->poles);
	if (curve->weights)
		bspline_rows_reverse(curve->count, 1, curve->weights);
}

batten_status bspline_curve_map(struct bspline_curve *curve, const double *matrix,
                                const double *shift)
{
	return bspline_poles_map(curve->context, curve->count, curve->dimension, matrix, shift,
	                         curve->poles);
}
