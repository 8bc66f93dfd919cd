/* The block search, whole searches in one launch.
 *
 * A work-group works a range of the searches, BATTEN_LANES of them at a time, one a lane of `real`; its
 * work-items share the lines of the grid. On a CPU: many lanes, one work-item. On a GPU: several searches abreast
 * (dialect.h), many work-items each. Every line and every sum is worked in one fixed order by one work-item, so
 * the shape does not change a bit of the result; the C path is the same source.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, STATE (local, or global for grids whose state does
 * not fit local memory), BLOCK_ANALYTIC (1: slopes of the integrand by formula, not by probes). */
#if !defined(BLOCK_ANALYTIC)
#define BLOCK_ANALYTIC 0
#endif
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
/* What is called from several places PoCL would call, and what it gets by address, the state of a search, then
 * stands in memory everywhere: 3 % of a search. */
#if defined(BATTEN_ALONE)
#undef SHARED_FUNCTION
#define SHARED_FUNCTION static inline __attribute__((always_inline))
#endif
#include "shared/block_grid.h"
#include "shared/block_lanes.h"

/* stencils: STENCIL_SIZE a line, then a node of a line, then BLOCK_HAT_SIZE a node of a line about its
 * hats, if there are any. inputs, settings, outcomes: as block_memory has them. Group g, or lane g of all
 * where searches stand abreast, works searches g * share up to count; turns[g]: how many iterations its lanes went
 * through. room: BLOCK_STATE_NUMBERS a search, with `slots` lines of probes (local size + 2; with hats or rounds
 * lines + 2). */
kernel void block_search(int lines, int length, int hats, int rounds, int slots,
                         int iteration_limit, int count, int share, global const scalar *stencils,
                         global const scalar *inputs, global const scalar *settings,
                         global scalar *outcomes, global scalar *ends, int ends_apart,
                         global int *turns, STATE real *room, local int *vote)
{
	const int group = QUEUE_NUMBER;
	block_state s;
	s.lines = lines;
	s.length = length;
	s.nodes = lines * length;
	s.hats = hats;
	s.rounds = rounds;
	s.slots = slots;
	s.analytic = BLOCK_ANALYTIC;
	s.across = stencils;
	s.along = stencils + lines * STENCIL_SIZE;
	s.hat_values = s.along + length * STENCIL_SIZE;
	s.arrays = OWN_STATE(
		room, BLOCK_STATE_NUMBERS((size_t)lines, (size_t)length, (size_t)hats, (size_t)slots));
	s.ring = s.arrays + BLOCK_STATE_COUNT * s.nodes;
	s.hat_rows = s.ring + BLOCK_PROBE_COUNT * (slots * length);
	s.vote = vote;
	s.sums = s.hat_rows + BLOCK_HAT_NUMBERS(lines, hats);
	block_memory m;
	m.inputs = inputs;
	m.settings = settings;
	m.outcomes = outcomes;
	m.ends = ends;
	m.ends_apart = ends_apart;
	m.lanes = s.sums + BLOCK_SUM_COUNT * lines;
	block_queue q;
	q.next = group * share;
	q.end = min(q.next + share, count);
	block_run(&s, &m, &q, iteration_limit);
	if (WORK_ITEM == 0)
		turns[group] = q.turns;
}
