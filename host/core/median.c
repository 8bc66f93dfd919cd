#include "core/median.h"

#include "core/runs.h"

#include <math.h>
#include <stdbool.h>

static double middle_of(double a, double b, double c)
{
	const double low = a < b ? a : b;
	const double high = a < b ? b : a;
	return c < low ? low : c > high ? high : c;
}

/* What a pivot leaves on either side; what is like it stays. */
struct sides {
	size_t less, more;
};

/* Into rooms of their own, so that nothing waits for what was written before; from may be one of them. No
 * branch depends on the values. */
static struct sides part(const double *from, size_t count, double pivot, double *less, double *more)
{
	struct sides sides = { 0, 0 };
	for (size_t i = 0; i < count; i++) {
		const double value = from[i];
		less[sides.less] = value;
		more[sides.more] = value;
		sides.less += value < pivot;
		sides.more += value > pivot;
	}
	return sides;
}

/* The value that would stand at place in ascending order (Hoare's FIND). */
static double nth_least(const double *list, size_t total, size_t place, double *room)
{
	double *less = room;
	double *more = room + total;
	const double *from = list;
	for (size_t count = total;;) {
		const double pivot = middle_of(from[0], from[count / 2], from[count - 1]);
		const struct sides sides = part(from, count, pivot, less, more);
		const size_t not_more = count - sides.more;
		if (place >= sides.less && place < not_more)
			return pivot;
		from = place < sides.less ? less : more;
		count = place < sides.less ? sides.less : sides.more;
		place -= place < not_more ? 0 : not_more;
	}
}

/* The greatest value less than limit, how many there are. */
struct below {
	double most;
	size_t count;
};

/* Four runs at a time: none waits for the one before it. */
enum { LOOK = 4 * RUN_LENGTH };

INLINED void look_below(const double *list, size_t total, double limit, struct below *out)
{
	double most[LOOK], count[LOOK];
	RUN_LOOP
	for (size_t l = 0; l < LOOK; l++) {
		most[l] = -INFINITY;
		count[l] = 0;
	}
	for (size_t i = 0; i + LOOK <= total; i += LOOK) {
		RUN_LOOP
		for (size_t l = 0; l < LOOK; l++) {
			const double value = list[i + l] < limit ? list[i + l] : -INFINITY;
			most[l] = value > most[l] ? value : most[l];
			count[l] += list[i + l] < limit ? 1.0 : 0.0;
		}
	}
	*out = (struct below){ -INFINITY, 0 };
	for (size_t l = 0; l < LOOK; l++) {
		out->most = most[l] > out->most ? most[l] : out->most;
		out->count += (size_t)count[l];
	}
	for (size_t i = total / LOOK * LOOK; i < total; i++) {
		const bool below = list[i] < limit;
		out->most = below && list[i] > out->most ? list[i] : out->most;
		out->count += below;
	}
}

RUNS_FUNCTION(find_below, look_below,
              (const double *list, size_t total, double limit, struct below *out),
              (list, total, limit, out))

double median_of_least(const double *list, size_t total, size_t count, double *room)
{
	const double upper = nth_least(list, total, count / 2, room);
	if (count % 2 != 0)
		return upper;
	struct below below;
	find_below(list, total, upper, &below);
	return 0.5 * (upper + (below.count == count / 2 ? below.most : upper));
}
