/* Body of host/reference/block_search_f64.c and _f32.c, compiled once per precision: the includer
 * defines BATTEN_DOUBLE and BLOCK_SEARCH_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#define BATTEN_LANES 1
#define BLOCK_ANALYTIC (s->analytic)
#include "shared/dialect.h"

#include "shared/block_lanes.h"

void BLOCK_SEARCH_FUNCTION(const reference_block_search *shared, const scalar *stencils,
                           scalar *input, const scalar *settings, scalar *outcome, scalar *scratch)
{
	const int nodes = shared->lines * shared->length;
	scalar lanes[BLOCK_OUTCOME_COUNT + 1];
	scalar *ring = scratch + (size_t)BLOCK_STATE_COUNT * (size_t)nodes;
	const block_state s = { .lines = shared->lines,
		                    .length = shared->length,
		                    .nodes = nodes,
		                    .slots = 3,
		                    .analytic = shared->analytic,
		                    .across = stencils,
		                    .along = stencils + shared->lines * STENCIL_SIZE,
		                    .arrays = scratch,
		                    .ring = ring,
		                    .sums = ring + (size_t)3 * (size_t)shared->length * BLOCK_PROBE_COUNT };
	const block_memory m = {
		.inputs = input, .settings = settings, .outcomes = outcome, .lanes = lanes
	};
	block_queue q = { .next = 0, .end = 1 };
	block_run(&s, &m, &q, shared->iteration_limit);
}
