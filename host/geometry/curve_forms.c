/* The representations of a line (thesis 3.1, 3.2; Letcher 3.5-3.7). */
#include "geometry/curve.h"
#include "geometry/least_squares.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------------------------------------
 * Slopes
 * --------------------------------------------------------------------------------------------- */

/* Derivative at point i of the parabola through it and its neighbours (at an end: the next two); of
 * two points the chord. */
static double parabola_slope(const batten_curve *curve, size_t i, size_t coordinate)
{
	size_t last = curve->count - 1;
	size_t first = i == 0 ? 0 : i == last && last > 1 ? last - 2 : i - 1;
	const double *t = curve->parameters + first;
	const double *p = curve->points + first * curve->dimension + coordinate;
	double step = t[1] - t[0];
	double chord = (p[curve->dimension] - p[0]) / step;
	if (last < 2)
		return chord;
	double next_step = t[2] - t[1];
	double next = (p[2 * curve->dimension] - p[curve->dimension]) / next_step;
	double bend = (next - chord) / (step + next_step);
	return i == first       ? chord - step * bend
	       : i == first + 1 ? chord + step * bend
	                        : next + next_step * bend;
}

static batten_status make_hermite(batten_curve *curve, const batten_curve_options *options)
{
	size_t numbers = curve->count * curve->dimension;
	curve->slopes = batten_allocate(curve->context, numbers, sizeof *curve->slopes);
	if (!curve->slopes)
		return BATTEN_MEMORY;
	for (size_t n = 0; n < numbers; n++) {
		if (options->slopes && !isfinite(options->slopes[n]))
			return batten_fail(curve->context, BATTEN_USAGE, "slope %zu of a curve is not finite",
			                   n / curve->dimension + 1);
		curve->slopes[n] = options->slopes
		                       ? options->slopes[n]
		                       : parabola_slope(curve, n / curve->dimension, n % curve->dimension);
	}
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Cubic spline
 * --------------------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Derivative by the parameter at a clamped end: along the tangent, as fast as the end's chord; where
 * x is the parameter, as fast as x. */
static batten_status clamp(const batten_curve *curve, const batten_curve_end *end, bool first,
                           struct spline_condition conditions[3])
{
	size_t dimension = curve->dimension;
	size_t from = first ? 0 : curve->count - 2;
	double tangent[3] = { 0 };
	double chord[3] = { 0 };
	memcpy(tangent, end->tangent, dimension * sizeof *tangent);
	for (size_t c = 0; c < dimension; c++)
		chord[c] = curve->points[(from + 1) * dimension + c] - curve->points[from * dimension + c];
	double length = sqrt(dot(tangent, tangent));
	double speed = sqrt(dot(chord, chord)) /
	               (curve->parameters[from + 1] - curve->parameters[from]);
	if (!isfinite(length) || (curve->by_x && length > 0 && !(tangent[0] > 0)))
		return batten_fail(curve->context, BATTEN_USAGE,
		                   "the tangent at the %s end is not finite, or does not run with x",
		                   first ? "first" : "last");
	for (size_t c = 0; c < dimension; c++) {
		double slope = curve->by_x ? tangent[c] / tangent[0] : tangent[c] / length * speed;
		if (!(length > 0))
			slope = parabola_slope(curve, first ? 0 : curve->count - 1, c);
		conditions[c] = (struct spline_condition){ SPLINE_CLAMPED, slope };
	}
	return BATTEN_OK;
}

/* The second derivative that gives an end its curvature where the tangent is as the spline now has
 * it: |c'|^2 times the curvature across the tangent, and along it what keeps x the parameter. */
static void bend(const batten_curve *curve, const batten_curve_end *end, bool first, double out[3])
{
	double slope[3] = { 0 };
	double asked[3] = { 0 };
	for (size_t c = 0; c < curve->dimension; c++) {
		const struct spline *spline = &curve->splines[c];
		slope[c] = spline_slope(spline, spline->x[first ? 0 : curve->count - 1]);
	}
	double square = dot(slope, slope);
	double speed = sqrt(square);
	if (curve->dimension == 2) {
		asked[0] = -end->curvature_per_m[0] * slope[1] / speed;
		asked[1] = end->curvature_per_m[0] * slope[0] / speed;
	} else {
		memcpy(asked, end->curvature_per_m, sizeof asked);
	}
	double along = dot(asked, slope) / square;
	for (size_t c = 0; c < 3; c++)
		out[c] = square * (asked[c] - along * slope[c]);
	double shift = curve->by_x ? out[0] / slope[0] : 0;
	for (size_t c = 0; c < 3; c++)
		out[c] -= shift * slope[c];
}

static void release_splines(batten_curve *curve)
{
	for (size_t c = 0; c < 3; c++)
		spline_destroy(&curve->splines[c]);
}

static batten_status build_splines(batten_curve *curve, struct spline_condition conditions[2][3],
                                   double *column)
{
	batten_status status = BATTEN_OK;
	release_splines(curve);
	for (size_t c = 0; c < curve->dimension && status == BATTEN_OK; c++) {
		for (size_t i = 0; i < curve->count; i++)
			column[i] = curve->points[i * curve->dimension + c];
		status = spline_create_mixed(curve->context, curve->count, curve->parameters, column,
		                             conditions[0][c], conditions[1][c], &curve->splines[c]);
	}
	return status;
}

/* Puts the second derivatives that ends of given curvature ask for into the conditions; returns the
 * largest change, as a part of what it changed to. */
static double update_bends(const batten_curve *curve, const batten_curve_options *options,
                           struct spline_condition conditions[2][3])
{
	double change = 0;
	for (size_t e = 0; e < 2; e++) {
		double bent[3];
		if (options->ends[e].kind != BATTEN_END_CURVATURE)
			continue;
		bend(curve, &options->ends[e], e == 0, bent);
		double length = sqrt(dot(bent, bent));
		if (!isfinite(length))
			return INFINITY;
		for (size_t c = 0; c < curve->dimension; c++) {
			if (bent[c] != conditions[e][c].value)
				change = fmax(change, fabs(bent[c] - conditions[e][c].value) / length);
			conditions[e][c].value = bent[c];
		}
	}
	return change;
}

static batten_status check_end(const batten_curve *curve, const batten_curve_end *end)
{
	if (end->kind > BATTEN_END_CURVATURE)
		return batten_fail(curve->context, BATTEN_USAGE, "an end of a spline of no known kind");
	for (size_t c = 0; c < 3; c++)
		if (end->kind == BATTEN_END_CURVATURE && !isfinite(end->curvature_per_m[c]))
			return batten_fail(curve->context, BATTEN_USAGE,
			                   "the curvature at an end of a spline is not finite");
	return BATTEN_OK;
}

/* The curvature of an end depends on its tangent, which depends on the second derivative there: by
 * turns, each a fraction closer. */
static batten_status solve_splines(batten_curve *curve, const batten_curve_options *options,
                                   double *column)
{
	enum { TURNS_MOST = 200 };
	static const enum spline_end ends[] = { SPLINE_NATURAL, SPLINE_NOT_A_KNOT, SPLINE_CLAMPED,
		                                    SPLINE_BENT };
	struct spline_condition conditions[2][3] = { 0 };
	batten_status status = BATTEN_OK;
	for (size_t e = 0; e < 2 && status == BATTEN_OK; e++) {
		status = check_end(curve, &options->ends[e]);
		for (size_t c = 0; c < 3 && status == BATTEN_OK; c++)
			conditions[e][c].end = ends[options->ends[e].kind];
		if (status == BATTEN_OK && options->ends[e].kind == BATTEN_END_CLAMPED)
			status = clamp(curve, &options->ends[e], e == 0, conditions[e]);
	}
	double change = 1;
	for (int turn = 0;
	     turn < TURNS_MOST && change > 1e-14 && isfinite(change) && status == BATTEN_OK; turn++) {
		status = build_splines(curve, conditions, column);
		if (status == BATTEN_OK)
			change = update_bends(curve, options, conditions);
	}
	if (status == BATTEN_OK && !(change <= 1e-12))
		status = batten_fail(
			curve->context, BATTEN_INPUT,
			"no spline with the curvature asked for at an end was found: it is too "
			"large beside the distance of the points there");
	return status;
}

static batten_status make_splines(batten_curve *curve, const batten_curve_options *options)
{
	double *column = batten_allocate(curve->context, curve->count, sizeof *column);
	if (!column)
		return BATTEN_MEMORY;
	batten_status status = solve_splines(curve, options, column);
	batten_release(curve->context, column);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * B-splines
 * --------------------------------------------------------------------------------------------- */

/* The points as polygon, on the thesis's open uniform knots. */
static batten_status make_polygon(batten_curve *curve, size_t order)
{
	batten_status status = bspline_shape_check(curve->context, curve->label, order, curve->count);
	if (status != BATTEN_OK)
		return status;
	double *knots = batten_allocate(curve->context, curve->count + order, sizeof *knots);
	if (!knots)
		return BATTEN_MEMORY;
	bspline_knots_open(order, curve->count, knots);
	const struct bspline_curve_net net = { .order = order,
		                                   .count = curve->count,
		                                   .dimension = curve->dimension,
		                                   .knots = knots,
		                                   .poles = curve->points };
	status = bspline_curve_create(curve->context, &net, &curve->bspline);
	batten_release(curve->context, knots);
	curve->bspline_scale = 1;
	if (status == BATTEN_OK)
		curve_find_nearest(curve);
	return status;
}

/* The equations of the inner points for the inner poles; the end poles are the end points. */
static batten_status solve_poles(const batten_curve *curve, const double *parameters,
                                 const struct bspline_curve_net *net, double *poles)
{
	size_t order = net->order;
	size_t width = curve->dimension;
	struct least_squares system;
	batten_status status = least_squares_create(curve->context, net->count - 2, order, width,
	                                            &system);
	if (status != BATTEN_OK)
		return status;
	for (size_t i = 1; i + 1 < curve->count; i++) {
		double basis[BSPLINE_ORDER_MOST], row[BSPLINE_ORDER_MOST], right[3];
		size_t span = bspline_span(order, net->count, net->knots, parameters[i]);
		size_t first = span + 1 - order;
		size_t count = 0;
		bspline_basis(order, net->knots, span, parameters[i], basis);
		memcpy(right, curve->points + i * width, width * sizeof *right);
		for (size_t j = 0; j < order; j++) {
			size_t pole = first + j;
			bool held = pole == 0 || pole + 1 == net->count;
			if (!held)
				row[count++] = basis[j];
			for (size_t c = 0; held && c < width; c++)
				right[c] -= basis[j] * poles[pole * width + c];
		}
		if (count > 0)
			least_squares_add(&system, first > 0 ? first - 1 : 0, count, row, right);
	}
	if (!least_squares_solve(&system, poles + width))
		status = batten_fail(curve->context, BATTEN_INPUT,
		                     "%s: the points leave some of %zu poles free, or nearly so",
		                     curve->label, net->count);
	least_squares_destroy(&system);
	return status;
}

static batten_status fit_poles(batten_curve *curve, size_t order, size_t count, double *parameters,
                               double *knots, double *poles)
{
	size_t last = curve->count - 1;
	double first = curve->parameters[0];
	double range = curve->parameters[last] - first;
	for (size_t i = 0; i <= last; i++)
		parameters[i] = i == last ? 1 : (curve->parameters[i] - first) / range;
	curve->bspline_first = first;
	curve->bspline_scale = 1 / range;
	batten_status status = bspline_knots_spread(curve->context, order, count, curve->count,
	                                            parameters, knots);
	if (status != BATTEN_OK)
		return status;
	size_t bytes = curve->dimension * sizeof *poles;
	memcpy(poles, curve->points, bytes);
	memcpy(poles + (count - 1) * curve->dimension, curve->points + last * curve->dimension, bytes);
	const struct bspline_curve_net net = { .order = order,
		                                   .count = count,
		                                   .dimension = curve->dimension,
		                                   .knots = knots,
		                                   .poles = poles };
	if (count > 2)
		status = solve_poles(curve, parameters, &net, poles);
	return status == BATTEN_OK ? bspline_curve_create(curve->context, &net, &curve->bspline)
	                           : status;
}

/* Near the points by least squares (thesis 5.3). */
static batten_status make_fit(batten_curve *curve, const batten_curve_options *options)
{
	batten_context *context = curve->context;
	size_t order = options->order;
	size_t count = options->pole_count > 0 ? options->pole_count : curve->count;
	batten_status status = bspline_shape_check(context, curve->label, order, count);
	if (status == BATTEN_OK && count > curve->count)
		status = batten_fail(context, BATTEN_USAGE, "%s: found %zu poles, more than the %zu points",
		                     curve->label, count, curve->count);
	if (status != BATTEN_OK)
		return status;
	double *parameters = batten_allocate(context, curve->count, sizeof(double));
	double *knots = batten_allocate(context, count + order, sizeof(double));
	double *poles = batten_allocate(context, count * curve->dimension, sizeof(double));
	status = parameters && knots && poles ? fit_poles(curve, order, count, parameters, knots, poles)
	                                      : BATTEN_MEMORY;
	batten_release(context, parameters);
	batten_release(context, knots);
	batten_release(context, poles);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * Any of them
 * --------------------------------------------------------------------------------------------- */

static batten_status make_polynomial(batten_curve *curve, enum polynomial_basis basis, size_t order)
{
	if (basis == POLYNOMIAL_CHEBYSHEV && order < 1)
		return batten_fail(curve->context, BATTEN_USAGE, "%s: found order 0, expected 1 or more",
		                   curve->label);
	return polynomial_create(curve->context, basis, curve->count, curve->parameters,
	                         curve->dimension, curve->points, order - 1, &curve->polynomial);
}

static batten_status make_breaks(batten_curve *curve)
{
	const struct bspline_curve *bspline = &curve->bspline;
	bool knots = bspline->knots != NULL;
	size_t most = knots ? bspline->count + 1 : curve->count;
	curve->breaks = batten_allocate(curve->context, most, sizeof *curve->breaks);
	if (!curve->breaks)
		return BATTEN_MEMORY;
	if (!knots) {
		memcpy(curve->breaks, curve->parameters, most * sizeof *curve->breaks);
		curve->break_count = most;
		return BATTEN_OK;
	}
	for (size_t i = bspline->order - 1; i <= bspline->count; i++)
		if (i < bspline->order || bspline->knots[i] > bspline->knots[i - 1])
			curve->breaks[curve->break_count++] = curve->bspline_first +
			                                      bspline->knots[i] / curve->bspline_scale;
	return BATTEN_OK;
}

batten_status curve_forms_make(batten_curve *curve, const batten_curve_options *options)
{
	batten_status status = BATTEN_USAGE;
	switch (curve->form) {
	case BATTEN_CURVE_MONOMIAL:
		status = make_polynomial(curve, POLYNOMIAL_MONOMIAL, curve->count);
		break;
	case BATTEN_CURVE_LAGRANGE:
		status = make_polynomial(curve, POLYNOMIAL_LAGRANGE, curve->count);
		break;
	case BATTEN_CURVE_NEWTON:
		status = make_polynomial(curve, POLYNOMIAL_NEWTON, curve->count);
		break;
	case BATTEN_CURVE_LEAST_SQUARES:
		status = make_polynomial(curve, POLYNOMIAL_CHEBYSHEV, options->order);
		break;
	case BATTEN_CURVE_HERMITE:
		status = make_hermite(curve, options);
		break;
	case BATTEN_CURVE_SPLINE:
		status = make_splines(curve, options);
		break;
	case BATTEN_CURVE_BEZIER:
		status = make_polygon(curve, curve->count);
		break;
	case BATTEN_CURVE_BSPLINE:
		status = make_polygon(curve, options->order);
		break;
	case BATTEN_CURVE_BSPLINE_FIT:
		status = make_fit(curve, options);
		break;
	}
	return status == BATTEN_OK ? make_breaks(curve) : status;
}
