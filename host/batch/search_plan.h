/* A batch of searches made ready to run: what all searches share (grid, stencils, levels,
 * directions) and, packed lane by lane, what each has of its own. The C path and the kernels read the
 * same numbers. */
#ifndef BATTEN_BATCH_SEARCH_PLAN_H
#define BATTEN_BATCH_SEARCH_PLAN_H

#include "core/context.h"
#include "shared/search_layout.h"

enum { SEARCH_LEVEL_LIMIT = 12 };

/* One level of hats, laid out as SEARCH_LEVEL_SIZE numbers: the directions of colour c are number
 * first[c] to first[c + 1] of plan->centres. */
typedef struct search_level {
	int32_t width_x, width_z;
	int32_t first[SEARCH_COLOUR_LIMIT + 1];
} search_level;
_Static_assert(sizeof(search_level) == SEARCH_LEVEL_SIZE * sizeof(int32_t),
               "as the kernel reads it");

typedef struct search_plan {
	batten_context *context;
	size_t station_count, waterline_count,
		node_count;                /* node_count with a ring of one node around */
	double *x_m, *z_m;             /* coordinates */
	double *stencil_x, *stencil_z; /* STENCIL_SIZE a station, a waterline */
	double *third_x, *third_z;     /* STENCIL_THIRD each, of GRID_VARIATION; else NULL */
	double *cell_x, *cell_z;       /* half-sum spacings */
	double spacing_x, spacing_z;   /* medians */
	int level_count;
	search_level levels[SEARCH_LEVEL_LIMIT];
	int32_t *centres; /* station, waterline; every level and colour one after the other */
	size_t direction_count;
	int fairness;                  /* GRID_BENDING ... */
	const double *penalties;       /* r of each problem's interior penalty, borrowed; NULL: none */
	batten_search_options options; /* with every 0 replaced by what it chooses */
} search_plan;

/* Widths of a level's hats in nodes along two directions. */
typedef struct search_width {
	int a, b;
} search_width;

/* The levels of hats for so many nodes at such a spacing, fine to coarse. Hats grow in physical width,
 * not in nodes: the energy couples neighbours strongly only along the finer direction, and widening
 * the other with it converges several times slower. They grow until both directions are spanned.
 * Returns the number of levels. */
int search_widths_choose(size_t count_a, double spacing_a, size_t count_b, double spacing_b,
                         search_width widths[SEARCH_LEVEL_LIMIT]);

/* Hats of a width that it takes to span so many nodes; their centres lie `width` apart from node 0 on,
 * the last one perhaps beyond. */
size_t search_centre_count(size_t count, int width);

/* Counts and coordinates as batten_grid wants them. Errors: USAGE. */
batten_status search_grid_check(batten_context *context, const batten_grid *grid);

/* Whether it is bending, both directions alike, that is to be low. */
bool search_options_plain(const batten_search_options *options);

/* The algorithm of a search over an offset grid: what AUTO takes. */
batten_search_algorithm search_options_algorithm(const batten_search_options *options);

/* Takes the defaults where given is NULL, checks them and replaces every 0 that stands for "choose".
 * Lanes and work-group are chosen per device later. Errors: USAGE. */
batten_status search_options_check(batten_context *context, const batten_search_options *given,
                                   batten_search_options *chosen);

/* Why these cannot be searched with in the precision, or NULL. */
const char *search_weights_fault(batten_precision precision, double w1, double w2,
                                 double half_beam_m);

/* Checks the batch and lays it out. The directions are those that can move a node of at least one of
 * the problems; the block search has none. Errors: USAGE, MEMORY. */
batten_status search_plan_create(batten_context *context, const batten_grid *grid, size_t count,
                                 const batten_search_problem *problems,
                                 const batten_search_options *options, search_plan **out);
void search_plan_destroy(search_plan *plan);

/* What was asked for where the plan says GRID_BENDING ... */
batten_fairness search_fairness_of(int fairness);

/* Why a problem cannot be searched, or NULL. */
const char *search_problem_fault(const search_plan *plan, const batten_search_problem *problem);

/* How many of the levels, the last ones, wait for their turn (shared/multilevel.h). */
int search_plan_wide_levels(const search_plan *plan);

/* Directions of levels first_level .. end_level - 1 that can move at least one node of this problem. */
uint64_t search_problem_directions(const search_plan *plan, const batten_search_problem *problem,
                                   int first_level, int end_level);

#endif
