#include "core/spline.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------------------------------------
 * Second derivatives at the points
 * --------------------------------------------------------------------------------------------- */

/* One tridiagonal row: below * M[i-1] + diagonal * M[i] + above * M[i+1] = right. */
struct row {
	double below, diagonal, above, right;
};

static double chord_slope(const struct spline *spline, size_t i)
{
	return (spline->y[i + 1] - spline->y[i]) / (spline->x[i + 1] - spline->x[i]);
}

static double width(const struct spline *spline, size_t i)
{
	return spline->x[i + 1] - spline->x[i];
}

/* Continuity of the slope at an inner point. */
static struct row inner_row(const struct spline *spline, size_t i)
{
	double before = width(spline, i - 1);
	double after = width(spline, i);
	return (struct row){ before, 2 * (before + after), after,
		                 6 * (chord_slope(spline, i) - chord_slope(spline, i - 1)) };
}

/* The not-a-knot condition put into the row of the second (or last but one) point, so that the end
 * point drops out; outer is the end interval, inner the one next to it. Four points or more. */
static struct row not_a_knot_row(const struct spline *spline, bool first)
{
	size_t i = first ? 1 : spline->count - 2;
	double outer = width(spline, first ? 0 : spline->count - 2);
	double inner = width(spline, first ? 1 : spline->count - 3);
	double right = 6 * (chord_slope(spline, i) - chord_slope(spline, i - 1)) * inner /
	               (outer + inner);
	double diagonal = outer + 2 * inner;
	double off = inner - outer;
	return (struct row){ first ? 0 : off, diagonal, first ? off : 0, right };
}

/* Gaussian elimination; the rows are diagonally dominant or (not-a-knot) nearly so. */
static void solve_rows(struct row *rows, size_t first, size_t last, double *second)
{
	for (size_t i = first + 1; i <= last; i++) {
		double factor = rows[i].below / rows[i - 1].diagonal;
		rows[i].diagonal -= factor * rows[i - 1].above;
		rows[i].right -= factor * rows[i - 1].right;
	}
	second[last] = rows[last].right / rows[last].diagonal;
	for (size_t i = last; i-- > first;)
		second[i] = (rows[i].right - rows[i].above * second[i + 1]) / rows[i].diagonal;
}

static void fill_rows(const struct spline *spline, const double slopes[2], struct row *rows)
{
	size_t last = spline->count - 1;
	for (size_t i = 1; i < last; i++)
		rows[i] = inner_row(spline, i);
	if (spline->ends == SPLINE_CLAMPED) {
		double step = width(spline, 0);
		rows[0] = (struct row){ 0, 2 * step, step, 6 * (chord_slope(spline, 0) - slopes[0]) };
		step = width(spline, last - 1);
		rows[last] = (struct row){ step, 2 * step, 0,
			                       6 * (slopes[1] - chord_slope(spline, last - 1)) };
	} else if (spline->ends == SPLINE_NOT_A_KNOT && spline->count >= 4) {
		rows[1] = not_a_knot_row(spline, true);
		rows[last - 1] = not_a_knot_row(spline, false);
	}
}

static void not_a_knot_ends(const struct spline *spline)
{
	size_t last = spline->count - 1;
	double *m = spline->second;
	m[0] = m[1] - (m[2] - m[1]) * width(spline, 0) / width(spline, 1);
	m[last] = m[last - 1] +
	          (m[last - 1] - m[last - 2]) * width(spline, last - 1) / width(spline, last - 2);
}

static batten_status find_second_derivatives(struct spline *spline, const double slopes[2])
{
	size_t last = spline->count - 1;
	if (spline->ends != SPLINE_CLAMPED && last == 1)
		return BATTEN_OK; /* the straight line: all zero as allocated */
	if (spline->ends == SPLINE_NOT_A_KNOT && last == 2) {
		double bend = 2 * (chord_slope(spline, 1) - chord_slope(spline, 0)) /
		              (spline->x[2] - spline->x[0]);
		for (size_t i = 0; i <= last; i++)
			spline->second[i] = bend;
		return BATTEN_OK;
	}
	struct row *rows = batten_allocate(spline->context, spline->count, sizeof *rows);
	if (!rows)
		return BATTEN_MEMORY;
	fill_rows(spline, slopes, rows);
	if (spline->ends == SPLINE_CLAMPED)
		solve_rows(rows, 0, last, spline->second);
	else
		solve_rows(rows, 1, last - 1, spline->second);
	if (spline->ends == SPLINE_NOT_A_KNOT)
		not_a_knot_ends(spline);
	batten_release(spline->context, rows);
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

static batten_status check_points(batten_context *context, size_t count, const double *x,
                                  const double *y)
{
	if (count < 2)
		return batten_fail(context, BATTEN_USAGE, "a spline needs two points, found %zu", count);
	for (size_t i = 0; i < count; i++) {
		if (!isfinite(x[i]) || !isfinite(y[i]))
			return batten_fail(context, BATTEN_USAGE, "point %zu of a spline is not finite", i + 1);
		if (i > 0 && !(x[i] > x[i - 1]))
			return batten_fail(context, BATTEN_USAGE,
			                   "point %zu of a spline is not beyond the last", i + 1);
	}
	return BATTEN_OK;
}

static batten_status create(batten_context *context, size_t count, const double *x, const double *y,
                            enum spline_ends ends, const double slopes[2], struct spline *out)
{
	*out = (struct spline){ 0 };
	batten_status status = check_points(context, count, x, y);
	if (status != BATTEN_OK)
		return status;
	struct spline spline = { .context = context, .ends = ends, .count = count };
	spline.x = batten_allocate(context, count, 3 * sizeof *spline.x);
	if (!spline.x)
		return BATTEN_MEMORY;
	spline.y = spline.x + count;
	spline.second = spline.y + count;
	memcpy(spline.x, x, count * sizeof *x);
	memcpy(spline.y, y, count * sizeof *y);
	status = find_second_derivatives(&spline, slopes);
	if (status != BATTEN_OK) {
		batten_release(context, spline.x);
		return status;
	}
	*out = spline;
	return BATTEN_OK;
}

batten_status spline_create(batten_context *context, size_t count, const double *x, const double *y,
                            enum spline_ends ends, struct spline *out)
{
	if (ends != SPLINE_NATURAL && ends != SPLINE_NOT_A_KNOT) {
		*out = (struct spline){ 0 };
		return batten_fail(context, BATTEN_USAGE, "a clamped spline needs its end slopes");
	}
	return create(context, count, x, y, ends, NULL, out);
}

batten_status spline_create_clamped(batten_context *context, size_t count, const double *x,
                                    const double *y, double first_slope, double last_slope,
                                    struct spline *out)
{
	if (!isfinite(first_slope) || !isfinite(last_slope)) {
		*out = (struct spline){ 0 };
		return batten_fail(context, BATTEN_USAGE, "an end slope of a spline is not finite");
	}
	return create(context, count, x, y, SPLINE_CLAMPED, (double[]){ first_slope, last_slope }, out);
}

void spline_destroy(struct spline *spline)
{
	if (spline->x)
		batten_release(spline->context, spline->x);
	*spline = (struct spline){ 0 };
}

/* ------------------------------------------------------------------------------------------------
 * Evaluation
 * --------------------------------------------------------------------------------------------- */

/* One cubic of the spline about its origin: y + t (b + t (c + t d)). */
struct piece {
	double origin, y, b, c, d;
};

/* Interval that holds x: the last i with x[i] <= x, within 0..count-2. */
static size_t interval_at(const struct spline *spline, double x)
{
	size_t low = 0;
	size_t high = spline->count - 1;
	while (high - low > 1) {
		size_t middle = low + (high - low) / 2;
		if (spline->x[middle] <= x)
			low = middle;
		else
			high = middle;
	}
	return low;
}

static struct piece piece_of(const struct spline *spline, size_t i)
{
	double step = width(spline, i);
	double left = spline->second[i];
	double right = spline->second[i + 1];
	return (struct piece){ .origin = spline->x[i],
		                   .y = spline->y[i],
		                   .b = chord_slope(spline, i) - step * (2 * left + right) / 6,
		                   .c = left / 2,
		                   .d = (right - left) / (6 * step) };
}

/* The piece that stands for the spline about x, beyond its points too. */
static struct piece piece_at(const struct spline *spline, double x)
{
	size_t last = spline->count - 1;
	struct piece piece = piece_of(spline, interval_at(spline, x));
	if (spline->ends != SPLINE_NATURAL)
		return piece;
	if (x < spline->x[0]) {
		piece.c = piece.d = 0;
	} else if (x > spline->x[last]) {
		double step = width(spline, last - 1);
		double slope = piece.b + step * (2 * piece.c + step * 3 * piece.d);
		piece = (struct piece){ spline->x[last], spline->y[last], slope, 0, 0 };
	}
	return piece;
}

static double piece_value(const struct piece *piece, double x)
{
	double t = x - piece->origin;
	return piece->y + t * (piece->b + t * (piece->c + t * piece->d));
}

double spline_value(const struct spline *spline, double x)
{
	/* The cubic of the last interval reaches its end only within rounding. */
	if (x == spline->x[spline->count - 1])
		return spline->y[spline->count - 1];
	struct piece piece = piece_at(spline, x);
	return piece_value(&piece, x);
}

double spline_slope(const struct spline *spline, double x)
{
	struct piece piece = piece_at(spline, x);
	double t = x - piece.origin;
	return piece.b + t * (2 * piece.c + t * 3 * piece.d);
}

double spline_second(const struct spline *spline, double x)
{
	if (x == spline->x[spline->count - 1])
		return spline->second[spline->count - 1];
	struct piece piece = piece_at(spline, x);
	return 2 * piece.c + 6 * piece.d * (x - piece.origin);
}

/* ------------------------------------------------------------------------------------------------
 * Integrals: five Gauss points an interval are exact to degree 9, which the cube of a cubic has
 * --------------------------------------------------------------------------------------------- */

enum { GAUSS_POINTS = 5 };

static const double gauss_place[GAUSS_POINTS] = { -0.906179845938663992797626878299,
	                                              -0.538469310105683091036314420700, 0.0,
	                                              0.538469310105683091036314420700,
	                                              0.906179845938663992797626878299 };
static const double gauss_weight[GAUSS_POINTS] = { 0.236926885056189087514264040720,
	                                               0.478628670499366468041291514836,
	                                               0.568888888888888888888888888889,
	                                               0.478628670499366468041291514836,
	                                               0.236926885056189087514264040720 };

/* Integral of x^moment s^power over [a, b], which lies within one piece. */
static double integrate_piece(const struct piece *piece, double a, double b, int moment, int power)
{
	double middle = 0.5 * (a + b);
	double half = 0.5 * (b - a);
	double sum = 0;
	for (int k = 0; k < GAUSS_POINTS; k++) {
		double x = middle + half * gauss_place[k];
		double value = piece_value(piece, x);
		double term = value;
		for (int i = 1; i < power; i++)
			term *= value;
		for (int i = 0; i < moment; i++)
			term *= x;
		sum += gauss_weight[k] * term;
	}
	return half * sum;
}

static double integrate(const struct spline *spline, double a, double b, int moment, int power)
{
	if (b < a)
		return -integrate(spline, b, a, moment, power);
	size_t last = spline->count - 1;
	double sum = 0;
	double from = a;
	while (from < b) {
		/* The next point of the spline beyond from, or b. */
		double to = b;
		if (from < spline->x[0])
			to = fmin(b, spline->x[0]);
		else if (from < spline->x[last])
			to = fmin(b, spline->x[interval_at(spline, from) + 1]);
		struct piece piece = piece_at(spline, 0.5 * (from + to));
		sum += integrate_piece(&piece, from, to, moment, power);
		from = to;
	}
	return sum;
}

double spline_integral(const struct spline *spline, double a, double b)
{
	return integrate(spline, a, b, 0, 1);
}

double spline_moment(const struct spline *spline, double a, double b)
{
	return integrate(spline, a, b, 1, 1);
}

double spline_second_moment(const struct spline *spline, double a, double b)
{
	return integrate(spline, a, b, 2, 1);
}

double spline_square(const struct spline *spline, double a, double b)
{
	return integrate(spline, a, b, 0, 2);
}

double spline_cube(const struct spline *spline, double a, double b)
{
	return integrate(spline, a, b, 0, 3);
}
