/* The public hydrostatics of many surfaces of one topology. */
#include "batch/afloat_batch.h"
#include "batch/variants_plan.h"
#include "geometry/surface_batch.h"
#include "hydrostatics/patch.h"
#include "hydrostatics/quantities.h"

#include <math.h>
#include <stdio.h>

/* Surfaces of one piece of a batch, whose outcomes are held at once. */
enum { PIECE = 1024 };

/* A batch and what it stands on. */
struct task {
	batten_context *context;
	batten_hydrostatics_options chosen;
	size_t draft_count;
	const double *drafts_m;
	batten_hydrostatics *out;
	batten_afloat_result *results;
};

static double known(double number)
{
	return number > AFLOAT_NONE ? number : NAN;
}

/* Sums over the half hull, with whichever sense the normal has, as integrals of the whole hull. */
static hydrostatics integrals_of(const double *form)
{
	/* u and v may run either way: an outward normal makes the volume positive */
	const double side = form[AFLOAT_VOLUME_Y] < 0 ? -2 : 2;
	const double apart = fmax(fabs(form[AFLOAT_VOLUME_X] - form[AFLOAT_VOLUME_Y]),
	                          fabs(form[AFLOAT_VOLUME_Z] - form[AFLOAT_VOLUME_Y]));
	const double half_breadth = known(form[AFLOAT_LINE_HALF_BREADTH]);
	return (hydrostatics){
		.volume_m3 = side * form[AFLOAT_VOLUME_Y],
		.volume_moment_x_m4 = side * form[AFLOAT_MOMENT_X],
		.volume_moment_z_m4 = side * form[AFLOAT_MOMENT_Z],
		.wetted_surface_m2 = 2 * form[AFLOAT_WETTED],
		.transom_area_m2 = 2 * form[AFLOAT_TRANSOM],
		.midship_area_m2 = known(form[AFLOAT_MIDSHIP]),
		.max_section_area_m2 = form[AFLOAT_LARGEST],
		.waterline_length_m = isnan(half_breadth) ? NAN
		                                          : form[AFLOAT_LINE_FORE] - form[AFLOAT_LINE_AFT],
		.waterline_half_breadth_m = half_breadth,
		.waterplane_area_m2 = side * form[AFLOAT_PLANE],
		.waterplane_moment_x_m3 = side * form[AFLOAT_PLANE_X],
		.transverse_second_moment_m4 = side * form[AFLOAT_PLANE_YY],
		.longitudinal_second_moment_m4 = side * form[AFLOAT_PLANE_XX],
		.volume_mismatch_pct = form[AFLOAT_VOLUME_Y] == 0
		                           ? NAN
		                           : 100 * apart / fabs(form[AFLOAT_VOLUME_Y]),
	};
}

static batten_status take_surface(const struct task *task, const double *outcome, size_t which)
{
	floating_body body = { .context = task->context,
		                   .half_beam_m = outcome[AFLOAT_HALF_BEAM],
		                   .lowest_m = outcome[AFLOAT_LOWEST],
		                   .highest_m = outcome[AFLOAT_HIGHEST] };
	batten_status status = quantities_length(task->context, "surface", &task->chosen,
	                                         outcome[AFLOAT_FOREMOST], &body.lbp_m);
	for (size_t d = 0; d < task->draft_count && status == BATTEN_OK; d++)
		status = quantities_check_draft(task->context, body.lowest_m, body.highest_m,
		                                task->drafts_m[d]);
	for (size_t d = 0; d < task->draft_count && status == BATTEN_OK; d++) {
		const hydrostatics integrals = integrals_of(outcome + AFLOAT_OUT_COUNT +
		                                            d * AFLOAT_FORM_COUNT);
		quantities_take(&body, &integrals, task->drafts_m[d], &task->chosen,
		                &task->out[which * task->draft_count + d]);
	}
	return status;
}

static void fill_with_nothing(const struct task *task, size_t which)
{
	double *numbers = (double *)(task->out + which * task->draft_count);
	for (size_t n = 0; n < task->draft_count * BATTEN_HYDROSTATICS_COUNT; n++)
		numbers[n] = NAN;
}

/* A surface that fails keeps its reason to itself where the caller wants to know each. */
static batten_status judge(const struct task *task, batten_status status, size_t which)
{
	if (!task->results)
		return status;
	batten_afloat_result *result = &task->results[which];
	*result = (batten_afloat_result){ .status = status };
	if (status == BATTEN_OK)
		return BATTEN_OK;
	fill_with_nothing(task, which);
	(void)snprintf(result->reason, sizeof result->reason, "%s",
	               batten_context_error(task->context));
	return BATTEN_OK;
}

static batten_status run_piece(const struct task *task, afloat_plan *plan, size_t first,
                               size_t count, const batten_surface *const *surfaces,
                               afloat_item *items, batten_run *run)
{
	batten_run told = { .strict = true };
	for (size_t i = 0; i < count; i++)
		items[i] = (afloat_item){ surfaces[first + i]->poles, surfaces[first + i]->weights };
	plan->count = count;
	plan->items = items;
	batten_status status = afloat_batch_run(plan, &told);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++) {
		status = take_surface(task, plan->out + i * afloat_plan_outcome(plan), first + i);
		status = judge(task, status, first + i);
	}
	told.seconds += run->seconds;
	*run = told;
	return status;
}

static batten_status run_pieces(const struct task *task, afloat_plan *plan, size_t count,
                                const batten_surface *const *surfaces, batten_run *run)
{
	const size_t piece = count < PIECE ? count : PIECE;
	afloat_item *items = batten_allocate(task->context, piece, sizeof *items);
	plan->out = batten_allocate(task->context, piece, afloat_plan_outcome(plan) * sizeof(double));
	batten_status status = items && plan->out ? BATTEN_OK : BATTEN_MEMORY;
	for (size_t first = 0; first < count && status == BATTEN_OK; first += piece)
		status = run_piece(task, plan, first, count - first < piece ? count - first : piece,
		                   surfaces, items, run);
	batten_release(task->context, plan->out);
	batten_release(task->context, items);
	return status;
}

static batten_status make_plan(const struct task *task, const surface_topology *all,
                               const batten_batch_options *batch, afloat_plan *plan)
{
	const afloat_topology topology = {
		.order = { all->order_u, all->order_v },
		.count = { all->count_u, all->count_v },
		.knots = { all->knots_u, all->knots_v },
		.rational = all->rational,
		.points = patch_points(all->order_u, all->order_v, task->chosen.gauss_points),
	};
	batten_status status = afloat_plan_create(task->context, &topology, task->draft_count,
	                                          task->drafts_m, task->chosen.lbp_m, plan);
	plan->device = batch->device;
	plan->lanes = batch->lanes;
	plan->work_group = batch->work_group;
	return status;
}

static batten_status check_drafts(const struct task *task)
{
	if (task->draft_count > VARIANTS_DRAFTS_MOST)
		return batten_fail(task->context, BATTEN_USAGE, "%zu drafts: at most %d are expected",
		                   task->draft_count, VARIANTS_DRAFTS_MOST);
	for (size_t d = 0; d < task->draft_count; d++)
		if (!isfinite(task->drafts_m[d]))
			return batten_fail(task->context, BATTEN_USAGE, "draft %zu: not a finite number", d);
	return BATTEN_OK;
}

batten_status batten_surface_hydrostatics_batch(batten_context *context, size_t count,
                                                const batten_surface *const *surfaces,
                                                const batten_hydrostatics_options *options,
                                                const batten_batch_options *batch,
                                                size_t draft_count, const double *drafts_m,
                                                batten_hydrostatics *out,
                                                batten_afloat_result *results, batten_run *run)
{
	struct task task = { .context = context,
		                 .draft_count = draft_count,
		                 .drafts_m = drafts_m,
		                 .out = out,
		                 .results = results };
	batten_run told = { .strict = true };
	batten_batch_options how;
	surface_topology topology;
	batten_status status = quantities_options(context, options, &task.chosen);
	if (status == BATTEN_OK)
		status = variants_options(context, batch, &how);
	if (status == BATTEN_OK)
		status = check_drafts(&task);
	if (status == BATTEN_OK && count > 0)
		status = surface_topology_of(context, count, surfaces, &topology);
	if (status != BATTEN_OK)
		return status;
	if (count > 0 && draft_count > 0) {
		afloat_plan plan = { .context = context };
		status = make_plan(&task, &topology, &how, &plan);
		if (status == BATTEN_OK)
			status = run_pieces(&task, &plan, count, surfaces, &told);
		afloat_plan_destroy(&plan);
	}
	if (status == BATTEN_OK && run)
		*run = told;
	return status;
}
