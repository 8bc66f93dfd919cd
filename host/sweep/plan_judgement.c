/* "measure", "reject", "objectives" and "keep" of a plan: what is looked at, what will not do, what is
 * better, what stays. */
#include "sweep/plan_parts.h"

#include "hull/hull.h"

#include <math.h>
#include <string.h>

/* Whether variants may be higher than their parent. */
static bool is_scaled(const sweep_plan *plan)
{
	for (size_t s = 0; s < plan->step_count; s++)
		if (plan->steps[s].fixed.options.method == BATTEN_VARY_AFFINE)
			return true;
	return false;
}

/* Above the keel of the table and, unless variants are scaled, not above its highest waterline. */
static batten_status read_draft(const sweep_plan *plan, const plan_place *place, double *out)
{
	const batten_hull *parent = plan->parent;
	const double highest = parent->z_m[parent->waterline_count - 1];
	batten_status status = plan_number(place, 0.0, is_scaled(plan) ? HULL_LARGEST_M : highest, out);
	if (status == BATTEN_OK && !(*out > (is_scaled(plan) ? 0.0 : parent->z_m[0])))
		status = plan_expect(place, "a draft above %g m, where the hull begins", parent->z_m[0]);
	return status;
}

static batten_status read_measure(sweep_plan *plan, const plan_place *root)
{
	static const char *const keys[] = { "drafts_m", "quadrature", "density_t_per_m3", NULL };
	static const char *const rules[] = { "spline", "simpson", "trapezoid", NULL };
	batten_hydrostatics_options_default(&plan->hydrostatics);
	const plan_place place = plan_member(root, "measure");
	if (!place.json)
		return BATTEN_OK;
	const plan_place drafts = plan_member(&place, "drafts_m");
	const plan_place rule = plan_member(&place, "quadrature");
	const plan_place density = plan_member(&place, "density_t_per_m3");
	size_t word = BATTEN_QUADRATURE_SPLINE;
	batten_status status = plan_keys(&place, keys);
	if (status == BATTEN_OK && rule.json)
		status = plan_word(&rule, rules, &word);
	plan->hydrostatics.quadrature = (batten_quadrature)word;
	if (status == BATTEN_OK && density.json)
		status = plan_number(&density, 1e-3, 1e3, &plan->hydrostatics.density_t_per_m3);
	if (status == BATTEN_OK && drafts.json)
		status = plan_array(&drafts, 0, PLAN_DRAFTS_MOST, &plan->draft_count);
	for (size_t i = 0; i < plan->draft_count && status == BATTEN_OK; i++) {
		const plan_place draft = plan_item(&drafts, i);
		status = read_draft(plan, &draft, &plan->drafts_m[i]);
		if (status == BATTEN_OK && i > 0 && !(plan->drafts_m[i] > plan->drafts_m[i - 1]))
			return plan_expect(&draft, "more than the %g before it", plan->drafts_m[i - 1]);
	}
	return status;
}

/* Measures first, then parameters. */
static size_t look_up(const char *name, size_t length, const void *user)
{
	const size_t measure = sweep_measure_number(name, length);
	if (measure != SIZE_MAX)
		return measure;
	const size_t parameter = plan_parameter_number(user, name, length);
	return parameter == SIZE_MAX ? SIZE_MAX : SWEEP_MEASURE_COUNT + parameter;
}

static batten_status read_expression(const sweep_plan *plan, const plan_place *place,
                                     sweep_expression *out)
{
	const char *text = NULL;
	batten_status status = plan_text(place, &text);
	if (status == BATTEN_OK && strlen(text) > EXPRESSION_TEXT_MOST)
		return plan_expect(place, "at most %d bytes", EXPRESSION_TEXT_MOST);
	expression_fault fault = { 0 };
	if (status == BATTEN_OK && !expression_parse(text, look_up, plan, out, &fault))
		return batten_fail(plan->context, BATTEN_INPUT,
		                   "%s: %s: found '%.40s' at place %zu of it, expected %s", place->file,
		                   place->path, text + fault.at, fault.at + 1, fault.expected);
	return status;
}

/* {"name", "expression"}: g <= 0, or {"measure", "at_least", "at_most"}: a band. */
static batten_status read_constraint(const sweep_plan *plan, const plan_place *place,
                                     plan_constraint *out)
{
	static const char *const band_keys[] = { "measure", "at_least", "at_most", NULL };
	static const char *const keys[] = { "name", "expression", NULL };
	const plan_place measure = plan_member(place, "measure");
	const plan_place name = plan_member(place, "name");
	const plan_place formula = plan_member(place, "expression");
	const plan_place least = plan_member(place, "at_least");
	const plan_place most = plan_member(place, "at_most");
	const char *text = NULL;
	*out = (plan_constraint){ .least = -INFINITY, .most = measure.json ? INFINITY : 0.0 };
	batten_status status = plan_keys(place, measure.json ? band_keys : keys);
	if (status == BATTEN_OK)
		status = plan_text(measure.json ? &measure : &name, &text);
	if (status == BATTEN_OK && !measure.json && !plan_is_name(text))
		return plan_expect(&name, "a name of letters, digits and _");
	if (status == BATTEN_OK)
		status = read_expression(plan, measure.json ? &measure : &formula, &out->expression);
	if (status != BATTEN_OK)
		return status;
	(void)snprintf(out->name, sizeof out->name, "%s", text);
	if (least.json)
		status = plan_number(&least, -INFINITY, INFINITY, &out->least);
	if (status == BATTEN_OK && most.json)
		status = plan_number(&most, -INFINITY, INFINITY, &out->most);
	if (status == BATTEN_OK && measure.json && !least.json && !most.json)
		return plan_expect(&least, "a number, here or at at_most");
	if (status == BATTEN_OK && out->least > out->most)
		return plan_expect(&most, "at least %g, where the band begins", out->least);
	return status;
}

static batten_status read_constraints(sweep_plan *plan, const plan_place *root)
{
	const plan_place place = plan_member(root, "reject");
	if (!place.json)
		return BATTEN_OK;
	batten_status status = plan_array(&place, 0, PLAN_CONSTRAINTS_MOST, &plan->constraint_count);
	if (status != BATTEN_OK)
		return status;
	plan->constraints = batten_allocate(plan->context, plan->constraint_count,
	                                    sizeof *plan->constraints);
	if (!plan->constraints)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < plan->constraint_count && status == BATTEN_OK; i++) {
		const plan_place item = plan_item(&place, i);
		status = read_constraint(plan, &item, &plan->constraints[i]);
	}
	return status;
}

static batten_status read_objective(const plan_place *measure, const plan_place *goal,
                                    plan_objective *out)
{
	static const char *const goals[] = { "min", "max", NULL };
	const char *name = NULL;
	size_t word = 0;
	batten_status status = plan_text(measure, &name);
	if (status != BATTEN_OK)
		return status;
	out->measure = sweep_measure_number(name, strlen(name));
	if (out->measure == SIZE_MAX)
		return plan_expect(measure, "the name of a measure");
	status = plan_word(goal, goals, &word);
	out->greatest = word == 1;
	return status;
}

static batten_status read_objectives(sweep_plan *plan, const plan_place *root)
{
	static const char *const keys[] = { "measure", "goal", NULL };
	const plan_place place = plan_member(root, "objectives");
	if (!place.json)
		return BATTEN_OK;
	batten_status status = plan_array(&place, 0, PLAN_OBJECTIVES_MOST, &plan->objective_count);
	for (size_t i = 0; i < plan->objective_count && status == BATTEN_OK; i++) {
		const plan_place item = plan_item(&place, i);
		const plan_place measure = plan_member(&item, "measure");
		const plan_place goal = plan_member(&item, "goal");
		status = plan_keys(&item, keys);
		if (status == BATTEN_OK)
			status = read_objective(&measure, &goal, &plan->objectives[i]);
	}
	return status;
}

/* "offsets": "all", "none", or {"best": K, "measure": ..., "goal": ...}. */
static batten_status read_keep(sweep_plan *plan, const plan_place *root)
{
	static const char *const keys[] = { "offsets", NULL };
	static const char *const best_keys[] = { "best", "measure", "goal", NULL };
	static const char *const words[] = { "none", "all", NULL };
	const plan_place place = plan_member(root, "keep");
	if (!place.json)
		return BATTEN_OK;
	const plan_place offsets = plan_member(&place, "offsets");
	const plan_place count = plan_member(&offsets, "best");
	const plan_place measure = plan_member(&offsets, "measure");
	const plan_place goal = plan_member(&offsets, "goal");
	size_t word = 0;
	batten_status status = plan_keys(&place, keys);
	if (status != BATTEN_OK)
		return status;
	if (json_is_object(offsets.json)) {
		plan->keep = PLAN_KEEP_BEST;
		status = plan_keys(&offsets, best_keys);
		if (status == BATTEN_OK)
			status = plan_whole(&count, 1, 1000000, &plan->keep_count);
		return status == BATTEN_OK ? read_objective(&measure, &goal, &plan->keep_by) : status;
	}
	if (!json_is_string(offsets.json))
		return plan_expect(&offsets, "none, all or an object with best");
	status = plan_word(&offsets, words, &word);
	plan->keep = word == 1 ? PLAN_KEEP_ALL : PLAN_KEEP_NONE;
	return status;
}

batten_status plan_read_judgement(sweep_plan *plan, const plan_place *root)
{
	batten_status status = read_measure(plan, root);
	if (status == BATTEN_OK)
		status = read_constraints(plan, root);
	if (status == BATTEN_OK)
		status = read_objectives(plan, root);
	return status == BATTEN_OK ? read_keep(plan, root) : status;
}
