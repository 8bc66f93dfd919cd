#include "geometry/bspline.h"

#include <math.h>
#include <string.h>

/* Knots are at most this large, their range is no smaller than this part of them, and two knots
 * that differ do so by this part of the range: no derivative of a basis function then overflows. */
#define KNOT_LARGEST 1e9
#define RANGE_PART 1e-3
#define SPAN_PART 1e-9

/* ------------------------------------------------------------------------------------------------
 * Checks
 * --------------------------------------------------------------------------------------------- */

batten_status bspline_shape_check(batten_context *context, const char *what, size_t order,
                                  size_t count)
{
	if (order < BSPLINE_ORDER_LEAST || order > BSPLINE_ORDER_MOST)
		return batten_fail(context, BATTEN_USAGE, "%s: found order %zu, expected %d..%d", what,
		                   order, (int)BSPLINE_ORDER_LEAST, (int)BSPLINE_ORDER_MOST);
	if (count < order)
		return batten_fail(context, BATTEN_USAGE,
		                   "%s: found %zu poles, order %zu needs at least as many", what, count,
		                   order);
	if (count > BSPLINE_POLES_MOST)
		return batten_fail(context, BATTEN_USAGE, "%s: found %zu poles, expected at most %d", what,
		                   count, (int)BSPLINE_POLES_MOST);
	return BATTEN_OK;
}

static batten_status check_values(batten_context *context, const char *what, size_t total,
                                  const double *knots)
{
	for (size_t i = 0; i < total; i++) {
		if (!isfinite(knots[i]) || fabs(knots[i]) > KNOT_LARGEST)
			return batten_fail(context, BATTEN_USAGE, "%s: knot %zu is not finite or beyond %g",
			                   what, i + 1, KNOT_LARGEST);
		if (i > 0 && knots[i] < knots[i - 1])
			return batten_fail(context, BATTEN_USAGE, "%s: knot %zu (%g) is below the one before",
			                   what, i + 1, knots[i]);
	}
	return BATTEN_OK;
}

/* The range is not empty, and neither are its first and last spans: a pole that no point depends
 * on, and a knot repeated more often than the order, are both caught by that. */
static batten_status check_range(batten_context *context, const char *what, size_t order,
                                 size_t count, const double *knots)
{
	double first = knots[order - 1];
	double last = knots[count];
	double largest = fmax(fabs(knots[0]), fabs(knots[count + order - 1]));
	if (!(last > first) || last - first < RANGE_PART * largest)
		return batten_fail(context, BATTEN_USAGE,
		                   "%s: the range of the parameter, knot %zu to knot %zu, is empty or too "
		                   "small beside its knots",
		                   what, order, count + 1);
	if (!(knots[order] > first))
		return batten_fail(context, BATTEN_USAGE,
		                   "%s: knot %g begins the range and occurs beyond place %zu too", what,
		                   first, order);
	if (!(knots[count - 1] < last))
		return batten_fail(context, BATTEN_USAGE,
		                   "%s: knot %g ends the range and occurs before place %zu too", what, last,
		                   count + 1);
	return BATTEN_OK;
}

static batten_status check_spans(batten_context *context, const char *what, size_t order,
                                 size_t count, const double *knots)
{
	double least = SPAN_PART * (knots[count] - knots[order - 1]);
	size_t times = 1;
	for (size_t i = 1; i < count + order; i++) {
		times = knots[i] > knots[i - 1] ? 1 : times + 1;
		if (times == 1 && knots[i] - knots[i - 1] < least)
			return batten_fail(context, BATTEN_USAGE,
			                   "%s: knots %zu and %zu differ by less than %g of the range", what, i,
			                   i + 1, SPAN_PART);
		bool inside = knots[i] > knots[order - 1] && knots[i] < knots[count];
		size_t most = inside ? order - 1 : order;
		if (times > most)
			return batten_fail(context, BATTEN_USAGE,
			                   "%s: knot %g occurs more than %zu times, the most at order %zu",
			                   what, knots[i], most, order);
	}
	return BATTEN_OK;
}

batten_status bspline_knots_check(batten_context *context, const char *what, size_t order,
                                  size_t count, const double *knots)
{
	batten_status status = bspline_shape_check(context, what, order, count);
	if (status == BATTEN_OK)
		status = check_values(context, what, count + order, knots);
	if (status == BATTEN_OK)
		status = check_range(context, what, order, count, knots);
	if (status == BATTEN_OK)
		status = check_spans(context, what, order, count, knots);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * Uniform
 * --------------------------------------------------------------------------------------------- */

void bspline_knots_open(size_t order, size_t count, double *knots)
{
	for (size_t i = 0; i < count + order; i++) {
		if (i < order)
			knots[i] = 0;
		else
			knots[i] = (double)((i < count ? i : count) - order + 1);
	}
}

void bspline_knots_clamped(size_t order, size_t count, double *knots)
{
	bspline_knots_open(order, count, knots);
	double spans = (double)(count - order + 1);
	for (size_t i = 0; i < count + order; i++)
		knots[i] /= spans;
}

void bspline_knots_greville(size_t order, size_t count, const double *knots, double *places)
{
	for (size_t i = 0; i < count; i++) {
		double sum = 0;
		for (size_t j = i + 1; j < i + order; j++)
			sum += knots[j];
		places[i] = sum / (double)(order - 1);
	}
}

/* ------------------------------------------------------------------------------------------------
 * From the points
 * --------------------------------------------------------------------------------------------- */

static double distance(size_t dimension, const double *a, const double *b)
{
	double sum = 0;
	for (size_t i = 0; i < dimension; i++)
		sum += (b[i] - a[i]) * (b[i] - a[i]);
	return sqrt(sum);
}

batten_status bspline_parameters_chord(batten_context *context, size_t count, size_t dimension,
                                       const double *points, double *parameters)
{
	if (count < 2)
		return batten_fail(context, BATTEN_USAGE, "a chord needs two points, found %zu", count);
	double length = 0;
	for (size_t i = 1; i < count; i++)
		length += distance(dimension, points + (i - 1) * dimension, points + i * dimension);
	if (!isfinite(length))
		return batten_fail(context, BATTEN_USAGE, "a point of a curve is not finite");
	if (!(length > 0))
		return batten_fail(context, BATTEN_USAGE, "all points of a curve are in one place");
	double along = 0;
	parameters[0] = 0;
	for (size_t i = 1; i < count; i++) {
		along += distance(dimension, points + (i - 1) * dimension, points + i * dimension);
		parameters[i] = along / length;
	}
	return BATTEN_OK;
}

static batten_status check_parameters(batten_context *context, size_t count,
                                      const double *parameters, bool apart)
{
	for (size_t i = 0; i < count; i++) {
		if (!isfinite(parameters[i]))
			return batten_fail(context, BATTEN_USAGE, "parameter %zu is not finite", i + 1);
		if (i > 0 &&
		    (apart ? !(parameters[i] > parameters[i - 1]) : parameters[i] < parameters[i - 1]))
			return batten_fail(context, BATTEN_USAGE,
			                   "parameter %zu (%g) is not beyond the one before", i + 1,
			                   parameters[i]);
	}
	return BATTEN_OK;
}

/* The first and the last knot, order times each. */
static void clamp_ends(size_t order, size_t count, double first, double last, double *knots)
{
	for (size_t i = 0; i < order; i++) {
		knots[i] = first;
		knots[count + i] = last;
	}
}

batten_status bspline_knots_averaged(batten_context *context, size_t order, size_t count,
                                     const double *parameters, double *knots)
{
	batten_status status = bspline_shape_check(context, "knots", order, count);
	if (status == BATTEN_OK)
		status = check_parameters(context, count, parameters, true);
	if (status != BATTEN_OK)
		return status;
	clamp_ends(order, count, parameters[0], parameters[count - 1], knots);
	for (size_t i = 1; i + order <= count; i++) {
		double sum = 0;
		for (size_t j = i; j < i + order - 1; j++)
			sum += parameters[j];
		knots[i + order - 1] = sum / (double)(order - 1);
	}
	return bspline_knots_check(context, "knots", order, count, knots);
}

batten_status bspline_knots_spread(batten_context *context, size_t order, size_t count,
                                   size_t parameter_count, const double *parameters, double *knots)
{
	if (parameter_count == count)
		return bspline_knots_averaged(context, order, count, parameters, knots);
	batten_status status = bspline_shape_check(context, "knots", order, count);
	if (status == BATTEN_OK && parameter_count < count)
		status = batten_fail(context, BATTEN_USAGE, "found %zu parameters, %zu poles need as many",
		                     parameter_count, count);
	if (status == BATTEN_OK)
		status = check_parameters(context, parameter_count, parameters, false);
	if (status != BATTEN_OK)
		return status;
	clamp_ends(order, count, parameters[0], parameters[parameter_count - 1], knots);
	double step = (double)(parameter_count - 1) / (double)(count - order + 1);
	for (size_t i = 1; i + order <= count; i++) {
		double place = (double)i * step;
		size_t whole = (size_t)place;
		double part = place - (double)whole;
		knots[i + order - 1] = (1 - part) * parameters[whole] + part * parameters[whole + 1];
	}
	return bspline_knots_check(context, "knots", order, count, knots);
}
