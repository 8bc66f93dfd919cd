/* The course of the block search (Hooke and Jeeves, thesis 7.2, with other moves): an exploratory move to
 * the bottom of the parabolas of all lines at once, bent by the moves remembered (limited-memory
 * quasi-Newton form: Nocedal and Wright 7.2), taken where the objective falls, shortened where it does
 * not. Lanes are searches.
 *
 * Defined before this is included (block_grid.h), beside what block_rows.h asks for:
 *   real block_explore(const block_state *, real far, real part, int turn, block_stay)
 *                      slopes and tables at y, from probes; returns the objective there. part: of the slopes
 *                      along the first derivatives that count. The products of block_rows.h go into the sums
 *   void block_solve(const block_state *, int turn, const real *alpha)
 *                      the bottom of the parabola, slopes less the changes remembered, alpha of each, into the
 *                      way; its products with the changes into the first BLOCK_MEMORY sums
 *   void block_follow(const block_state *)
 *                      gives the way to what goes with others
 *   BLOCK_ROUNDS(const block_state *), void block_go_rounds(const block_state *, real weight, real bold)
 *                      optional: how many rounds an iteration takes, and their way (block_rounds.h)
 *   real block_trial_objective(const block_state *)
 *                      the objective at the trial */
#ifndef BATTEN_SHARED_BLOCK_SEARCH_H
#define BATTEN_SHARED_BLOCK_SEARCH_H

#include "block_rows.h"
#include "multilevel.h"

#if !defined(BLOCK_ROUNDS)
#define BLOCK_ROUNDS(s) 0
SHARED_FUNCTION void block_go_rounds(const block_state *s, real weight, real bold)
{
	(void)s;
	(void)weight;
	(void)bold;
}
#endif

/* A search has ended when the objective fell by less than this part of it BLOCK_CALM times running; or by
 * less than BLOCK_FADING of these, and so much less than the time before that falls which go on so come to
 * less than BLOCK_FADED of one in all. */
#if BATTEN_DOUBLE
#define BLOCK_CALM_PART LITERAL(1e-8)
#else
#define BLOCK_CALM_PART LITERAL(1e-6)
#endif
#define BLOCK_CALM LITERAL(2.0)
#define BLOCK_FADING LITERAL(10.0)
#define BLOCK_FADED LITERAL(0.01)
/* Tables are damped by so much at least, or not at all. */
#define BLOCK_DAMPING_LEAST LITERAL(0.125)
#define BLOCK_DAMPING_MOST LITERAL(1e4)
/* What is left of the weight of staying after a way that was short enough, at most. */
#define BLOCK_STAY_FADES LITERAL(0.25)
enum { BLOCK_TRIALS = 8 }; /* whole objectives an iteration */
/* A pair whose slope changed by less than this part of what it was tells nothing of the curvature. */
#define BLOCK_PAIR_FLOOR LITERAL(0.01)

/* What a lane has come to; the same in every work-item. 1 and 0 stand for yes and no. */
typedef struct block_progress {
	real working, fresh; /* has a search; has just begun it */
	real objective, start, step, calm, converged;
	real gained; /* by the last iteration */
	real iterations, moves, trials;
	real stiffness;             /* of the way, by the tables: slope . way / way . way */
	real weight;                /* of staying, on the diagonals of the tables */
	real damping;               /* of the tables: what their diagonals are raised by, as a part */
	real tries;                 /* of the last iteration */
	real bold;                  /* takes more rounds than one */
	real promise;               /* of the whole way, by the slope, whatever the box stops of it */
	real fall;                  /* of the objective along the last move, by its slope; 0: no move */
	real inverse[BLOCK_MEMORY]; /* 1 / (move . change) of each pair, newest first; 0: not used */
	real old_1, old_2, older;   /* move . change of pairs: 1 with 0, 2 with 0, 2 with 1 */
} block_progress;

/* Which pairs of move and change tell of the curvature here; one made under other bounds does not, nor one
 * from the slopes of the first iteration. */
SHARED_FUNCTION void block_remember(const block_state *s, block_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real newest = block_total(s, BLOCK_MEMORY);
	const mask same = (block_total(s, 2 * BLOCK_MEMORY) == zero) & (p->iterations > one);
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
 * part, slope . way and way . way go into the sums. */
SHARED_FUNCTION void block_way_line(const block_state *s, int line, int turn, const real *beta)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *inverse = block_array(s, BLOCK_STATE_INVERSE);
	STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	const STATE stored *slope = block_array(s, BLOCK_STATE_SLOPE);
	real longest = zero, fall = zero, square = zero;
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		real bottom = AT(way[n]);
		for (int m = 0; m < BLOCK_MEMORY; m++) {
			const real move = AT(block_array(s, BLOCK_STATE_MOVE + block_slot(turn, m))[n]);
			bottom += CHOOSE(beta[m] != zero, beta[m] * move, zero);
		}
		bottom = CHOOSE(AT(inverse[n]) > zero, -bottom, zero);
		const real size = CHOOSE(bottom < zero, -bottom, bottom);
		longest = CHOOSE(size > longest, size, longest);
		AT(way[n]) = bottom;
		fall -= AT(slope[n]) * bottom;
		square += bottom * bottom;
	}
	AT(s->sums[line]) = longest;
	AT(s->sums[s->lines + line]) = fall;
	AT(s->sums[2 * s->lines + line]) = square;
}

/* The way of one round, bent by the moves remembered. */
SHARED_FUNCTION void block_bend_way(const block_state *s, int turn, block_progress *p)
{
	real alpha[BLOCK_MEMORY];
	block_remember(s, p);
	block_unroll(s, p, alpha);
	WAIT;
	block_solve(s, turn, alpha);
	WAIT;
	block_roll(s, p, alpha);
	WAIT;
	ROLLED
	for (int line = WORK_ITEM; line < s->lines; line += WORK_ITEMS)
		block_way_line(s, line, turn, alpha);
	WAIT;
	block_follow(s);
}

/* The way all lines go. Returns its longest part. */
SHARED_FUNCTION real block_choose_way(const block_state *s, int turn, block_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	if (BLOCK_ROUNDS(s) > 0)
		block_go_rounds(s, p->weight, CHOOSE(p->damping > zero, zero, p->bold));
	else
		block_bend_way(s, turn, p);
	const real longest = block_most(s, 0);
	const real fall = block_total(s, 1);
	const real square = block_total(s, 2);
	const mask goes = square > zero;
	p->stiffness = CHOOSE(goes, fall / CHOOSE(goes, square, SPREAD(LITERAL(1.0))), zero);
	p->promise = fall;
	WAIT;
	return longest;
}

/* y + part * way, kept in the box, into trial; what the slope promises of it and its longest part go
 * into the sums. */
SHARED_FUNCTION void block_trial_line(const block_state *s, int line, real part)
{
	const real zero = SPREAD(LITERAL(0.0));
	const STATE stored *y = block_array(s, BLOCK_INPUT_START);
	const STATE stored *way = block_array(s, BLOCK_STATE_WAY);
	const STATE stored *lower = block_array(s, BLOCK_INPUT_LOWER);
	const STATE stored *upper = block_array(s, BLOCK_INPUT_UPPER);
	const STATE stored *slope = block_array(s, BLOCK_STATE_SLOPE);
	STATE stored *trial = block_array(s, BLOCK_STATE_TRIAL);
	real promise = zero, longest = zero;
	ROLLED
	for (int n = line * s->length; n < (line + 1) * s->length; n++) {
		AT(trial[n]) = move_clamped(AT(y[n]), part * AT(way[n]), AT(lower[n]), AT(upper[n]));
		const real moved = AT(trial[n]) - AT(y[n]);
		const real size = CHOOSE(moved < zero, -moved, moved);
		promise += AT(slope[n]) * moved;
		longest = CHOOSE(size > longest, size, longest);
	}
	AT(s->sums[line]) = promise;
	AT(s->sums[s->lines + line]) = longest;
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
	trial.promise = block_total(s, 0);
	trial.longest = block_most(s, 1);
	trial.objective = block_trial_objective(s);
	WAIT;
	return trial;
}

/* Takes the trial where it is a gain. */
SHARED_FUNCTION void block_take(const block_state *s, int turn, mask gain)
{
	const real zero = SPREAD(LITERAL(0.0));
	STATE stored *y = block_array(s, BLOCK_INPUT_START);
	STATE stored *move = block_array(s, BLOCK_STATE_MOVE + block_slot(turn + 1, 0));
	const STATE stored *trial = block_array(s, BLOCK_STATE_TRIAL);
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		AT(move[n]) = CHOOSE(gain, AT(trial[n]) - AT(y[n]), zero);
		AT(y[n]) = CHOOSE(gain, AT(trial[n]), AT(y[n]));
	}
	WAIT;
}

/* What the gain of an iteration says of those to come. */
SHARED_FUNCTION void block_judge_gain(real found, mask gain, real longest, block_limits limits,
                                      block_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real gained = p->objective - found;
	const real small = SPREAD(BLOCK_CALM_PART) * p->objective;
	const mask little = gain & (gained <= small);
	const mask whole = gain & (p->tries == one) & (longest <= limits.longest) &
	                   (p->fall <= SPREAD(LITERAL(3.0)) * gained);
	const mask fades = whole & (gained <= SPREAD(BLOCK_FADING) * small) &
	                   (gained * gained <= (p->gained - gained) * (SPREAD(BLOCK_FADED) * small));
	p->calm = CHOOSE(little, p->calm + one, CHOOSE(gain, zero, p->calm));
	p->calm = CHOOSE(fades, SPREAD(BLOCK_CALM), p->calm);
	p->calm = CHOOSE(p->fresh > zero, zero, p->calm);
	p->gained = CHOOSE(gain & (p->fresh == zero), gained, zero);
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
		p->tries += CHOOSE(trying, one, zero);
		found = CHOOSE(good, trial.objective, found);
		gain = gain | good;
		/* A way that goes on promises no gain worth it, by its slope: rounding is all there is to be found. */
		const mask hopes = (part * shorter) * p->promise > least_gain;
		trying = trying & hopes & (trial.objective >= p->objective - least_gain) &
		         (trial.longest > middle * limits.last_step) & (p->fresh == zero);
		if (!ANY_BESIDE(s, trying))
			break;
		part = CHOOSE(trying, part * shorter, part);
	}
	block_judge_gain(found, gain, longest, limits, p);
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

/* A way longer than a step may be is not only cut: the next one is held back by a weight of staying, so
 * that the stiff part of the way, noise, is gone all the same while the soft part waits (Levenberg's
 * method, the weight after Hebden: More and Sorensen 1983). It goes when ways are short again. */
SHARED_FUNCTION void block_hold(block_progress *p, real longest, block_limits limits)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real too_long = longest / limits.longest - SPREAD(LITERAL(1.0));
	const real weight = p->weight + p->stiffness * too_long;
	const real least = CHOOSE(weight > zero, weight, zero);
	const real faded = SPREAD(BLOCK_STAY_FADES) * p->weight;
	p->weight = CHOOSE(too_long > zero, weight, CHOOSE(least < faded, least, faded));
}

/* One iteration of all lanes that have a search. The first leaves out the slopes along the first derivatives:
 * where y is rough they say, steeper is better, and lead away from the minimum for many iterations to come,
 * while the rest is a parabola whose bottom is nearly fair. It has one trial: where y is fair already there is
 * nothing in it, and it decides nothing. */
SHARED_FUNCTION void block_iterate(const block_state *s, int turn, block_limits limits,
                                   block_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const block_stay stay = { p->damping, p->weight };
	const mask fresh = p->fresh > zero;
	const real objective = block_explore(s, limits.far, CHOOSE(fresh, zero, one), turn, stay);
	p->start = CHOOSE(fresh, objective, p->start);
	p->objective = CHOOSE(fresh, objective, p->objective);
	const real longest = block_choose_way(s, turn, p);
	const mask gain = block_descend(s, turn, longest, limits, p);
	const mask bare = (p->inverse[0] == zero) & (p->inverse[1] == zero) & (p->inverse[2] == zero) &
	                  (p->bold == zero);
	const mask begun = (p->working > zero) & (p->fresh == zero);
	const mask still = begun & (p->fall == zero);
	/* Without a gain the memory is at fault, or rounds, if there are any, then offsets that the box stopped on their
	 * way while their neighbours went on: steps of damped tables part from them less. What the trial itself
	 * promises says nothing then: beside offsets a rounding off their bounds it may go uphill. */
	const mask done = (longest <= limits.last_step) | (p->damping > SPREAD(BLOCK_DAMPING_MOST)) |
	                  (p->promise <= SPREAD(BLOCK_CALM_PART) * p->objective);
	const mask over = (still & bare & done) | (gain & (p->step <= limits.last_step)) |
	                  (p->calm >= SPREAD(BLOCK_CALM));
	block_damp(p, still & bare, gain);
	block_hold(p, longest, limits);
	for (int m = 0; m < BLOCK_MEMORY; m++)
		p->inverse[m] = CHOOSE(still, zero, p->inverse[m]);
	if (BLOCK_ROUNDS(s) > 0)
		p->bold = CHOOSE(still, zero, one);
	p->converged = CHOOSE(over & begun, one, p->converged);
	p->moves += CHOOSE(gain, one, zero);
	p->iterations += p->working;
	p->fresh = zero;
}

#endif
