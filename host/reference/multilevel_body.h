/* Body of host/reference/multilevel_*.c, compiled once per precision, and once more for plain bending in a box,
 * which takes two thirds of the time where the compiler knows it: the includer defines BATTEN_DOUBLE,
 * MULTILEVEL_FUNCTION, GRID_FAIRNESS and GRID_PENALTY. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#include "shared/dialect.h"
#include "shared/grid_moves.h"
#include "shared/multilevel.h"
#include "shared/search_layout.h"

/* One direction: a hat, or, the narrowest, an offset alone. */
typedef struct direction {
	search_move move;
	bool single;
	single_offset offset;
} direction;

static scalar objective_after(const search_state *s, direction *d, scalar step, int turn)
{
	if (d->single)
		return single_objective(s, &d->offset, step);
	d->move.step = step;
	return hat_objective(s, &d->move, turn);
}

/* `probed`: the last step that was. */
static void move_for_good(const search_state *s, direction *d, scalar step, scalar probed)
{
	if (d->single) {
		single_end(s, &d->offset, step);
		return;
	}
	d->move.step = step;
	if (step != LITERAL(0.0) && step != probed)
		(void)hat_objective(s, &d->move, 4); /* for its terms */
	hat_end(s, &d->move);
}

/* Exploratory move along one direction: +h, -h and the bottom of the parabola through them; the best
 * is taken if it is a gain. Returns the length of the step taken. */
static scalar explore(const search_state *s, direction *d, scalar h, uint64_t *extra)
{
	const scalar before = d->single ? single_objective(s, &d->offset, LITERAL(0.0))
	                                : hat_objective_before(s, &d->move);
	const scalar plus = objective_after(s, d, h, 1) - before;
	const scalar minus = objective_after(s, d, -h, 2) - before;
	const scalar bottom = parabola_step(h, plus, minus);
	scalar step = minus < plus ? -h : h;
	scalar change = minus < plus ? minus : plus;
	if (bottom != LITERAL(0.0)) {
		(*extra)++;
		const scalar found = objective_after(s, d, bottom, 3) - before;
		if (found < change) {
			step = bottom;
			change = found;
		}
	}
	if (!(change < -(GAIN_FLOOR * before)))
		step = LITERAL(0.0);
	move_for_good(s, d, step, bottom != LITERAL(0.0) ? bottom : -h);
	return step < LITERAL(0.0) ? -step : step;
}

/* The directions of levels below `above` down to `lowest`. Returns the longest step taken. */
static scalar sweep(const reference_multilevel *plan, const search_state *s, int above, int lowest,
                    scalar h, uint64_t *extra)
{
	scalar longest = LITERAL(0.0);
	for (int l = above - 1; l >= lowest; l--) {
		const int32_t *level = plan->levels + l * SEARCH_LEVEL_SIZE;
		const int32_t *first = level + SEARCH_LEVEL_FIRST;
		direction d = { .move = { .width_x = level[SEARCH_LEVEL_WIDTH_X],
			                      .width_z = level[SEARCH_LEVEL_WIDTH_Z] } };
		d.single = GRID_FAIRNESS != GRID_VARIATION && d.move.width_x == 1 && d.move.width_z == 1;
		d.move.inverse_x = LITERAL(1.0) / (scalar)d.move.width_x;
		d.move.inverse_z = LITERAL(1.0) / (scalar)d.move.width_z;
		for (int32_t n = first[0]; n < first[GRID_COLOURS(GRID_FAIRNESS)]; n++) {
			d.move.station = plan->centres[2 * n];
			d.move.waterline = plan->centres[2 * n + 1];
			if (d.single)
				single_begin(s, d.move.station, d.move.waterline, &d.offset);
			const scalar length = explore(s, &d, h, extra);
			longest = length > longest ? length : longest;
		}
	}
	return longest;
}

/* y + factor (y - base), kept in the box, into trial. */
static void extrapolate(const search_state *s, scalar factor)
{
	for (int n = 0; n < s->nodes; n++)
		s->trial[n] = step_from(s, s->y[n], factor * (s->y[n] - s->base[n]), s->lower[n],
		                        s->upper[n]);
}

/* The objective at y. */
static scalar objective_here(const search_state *s)
{
	memcpy(s->trial, s->y, (size_t)s->nodes * sizeof *s->trial);
	return whole_objective(s);
}

/* Pattern move: on along the iteration's way, doubling while the objective falls. */
static scalar pattern(const search_state *s, scalar objective, uint64_t *extra)
{
	scalar best = LITERAL(0.0);
	scalar factor = LITERAL(1.0);
	for (int turn = 0; turn < PATTERN_LIMIT; turn++) {
		extrapolate(s, factor);
		const scalar found = whole_objective(s);
		(*extra)++;
		if (!(found < objective - GAIN_FLOOR * objective))
			break;
		objective = found;
		best = factor;
		factor *= LITERAL(2.0);
	}
	if (best > LITERAL(0.0)) {
		extrapolate(s, best);
		memcpy(s->y, s->trial, (size_t)s->nodes * sizeof *s->y);
	}
	return objective;
}

/* What an iteration came to. */
typedef struct iteration {
	scalar objective, longest;
	bool wide_pays;
} iteration;

/* Exploratory moves, coarse to fine, and the pattern move. */
static iteration iterate(const reference_multilevel *plan, const search_state *s, bool wide_is_due,
                         scalar objective, scalar h, uint64_t *extra)
{
	const int wide_levels = search_wide_levels(plan->levels, plan->level_count);
	const int narrow = plan->level_count - wide_levels;
	iteration done = { .objective = objective };
	scalar after_wide = objective;
	memcpy(s->base, s->y, (size_t)s->nodes * sizeof *s->base);
	grid_terms_begin(s);
	if (wide_levels > 0 && wide_is_due) {
		done.longest = sweep(plan, s, plan->level_count, narrow, h, extra);
		after_wide = objective_here(s);
		*extra += (uint64_t)s->wide_probes;
	}
	const scalar longest = sweep(plan, s, narrow, 0, h, extra);
	done.longest = longest > done.longest ? longest : done.longest;
	if (done.longest > LITERAL(0.0))
		done.objective = pattern(s, objective_here(s), extra);
	done.wide_pays = objective - after_wide > WIDE_SHARE * (after_wide - done.objective);
	return done;
}

void MULTILEVEL_FUNCTION(const reference_multilevel *plan, const scalar *stencils, scalar *arrays,
                         const scalar *settings, scalar *outcome, scalar *scratch)
{
	const size_t nodes = ((size_t)plan->stations + 2) * ((size_t)plan->waterlines + 2);
	search_state s = state_of(plan->stations, plan->waterlines, stencils, arrays, settings, scratch,
	                          scratch + SEARCH_STATE_COUNT * nodes);
	s.fairness = plan->fairness;
	s.penalised = plan->penalised;
	s.y = arrays + SEARCH_ARRAY_Y * nodes;
	scalar h = settings[SEARCH_SETTING_FIRST_STEP];
	scalar objective = objective_here(&s);
	uint64_t extra = 0;
	int iterations = 0;
	int moves = 0;
	bool wide_pays = false;
	outcome[SEARCH_OUTCOME_START] = objective;
	while (h > settings[SEARCH_SETTING_LAST_STEP] && iterations < plan->iteration_limit) {
		iterations++;
		const iteration done = iterate(plan, &s, wide_pays || iterations % WIDE_TURNS == 0,
		                               objective, h, &extra);
		objective = done.objective;
		wide_pays = done.wide_pays;
		moves += done.longest > LITERAL(0.0);
		if (done.longest < h)
			h *= LITERAL(0.5);
	}
	outcome[SEARCH_OUTCOME_END] = objective;
	outcome[SEARCH_OUTCOME_STEP] = h;
	outcome[SEARCH_OUTCOME_ITERATIONS] = (scalar)iterations;
	outcome[SEARCH_OUTCOME_MOVES] = (scalar)moves;
	outcome[SEARCH_OUTCOME_EXTRA_HIGH] = (scalar)(extra >> 20);
	outcome[SEARCH_OUTCOME_EXTRA_LOW] = (scalar)(extra & 0xfffff);
}
