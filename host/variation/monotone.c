#include "variation/monotone.h"

#include <math.h>
#include <string.h>

static double chord(const struct monotone *map, size_t i)
{
	return (map->to[i + 1] - map->to[i]) / (map->from[i + 1] - map->from[i]);
}

/* Slopes of the parabolas through three points each, then within the circle of radius 3 of each
 * interval's chord slope. */
static void find_slopes(struct monotone *map)
{
	const size_t last = map->count - 1;
	for (size_t i = 1; i < last; i++) {
		const double before = map->from[i] - map->from[i - 1];
		const double after = map->from[i + 1] - map->from[i];
		map->slope[i] = (after * chord(map, i - 1) + before * chord(map, i)) / (before + after);
	}
	map->slope[0] = last > 1 ? 2 * chord(map, 0) - map->slope[1] : chord(map, 0);
	map->slope[last] = last > 1 ? 2 * chord(map, last - 1) - map->slope[last - 1] : chord(map, 0);
	/* An end may not turn back either. */
	map->slope[0] = fmax(map->slope[0], chord(map, 0) / 3);
	map->slope[last] = fmax(map->slope[last], chord(map, last - 1) / 3);
	for (size_t i = 0; i < last; i++) {
		const double a = map->slope[i] / chord(map, i), b = map->slope[i + 1] / chord(map, i);
		const double size = sqrt(a * a + b * b);
		if (size > 3) {
			map->slope[i] *= 3 / size;
			map->slope[i + 1] *= 3 / size;
		}
	}
}

batten_status monotone_create(batten_context *context, size_t count, const double *from,
                              const double *to, bool straight, struct monotone *out)
{
	*out = (struct monotone){ .context = context, .count = count, .straight = straight };
	out->from = batten_allocate(context, count, 3 * sizeof *out->from);
	if (!out->from)
		return BATTEN_MEMORY;
	out->to = out->from + count;
	out->slope = out->to + count;
	memcpy(out->from, from, count * sizeof *from);
	memcpy(out->to, to, count * sizeof *to);
	find_slopes(out);
	return BATTEN_OK;
}

void monotone_destroy(struct monotone *map)
{
	batten_release(map->context, map->from);
	*map = (struct monotone){ 0 };
}

double monotone_value(double at, const void *user)
{
	const struct monotone *map = user;
	const size_t last = map->count - 1;
	size_t i = 0;
	while (i + 1 < last && at >= map->from[i + 1])
		i++;
	const double step = map->from[i + 1] - map->from[i];
	const double t = (at - map->from[i]) / step;
	double value = 0;
	if (map->straight || map->count == 2)
		value = map->to[i] + t * (map->to[i + 1] - map->to[i]);
	else if (at < map->from[0])
		value = map->to[0] + map->slope[0] * (at - map->from[0]);
	else if (at > map->from[last])
		value = map->to[last] + map->slope[last] * (at - map->from[last]);
	else
		value = map->to[i] * (1 + 2 * t) * (1 - t) * (1 - t) +
		        map->slope[i] * step * t * (1 - t) * (1 - t) +
		        map->to[i + 1] * t * t * (3 - 2 * t) - map->slope[i + 1] * step * t * t * (1 - t);
	return value - map->origin;
}
