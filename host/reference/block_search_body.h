/* Body of host/reference/block_search_f64.c and _f32.c, compiled once per precision: the includer
 * defines BATTEN_DOUBLE and BLOCK_SEARCH_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#define BATTEN_LANES 1
#define BLOCK_ANALYTIC (s->analytic)
#include "shared/dialect.h"

#include "shared/block_grid.h"
/* The course last: it calls these. */
#include "shared/block_lanes.h"

void BLOCK_SEARCH_FUNCTION(const reference_block_search *shared, const scalar *stencils,
                           scalar *input, const scalar *settings, scalar *outcome, scalar *scratch)
{
	const int lines = shared->lines, length = shared->length, hats = shared->hats;
	const int slots = REFERENCE_BLOCK_SLOTS(lines, hats, shared->rounds);
	scalar *ring = scratch + (size_t)BLOCK_STATE_COUNT * (size_t)(lines * length);
	scalar *hat_rows = ring + (size_t)BLOCK_PROBE_COUNT * (size_t)(slots * length);
	scalar *sums = hat_rows + BLOCK_HAT_NUMBERS(lines, hats);
	const block_state s = { .lines = lines,
		                    .length = length,
		                    .nodes = lines * length,
		                    .slots = slots,
		                    .rounds = shared->rounds,
		                    .analytic = shared->analytic,
		                    .across = stencils,
		                    .along = stencils + lines * STENCIL_SIZE,
		                    .arrays = scratch,
		                    .ring = ring,
		                    .sums = sums,
		                    .hats = hats,
		                    .hat_values = stencils + (lines + length) * STENCIL_SIZE,
		                    .hat_rows = hat_rows };
	const block_memory m = { .inputs = input,
		                     .ends = input,
		                     .settings = settings,
		                     .outcomes = outcome,
		                     .lanes = sums + BLOCK_SUM_COUNT * lines };
	block_queue q = { .next = 0, .end = 1 };
	block_run(&s, &m, &q, shared->iteration_limit);
}
