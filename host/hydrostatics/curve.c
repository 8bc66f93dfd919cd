#include "hydrostatics/curve.h"

#include <math.h>
#include <string.h>

enum { GAUSS_POINTS = 5 };

/* Gauss-Legendre, five points on [-1, 1]: exact to the ninth power, so for the cube of a cubic. */
static const double gauss_at[GAUSS_POINTS] = { -0.90617984593866399280, -0.53846931010568309104, 0,
	                                           0.53846931010568309104, 0.90617984593866399280 };
static const double gauss_weight[GAUSS_POINTS] = { 0.23692688505618908751, 0.47862867049936646804,
	                                               0.56888888888888888889, 0.47862867049936646804,
	                                               0.23692688505618908751 };

/* Equal intervals are equal to this part of themselves. */
static const double spacing_tolerance = 1e-6;

static batten_status add_piece(curve *line, size_t first, size_t last, enum spline_end ends)
{
	if (last == first)
		return BATTEN_OK;
	batten_status status = spline_create(line->context, last - first + 1, line->at + first,
	                                     line->value + first, ends,
	                                     &line->pieces[line->piece_count]);
	if (status == BATTEN_OK)
		line->piece_count++;
	return status;
}

static batten_status add_pieces(curve *line, const unsigned char *breaks, enum spline_end ends)
{
	batten_status status = BATTEN_OK;
	size_t first = 0;
	for (size_t i = 0; breaks && i + 1 < line->count && status == BATTEN_OK; i++) {
		if (i > first && (breaks[i] & (CURVE_BREAK_AT | CURVE_BREAK_AFTER))) {
			status = add_piece(line, first, i, ends);
			first = i;
		}
		if (status == BATTEN_OK && (breaks[i] & CURVE_BREAK_AFTER)) {
			status = add_piece(line, i, i + 1, ends);
			first = i + 1;
		}
	}
	return status == BATTEN_OK ? add_piece(line, first, line->count - 1, ends) : status;
}

batten_status curve_create(batten_context *context, size_t count, const double *at,
                           const double *value, const unsigned char *breaks, enum spline_end ends,
                           curve *out)
{
	curve line = { .context = context, .count = count };
	batten_status status = BATTEN_MEMORY;
	line.at = batten_allocate(context, count, sizeof *line.at);
	line.value = batten_allocate(context, count, sizeof *line.value);
	line.pieces = batten_allocate(context, count, sizeof *line.pieces);
	if (line.at && line.value && line.pieces) {
		memcpy(line.at, at, count * sizeof *at);
		memcpy(line.value, value, count * sizeof *value);
		status = add_pieces(&line, breaks, ends);
	}
	if (status != BATTEN_OK) {
		curve_destroy(&line);
		return status;
	}
	*out = line;
	return BATTEN_OK;
}

void curve_destroy(curve *line)
{
	if (!line->context)
		return;
	for (size_t i = 0; i < line->piece_count; i++)
		spline_destroy(&line->pieces[i]);
	batten_release(line->context, line->pieces);
	batten_release(line->context, line->value);
	batten_release(line->context, line->at);
	*line = (curve){ 0 };
}

static const struct spline *piece_at(const curve *line, double at)
{
	size_t low = 0, high = line->piece_count - 1;
	while (low < high) {
		size_t middle = low + (high - low) / 2;
		const struct spline *piece = &line->pieces[middle];
		if (at > piece->x[piece->count - 1])
			low = middle + 1;
		else
			high = middle;
	}
	return &line->pieces[low];
}

double curve_value(const curve *line, double at)
{
	return line->piece_count > 0 ? spline_value(piece_at(line, at), at) : line->value[0];
}

double curve_slope(const curve *line, double at)
{
	return line->piece_count > 0 ? spline_slope(piece_at(line, at), at) : 0;
}

/* Number of the interval at lies in; the first or last one beyond the ends. count >= 2. */
static size_t interval_at(const curve *line, double at)
{
	size_t low = 0, high = line->count - 2;
	while (low < high) {
		size_t middle = low + (high - low + 1) / 2;
		if (line->at[middle] <= at)
			low = middle;
		else
			high = middle - 1;
	}
	return low;
}

double curve_value_straight(const curve *line, double at)
{
	if (line->count < 2)
		return line->value[0];
	size_t i = interval_at(line, at);
	double part = (at - line->at[i]) / (line->at[i + 1] - line->at[i]);
	return line->value[i] + part * (line->value[i + 1] - line->value[i]);
}

static void add_node(curve_nodes *nodes, double at, double weight, double value)
{
	nodes->at[nodes->count] = at;
	nodes->weight[nodes->count] = weight;
	nodes->value[nodes->count] = value;
	nodes->count++;
}

static void spline_nodes(const curve *line, double from, double to, curve_nodes *nodes)
{
	for (size_t i = interval_at(line, from); i + 1 < line->count && line->at[i] < to; i++) {
		double a = fmax(from, line->at[i]), b = fmin(to, line->at[i + 1]);
		double half = 0.5 * (b - a), middle = 0.5 * (a + b);
		for (size_t k = 0; k < GAUSS_POINTS && half > 0; k++) {
			double at = middle + half * gauss_at[k];
			add_node(nodes, at, half * gauss_weight[k], curve_value(line, at));
		}
	}
}

static void trapezoid_nodes(const curve *line, double from, double to, curve_nodes *nodes)
{
	add_node(nodes, from, 0, curve_value_straight(line, from));
	for (size_t i = interval_at(line, from) + 1; i < line->count && line->at[i] < to; i++)
		add_node(nodes, line->at[i], 0, line->value[i]);
	add_node(nodes, to, 0, curve_value_straight(line, to));
	for (size_t i = 0; i + 1 < nodes->count; i++) {
		double half = 0.5 * (nodes->at[i + 1] - nodes->at[i]);
		nodes->weight[i] += half;
		nodes->weight[i + 1] += half;
	}
}

/* No jump of the slope between the points of a parabola: knuckles stand at every second point only. */
static batten_status check_knuckles(const curve *line, size_t first, size_t last, const char *what,
                                    double coordinate)
{
	size_t point = 0;
	for (size_t k = 0; k + 1 < line->piece_count; k++) {
		point += line->pieces[k].count - 1; /* where the next piece begins */
		if (point > first && point < last && (point - first) % 2 != 0)
			return batten_fail(line->context, BATTEN_INPUT,
			                   "%s %g m: Simpson's rule needs an even number of intervals before "
			                   "the knuckle at %g m, found %zu",
			                   what, coordinate, line->at[point], point - first);
	}
	return BATTEN_OK;
}

/* The points first..last are from and to and have equal intervals, an even number of them. */
static batten_status check_simpson(const curve *line, double from, double to, size_t first,
                                   size_t last, const char *what, double coordinate)
{
	double near = spacing_tolerance * (to - from) / (double)line->count;
	if (fabs(line->at[first] - from) > near || fabs(line->at[last] - to) > near)
		return batten_fail(line->context, BATTEN_INPUT,
		                   "%s %g m: Simpson's rule needs a point at each end of %g..%g m", what,
		                   coordinate, from, to);
	double step = (to - from) / (double)(last - first);
	for (size_t i = first; i < last; i++)
		if (fabs(line->at[i + 1] - line->at[i] - step) > spacing_tolerance * step)
			return batten_fail(line->context, BATTEN_INPUT,
			                   "%s %g m: Simpson's rule needs equal intervals, found %g m after "
			                   "%g m where %g m is expected",
			                   what, coordinate, line->at[i + 1] - line->at[i], line->at[i], step);
	if ((last - first) % 2 != 0)
		return batten_fail(line->context, BATTEN_INPUT,
		                   "%s %g m: Simpson's rule needs an even number of intervals, found %zu",
		                   what, coordinate, last - first);
	return check_knuckles(line, first, last, what, coordinate);
}

static batten_status simpson_nodes(const curve *line, double from, double to, const char *what,
                                   double coordinate, curve_nodes *nodes)
{
	size_t first = interval_at(line, from), last = interval_at(line, to);
	/* rounding may put an end that is a point into the interval before it */
	if (line->at[first + 1] - from < from - line->at[first])
		first++;
	if (last + 1 < line->count && line->at[last + 1] - to < to - line->at[last])
		last++;
	if (last <= first)
		return BATTEN_OK;
	batten_status status = check_simpson(line, from, to, first, last, what, coordinate);
	double third = (to - from) / (double)(last - first) / 3;
	for (size_t i = first; i <= last && status == BATTEN_OK; i++) {
		double factor = i == first || i == last ? 1 : (i - first) % 2 != 0 ? 4 : 2;
		add_node(nodes, line->at[i], factor * third, line->value[i]);
	}
	return status;
}

batten_status curve_quadrature(const curve *line, batten_quadrature rule, double from, double to,
                               const char *what, double coordinate, curve_nodes *out)
{
	batten_context *context = line->context;
	curve_nodes nodes = { 0 };
	size_t most = rule == BATTEN_QUADRATURE_SPLINE ? GAUSS_POINTS * line->count : line->count + 2;
	nodes.at = batten_allocate(context, most, sizeof *nodes.at);
	nodes.weight = batten_allocate(context, most, sizeof *nodes.weight);
	nodes.value = batten_allocate(context, most, sizeof *nodes.value);
	batten_status status = nodes.at && nodes.weight && nodes.value ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK && line->count >= 2 && to > from) {
		if (rule == BATTEN_QUADRATURE_SPLINE)
			spline_nodes(line, from, to, &nodes);
		else if (rule == BATTEN_QUADRATURE_TRAPEZOID)
			trapezoid_nodes(line, from, to, &nodes);
		else
			status = simpson_nodes(line, from, to, what, coordinate, &nodes);
	}
	if (status != BATTEN_OK) {
		curve_nodes_release(context, &nodes);
		return status;
	}
	*out = nodes;
	return BATTEN_OK;
}

void curve_nodes_release(batten_context *context, curve_nodes *nodes)
{
	batten_release(context, nodes->at);
	batten_release(context, nodes->weight);
	batten_release(context, nodes->value);
	*nodes = (curve_nodes){ 0 };
}

double curve_nodes_moment(const curve_nodes *nodes, int power)
{
	double sum = 0;
	for (size_t i = 0; i < nodes->count; i++) {
		double term = nodes->weight[i] * nodes->value[i];
		for (int k = 0; k < power; k++)
			term *= nodes->at[i];
		sum += term;
	}
	return sum;
}

double curve_nodes_cube(const curve_nodes *nodes)
{
	double sum = 0;
	for (size_t i = 0; i < nodes->count; i++)
		sum += nodes->weight[i] * (nodes->value[i] * nodes->value[i] * nodes->value[i]);
	return sum;
}
