#include "geometry/curve.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------------------------------------
 * Points and derivatives
 * --------------------------------------------------------------------------------------------- */

/* The cubic between two points with their slopes, in powers of s = t - t0. */
static void hermite_derivatives(const batten_curve *curve, double t, double out[4][3])
{
	size_t low = 0;
	size_t high = curve->count - 1;
	while (high - low > 1) {
		size_t middle = low + (high - low) / 2;
		if (curve->parameters[middle] <= t)
			low = middle;
		else
			high = middle;
	}
	double step = curve->parameters[low + 1] - curve->parameters[low];
	double s = t - curve->parameters[low];
	for (size_t c = 0; c < curve->dimension; c++) {
		const double *p = curve->points + low * curve->dimension + c;
		const double *m = curve->slopes + low * curve->dimension + c;
		double chord = (p[curve->dimension] - p[0]) / step;
		double second = (3 * chord - 2 * m[0] - m[curve->dimension]) / step;
		double third = (m[0] + m[curve->dimension] - 2 * chord) / (step * step);
		out[0][c] = p[0] + s * (m[0] + s * (second + s * third));
		out[1][c] = m[0] + s * (2 * second + 3 * s * third);
		out[2][c] = 2 * second + 6 * s * third;
		out[3][c] = 6 * third;
		if (t == curve->parameters[low + 1])
			out[0][c] = p[curve->dimension];
	}
}

static void spline_curve_derivatives(const batten_curve *curve, double t, double out[4][3])
{
	for (size_t c = 0; c < curve->dimension; c++) {
		double values[SPLINE_DERIVATIVES];
		spline_derivatives(&curve->splines[c], t, values);
		for (size_t d = 0; d < 4; d++)
			out[d][c] = values[d];
	}
}

static void bspline_derivatives(const batten_curve *curve, double t, double out[4][3])
{
	double values[4 * 3];
	double factor = 1;
	bspline_curve_evaluate(&curve->bspline, (t - curve->bspline_first) * curve->bspline_scale, 3,
	                       values);
	for (size_t d = 0; d < 4; d++, factor *= curve->bspline_scale)
		for (size_t c = 0; c < curve->dimension; c++)
			out[d][c] = factor * values[d * curve->dimension + c];
}

void curve_derivatives(const batten_curve *curve, double t, double out[4][3])
{
	memset(out, 0, 4 * sizeof *out);
	if (curve->polynomial.coefficients)
		polynomial_evaluate(&curve->polynomial, t, out);
	else if (curve->slopes)
		hermite_derivatives(curve, t, out);
	else if (curve->bspline.knots)
		bspline_derivatives(curve, t, out);
	else
		spline_curve_derivatives(curve, t, out);
	if (curve->by_x)
		for (size_t d = 0; d < 4; d++)
			out[d][0] = d == 0 ? t : d == 1 ? 1 : 0;
}

/* ------------------------------------------------------------------------------------------------
 * Frame, curvature, torsion
 * --------------------------------------------------------------------------------------------- */

/* A slower place has no tangent; a curvature below has no direction (part of 1 / size). */
static const double slow_part = 1e-12;
static const double straight_part = 1e-9;

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

/* turn = c' x c'', turn_rate = c' x c''' is its derivative. */
static void plane_frame(batten_curve_point *point, double turn, double turn_rate, double along)
{
	double speed = point->speed;
	double cube = speed * speed * speed;
	point->normal[0] = -point->tangent[1];
	point->normal[1] = point->tangent[0];
	point->binormal[2] = 1;
	point->curvature_per_m = turn / cube;
	point->curvature_rate_per_m2 = (turn_rate - 3 * turn * along / (speed * speed)) /
	                               (cube * speed);
}

static void space_frame(const batten_curve *curve, batten_curve_point *point, const double turn[3],
                        const double turn_rate[3], double along)
{
	double speed = point->speed;
	double cube = speed * speed * speed;
	double size = sqrt(dot(turn, turn));
	point->curvature_per_m = size / cube;
	if (!(point->curvature_per_m * curve->size > straight_part)) {
		point->curvature_rate_per_m2 = sqrt(dot(turn_rate, turn_rate)) / (cube * speed);
		return;
	}
	for (size_t c = 0; c < 3; c++)
		point->binormal[c] = turn[c] / size;
	cross(point->binormal, point->tangent, point->normal);
	double rate = dot(point->binormal, turn_rate);
	point->curvature_rate_per_m2 = (rate - 3 * size * along / (speed * speed)) / (cube * speed);
	point->torsion_per_m = dot(turn, point->derivative[3]) / (size * size);
}

void curve_frame(const batten_curve *curve, batten_curve_point *point)
{
	const double *first = point->derivative[1];
	const double *second = point->derivative[2];
	double turn[3], turn_rate[3];
	point->speed = sqrt(dot(first, first));
	point->regular = point->speed > slow_part * curve->mean_speed;
	if (!point->regular)
		return;
	for (size_t c = 0; c < 3; c++)
		point->tangent[c] = first[c] / point->speed;
	cross(first, second, turn);
	cross(first, point->derivative[3], turn_rate);
	double along = dot(first, second);
	if (curve->dimension == 2)
		plane_frame(point, turn[2], turn_rate[2], along);
	else
		space_frame(curve, point, turn, turn_rate, along);
}

batten_status batten_curve_evaluate(const batten_curve *curve, double t, batten_curve_point *out)
{
	if (!isfinite(t))
		return batten_fail(curve->context, BATTEN_USAGE, "the parameter of a curve is not finite");
	*out = (batten_curve_point){ .t = t };
	curve_derivatives(curve, t, out->derivative);
	curve_frame(curve, out);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * The given points
 * --------------------------------------------------------------------------------------------- */

double curve_find_largest(const batten_curve *curve, double low, double high, curve_value_at *value,
                          const void *data)
{
	/* Golden section: each step leaves 0.618 of the bracket. */
	const double golden = 0.61803398874989484820;
	double left = high - golden * (high - low);
	double right = low + golden * (high - low);
	double at_left = value(curve, left, data);
	double at_right = value(curve, right, data);
	for (int step = 0; step < 60; step++) {
		if (at_left < at_right) {
			low = left;
			left = right;
			at_left = at_right;
			right = low + golden * (high - low);
			at_right = value(curve, right, data);
		} else {
			high = right;
			right = left;
			at_right = at_left;
			left = high - golden * (high - low);
			at_left = value(curve, left, data);
		}
	}
	return at_left < at_right ? right : left;
}

static double distance(const batten_curve *curve, const double *point, const double *at)
{
	double square = 0;
	for (size_t c = 0; c < curve->dimension; c++)
		square += (at[c] - point[c]) * (at[c] - point[c]);
	return sqrt(square);
}

static double nearness(const batten_curve *curve, double t, const void *data)
{
	double values[4][3];
	curve_derivatives(curve, t, values);
	return -distance(curve, data, values[0]);
}

void curve_find_nearest(batten_curve *curve)
{
	enum { SAMPLES = 64 };
	const struct bspline_curve *bspline = &curve->bspline;
	for (size_t i = 0; i < curve->count; i++) {
		/* The part of the curve that the pole governs. */
		const double *point = curve->points + i * curve->dimension;
		double low = bspline->knots[i];
		double high = bspline->knots[i + bspline->order];
		double step = (high - low) / SAMPLES;
		double best = low;
		for (size_t k = 1; k <= SAMPLES; k++)
			if (nearness(curve, low + (double)k * step, point) > nearness(curve, best, point))
				best = low + (double)k * step;
		double found = curve_find_largest(curve, fmax(low, best - step), fmin(high, best + step),
		                                  nearness, point);
		curve->parameters[i] = nearness(curve, found, point) > nearness(curve, best, point) ? found
		                                                                                    : best;
	}
}

void batten_curve_data(const batten_curve *curve, batten_curve_datum *data)
{
	for (size_t i = 0; i < curve->count; i++) {
		data[i] = (batten_curve_datum){ .at.t = curve->parameters[i] };
		curve_derivatives(curve, curve->parameters[i], data[i].at.derivative);
		curve_frame(curve, &data[i].at);
		data[i].deviation_m = distance(curve, curve->points + i * curve->dimension,
		                               data[i].at.derivative[0]);
	}
}
