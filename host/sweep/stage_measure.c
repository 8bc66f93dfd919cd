/* Hulls -> numbers, and whether they will do. */
#include "fairing/measures.h"
#include "hydrostatics/offsets_batch.h"
#include "hydrostatics/offsets_tables.h"
#include "sweep/stages.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MEASURE_PIECE = 128 };

/* The block's designs, and those of them that lie on the parent's table: their hydrostatics are worked in
 * one batch, at the drafts of the plan and of the parent. Which way a design goes depends on it alone:
 * both agree within rounding, not bit for bit. */
struct measuring {
	sweep_block *block;
	size_t batch_count, batch_drafts;
	double drafts_m[PLAN_DRAFTS_MOST + 1];
	size_t own;                 /* which of the drafts is the parent's */
	size_t *place;              /* of each design in the batch, SIZE_MAX elsewhere */
	batten_hydrostatics *forms; /* [batch][drafts] */
};

/* ---- fairing ---- */

static batten_status measure_fairing(batten_context *context, measure_room *room,
                                     const sweep_block *block, size_t i)
{
	sweep_design *design = &block->designs[i];
	double *out = design->measures + BATTEN_MEASURE_COUNT;
	for (size_t k = 0; k < SWEEP_FAIRING_COUNT; k++)
		out[k] = NAN;
	if (!block->plan->fairs)
		return BATTEN_OK;
	const batten_hull varied = sweep_block_varied(block, context, i);
	const batten_hull faired = sweep_block_final(block, context, i);
	batten_closeness closeness;
	const batten_status status = measure_room_closeness(room, &faired, &varied, &closeness);
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

/* ---- judgement ---- */

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

/* ---- one design ---- */

static batten_hydrostatics *drafts_of(const sweep_block *block, size_t i)
{
	return block->hydrostatics + i * block->plan->draft_count;
}

/* The drafts of the plan, then that of a hull unless it is one of them. Returns how many. */
static size_t list_drafts(const sweep_plan *plan, double draft_m, double *drafts_m, size_t *own)
{
	memcpy(drafts_m, plan->drafts_m, plan->draft_count * sizeof *drafts_m);
	drafts_m[plan->draft_count] = draft_m;
	for (*own = 0; *own < plan->draft_count && drafts_m[*own] != draft_m; ++*own)
		;
	return *own < plan->draft_count ? plan->draft_count : plan->draft_count + 1;
}

/* Hydrostatics are there already. */
static batten_status measure_batched(measure_room *room, const struct measuring *measuring,
                                     const batten_hull *hull, size_t i, batten_measures *out)
{
	const sweep_block *block = measuring->block;
	const batten_hydrostatics *forms = measuring->forms +
	                                   measuring->place[i] * measuring->batch_drafts;
	memcpy(drafts_of(block, i), forms, block->plan->draft_count * sizeof *forms);
	return measures_complete(room, hull, &forms[measuring->own], out);
}

static batten_status measure_alone(batten_context *context, measure_room *room,
                                   const struct measuring *measuring, const batten_hull *hull,
                                   size_t i, batten_measures *out)
{
	const sweep_plan *plan = measuring->block->plan;
	double drafts[PLAN_DRAFTS_MOST + 1];
	batten_hydrostatics forms[PLAN_DRAFTS_MOST + 1];
	size_t own = 0;
	const size_t count = list_drafts(plan, hull->draft_m, drafts, &own);
	const batten_status status = batten_hull_hydrostatics(context, hull, &plan->hydrostatics, count,
	                                                      drafts, forms);
	if (status != BATTEN_OK)
		return status;
	memcpy(drafts_of(measuring->block, i), forms, plan->draft_count * sizeof *forms);
	return measures_complete(room, hull, &forms[own], out);
}

static batten_status measure(batten_context *context, measure_room *room,
                             const struct measuring *measuring, size_t i)
{
	const sweep_block *block = measuring->block;
	const sweep_plan *plan = block->plan;
	sweep_design *design = &block->designs[i];
	const batten_hull hull = sweep_block_final(block, context, i);
	batten_measures measures;
	batten_status status = measuring->place[i] == SIZE_MAX
	                           ? measure_alone(context, room, measuring, &hull, i, &measures)
	                           : measure_batched(room, measuring, &hull, i, &measures);
	if (status == BATTEN_OK) {
		memcpy(design->measures, &measures, sizeof measures);
		status = measure_fairing(context, room, block, i);
	}
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
	const struct measuring *measuring = user;
	measure_room *room = NULL;
	batten_status status = measure_room_create(context, &room);
	for (size_t i = first; i < first + count && status == BATTEN_OK; i++)
		if (sweep_design_lives(&measuring->block->designs[i]))
			status = measure(context, room, measuring, i);
	measure_room_destroy(room);
	return status;
}

/* ---- hydrostatics of many ---- */

/* Whether a batch can take hulls on the parent's table at all these drafts. */
static bool fits_batch(const sweep_plan *plan)
{
	const batten_hull *parent = plan->parent;
	return parent->draft_m > parent->z_m[0] &&
	       parent->draft_m <= parent->z_m[parent->waterline_count - 1] &&
	       offsets_tables_fit(parent, plan->hydrostatics.quadrature, plan->draft_count + 1);
}

static size_t list_batch(const sweep_block *block, size_t *place)
{
	const bool fits = fits_batch(block->plan);
	size_t count = 0;
	for (size_t i = 0; i < block->count; i++) {
		const sweep_design *design = &block->designs[i];
		place[i] = fits && !design->form && sweep_design_lives(design) ? count++ : SIZE_MAX;
	}
	return count;
}

/* Half-breadths and nodes of a batch, side by side. */
struct offsets {
	const double *y_m;
	const uint8_t *nodes;
};

/* Those of the block where all of it goes in the batch, else copies in the machine's room. */
static batten_status gather(sweep_machine *machine, const struct measuring *measuring,
                            struct offsets *out)
{
	const sweep_block *block = measuring->block;
	const size_t each = block->nodes_each;
	const double *from = block->faired_y_m ? block->faired_y_m : block->varied_y_m;
	*out = (struct offsets){ from, block->nodes };
	if (measuring->batch_count == block->count)
		return BATTEN_OK;
	double *y_m = sweep_machine_room(machine, block, 2);
	if (!y_m)
		return BATTEN_MEMORY;
	uint8_t *nodes = (uint8_t *)(y_m + block->capacity * each);
	for (size_t i = 0; i < block->count; i++) {
		const size_t place = measuring->place[i];
		if (place == SIZE_MAX)
			continue;
		memcpy(y_m + place * each, from + i * each, each * sizeof *y_m);
		memcpy(nodes + place * each, block->nodes + i * each, each);
	}
	*out = (struct offsets){ y_m, nodes };
	return BATTEN_OK;
}

static batten_status run_batch(sweep_machine *machine, const struct measuring *measuring)
{
	const sweep_plan *plan = measuring->block->plan;
	struct offsets offsets;
	batten_status status = gather(machine, measuring, &offsets);
	if (status == BATTEN_OK && !machine->afloat) {
		batten_batch_options batch;
		batten_batch_options_default(&batch);
		batch.device = sweep_machine_device_f64(machine);
		status = offsets_batch_create(machine->context, plan->parent, &plan->hydrostatics, &batch,
		                              measuring->batch_drafts, measuring->drafts_m,
		                              &machine->afloat);
	}
	if (status == BATTEN_OK)
		status = offsets_batch_run(machine->afloat, measuring->batch_count, offsets.y_m,
		                           offsets.nodes, measuring->forms, NULL);
	return status;
}

batten_status sweep_stage_measure(sweep_machine *machine, sweep_block *block)
{
	batten_context *context = machine->context;
	struct measuring measuring = { .block = block };
	measuring.batch_drafts = list_drafts(block->plan, block->plan->parent->draft_m,
	                                     measuring.drafts_m, &measuring.own);
	measuring.place = batten_allocate(context, block->count, sizeof *measuring.place);
	batten_status status = measuring.place ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		measuring.batch_count = list_batch(block, measuring.place);
		measuring.forms = batten_allocate(context, measuring.batch_count,
		                                  measuring.batch_drafts * sizeof *measuring.forms);
		status = measuring.forms ? BATTEN_OK : BATTEN_MEMORY;
	}
	if (status == BATTEN_OK && measuring.batch_count > 0)
		status = run_batch(machine, &measuring);
	if (status == BATTEN_OK)
		status = sweep_crew_run(&machine->crew, block->count, MEASURE_PIECE, measure_piece,
		                        &measuring);
	batten_release(context, measuring.place);
	batten_release(context, measuring.forms);
	return status;
}
