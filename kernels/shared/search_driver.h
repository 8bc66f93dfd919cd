/* The course of a multilevel pattern search (Hooke and Jeeves; thesis 7.2): exploratory moves along
 * every direction, pattern moves, steps that halve. The objective is the includer's. Several searches
 * run side by side, one a lane; in OpenCL the work-items of a group share the directions of a colour.
 *
 * Defined before this is included:
 *   search_state       nodes; y, base, trial, ways (SEARCH_WAYS - 1 nets): STATE real *; lower,
 *                      upper: GLOBAL const real *;
 *                      colour_count; whatever the objective needs
 *   search_move        step: real; whatever tells one direction from another
 *   void move_begin(const search_state *, int colour, int direction, search_move *)
 *   real move_objective(const search_state *, const search_move *)
 *                      the terms the direction can change, after move->step along it
 *   void move_end(const search_state *, const search_move *)
 *                      y after move->step for good; 0 leaves y as it was
 *   void colour_range(const search_state *, int colour, int *first, int *end)
 *                      directions of a colour, colours in the order they are worked
 *   real whole_objective(const search_state *)
 *                      at trial, the same in every work-item */
#ifndef BATTEN_SHARED_SEARCH_DRIVER_H
#define BATTEN_SHARED_SEARCH_DRIVER_H

#include "dialect.h"
#include "multilevel.h"
#include "search_layout.h"

/* A pattern move: its objective at y, two probes a way and one for every two, the bottom of the
 * parabola, and on from there. */
#define SEARCH_MODEL_PROBES (1 + 2 * SEARCH_WAYS + SEARCH_WAYS * (SEARCH_WAYS - 1) / 2)
#define SEARCH_PROBE_LIMIT (SEARCH_MODEL_PROBES + PATTERN_LIMIT)

/* A way whose own part of the bend is less than this is what others say already. */
#if BATTEN_DOUBLE
#define SEARCH_PIVOT LITERAL(1e-8)
#else
#define SEARCH_PIVOT LITERAL(1e-3)
#endif

/* What a lane has come to; the same in every work-item. */
typedef struct search_progress {
	real objective, step, iterations, moves, extra_high, extra_low;
} search_progress;

/* Exploratory move along one direction: +h, -h and the bottom of the parabola through them; the best
 * is taken where it is a gain. One call of the objective in a loop: PoCL compiles each call anew.
 * Returns the length of the step taken. */
SHARED_FUNCTION real search_explore(const search_state *s, search_move *move, real h, real *extra)
{
	const real zero = SPREAD(LITERAL(0.0));
	real before = zero;
	real plus = zero;
	real change = zero;
	real step = zero;
	move->step = zero;
	ROLLED
	for (int turn = 0; turn < 4; turn++) {
		const real sum = move_objective(s, move);
		const real found = sum - before;
		if (turn == 0) {
			before = sum;
			move->step = h;
		} else if (turn == 1) {
			plus = found;
			change = found;
			step = h;
			move->step = -h;
		} else if (turn == 2) {
			const mask better = found < change;
			change = CHOOSE(better, found, change);
			step = CHOOSE(better, -h, step);
			move->step = parabola_step(h, plus, found);
			const mask tried = move->step != zero;
			*extra += CHOOSE(tried, SPREAD(LITERAL(1.0)), zero);
			if (!ANY(tried))
				break;
		} else {
			const mask better = (move->step != zero) & (found < change);
			change = CHOOSE(better, found, change);
			step = CHOOSE(better, move->step, step);
		}
	}
	const mask gain = change < -(SPREAD(GAIN_FLOOR) * before);
	move->step = CHOOSE(gain, step, zero);
	move_end(s, move);
	return CHOOSE(move->step < zero, -move->step, move->step);
}

/* All directions, coarse to fine. Returns the longest step this work-item took. */
SHARED_FUNCTION real search_sweep(const search_state *s, real h, real *extra)
{
	real longest = SPREAD(LITERAL(0.0));
	ROLLED
	for (int colour = 0; colour < s->colour_count; colour++) {
		int first = 0;
		int end = 0;
		colour_range(s, colour, &first, &end);
		ROLLED
		for (int d = first + WORK_ITEM; d < end; d += WORK_ITEMS) {
			search_move move;
			move_begin(s, colour, d, &move);
			const real length = search_explore(s, &move, h, extra);
			longest = CHOOSE(length > longest, length, longest);
		}
		WAIT;
	}
	return longest;
}

/* y and on along this iteration's way, y - base, and the remembered ones, kept in the box, into
 * trial. */
SHARED_FUNCTION void search_extrapolate(const search_state *s, const real *factors)
{
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		real step = factors[0] * (s->y[n] - s->base[n]);
		ROLLED
		for (int w = 1; w < SEARCH_WAYS; w++)
			step += factors[w] * s->ways[(w - 1) * s->nodes + n];
		s->trial[n] = move_clamped(s->y[n], step, s->lower[n], s->upper[n]);
	}
	WAIT;
}

/* The longest step and the number of probes of all work-items: a maximum and a sum of whole numbers,
 * so their order does not matter. gathered has two values a work-item. */
SHARED_FUNCTION void search_gather(LOCAL real *gathered, real *longest, real *extra)
{
	gathered[WORK_ITEM] = *longest;
	gathered[WORK_ITEMS + WORK_ITEM] = *extra;
	WAIT;
	*extra = SPREAD(LITERAL(0.0));
	ROLLED
	for (int w = 0; w < WORK_ITEMS; w++) {
		*longest = CHOOSE(gathered[w] > *longest, gathered[w], *longest);
		*extra += gathered[WORK_ITEMS + w];
	}
	WAIT;
}

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

/* A parabola through the objective over this iteration's way and the remembered ones. */
typedef struct search_model {
	real plus[SEARCH_WAYS], slope[SEARCH_WAYS];
	real bend[SEARCH_WAYS][SEARCH_WAYS]; /* lower triangle */
} search_model;

/* The ways that probe number `probe` goes: each forth and back, then every two together. */
SHARED_FUNCTION void search_probe_ways(int probe, int *i, int *j)
{
	int pair = probe - 1 - 2 * SEARCH_WAYS;
	*i = *j = (probe - 1) / 2;
	if (pair < 0)
		return;
	*i = 1;
	ROLLED
	for (; pair >= *i; (*i)++)
		pair -= *i;
	*j = pair;
}

/* Takes what probe number `probe` found into the model. */
SHARED_FUNCTION void search_model_add(search_model *model, int probe, real change)
{
	int i = 0;
	int j = 0;
	search_probe_ways(probe, &i, &j);
	if (i != j) {
		model->bend[i][j] = (change - model->plus[i]) - model->plus[j];
	} else if (probe % 2 == 1) {
		model->plus[i] = change;
	} else {
		model->slope[i] = SPREAD(LITERAL(0.5)) * (model->plus[i] - change);
		model->bend[i][i] = model->plus[i] + change;
	}
}

/* The bottom of the model, by L D L^T. A way along which it has none, or that the ones before say
 * already, is left out. */
SHARED_FUNCTION void search_model_solve(search_model *model, real *factors)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real most = SPREAD(LITERAL(64.0));
	real inverse[SEARCH_WAYS];
	ROLLED
	for (int i = 0; i < SEARCH_WAYS; i++) {
		real right = -model->slope[i];
		real pivot = model->bend[i][i];
		/* Row i: bend[i][k] becomes L times D. */
		ROLLED
		for (int k = 0; k < i; k++) {
			ROLLED
			for (int l = 0; l < k; l++)
				model->bend[i][k] -= (model->bend[i][l] * inverse[l]) * model->bend[k][l];
			const real part = model->bend[i][k] * inverse[k];
			pivot -= part * model->bend[i][k];
			right -= part * factors[k];
		}
		const mask sound = pivot > SPREAD(SEARCH_PIVOT) * model->bend[i][i];
		inverse[i] = CHOOSE(sound, one / CHOOSE(sound, pivot, one), zero);
		factors[i] = right;
	}
	ROLLED
	for (int i = SEARCH_WAYS - 1; i >= 0; i--) {
		real right = factors[i];
		ROLLED
		for (int j = i + 1; j < SEARCH_WAYS; j++)
			right -= model->bend[j][i] * factors[j];
		const real bottom = right * inverse[i];
		factors[i] = CHOOSE(bottom > most, most, CHOOSE(bottom < -most, -most, bottom));
	}
}

/* Where the next probe goes. */
SHARED_FUNCTION void search_probe_place(search_model *model, int probe, const real *best,
                                        real *factors)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	int i = 0;
	int j = 0;
	if (probe == SEARCH_MODEL_PROBES)
		search_model_solve(model, factors);
	if (probe == 0 || probe == SEARCH_MODEL_PROBES)
		return;
	search_probe_ways(probe, &i, &j);
	const real sign = i == j && probe % 2 == 0 ? -one : one;
	ROLLED
	for (int w = 0; w < SEARCH_WAYS; w++)
		if (probe < SEARCH_MODEL_PROBES)
			factors[w] = w == i || w == j ? sign : zero;
		else
			factors[w] = SPREAD(LITERAL(2.0)) * best[w];
}

/* The objective at y, then the pattern move: probes along this iteration's way and the remembered
 * ones, the bottom of the parabola through them, and on from the best of all, doubling while the
 * objective falls. Lanes that are not `going` keep everything. */
SHARED_FUNCTION void search_pattern(const search_state *s, mask going, int probe_limit, int slot,
                                    search_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const mask moved = going;
	search_model model;
	real factors[SEARCH_WAYS];
	real best[SEARCH_WAYS];
	real origin = zero;
	real probes = zero;
	ROLLED
	for (int w = 0; w < SEARCH_WAYS; w++)
		factors[w] = best[w] = zero;
	ROLLED
	for (int probe = 0; probe <= probe_limit; probe++) {
		search_probe_place(&model, probe, best, factors);
		search_extrapolate(s, factors);
		const real found = whole_objective(s);
		if (probe == 0) {
			origin = found;
			p->objective = CHOOSE(going, found, p->objective);
			continue;
		}
		probes += CHOOSE(going, SPREAD(LITERAL(1.0)), zero);
		if (probe < SEARCH_MODEL_PROBES)
			search_model_add(&model, probe, found - origin);
		const mask gain = going & (found < p->objective - SPREAD(GAIN_FLOOR) * p->objective);
		p->objective = CHOOSE(gain, found, p->objective);
		ROLLED
		for (int w = 0; w < SEARCH_WAYS; w++)
			best[w] = CHOOSE(gain, factors[w], best[w]);
		if (probe <= SEARCH_MODEL_PROBES)
			continue;
		going = gain;
		if (!ANY(going))
			break;
	}
	search_count(p, probes);
	search_extrapolate(s, best);
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		STATE real *way = s->ways + slot * s->nodes + n;
		s->y[n] = s->trial[n];
		*way = CHOOSE(moved, s->y[n] - s->base[n], *way);
	}
	WAIT;
}

/* One iteration of the lanes that are active. Turn 0 only evaluates the start. */
SHARED_FUNCTION void search_iterate(const search_state *s, int turn, mask active, mask unlimited,
                                    LOCAL real *gathered, search_progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	real longest = zero;
	mask going = unlimited;
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		s->base[n] = s->y[n];
	WAIT;
	if (turn > 0) {
		real extra = zero;
		longest = search_sweep(s, CHOOSE(active, p->step, zero), &extra);
		search_gather(gathered, &longest, &extra);
		search_count(p, extra);
		going = active & (longest > zero);
		p->moves += CHOOSE(going, one, zero);
	}
	if (ANY(going))
		search_pattern(s, going, turn > 0 ? SEARCH_PROBE_LIMIT : 0, turn % (SEARCH_WAYS - 1), p);
	if (turn == 0)
		return;
	p->step = CHOOSE(active & (longest < p->step), p->step * SPREAD(LITERAL(0.5)), p->step);
	p->iterations += CHOOSE(active, one, zero);
}

/* A whole search: y from and back to `values` (s->nodes of real), settings and outcome as in
 * search_layout.h. */
SHARED_FUNCTION void search_run(const search_state *s, int iteration_limit,
                                GLOBAL const real *settings, GLOBAL real *values,
                                GLOBAL real *outcome, LOCAL real *gathered)
{
	const real zero = SPREAD(LITERAL(0.0));
	const real limit = SPREAD((scalar)iteration_limit);
	const real last_step = settings[SEARCH_SETTING_LAST_STEP];
	search_progress p = { zero, settings[SEARCH_SETTING_FIRST_STEP], zero, zero, zero, zero };
	real start = zero;
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		s->y[n] = values[n];
	ROLLED
	for (int n = WORK_ITEM; n < (SEARCH_WAYS - 1) * s->nodes; n += WORK_ITEMS)
		s->ways[n] = zero;
	WAIT;
	ROLLED
	for (int turn = 0;; turn++) {
		const mask unlimited = p.iterations < limit;
		const mask active = (p.step > last_step) & unlimited;
		if (turn > 0 && !ANY(active))
			break;
		search_iterate(s, turn, active, unlimited, gathered, &p);
		if (turn == 0)
			start = p.objective;
	}
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		values[n] = s->y[n];
	if (WORK_ITEM != 0)
		return;
	outcome[SEARCH_OUTCOME_START] = start;
	outcome[SEARCH_OUTCOME_END] = p.objective;
	outcome[SEARCH_OUTCOME_STEP] = p.step;
	outcome[SEARCH_OUTCOME_ITERATIONS] = p.iterations;
	outcome[SEARCH_OUTCOME_MOVES] = p.moves;
	outcome[SEARCH_OUTCOME_EXTRA_HIGH] = p.extra_high;
	outcome[SEARCH_OUTCOME_EXTRA_LOW] = p.extra_low;
}

#endif
