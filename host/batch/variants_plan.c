#include "batch/variants_plan.h"

#include <stdio.h>
#include <string.h>

/* Numbers of each table, in the order of shape. */
static size_t table_size(int at, size_t stations, size_t waterlines, size_t drafts)
{
	const size_t nodes = stations * waterlines;
	switch (at) {
	case VARIANTS_AT_X:
		return stations;
	case VARIANTS_AT_Z:
		return 2 * waterlines;
	case VARIANTS_AT_ENDS:
	case VARIANTS_AT_MIDDLE:
		return at == VARIANTS_AT_ENDS ? 4 * waterlines : waterlines;
	case VARIANTS_AT_NODES:
	case VARIANTS_AT_PARENT:
		return nodes;
	case VARIANTS_AT_SHIFT:
		return 3 * stations;
	case VARIANTS_AT_FORMULA:
		return VARIANTS_FORMULA_COUNT;
	case VARIANTS_AT_DRAFTS:
		return 4 * (drafts + 1);
	case VARIANTS_AT_SECTIONS:
		return (drafts + 1) * 3 * waterlines * waterlines;
	case VARIANTS_AT_BENDS:
		return 4 * waterlines * waterlines;
	case VARIANTS_AT_RULES:
		return 35 * (drafts + 1);
	default:
		return 0;
	}
}

batten_status variants_plan_create(batten_context *context, size_t stations, size_t waterlines,
                                   size_t drafts, variants_plan *out)
{
	variants_plan plan = { .context = context };
	plan.shape[VARIANTS_STATIONS] = (int32_t)stations;
	plan.shape[VARIANTS_WATERLINES] = (int32_t)waterlines;
	plan.shape[VARIANTS_DRAFTS] = (int32_t)drafts;
	for (int at = VARIANTS_AT_X; at < VARIANTS_SHAPE_SIZE; at++) {
		plan.shape[at] = (int32_t)plan.table_count;
		plan.table_count += table_size(at, stations, waterlines, drafts);
	}
	plan.list_count = waterlines;
	plan.tables = batten_allocate(context, plan.table_count, sizeof *plan.tables);
	plan.lists = batten_allocate(context, plan.list_count, sizeof *plan.lists);
	if (!plan.tables || !plan.lists) {
		variants_plan_destroy(&plan);
		return BATTEN_MEMORY;
	}
	double *ends = variants_plan_table(&plan, VARIANTS_AT_ENDS);
	for (size_t i = 0; i < 4 * waterlines; i++)
		ends[i] = VARIANTS_NONE;
	*out = plan;
	return BATTEN_OK;
}

void variants_plan_destroy(variants_plan *plan)
{
	if (!plan->context)
		return;
	batten_release(plan->context, plan->tables);
	batten_release(plan->context, plan->lists);
	*plan = (variants_plan){ 0 };
}

double *variants_plan_table(const variants_plan *plan, int at)
{
	return plan->tables + plan->shape[at];
}

size_t variants_plan_nodes(const variants_plan *plan)
{
	return (size_t)plan->shape[VARIANTS_STATIONS] * (size_t)plan->shape[VARIANTS_WATERLINES];
}

size_t variants_plan_outcome(const variants_plan *plan)
{
	return VARIANTS_OUT_COUNT + (size_t)plan->shape[VARIANTS_DRAFTS] * VARIANTS_FORM_COUNT;
}

size_t variants_plan_room(const variants_plan *plan, size_t work_items)
{
	const size_t stations = (size_t)plan->shape[VARIANTS_STATIONS];
	const size_t waterlines = (size_t)plan->shape[VARIANTS_WATERLINES];
	const size_t drafts = (size_t)plan->shape[VARIANTS_DRAFTS];
	return VARIANTS_ROOM(stations, waterlines, drafts) +
	       work_items * VARIANTS_ITEM_ROOM(stations, waterlines);
}

void batten_batch_options_default(batten_batch_options *options)
{
	*options = (batten_batch_options){ .struct_size = sizeof *options,
		                               .device = BATTEN_DEVICE_AUTO };
}

batten_status variants_options(batten_context *context, const batten_batch_options *options,
                               batten_batch_options *out)
{
	batten_batch_options_default(out);
	if (!options)
		return BATTEN_OK;
	if (options->struct_size != sizeof *options)
		return batten_fail(context, BATTEN_USAGE,
		                   "batch options: not filled by batten_batch_options_default()");
	const unsigned lanes = options->lanes;
	if (lanes > 16 || (lanes & (lanes - 1)) != 0)
		return batten_fail(context, BATTEN_USAGE,
		                   "%u lanes: 0 (chosen), 1, 2, 4, 8 or 16 are expected", lanes);
	if (options->work_group > 1024)
		return batten_fail(context, BATTEN_USAGE,
		                   "%u work-items a group: 0 (chosen) to 1024 are expected",
		                   options->work_group);
	*out = *options;
	return BATTEN_OK;
}

void variants_tell_singly(batten_run *run, size_t singly, size_t count)
{
	const size_t used = strlen(run->warning);
	if (singly > 0 && used < sizeof run->warning)
		(void)snprintf(run->warning + used, sizeof run->warning - used,
		               "%s%zu of %zu hulls worked one by one", used ? "; " : "", singly, count);
	if (!run->device[0])
		(void)snprintf(run->device, sizeof run->device, "reference");
}

void variants_pack(const variants_plan *plan, size_t which, size_t lane, size_t lanes,
                   double *asked, double *y)
{
	const size_t nodes = variants_plan_nodes(plan);
	for (size_t i = 0; i < VARIANTS_ASK_COUNT; i++)
		asked[i * lanes + lane] = plan->asked ? plan->asked[which * VARIANTS_ASK_COUNT + i] : 0.0;
	if (!plan->y_m)
		return;
	const double *from = plan->y_m + which * nodes;
	const uint8_t *kind = plan->nodes + (plan->nodes_alike ? 0 : which * nodes);
	for (size_t n = 0; n < nodes; n++)
		y[n * lanes + lane] = kind[n] == BATTEN_NODE_OUTSIDE ? -1.0 : from[n];
}

void variants_unpack(const variants_plan *plan, size_t which, size_t lane, size_t lanes,
                     const double *y, const double *out)
{
	const size_t nodes = variants_plan_nodes(plan), numbers = variants_plan_outcome(plan);
	double *to = plan->out + which * numbers;
	for (size_t n = 0; n < numbers; n++)
		to[n] = out[n * lanes + lane];
	if (!plan->found_y_m)
		return;
	to = plan->found_y_m + which * nodes;
	for (size_t n = 0; n < nodes; n++)
		to[n] = y[n * lanes + lane];
}
