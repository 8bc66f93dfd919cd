/* The multilevel pattern search (Hooke and Jeeves; thesis 7.2), whole searches in one launch.
 *
 * A work-group runs BATTEN_LANES searches side by side, one a lane of `real`; its work-items share
 * the directions of each colour. On a CPU: many lanes, one work-item. On a GPU: several searches abreast
 * (dialect.h), many work-items each. Every direction and every sum is worked in one fixed order by one work-item, so the
 * shape does not change a bit of the result; the C path is the same source.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, STATE (local, or global for grids whose state
 * does not fit local memory), GRID_FAIRNESS (search_layout.h), plain bending where it is not, and
 * GRID_PENALTY (grid_state.h). */
#if !defined(GRID_FAIRNESS)
#define GRID_FAIRNESS GRID_BENDING
#endif
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/grid_search.h"

/* stencils: STENCIL_SIZE a station, then a waterline. levels: SEARCH_LEVEL_SIZE numbers each. centres:
 * station and waterline of each direction. arrays [group][SEARCH_ARRAY_COUNT][nodes], settings
 * [group][SEARCH_SETTING_COUNT], outcome [group][SEARCH_OUTCOME_COUNT], room [group][SEARCH_STATE_NUMBERS], all
 * of real. */
kernel void multilevel(int stations, int waterlines, int level_count, int iteration_limit,
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
	search_levels(&s, level_count, levels, centres);
	search_slopes_clear(&s);
	search_run(&s, iteration_limit, set, own + SEARCH_ARRAY_Y * nodes, told);
}
