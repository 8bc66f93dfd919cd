/* Hulls -> numbers, and whether they will do. */
#include "sweep/stages.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MEASURE_PIECE = 8 };

static batten_status measure_hull(batten_context *context, const sweep_plan *plan,
                                  sweep_design *design)
{
	batten_measure_options options;
	batten_measure_options_default(&options);
	options.quadrature = plan->hydrostatics.quadrature;
	options.density_t_per_m3 = plan->hydrostatics.density_t_per_m3;
	batten_measures measures;
	const batten_status status = batten_hull_measure(context, sweep_design_hull(design), &options,
	                                                 &measures);
	if (status == BATTEN_OK)
		memcpy(design->measures, &measures, sizeof measures);
	return status;
}

static batten_status measure_fairing(batten_context *context, sweep_design *design)
{
	double *out = design->measures + BATTEN_MEASURE_COUNT;
	for (size_t i = 0; i < SWEEP_FAIRING_COUNT; i++)
		out[i] = NAN;
	if (!design->faired)
		return BATTEN_OK;
	batten_closeness closeness;
	const batten_status status = batten_hull_closeness(context, design->faired, design->varied,
	                                                   &closeness);
	if (status != BATTEN_OK)
		return status;
	out[SWEEP_cn_pct] = closeness.cn_pct;
	out[SWEEP_cn_max_m] = closeness.cn_max_m;
	out[SWEEP_cn_rms_m] = closeness.cn_rms_m;
	out[SWEEP_closeness_m4] = closeness.closeness_m4;
	out[SWEEP_search_iterations] = design->search.iterations;
	out[SWEEP_objective_start] = design->search.objective_start;
	out[SWEEP_objective_end] = design->search.objective_end;
	out[SWEEP_w2_over_w1] = design->fairing.w2_over_w1;
	return BATTEN_OK;
}

/* The first constraint that a design does not keep rejects it. */
static void judge(const sweep_plan *plan, const double *parameters, sweep_design *design)
{
	double numbers[SWEEP_MEASURE_COUNT + SAMPLING_PARAMETERS_MOST];
	memcpy(numbers, design->measures, sizeof design->measures);
	memcpy(numbers + SWEEP_MEASURE_COUNT, parameters,
	       plan->sampling.parameter_count * sizeof *parameters);
	for (size_t c = 0; c < plan->constraint_count; c++) {
		const plan_constraint *constraint = &plan->constraints[c];
		const double value = expression_value(&constraint->expression, numbers);
		if (value >= constraint->least && value <= constraint->most)
			continue;
		char reason[sizeof design->reason];
		if (isnan(value))
			(void)snprintf(reason, sizeof reason, "%s has no value", constraint->name);
		else if (value < constraint->least)
			(void)snprintf(reason, sizeof reason, "%s is %.6g, at least %.6g was asked for",
			               constraint->name, value, constraint->least);
		else
			(void)snprintf(reason, sizeof reason, "%s is %.6g, at most %.6g was asked for",
			               constraint->name, value, constraint->most);
		sweep_design_fail(design, SWEEP_REJECTED, reason);
		return;
	}
}

static batten_status measure(batten_context *context, sweep_block *block, size_t i)
{
	const sweep_plan *plan = block->plan;
	sweep_design *design = &block->designs[i];
	batten_status status = measure_hull(context, plan, design);
	if (status == BATTEN_OK)
		status = measure_fairing(context, design);
	if (status == BATTEN_OK && plan->draft_count > 0)
		status = batten_hull_hydrostatics(context, sweep_design_hull(design), &plan->hydrostatics,
		                                  plan->draft_count, plan->drafts_m,
		                                  block->hydrostatics + i * plan->draft_count);
	if (status == BATTEN_MEMORY || status == BATTEN_INTERNAL)
		return status;
	if (status != BATTEN_OK) {
		sweep_design_fail(design, SWEEP_MEASURE_FAILED, batten_context_error(context));
		return BATTEN_OK;
	}
	design->measured = true;
	judge(plan, block->parameters + i * plan->sampling.parameter_count, design);
	return BATTEN_OK;
}

static batten_status measure_piece(batten_context *context, void *user, size_t first, size_t count)
{
	sweep_block *block = user;
	batten_status status = BATTEN_OK;
	for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
		if (sweep_design_lives(&block->designs[i]))
			status = measure(context, block, i);
	return status;
}

batten_status sweep_stage_measure(sweep_machine *machine, sweep_block *block)
{
	return sweep_crew_run(&machine->crew, block->count, MEASURE_PIECE, measure_piece, block);
}
