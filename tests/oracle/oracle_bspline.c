/* Points and derivatives of B-spline curves and surfaces, by de Boor's recursion over the control
 * points that reach a span. */
#include "oracle_bspline.h"

#include "oracle_internal.h"

#include <math.h>

enum { POLES = ORACLE_ORDER_MOST, KNOTS = 2 * ORACLE_ORDER_MOST - 2 };

/* Part of a homogeneous curve: the control points that reach one span, and their knots. */
typedef struct polygon {
	size_t order;
	long double knot[KNOTS];    /* 2 order - 2 */
	long double pole[POLES][4]; /* order; w x, w y, w z, w */
} polygon;

static bool basis_is_valid(size_t order, size_t count, const double *knots)
{
	if (order < 2 || order > ORACLE_ORDER_MOST || count < order)
		return false;
	for (size_t i = 0; i < count + order; i++)
		if (!isfinite(knots[i]) || (i > 0 && knots[i] < knots[i - 1]))
			return false;
	return knots[order - 1] < knots[count];
}

/* The span of t, numbered by the knot at its beginning. */
static size_t find_span(size_t order, size_t count, const double *knots, long double t)
{
	size_t span = order - 1;
	while (!(knots[span] < knots[span + 1]))
		span++;
	for (size_t i = span + 1; i < count && knots[i] <= t; i++)
		if (knots[i] < knots[i + 1])
			span = i;
	return span;
}

static void take_knots(polygon *p, size_t order, const double *knots, size_t span)
{
	p->order = order;
	for (size_t i = 0; i < 2 * order - 2; i++)
		p->knot[i] = knots[span + 2 - order + i];
}

/* The polygon of the derivative: order - 1, its points the differences of the points over their
 * knots. magnitude: the sum of the absolute values in place of the difference. */
static void differentiate(polygon *p, bool magnitude)
{
	size_t degree = p->order - 1;
	for (size_t i = 0; i < degree; i++) {
		long double scale = (long double)degree / (p->knot[degree + i] - p->knot[i]);
		for (size_t c = 0; c < 4; c++) {
			long double a = p->pole[i][c], b = p->pole[i + 1][c];
			p->pole[i][c] = scale * (magnitude ? fabsl(a) + fabsl(b) : b - a);
		}
	}
	p->order = degree;
	for (size_t i = 0; degree > 0 && i < 2 * degree - 2; i++)
		p->knot[i] = p->knot[i + 1];
}

/* Point `derivative` times differentiated, by corner cutting. */
static void cut_corners(polygon p, long double t, size_t derivative, bool magnitude,
                        long double out[4])
{
	for (size_t c = 0; c < 4; c++)
		out[c] = 0;
	if (derivative >= p.order)
		return;
	for (size_t d = 0; d < derivative; d++)
		differentiate(&p, magnitude);
	for (size_t round = 1; round < p.order; round++) {
		for (size_t i = p.order - 1; i >= round; i--) {
			long double left = p.knot[i - 1], right = p.knot[i - 1 + p.order - round];
			long double part = (t - left) / (right - left);
			for (size_t c = 0; c < 4; c++) {
				long double a = (1 - part) * p.pole[i - 1][c], b = part * p.pole[i][c];
				p.pole[i][c] = magnitude ? fabsl(a) + fabsl(b) : a + b;
			}
		}
	}
	for (size_t c = 0; c < 4; c++)
		out[c] = p.pole[p.order - 1][c];
}

static void lift(const double *point, size_t dimension, const double *weight, long double out[4])
{
	out[3] = weight ? *weight : 1;
	for (size_t c = 0; c < 3; c++)
		out[c] = c < dimension ? out[3] * point[c] : 0;
}

static long double factorial(size_t n)
{
	return n < 2 ? 1 : (long double)n * factorial(n - 1);
}

/* Derivatives of (x, y, z) from those of (w x, w y, w z, w): as power series about the point, the
 * first three divided by the fourth. magnitude: every term counts as positive. */
static bool divide(long double series[ORACLE_ORDERS][ORACLE_ORDERS][4], bool magnitude,
                   oracle_jet out)
{
	long double sign = magnitude ? 1 : -1;
	if (!(fabsl(series[0][0][3]) > 0))
		return false;
	for (size_t a = 0; a < ORACLE_ORDERS; a++)
		for (size_t b = 0; b < ORACLE_ORDERS; b++)
			for (size_t c = 0; c < 4; c++)
				series[a][b][c] /= factorial(a) * factorial(b);
	for (size_t a = 0; a < ORACLE_ORDERS; a++) {
		for (size_t b = 0; b < ORACLE_ORDERS; b++) {
			for (size_t c = 0; c < 3; c++) {
				long double rest = a + b < ORACLE_ORDERS ? series[a][b][c] : 0;
				for (size_t i = 0; i <= a && a + b < ORACLE_ORDERS; i++)
					for (size_t j = 0; j <= b; j++)
						if (i + j > 0)
							rest += sign * series[i][j][3] * out[a - i][b - j][c];
				out[a][b][c] = rest / series[0][0][3];
			}
		}
	}
	for (size_t a = 0; a < ORACLE_ORDERS; a++)
		for (size_t b = 0; b < ORACLE_ORDERS; b++)
			for (size_t c = 0; c < 3; c++)
				out[a][b][c] *= factorial(a) * factorial(b);
	return true;
}

bool oracle_curve_at(const oracle_curve *curve, long double t,
                     long double derivative[ORACLE_ORDERS][3])
{
	if (curve->dimension < 1 || curve->dimension > 3 ||
	    !basis_is_valid(curve->order, curve->count, curve->knots))
		return false;
	polygon p;
	size_t span = find_span(curve->order, curve->count, curve->knots, t);
	take_knots(&p, curve->order, curve->knots, span);
	for (size_t i = 0; i < curve->order; i++) {
		size_t pole = span + 1 - curve->order + i;
		lift(&curve->poles[pole * curve->dimension], curve->dimension,
		     curve->weights ? &curve->weights[pole] : NULL, p.pole[i]);
	}
	long double series[ORACLE_ORDERS][ORACLE_ORDERS][4] = { 0 };
	for (size_t a = 0; a < ORACLE_ORDERS; a++)
		cut_corners(p, t, a, false, series[a][0]);
	oracle_jet jet;
	if (!divide(series, false, jet))
		return false;
	for (size_t a = 0; a < ORACLE_ORDERS; a++)
		for (size_t c = 0; c < 3; c++)
			derivative[a][c] = jet[a][0][c];
	return true;
}

/* One homogeneous derivative: every row of the net along u, then the column of what came out. */
static void surface_term(const oracle_surface *s, const size_t span[2], const long double at[2],
                         const size_t derivative[2], bool magnitude, long double out[4])
{
	polygon row, column;
	take_knots(&row, s->order_u, s->knots_u, span[0]);
	take_knots(&column, s->order_v, s->knots_v, span[1]);
	for (size_t j = 0; j < s->order_v; j++) {
		size_t first = (span[1] + 1 - s->order_v + j) * s->count_u + span[0] + 1 - s->order_u;
		for (size_t i = 0; i < s->order_u; i++) {
			size_t pole = first + i;
			lift(&s->poles[pole * 3], 3, s->weights ? &s->weights[pole] : NULL, row.pole[i]);
		}
		cut_corners(row, at[0], derivative[0], magnitude, column.pole[j]);
	}
	cut_corners(column, at[1], derivative[1], magnitude, out);
}

static bool jet_in_span(const oracle_surface *surface, const size_t span[2],
                        const long double at[2], bool magnitude, oracle_jet out)
{
	long double series[ORACLE_ORDERS][ORACLE_ORDERS][4] = { 0 };
	for (size_t a = 0; a < ORACLE_ORDERS; a++)
		for (size_t b = 0; a + b < ORACLE_ORDERS; b++)
			surface_term(surface, span, at, (size_t[2]){ a, b }, magnitude, series[a][b]);
	return divide(series, magnitude, out);
}

bool oracle_surface_spans(const oracle_surface *s, long double u, long double v, size_t span[2])
{
	if (!basis_is_valid(s->order_u, s->count_u, s->knots_u) ||
	    !basis_is_valid(s->order_v, s->count_v, s->knots_v))
		return false;
	span[0] = find_span(s->order_u, s->count_u, s->knots_u, u);
	span[1] = find_span(s->order_v, s->count_v, s->knots_v, v);
	return true;
}

bool oracle_surface_in_span(const oracle_surface *surface, const size_t span[2], long double u,
                            long double v, oracle_jet derivative)
{
	return jet_in_span(surface, span, (long double[2]){ u, v }, false, derivative);
}

bool oracle_surface_at(const oracle_surface *surface, long double u, long double v,
                       oracle_jet derivative)
{
	size_t span[2];
	return oracle_surface_spans(surface, u, v, span) &&
	       oracle_surface_in_span(surface, span, u, v, derivative);
}

bool oracle_surface_magnitude(const oracle_surface *surface, long double u, long double v,
                              oracle_jet magnitude)
{
	size_t span[2];
	return oracle_surface_spans(surface, u, v, span) &&
	       jet_in_span(surface, span, (long double[2]){ u, v }, true, magnitude);
}
