/* How far a search has come, and what it has to tell in the end. */
#ifndef BATTEN_SHARED_SEARCH_PROGRESS_H
#define BATTEN_SHARED_SEARCH_PROGRESS_H

#include "dialect.h"
#include "search_layout.h"

/* What a lane has come to; the same in every work-item. */
typedef struct search_progress {
	real objective, step, iterations, moves, extra_high, extra_low;
	real wide,
		wide_pays; /* objective after the wide levels; 1 where they go on in the next iteration */
} search_progress;

SHARED_FUNCTION void search_count(search_progress *p, real probes)
{
	const real block = SPREAD(LITERAL(1048576.0));
	p->extra_low += probes;
	/* f32 counts whole numbers up to 2^24, which one iteration's probes on the largest grid allowed
	 * stay below: sixteen turns clear them. */
	ROLLED
	for (int turn = 0; turn < 16; turn++) {
		const mask full = p->extra_low >= block;
		p->extra_high += CHOOSE(full, SPREAD(LITERAL(1.0)), SPREAD(LITERAL(0.0)));
		p->extra_low = CHOOSE(full, p->extra_low - block, p->extra_low);
	}
}

/* Written by one work-item. */
SHARED_FUNCTION void search_tell(const search_progress *p, real start, GLOBAL stored *outcome)
{
	AT(outcome[SEARCH_OUTCOME_START]) = start;
	AT(outcome[SEARCH_OUTCOME_END]) = p->objective;
	AT(outcome[SEARCH_OUTCOME_STEP]) = p->step;
	AT(outcome[SEARCH_OUTCOME_ITERATIONS]) = p->iterations;
	AT(outcome[SEARCH_OUTCOME_MOVES]) = p->moves;
	AT(outcome[SEARCH_OUTCOME_EXTRA_HIGH]) = p->extra_high;
	AT(outcome[SEARCH_OUTCOME_EXTRA_LOW]) = p->extra_low;
}

#endif
