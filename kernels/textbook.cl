/* The pattern search of Hooke and Jeeves as published (thesis 7.2), whole searches in one launch, to
 * compare with. A work-group runs BATTEN_LANES searches side by side, one a lane of `real`; its
 * work-items share the waterlines of each objective. Arguments and layout are those of multilevel.cl;
 * it looks at no hats.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, STATE, GRID_FAIRNESS as in multilevel.cl. */
#if !defined(GRID_FAIRNESS)
#define GRID_FAIRNESS GRID_BENDING
#endif
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/textbook.h"

kernel void textbook(int stations, int waterlines, int level_count, int iteration_limit,
                     global const int *levels, global const int *centres,
                     global const scalar *stencils, global real *arrays,
                     global const real *settings, global real *outcome, STATE real *room,
                     local int *vote)
{
	const size_t nodes = (size_t)(stations + 2) * (size_t)(waterlines + 2);
	global stored *own = OWN_GLOBAL(arrays, SEARCH_ARRAY_COUNT * nodes);
	global const stored *set = OWN_GLOBAL(settings, SEARCH_SETTING_COUNT);
	global stored *told = OWN_GLOBAL(outcome, SEARCH_OUTCOME_COUNT);
	search_state s = state_of(
		stations, waterlines, stencils, own, set,
		OWN_STATE(room, SEARCH_STATE_NUMBERS(nodes, (size_t)waterlines, (size_t)WORK_ITEMS)));
	s.vote = vote;
	(void)level_count;
	(void)levels;
	(void)centres;
	textbook_run(&s, iteration_limit, set, own + SEARCH_ARRAY_Y * nodes, told);
}
