/* The multilevel pattern search (Hooke and Jeeves; thesis 7.2), whole searches in one launch.
 *
 * A work-group runs BATTEN_LANES searches side by side, one a lane of `real`; its work-items share
 * the directions of each colour. On a CPU: many lanes, one work-item. On a GPU: one lane, many
 * work-items. Every direction and every sum is worked in one fixed order by one work-item, so the
 * shape does not change a bit of the result; host/reference/multilevel_body.h is the same in plain C.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, STATE (local, or global for grids whose state
 * does not fit local memory), GRID_FAIRNESS (search_layout.h), plain bending where it is not, and
 * GRID_PENALTY (grid_state.h). */
#if !defined(GRID_FAIRNESS)
#define GRID_FAIRNESS GRID_BENDING
#endif
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/grid_moves.h"
#include "shared/grid_state.h"
#include "shared/multilevel.h"

/* The level of a colour: all colours of the coarsest level first. */
static inline global const int *level_of(const search_state *s, int colour)
{
	return s->levels +
	       (s->level_count - 1 - colour / GRID_COLOURS(GRID_FAIRNESS)) * SEARCH_LEVEL_SIZE;
}

static inline void colour_range(const search_state *s, int colour, int *first, int *end)
{
	global const int *at = level_of(s, colour) + SEARCH_LEVEL_FIRST +
	                       colour % GRID_COLOURS(GRID_FAIRNESS);
	*first = at[0];
	*end = at[1];
}

static inline void move_begin(const search_state *s, int colour, int direction, search_move *move)
{
	global const int *level = level_of(s, colour);
	move->station = s->centres[2 * direction];
	move->waterline = s->centres[2 * direction + 1];
	move->width_x = level[SEARCH_LEVEL_WIDTH_X];
	move->width_z = level[SEARCH_LEVEL_WIDTH_Z];
	move->inverse_x = LITERAL(1.0) / (scalar)level[SEARCH_LEVEL_WIDTH_X];
	move->inverse_z = LITERAL(1.0) / (scalar)level[SEARCH_LEVEL_WIDTH_Z];
}

/* An exploratory move along a hat. Returns the step taken. */
static inline real hat_explore(const search_state *s, search_move *move, real h, real *extra)
{
	const real zero = SPREAD(LITERAL(0.0));
	search_trial trial = search_trial_begin();
	(void)search_trial_next(&trial, 0, h, hat_objective_before(s, move), extra);
	move->step = trial.next;
	ROLLED
	for (int turn = 1;; turn++) {
		const real sum = hat_objective(s, move, turn);
		if (turn > 3)
			break; /* the step taken, worked again */
		if (search_trial_next(&trial, turn, h, sum, extra)) {
			move->step = trial.next;
			continue;
		}
		const real probed = move->step;
		move->step = search_trial_end(&trial);
		if (!ANY((move->step != zero) & (move->step != probed)))
			break; /* the terms of the last probe are those of the step taken */
		turn = 3;
	}
	hat_end(s, move);
	return move->step;
}

/* An exploratory move of a single offset. Returns the step taken. */
static inline real single_explore(const search_state *s, int station, int waterline, real h,
                                  real *extra)
{
	single_offset offset;
	search_trial trial = search_trial_begin();
	single_begin(s, station, waterline, &offset);
	ROLLED
	for (int turn = 0; turn < 4; turn++)
		if (!search_trial_next(&trial, turn, h, single_objective(s, &offset, trial.next), extra))
			break;
	const real step = search_trial_end(&trial);
	single_end(s, &offset, step);
	return step;
}

/* An exploratory move along one direction. Returns the length of the step taken. */
static inline real direction_explore(const search_state *s, int colour, int direction, real h,
                                     real *extra)
{
	global const int *level = level_of(s, colour);
	search_move move;
	real step;
	if (GRID_FAIRNESS == GRID_VARIATION || level[SEARCH_LEVEL_WIDTH_X] > 1 ||
	    level[SEARCH_LEVEL_WIDTH_Z] > 1) {
		move_begin(s, colour, direction, &move);
		step = hat_explore(s, &move, h, extra);
	} else {
		step = single_explore(s, s->centres[2 * direction], s->centres[2 * direction + 1], h,
		                      extra);
	}
	return CHOOSE(step < SPREAD(LITERAL(0.0)), -step, step);
}

static inline void sweeps_begin(const search_state *s)
{
	grid_terms_begin(s);
}

#include "shared/search_sweep.h"

/* Nothing is remembered from one pattern move to the next. */
static inline void search_prepare(const search_state *s)
{
	(void)s;
}

/* y + factor (y - base), kept in the box, into trial. */
static inline void extrapolate(const search_state *s, real factor)
{
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		s->trial[n] = step_from(s, s->y[n], factor * (s->y[n] - s->base[n]), s->lower[n],
		                        s->upper[n]);
	WAIT;
}

/* The objective at y (factor 0), then the pattern move: on along the iteration's way, doubling while
 * it falls. Lanes that are not `going` keep everything. */
static inline void search_pattern(const search_state *s, mask going, int turn, search_progress *p)
{
	const int pattern_limit = !ANY(going) ? -1 : turn > 0 ? PATTERN_LIMIT : 0;
	const real zero = SPREAD(LITERAL(0.0));
	real factor = zero, best = zero, probes = zero;
	ROLLED
	for (int probe = 0; probe <= pattern_limit; probe++) {
		extrapolate(s, factor);
		const real found = whole_objective(s);
		if (probe == 0) {
			p->objective = CHOOSE(going, found, p->objective);
			factor = SPREAD(LITERAL(1.0));
			continue;
		}
		probes += CHOOSE(going, SPREAD(LITERAL(1.0)), zero);
		going = going & (found < p->objective - SPREAD(GAIN_FLOOR) * p->objective);
		p->objective = CHOOSE(going, found, p->objective);
		best = CHOOSE(going, factor, best);
		factor *= SPREAD(LITERAL(2.0));
		if (!ANY(going))
			break;
	}
	search_count(p, probes);
	if (ALONE && !ANY(best > zero))
		return;
	extrapolate(s, best);
	ROLLED
	for (int n = WORK_ITEM; n < s->nodes; n += WORK_ITEMS)
		s->y[n] = CHOOSE(best > zero, s->trial[n], s->y[n]);
	WAIT;
}

#include "shared/search_driver.h"

/* stencils: STENCIL_SIZE a station, then a waterline. levels: SEARCH_LEVEL_SIZE numbers each. centres:
 * station and waterline of each direction. arrays [group][SEARCH_ARRAY_COUNT][nodes], settings
 * [group][SEARCH_SETTING_COUNT], outcome [group][SEARCH_OUTCOME_COUNT], all of real. room: SEARCH_STATE_COUNT * nodes of
 * real a group. lines: a real a waterline. gathered: two reals a work-item. */
kernel void multilevel(int stations, int waterlines, int level_count, int iteration_limit,
                       global const int *levels, global const int *centres,
                       global const scalar *stencils, global real *arrays,
                       global const real *settings, global real *outcome, STATE real *room,
                       local real *lines, local real *gathered)
{
	const size_t group = get_group_id(0);
	const size_t nodes = (size_t)(stations + 2) * (size_t)(waterlines + 2);
#if defined(STATE_IS_GLOBAL)
	room += group * SEARCH_STATE_COUNT * nodes;
#endif
	arrays += group * SEARCH_ARRAY_COUNT * nodes;
	settings += group * SEARCH_SETTING_COUNT;
	search_state s = state_of(stations, waterlines, stencils, arrays, settings, room, lines);
	s.level_count = level_count;
	s.colour_count = level_count * GRID_COLOURS(GRID_FAIRNESS);
	s.wide_colours = search_wide_levels(levels, level_count) * GRID_COLOURS(GRID_FAIRNESS);
	s.levels = levels;
	s.centres = centres;
	search_run(&s, iteration_limit, settings, arrays + SEARCH_ARRAY_Y * nodes,
	           outcome + group * SEARCH_OUTCOME_COUNT, gathered);
}
