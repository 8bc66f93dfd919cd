#include "core/median.h"

#include "core/runs.h"

#include <math.h>
#include <stdbool.h>

/* The values on either side of a limit: how many are below it, the greatest of those, the least of the
 * others. */
struct sides {
	double below_most, above_least;
	size_t below;
};

INLINED void look_around(const double *list, size_t total, double limit, struct sides *out)
{
	double most[RUN_LENGTH], least[RUN_LENGTH], count[RUN_LENGTH];
	RUN_LOOP
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		most[l] = -INFINITY;
		least[l] = INFINITY;
		count[l] = 0;
	}
	for (size_t i = 0; i + RUN_LENGTH <= total; i += RUN_LENGTH) {
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++) {
			const double value = list[i + l];
			const double below = value < limit ? value : -INFINITY;
			const double above = value < limit ? INFINITY : value;
			most[l] = below > most[l] ? below : most[l];
			least[l] = above < least[l] ? above : least[l];
			count[l] += value < limit ? 1.0 : 0.0;
		}
	}
	struct sides found = { -INFINITY, INFINITY, 0 };
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		found.below_most = most[l] > found.below_most ? most[l] : found.below_most;
		found.above_least = least[l] < found.above_least ? least[l] : found.above_least;
		found.below += (size_t)count[l];
	}
	for (size_t i = total / RUN_LENGTH * RUN_LENGTH; i < total; i++) {
		const bool below = list[i] < limit;
		found.below_most = below && list[i] > found.below_most ? list[i] : found.below_most;
		found.above_least = !below && list[i] < found.above_least ? list[i] : found.above_least;
		found.below += below;
	}
	*out = found;
}

RUNS_FUNCTION(find_sides, look_around,
              (const double *list, size_t total, double limit, struct sides *out),
              (list, total, limit, out))

/* A value of the list: fewer than place are below it, as many as count say; or more than place up to it. */
struct bound {
	double value;
	size_t count;
};

/* Where the value sought would be if `count` values lay as magnitudes of a normal variate do near their
 * median, of which one is known. */
static double as_normal(struct bound known, size_t place, size_t count)
{
	const double off = (double)place + 0.5 - (double)known.count;
	const double limit = known.value * (1 + off / (0.43 * (double)count));
	return isfinite(limit) ? limit : known.value;
}

/* Where to look next: where the value sought would be if they lay evenly, now and then half way. Beyond the
 * values while there is no bound on that side, but near the other one first. */
static double between(struct bound low, struct bound high, size_t place, size_t count,
                      unsigned looks)
{
	if (low.value == -INFINITY) {
		const double limit = as_normal(high, place, count);
		return looks < 3 && limit < high.value ? limit : -INFINITY;
	}
	if (high.value == INFINITY) {
		const double limit = as_normal(low, place, count);
		return looks < 3 && limit > low.value ? limit : INFINITY;
	}
	const double part = looks % 4 == 3 ? 0.5
	                                   : ((double)(place - low.count) + 0.5) /
	                                         (double)(high.count - low.count);
	const double limit = low.value + (high.value - low.value) * part;
	return limit > low.value && limit < high.value ? limit : high.value;
}

/* Values are counted, never moved: a look at all of them is a few vectors. Each one brings a bound nearer by
 * a value at least. */
double median_of_least(const double *list, size_t total, size_t count, double guess)
{
	const size_t place = count / 2;
	struct bound low = { -INFINITY, 0 }, high = { INFINITY, total };
	double limit = guess;
	for (unsigned looks = 0;; looks++) {
		struct sides sides;
		find_sides(list, total, limit, &sides);
		if (sides.below == place)
			return count % 2 != 0 ? sides.above_least
			                      : 0.5 * (sides.below_most + sides.above_least);
		if (sides.below < place)
			low = (struct bound){ sides.above_least, sides.below };
		else
			high = (struct bound){ sides.below_most, sides.below };
		/* Those in the middle are all alike. */
		if (low.value == high.value)
			return low.value;
		limit = between(low, high, place, count, looks);
	}
}
