#include "fairing/noise.h"

#include "fairing/lines.h"

#include <math.h>

enum { LEAST_ORDER = 4, MOST_ORDER = 8, LEAST_SAMPLES = 16 };

/* Median of magnitude of a normal variate of standard deviation 1. */
static const double normal_median = 0.6744897501960817;

/* Magnitudes of the differences of one order in one direction. */
struct samples {
	size_t order, count;
	double *magnitude;
};

/* Order-th divided difference of order + 1 points, divided by the root of the sum of squares of its
 * weights. */
static double normalised_difference(size_t order, const double *along_m, const double *value_m)
{
	double length = along_m[order] - along_m[0];
	double sum = 0, squares = 0;
	for (size_t i = 0; i <= order; i++) {
		double product = 1;
		for (size_t k = 0; k <= order; k++)
			if (k != i)
				product *= (along_m[i] - along_m[k]) / length;
		sum += value_m[i] / product;
		squares += 1 / (product * product);
	}
	return fabs(sum) / sqrt(squares);
}

/* All differences of one run of points. */
static void take_run(struct samples *samples, size_t count, const double *along_m,
                     const double *value_m)
{
	for (size_t first = 0; first + samples->order < count; first++) {
		double magnitude = normalised_difference(samples->order, along_m + first, value_m + first);
		/* only points closer than their own rounding give anything else */
		if (isfinite(magnitude))
			samples->magnitude[samples->count++] = magnitude;
	}
}

/* The runs of positive half-breadths in one piece of a line. */
static void take_piece(struct samples *samples, const hull_line *points, size_t first, size_t last)
{
	for (size_t i = first; i <= last;) {
		size_t begin = i;
		while (i <= last && points->value_m[i] > 0)
			i++;
		take_run(samples, i - begin, points->along_m + begin, points->value_m + begin);
		while (i <= last && !(points->value_m[i] > 0))
			i++;
	}
}

static batten_status take_lines(const batten_hull *hull, bool waterlines, struct samples *samples)
{
	size_t count = waterlines ? hull->waterline_count : hull->station_count;
	for (size_t line = 0; line < count; line++) {
		hull_line points;
		batten_status status = hull_line_collect(hull, waterlines, line, false, &points);
		if (status != BATTEN_OK)
			return status;
		for (size_t first = 0, next = 0; first < points.count; first = next) {
			size_t last = lines_piece_end(hull, waterlines, line, &points, first, &next);
			take_piece(samples, &points, first, last);
		}
		hull_line_release(hull, &points);
	}
	return BATTEN_OK;
}

/* The value that would stand at place in ascending order; the list is rearranged (Hoare's FIND). */
static double nth_smallest(double *list, size_t count, size_t place)
{
	ptrdiff_t low = 0, high = (ptrdiff_t)count - 1, wanted = (ptrdiff_t)place;
	while (low < high) {
		double pivot = list[low + (high - low) / 2];
		ptrdiff_t i = low, j = high;
		while (i <= j) {
			while (list[i] < pivot)
				i++;
			while (list[j] > pivot)
				j--;
			if (i <= j) {
				double swapped = list[i];
				list[i++] = list[j];
				list[j--] = swapped;
			}
		}
		if (wanted <= j)
			high = j;
		else if (wanted >= i)
			low = i;
		else
			break;
	}
	return list[wanted];
}

static double median(double *list, size_t count)
{
	double upper = nth_smallest(list, count, count / 2);
	if (count % 2 != 0)
		return upper;
	return 0.5 * (nth_smallest(list, count, count / 2 - 1) + upper);
}

/* The least scale over the orders; infinite without enough samples of any order. */
static batten_status measure_direction(batten_context *context, const batten_hull *hull,
                                       bool waterlines, double *out)
{
	/* at most one difference begins at a point; a knuckle that is a point is in two pieces */
	size_t most = hull_node_count(hull) + hull->end_count + hull->knuckle_count +
	              hull->profile_count;
	double *memory = batten_allocate(context, most, sizeof *memory);
	if (!memory)
		return BATTEN_MEMORY;
	batten_status status = BATTEN_OK;
	*out = INFINITY;
	for (size_t order = LEAST_ORDER; order <= MOST_ORDER && status == BATTEN_OK; order++) {
		struct samples samples = { .order = order, .magnitude = memory };
		status = take_lines(hull, waterlines, &samples);
		if (status == BATTEN_OK && samples.count >= LEAST_SAMPLES)
			*out = fmin(*out, median(samples.magnitude, samples.count) / normal_median);
	}
	batten_release(context, memory);
	return status;
}

batten_status noise_estimate(batten_context *context, const batten_hull *hull, double *noise_m)
{
	double along[2] = { 0 };
	for (size_t direction = 0; direction < 2; direction++) {
		batten_status status = measure_direction(context, hull, direction == 0, &along[direction]);
		if (status != BATTEN_OK)
			return status;
	}
	double least = fmin(along[0], along[1]), most = fmax(along[0], along[1]);
	if (!isfinite(least))
		*noise_m = 0;
	else if (!isfinite(most))
		*noise_m = least;
	else if (least == 0)
		*noise_m = 0;
	else /* scaled by the lesser, so that nothing overflows */
		*noise_m = least * sqrt(2 / (1 + (least / most) * (least / most)));
	return BATTEN_OK;
}
