#include "fairing/noise.h"

#include "fairing/lines.h"

#include <math.h>

enum { LEAST_ORDER = 4, MOST_ORDER = 8, LEAST_SAMPLES = 16 };

/* Median of magnitude of a normal variate of standard deviation 1. */
static const double normal_median = 0.6744897501960817;

/* Magnitudes of the differences of one order in one direction. */
struct samples {
	size_t count;
	double *magnitude;
};

static void take(struct samples *samples, double difference)
{
	/* only points closer than their own rounding give anything else */
	if (isfinite(difference))
		samples->magnitude[samples->count++] = fabs(difference);
}

/* Weights of the order-th divided difference of order + 1 points, divided by the root of the sum of their
 * squares. */
static void difference_weights_of(size_t order, const double *along_m, double *weights)
{
	double squares = 0;
	for (size_t i = 0; i <= order; i++) {
		/* hull.h bounds steps and lengths: eight of them neither overflow nor vanish */
		double product = 1;
		for (size_t k = 0; k <= order; k++)
			if (k != i)
				product *= along_m[i] - along_m[k];
		weights[i] = 1 / product;
		squares += weights[i] * weights[i];
	}
	const double scale = 1 / sqrt(squares);
	for (size_t i = 0; i <= order; i++)
		weights[i] *= scale;
}

/* ---- any hull ---- */

/* All differences of one run of points. */
static void take_run(struct samples *samples, size_t order, size_t count, const double *along_m,
                     const double *value_m)
{
	for (size_t first = 0; first + order < count; first++) {
		double weights[MOST_ORDER + 1];
		double sum = 0;
		difference_weights_of(order, along_m + first, weights);
		for (size_t i = 0; i <= order; i++)
			sum += weights[i] * value_m[first + i];
		take(samples, sum);
	}
}

/* The runs of positive half-breadths in one piece of a line. */
static void take_piece(struct samples *samples, size_t order, const hull_line *points, size_t first,
                       size_t last)
{
	for (size_t i = first; i <= last;) {
		size_t begin = i;
		while (i <= last && points->value_m[i] > 0)
			i++;
		take_run(samples, order, i - begin, points->along_m + begin, points->value_m + begin);
		while (i <= last && !(points->value_m[i] > 0))
			i++;
	}
}

static batten_status take_lines(const batten_hull *hull, bool waterlines, size_t order,
                                struct samples *samples)
{
	size_t count = waterlines ? hull->waterline_count : hull->station_count;
	for (size_t line = 0; line < count; line++) {
		hull_line points;
		batten_status status = hull_line_collect(hull, waterlines, line, false, &points);
		if (status != BATTEN_OK)
			return status;
		for (size_t first = 0, next = 0; first < points.count; first = next) {
			size_t last = lines_piece_end(hull, waterlines, line, &points, first, &next);
			take_piece(samples, order, &points, first, last);
		}
		hull_line_release(hull, &points);
	}
	return BATTEN_OK;
}

/* ---- a plain grid ---- */

/* Nothing but the grid's own nodes, all known: the windows of all lines are the same, and many hulls are
 * worked so. The same differences in another order. */
static bool is_plain(const batten_hull *hull)
{
	if (!lines_are_of_grid(hull))
		return false;
	for (size_t n = 0; n < hull_node_count(hull); n++)
		if (hull->nodes[n] == BATTEN_NODE_UNKNOWN)
			return false;
	return true;
}

/* One direction of a table: count points a line, step apart in the arrays; lines line_step apart. */
struct direction {
	size_t count, step, lines, line_step;
	const double *along_m;
};

/* How many positive half-breadths in a row end at each node. */
static void count_runs(const batten_hull *hull, const struct direction *d, uint16_t *runs)
{
	for (size_t line = 0; line < d->lines; line++) {
		uint16_t run = 0;
		for (size_t i = 0; i < d->count; i++) {
			const size_t node = line * d->line_step + i * d->step;
			run = hull->y_m[node] > 0 ? (uint16_t)(run + 1) : 0;
			runs[node] = run;
		}
	}
}

static void take_windows(const batten_hull *hull, const struct direction *d, const uint16_t *runs,
                         size_t order, struct samples *samples)
{
	for (size_t first = 0; first + order < d->count; first++) {
		double weights[MOST_ORDER + 1];
		difference_weights_of(order, d->along_m + first, weights);
		for (size_t line = 0; line < d->lines; line++) {
			const size_t node = line * d->line_step + first * d->step;
			if (runs[node + order * d->step] <= order)
				continue;
			double sum = 0;
			for (size_t i = 0; i <= order; i++)
				sum += weights[i] * hull->y_m[node + i * d->step];
			take(samples, sum);
		}
	}
}

/* ---- the median ---- */

/* Moves what is less than the pivot (or_equal: not more) to the front of list[low..high); returns where
 * the rest begins. Without a branch that depends on the values. */
static size_t partition(double *list, size_t low, size_t high, double pivot, bool or_equal)
{
	for (size_t i = low; i < high; i++) {
		const double value = list[i];
		list[i] = list[low];
		list[low] = value;
		low += or_equal ? !(pivot < value) : value < pivot;
	}
	return low;
}

/* The value that would stand at place in ascending order; the list is rearranged, what stands before
 * place is not more (Hoare's FIND). */
static double nth_smallest(double *list, size_t count, size_t place)
{
	size_t low = 0;
	size_t high = count;
	while (high - low > 1) {
		const double pivot = list[low + (high - low) / 2];
		const size_t less = partition(list, low, high, pivot, false);
		if (place < less) {
			high = less;
			continue;
		}
		low = partition(list, less, high, pivot, true);
		if (place < low)
			return pivot;
	}
	return list[place];
}

static double median(double *list, size_t count)
{
	const double upper = nth_smallest(list, count, count / 2);
	double lower = list[0];
	if (count % 2 != 0)
		return upper;
	for (size_t i = 1; i < count / 2; i++)
		lower = list[i] > lower ? list[i] : lower;
	return 0.5 * (lower + upper);
}

/* ---- both directions ---- */

static struct direction direction_of(const batten_hull *hull, bool waterlines)
{
	const size_t nx = hull->station_count;
	const size_t nz = hull->waterline_count;
	return waterlines ? (struct direction){ nx, 1, nz, nx, hull->x_m }
	                  : (struct direction){ nz, nx, nx, 1, hull->z_m };
}

/* runs: NULL where the hull is more than a plain grid. */
static batten_status take_direction(const batten_hull *hull, bool waterlines, size_t order,
                                    const uint16_t *runs, struct samples *samples)
{
	const struct direction d = direction_of(hull, waterlines);
	if (!runs)
		return take_lines(hull, waterlines, order, samples);
	take_windows(hull, &d, runs, order, samples);
	return BATTEN_OK;
}

/* The least scale over the orders; infinite without enough samples of any order. */
static batten_status measure_direction(const batten_hull *hull, bool waterlines,
                                       const uint16_t *runs, double *memory, double *out)
{
	batten_status status = BATTEN_OK;
	*out = INFINITY;
	for (size_t order = LEAST_ORDER; order <= MOST_ORDER && status == BATTEN_OK; order++) {
		struct samples samples = { .magnitude = memory };
		status = take_direction(hull, waterlines, order, runs, &samples);
		if (status == BATTEN_OK && samples.count >= LEAST_SAMPLES)
			*out = fmin(*out, median(samples.magnitude, samples.count) / normal_median);
	}
	return status;
}

static batten_status measure_both(batten_context *context, const batten_hull *hull, double along[2])
{
	const size_t nodes = hull_node_count(hull);
	/* at most one difference begins at a point; a knuckle that is a point is in two pieces */
	const size_t most = nodes + hull->end_count + hull->knuckle_count + hull->profile_count;
	const bool plain = is_plain(hull);
	double *memory = batten_allocate(context, most, sizeof *memory);
	uint16_t *runs = batten_allocate(context, nodes, sizeof *runs);
	batten_status status = memory && runs ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t k = 0; k < 2 && status == BATTEN_OK; k++) {
		const bool waterlines = k == 0;
		const struct direction d = direction_of(hull, waterlines);
		count_runs(hull, &d, runs);
		status = measure_direction(hull, waterlines, plain ? runs : NULL, memory, &along[k]);
	}
	batten_release(context, memory);
	batten_release(context, runs);
	return status;
}

batten_status noise_estimate(batten_context *context, const batten_hull *hull, double *noise_m)
{
	double along[2] = { 0 };
	const batten_status status = measure_both(context, hull, along);
	if (status != BATTEN_OK)
		return status;
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
