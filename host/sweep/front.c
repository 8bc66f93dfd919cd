#include "sweep/front.h"

#include <stdlib.h>
#include <string.h>

/* One point as it is sorted. */
struct point {
	const double *values;
	size_t objectives, number;
};

static int by_values(const void *a, const void *b)
{
	const struct point *p = a;
	const struct point *q = b;
	for (size_t o = 0; o < p->objectives; o++)
		if (p->values[o] != q->values[o])
			return p->values[o] < q->values[o] ? -1 : 1;
	return p->number < q->number ? -1 : p->number > q->number;
}

/* Whether a, which is not behind b in the order, dominates it. Equals do not. */
static bool dominates(const struct point *a, const struct point *b)
{
	bool better = false;
	for (size_t o = 0; o < a->objectives; o++) {
		if (a->values[o] > b->values[o])
			return false;
		better = better || a->values[o] < b->values[o];
	}
	return better;
}

/* Two objectives, in order of the first: on the front is what has a second less than all before it, and
 * its equals. */
static void sweep_two(const struct point *points, size_t count, uint8_t *on_front)
{
	const struct point *last = NULL; /* the last one on the front */
	for (size_t i = 0; i < count; i++) {
		const double *values = points[i].values;
		const bool equal = last && values[0] == last->values[0] && values[1] == last->values[1];
		on_front[points[i].number] = !last || equal || values[1] < last->values[1];
		if (on_front[points[i].number])
			last = &points[i];
	}
}

/* Any number: only what came before in the order can dominate, and of that only the front need be
 * asked. What has dominated is asked first next time. */
static void scan(const struct point *points, size_t count, struct point *front, uint8_t *on_front)
{
	size_t size = 0;
	for (size_t i = 0; i < count; i++) {
		size_t f = 0;
		while (f < size && !dominates(&front[f], &points[i]))
			f++;
		on_front[points[i].number] = f == size;
		if (f == size) {
			front[size++] = points[i];
		} else if (f > 0) {
			const struct point hit = front[f];
			front[f] = front[f / 2];
			front[f / 2] = hit;
		}
	}
}

batten_status sweep_front_find(batten_context *context, size_t count, size_t objectives,
                               const double *values, uint8_t *on_front)
{
	struct point *points = batten_allocate(context, count, sizeof *points);
	struct point *front = batten_allocate(context, count, sizeof *front);
	if (points && front) {
		for (size_t i = 0; i < count; i++)
			points[i] = (struct point){ values + i * objectives, objectives, i };
		qsort(points, count, sizeof *points, by_values);
		if (objectives == 2)
			sweep_two(points, count, on_front);
		else
			scan(points, count, front, on_front);
	}
	const batten_status status = points && front ? BATTEN_OK : BATTEN_MEMORY;
	batten_release(context, points);
	batten_release(context, front);
	return status;
}
