/* The pattern move with a memory: a parabola is probed over this iteration's way and the ways of the
 * iterations before, and the search goes on from its bottom. What search_driver.h asks for.
 *
 * Defined before this is included, beside what search_sweep.h asks for:
 *   SEARCH_WAYS        ways, this iteration's among them
 *   search_state       ways: STATE stored *, SEARCH_WAYS - 1 arrays of nodes
 *   real step_from(const search_state *, real y, real step, real lower, real upper)
 *                      where a step leads from y in a box */
#ifndef BATTEN_SHARED_SEARCH_WAYS_H
#define BATTEN_SHARED_SEARCH_WAYS_H

#include "multilevel.h"
#include "search_progress.h"

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

/* y and on along this iteration's way, y - base, and the remembered ones, kept in the box, into
 * trial. */
SHARED_FUNCTION void search_extrapolate(const search_state *s, const real *factors)
{
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		real step = factors[0] * (AT(s->y[n]) - AT(s->base[n]));
		ROLLED
		for (int w = 1; w < SEARCH_WAYS; w++)
			step += factors[w] * AT(s->ways[(w - 1) * s->nodes + n]);
		AT(s->trial[n]) = step_from(s, AT(s->y[n]), step, AT(s->lower[n]), AT(s->upper[n]));
	}
	WAIT;
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
SHARED_FUNCTION void search_pattern(const search_state *s, mask going, int turn, search_progress *p)
{
	const int probe_limit = !ANY_BESIDE(s, going) ? -1 : turn > 0 ? SEARCH_PROBE_LIMIT : 0;
	const int slot = turn % (SEARCH_WAYS - 1); /* the oldest is forgotten */
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
		if (!ANY_BESIDE(s, going))
			break;
	}
	search_count(p, probes);
	if (ALONE && !ANY(moved))
		return;
	search_extrapolate(s, best);
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS) {
		STATE stored *way = s->ways + slot * s->nodes + n;
		AT(s->y[n]) = AT(s->trial[n]);
		AT(*way) = CHOOSE(moved, AT(s->y[n]) - AT(s->base[n]), AT(*way));
	}
	WAIT;
}

/* No way is remembered yet. */
SHARED_FUNCTION void search_prepare(const search_state *s)
{
	ROLLED
	for (int n = WORK_ITEM; n < (SEARCH_WAYS - 1) * s->nodes; n += WORK_ITEMS)
		AT(s->ways[n]) = SPREAD(LITERAL(0.0));
}

#endif
