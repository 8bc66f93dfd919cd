#include "batch/search_plan.h"

#include "core/difference.h"
#include "core/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/grid_energy.h"
#include "shared/multilevel.h"

enum { COORDINATE_LIMIT = 4096, F32_NODE_LIMIT = 1 << 22 };

static void lay_out_direction(const double *at, size_t count, double *stencil, double *cell)
{
	for (size_t i = 0; i < count; i++) {
		cell[i] = difference_cell(at, count, i);
		if (i > 0 && i + 1 < count) /* no term of the energy at the ends; weights stay 0 */
			difference_weights(at + i, stencil + i * STENCIL_SIZE);
	}
}

/* Weights of third derivatives; 0 where two nodes on each side are not there. */
static void lay_out_third(const double *at, size_t count, double *third)
{
	for (size_t i = 2; i + 2 < count; i++) {
		const difference_quartic quartic = difference_quartic_of(at + i);
		memcpy(third + i * STENCIL_THIRD, quartic.weight, sizeof quartic.weight);
	}
}

/* The median spacing stands for a direction whose spacing is uneven. */
static batten_status typical_spacing(batten_context *context, const double *at, size_t count,
                                     double *spacing)
{
	double *steps = batten_allocate(context, count, sizeof *steps);
	if (!steps)
		return BATTEN_MEMORY;
	for (size_t i = 0; i + 1 < count; i++)
		steps[i] = at[i + 1] - at[i];
	qsort(steps, count - 1, sizeof *steps, batten_number_compare);
	*spacing = steps[(count - 1) / 2];
	batten_release(context, steps);
	return BATTEN_OK;
}

/* The largest power of two that is neither above wanted nor above half the direction's intervals. */
static int hat_width(double wanted, size_t count)
{
	int width = 1;
	while (2.0 * width <= wanted && 2 * (size_t)width <= (count - 1) / 2)
		width *= 2;
	return width;
}

int search_widths_choose(size_t count_a, double spacing_a, size_t count_b, double spacing_b,
                         search_width widths[SEARCH_LEVEL_LIMIT])
{
	const double finest = fmin(spacing_a, spacing_b) * (1.0 + 1e-9);
	const double span_a = spacing_a * 0.5 * (double)(count_a - 1);
	const double span_b = spacing_b * 0.5 * (double)(count_b - 1);
	int levels = 0;
	for (int doublings = 0; levels < SEARCH_LEVEL_LIMIT; doublings++) {
		const double width = ldexp(finest, doublings);
		const search_width level = { hat_width(width / spacing_a, count_a),
			                         hat_width(width / spacing_b, count_b) };
		if (levels == 0 || level.a != widths[levels - 1].a || level.b != widths[levels - 1].b)
			widths[levels++] = level;
		if (width >= span_a && width >= span_b)
			break;
	}
	return levels;
}

static void choose_levels(search_plan *plan)
{
	search_width widths[SEARCH_LEVEL_LIMIT];
	plan->level_count = search_widths_choose(plan->station_count, plan->spacing_x,
	                                         plan->waterline_count, plan->spacing_z, widths);
	for (int l = 0; l < plan->level_count; l++) {
		plan->levels[l].width_x = widths[l].a;
		plan->levels[l].width_z = widths[l].b;
	}
}

static bool can_move(const batten_search_problem *problem, size_t node)
{
	return (!problem->nodes || problem->nodes[node] != BATTEN_NODE_OUTSIDE) &&
	       problem->lower_m[node] < problem->upper_m[node];
}

/* Whether a node under the hat is marked in movable; where that is NULL, whether the problem's can move. */
static bool direction_moves(const search_plan *plan, const uint8_t *movable,
                            const batten_search_problem *problem, const search_level *level,
                            int station, int waterline)
{
	for (int k = waterline - level->width_z + 1; k < waterline + level->width_z; k++)
		for (int i = station - level->width_x + 1; i < station + level->width_x; i++)
			if (k >= 0 && k < (int)plan->waterline_count && i >= 0 &&
			    i < (int)plan->station_count) {
				const size_t node = (size_t)k * plan->station_count + (size_t)i;
				if (movable ? movable[node] : can_move(problem, node))
					return true;
			}
	return false;
}

size_t search_centre_count(size_t count, int width)
{
	return (count - 1 + (size_t)width - 1) / (size_t)width + 1;
}

/* Appends the directions of one level and colour; with centres NULL only counts them. */
static size_t add_colour(const search_plan *plan, const search_level *level, size_t colour,
                         const uint8_t *movable, int32_t *centres)
{
	const size_t along_x = search_centre_count(plan->station_count, level->width_x);
	const size_t along_z = search_centre_count(plan->waterline_count, level->width_z);
	size_t added = 0;
	const size_t aside = GRID_COLOURS_ASIDE(plan->fairness);
	for (size_t b = colour / aside; b < along_z; b += aside)
		for (size_t a = colour % aside; a < along_x; a += aside) {
			const int station = (int)a * level->width_x;
			const int waterline = (int)b * level->width_z;
			if (!direction_moves(plan, movable, NULL, level, station, waterline))
				continue;
			if (centres) {
				centres[2 * added] = station;
				centres[2 * added + 1] = waterline;
			}
			added++;
		}
	return added;
}

static void add_directions(search_plan *plan, const uint8_t *movable)
{
	size_t total = 0;
	for (int l = 0; l < plan->level_count; l++)
		for (size_t c = 0; c < GRID_COLOURS(plan->fairness); c++) {
			search_level *level = &plan->levels[l];
			int32_t *centres = plan->centres ? plan->centres + 2 * total : NULL;
			level->first[c] = (int)total;
			total += add_colour(plan, level, c, movable, centres);
			level->first[c + 1] = (int)total;
		}
	plan->direction_count = total;
}

/* The directions that can move something in at least one problem of the batch. A direction that
 * cannot move a hull changes nothing in it, so a hull's result does not depend on its batch. */
static batten_status list_directions(search_plan *plan, size_t count,
                                     const batten_search_problem *problems)
{
	const size_t nodes = plan->station_count * plan->waterline_count;
	uint8_t *movable = batten_allocate(plan->context, nodes, 1);
	if (!movable)
		return BATTEN_MEMORY;
	for (size_t p = 0; p < count; p++)
		if (!search_problem_fault(plan, &problems[p]))
			for (size_t n = 0; n < nodes; n++)
				movable[n] |= can_move(&problems[p], n);
	add_directions(plan, movable);
	plan->centres = batten_allocate(plan->context, 2 * plan->direction_count + 1,
	                                sizeof *plan->centres);
	if (plan->centres)
		add_directions(plan, movable);
	batten_release(plan->context, movable);
	return plan->centres ? BATTEN_OK : BATTEN_MEMORY;
}

batten_status search_grid_check(batten_context *context, const batten_grid *grid)
{
	if (grid->station_count < 3 || grid->station_count > COORDINATE_LIMIT ||
	    grid->waterline_count < 3 || grid->waterline_count > COORDINATE_LIMIT)
		return batten_fail(context, BATTEN_USAGE,
		                   "a grid of %zu stations and %zu waterlines, 3 to %d each are expected",
		                   grid->station_count, grid->waterline_count, COORDINATE_LIMIT);
	for (size_t i = 0; i < grid->station_count; i++)
		if (!isfinite(grid->x_m[i]) || (i > 0 && !(grid->x_m[i] > grid->x_m[i - 1])))
			return batten_fail(context, BATTEN_USAGE, "station %zu: x must be finite and ascending",
			                   i);
	for (size_t k = 0; k < grid->waterline_count; k++)
		if (!isfinite(grid->z_m[k]) || (k > 0 && !(grid->z_m[k] > grid->z_m[k - 1])))
			return batten_fail(context, BATTEN_USAGE,
			                   "waterline %zu: z must be finite and ascending", k);
	return BATTEN_OK;
}

/* A work-item has at most 16, or, abreast, one. */
static bool is_lane_count(unsigned lanes, unsigned work_group)
{
	return (lanes <= 16 || work_group % lanes == 0) && (lanes & (lanes - 1)) == 0;
}

bool search_options_plain(const batten_search_options *options)
{
	return options->fairness == BATTEN_FAIRNESS_BENDING && options->longitudinal_weight == 1.0 &&
	       options->transverse_weight == 1.0;
}

batten_search_algorithm search_options_algorithm(const batten_search_options *options)
{
	if (options->algorithm != BATTEN_ALGORITHM_AUTO)
		return options->algorithm;
	return search_options_plain(options) && !options->interior_penalty
	           ? BATTEN_ALGORITHM_BLOCK
	           : BATTEN_ALGORITHM_MULTILEVEL;
}

/* Hats leave the gap that is promised at steps ten times as long as others need; not so where the problem is
 * of the sixth order, or a round of an interior penalty has to leave less. */
static double default_last_step(const batten_search_options *options)
{
	const bool hats = search_options_algorithm(options) == BATTEN_ALGORITHM_MULTILEVEL &&
	                  options->fairness != BATTEN_FAIRNESS_VARIATION && !options->interior_penalty;
	return (options->precision == BATTEN_F64 ? 2e-7 : 2e-6) * (hats ? 10.0 : 1.0);
}

batten_status search_options_check(batten_context *context, const batten_search_options *given,
                                   batten_search_options *chosen)
{
	batten_search_options_default(chosen);
	if (given)
		*chosen = *given;
	if (chosen->struct_size != sizeof *chosen)
		return batten_fail(context, BATTEN_USAGE, "search options of another version of batten");
	if (chosen->last_step == 0.0)
		chosen->last_step = default_last_step(chosen);
	const bool shrinks = chosen->precision == BATTEN_F64
	                         ? chosen->last_step < chosen->first_step
	                         : (float)chosen->last_step < (float)chosen->first_step;
	if (!(chosen->last_step >= 1e-30) || !shrinks || !(chosen->first_step <= 1e30))
		return batten_fail(
			context, BATTEN_USAGE,
			"search steps %g to %g of the half-beam: 1e-30 <= last < first <= 1e30 is "
			"expected",
			chosen->first_step, chosen->last_step);
	if (chosen->iteration_limit == 0 || chosen->iteration_limit > 1000000)
		return batten_fail(context, BATTEN_USAGE, "iteration limit %u: 1 to 1000000 is expected",
		                   chosen->iteration_limit);
	if (chosen->device < BATTEN_DEVICE_REFERENCE)
		return batten_fail(context, BATTEN_USAGE,
		                   "device %d: auto, reference or an index is expected", chosen->device);
	if (!is_lane_count(chosen->lanes, chosen->work_group) || chosen->work_group > 1024)
		return batten_fail(
			context, BATTEN_USAGE,
			"%u lanes in a work-group of %u: 1, 2, 4, 8 or 16 lanes, or a power of two that "
			"divides the work-items, and at most 1024 of these are expected",
			chosen->lanes, chosen->work_group);
	return BATTEN_OK;
}

static batten_status lay_out_grid(search_plan *plan, const batten_grid *grid)
{
	batten_context *context = plan->context;
	plan->station_count = grid->station_count;
	plan->waterline_count = grid->waterline_count;
	plan->node_count = (grid->station_count + 2) * (grid->waterline_count + 2);
	plan->x_m = batten_allocate(context, grid->station_count, sizeof(double));
	plan->z_m = batten_allocate(context, grid->waterline_count, sizeof(double));
	plan->stencil_x = batten_allocate(context, grid->station_count, STENCIL_SIZE * sizeof(double));
	plan->stencil_z = batten_allocate(context, grid->waterline_count,
	                                  STENCIL_SIZE * sizeof(double));
	plan->cell_x = batten_allocate(context, grid->station_count, sizeof(double));
	plan->cell_z = batten_allocate(context, grid->waterline_count, sizeof(double));
	if (!plan->x_m || !plan->z_m || !plan->stencil_x || !plan->stencil_z || !plan->cell_x ||
	    !plan->cell_z)
		return BATTEN_MEMORY;
	memcpy(plan->x_m, grid->x_m, grid->station_count * sizeof(double));
	memcpy(plan->z_m, grid->z_m, grid->waterline_count * sizeof(double));
	lay_out_direction(grid->x_m, grid->station_count, plan->stencil_x, plan->cell_x);
	lay_out_direction(grid->z_m, grid->waterline_count, plan->stencil_z, plan->cell_z);
	if (plan->fairness == GRID_VARIATION) {
		plan->third_x = batten_allocate(context, grid->station_count,
		                                STENCIL_THIRD * sizeof(double));
		plan->third_z = batten_allocate(context, grid->waterline_count,
		                                STENCIL_THIRD * sizeof(double));
		if (!plan->third_x || !plan->third_z)
			return BATTEN_MEMORY;
		lay_out_third(grid->x_m, grid->station_count, plan->third_x);
		lay_out_third(grid->z_m, grid->waterline_count, plan->third_z);
	}
	batten_status status = typical_spacing(context, grid->x_m, grid->station_count,
	                                       &plan->spacing_x);
	if (status == BATTEN_OK)
		status = typical_spacing(context, grid->z_m, grid->waterline_count, &plan->spacing_z);
	if (status == BATTEN_OK)
		choose_levels(plan);
	return status;
}

batten_fairness search_fairness_of(int fairness)
{
	switch (fairness) {
	case GRID_MEAN:
		return BATTEN_FAIRNESS_MEAN;
	case GRID_GAUSS:
		return BATTEN_FAIRNESS_GAUSS;
	case GRID_VARIATION:
		return BATTEN_FAIRNESS_VARIATION;
	default:
		return BATTEN_FAIRNESS_BENDING;
	}
}

static bool is_curvature_weight(double weight)
{
	return weight == 0.0 || (weight >= 1e-6 && weight <= 1e6);
}

static batten_status choose_fairness(search_plan *plan)
{
	const double along = plan->options.longitudinal_weight;
	const double across = plan->options.transverse_weight;
	if (!is_curvature_weight(along) || !is_curvature_weight(across) || along + across == 0.0)
		return batten_fail(
			plan->context, BATTEN_USAGE,
			"longitudinal and transverse weight %g and %g: 0 or 1e-6 to 1e6, not both "
			"0, are expected",
			along, across);
	switch (plan->options.fairness) {
	case BATTEN_FAIRNESS_BENDING:
		plan->fairness = along == 1.0 && across == 1.0 ? GRID_BENDING : GRID_BENDING_WEIGHTED;
		return BATTEN_OK;
	case BATTEN_FAIRNESS_MEAN:
		plan->fairness = GRID_MEAN;
		return BATTEN_OK;
	case BATTEN_FAIRNESS_GAUSS:
		plan->fairness = GRID_GAUSS;
		return BATTEN_OK;
	case BATTEN_FAIRNESS_VARIATION:
		plan->fairness = GRID_VARIATION;
		if (along == 1.0 && across == 1.0)
			return BATTEN_OK;
		return batten_fail(
			plan->context, BATTEN_USAGE,
			"variation of curvature goes along the principal directions, both alike: "
			"longitudinal and transverse weight 1 are expected, found %g and %g",
			along, across);
	}
	return batten_fail(plan->context, BATTEN_USAGE, "found fairness %d, which is none",
	                   (int)plan->options.fairness);
}

batten_status search_plan_create(batten_context *context, const batten_grid *grid, size_t count,
                                 const batten_search_problem *problems,
                                 const batten_search_options *options, search_plan **out)
{
	batten_status status = search_grid_check(context, grid);
	if (status != BATTEN_OK)
		return status;
	search_plan *plan = batten_allocate(context, 1, sizeof *plan);
	if (!plan)
		return BATTEN_MEMORY;
	plan->context = context;
	status = search_options_check(context, options, &plan->options);
	if (status == BATTEN_OK)
		status = choose_fairness(plan);
	if (status == BATTEN_OK && plan->options.precision == BATTEN_F32 &&
	    grid->station_count * grid->waterline_count > F32_NODE_LIMIT)
		status = batten_fail(context, BATTEN_USAGE,
		                     "a grid of %zu x %zu nodes in f32: at most %d nodes are expected",
		                     grid->station_count, grid->waterline_count, F32_NODE_LIMIT);
	if (status == BATTEN_OK)
		status = lay_out_grid(plan, grid);
	if (status == BATTEN_OK && plan->options.algorithm != BATTEN_ALGORITHM_BLOCK)
		status = list_directions(plan, count, problems);
	if (status != BATTEN_OK) {
		search_plan_destroy(plan);
		return status;
	}
	*out = plan;
	return BATTEN_OK;
}

void search_plan_destroy(search_plan *plan)
{
	if (!plan)
		return;
	batten_context *context = plan->context;
	batten_release(context, plan->x_m);
	batten_release(context, plan->z_m);
	batten_release(context, plan->stencil_x);
	batten_release(context, plan->stencil_z);
	batten_release(context, plan->third_x);
	batten_release(context, plan->third_z);
	batten_release(context, plan->cell_x);
	batten_release(context, plan->cell_z);
	batten_release(context, plan->centres);
	batten_release(context, plan);
}

int search_plan_wide_levels(const search_plan *plan)
{
	return search_wide_levels(&plan->levels[0].width_x, plan->level_count);
}

uint64_t search_problem_directions(const search_plan *plan, const batten_search_problem *problem,
                                   int first_level, int end_level)
{
	uint64_t directions = 0;
	for (int l = first_level; l < end_level; l++)
		for (int d = plan->levels[l].first[0];
		     d < plan->levels[l].first[GRID_COLOURS(plan->fairness)]; d++)
			directions += direction_moves(plan, NULL, problem, &plan->levels[l],
			                              plan->centres[2 * d], plan->centres[2 * d + 1]);
	return directions;
}

void batten_search_options_default(batten_search_options *options)
{
	*options = (batten_search_options){ .struct_size = sizeof *options,
		                                .device = BATTEN_DEVICE_AUTO,
		                                .precision = BATTEN_F64,
		                                .first_step = 0.02,
		                                .iteration_limit = 400,
		                                .longitudinal_weight = 1.0,
		                                .transverse_weight = 1.0 };
}

const char *batten_search_end_text(batten_search_end end)
{
	switch (end) {
	case BATTEN_SEARCH_CONVERGED:
		return "converged by step";
	case BATTEN_SEARCH_LIMIT:
		return "iteration limit";
	case BATTEN_SEARCH_STATIONARY:
		return "stationary at start";
	case BATTEN_SEARCH_REFUSED:
		return "refused";
	}
	return "unknown";
}
