#include "fairing/grid_noise.h"

#include "core/median.h"
#include "core/runs.h"
#include "fairing/lines.h"

#include <math.h>
#include <string.h>

void noise_weights(size_t order, const double *along_m, double *weights)
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

/* ---- tables ---- */

/* One direction of the table: count points a line, lines side by side in whole runs, those beyond the last
 * one empty. */
struct direction {
	size_t count, lines, stride;
	double *weights; /* of each order and each place its first point may have */
	double *value_m; /* [count][stride] */
	double *run;     /* as value_m: how many positive half-breadths in a row end here */
	/* The medians found last, of order after order: those of the next hull are often near them. */
	double median[NOISE_MOST_ORDER - NOISE_LEAST_ORDER + 1];
};

struct grid_noise {
	batten_context *context;
	struct direction along[2]; /* waterlines, sections */
	double *magnitude;         /* of the larger direction: of the differences of one order */
	size_t most;
	double *memory;
};

enum {
	/* Weights that begin at a point. */
	NUMBERS_A_POINT = (NOISE_MOST_ORDER - NOISE_LEAST_ORDER + 1) *
	                  (NOISE_MOST_ORDER + NOISE_LEAST_ORDER + 2) / 2
};

/* Those of one order stand together, place after place. */
static double *weights_of(const struct direction *d, size_t order)
{
	const size_t before = (order - NOISE_LEAST_ORDER) * (order + NOISE_LEAST_ORDER + 1) / 2;
	return d->weights + before * d->count;
}

static void lay_weights(const struct direction *d, const double *along_m)
{
	for (size_t order = NOISE_LEAST_ORDER; order <= NOISE_MOST_ORDER; order++)
		for (size_t first = 0; first + order < d->count; first++)
			noise_weights(order, along_m + first, weights_of(d, order) + first * (order + 1));
}

static struct direction direction_of(size_t count, size_t lines)
{
	return (struct direction){ .count = count,
		                       .lines = lines,
		                       .stride = (lines + RUN_LENGTH - 1) / RUN_LENGTH * RUN_LENGTH };
}

static batten_status take_memory(grid_noise *noise)
{
	size_t numbers = 0;
	for (size_t k = 0; k < 2; k++) {
		const struct direction *d = &noise->along[k];
		const size_t nodes = d->count * d->stride;
		noise->most = nodes > noise->most ? nodes : noise->most;
		numbers += NUMBERS_A_POINT * d->count;
	}
	/* One direction after the other works in the same rooms, whose runs begin at lines of the cache. */
	noise->memory = batten_allocate(noise->context, numbers + 3 * noise->most + RUN_LENGTH,
	                                sizeof *noise->memory);
	if (!noise->memory)
		return BATTEN_MEMORY;
	double *at = noise->memory + (-(uintptr_t)noise->memory / sizeof *at) % RUN_LENGTH;
	for (size_t k = 0; k < 2; k++) {
		noise->along[k].value_m = at;
		noise->along[k].run = at + noise->most;
	}
	noise->magnitude = at + 2 * noise->most;
	at += 3 * noise->most;
	for (size_t k = 0; k < 2; k++) {
		struct direction *d = &noise->along[k];
		d->weights = at;
		at += NUMBERS_A_POINT * d->count;
	}
	return BATTEN_OK;
}

bool grid_noise_fits(const batten_hull *hull)
{
	return lines_are_of_grid(hull) &&
	       !memchr(hull->nodes, BATTEN_NODE_UNKNOWN, hull_node_count(hull));
}

batten_status grid_noise_create(batten_context *context, const batten_hull *hull, grid_noise **out)
{
	const size_t nx = hull->station_count;
	const size_t nz = hull->waterline_count;
	grid_noise *noise = batten_allocate(context, 1, sizeof *noise);
	if (!noise)
		return BATTEN_MEMORY;
	*noise = (grid_noise){ .context = context,
		                   .along = { direction_of(nx, nz), direction_of(nz, nx) } };
	const batten_status status = take_memory(noise);
	if (status != BATTEN_OK) {
		grid_noise_destroy(noise);
		return status;
	}
	lay_weights(&noise->along[0], hull->x_m);
	lay_weights(&noise->along[1], hull->z_m);
	*out = noise;
	return BATTEN_OK;
}

void grid_noise_destroy(grid_noise *noise)
{
	if (!noise)
		return;
	batten_release(noise->context, noise->memory);
	batten_release(noise->context, noise);
}

/* ---- differences ---- */

/* Points of the lines, step apart in y_m, lines line_step apart. */
static void take_values(const struct direction *d, const double *restrict y_m, size_t step,
                        size_t line_step)
{
	for (size_t i = 0; i < d->count; i++) {
		double *restrict value = d->value_m + i * d->stride;
		for (size_t line = 0; line < d->lines; line++)
			value[line] = y_m[i * step + line * line_step];
		for (size_t line = d->lines; line < d->stride; line++)
			value[line] = 0.0;
	}
}

INLINED void count_runs(const struct direction *d)
{
	for (size_t n = 0; n < d->count * d->stride; n += RUN_LENGTH)
		RUN_LOOP
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		const double before = n < d->stride ? 0.0 : d->run[n + l - d->stride];
		d->run[n + l] = d->value_m[n + l] > 0 ? before + 1 : 0.0;
	}
}

RUNS_FUNCTION(take_runs, count_runs, (const struct direction *d), (d))

/* How many differences of an order there are in each lane, and how many of them below a limit. */
struct counted {
	double limit;
	double there[RUN_LENGTH], below[RUN_LENGTH];
};

/* The magnitudes of all differences of an order, where they begin, infinite where there is none. One loop, in
 * which what is counted stays in registers. */
INLINED void take_places(const struct direction *d, size_t order, double *magnitude,
                         struct counted *out)
{
	const size_t stride = d->stride, end = (d->count - order) * stride;
	const double limit = out->limit;
	const double *weights = weights_of(d, order);
	double there_are[RUN_LENGTH] = { 0 }, below[RUN_LENGTH] = { 0 };
	for (size_t n = 0, line = 0; n < end; n += RUN_LENGTH) {
		const double *value = d->value_m + n, *run = d->run + n + order * stride;
		double sum[RUN_LENGTH] = { 0 }, size[RUN_LENGTH];
		for (size_t i = 0; i <= order; i++)
			RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++)
			sum[l] += weights[i] * value[i * stride + l];
		/* Only points closer than their own rounding give what is not finite. */
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++) {
			const double there = run[l] > (double)order ? fabs(sum[l]) : INFINITY;
			size[l] = there < INFINITY ? there : INFINITY;
		}
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++) {
			there_are[l] += size[l] < INFINITY ? 1.0 : 0.0;
			below[l] += size[l] < limit ? 1.0 : 0.0;
		}
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++)
			magnitude[n + l] = size[l];
		line += RUN_LENGTH;
		weights += line == stride ? order + 1 : 0;
		line = line == stride ? 0 : line;
	}
	RUN_LOOP
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		out->there[l] = there_are[l];
		out->below[l] = below[l];
	}
}

/* An order the compiler knows is a sum without a loop. */
INLINED void take_order(const struct direction *d, size_t order, double *magnitude,
                        struct counted *counted)
{
	_Static_assert(NOISE_LEAST_ORDER == 4 && NOISE_MOST_ORDER == 8, "the orders below");
	switch (order) {
	case 4:
		take_places(d, 4, magnitude, counted);
		break;
	case 5:
		take_places(d, 5, magnitude, counted);
		break;
	case 6:
		take_places(d, 6, magnitude, counted);
		break;
	case 7:
		take_places(d, 7, magnitude, counted);
		break;
	default:
		take_places(d, 8, magnitude, counted);
	}
}

RUNS_FUNCTION(take_differences, take_order,
              (const struct direction *d, size_t order, double *magnitude, struct counted *counted),
              (d, order, magnitude, counted))

static size_t total(const double *lanes)
{
	double sum = 0;
	for (size_t l = 0; l < RUN_LENGTH; l++)
		sum += lanes[l];
	return (size_t)sum;
}

/* The least scale over the orders. On faired hulls it is most often that of order 5, then 4; of the others a
 * count then tells that their median is not less. */
static double least_scale(const grid_noise *noise, struct direction *d)
{
	static const size_t orders[] = { 5, 4, 6, 7, 8 };
	_Static_assert(sizeof orders / sizeof orders[0] == NOISE_MOST_ORDER - NOISE_LEAST_ORDER + 1,
	               "every order");
	double least = INFINITY;
	take_runs(d);
	for (size_t o = 0; o < sizeof orders / sizeof orders[0]; o++) {
		const size_t order = orders[o];
		double *median = &d->median[order - NOISE_LEAST_ORDER];
		if (d->count <= order)
			continue;
		struct counted counted = { .limit = least };
		take_differences(d, order, noise->magnitude, &counted);
		const size_t count = total(counted.there);
		if (count < NOISE_LEAST_SAMPLES || total(counted.below) < (count + 1) / 2)
			continue;
		*median = median_of_least(noise->magnitude, (d->count - order) * d->stride, count, *median);
		least = fmin(least, *median);
	}
	return least / NOISE_NORMAL_MEDIAN;
}

void grid_noise_scales(grid_noise *noise, const double *y_m, double along[2])
{
	const size_t nx = noise->along[0].count;
	take_values(&noise->along[0], y_m, 1, nx);
	along[0] = least_scale(noise, &noise->along[0]);
	take_values(&noise->along[1], y_m, nx, 1);
	along[1] = least_scale(noise, &noise->along[1]);
}
