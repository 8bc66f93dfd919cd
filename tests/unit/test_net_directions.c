/* Directions of one colour of a net search may be worked in any order: by brute force, no two of them
 * share a sample, and neither reads a pole the other moves. */
#include "batten.h"

#include "batch/net_plan.h"
#include "fairing/net_tables.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { POINTS = 2, MOST = 32 * 16 };

typedef struct directions_case {
	net_plan plan;
	net_item item;
	size_t leader[MOST];
	double poles[3 * MOST], lower[MOST], upper[MOST], target[MOST];
} directions_case;

/* Orders and counts with one knot repeated, so that a sample's first pole leaps. */
static directions_case *open_case(size_t order_u, size_t count_u, size_t order_v, size_t count_v,
                                  bool leaders)
{
	double knots[64];
	directions_case *d = calloc(1, sizeof *d);
	assert_non_null(d);
	assert_int_equal(batten_context_create(NULL, &d->plan.context), BATTEN_OK);
	bspline_knots_clamped(order_u, count_u, knots);
	knots[order_u + 1] = knots[order_u];
	assert_int_equal(
		net_tables_create(d->plan.context, order_u, count_u, knots, POINTS, &d->plan.u), BATTEN_OK);
	bspline_knots_clamped(order_v, count_v, knots);
	assert_int_equal(
		net_tables_create(d->plan.context, order_v, count_v, knots, POINTS, &d->plan.v), BATTEN_OK);
	for (size_t n = 0; n < count_u * count_v; n++) {
		d->lower[n] = n % 5 == 0 ? 0.0 : -1.0;
		d->upper[n] = n % 5 == 0 ? 0.0 : 1.0;
		d->leader[n] = n;
		/* The second row moves with the first, one pole with another far away. */
		if (leaders && n / count_u == 1)
			d->leader[n] = n - count_u;
	}
	if (leaders)
		d->leader[count_u * count_v - 1] = 2;
	d->item = (net_item){ .poles_m = d->poles,
		                  .target_y_m = d->target,
		                  .lower_y_m = d->lower,
		                  .upper_y_m = d->upper,
		                  .stretch = 2 };
	d->plan.leader = d->leader;
	d->plan.count = 1;
	d->plan.items = &d->item;
	assert_int_equal(net_directions_create(&d->plan, 2, &d->plan.directions), BATTEN_OK);
	return d;
}

static void close_case(directions_case *d)
{
	batten_context *context = d->plan.context;
	net_directions_release(context, &d->plan.directions);
	net_tables_release(context, &d->plan.u);
	net_tables_release(context, &d->plan.v);
	batten_context_destroy(context);
	free(d);
}

static bool sees(const net_samples *samples, size_t sample, size_t pole)
{
	const size_t first = (size_t)samples->first[sample];
	return pole >= first && pole < first + samples->order;
}

/* What a direction writes, which samples change with it, and what these read. */
typedef struct footprint {
	uint8_t writes[MOST], samples[4 * MOST], reads[MOST];
} footprint;

static void trace(const net_plan *plan, size_t number, footprint *f)
{
	const int32_t *d = plan->directions.directions + number * NET_DIRECTION_SIZE;
	const size_t columns = plan->u.poles;
	memset(f, 0, sizeof *f);
	assert_true(plan->u.count * plan->v.count <= sizeof f->samples);
	for (int32_t m = d[NET_DIRECTION_FIRST]; m < d[NET_DIRECTION_END]; m++) {
		assert_true(plan->directions.heights[m] > 0.0 && plan->directions.heights[m] <= 1.0);
		f->writes[plan->directions.members[m]] = 1;
	}
	for (size_t s = 0; s < plan->u.count * plan->v.count; s++) {
		const size_t i = s % plan->u.count;
		const size_t k = s / plan->u.count;
		const bool within = (int)i >= d[NET_DIRECTION_SAMPLE] &&
		                    (int)i < d[NET_DIRECTION_SAMPLE_END] &&
		                    (int)k >= d[NET_DIRECTION_LINE] && (int)k < d[NET_DIRECTION_LINE_END];
		for (size_t n = 0; n < columns * plan->v.poles; n++)
			if (f->writes[n] && sees(&plan->u, i, n % columns) && sees(&plan->v, k, n / columns)) {
				/* Every sample that changes is one the direction looks at. */
				assert_true(within);
			}
		f->samples[s] = within;
		for (size_t n = 0; within && n < columns * plan->v.poles; n++)
			f->reads[n] |= sees(&plan->u, i, n % columns) && sees(&plan->v, k, n / columns);
	}
}

static void check_colours(const net_plan *plan)
{
	const net_directions *made = &plan->directions;
	footprint *one = calloc(2, sizeof *one);
	assert_non_null(one);
	footprint *other = one + 1;
	assert_int_equal(made->colours[0], 0);
	assert_int_equal(made->colours[made->colour_count], made->direction_count);
	for (size_t c = 0; c < made->colour_count; c++)
		for (int32_t a = made->colours[c]; a < made->colours[c + 1]; a++) {
			trace(plan, (size_t)a, one);
			for (int32_t b = a + 1; b < made->colours[c + 1]; b++) {
				trace(plan, (size_t)b, other);
				for (size_t s = 0; s < plan->u.count * plan->v.count; s++)
					assert_false(one->samples[s] && other->samples[s]);
				for (size_t n = 0; n < net_plan_poles(plan); n++) {
					assert_false(one->writes[n] && other->reads[n]);
					assert_false(one->reads[n] && other->writes[n]);
				}
			}
		}
	free(one);
}

/* Every leader that can move has a direction of its own, in which it moves by the whole step and
 * nothing moves but what follows it. */
static void check_finest(const directions_case *d)
{
	const net_plan *plan = &d->plan;
	const net_directions *made = &plan->directions;
	net_room rooms[MOST];
	net_rooms_of(plan, &d->item, rooms);
	for (size_t n = 0; n < net_plan_poles(plan); n++) {
		size_t own = 0;
		if (d->leader[n] != n || !(rooms[n].down < rooms[n].up))
			continue;
		for (size_t a = 0; a < made->direction_count; a++) {
			const int32_t *e = made->directions + a * NET_DIRECTION_SIZE;
			bool alone = true;
			for (int32_t m = e[NET_DIRECTION_FIRST]; m < e[NET_DIRECTION_END]; m++)
				alone = alone && d->leader[made->members[m]] == n && made->heights[m] == 1.0;
			own += alone && e[NET_DIRECTION_FIRST] < e[NET_DIRECTION_END];
		}
		assert_true(own >= 1);
	}
}

static void check(size_t order_u, size_t count_u, size_t order_v, size_t count_v)
{
	for (int leaders = 0; leaders < 2; leaders++) {
		directions_case *d = open_case(order_u, count_u, order_v, count_v, leaders);
		check_colours(&d->plan);
		check_finest(d);
		close_case(d);
	}
}

static void test_bicubic(void **state)
{
	(void)state;
	check(4, 16, 4, 10);
}

static void test_other_orders(void **state)
{
	(void)state;
	check(2, 7, 3, 9);
	check(6, 12, 2, 6);
	check(3, 6, 8, 9);
}

/* What a leader and its followers share of their boxes. */
static void test_rooms(void **state)
{
	(void)state;
	directions_case *d = open_case(4, 8, 4, 6, true);
	net_room rooms[MOST];
	d->lower[1] = -0.25;
	d->upper[9] = 0.5;
	d->upper[2] = d->lower[2] = 0.0;
	net_rooms_of(&d->plan, &d->item, rooms);
	assert_true(rooms[1].down == -0.25 && rooms[1].up == 0.5);
	assert_true(rooms[9].down == -0.25 && rooms[9].up == 0.5);
	assert_true(rooms[2].down == 0.0 && rooms[2].up == 0.0);
	assert_true(rooms[47].down == 0.0 && rooms[47].up == 0.0);
	close_case(d);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_bicubic),
		cmocka_unit_test(test_other_orders),
		cmocka_unit_test(test_rooms),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
