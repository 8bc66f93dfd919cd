/* Rows of any method varied and measured on the host, shared out to threads. */
#include "variation/measure.h"

#include "batch/workers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct batch {
	batch_work work; /* first: the callback gets it */
	const measure_task *task;
} batch;

batten_vary_options measure_row_options(const measure_task *task, size_t which)
{
	if (task->v->row_options)
		return task->v->row_options[which];
	batten_vary_options options = task->options;
	const batten_vary_row *row = &task->v->rows[which];
	options.dcp_pct = row->dcp_pct;
	options.dlcb_pct = row->dlcb_pct;
	options.dp_fore_pct = row->dp_fore_pct;
	options.dp_aft_pct = row->dp_aft_pct;
	return options;
}

batten_hydrostatics *measure_forms_of(const measure_task *task, size_t which)
{
	return task->v->out ? task->v->out + which * task->draft_count : NULL;
}

void measure_leave_empty(const measure_task *task, size_t which, batten_status status)
{
	const batten_variants *v = task->v;
	batten_vary_result *result = &v->results[which];
	result->status = status;
	result->cp = result->lcb_pct_lbp_fwd = NAN;
	for (size_t n = 0; n < task->nodes && v->y_m; n++)
		v->y_m[which * task->nodes + n] = NAN;
	if (v->nodes)
		memset(v->nodes + which * task->nodes, BATTEN_NODE_OUTSIDE, task->nodes);
	double *form = (double *)measure_forms_of(task, which);
	for (size_t i = 0; form && i < task->draft_count * BATTEN_HYDROSTATICS_COUNT; i++)
		form[i] = NAN;
}

/* What is told of a variant there is. Errors: MEMORY. */
static batten_status keep(const measure_task *task, size_t which, const batten_hull *variant)
{
	const batten_variants *v = task->v;
	if (v->y_m)
		memcpy(v->y_m + which * task->nodes, variant->y_m, task->nodes * sizeof *v->y_m);
	if (v->nodes)
		memcpy(v->nodes + which * task->nodes, variant->nodes, task->nodes);
	return v->hulls ? batten_hull_clone(task->context, variant, &v->hulls[which]) : BATTEN_OK;
}

/* One row, in a thread's own context: its errors are the rows' reasons. Errors: MEMORY. */
static batten_status work(const measure_task *task, variation_family *family, size_t which)
{
	const batten_variants *v = task->v;
	const batten_vary_options options = measure_row_options(task, which);
	batten_vary_result result = { .status = BATTEN_OK };
	batten_vary_outcome outcome;
	batten_measures measures;
	batten_hull *variant = NULL;
	batten_status status = variation_family_vary(family, &options, &variant, &outcome);
	result.passes = outcome.passes;
	if (status == BATTEN_OK)
		status = variation_measure(family->context, variant, &measures);
	if (status == BATTEN_OK && v->out)
		status = batten_hull_hydrostatics(
			family->context, variant, &task->hydrostatics, task->draft_count,
			v->drafts_m ? v->drafts_m : &variant->draft_m, measure_forms_of(task, which));
	if (status == BATTEN_OK) {
		result.cp = measures.cp;
		result.lcb_pct_lbp_fwd = measures.lcb_pct_lbp_fwd;
		status = keep(task, which, variant);
	} else {
		const char *reason = batten_context_error(family->context);
		(void)snprintf(result.reason, sizeof result.reason, "%.119s", reason);
		(void)snprintf(outcome.reason, sizeof outcome.reason, "%.383s", reason);
	}
	outcome.status = status;
	v->results[which] = result;
	if (status != BATTEN_OK)
		measure_leave_empty(task, which, status);
	if (v->outcomes)
		v->outcomes[which] = outcome;
	batten_hull_destroy(variant);
	return status == BATTEN_MEMORY ? status : BATTEN_OK;
}

static batten_status run_on_reference(batch_work *batch_of)
{
	batch *b = (batch *)batch_of;
	const measure_task *task = b->task;
	variation_family family = { .parent = task->parent };
	batten_context_options options = task->context->options;
	options.threads = 1;
	options.log = NULL;
	if (batten_context_create(&options, &family.context) != BATTEN_OK)
		return batten_fail_memory(task->context);
	batten_status status = BATTEN_OK;
	size_t which = 0;
	while (status == BATTEN_OK && work_queue_take(&b->work.queue, 1, &which) == 1)
		status = work(task, &family, which);
	variation_family_destroy(&family);
	batten_context_destroy(family.context);
	return status == BATTEN_OK ? BATTEN_OK : batten_fail_memory(task->context);
}

batten_status measure_on_host(const measure_task *task, size_t count, const size_t *which)
{
	batch b = { .work = { .context = task->context,
		                  .device = BATTEN_DEVICE_REFERENCE,
		                  .run_reference = run_on_reference },
		        .task = task };
	batten_run ran = { .strict = true };
	batten_status status = work_queue_create(task->context, which, count, &b.work.queue);
	if (status == BATTEN_OK && count > 0)
		status = batch_work_run(&b.work, &ran);
	work_queue_release(task->context, &b.work.queue);
	return status;
}
