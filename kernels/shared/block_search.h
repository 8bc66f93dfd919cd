/* The course of the block search (Hooke and Jeeves, thesis 7.2, with other moves): an exploratory move to
 * the bottom of the parabolas of all lines at once, bent by the moves remembered (limited-memory
 * quasi-Newton form: Nocedal and Wright 7.2), taken where the objective falls, shortened where it does
 * not. Lanes are searches; a lane that has finished takes the next one of its group. */
#ifndef BATTEN_SHARED_BLOCK_SEARCH_H
#define BATTEN_SHARED_BLOCK_SEARCH_H

#include "block_lines.h"
#include "multilevel.h"

/* A search has ended when the objective fell by less than this part of it BLOCK_CALM times running. */
#if BATTEN_DOUBLE
#define BLOCK_CALM_PART LITERAL(1e-8)
#else
#define BLOCK_CALM_PART LITERAL(1e-6)
#endif
#define BLOCK_CALM LITERAL(2.0)
/* Tables are damped by so much at least, or not at all. */
#define BLOCK_DAMPING_LEAST LITERAL(0.125)
#define BLOCK_DAMPING_MOST LITERAL(1e4)
enum { BLOCK_TRIALS = 8 }; /* whole objectives an iteration */
/* A pair whose slope changed by less than this part of what it was tells nothing of the curvature. */
#define BLOCK_PAIR_FLOOR LITERAL(0.01)

/* What a lane has come to; the same in every work-item. 1 and 0 stand for yes and no. */
typedef struct block_progress {
	real working, fresh; /* has a search; has just begun it */
	real objective, start, step, calm, converged;
	real iterations, moves, trials;
	real damping;               /* of the tables: what their diagonals are raised by, as a part */
	real tries;                 /* of the last iteration */
	real promise;               /* of the first trial, by the slope */
	real fall;                  /* of the objective along the last move, by its slope; 0: no move */
	real inverse[BLOCK_MEMORY]; /* 1 / (move . change) of each pair, newest first; 0: not used */
	real old_1, old_2, older;   /* move . change of pairs: 1 with 0, 2 with 0, 2 with 1 */
} block_progress;

/* Values of one search a lane: of settings. */
typedef struct block_limits {
	real longest, last_step, far, iterations;
} block_limits;

SHARED_FUNCTION real block_total(const block_state *s, int sum)
{
	real total = SPREAD(LITERAL(0.0));
	ROLLED
	for (int line = 0; line < s->lines; line++)
		total += s->sums[sum * s->lines + line];
	return total;
}

SHARED_FUNCTION real block_most(const block_state *s, int sum)
{
	real most = SPREAD(LITERAL(0.0));
	ROLLED
	for (int line = 0; line < s->lines; line++) {
		const real value = s->sums[sum * s->lines + line];
		most = CHOOSE(value > most, value, most);
	}
	return most;
}

/* Probes and tables of all lines, WORK_ITEMS at a time: a line is gathered when those beside it are
 * probed. */
SHARED_FUNCTION void block_explore(const block_state *s, real far, int turn, real damping)
{
	const int at_once = s->slots - 2;
	ROLLED
	for (int first = 0; first <= s->lines; first += at_once) {
		ROLLED
		for (int line = first + WORK_ITEM; line < first + at_once && line < s->lines;
		     line += WORK_ITEMS)
			s->sums[(BLOCK_SUM_COUNT - 1) * s->lines + line] = block_probe_line(s, line, far);
		WAIT;
		ROLLED
		for (int line = first - 1 + WORK_ITEM; line < first + at_once - 1; line += WORK_ITEMS)
			if (line >= 0 && line < s->lines)
				block_gather_line(s, line, turn, damping);
		WAIT;
	}
}

/* Which pairs of move and change tell of the curvature here; one made under other bounds does not. */
SHARED_FUNCTION void block_remember(const block_state *s, block_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real newest = block_total(s, BLOCK_MEMORY);
	const mask same = (block_total(s, 2 * BLOCK_MEMORY) == zero) & (p->fresh == zero);
	const mask tells = same & (p->fall > zero) & (newest > SPREAD(BLOCK_PAIR_FLOOR) * p->fall);
	p->inverse[2] = CHOOSE(same, p->inverse[1], zero);
	p->inverse[1] = CHOOSE(same, p->inverse[0], zero);
	p->inverse[0] = CHOOSE(tells, one / CHOOSE(tells, newest, one), zero);
	p->older = p->old_1;
	p->old_1 = block_total(s, BLOCK_MEMORY + 1);
	p->old_2 = block_total(s, BLOCK_MEMORY + 2);
}

/* alpha of each pair: how much of its change the slope has. */
SHARED_FUNCTION void block_unroll(const block_state *s, const block_progress *p, real *alpha)
{
	const real zero = SPREAD(LITERAL(0.0));
	alpha[0] = CHOOSE(p->inverse[0] > zero, p->inverse[0] * block_total(s, 0), zero);
	real left = block_total(s, 1) - CHOOSE(alpha[0] != zero, alpha[0] * p->old_1, zero);
	alpha[1] = CHOOSE(p->inverse[1] > zero, p->inverse[1] * left, zero);
	left = block_total(s, 2) - CHOOSE(alpha[0] != zero, alpha[0] * p->old_2, zero);
	left -= CHOOSE(alpha[1] != zero, alpha[1] * p->older, zero);
	alpha[2] = CHOOSE(p->inverse[2] > zero, p->inverse[2] * left, zero);
}

/* From alpha and the products of the changes with the way, how much of each move is added to it. */
SHARED_FUNCTION void block_roll(const block_state *s, const block_progress *p, real *alpha)
{
	const real zero = SPREAD(LITERAL(0.0));
	real has = block_total(s, 2);
	alpha[2] -= CHOOSE(p->inverse[2] > zero, p->inverse[2] * has, zero);
	has = block_total(s, 1) + CHOOSE(alpha[2] != zero, alpha[2] * p->older, zero);
	alpha[1] -= CHOOSE(p->inverse[1] > zero, p->inverse[1] * has, zero);
	has = block_total(s, 0) + CHOOSE(alpha[2] != zero, alpha[2] * p->old_2, zero);
	has += CHOOSE(alpha[1] != zero, alpha[1] * p->old_1, zero);
	alpha[0] -= CHOOSE(p->inverse[0] > zero, p->inverse[0] * has, zero);
}

/* The whole way of a line: against the bottom of its parabola, and the moves remembered. Its longest
 * part goes into the sums. */
SHARED_FUNCTION void block_way_line(const block_state *s, int line, int turn, const real *beta)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE real *inverse = block_array(s, BLOCK_STATE_INVERSE);
	STATE real *way = block_array(s, BLOCK_STATE_WAY);
	real longest = zero;
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		real bottom = way[n];
		for (int m = 0; m < BLOCK_MEMORY; m++) {
			const real move = block_array(s, BLOCK_STATE_MOVE + block_slot(turn, m))[n];
			bottom += CHOOSE(beta[m] != zero, beta[m] * move, zero);
		}
		bottom = CHOOSE(inverse[n] > zero, -bottom, zero);
		const real size = CHOOSE(bottom < zero, -bottom, bottom);
		longest = CHOOSE(size > longest, size, longest);
		way[n] = bottom;
	}
	s->sums[line] = longest;
}

/* The way all lines go. Returns its longest part. */
SHARED_FUNCTION real block_choose_way(const block_state *s, int turn, block_progress *p)
{
	real alpha[BLOCK_MEMORY];
	block_remember(s, p);
	block_unroll(s, p, alpha);
	WAIT;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_solve_line(s, line, turn, alpha);
	WAIT;
	block_roll(s, p, alpha);
	WAIT;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_way_line(s, line, turn, alpha);
	WAIT;
	const real longest = block_most(s, 0);
	WAIT;
	return longest;
}

/* y + part * way, kept in the box, into trial; what the slope promises of it and its longest part go
 * into the sums. */
SHARED_FUNCTION void block_trial_line(const block_state *s, int line, real part)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE real *y = block_array(s, BLOCK_INPUT_START);
	const STATE real *way = block_array(s, BLOCK_STATE_WAY);
	const STATE real *lower = block_array(s, BLOCK_INPUT_LOWER);
	const STATE real *upper = block_array(s, BLOCK_INPUT_UPPER);
	const STATE real *slope = block_array(s, BLOCK_STATE_SLOPE);
	STATE real *trial = block_array(s, BLOCK_STATE_TRIAL);
	real promise = zero, longest = zero;
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		trial[n] = move_clamped(y[n], part * way[n], lower[n], upper[n]);
		const real moved = trial[n] - y[n];
		const real size = CHOOSE(moved < zero, -moved, moved);
		promise += slope[n] * moved;
		longest = CHOOSE(size > longest, size, longest);
	}
	s->sums[line] = promise;
	s->sums[s->lines + line] = longest;
}

typedef struct block_trial {
	real objective, promise, longest;
} block_trial;

SHARED_FUNCTION block_trial block_try(const block_state *s, real part)
{
	block_trial trial;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_trial_line(s, line, part);
	WAIT;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		s->sums[2 * s->lines + line] = block_line_objective(s, block_array(s, BLOCK_STATE_TRIAL),
		                                                    line);
	WAIT;
	trial.promise = block_total(s, 0);
	trial.longest = block_most(s, 1);
	trial.objective = block_total(s, 2);
	WAIT;
	return trial;
}

/* Takes the trial where it is a gain. */
SHARED_FUNCTION void block_take(const block_state *s, int turn, mask gain)
{
	const real zero = SPREAD(LITERAL(0.0));
	STATE real *y = block_array(s, BLOCK_INPUT_START);
	STATE real *move = block_array(s, BLOCK_STATE_MOVE + block_slot(turn + 1, 0));
	const STATE real *trial = block_array(s, BLOCK_STATE_TRIAL);
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		move[n] = CHOOSE(gain, trial[n] - y[n], zero);
		y[n] = CHOOSE(gain, trial[n], y[n]);
	}
	WAIT;
}

/* Goes along the way as far as the objective falls; the parabola through the objective here, its slope
 * and the trial says how far next. Returns where a lane gained. */
SHARED_FUNCTION mask block_descend(const block_state *s, int turn, real longest,
                                   block_limits limits, block_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real middle = SPREAD(LITERAL(0.5));
	const real least_gain = SPREAD(GAIN_FLOOR) * p->objective;
	real part = CHOOSE(longest > limits.longest, limits.longest / longest, one);
	real found = p->objective;
	p->fall = zero;
	p->tries = zero;
	mask gain = p->working < zero;
	mask trying = p->working > zero;
	ROLLED
	for (int turns = 0; turns < BLOCK_TRIALS; turns++) {
		const block_trial trial = block_try(s, part);
		const mask good = trying & (trial.objective < p->objective - least_gain);
		const real rise = (trial.objective - p->objective) - trial.promise;
		const real least = SPREAD(LITERAL(0.1));
		const mask bends = (trial.promise < zero) & (rise > zero);
		const real bottom = CHOOSE(bends, -(middle * trial.promise) / CHOOSE(bends, rise, one),
		                           middle);
		const real shorter = CHOOSE(bottom > middle, middle, CHOOSE(bottom < least, least, bottom));
		p->step = CHOOSE(trying, trial.longest, p->step);
		p->fall = CHOOSE(good, -trial.promise, p->fall);
		if (turns == 0)
			p->promise = trial.promise;
		p->tries += CHOOSE(trying, one, zero);
		found = CHOOSE(good, trial.objective, found);
		gain = gain | good;
		trying = trying & (trial.objective >= p->objective - least_gain) &
		         (trial.longest > middle * limits.last_step);
		if (!ANY(trying))
			break;
		part = CHOOSE(trying, part * shorter, part);
	}
	const mask little = gain & (p->objective - found <= SPREAD(BLOCK_CALM_PART) * p->objective);
	p->calm = CHOOSE(little, p->calm + one, CHOOSE(gain, zero, p->calm));
	p->objective = found;
	p->trials += p->tries;
	block_take(s, turn, gain);
	return gain;
}

/* Damps the tables of lanes that did not gain, or hardly, more and those of others less. */
SHARED_FUNCTION void block_damp(block_progress *p, mask failed, mask gain)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real least = SPREAD(BLOCK_DAMPING_LEAST);
	const mask hardly = failed | (gain & (p->tries > SPREAD(LITERAL(3.0))));
	const real more = p->damping * SPREAD(LITERAL(8.0));
	const real less = p->damping * SPREAD(LITERAL(0.25));
	const mask soon = gain & (p->tries <= SPREAD(LITERAL(2.0)));
	const real calmer = CHOOSE(less < least, zero, less);
	p->damping = CHOOSE(hardly, CHOOSE(more > least, more, least),
	                    CHOOSE(soon, calmer, p->damping));
}

/* One iteration of all lanes that have a search. */
SHARED_FUNCTION void block_iterate(const block_state *s, int turn, block_limits limits,
                                   block_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	block_explore(s, limits.far, turn, p->damping);
	const mask fresh = p->fresh > zero;
	const real objective = block_total(s, BLOCK_SUM_COUNT - 1);
	p->start = CHOOSE(fresh, objective, p->start);
	p->objective = CHOOSE(fresh, objective, p->objective);
	const real longest = block_choose_way(s, turn, p);
	const mask gain = block_descend(s, turn, longest, limits, p);
	const mask bare = (p->inverse[0] == zero) & (p->inverse[1] == zero) & (p->inverse[2] == zero);
	const mask still = (p->working > zero) & (p->fall == zero);
	/* Without a gain the memory is at fault, if there is one, then offsets that the box stopped on their
	 * way while their neighbours went on: steps of damped tables part from them less. */
	const mask done = (longest <= limits.last_step) | (p->damping > SPREAD(BLOCK_DAMPING_MOST)) |
	                  (-p->promise <= SPREAD(BLOCK_CALM_PART) * p->objective);
	const mask over = (still & bare & done) | (gain & (p->step <= limits.last_step)) |
	                  (p->calm >= SPREAD(BLOCK_CALM));
	block_damp(p, still & bare, gain);
	for (int m = 0; m < BLOCK_MEMORY; m++)
		p->inverse[m] = CHOOSE(still, zero, p->inverse[m]);
	p->converged = CHOOSE(over & (p->working > zero), one, p->converged);
	p->moves += CHOOSE(gain, one, zero);
	p->iterations += p->working;
	p->fresh = zero;
}

/* ---- lanes ---- */

/* The searches of a group: numbers first to end of all, lane by lane as they come free. */
typedef struct block_queue {
	int next, end;
	int current[BATTEN_LANES];
	int turns;
} block_queue;

typedef struct block_memory {
	GLOBAL const scalar *inputs, *settings; /* [search][BLOCK_INPUT_COUNT][nodes], ... */
	GLOBAL scalar *y, *outcomes;            /* [search][nodes], [search][BLOCK_OUTCOME_COUNT] */
	LOCAL real *lanes;                      /* [BLOCK_OUTCOME_COUNT] */
} block_memory;

/* Writes what the lanes marked in `leaves` came to. */
SHARED_FUNCTION void block_store(const block_state *s, const block_memory *m, const block_queue *q,
                                 const int *leaves)
{
	const STATE scalar *y = (const STATE scalar *)block_array(s, BLOCK_INPUT_START);
	const LOCAL scalar *told = (const LOCAL scalar *)m->lanes;
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		ROLLED
		for (int lane = 0; lane < BATTEN_LANES; lane++)
			if (leaves[lane])
				m->y[(size_t)q->current[lane] * (size_t)s->nodes + (size_t)n] =
					y[(size_t)n * BATTEN_LANES + (size_t)lane];
	}
	ROLLED
	for (int lane = 0; lane < BATTEN_LANES; lane++)
		if (leaves[lane] && WORK_ITEM == 0)
			for (int v = 0; v < BLOCK_OUTCOME_COUNT; v++)
				m->outcomes[(size_t)q->current[lane] * BLOCK_OUTCOME_COUNT + (size_t)v] =
					told[v * BATTEN_LANES + lane];
}

/* Puts searches into the lanes marked in `takes`. */
SHARED_FUNCTION void block_load(const block_state *s, const block_memory *m, const block_queue *q,
                                const int *takes)
{
	STATE scalar *to = (STATE scalar *)s->arrays;
	const int values = BLOCK_INPUT_COUNT * s->nodes;
	ROLLED
	for (int n = WORK_ITEM; n < values; n += WORK_ITEMS) {
		ROLLED
		for (int lane = 0; lane < BATTEN_LANES; lane++)
			if (takes[lane])
				to[(size_t)n * BATTEN_LANES + (size_t)lane] =
					m->inputs[(size_t)q->current[lane] * (size_t)values + (size_t)n];
	}
}

/* A setting of every lane's search. */
SHARED_FUNCTION void block_settings(const block_memory *m, const block_queue *q,
                                    block_limits *limits)
{
	LOCAL scalar *told = (LOCAL scalar *)m->lanes;
	WAIT;
	if (WORK_ITEM == 0) {
		ROLLED
		for (int lane = 0; lane < BATTEN_LANES; lane++)
			for (int v = 0; v < BLOCK_SETTING_COUNT; v++)
				told[v * BATTEN_LANES + lane] =
					q->current[lane] < 0
						? LITERAL(1.0)
						: m->settings[(size_t)q->current[lane] * BLOCK_SETTING_COUNT + (size_t)v];
	}
	WAIT;
	limits->longest = m->lanes[BLOCK_SETTING_LONGEST];
	limits->last_step = m->lanes[BLOCK_SETTING_LAST_STEP];
	limits->far = m->lanes[BLOCK_SETTING_CURVATURE];
	WAIT;
}

SHARED_FUNCTION void block_begin(block_progress *p, mask begins, mask works)
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
	p->damping = CHOOSE(begins, zero, p->damping);
}

SHARED_FUNCTION void block_tell(const block_memory *m, const block_progress *p, mask finished)
{
	WAIT;
	if (WORK_ITEM == 0) {
		m->lanes[BLOCK_OUTCOME_START] = p->start;
		m->lanes[BLOCK_OUTCOME_END] = p->objective;
		m->lanes[BLOCK_OUTCOME_STEP] = p->step;
		m->lanes[BLOCK_OUTCOME_CONVERGED] = p->converged;
		m->lanes[BLOCK_OUTCOME_ITERATIONS] = p->iterations;
		m->lanes[BLOCK_OUTCOME_MOVES] = p->moves;
		m->lanes[BLOCK_OUTCOME_TRIALS] = p->trials;
		m->lanes[BLOCK_OUTCOME_COUNT] = CHOOSE(finished, SPREAD(LITERAL(1.0)),
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
	int any = 0, begun = 0;
	block_tell(m, p, finished);
	const LOCAL scalar *told = (const LOCAL scalar *)(m->lanes + BLOCK_OUTCOME_COUNT);
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
		any |= q->current[lane] >= 0;
		begun |= takes[lane];
	}
	WAIT;
	if (begun)
		block_load(s, m, q, takes);
	if (WORK_ITEM == 0) {
		LOCAL scalar *lanes = (LOCAL scalar *)m->lanes;
		ROLLED
		for (int lane = 0; lane < BATTEN_LANES; lane++) {
			lanes[lane] = takes[lane] ? LITERAL(1.0) : LITERAL(0.0);
			lanes[BATTEN_LANES + lane] = q->current[lane] >= 0 ? LITERAL(1.0) : LITERAL(0.0);
		}
	}
	WAIT;
	block_begin(p, m->lanes[0] > zero, m->lanes[1] > zero);
	block_settings(m, q, limits);
	return any;
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
		s->arrays[n] = zero;
	ROLLED
	for (int lane = 0; lane < BATTEN_LANES; lane++)
		q->current[lane] = -1;
	q->turns = 0;
	p.working = p.fresh = p.objective = p.start = p.step = p.calm = p.converged = zero;
	p.iterations = p.moves = p.trials = p.fall = p.damping = p.promise = zero;
	p.tries = zero;
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
		} while (!ANY(finished & (p.working > zero)));
	}
}

#endif
