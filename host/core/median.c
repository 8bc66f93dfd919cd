#include "core/median.h"

#include "core/runs.h"

#include <math.h>

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

INLINED void look_below(const double *list, size_t total, double limit, struct below *out)
{
	double most[RUN_LENGTH], count[RUN_LENGTH];
	RUN_LOOP
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		most[l] = -INFINITY;
		count[l] = 0;
	}
	size_t i = 0;
	for (; i + RUN_LENGTH <= total; i += RUN_LENGTH)
		RUN_LOOP
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		const double value = list[i + l] < limit ? list[i + l] : -INFINITY;
		most[l] = value > most[l] ? value : most[l];
		count[l] += list[i + l] < limit ? 1.0 : 0.0;
	}
	for (size_t l = 0; i < total; i++) {
		const double value = list[i] < limit ? list[i] : -INFINITY;
		most[l] = value > most[l] ? value : most[l];
		count[l] += list[i] < limit ? 1.0 : 0.0;
	}
	*out = (struct below){ most[0], 0 };
	RUN_LOOP
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		out->most = most[l] > out->most ? most[l] : out->most;
		out->count += (size_t)count[l];
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

size_t median_count_below(const double *list, size_t total, double limit)
{
	struct below below;
	find_below(list, total, limit, &below);
	return below.count;
}
