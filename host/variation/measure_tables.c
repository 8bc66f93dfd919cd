#include "variation/measure.h"

#include <math.h>
#include <string.h>

bool variation_tables_fit(const batten_hull *parent, const batten_vary_options *options)
{
	const bool method = options->method == BATTEN_VARY_SWING ||
	                    options->method == BATTEN_VARY_ONE_MINUS_PRISMATIC ||
	                    options->method == BATTEN_VARY_LACKENBY;
	return method && !options->thesis && parent->layout == HULL_LAYOUT_GRID &&
	       parent->end_count == 0 && parent->profile_count == 0;
}

/* ------------------------------------------------------------------------------------------------
 * Formulas
 * --------------------------------------------------------------------------------------------- */

static void fill_half(const variation_half_numbers *half, double *numbers)
{
	numbers[VARIANTS_HALF_PARALLEL] = half->parallel;
	numbers[VARIANTS_HALF_LENGTH] = half->length_m;
	numbers[VARIANTS_HALF_FULLNESS] = half->fullness;
	numbers[VARIANTS_HALF_LEVER] = half->lever;
	numbers[VARIANTS_HALF_BODY_LEVER] = half->body_lever;
	numbers[VARIANTS_HALF_BY_FULLNESS] = half->by_fullness;
	numbers[VARIANTS_HALF_BY_BODY] = half->by_body;
	numbers[VARIANTS_HALF_LINEAR] = half->linear;
}

/* A swing by one metre of factor: the level of both halves is the factor. */
static void fill_swing(const variation_parent *parent, variants_plan *plan)
{
	const batten_hull *hull = parent->hull;
	double *formula = variants_plan_table(plan, VARIANTS_AT_FORMULA);
	double *move = variants_plan_table(plan, VARIANTS_AT_SHIFT);
	const variation_shift one = variation_shift_swing(&parent->areas, &parent->span, 1,
	                                                  hull->lbp_m);
	variation_shift_swing_slopes(&one, &formula[VARIANTS_FORMULA_SLOPE_LEAST],
	                             &formula[VARIANTS_FORMULA_SLOPE_MOST]);
	formula[VARIANTS_FORMULA_SWING] = one.swing_factor_m;
	for (size_t i = 0; i < hull->station_count; i++)
		move[3 * i] = variation_shift_at(&one, hull->x_m[i]) / one.swing_factor_m;
}

static batten_status fill_halves(const variation_parent *parent, const batten_vary_options *options,
                                 variants_plan *plan)
{
	const batten_hull *hull = parent->hull;
	const variation_span *span = &parent->span;
	double *formula = variants_plan_table(plan, VARIANTS_AT_FORMULA);
	double *move = variants_plan_table(plan, VARIANTS_AT_SHIFT);
	variation_numbers numbers;
	if (!variation_shift_numbers(&parent->areas, span, options->method == BATTEN_VARY_LACKENBY,
	                             &numbers))
		return batten_fail(
			parent->context, BATTEN_INPUT,
			"%s: a half of its sectional area curve is full, nothing is left to move", hull->name);
	fill_half(&numbers.aft, formula + VARIANTS_FORMULA_AFT);
	fill_half(&numbers.fore, formula + VARIANTS_FORMULA_FORE);
	formula[VARIANTS_FORMULA_FULLNESS] = numbers.fullness;
	formula[VARIANTS_FORMULA_CENTRE] = isnan(options->lcb_used_pct) ? numbers.centre
	                                                                : options->lcb_used_pct / 50;
	for (size_t i = 0; i < hull->station_count; i++) {
		const double x = hull->x_m[i];
		const bool fore = x >= span->middle_m;
		const variation_half_numbers *half = fore ? &numbers.fore : &numbers.aft;
		const double part = fmax(fabs(x - span->middle_m) / half->length_m, half->parallel);
		const bool still = x <= span->aft_m || x >= span->fore_m;
		move[3 * i] = still ? 0 : (fore ? 1 : -1) * (1 - part) * half->length_m;
		move[3 * i + 1] = move[3 * i] * (part - half->parallel);
		move[3 * i + 2] = fore;
	}
	return BATTEN_OK;
}

/* The stations that the parallel body takes the place of. */
static void fill_body(const variation_parent *parent, variants_plan *plan)
{
	const variation_span *span = &parent->span;
	const double from = span->middle_m - span->parallel_aft * (span->middle_m - span->aft_m);
	const double to = span->middle_m + span->parallel_fore * (span->fore_m - span->middle_m);
	double *formula = variants_plan_table(plan, VARIANTS_AT_FORMULA);
	for (size_t i = 0; i < parent->hull->station_count; i++) {
		const double x = parent->hull->x_m[i];
		plan->shape[VARIANTS_BEFORE_BODY] += x < from;
		plan->shape[VARIANTS_WITHIN_BODY] += x >= from && x <= to;
	}
	formula[VARIANTS_FORMULA_MIDDLE] = span->middle_m;
	formula[VARIANTS_FORMULA_LEAST_BODY] = VARIATION_BODY_PART * (span->fore_m - span->aft_m);
	formula[VARIANTS_FORMULA_ALWAYS_BODY] = span->parallel_aft > 0 || span->parallel_fore > 0;
}

/* ------------------------------------------------------------------------------------------------
 * Nodes
 * --------------------------------------------------------------------------------------------- */

/* Whether a neighbour along the waterline, or the one above, has a positive half-breadth. */
static bool is_beside(const batten_hull *hull, size_t node)
{
	const size_t stations = hull->station_count, station = node % stations;
	return (station > 0 && hull->y_m[node - 1] > 0) ||
	       (station + 1 < stations && hull->y_m[node + 1] > 0) ||
	       (node + stations < hull_node_count(hull) && hull->y_m[node + stations] > 0);
}

/* What sections.c makes of a node whose half-breadth becomes 0, as bits. */
static double kind_of(const batten_hull *hull, size_t node)
{
	const bool on = hull->nodes[node] != BATTEN_NODE_OUTSIDE;
	if (hull->nodes[node] == BATTEN_NODE_UNKNOWN)
		return VARIANTS_NODE_ALWAYS + VARIANTS_NODE_UNKNOWN;
	if (hull->y_m[node] > 0)
		return VARIANTS_NODE_BESIDE;
	if (is_beside(hull, node))
		return on ? VARIANTS_NODE_BESIDE : 0;
	return on ? VARIANTS_NODE_ALWAYS : VARIANTS_NODE_BESIDE;
}

static void fill_nodes(const variation_parent *parent, variants_plan *plan)
{
	const batten_hull *hull = parent->hull;
	double *nodes = variants_plan_table(plan, VARIANTS_AT_NODES);
	double *y = variants_plan_table(plan, VARIANTS_AT_PARENT);
	for (size_t n = 0; n < hull_node_count(hull); n++) {
		nodes[n] = kind_of(hull, n);
		y[n] = hull->nodes[n] == BATTEN_NODE_OUTSIDE ? 0 : hull->y_m[n];
	}
	for (size_t w = 0; w < hull->waterline_count; w++)
		variants_plan_table(plan, VARIANTS_AT_MIDDLE)[w] = parent->lines[w].middle_m;
}

/* The list of a waterline with '?' nodes; returns its length, 0 without any. */
static size_t list_line(const batten_hull *hull, size_t waterline, int32_t *list)
{
	const uint8_t *nodes = hull->nodes + waterline * hull->station_count;
	size_t known = 0, unknown = 0;
	for (size_t s = 0; s < hull->station_count; s++)
		if (nodes[s] != BATTEN_NODE_UNKNOWN)
			list[1 + known++] = (int32_t)s;
	list[0] = (int32_t)known;
	int32_t *row = list + known + 2;
	for (size_t s = 0, before = 0; s < hull->station_count; s++) {
		if (nodes[s] != BATTEN_NODE_UNKNOWN) {
			before++;
			continue;
		}
		row[2 * unknown] = (int32_t)s;
		/* one before the first has no interval: the kernel finds such lines irregular */
		row[2 * unknown + 1] = (int32_t)(before > 0 ? before - 1 : 0);
		unknown++;
	}
	list[known + 1] = (int32_t)unknown;
	return unknown > 0 ? known + 2 + 2 * unknown : 0;
}

static batten_status fill_lists(const batten_hull *hull, variants_plan *plan)
{
	const size_t lines = hull->waterline_count, most = 2 * hull->station_count + 2;
	int32_t *lists = batten_allocate(plan->context, lines, (most + 1) * sizeof *lists);
	if (!lists)
		return BATTEN_MEMORY;
	size_t used = lines, before = 0;
	for (size_t w = 0; w < lines; w++) {
		const size_t length = list_line(hull, w, lists + used);
		lists[w] = length > 0 ? (int32_t)used : 0;
		/* lines alike share a list, by which the kernel knows them */
		if (length > 0 && length == before &&
		    memcmp(lists + used, lists + used - before, length * sizeof *lists) == 0)
			lists[w] = (int32_t)(used - before);
		else
			used += before = length;
	}
	batten_release(plan->context, plan->lists);
	plan->lists = lists;
	plan->list_count = used;
	return BATTEN_OK;
}

batten_status variation_tables_fill(const variation_parent *parent,
                                    const batten_vary_options *options, variants_plan *plan)
{
	double *formula = variants_plan_table(plan, VARIANTS_AT_FORMULA);
	const bool swing = options->method == BATTEN_VARY_SWING;
	plan->shape[VARIANTS_METHOD] = swing ? VARIANTS_SWING : VARIANTS_HALVES;
	plan->shape[VARIANTS_ONCE] = options->first_pass;
	formula[VARIANTS_FORMULA_LEAST] = VARIATION_ZERO_PART * batten_hull_half_beam_m(parent->hull);
	formula[VARIANTS_FORMULA_PARENT_CP] = parent->measures.cp;
	formula[VARIANTS_FORMULA_PARENT_LCB] = parent->measures.lcb_pct_lbp_fwd;
	fill_body(parent, plan);
	fill_nodes(parent, plan);
	batten_status status = BATTEN_OK;
	if (swing)
		fill_swing(parent, plan);
	else
		status = fill_halves(parent, options, plan);
	return status == BATTEN_OK ? fill_lists(parent->hull, plan) : status;
}
