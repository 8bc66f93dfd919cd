/* Parameters of a method corrected until the measures of the variant are what is asked for. */
#include "variation/targets.h"
#include "variation/variation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST = BATTEN_VARY_TARGETS_MOST, PASSES_MOST = 60, HALVINGS = 12, RANGE_HALVINGS = 9 };

/* Converged below TIGHT, good enough below LOOSE (of a printed unit) when rounding ends it first. */
#define TIGHT 1e-10
#define LOOSE 1e-5

struct task {
	const variation_parent *parent;
	const batten_vary_options *options;
	batten_vary_outcome *outcome;
	size_t count;
	variation_target targets[MOST];
	double asked[MOST]; /* parameters */
};

/* Where the iteration stands. */
struct state {
	double p[MOST], off[MOST]; /* parameters; measured less asked, in the units of the parameters */
	double values[MOST];
	batten_hull *variant;
};

static double parameter_of(const variation_target *target, double value)
{
	return (value - target->zero) * target->scale;
}

/* A variant for parameters, and how far it is off. INPUT: these parameters give none. */
static batten_status try(const struct task *task, const double p[MOST], struct state *out)
{
	struct state made = { .variant = NULL };
	memcpy(made.p, p, sizeof made.p);
	batten_status status = variation_build(task->parent, task->options, p, &made.variant,
	                                       task->outcome);
	batten_measures measures;
	if (status == BATTEN_OK)
		status = variation_measure(task->parent->context, made.variant, &measures);
	for (size_t i = 0; i < task->count && status == BATTEN_OK; i++) {
		made.values[i] = variation_target_value(&task->targets[i], &measures);
		made.off[i] = parameter_of(&task->targets[i], made.values[i]) - task->asked[i];
		if (!isfinite(made.off[i]))
			status = batten_fail(task->parent->context, BATTEN_INPUT, "the variant has no %s",
			                     task->targets[i].name);
	}
	if (status != BATTEN_OK) {
		batten_hull_destroy(made.variant);
		return status;
	}
	batten_hull_destroy(out->variant);
	*out = made;
	return BATTEN_OK;
}

/* The largest residual, in the unit each measure is printed in and in that of its parameter. */
static double residual(const struct task *task, const struct state *state)
{
	double most = 0;
	for (size_t i = 0; i < task->count; i++)
		most = fmax(most, fabs(state->off[i]) * fmax(1, 1 / task->targets[i].scale));
	return most;
}

/* Broyden's update of the inverse of the derivatives. */
static void learn(size_t n, double inverse[MOST][MOST], const double step[MOST],
                  const double change[MOST])
{
	double image[MOST] = { 0 }, row[MOST] = { 0 }, along = 0;
	for (size_t i = 0; i < n; i++)
		for (size_t j = 0; j < n; j++) {
			image[i] += inverse[i][j] * change[j];
			row[j] += step[i] * inverse[i][j];
		}
	for (size_t i = 0; i < n; i++)
		along += step[i] * image[i];
	if (!(fabs(along) > 0))
		return;
	for (size_t i = 0; i < n; i++)
		for (size_t j = 0; j < n; j++)
			inverse[i][j] += (step[i] - image[i]) * row[j] / along;
}

/* One step, shortened while it leads to no variant. */
static batten_status advance(const struct task *task, double inverse[MOST][MOST],
                             struct state *state)
{
	double step[MOST] = { 0 }, before[MOST], change[MOST] = { 0 };
	memcpy(before, state->off, sizeof before);
	for (size_t i = 0; i < task->count; i++)
		for (size_t j = 0; j < task->count; j++)
			step[i] -= inverse[i][j] * state->off[j];
	batten_status status = BATTEN_INPUT;
	for (int k = 0; k < HALVINGS && status == BATTEN_INPUT; k++) {
		double p[MOST];
		for (size_t i = 0; i < MOST; i++)
			p[i] = state->p[i] + step[i];
		status = try(task, p, state);
		for (size_t i = 0; i < MOST && status == BATTEN_INPUT; i++)
			step[i] *= 0.5;
	}
	if (status != BATTEN_OK)
		return status;
	for (size_t i = 0; i < task->count; i++)
		change[i] = state->off[i] - before[i];
	learn(task->count, inverse, step, change);
	return BATTEN_OK;
}

/* From what is asked for, or as near to the parent as gives a variant at all. */
static batten_status start(const struct task *task, struct state *state)
{
	batten_status status = BATTEN_INPUT;
	double part = 1;
	for (int k = 0; k < HALVINGS && status == BATTEN_INPUT; k++) {
		double p[MOST] = { 0 };
		for (size_t i = 0; i < task->count; i++) {
			const variation_target *target = &task->targets[i];
			const double none = target->relative
			                        ? 0
			                        : variation_target_value(target, &task->parent->measures);
			p[i] = none + part * (task->asked[i] - none);
		}
		status = try(task, p, state);
		part = k + 2 < HALVINGS ? 0.5 * part : 0;
	}
	return status;
}

/* INPUT: not met; the state then holds the last variant. */
static batten_status solve(const struct task *task, struct state *state)
{
	double inverse[MOST][MOST] = { { 0 } };
	for (size_t i = 0; i < MOST; i++)
		inverse[i][i] = 1;
	batten_status status = start(task, state);
	double best = INFINITY;
	for (int k = 0; k < PASSES_MOST && status == BATTEN_OK; k++) {
		const double now = residual(task, state);
		if (now <= TIGHT || (now <= LOOSE && now > 0.5 * best))
			return BATTEN_OK;
		best = fmin(best, now);
		status = advance(task, inverse, state);
	}
	if (status == BATTEN_OK && residual(task, state) > LOOSE)
		status = batten_fail(task->parent->context, BATTEN_INPUT,
		                     "after %d passes still off by %.3g", PASSES_MOST,
		                     residual(task, state));
	return status;
}

/* ------------------------------------------------------------------------------------------------
 * What can be reached
 * --------------------------------------------------------------------------------------------- */

/* Asks for a part of what is asked for; the other targets of a method keep the parent's values. */
static batten_status solve_part(const struct task *task, double part, bool *good)
{
	batten_vary_outcome ignored = { 0 };
	struct task less = *task;
	less.outcome = &ignored;
	for (size_t i = 0; i < task->count; i++) {
		const double none = task->targets[i].relative
		                        ? 0
		                        : variation_target_value(&task->targets[i],
		                                                 &task->parent->measures);
		less.asked[i] = none + part * (task->asked[i] - none);
	}
	struct state state = { .variant = NULL };
	const batten_status status = solve(&less, &state);
	batten_hull_destroy(state.variant);
	*good = status == BATTEN_OK;
	return status == BATTEN_INPUT ? BATTEN_OK : status;
}

/* The part of what is asked for, towards limit, up to which there are variants. */
static batten_status find_limit(const struct task *task, double limit, double *part)
{
	double good = 0, bad = limit;
	bool reached = false;
	for (int k = 0; k < RANGE_HALVINGS; k++) {
		const double middle = 0.5 * (good + bad);
		const batten_status status = solve_part(task, middle, &reached);
		if (status != BATTEN_OK)
			return status;
		*(reached ? &good : &bad) = middle;
	}
	*part = good;
	return BATTEN_OK;
}

static batten_status explain(const struct task *task)
{
	char why[256], text[640];
	double least = 0, most = 0;
	bool any = false;
	(void)snprintf(why, sizeof why, "%s", batten_context_error(task->parent->context));
	batten_status status = solve_part(task, 0, &any);
	if (status == BATTEN_OK && !any) /* the parent is nothing for the method */
		return batten_fail(task->parent->context, BATTEN_INPUT, "%s", why);
	if (status == BATTEN_OK)
		status = find_limit(task, 1, &most);
	if (status == BATTEN_OK)
		status = find_limit(task, -4, &least);
	if (status != BATTEN_OK)
		return status;
	variation_tell_reach(text, sizeof text, task->options->method, why, task->count, task->targets,
	                     task->asked, &task->parent->measures, least, most);
	return batten_fail(task->parent->context, BATTEN_INPUT, "%s", text);
}

/* ------------------------------------------------------------------------------------------------
 * The whole
 * --------------------------------------------------------------------------------------------- */

static void report(const struct task *task, const struct state *state)
{
	batten_vary_outcome *outcome = task->outcome;
	outcome->target_count = task->count;
	for (size_t i = 0; i < task->count; i++)
		outcome->targets[i] = variation_target_tell(&task->targets[i], &task->parent->measures,
		                                            task->asked[i], state->values[i]);
}

batten_status variation_iterate(const variation_parent *parent, const batten_vary_options *options,
                                batten_hull **out, batten_vary_outcome *outcome)
{
	struct task task = { .parent = parent, .options = options, .outcome = outcome };
	task.count = variation_targets(options, &parent->measures, task.targets);
	for (size_t i = 0; i < task.count; i++)
		task.asked[i] = task.targets[i].asked;
	struct state state = { .variant = NULL };
	const bool once = options->first_pass || task.count == 0;
	batten_status status = once ? try(&task, task.asked, &state) : solve(&task, &state);
	if (status == BATTEN_INPUT && !once)
		status = explain(&task);
	if (status != BATTEN_OK) {
		batten_hull_destroy(state.variant);
		return status;
	}
	report(&task, &state);
	*out = state.variant;
	return BATTEN_OK;
}
