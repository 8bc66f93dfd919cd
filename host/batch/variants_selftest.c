#include "batch/variants_selftest.h"

#include "batch/variants_batch.h"

#include <math.h>
#include <string.h>

enum {
	STATIONS = 7,
	WATERLINES = 5,
	NODES = STATIONS * WATERLINES,
	DRAFTS = 2,
	LANES_MOST = 16,
	ROWS_MOST = 2 * LANES_MOST + 1,
	NUMBERS = VARIANTS_OUT_COUNT + DRAFTS * VARIANTS_FORM_COUNT
};

/* Both sides of the comparison and what they are given. */
typedef struct test_batch {
	double asked[ROWS_MOST * VARIANTS_ASK_COUNT];
	double y[ROWS_MOST * NODES];
	uint8_t nodes[ROWS_MOST * NODES];
	double found_y[ROWS_MOST * NODES], known_y[ROWS_MOST * NODES];
	double found[ROWS_MOST * NUMBERS], known[ROWS_MOST * NUMBERS];
	double room[VARIANTS_ROOM(STATIONS, WATERLINES, DRAFTS) +
	            VARIANTS_ITEM_ROOM(STATIONS, WATERLINES) + NODES + NUMBERS];
} test_batch;

static double noise_of(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (double)(*state >> 8) / (double)(1u << 24) - 0.5;
}

/* Half-breadth of a hull with a stem that rakes: zeros below it. No library function takes part, so
 * every machine gets the same numbers. */
static double breadth_of(size_t waterline, size_t station)
{
	const double x = ((double)station - 3) / 3, z = (double)waterline / (WATERLINES - 1);
	const double y = (1 - x * x * x * x) * (0.3 + 0.7 * z) * (waterline > 0 ? 1.0 : 0.0);
	return station == STATIONS - 1 && waterline > 2 ? 0.05 * z : y;
}

/* Weights of trapezoids in place of splines: any linear ones do. */
static void make_sections(const variants_plan *plan)
{
	double *sections = variants_plan_table(plan, VARIANTS_AT_SECTIONS);
	double *bends = variants_plan_table(plan, VARIANTS_AT_BENDS);
	for (size_t d = 0; d <= DRAFTS; d++)
		for (size_t first = 0; first < WATERLINES; first++)
			for (size_t k = first; k < WATERLINES; k++) {
				double *weights = sections + (d * WATERLINES + first) * 3 * WATERLINES + k;
				const double weight = (k == first || k + 1 == WATERLINES ? 0.25 : 0.5) /
				                      (double)(d + 1);
				weights[0] = weight;
				weights[WATERLINES] = 0.25 * weight * (double)k;
				weights[2 * WATERLINES] = k + 1 + d == WATERLINES ? 1.0 : 0.0;
			}
	for (size_t first = 0; first < WATERLINES; first++)
		for (size_t k = first + 1; k + 1 < WATERLINES; k++) {
			double *row = bends + first * 4 * WATERLINES + k;
			row[0] = 6.0;
			row[WATERLINES] = row[2 * WATERLINES] = 0.125;
			row[3 * WATERLINES] = 1.0;
		}
}

static void make_rules(const variants_plan *plan)
{
	double *rule = variants_plan_table(plan, VARIANTS_AT_RULES);
	double *drafts = variants_plan_table(plan, VARIANTS_AT_DRAFTS);
	for (size_t g = 0; g < (size_t)5 * (DRAFTS + 1); g++, rule += 7) {
		const double u = 0.1 + 0.2 * (double)(g % 5);
		rule[0] = 1 - u;
		rule[1] = u;
		rule[2] = rule[3] = 0.125 * u;
		rule[4] = rule[5] = 0.25 - 0.5 * u;
		rule[6] = 0.2;
	}
	for (size_t d = 0; d <= DRAFTS; d++) {
		drafts[4 * d] = d == 0 || d == DRAFTS ? 1.0 : 0.6;
		drafts[4 * d + 1] = d == 0 || d == DRAFTS ? WATERLINES - 1 : 2;
		drafts[4 * d + 2] = d == 0 || d == DRAFTS ? 0.0 : 0.4;
		drafts[4 * d + 3] = 1e-9;
	}
}

/* Numbers like those of Lackenby's method for a parabolic curve of areas. */
static void make_formula(const variants_plan *plan)
{
	double *formula = variants_plan_table(plan, VARIANTS_AT_FORMULA);
	static const double numbers[VARIANTS_HALF_COUNT] = { 0, 3, 0.75, 0.4, 0.2, 0, 1, 4 };
	memcpy(formula + VARIANTS_FORMULA_AFT, numbers, sizeof numbers);
	memcpy(formula + VARIANTS_FORMULA_FORE, numbers, sizeof numbers);
	formula[VARIANTS_FORMULA_FULLNESS] = 0.75;
	formula[VARIANTS_FORMULA_MIDDLE] = formula[VARIANTS_FORMULA_AMIDSHIPS] = 3;
	formula[VARIANTS_FORMULA_LEAST_BODY] = formula[VARIANTS_FORMULA_NEAR] = 6e-9;
	formula[VARIANTS_FORMULA_LEAST] = 1e-12;
	formula[VARIANTS_FORMULA_LENGTH] = 6;
	formula[VARIANTS_FORMULA_PARENT_CP] = 0.8;
	formula[VARIANTS_FORMULA_SWING] = 0.1;
	formula[VARIANTS_FORMULA_SLOPE_LEAST] = -0.5;
	formula[VARIANTS_FORMULA_SLOPE_MOST] = 0.5;
}

static batten_status make_plan(batten_context *context, int method, variants_plan *plan)
{
	batten_status status = variants_plan_create(context, STATIONS, WATERLINES, DRAFTS, plan);
	if (status != BATTEN_OK)
		return status;
	double *x = variants_plan_table(plan, VARIANTS_AT_X);
	double *z = variants_plan_table(plan, VARIANTS_AT_Z);
	double *shift = variants_plan_table(plan, VARIANTS_AT_SHIFT);
	double *parent = variants_plan_table(plan, VARIANTS_AT_PARENT);
	double *nodes = variants_plan_table(plan, VARIANTS_AT_NODES);
	for (size_t i = 0; i < STATIONS; i++) {
		const double part = ((double)i - 3) / 3, away = part < 0 ? -part : part;
		x[i] = (double)i;
		shift[3 * i] = (part < 0 ? -3 : 3) * (1 - away);
		shift[3 * i + 1] = shift[3 * i] * away;
		shift[3 * i + 2] = i >= 3 ? 1 : 0;
	}
	for (size_t k = 0; k < WATERLINES; k++) {
		z[k] = 0.25 * (double)k;
		z[WATERLINES + k] = 4;
		variants_plan_table(plan, VARIANTS_AT_MIDDLE)[k] = breadth_of(k, 3);
		for (size_t i = 0; i < STATIONS; i++) {
			parent[k * STATIONS + i] = breadth_of(k, i);
			nodes[k * STATIONS + i] = VARIANTS_NODE_BESIDE;
		}
	}
	/* an end off the table; half-breadths given reach it */
	if (method == VARIANTS_GIVEN) {
		double *end = variants_plan_table(plan, VARIANTS_AT_ENDS) + 4 * 3;
		end[0] = -0.25;
		end[1] = 0.0;
	}
	plan->shape[VARIANTS_METHOD] = method;
	plan->shape[VARIANTS_LISTED] = 1;
	plan->shape[VARIANTS_BEFORE_BODY] = 3;
	plan->shape[VARIANTS_WITHIN_BODY] = 1;
	make_sections(plan);
	make_rules(plan);
	make_formula(plan);
	return BATTEN_OK;
}

/* Two full groups of lanes and one more, so that lanes left over are met too; every row its own. */
static void make_rows(test_batch *t, variants_plan *plan, size_t count)
{
	uint32_t state = 20011u;
	plan->count = count;
	for (size_t r = 0; r < count; r++) {
		for (size_t i = 0; i < VARIANTS_ASK_COUNT; i++)
			t->asked[r * VARIANTS_ASK_COUNT + i] = (i < 2        ? 6.0
			                                        : r % 3 == 0 ? 0.1
			                                                     : 0.0) *
			                                       noise_of(&state);
		for (size_t n = 0; n < NODES; n++) {
			const double y = breadth_of(n / STATIONS, n % STATIONS);
			t->y[r * NODES + n] = y > 0 ? y * (1 + 0.2 * noise_of(&state)) : 0;
			/* the stem's zeros, and here and there a hole */
			t->nodes[r * NODES + n] = y > 0 || n % STATIONS < 6 ? BATTEN_NODE_GIVEN
			                                                    : BATTEN_NODE_OUTSIDE;
		}
	}
	if (plan->shape[VARIANTS_METHOD] != VARIANTS_GIVEN) {
		plan->asked = t->asked;
		return;
	}
	plan->y_m = t->y;
	plan->nodes = t->nodes;
}

static void compare(const test_batch *t, const variants_plan *plan, batten_selftest *test,
                    double *worst)
{
	for (size_t n = 0; n < plan->count * NUMBERS; n++) {
		test->different += memcmp(&t->found[n], &t->known[n], sizeof t->found[n]) != 0;
		const double off = fabs(t->found[n] - t->known[n]) / (1.0 + fabs(t->known[n]));
		if (!(off <= *worst) && !(isnan(t->found[n]) && isnan(t->known[n])))
			*worst = off;
	}
	test->compared += plan->count * NUMBERS;
	for (size_t n = 0; plan->asked && n < plan->count * NODES; n++)
		test->different += memcmp(&t->found_y[n], &t->known_y[n], sizeof t->found_y[n]) != 0;
	test->compared += plan->asked ? plan->count * NODES : 0;
}

static batten_status run_both(batch_engine *engine, test_batch *t, variants_plan *plan)
{
	size_t which[ROWS_MOST];
	for (size_t r = 0; r < plan->count; r++)
		which[r] = r;
	plan->out = t->found;
	plan->found_y_m = plan->asked ? t->found_y : NULL;
	const double begun = batten_wall_seconds();
	const batten_status status = variants_engine_run(engine, plan, which, plan->count);
	engine->test.run_s += batten_wall_seconds() - begun;
	plan->out = t->known;
	plan->found_y_m = plan->asked ? t->known_y : NULL;
	double *y = t->room + variants_plan_room(plan, 1);
	for (size_t r = 0; r < plan->count && status == BATTEN_OK; r++)
		variants_reference_run(plan, r, t->room, y, y + NODES);
	return status;
}

batten_status variants_selftest_run(batch_engine *engine)
{
	static const int methods[] = { VARIANTS_GIVEN, VARIANTS_SWING, VARIANTS_HALVES };
	double worst = 0.0;
	test_batch *t = batten_allocate(engine->context, 1, sizeof *t);
	batten_status status = t ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t m = 0; m < 3 && status == BATTEN_OK; m++) {
		variants_plan plan = { 0 };
		status = make_plan(engine->context, methods[m], &plan);
		if (status == BATTEN_OK) {
			make_rows(t, &plan, 2 * (size_t)engine->recipe.lanes + 1);
			status = run_both(engine, t, &plan);
		}
		if (status == BATTEN_OK)
			compare(t, &plan, &engine->test, &worst);
		variants_plan_destroy(&plan);
	}
	/* Other last bits may end the correction of a row a pass earlier or later: on PoCL with relaxed
	 * mathematics numbers differ by up to 6e-9. */
	if (status == BATTEN_OK)
		batch_engine_compare(&engine->test, worst, 1e-7, "a number");
	batten_release(engine->context, t);
	return status;
}
