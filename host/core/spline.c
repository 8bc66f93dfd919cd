#include "core/spline.h"

#include "core/gauss.h"

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

/* The row of an end point whose second derivative stands alone or with its neighbour's; given for
 * not-a-knot it is that of two points only: their second derivatives are equal. */
static struct row end_row(const struct spline *spline, struct spline_condition condition,
                          bool first)
{
	size_t interval = first ? 0 : spline->count - 2;
	double step = width(spline, interval);
	double chord = chord_slope(spline, interval);
	struct row row = { 0, 1, 0, 0 };
	double beside = 0;
	if (condition.end == SPLINE_CLAMPED) {
		row.diagonal = 2 * step;
		beside = step;
		row.right = first ? 6 * (chord - condition.value) : 6 * (condition.value - chord);
	} else if (condition.end == SPLINE_BENT) {
		row.right = condition.value;
	} else if (condition.end == SPLINE_NOT_A_KNOT) {
		beside = -1;
	}
	*(first ? &row.above : &row.below) = beside;
	return row;
}

/* Solves for the second derivatives; a not-a-knot end is found from its neighbours afterwards. */
static void solve_ends(struct spline *spline, const struct spline_condition conditions[2],
                       struct row *rows)
{
	size_t last = spline->count - 1;
	bool inside = last > 1;
	bool out_first = inside && conditions[0].end == SPLINE_NOT_A_KNOT;
	bool out_last = inside && conditions[1].end == SPLINE_NOT_A_KNOT;
	for (size_t i = 1; i < last; i++)
		rows[i] = inner_row(spline, i);
	rows[0] = end_row(spline, conditions[0], true);
	rows[last] = end_row(spline, conditions[1], false);
	if (out_first)
		rows[1] = not_a_knot_row(spline, true);
	if (out_last)
		rows[last - 1] = not_a_knot_row(spline, false);
	double *m = spline->second;
	solve_rows(rows, out_first ? 1 : 0, out_last ? last - 1 : last, m);
	if (out_first)
		m[0] = m[1] - (m[2] - m[1]) * width(spline, 0) / width(spline, 1);
	if (out_last)
		m[last] = m[last - 1] +
		          (m[last - 1] - m[last - 2]) * width(spline, last - 1) / width(spline, last - 2);
}

static batten_status find_second_derivatives(struct spline *spline,
                                             const struct spline_condition conditions[2])
{
	size_t last = spline->count - 1;
	if (conditions[0].end == SPLINE_NOT_A_KNOT && conditions[1].end == SPLINE_NOT_A_KNOT &&
	    last <= 2) {
		/* The straight line or the parabola. */
		double bend = last == 1 ? 0
		                        : 2 * (chord_slope(spline, 1) - chord_slope(spline, 0)) /
		                              (spline->x[2] - spline->x[0]);
		for (size_t i = 0; i <= last; i++)
			spline->second[i] = bend;
		return BATTEN_OK;
	}
	struct row *rows = batten_allocate(spline->context, spline->count, sizeof *rows);
	if (!rows)
		return BATTEN_MEMORY;
	solve_ends(spline, conditions, rows);
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

batten_status spline_create_mixed(batten_context *context, size_t count, const double *x,
                                  const double *y, struct spline_condition first,
                                  struct spline_condition last, struct spline *out)
{
	const struct spline_condition conditions[2] = { first, last };
	*out = (struct spline){ 0 };
	batten_status status = check_points(context, count, x, y);
	if (status != BATTEN_OK)
		return status;
	for (int i = 0; i < 2; i++)
		if (!isfinite(conditions[i].value))
			return batten_fail(context, BATTEN_USAGE, "an end condition of a spline is not finite");
	struct spline spline = { .context = context, .ends = { first.end, last.end }, .count = count };
	spline.x = batten_allocate(context, count, 3 * sizeof *spline.x);
	if (!spline.x)
		return BATTEN_MEMORY;
	spline.y = spline.x + count;
	spline.second = spline.y + count;
	memcpy(spline.x, x, count * sizeof *x);
	memcpy(spline.y, y, count * sizeof *y);
	status = find_second_derivatives(&spline, conditions);
	if (status != BATTEN_OK) {
		batten_release(context, spline.x);
		return status;
	}
	*out = spline;
	return BATTEN_OK;
}

batten_status spline_create(batten_context *context, size_t count, const double *x, const double *y,
                            enum spline_end ends, struct spline *out)
{
	const struct spline_condition both = { ends, 0 };
	if (ends != SPLINE_NATURAL && ends != SPLINE_NOT_A_KNOT) {
		*out = (struct spline){ 0 };
		return batten_fail(context, BATTEN_USAGE, "the ends of a spline need their values");
	}
	return spline_create_mixed(context, count, x, y, both, both, out);
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
	if (x < spline->x[0] && spline->ends[0] == SPLINE_NATURAL) {
		piece.c = piece.d = 0;
	} else if (x > spline->x[last] && spline->ends[1] == SPLINE_NATURAL) {
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

void spline_derivatives(const struct spline *spline, double x, double out[SPLINE_DERIVATIVES])
{
	struct piece piece = piece_at(spline, x);
	out[0] = spline_value(spline, x);
	out[1] = spline_slope(spline, x);
	out[2] = spline_second(spline, x);
	out[3] = 6 * piece.d;
}

void spline_rule_of(struct spline_rule *out)
{
	gauss_points(SPLINE_RULE_POINTS, out->nodes, out->weights);
}

double spline_integral_by(const struct spline_rule *rule, const struct spline *spline, double a,
                          double b, int x_power, int power)
{
	double sum = 0;
	for (size_t i = 0; i + 1 < spline->count; i++) {
		const double first = fmax(fmin(a, b), spline->x[i]);
		const double last = fmin(fmax(a, b), spline->x[i + 1]);
		if (!(last > first))
			continue;
		const struct piece piece = piece_of(spline, i);
		for (size_t n = 0; n < SPLINE_RULE_POINTS; n++) {
			const double x = 0.5 * (first + last) + 0.5 * (last - first) * rule->nodes[n];
			const double value = piece_value(&piece, x);
			double product = 0.5 * (last - first) * rule->weights[n];
			for (int p = 0; p < x_power; p++)
				product *= x;
			for (int p = 0; p < power; p++)
				product *= value;
			sum += product;
		}
	}
	return a <= b ? sum : -sum;
}

double spline_integral(const struct spline *spline, double a, double b, int x_power, int power)
{
	struct spline_rule rule;
	spline_rule_of(&rule);
	return spline_integral_by(&rule, spline, a, b, x_power, power);
}
