#include "fairing/noise.h"

#include "core/median.h"
#include "fairing/grid_noise.h"
#include "fairing/lines.h"

#include <math.h>

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

/* ---- any hull ---- */

/* All differences of one run of points. */
static void take_run(struct samples *samples, size_t order, size_t count, const double *along_m,
                     const double *value_m)
{
	for (size_t first = 0; first + order < count; first++) {
		double weights[NOISE_MOST_ORDER + 1];
		double sum = 0;
		noise_weights(order, along_m + first, weights);
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

/* The least scale over the orders; infinite without enough samples of any order. */
static batten_status measure_direction(const batten_hull *hull, bool waterlines, double *memory,
                                       double *out)
{
	double least = INFINITY;
	batten_status status = BATTEN_OK;
	for (size_t order = NOISE_LEAST_ORDER; order <= NOISE_MOST_ORDER && status == BATTEN_OK;
	     order++) {
		struct samples samples = { .magnitude = memory };
		status = take_lines(hull, waterlines, order, &samples);
		if (status == BATTEN_OK && samples.count >= NOISE_LEAST_SAMPLES)
			least = fmin(least, median_of_least(memory, samples.count, samples.count,
			                                    memory[samples.count / 2]));
	}
	*out = least / NOISE_NORMAL_MEDIAN;
	return status;
}

static batten_status measure_both(batten_context *context, const batten_hull *hull, double along[2])
{
	/* at most one difference begins at a point; a knuckle that is a point is in two pieces */
	const size_t most = hull_node_count(hull) + hull->end_count + hull->knuckle_count +
	                    hull->profile_count;
	double *memory = batten_allocate(context, most, sizeof *memory);
	if (!memory)
		return BATTEN_MEMORY;
	batten_status status = measure_direction(hull, true, memory, &along[0]);
	if (status == BATTEN_OK)
		status = measure_direction(hull, false, memory, &along[1]);
	batten_release(context, memory);
	return status;
}

/* ---- both directions ---- */

double noise_of_scales(const double along[2])
{
	const double least = fmin(along[0], along[1]);
	const double most = fmax(along[0], along[1]);
	if (!isfinite(least))
		return 0;
	if (!isfinite(most))
		return least;
	if (least == 0)
		return 0;
	/* scaled by the lesser, so that nothing overflows */
	return least * sqrt(2 / (1 + (least / most) * (least / most)));
}

batten_status noise_estimate(batten_context *context, const batten_hull *hull, double *noise_m)
{
	double along[2] = { 0 };
	grid_noise *grid = NULL;
	batten_status status = BATTEN_OK;
	if (grid_noise_fits(hull))
		status = grid_noise_create(context, hull, &grid);
	else
		status = measure_both(context, hull, along);
	if (grid)
		grid_noise_scales(grid, hull->y_m, along);
	grid_noise_destroy(grid);
	if (status == BATTEN_OK)
		*noise_m = noise_of_scales(along);
	return status;
}
