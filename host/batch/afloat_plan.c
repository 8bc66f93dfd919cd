#include "batch/afloat_plan.h"

#include "core/gauss.h"

#include <string.h>

/* Spans of a direction that are not empty. */
static size_t count_spans(const afloat_topology *t, size_t d)
{
	size_t spans = 0;
	for (size_t i = t->order[d] - 1; i < t->count[d]; i++)
		spans += t->knots[d][i + 1] > t->knots[d][i];
	return spans;
}

/* Where the tables of each direction begin, and how large all is together. */
static void lay_out(afloat_plan *plan, const afloat_topology *t, size_t drafts)
{
	int32_t *shape = plan->shape;
	size_t at = 0, in_list = 0;
	for (size_t d = 0; d < 2; d++) {
		const size_t spans = count_spans(t, d), order = t->order[d];
		shape[AFLOAT_ORDER + d] = (int32_t)order;
		shape[AFLOAT_COUNT + d] = (int32_t)t->count[d];
		shape[AFLOAT_SPANS + d] = (int32_t)spans;
		shape[AFLOAT_AT_FIRST + d] = (int32_t)in_list;
		in_list += spans;
		shape[AFLOAT_AT_LINES + d] = (int32_t)at;
		at += spans + 1;
		shape[AFLOAT_AT_BASES + d] = (int32_t)at;
		at += spans * order * order;
		shape[AFLOAT_AT_EDGES + d] = (int32_t)at;
		at += spans * 2 * order;
	}
	shape[AFLOAT_POINTS] = (int32_t)t->points;
	shape[AFLOAT_DRAFTS] = (int32_t)drafts;
	shape[AFLOAT_DIMENSION] = t->rational ? 4 : 3;
	shape[AFLOAT_AT_RULE] = (int32_t)at;
	at += 2 * t->points;
	shape[AFLOAT_AT_DRAFTS] = (int32_t)at;
	at += drafts;
	shape[AFLOAT_AT_LENGTH] = (int32_t)at;
	plan->table_count = at + 1;
	plan->list_count = in_list;
}

/* The basis of the span between knots i and i + 1 as polynomials in s, basis [power][order]: Cox and de
 * Boor's recurrence with polynomials for numbers. */
static void take_basis(size_t order, const double *knots, size_t i, double *basis)
{
	double of[AFLOAT_ORDER_MOST][AFLOAT_ORDER_MOST] = { { 1 } }; /* [function][power] */
	const double wide = knots[i + 1] - knots[i], middle = 0.5 * (knots[i] + knots[i + 1]);
	for (size_t degree = 1; degree < order; degree++) {
		double next[AFLOAT_ORDER_MOST][AFLOAT_ORDER_MOST] = { { 0 } };
		/* function k of a degree begins at knot i - degree + k */
		for (size_t k = 0; k < degree; k++) {
			const double low = knots[i + 1 + k - degree], high = knots[i + 1 + k];
			const double rise = wide / (high - low), level = (middle - low) / (high - low);
			for (size_t power = 0; power < degree; power++) {
				next[k + 1][power] += level * of[k][power];
				next[k + 1][power + 1] += rise * of[k][power];
				next[k][power] += (1 - level) * of[k][power];
				next[k][power + 1] -= rise * of[k][power];
			}
		}
		memcpy(of, next, sizeof of);
	}
	for (size_t power = 0; power < order; power++)
		for (size_t k = 0; k < order; k++)
			basis[power * order + k] = of[k][power];
}

static double value_at(size_t order, const double *basis, size_t k, double at)
{
	double value = basis[(order - 1) * order + k];
	for (size_t power = order - 1; power-- > 0;)
		value = value * at + basis[power * order + k];
	return value;
}

static void fill_direction(afloat_plan *plan, const afloat_topology *t, size_t d)
{
	const size_t order = t->order[d];
	double *lines = plan->tables + plan->shape[AFLOAT_AT_LINES + d];
	double *bases = plan->tables + plan->shape[AFLOAT_AT_BASES + d];
	double *edges = plan->tables + plan->shape[AFLOAT_AT_EDGES + d];
	int32_t *first = plan->lists + plan->shape[AFLOAT_AT_FIRST + d];
	size_t span = 0;
	lines[0] = t->knots[d][order - 1];
	for (size_t i = order - 1; i < t->count[d]; i++) {
		if (!(t->knots[d][i + 1] > t->knots[d][i]))
			continue;
		double *basis = bases + span * order * order;
		first[span] = (int32_t)(i + 1 - order);
		take_basis(order, t->knots[d], i, basis);
		for (size_t k = 0; k < order; k++) {
			edges[2 * span * order + k] = value_at(order, basis, k, -0.5);
			edges[(2 * span + 1) * order + k] = value_at(order, basis, k, 0.5);
		}
		lines[++span] = t->knots[d][i + 1];
	}
}

static void fill(afloat_plan *plan, const afloat_topology *t, const double *drafts_m, double lbp_m)
{
	double *rule = plan->tables + plan->shape[AFLOAT_AT_RULE];
	gauss_points(t->points, rule, rule + t->points);
	for (size_t k = 0; k < t->points; k++) {
		rule[k] = 0.5 * (1 + rule[k]);
		rule[t->points + k] *= 0.5;
	}
	fill_direction(plan, t, AFLOAT_U);
	fill_direction(plan, t, AFLOAT_V);
	memcpy(plan->tables + plan->shape[AFLOAT_AT_DRAFTS], drafts_m,
	       (size_t)plan->shape[AFLOAT_DRAFTS] * sizeof *drafts_m);
	plan->tables[plan->shape[AFLOAT_AT_LENGTH]] = lbp_m;
}

batten_status afloat_plan_create(batten_context *context, const afloat_topology *topology,
                                 size_t draft_count, const double *drafts_m, double lbp_m,
                                 afloat_plan *out)
{
	*out = (afloat_plan){ .context = context };
	lay_out(out, topology, draft_count);
	out->lists = batten_allocate(context, out->list_count, sizeof *out->lists);
	out->tables = batten_allocate(context, out->table_count, sizeof *out->tables);
	if (!out->lists || !out->tables) {
		afloat_plan_destroy(out);
		return BATTEN_MEMORY;
	}
	fill(out, topology, drafts_m, lbp_m);
	return BATTEN_OK;
}

void afloat_plan_destroy(afloat_plan *plan)
{
	batten_release(plan->context, plan->lists);
	batten_release(plan->context, plan->tables);
	plan->lists = NULL;
	plan->tables = NULL;
}

static size_t poles_of(const afloat_plan *plan)
{
	return (size_t)plan->shape[AFLOAT_COUNT] * (size_t)plan->shape[AFLOAT_COUNT + 1];
}

size_t afloat_plan_net(const afloat_plan *plan)
{
	return poles_of(plan) * (size_t)plan->shape[AFLOAT_DIMENSION];
}

size_t afloat_plan_outcome(const afloat_plan *plan)
{
	return AFLOAT_OUTCOME((size_t)plan->shape[AFLOAT_DRAFTS]);
}

size_t afloat_plan_room(const afloat_plan *plan, size_t work_items)
{
	const size_t count_u = (size_t)plan->shape[AFLOAT_COUNT];
	const size_t count_v = (size_t)plan->shape[AFLOAT_COUNT + 1];
	return work_items * AFLOAT_ROOM(count_u, count_v);
}

void afloat_pack(const afloat_plan *plan, size_t which, size_t lane, size_t lanes, double *poles)
{
	const afloat_item *item = &plan->items[which];
	const size_t dimension = (size_t)plan->shape[AFLOAT_DIMENSION], count = poles_of(plan);
	for (size_t n = 0; n < count; n++) {
		double *to = poles + n * dimension * lanes + lane;
		const double weight = item->weights ? item->weights[n] : 1;
		for (size_t c = 0; c < 3; c++)
			to[c * lanes] = item->poles_m[3 * n + c] * weight;
		if (dimension == 4)
			to[3 * lanes] = weight;
	}
}

void afloat_unpack(const afloat_plan *plan, size_t which, size_t lane, size_t lanes,
                   const double *out)
{
	const size_t size = afloat_plan_outcome(plan);
	for (size_t n = 0; n < size; n++)
		plan->out[which * size + n] = out[n * lanes + lane];
}
