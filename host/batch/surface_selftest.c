#include "batch/surface_selftest.h"

#include "batch/surface_reference.h"

#include <math.h>
#include <string.h>

enum {
	SAMPLES_U = 10,
	SAMPLES_V = 5,
	SAMPLES = SAMPLES_U * SAMPLES_V,
	SEGMENT = 2,
	TABLE_ROWS_MOST = SURFACE_TABLE_ROWS(SURFACE_OUTPUT_VARIATION),
	POLES_MOST = SURFACE_ORDER_MOST + 3,
	LANES_MOST = 16,
	SURFACES_MOST = 2 * LANES_MOST + 1
};

/* Room for one direction. */
typedef struct test_direction {
	int32_t first[SAMPLES_U];
	double table[SAMPLES_U * SURFACE_TABLE_SIZE(TABLE_ROWS_MOST, SURFACE_ORDER_MOST)];
} test_direction;

/* Two sides of the comparison and what both are given. */
typedef struct test_batch {
	test_direction u, v;
	double poles[SURFACES_MOST][POLES_MOST * POLES_MOST * 3];
	double weights[SURFACES_MOST][POLES_MOST * POLES_MOST];
	surface_item items[SURFACES_MOST];
	double found[SURFACES_MOST * SURFACE_EVERYTHING_COUNT * SAMPLES];
	double known[SURFACES_MOST * SURFACE_EVERYTHING_COUNT * SAMPLES];
	uint8_t found_singular[SURFACES_MOST * SAMPLES], known_singular[SURFACES_MOST * SAMPLES];
} test_batch;

/* Bernstein polynomials at t (thesis 3.2; Letcher 3.7, N = k), degree = order - 1. */
static void bernstein(size_t order, double t, double *values)
{
	values[0] = 1.0;
	for (size_t degree = 1; degree < order; degree++) {
		values[degree] = t * values[degree - 1];
		for (size_t i = degree - 1; i > 0; i--)
			values[i] = (1.0 - t) * values[i] + t * values[i - 1];
		values[0] *= 1.0 - t;
	}
}

/* The derivative of a basis from that of one order less. */
static void differentiate(size_t order, const double *lower, double *values)
{
	for (size_t i = 0; i < order; i++) {
		const double before = i > 0 ? lower[i - 1] : 0.0;
		const double here = i + 1 < order ? lower[i] : 0.0;
		values[i] = (double)(order - 1) * (before - here);
	}
}

/* Derivative number `derivative` of the polynomials at t, 0 beyond the degree. */
static void bernstein_derivative(size_t order, size_t derivative, double t, double *values)
{
	double lower[SURFACE_ORDER_MOST] = { 0.0 };
	if (derivative >= order) {
		memset(values, 0, order * sizeof *values);
	} else if (derivative == 0) {
		bernstein(order, t, values);
	} else {
		bernstein_derivative(order - 1, derivative - 1, t, lower);
		differentiate(order, lower, values);
	}
}

/* Patches of a net, one after the other, each sampled from its one end to its other. No library
 * function takes part, so every machine gets the same numbers. */
static surface_samples make_direction(size_t order, size_t rows, size_t poles, size_t count,
                                      test_direction *d)
{
	for (size_t n = 0; n < count; n++) {
		double *row = d->table + n * SURFACE_TABLE_SIZE(rows, order);
		d->first[n] = (int32_t)(n / 2 % (poles - order + 1));
		for (size_t k = 0; k < rows; k++)
			bernstein_derivative(order, k, 0.25 * (double)(n % 5), row + k * order);
		row[rows * order] = 0.125 + 0.0625 * (double)(n % 3);
	}
	return (surface_samples){ .order = order,
		                      .rows = rows,
		                      .poles = poles,
		                      .count = count,
		                      .first = d->first,
		                      .table = d->table };
}

/* A hull-like net with noise; the second surface is shrunk to a point on one side, so that there are
 * points without a normal. */
static void make_item(test_batch *t, size_t s, const surface_plan *plan, uint32_t *state)
{
	for (size_t k = 0; k < plan->v.poles; k++)
		for (size_t i = 0; i < plan->u.poles; i++) {
			const size_t n = k * plan->u.poles + i;
			const double a = (double)(s == 1 && i < plan->u.order ? 0 : i);
			const double b = (double)(s == 1 && i < plan->u.order ? 0 : k);
			*state = *state * 1664525u + 1013904223u;
			const double noise = (double)(*state >> 8) / (double)(1u << 24) - 0.5;
			double *pole = t->poles[s] + 3 * n;
			pole[0] = 2.0 * a;
			pole[1] = 0.25 + 0.125 * a * (6.0 - a) + 0.5 * b + (a > 0.0 ? 0.25 * noise : 0.0);
			pole[2] = b;
			t->weights[s][n] = 1.0 + 0.5 * noise;
		}
	t->items[s] = (surface_item){ .poles_m = t->poles[s],
		                          .weights = plan->rational ? t->weights[s] : NULL,
		                          .area = 4.0 };
}

static surface_plan make_plan(test_batch *t, const batch_engine *engine, const surface_plan *model)
{
	surface_plan plan = { .context = engine->context,
		                  .output = model->output,
		                  .rational = model->rational,
		                  .light = { 0.48, 0.6, 0.64 },
		                  .segment_length = SEGMENT,
		                  .precision = engine->recipe.precision,
		                  .lanes = engine->recipe.lanes,
		                  .work_group = engine->recipe.work_group };
	const size_t rows = SURFACE_TABLE_ROWS(model->output);
	plan.u = make_direction(model->u.order, rows, model->u.order + 3, SAMPLES_U, &t->u);
	plan.v = make_direction(model->v.order, rows, model->v.order + 2, SAMPLES_V, &t->v);
	/* Two full groups of lanes and one more, so that lanes left over are met too. */
	plan.count = 2 * (size_t)engine->recipe.lanes + 1;
	uint32_t state = 20011u;
	for (size_t s = 0; s < plan.count; s++)
		make_item(t, s, &plan, &state);
	plan.items = t->items;
	plan.floats = model->floats;
	return plan;
}

static double value_of(const surface_plan *plan, const double *values, size_t n)
{
	return plan->floats ? (double)((const float *)values)[n] : values[n];
}

static void compare(const surface_plan *plan, const test_batch *t, batten_selftest *test)
{
	const bool sums = SURFACE_SUMS(plan->output);
	const size_t each = surface_plan_values(plan) * (sums ? 1 : SAMPLES);
	double worst = 0.0;
	for (size_t n = 0; n < plan->count * each; n++) {
		const double found = value_of(plan, t->found, n);
		const double known = value_of(plan, t->known, n);
		test->different += memcmp(&found, &known, sizeof found) != 0;
		const double off = fabs(found - known) / (1.0 + fabs(known));
		if (!(off <= worst))
			worst = off;
	}
	test->compared += plan->count * each;
	for (size_t n = 0; n < plan->count * SAMPLES && !sums; n++)
		test->different += t->found_singular[n] != t->known_singular[n];
	batch_engine_compare(test, worst, test->precision == BATTEN_F64 ? 1e-9 : 1e-2, "a value");
}

static batten_status run_both(batch_engine *engine, surface_plan *plan, test_batch *t)
{
	size_t which[SURFACES_MOST];
	for (size_t s = 0; s < plan->count; s++)
		which[s] = s;
	plan->values = t->found;
	plan->singular = t->found_singular;
	const double begun = batten_wall_seconds();
	batten_status status = surface_engine_run(engine, plan, which, plan->count);
	engine->test.run_s = batten_wall_seconds() - begun;
	surface_reference reference = { 0 };
	plan->values = t->known;
	plan->singular = t->known_singular;
	if (status == BATTEN_OK)
		status = surface_reference_create(plan, &reference);
	for (size_t s = 0; s < plan->count && status == BATTEN_OK; s++)
		surface_reference_run(&reference, s);
	surface_reference_release(&reference);
	return status;
}

batten_status surface_selftest_run(batch_engine *engine, const surface_plan *plan)
{
	test_batch *t = batten_allocate(engine->context, 1, sizeof *t);
	if (!t)
		return BATTEN_MEMORY;
	surface_plan small = make_plan(t, engine, plan);
	const batten_status status = run_both(engine, &small, t);
	if (status == BATTEN_OK)
		compare(&small, t, &engine->test);
	batten_release(engine->context, t);
	return status;
}
