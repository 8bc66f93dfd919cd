/* Form-parameter design: targets met by parameters of methods applied one after another (Letcher 10.4). */
#include "variation/roots.h"
#include "variation/variation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Of a target, or of 1 where that is more. */
#define TOLERANCE 1e-10

enum { MOST = BATTEN_VARY_TARGETS_MOST };

/* Where a parameter lies in the options of its method. */
struct known {
	const char *name;
	batten_vary_method method;
	size_t offset;
	double none, least, most;
};

static const struct known known[] = {
#define KNOWN(method, field, name, none, least, most)                                              \
	{ name, BATTEN_VARY_##method, offsetof(batten_vary_options, field), none, least, most },
	BATTEN_SOLVE_PARAMETER_LIST(KNOWN)
#undef KNOWN
};
enum { KNOWN_COUNT = sizeof known / sizeof known[0] };

const char *batten_solve_parameter_name(size_t parameter, double *least, double *most, double *none)
{
	if (parameter >= KNOWN_COUNT)
		return NULL;
	*least = known[parameter].least;
	*most = known[parameter].most;
	*none = known[parameter].none;
	return known[parameter].name;
}

/* The preset a parameter of the nonlinear method is the amount of. */
static batten_vary_preset preset_of(const struct known *parameter)
{
	size_t i = 0;
	while (parameter->method == BATTEN_VARY_NONLINEAR && i < BATTEN_VARY_PRESET_COUNT &&
	       strcmp(strchr(parameter->name, '.') + 1, batten_vary_preset_name(i)) != 0)
		i++;
	return parameter->method == BATTEN_VARY_NONLINEAR ? (batten_vary_preset)i
	                                                  : BATTEN_VARY_PRESET_COUNT;
}

struct problem {
	batten_context *context;
	const batten_hull *parent;
	size_t count;
	const batten_solve_target *targets;
	size_t measures[MOST]; /* number of each target's measure */
	const struct known *parameters[MOST];
	size_t stage_count;
	size_t stage[MOST]; /* of each parameter: which method in order */
	struct roots_task task;
	batten_vary_outcome *outcome;
};

/* ------------------------------------------------------------------------------------------------
 * What is asked
 * --------------------------------------------------------------------------------------------- */

/* Number of a measure of form; BATTEN_MEASURE_COUNT for no such name. */
static size_t measure_number(const char *name)
{
	const size_t form_count = offsetof(batten_measures, fn_per_m2) / sizeof(double);
	for (size_t i = 0; name && i < form_count; i++)
		if (strcmp(batten_measure_name(i), name) == 0)
			return i;
	return BATTEN_MEASURE_COUNT;
}

static batten_status read_target(struct problem *problem, batten_solve_target target, size_t i)
{
	const char *name = target.measure ? target.measure : "";
	problem->measures[i] = measure_number(name);
	if (problem->measures[i] == BATTEN_MEASURE_COUNT)
		return batten_fail(problem->context, BATTEN_USAGE,
		                   "target '%s': a measure of form was expected, as volume_m3 or cb", name);
	if (!(fabs(target.value) <= 1e15))
		return batten_fail(problem->context, BATTEN_USAGE, "target %s is %g, expected a number",
		                   name, target.value);
	for (size_t k = 0; k < i; k++)
		if (problem->measures[k] == problem->measures[i])
			return batten_fail(problem->context, BATTEN_USAGE,
			                   "target %s is given twice, once was expected", name);
	return BATTEN_OK;
}

static batten_status read_parameter(struct problem *problem,
                                    const batten_solve_parameter *parameter, size_t i)
{
	size_t number = 0;
	while (number < KNOWN_COUNT && parameter->name &&
	       strcmp(known[number].name, parameter->name) != 0)
		number++;
	if (!parameter->name || number == KNOWN_COUNT)
		return batten_fail(problem->context, BATTEN_USAGE,
		                   "parameter '%s': one of a method was expected, as lackenby.dcp or "
		                   "affine.y",
		                   parameter->name ? parameter->name : "");
	const struct known *found = &known[number];
	const double least = isnan(parameter->least) ? found->least : parameter->least;
	const double most = isnan(parameter->most) ? found->most : parameter->most;
	if (!(fabs(least) <= 1e6 && fabs(most) <= 1e6 && most - least >= 1e-9))
		return batten_fail(problem->context, BATTEN_USAGE,
		                   "parameter %s from %g to %g: an ascending range was expected",
		                   found->name, least, most);
	problem->parameters[i] = found;
	problem->task.least[i] = least;
	problem->task.most[i] = most;
	problem->task.start[i] = fmin(fmax(found->none, least), most);
	return BATTEN_OK;
}

/* Parameters of one method (and preset) are one stage, where the first of them stands. */
static batten_status find_stage(struct problem *problem, const char *name, size_t i)
{
	const struct known *last = problem->parameters[i];
	problem->stage[i] = problem->stage_count;
	for (size_t k = 0; k < i; k++) {
		const struct known *other = problem->parameters[k];
		if (other == last)
			return batten_fail(problem->context, BATTEN_USAGE,
			                   "parameter %s is given twice, once was expected", name);
		if (other->method == last->method && preset_of(other) == preset_of(last))
			problem->stage[i] = problem->stage[k];
	}
	problem->stage_count += problem->stage[i] == problem->stage_count;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Variants
 * --------------------------------------------------------------------------------------------- */

static batten_status apply_stage(const struct problem *problem, size_t stage, const double *at,
                                 const batten_hull *from, batten_hull **out)
{
	batten_vary_options options;
	batten_vary_options_default(&options);
	options.first_pass = true;
	for (size_t i = 0; i < problem->count; i++) {
		if (problem->stage[i] != stage)
			continue;
		options.method = problem->parameters[i]->method;
		options.preset = preset_of(problem->parameters[i]);
		memcpy((char *)&options + problem->parameters[i]->offset, &at[i], sizeof at[i]);
	}
	batten_vary_outcome outcome;
	const batten_status status = batten_hull_vary(problem->context, from, &options, out, &outcome);
	if (outcome.warning[0] && !problem->outcome->warning[0])
		(void)snprintf(problem->outcome->warning, sizeof outcome.warning, "%s", outcome.warning);
	return status;
}

static batten_status make_variant(const struct problem *problem, const double *at,
                                  batten_hull **out)
{
	batten_hull *made = NULL;
	batten_status status = BATTEN_OK;
	problem->outcome->passes++;
	problem->outcome->warning[0] = '\0';
	for (size_t stage = 0; stage < problem->stage_count && status == BATTEN_OK; stage++) {
		batten_hull *next = NULL;
		status = apply_stage(problem, stage, at, made ? made : problem->parent, &next);
		batten_hull_destroy(made);
		made = next;
	}
	*out = made;
	return status;
}

static double measure_of(const struct problem *problem, size_t target,
                         const batten_measures *measures)
{
	/* The struct is an array of doubles in the order of the names (batten.h). */
	return ((const double *)measures)[problem->measures[target]];
}

static batten_status evaluate(void *user, const double *at, double *out)
{
	const struct problem *problem = user;
	batten_hull *variant = NULL;
	batten_measures measures;
	batten_status status = make_variant(problem, at, &variant);
	if (status == BATTEN_OK)
		status = variation_measure(problem->context, variant, &measures);
	for (size_t i = 0; i < problem->count && status == BATTEN_OK; i++) {
		const double asked = problem->targets[i].value;
		out[i] = (measure_of(problem, i, &measures) - asked) / fmax(1, fabs(asked));
	}
	batten_hull_destroy(variant);
	return status == BATTEN_USAGE ? BATTEN_INPUT : status; /* beyond what the method takes */
}

/* ------------------------------------------------------------------------------------------------
 * The answer
 * --------------------------------------------------------------------------------------------- */

static size_t add_text(char *text, size_t size, size_t used, const char *part)
{
	const int length = snprintf(text + used, size - used, "%s", part);
	return length < 0 || (size_t)length >= size - used ? size - 1 : used + (size_t)length;
}

static void name_place(const struct problem *problem, const double *at, char *text, size_t size)
{
	size_t used = 0;
	text[0] = '\0';
	for (size_t i = 0; i < problem->count; i++) {
		char part[80];
		(void)snprintf(part, sizeof part, "%s%s %.5g", i > 0 ? ", " : "",
		               problem->parameters[i]->name, at[i]);
		used = add_text(text, size, used, part);
	}
}

static batten_status refuse(const struct problem *problem, const struct roots *roots)
{
	char place[160], values[160] = "";
	if (!isfinite(roots->off))
		return batten_fail(problem->context, BATTEN_INPUT, "no variant anywhere in the ranges (%s)",
		                   batten_context_error(problem->context));
	batten_hull *variant = NULL;
	batten_measures measures;
	batten_status status = make_variant(problem, roots->nearest, &variant);
	if (status == BATTEN_OK)
		status = variation_measure(problem->context, variant, &measures);
	batten_hull_destroy(variant);
	if (status != BATTEN_OK)
		return status;
	size_t used = 0;
	for (size_t i = 0; i < problem->count; i++) {
		char part[80];
		(void)snprintf(part, sizeof part, "%s%s %.5g", i > 0 ? ", " : "",
		               problem->targets[i].measure, measure_of(problem, i, &measures));
		used = add_text(values, sizeof values, used, part);
	}
	name_place(problem, roots->nearest, place, sizeof place);
	return batten_fail(problem->context, BATTEN_INPUT,
	                   "no solution found within the ranges; nearest comes %s, with %s", place,
	                   values);
}

static void report(const struct problem *problem, const struct roots *roots,
                   const batten_measures *before, const batten_measures *after)
{
	batten_vary_outcome *outcome = problem->outcome;
	outcome->target_count = outcome->parameter_count = problem->count;
	for (size_t i = 0; i < problem->count; i++) {
		outcome->targets[i] = (struct batten_vary_target){
			.name = batten_measure_name(problem->measures[i]),
			.parent = measure_of(problem, i, before),
			.asked = problem->targets[i].value,
			.got = measure_of(problem, i, after),
		};
		outcome->parameters[i] = (struct batten_vary_parameter){ problem->parameters[i]->name,
			                                                     roots->at[0][i] };
	}
	if (roots->count < 2)
		return;
	char other[200];
	name_place(problem, roots->at[1], other, sizeof other);
	(void)snprintf(outcome->warning, sizeof outcome->warning,
	               "%zu solutions; the one nearest to the parent is taken, the next is %s",
	               roots->count, other);
}

static batten_status solve(struct problem *problem, batten_hull **out)
{
	struct roots roots;
	batten_measures before, after;
	batten_status status = variation_measure(problem->context, problem->parent, &before);
	if (status == BATTEN_OK)
		status = roots_find(&problem->task, &roots);
	if (status == BATTEN_OK && roots.count == 0)
		status = refuse(problem, &roots);
	if (status != BATTEN_OK)
		return status;
	status = make_variant(problem, roots.at[0], out);
	if (status == BATTEN_OK)
		status = variation_measure(problem->context, *out, &after);
	if (status == BATTEN_OK)
		report(problem, &roots, &before, &after);
	return status;
}

batten_status batten_hull_solve(batten_context *context, const batten_hull *parent, size_t count,
                                const batten_solve_target *targets,
                                const batten_solve_parameter *parameters, batten_hull **out,
                                batten_vary_outcome *outcome)
{
	batten_vary_outcome ignored;
	struct problem problem = {
		.context = context,
		.parent = parent,
		.count = count,
		.targets = targets,
		.task = { .count = count, .tolerance = TOLERANCE, .function = evaluate },
		.outcome = outcome ? outcome : &ignored
	};
	*out = NULL;
	*problem.outcome = (batten_vary_outcome){ .status = BATTEN_OK };
	problem.task.user = &problem;
	batten_status status = BATTEN_OK;
	if (count < 1 || count > MOST || !targets || !parameters)
		status = batten_fail(context, BATTEN_USAGE,
		                     "solve for %zu targets, expected 1 to %d and as many parameters",
		                     count, MOST);
	for (size_t i = 0; status == BATTEN_OK && targets && parameters && i < count; i++) {
		status = read_target(&problem, targets[i], i);
		if (status == BATTEN_OK)
			status = read_parameter(&problem, &parameters[i], i);
		if (status == BATTEN_OK)
			status = find_stage(&problem, parameters[i].name, i);
	}
	if (status == BATTEN_OK)
		status = solve(&problem, out);
	problem.outcome->status = status;
	if (status != BATTEN_OK) {
		batten_hull_destroy(*out);
		*out = NULL;
		(void)snprintf(problem.outcome->reason, sizeof problem.outcome->reason, "%s",
		               batten_context_error(context));
	}
	return status;
}
