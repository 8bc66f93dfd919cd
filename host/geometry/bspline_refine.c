#include "geometry/bspline_refine.h"

#include <math.h>
#include <string.h>

/* Memory for the knots and the rows of out->order, count and width. Errors: MEMORY. */
static batten_status allocate_rows(batten_context *context, struct bspline_rows *out)
{
	out->rows = NULL;
	out->knots = batten_allocate(context, out->count + out->order, sizeof *out->knots);
	if (out->knots)
		out->rows = batten_allocate(context, out->count, out->width * sizeof *out->rows);
	if (out->rows)
		return BATTEN_OK;
	bspline_rows_release(context, out);
	return BATTEN_MEMORY;
}

void bspline_rows_release(batten_context *context, struct bspline_rows *rows)
{
	batten_release(context, rows->knots);
	batten_release(context, rows->rows);
	rows->knots = rows->rows = NULL;
}

void bspline_knots_reverse(size_t order, size_t count, double *knots)
{
	double first = knots[order - 1];
	double last = knots[count];
	size_t total = count + order;
	for (size_t i = 0; i < total; i++) {
		/* Rounding may not move the ends of the range. */
		if (knots[i] == first)
			knots[i] = last;
		else if (knots[i] == last)
			knots[i] = first;
		else
			knots[i] = first + (last - knots[i]);
	}
	for (size_t i = 0; i < total / 2; i++) {
		double knot = knots[i];
		knots[i] = knots[total - 1 - i];
		knots[total - 1 - i] = knot;
	}
}

/* to = (1 - part) a + part b, exactly a or b at its ends; to may be a or b. */
static void blend(size_t width, double part, const double *a, const double *b, double *to)
{
	if (part == 0 || part == 1) {
		memmove(to, part == 0 ? a : b, width * sizeof *to);
		return;
	}
	for (size_t i = 0; i < width; i++)
		to[i] = (1 - part) * a[i] + part * b[i];
}

/* ------------------------------------------------------------------------------------------------
 * A knot more
 * --------------------------------------------------------------------------------------------- */

/* Boehm's rule in place; knots and rows have room for one more. */
static void insert_once(struct bspline_rows *s, double t)
{
	size_t width = s->width;
	size_t span = bspline_span(s->order, s->count, s->knots, t);
	memmove(s->rows + (span + 1) * width, s->rows + span * width,
	        (s->count - span) * width * sizeof *s->rows);
	/* From the top down, as each new row is made of an old one and the old one before. */
	for (size_t i = span; i + s->order > span + 1; i--) {
		double part = (t - s->knots[i]) / (s->knots[i + s->order - 1] - s->knots[i]);
		blend(width, part, s->rows + (i - 1) * width, s->rows + i * width, s->rows + i * width);
	}
	memmove(s->knots + span + 2, s->knots + span + 1,
	        (s->count + s->order - span - 1) * sizeof *s->knots);
	s->knots[span + 1] = t;
	s->count++;
}

batten_status bspline_rows_insert(batten_context *context, const struct bspline_rows *from,
                                  double t, size_t times, struct bspline_rows *out)
{
	size_t order = from->order;
	if (!(t > from->knots[order - 1] && t < from->knots[from->count]))
		return batten_fail(context, BATTEN_USAGE, "knot %g is not inside the range %g..%g", t,
		                   from->knots[order - 1], from->knots[from->count]);
	size_t most = order - 1;
	for (size_t i = order; i < from->count; i++)
		most -= from->knots[i] == t;
	if (times > most)
		return batten_fail(context, BATTEN_USAGE,
		                   "knot %g can be inserted %zu times at order %zu, not %zu", t, most,
		                   order, times);
	struct bspline_rows s = *from;
	s.count += times;
	batten_status status = allocate_rows(context, &s);
	if (status != BATTEN_OK)
		return status;
	s.count = from->count;
	memcpy(s.knots, from->knots, (from->count + order) * sizeof *s.knots);
	memcpy(s.rows, from->rows, from->count * from->width * sizeof *s.rows);
	for (size_t i = 0; i < times; i++)
		insert_once(&s, t);
	status = bspline_knots_check(context, "knots", order, s.count, s.knots);
	if (status == BATTEN_OK)
		*out = s;
	else
		bspline_rows_release(context, &s);
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * An order more
 * --------------------------------------------------------------------------------------------- */

/* The polar form of the polynomial of one span at order - 1 arguments, by de Boor's recursion with
 * an argument of its own at every step. work holds order rows, the first gets the result. */
static void polar_form(const struct bspline_rows *s, size_t span, const double *arguments,
                       double *work)
{
	size_t degree = s->order - 1;
	size_t first = span - degree;
	memcpy(work, s->rows + first * s->width, s->order * s->width * sizeof *work);
	for (size_t r = 1; r <= degree; r++) {
		for (size_t j = 0; j + r <= degree; j++) {
			double left = s->knots[first + r + j];
			double right = s->knots[span + 1 + j];
			double part = (arguments[r - 1] - left) / (right - left);
			blend(s->width, part, work + j * s->width, work + (j + 1) * s->width,
			      work + j * s->width);
		}
	}
}

/* One row of the next order: the mean of the polar form over its degree + 1 knots, each left out
 * in turn. Any span under the row gives the same; the one about their mean keeps the arguments
 * near. */
static void elevated_row(const struct bspline_rows *s, const double *knots, double *work,
                         double *row)
{
	size_t order = s->order;
	double middle = 0;
	for (size_t i = 0; i < order; i++)
		middle += knots[i] / (double)order;
	size_t span = bspline_span(order, s->count, s->knots, middle);
	if (knots[0] == knots[order - 1]) { /* a point of the curve: exact where the old row was */
		polar_form(s, span, knots, work);
		memcpy(row, work, s->width * sizeof *row);
		return;
	}
	double arguments[BSPLINE_ORDER_MOST];
	for (size_t i = 0; i < s->width; i++)
		row[i] = 0;
	for (size_t left_out = 0; left_out < order; left_out++) {
		size_t count = 0;
		for (size_t i = 0; i < order; i++)
			if (i != left_out)
				arguments[count++] = knots[i];
		polar_form(s, span, arguments, work);
		for (size_t i = 0; i < s->width; i++)
			row[i] += work[i] / (double)order;
	}
}

static size_t distinct(size_t count, const double *knots)
{
	size_t number = count > 0;
	for (size_t i = 1; i < count; i++)
		number += knots[i] > knots[i - 1];
	return number;
}

/* Every knot once more often, without those before the range that no pole needs any more, nor those
 * beyond it. Returns the number of poles; knots may be NULL. */
static size_t elevated_knots(const struct bspline_rows *s, double *knots)
{
	size_t total = s->count + s->order;
	size_t before = distinct(s->order, s->knots) - 1;
	size_t beyond = distinct(s->order, s->knots + s->count) - 1;
	size_t kept = total + distinct(total, s->knots) - before - beyond;
	size_t place = 0;
	for (size_t i = 0; i < total && knots; i++) {
		size_t copies = i > 0 && s->knots[i] == s->knots[i - 1] ? 1 : 2;
		for (size_t copy = 0; copy < copies; copy++, place++)
			if (place >= before && place - before < kept)
				knots[place - before] = s->knots[i];
	}
	return kept - s->order - 1;
}

static batten_status elevate_once(batten_context *context, const struct bspline_rows *from,
                                  struct bspline_rows *out)
{
	struct bspline_rows s = *from;
	s.order = from->order + 1;
	s.count = elevated_knots(from, NULL);
	if (s.order > BSPLINE_ORDER_MOST || s.count > BSPLINE_POLES_MOST)
		return batten_fail(context, BATTEN_USAGE,
		                   "raising the order gives order %zu and %zu poles, at most %d and %d",
		                   s.order, s.count, (int)BSPLINE_ORDER_MOST, (int)BSPLINE_POLES_MOST);
	double *work = batten_allocate(context, s.order, s.width * sizeof *work);
	if (!work)
		return BATTEN_MEMORY;
	batten_status status = allocate_rows(context, &s);
	if (status == BATTEN_OK) {
		elevated_knots(from, s.knots);
		for (size_t i = 0; i < s.count; i++)
			elevated_row(from, s.knots + i + 1, work, s.rows + i * s.width);
		*out = s;
	}
	batten_release(context, work);
	return status;
}

batten_status bspline_rows_elevate(batten_context *context, const struct bspline_rows *from,
                                   size_t times, struct bspline_rows *out)
{
	struct bspline_rows now = *from;
	for (size_t i = 0; i < times; i++) {
		struct bspline_rows next;
		batten_status status = elevate_once(context, &now, &next);
		if (i > 0)
			bspline_rows_release(context, &now);
		if (status != BATTEN_OK)
			return status;
		now = next;
	}
	*out = now;
	return BATTEN_OK;
}
