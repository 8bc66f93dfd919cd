/* Body of host/reference/textbook_f64.c and _f32.c, compiled once per precision: the includer defines
 * BATTEN_DOUBLE and TEXTBOOK_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#define GRID_FAIRNESS (s->fairness)
#include "shared/dialect.h"
#include "shared/textbook.h"

void TEXTBOOK_FUNCTION(const reference_multilevel *plan, const scalar *stencils, scalar *arrays,
                       const scalar *settings, scalar *outcome, scalar *scratch)
{
	const size_t nodes = ((size_t)plan->stations + 2) * ((size_t)plan->waterlines + 2);
	search_state s = state_of(plan->stations, plan->waterlines, stencils, arrays, settings,
	                          scratch);
	s.fairness = plan->fairness;
	textbook_run(&s, plan->iteration_limit, settings, arrays + SEARCH_ARRAY_Y * nodes, outcome);
}
