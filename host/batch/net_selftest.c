#include "batch/net_selftest.h"

#include "batch/net_engine.h"
#include "batch/net_reference.h"
#include "shared/net_block_layout.h"

#include <math.h>
#include <string.h>

enum {
	POINTS = 2,
	SPANS = 5,
	POLES_MOST = NET_ORDER_MOST + SPANS - 1, /* along one direction */
	SAMPLES_MOST = (POLES_MOST - 1) * NET_POINTS_MOST,
	NET_MOST = POLES_MOST * POLES_MOST,
	SEARCHES_MOST = BATCH_TEST_MOST
};

/* Searches on one net and what both sides found. */
typedef struct test_batch {
	int32_t first[2][SAMPLES_MOST];
	double table[2][SAMPLES_MOST * NET_TABLE_SIZE(NET_ORDER_MOST)];
	double poles[SEARCHES_MOST][3 * NET_MOST];
	double target[NET_MOST], lower[NET_MOST], upper[NET_MOST];
	size_t leader[NET_MOST];
	net_item items[SEARCHES_MOST];
	double found_y[SEARCHES_MOST * NET_MOST], known_y[SEARCHES_MOST * NET_MOST];
	batten_search_result found[SEARCHES_MOST], known[SEARCHES_MOST];
} test_batch;

static double noise_of(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (double)(*state >> 8) / (double)(1u << 24) - 0.5;
}

/* Values of a basis of `order` smooth functions that add up to 1, and derivatives up to the third:
 * Bernstein polynomials (Letcher 3.7), each derivative from those of one order less. No library
 * function takes part, so every machine gets the same numbers. */
static void bernstein(size_t order, double t, double *rows)
{
	for (size_t d = 0; d < 4; d++) {
		double *row = rows + d * order;
		const size_t degree = order - 1;
		for (size_t i = 0; i < order; i++)
			row[i] = 0.0;
		if (d > degree)
			continue;
		row[0] = 1.0;
		for (size_t n = 1; n <= degree - d; n++) {
			row[n] = t * row[n - 1];
			for (size_t i = n - 1; i > 0; i--)
				row[i] = (1.0 - t) * row[i] + t * row[i - 1];
			row[0] *= 1.0 - t;
		}
		for (size_t n = degree - d + 1; n <= degree; n++)
			for (size_t i = n + 1; i-- > 0;)
				row[i] = (double)n * ((i > 0 ? row[i - 1] : 0.0) - (i < n ? row[i] : 0.0));
	}
}

/* Patches of a net, one after the other; all that is asked of it is the same on both sides. */
static net_samples make_direction(const net_samples *like, size_t spans, int32_t *first,
                                  double *table)
{
	const size_t order = like->order;
	const size_t points = like->points ? like->points : POINTS;
	for (size_t n = 0; n < spans * points; n++) {
		double *row = table + n * NET_TABLE_SIZE(order);
		bernstein(order, ((double)(n % points) + 0.5) / (double)points, row);
		row[NET_TABLE_SIZE(order) - 1] = 1.0 / (double)points;
		first[n] = (int32_t)(n / points);
	}
	return (net_samples){ .order = order,
		                  .poles = order + spans - 1,
		                  .count = spans * points,
		                  .points = points,
		                  .first = first,
		                  .table = table };
}

/* A convex shell with noise; a fixed edge, one that keeps its tangents, poles at their bounds. */
static void make_searches(test_batch *t, net_plan *plan)
{
	const size_t columns = plan->u.poles;
	const size_t poles = net_plan_poles(plan);
	uint32_t state = 20011u;
	for (size_t n = 0; n < poles; n++) {
		const double u = (double)(n % columns) / (double)(columns - 1);
		const size_t row = n / columns;
		const double v = (double)row / (double)(plan->v.poles - 1);
		const bool fixed = n < columns;
		const double form = 1.0 + u * (1.0 - u) + v * (2.0 - v);
		for (size_t p = 0; p < plan->count; p++) {
			double *pole = t->poles[p] + 3 * n;
			pole[0] = 4.0 * u;
			pole[1] = form + (fixed ? 0.0 : 0.0625 * noise_of(&state));
			pole[2] = v + 0.03125 * (double)(p % 4) * u;
		}
		t->target[n] = form;
		t->lower[n] = fixed ? form : form - 0.046875;
		t->upper[n] = fixed ? form : form + (n % 7 == 0 ? 0.0078125 : 0.046875);
		/* The last column moves with the one before it. */
		t->leader[n] = n % columns == columns - 1 ? n - 1 : n;
	}
	for (size_t p = 0; p < plan->count; p++)
		t->items[p] = (net_item){ .poles_m = t->poles[p],
			                      .target_y_m = t->target,
			                      .lower_y_m = t->lower,
			                      .upper_y_m = t->upper,
			                      .w1 = 1.0,
			                      .w2 = ldexp(1.0, (int)p % 12),
			                      .half_beam_m = 1.0,
			                      .stretch = 1 };
}

static bool equal_bits(double a, double b)
{
	return memcmp(&a, &b, sizeof a) == 0;
}

static void compare(const test_batch *t, const net_plan *plan, batten_selftest *test)
{
	const size_t poles = net_plan_poles(plan);
	double worst = 0.0;
	for (size_t p = 0; p < plan->count; p++) {
		const batten_search_result *a = &t->found[p];
		const batten_search_result *b = &t->known[p];
		for (size_t n = 0; n < poles; n++)
			test->different += !equal_bits(t->found_y[p * poles + n], t->known_y[p * poles + n]);
		test->different += !equal_bits(a->objective_start, b->objective_start);
		test->different += !equal_bits(a->objective_end, b->objective_end);
		test->different += !equal_bits(a->last_step_m, b->last_step_m);
		test->different += a->iterations != b->iterations;
		test->different += a->probes != b->probes;
		test->compared += poles + 5;
		const double off = fabs(a->objective_end - b->objective_end) / b->objective_end;
		if (!(off <= worst))
			worst = off;
	}
	batch_engine_compare(test, worst, test->precision == BATTEN_F64 ? 1e-6 : 1e-3, "the objective");
}

static batten_status run_both(batch_engine *engine, const net_selftest_sides *sides, test_batch *t,
                              net_plan *plan)
{
	size_t which[SEARCHES_MOST];
	for (size_t p = 0; p < plan->count; p++)
		which[p] = p;
	plan->y_m = t->found_y;
	plan->results = t->found;
	const double begun = batten_wall_seconds();
	batten_status status = sides->run(engine, plan, which, plan->count);
	engine->test.run_s = batten_wall_seconds() - begun;
	plan->y_m = t->known_y;
	plan->results = t->known;
	if (status == BATTEN_OK)
		status = sides->run_known(plan);
	if (status == BATTEN_OK)
		compare(t, plan, &engine->test);
	return status;
}

batten_status net_selftest_compare(batch_engine *engine, const net_plan *plan,
                                   const net_selftest_sides *sides)
{
	test_batch *t = batten_allocate(plan->context, 1, sizeof *t);
	if (!t)
		return BATTEN_MEMORY;
	net_plan test = { .context = plan->context,
		              .options = plan->options,
		              .fairness = plan->fairness,
		              .leader = t->leader,
		              .count = batch_engine_test_count(engine->recipe.lanes),
		              .items = t->items };
	const size_t short_by = plan->u.order < plan->v.order ? plan->v.order - plan->u.order : 0;
	test.options.first_step = 0.02;
	test.options.last_step = plan->options.precision == BATTEN_F64 ? 1e-4 : 1e-3;
	test.options.iteration_limit = 12;
	test.u = make_direction(&plan->u, SPANS + short_by, t->first[0], t->table[0]);
	test.v = make_direction(&plan->v, SPANS, t->first[1], t->table[1]);
	make_searches(t, &test);
	batten_status status = net_directions_create(&test, 1, &test.directions);
	if (status == BATTEN_OK)
		status = run_both(engine, sides, t, &test);
	net_directions_release(plan->context, &test.directions);
	batten_release(plan->context, t);
	return status;
}

static batten_status run_known(const net_plan *plan)
{
	net_reference reference = { 0 };
	const batten_status status = net_reference_create(plan, &reference);
	for (size_t p = 0; p < plan->count && status == BATTEN_OK; p++)
		net_reference_run(&reference, p);
	net_reference_release(&reference);
	return status;
}

batten_status net_selftest_run(batch_engine *engine, const net_plan *plan)
{
	static const net_selftest_sides sides = { net_engine_run, run_known };
	net_plan two_points = *plan;
	two_points.u.points = two_points.v.points = 0;
	return net_selftest_compare(engine, &two_points, &sides);
}
