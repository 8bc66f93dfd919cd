/* Body of host/reference/multilevel_*.c, compiled once per precision, and once more for plain bending in a box,
 * which takes two thirds of the time where the compiler knows it: the includer defines BATTEN_DOUBLE,
 * MULTILEVEL_FUNCTION, GRID_FAIRNESS and GRID_PENALTY. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#include "shared/dialect.h"

#include "reference/inlined.h"
#include "shared/grid_search.h"

INLINED void work_search(const reference_multilevel *plan, const scalar *stencils, scalar *arrays,
                         const scalar *settings, scalar *outcome, scalar *scratch)
{
	const size_t nodes = ((size_t)plan->stations + 2) * ((size_t)plan->waterlines + 2);
	search_state s = state_of(plan->stations, plan->waterlines, stencils, arrays, settings,
	                          scratch);
	s.fairness = plan->fairness;
	s.penalised = plan->penalised;
	search_levels(&s, plan->level_count, plan->levels, plan->centres);
	search_slopes_clear(&s);
	search_run(&s, plan->iteration_limit, settings, arrays + SEARCH_ARRAY_Y * nodes, outcome);
}

WITH_FMA_WHERE_THERE_IS(MULTILEVEL_FUNCTION, work_search,
                        (const reference_multilevel *plan, const scalar *stencils, scalar *arrays,
                         const scalar *settings, scalar *outcome, scalar *scratch),
                        (plan, stencils, arrays, settings, outcome, scratch))
