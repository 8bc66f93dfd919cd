/* How far rows can go that the device found out of reach: what iterate.c looks for of one row, of many at
 * once. */
#include "variation/measure.h"

#include "batch/variants_batch.h"
#include "variation/targets.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* As in iterate.c: bisected between the parent and what is asked for, and as far as four times that on the
 * other side. */
enum { HALVINGS = 9, SIDES = 2 };
static const double limits[SIDES] = { -4, 1 };

/* The search at work; of each row both sides. */
struct reach {
	variants_plan *plan;
	size_t count;
	const double *asked; /* [count][VARIANTS_ASK_COUNT] */
	double *parts;       /* asked for in this round: [count][SIDES][VARIANTS_ASK_COUNT] */
	double *out;
	double *good, *bad; /* [count][SIDES] */
};

static batten_status create(batten_context *context, struct reach *r)
{
	const size_t rows = r->count * SIDES, outcome = variants_plan_outcome(r->plan);
	r->parts = batten_allocate(context, rows, VARIANTS_ASK_COUNT * sizeof *r->parts);
	r->out = batten_allocate(context, rows, outcome * sizeof *r->out);
	r->good = batten_allocate(context, rows, sizeof *r->good);
	r->bad = batten_allocate(context, rows, sizeof *r->bad);
	for (size_t i = 0; r->bad && i < rows; i++)
		r->bad[i] = limits[i % SIDES];
	return r->parts && r->out && r->good && r->bad ? BATTEN_OK : BATTEN_MEMORY;
}

static void release(batten_context *context, struct reach *r)
{
	batten_release(context, r->parts);
	batten_release(context, r->out);
	batten_release(context, r->good);
	batten_release(context, r->bad);
}

/* Asks for so much of each row; what the parallel body is to become stays. */
static batten_status run(const struct reach *r, bool parent)
{
	for (size_t i = 0; i < r->count * SIDES; i++) {
		double *asked = r->parts + i * VARIANTS_ASK_COUNT;
		const double part = parent ? 0 : 0.5 * (r->good[i] + r->bad[i]);
		memcpy(asked, r->asked + i / SIDES * VARIANTS_ASK_COUNT,
		       VARIANTS_ASK_COUNT * sizeof *asked);
		asked[VARIANTS_ASK_FULLNESS] *= part;
		asked[VARIANTS_ASK_CENTRE] *= part;
	}
	r->plan->count = r->count * SIDES;
	r->plan->asked = r->parts;
	r->plan->found_y_m = NULL;
	r->plan->out = r->out;
	return variants_batch_run(r->plan, NULL);
}

static bool reached(const struct reach *r, size_t i)
{
	return r->out[i * variants_plan_outcome(r->plan) + VARIANTS_OUT_END] == VARIANTS_END_GOOD;
}

batten_status measure_reach(variants_plan *plan, size_t count, const double *asked, double *parts)
{
	struct reach r = { .plan = plan, .count = count, .asked = asked };
	batten_status status = create(plan->context, &r);
	if (status == BATTEN_OK)
		status = run(&r, true);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		parts[SIDES * i] = reached(&r, SIDES * i) ? 0 : NAN;
	for (int k = 0; k < HALVINGS && status == BATTEN_OK; k++) {
		status = run(&r, false);
		for (size_t i = 0; i < count * SIDES && status == BATTEN_OK; i++) {
			const double middle = 0.5 * (r.good[i] + r.bad[i]);
			*(reached(&r, i) ? &r.good[i] : &r.bad[i]) = middle;
		}
	}
	for (size_t i = 0; i < count * SIDES && status == BATTEN_OK; i++)
		parts[i] = isnan(parts[i - i % SIDES]) ? NAN : r.good[i];
	release(plan->context, &r);
	return status;
}
