/* Block searches in lanes: a lane that has finished takes the next search of its group. Defined before this is
 * included, beside what block_search.h asks for:
 *   void block_arrive(const block_state *, int begun, mask fresh, real fair, real close)
 *                      what is to be known of searches that are fresh in their lanes; begun: there are any */
#ifndef BATTEN_SHARED_BLOCK_LANES_H
#define BATTEN_SHARED_BLOCK_LANES_H

#include "block_search.h"

/* The searches of a group: numbers first to end of all, lane by lane as they come free. */
typedef struct block_queue {
	int next, end;
	int current[BATTEN_LANES];
	int turns;
} block_queue;

typedef struct block_memory {
	GLOBAL const scalar *inputs; /* [search][BLOCK_INPUT_COUNT][nodes] */
	GLOBAL scalar *ends; /* [search][nodes], ends_apart one from the next; starts may be there */
	int ends_apart;
	GLOBAL const scalar *settings; /* [search][BLOCK_SETTING_COUNT] */
	GLOBAL scalar *outcomes;       /* [search][BLOCK_OUTCOME_COUNT] */
	STATE stored *lanes;           /* [BLOCK_OUTCOME_COUNT] */
} block_memory;

/* Writes what the lanes marked in `leaves` came to. */
SHARED_FUNCTION void block_store(const block_state *s, const block_memory *m, const block_queue *q,
                                 const int *leaves)
{
	const STATE scalar *y = (const STATE scalar *)block_array(s, BLOCK_INPUT_START);
	const STATE scalar *told = (const STATE scalar *)m->lanes;
	ROLLED
	for (int lane = 0; lane < BATTEN_LANES; lane++) {
		if (!leaves[lane])
			continue;
		GLOBAL scalar *to = m->ends + (size_t)q->current[lane] * (size_t)m->ends_apart;
		ROLLED
		for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
			to[n] = y[n * STORED_LANES + lane];
	}
	ROLLED
	for (int lane = WORK_ITEM; lane < BATTEN_LANES; lane += WORK_ITEMS)
		if (leaves[lane])
			for (int v = 0; v < BLOCK_OUTCOME_COUNT; v++)
				m->outcomes[(size_t)q->current[lane] * BLOCK_OUTCOME_COUNT + (size_t)v] =
					told[v * STORED_LANES + lane];
}

/* Puts searches into the lanes marked in `takes`. */
SHARED_FUNCTION void block_load(const block_state *s, const block_memory *m, const block_queue *q,
                                const int *takes)
{
	STATE scalar *to = (STATE scalar *)s->arrays;
	const int values = BLOCK_INPUT_COUNT * s->nodes;
	ROLLED
	for (int lane = 0; lane < BATTEN_LANES; lane++) {
		if (!takes[lane])
			continue;
		GLOBAL const scalar *from = m->inputs + (size_t)q->current[lane] * (size_t)values;
		ROLLED
		for (int n = WORK_ITEM; n < values; n += WORK_ITEMS)
			to[n * STORED_LANES + lane] = from[n];
	}
}

/* A setting of every lane's search. */
SHARED_FUNCTION void block_settings(const block_memory *m, const block_queue *q,
                                    block_limits *limits)
{
	STATE scalar *told = (STATE scalar *)m->lanes;
	WAIT;
	if (WORK_ITEM == 0) {
		ROLLED
		for (int lane = 0; lane < BATTEN_LANES; lane++)
			for (int v = 0; v < BLOCK_SETTING_COUNT; v++)
				told[v * STORED_LANES + lane] =
					q->current[lane] < 0
						? LITERAL(1.0)
						: m->settings[(size_t)q->current[lane] * BLOCK_SETTING_COUNT + (size_t)v];
	}
	WAIT;
	limits->longest = AT(m->lanes[BLOCK_SETTING_LONGEST]);
	limits->last_step = AT(m->lanes[BLOCK_SETTING_LAST_STEP]);
	limits->far = AT(m->lanes[BLOCK_SETTING_CURVATURE]);
	limits->fair = AT(m->lanes[BLOCK_SETTING_FAIR]);
	limits->close = AT(m->lanes[BLOCK_SETTING_CLOSE]);
	WAIT;
}

/* rounds: 1 where an iteration takes more than one, else 0. */
SHARED_FUNCTION void block_begin(block_progress *p, mask begins, mask works, real rounds)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	p->fresh = CHOOSE(begins, one, zero);
	p->working = CHOOSE(works, one, zero);
	p->step = CHOOSE(begins, zero, p->step);
	p->calm = CHOOSE(begins, zero, p->calm);
	p->converged = CHOOSE(begins, zero, p->converged);
	p->iterations = CHOOSE(begins, zero, p->iterations);
	p->moves = CHOOSE(begins, zero, p->moves);
	p->trials = CHOOSE(begins, zero, p->trials);
	p->fall = CHOOSE(begins, zero, p->fall);
	p->gained = CHOOSE(begins, zero, p->gained);
	p->damping = CHOOSE(begins, zero, p->damping);
	p->bold = CHOOSE(begins, rounds, p->bold);
	p->weight = CHOOSE(begins, zero, p->weight);
}

SHARED_FUNCTION void block_tell(const block_memory *m, const block_progress *p, mask finished)
{
	WAIT;
	if (WORK_ITEM == 0) {
		AT(m->lanes[BLOCK_OUTCOME_START]) = p->start;
		AT(m->lanes[BLOCK_OUTCOME_END]) = p->objective;
		AT(m->lanes[BLOCK_OUTCOME_STEP]) = p->step;
		AT(m->lanes[BLOCK_OUTCOME_CONVERGED]) = p->converged;
		AT(m->lanes[BLOCK_OUTCOME_ITERATIONS]) = p->iterations;
		AT(m->lanes[BLOCK_OUTCOME_MOVES]) = p->moves;
		AT(m->lanes[BLOCK_OUTCOME_TRIALS]) = p->trials;
		AT(m->lanes[BLOCK_OUTCOME_COUNT]) = CHOOSE(finished, SPREAD(LITERAL(1.0)),
		                                           SPREAD(LITERAL(0.0)));
	}
	WAIT;
}

/* Lets go what has finished and fills the lanes that are free. Returns whether any lane works. */
SHARED_FUNCTION int block_change_lanes(const block_state *s, const block_memory *m, block_queue *q,
                                       mask finished, block_limits *limits, block_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	int leaves[BATTEN_LANES], takes[BATTEN_LANES];
	int begun = 0;
	block_tell(m, p, finished);
	const STATE scalar *told = (const STATE scalar *)(m->lanes + BLOCK_OUTCOME_COUNT);
	ROLLED
	for (int lane = 0; lane < BATTEN_LANES; lane++)
		leaves[lane] = told[lane] > LITERAL(0.0) && q->current[lane] >= 0;
	block_store(s, m, q, leaves);
	ROLLED
	for (int lane = 0; lane < BATTEN_LANES; lane++) {
		if (leaves[lane])
			q->current[lane] = -1;
		takes[lane] = q->current[lane] < 0 && q->next < q->end;
		if (takes[lane])
			q->current[lane] = q->next++;
		begun |= takes[lane];
	}
	WAIT;
	if (begun)
		block_load(s, m, q, takes);
	if (WORK_ITEM == 0) {
		STATE scalar *lanes = (STATE scalar *)m->lanes;
		ROLLED
		for (int lane = 0; lane < BATTEN_LANES; lane++) {
			lanes[lane] = takes[lane] ? LITERAL(1.0) : LITERAL(0.0);
			lanes[STORED_LANES + lane] = q->current[lane] >= 0 ? LITERAL(1.0) : LITERAL(0.0);
		}
	}
	WAIT;
	block_begin(p, AT(m->lanes[0]) > zero, AT(m->lanes[1]) > zero,
	            SPREAD(BLOCK_ROUNDS(s) > 0 ? LITERAL(1.0) : LITERAL(0.0)));
	block_settings(m, q, limits);
	block_arrive(s, begun, p->fresh > zero, limits->fair, limits->close);
	return ANY_BESIDE(s, p->working > zero);
}

/* All searches of a group. */
SHARED_FUNCTION void block_run(const block_state *s, const block_memory *m, block_queue *q,
                               int iteration_limit)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real limit = SPREAD((scalar)iteration_limit);
	block_progress p;
	block_limits limits;
	ROLLED
	for (int n = WORK_ITEM; n < BLOCK_STATE_COUNT * s->nodes; n += WORK_ITEMS)
		AT(s->arrays[n]) = zero;
	ROLLED
	for (int lane = 0; lane < BATTEN_LANES; lane++)
		q->current[lane] = -1;
	q->turns = 0;
	p.working = p.fresh = p.objective = p.start = p.step = p.calm = p.converged = zero;
	p.iterations = p.moves = p.trials = p.fall = p.damping = p.promise = zero;
	p.tries = p.bold = p.gained = p.weight = p.stiffness = zero;
	p.old_1 = p.old_2 = p.older = zero;
	for (int pair = 0; pair < BLOCK_MEMORY; pair++)
		p.inverse[pair] = zero;
	mask finished = p.working == zero;
	ROLLED
	while (block_change_lanes(s, m, q, finished, &limits, &p)) {
		do {
			block_iterate(s, q->turns, limits, &p);
			q->turns++;
			finished = (p.converged > zero) | (p.iterations >= limit);
		} while (!ANY_BESIDE(s, finished & (p.working > zero)));
	}
}

#endif
