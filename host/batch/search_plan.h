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
	int32_t first[SEARCH_COLOUR_COUNT + 1];
} search_level;
_Static_assert(sizeof(search_level) == SEARCH_LEVEL_SIZE * sizeof(int32_t),
               "as the kernel reads it");

typedef struct search_plan {
	batten_context *context;
	size_t station_count, waterline_count,
		node_count;                /* node_count with a ring of one node around */
	double *stencil_x, *stencil_z; /* STENCIL_SIZE a station, a waterline */
	double *cell_x, *cell_z;       /* half-sum spacings */
	int level_count;
	search_level levels[SEARCH_LEVEL_LIMIT];
	int32_t *centres; /* station, waterline; every level and colour one after the other */
	size_t direction_count;
	batten_search_options options; /* with every 0 replaced by what it chooses */
} search_plan;

/* Checks the batch and lays it out. The directions are those that can move a node of at least one of
 * the problems. Errors: USAGE, MEMORY. */
batten_status search_plan_create(batten_context *context, const batten_grid *grid, size_t count,
                                 const batten_search_problem *problems,
                                 const batten_search_options *options, search_plan **out);
void search_plan_destroy(search_plan *plan);

/* Why a problem cannot be searched, or NULL. */
const char *search_problem_fault(const search_plan *plan, const batten_search_problem *problem);

/* Directions that can move at least one node of this problem; scratch has a byte a node of the
 * grid. */
uint64_t search_problem_directions(const search_plan *plan, const batten_search_problem *problem,
                                   uint8_t *scratch);

#endif
