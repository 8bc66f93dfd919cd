#include "batch/afloat_selftest.h"

#include "batch/afloat_batch.h"
#include "batch/afloat_engine.h"

#include <math.h>
#include <string.h>

/* A small net of few Gauss points: what counts is that every path is taken. */
enum {
	ORDER_U = 3,
	ORDER_V = 4,
	COUNT_U = 5,
	COUNT_V = 5,
	POINTS = 3,
	NODES = COUNT_U * COUNT_V,
	DRAFTS = 3,
	LANES_MOST = 16,
	SURFACES_MOST = 2 * LANES_MOST + 1,
	NUMBERS = AFLOAT_OUTCOME(DRAFTS)
};

/* Both sides of the comparison and what they are given. */
typedef struct test_batch {
	double poles[SURFACES_MOST][3 * NODES], weights[SURFACES_MOST][NODES];
	afloat_item items[SURFACES_MOST];
	double found[SURFACES_MOST * NUMBERS], known[SURFACES_MOST * NUMBERS];
	double net[4 * NODES], room[AFLOAT_ROOM(COUNT_U, COUNT_V)];
} test_batch;

static double noise_of(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (double)(*state >> 8) / (double)(1u << 24) - 0.5;
}

/* A hull with raked ends, one of them full, and a sheer that the waterline cuts; every surface its own.
 * No library function takes part, so every machine gets the same numbers. */
static void make_surface(test_batch *t, size_t which, bool rational, uint32_t *state)
{
	for (size_t n = 0; n < NODES; n++) {
		const double along = (double)(n % COUNT_U) / (COUNT_U - 1) - 0.5;
		const size_t row = n / COUNT_U;
		const double up = (double)row / (COUNT_V - 1);
		double *p = t->poles[which] + 3 * n;
		p[0] = 10 * along + 5 + 2 * along * up + 0.3 * noise_of(state);
		p[1] = n < COUNT_U ? 0 : (1.25 - 4 * along * (along + 0.1)) * up;
		p[1] *= 1 + 0.1 * noise_of(state);
		p[2] = 2 * up + 2 * along * along * (1 - 0.5 * up) + 0.05 * noise_of(state);
		t->weights[which][n] = 1 + 0.5 * noise_of(state);
	}
	t->items[which] = (afloat_item){ t->poles[which], rational ? t->weights[which] : NULL };
}

static void compare(const test_batch *t, size_t count, batten_selftest *test, double *worst)
{
	for (size_t n = 0; n < count * NUMBERS; n++) {
		test->different += memcmp(&t->found[n], &t->known[n], sizeof t->found[n]) != 0;
		const double off = fabs(t->found[n] - t->known[n]) / (1.0 + fabs(t->known[n]));
		if (!(off <= *worst))
			*worst = off;
	}
	test->compared += count * NUMBERS;
}

static batten_status run_both(batch_engine *engine, test_batch *t, afloat_plan *plan)
{
	size_t which[SURFACES_MOST];
	for (size_t i = 0; i < plan->count; i++)
		which[i] = i;
	plan->out = t->found;
	const double begun = batten_wall_seconds();
	const batten_status status = afloat_engine_run(engine, plan, which, plan->count);
	engine->test.run_s += batten_wall_seconds() - begun;
	for (size_t i = 0; i < plan->count && status == BATTEN_OK; i++)
		afloat_reference_run(plan, i, t->net, t->known + i * NUMBERS, t->room);
	return status;
}

static batten_status test_kind(batch_engine *engine, test_batch *t, bool rational, double *worst)
{
	static const double knots_u[COUNT_U + ORDER_U] = { 0, 0, 0, 1, 2.5, 3, 3, 3 };
	static const double knots_v[COUNT_V + ORDER_V] = { 0, 0, 0, 0, 0.25, 1, 1, 1, 1 };
	static const double drafts[DRAFTS] = { 1.5, 0.5, 1.0 };
	const afloat_topology topology = {
		{ ORDER_U, ORDER_V }, { COUNT_U, COUNT_V }, { knots_u, knots_v }, rational, POINTS
	};
	afloat_plan plan;
	uint32_t state = 20011u;
	batten_status status = afloat_plan_create(engine->context, &topology, DRAFTS, drafts, 0, &plan);
	if (status != BATTEN_OK)
		return status;
	/* two full groups of lanes and one more, so that lanes left over are met too */
	plan.count = 2 * (size_t)engine->recipe.lanes + 1;
	plan.items = t->items;
	for (size_t i = 0; i < plan.count; i++)
		make_surface(t, i, rational, &state);
	status = run_both(engine, t, &plan);
	if (status == BATTEN_OK)
		compare(t, plan.count, &engine->test, worst);
	afloat_plan_destroy(&plan);
	return status;
}

batten_status afloat_selftest_run(batch_engine *engine)
{
	double worst = 0.0;
	test_batch *t = batten_allocate(engine->context, 1, sizeof *t);
	batten_status status = t ? test_kind(engine, t, false, &worst) : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = test_kind(engine, t, true, &worst);
	if (status == BATTEN_OK)
		batch_engine_compare(&engine->test, worst, 1e-7, "a number");
	batten_release(engine->context, t);
	return status;
}
