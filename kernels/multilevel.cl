/* The multilevel pattern search (Hooke and Jeeves; thesis 7.2), whole searches in one launch.
 *
 * A work-group runs BATTEN_LANES searches side by side, one a lane of `real`; its work-items share
 * the directions of each colour. On a CPU: many lanes, one work-item. On a GPU: one lane, many
 * work-items. Every direction and every sum is worked in one fixed order by one work-item, so the
 * shape does not change a bit of the result; host/reference/multilevel_body.h is the same in plain C.
 *
 * Defined by the host: BATTEN_DOUBLE, BATTEN_LANES, STATE (local, or global for grids whose state
 * does not fit local memory). */
#define BATTEN_DIALECT_OPENCL
#include "shared/dialect.h"
#include "shared/grid_energy.h"
#include "shared/multilevel.h"
#include "shared/search_layout.h"

typedef struct search_state {
	int stations, waterlines, stride, nodes;
	global const scalar *along_x, *along_z;
	STATE real *y, *base, *trial;
	global const real *lower, *upper, *target, *bend, *close;
	local real *lines; /* one sum a waterline */
} search_state;

typedef struct hat_move {
	int station, waterline; /* centre */
	int width_x, width_z;
	scalar inverse_x, inverse_z;
	real step;
} hat_move;

static inline int node_of(const search_state *s, int station, int waterline)
{
	return (waterline + 1) * s->stride + (station + 1);
}

static inline node_stencil stencil_of(const search_state *s, int station, int waterline)
{
	node_stencil stencil;
	for (int w = 0; w < STENCIL_SIZE; w++) {
		stencil.x[w] = s->along_x[station * STENCIL_SIZE + w];
		stencil.z[w] = s->along_z[waterline * STENCIL_SIZE + w];
	}
	return stencil;
}

static inline real moved_node(const search_state *s, const hat_move *move, int station,
                              int waterline)
{
	const int node = node_of(s, station, waterline);
	const scalar height = hat_height(station - move->station, move->inverse_x) *
	                      hat_height(waterline - move->waterline, move->inverse_z);
	/* Most nodes of a direction's stencils lie beside its hat. */
	if (height == LITERAL(0.0))
		return s->y[node];
	return move_clamped(s->y[node], height * move->step, s->lower[node], s->upper[node]);
}

static inline node_row moved_row(const search_state *s, const hat_move *move, int station,
                                 int waterline)
{
	node_row row;
	row.aft = moved_node(s, move, station - 1, waterline);
	row.here = moved_node(s, move, station, waterline);
	row.fore = moved_node(s, move, station + 1, waterline);
	return row;
}

/* The objective over the nodes whose terms a direction can change, after a move along it. */
static inline real local_objective(const search_state *s, const hat_move *move)
{
	const int first_i = max(move->station - move->width_x, 0);
	const int first_k = max(move->waterline - move->width_z, 0);
	const int end_i = min(move->station + move->width_x, s->stations - 1);
	const int end_k = min(move->waterline + move->width_z, s->waterlines - 1);
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int i = first_i; i <= end_i; i++) {
		real column = SPREAD(LITERAL(0.0));
		node_row below, here, above;
		below.aft = below.here = below.fore = column;
		here = below;
		ROLLED
		for (int k = first_k - 1; k <= end_k + 1; k++) {
			above = moved_row(s, move, i, k);
			if (k > first_k) {
				const int node = node_of(s, i, k - 1);
				column += node_objective(slopes_of(stencil_of(s, i, k - 1), below, here, above),
				                         s->bend[node], s->close[node], here.here, s->target[node]);
			}
			below = here;
			here = above;
		}
		sum += column;
	}
	return sum;
}

/* The whole objective at s->trial, the same in every work-item. */
static inline real whole_objective(const search_state *s)
{
	ROLLED
	for (int k = (int)get_local_id(0); k < s->waterlines; k += (int)get_local_size(0)) {
		real line = SPREAD(LITERAL(0.0));
		ROLLED
		for (int i = 0; i < s->stations; i++) {
			const int node = node_of(s, i, k);
			const STATE real *b = s->trial + (node - s->stride);
			const STATE real *h = s->trial + node;
			const STATE real *a = s->trial + (node + s->stride);
			const node_row below = { b[-1], b[0], b[1] };
			const node_row here = { h[-1], h[0], h[1] };
			const node_row above = { a[-1], a[0], a[1] };
			line += node_objective(slopes_of(stencil_of(s, i, k), below, here, above),
			                       s->bend[node], s->close[node], here.here, s->target[node]);
		}
		s->lines[k] = line;
	}
	barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
	real sum = SPREAD(LITERAL(0.0));
	ROLLED
	for (int k = 0; k < s->waterlines; k++)
		sum += s->lines[k];
	barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
	return sum;
}

static inline void apply_move(const search_state *s, const hat_move *move)
{
	ROLLED
	for (int k = move->waterline - move->width_z + 1; k < move->waterline + move->width_z; k++) {
		ROLLED
		for (int i = move->station - move->width_x + 1; i < move->station + move->width_x; i++)
			if (k >= 0 && k < s->waterlines && i >= 0 && i < s->stations)
				s->y[node_of(s, i, k)] = moved_node(s, move, i, k);
	}
}

/* Exploratory move along one direction: +h, -h and the bottom of the parabola through them; the best
 * is taken where it is a gain. One call of the objective in a loop: PoCL compiles each call anew.
 * Returns the length of the step taken. */
static inline real explore(const search_state *s, hat_move *move, real h, real *extra)
{
	const real zero = SPREAD(LITERAL(0.0));
	real before = zero, plus = zero, change = zero, step = zero;
	move->step = zero;
	ROLLED
	for (int turn = 0; turn < 4; turn++) {
		const real sum = local_objective(s, move);
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
	if (ANY(gain))
		apply_move(s, move);
	return CHOOSE(move->step < zero, -move->step, move->step);
}

/* All directions, coarse to fine. Returns the longest step this work-item took. */
static inline real sweep(const search_state *s, int level_count, global const int *levels,
                         global const int *centres, real h, real *extra)
{
	real longest = SPREAD(LITERAL(0.0));
	ROLLED
	for (int l = level_count - 1; l >= 0; l--) {
		global const int *level = levels + l * SEARCH_LEVEL_SIZE;
		hat_move move;
		move.width_x = level[SEARCH_LEVEL_WIDTH_X];
		move.width_z = level[SEARCH_LEVEL_WIDTH_Z];
		move.inverse_x = LITERAL(1.0) / (scalar)level[SEARCH_LEVEL_WIDTH_X];
		move.inverse_z = LITERAL(1.0) / (scalar)level[SEARCH_LEVEL_WIDTH_Z];
		ROLLED
		for (int colour = 0; colour < SEARCH_COLOUR_COUNT; colour++) {
			ROLLED
			for (int d = level[SEARCH_LEVEL_FIRST + colour] + (int)get_local_id(0);
			     d < level[SEARCH_LEVEL_FIRST + colour + 1]; d += (int)get_local_size(0)) {
				move.station = centres[2 * d];
				move.waterline = centres[2 * d + 1];
				const real length = explore(s, &move, h, extra);
				longest = CHOOSE(length > longest, length, longest);
			}
			barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
		}
	}
	return longest;
}

/* y + factor (y - base), kept in the box, into trial. */
static inline void extrapolate(const search_state *s, real factor)
{
	ROLLED
	for (int n = (int)get_local_id(0); n < s->nodes; n += (int)get_local_size(0))
		s->trial[n] = move_clamped(s->y[n], factor * (s->y[n] - s->base[n]), s->lower[n],
		                           s->upper[n]);
	barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
}

/* The longest step and the number of probes of all work-items: a maximum and a sum of whole numbers,
 * so their order does not matter. gathered has two values a work-item. */
static inline void gather(local real *gathered, real *longest, real *extra)
{
	const int size = (int)get_local_size(0);
	gathered[get_local_id(0)] = *longest;
	gathered[size + (int)get_local_id(0)] = *extra;
	barrier(CLK_LOCAL_MEM_FENCE);
	*extra = SPREAD(LITERAL(0.0));
	ROLLED
	for (int w = 0; w < size; w++) {
		*longest = CHOOSE(gathered[w] > *longest, gathered[w], *longest);
		*extra += gathered[size + w];
	}
	barrier(CLK_LOCAL_MEM_FENCE);
}

/* What a lane has come to; the same in every work-item. */
typedef struct progress {
	real objective, step, iterations, moves, extra_high, extra_low;
} progress;

static inline void count_probes(progress *p, real probes)
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

/* The objective at y (factor 0), then the pattern move: on along the iteration's way, doubling while
 * it falls. Lanes that are not `going` keep everything. */
static inline void evaluate_and_extrapolate(const search_state *s, mask going, int pattern_limit,
                                            progress *p)
{
	const real zero = SPREAD(LITERAL(0.0));
	real factor = zero, best = zero, probes = zero;
	ROLLED
	for (int turn = 0; turn <= pattern_limit; turn++) {
		extrapolate(s, factor);
		const real found = whole_objective(s);
		if (turn == 0) {
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
	count_probes(p, probes);
	if (ANY(best > zero)) {
		extrapolate(s, best);
		ROLLED
		for (int n = (int)get_local_id(0); n < s->nodes; n += (int)get_local_size(0))
			s->y[n] = CHOOSE(best > zero, s->trial[n], s->y[n]);
		barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
	}
}

/* The state of a group: its part of the arrays, and three arrays of nodes to work in. */
static inline search_state state_of(int stations, int waterlines, global const scalar *stencils,
                                    global const real *arrays, STATE real *room, local real *lines)
{
	search_state s;
	s.stations = stations;
	s.waterlines = waterlines;
	s.stride = stations + 2;
	s.nodes = (stations + 2) * (waterlines + 2);
	s.along_x = stencils;
	s.along_z = stencils + stations * STENCIL_SIZE;
	s.y = room;
	s.base = room + s.nodes;
	s.trial = room + 2 * s.nodes;
	s.lower = arrays + SEARCH_ARRAY_LOWER * s.nodes;
	s.upper = arrays + SEARCH_ARRAY_UPPER * s.nodes;
	s.target = arrays + SEARCH_ARRAY_TARGET * s.nodes;
	s.bend = arrays + SEARCH_ARRAY_BEND * s.nodes;
	s.close = arrays + SEARCH_ARRAY_CLOSE * s.nodes;
	s.lines = lines;
	return s;
}

static inline void copy_nodes(const search_state *s, STATE real *to, const STATE real *from)
{
	ROLLED
	for (int n = (int)get_local_id(0); n < s->nodes; n += (int)get_local_size(0))
		to[n] = from[n];
	barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
}

static inline void store_outcome(global real *end, real start, const progress *p)
{
	if (get_local_id(0) != 0)
		return;
	end[SEARCH_OUTCOME_START] = start;
	end[SEARCH_OUTCOME_END] = p->objective;
	end[SEARCH_OUTCOME_STEP] = p->step;
	end[SEARCH_OUTCOME_ITERATIONS] = p->iterations;
	end[SEARCH_OUTCOME_MOVES] = p->moves;
	end[SEARCH_OUTCOME_EXTRA_HIGH] = p->extra_high;
	end[SEARCH_OUTCOME_EXTRA_LOW] = p->extra_low;
}

/* stencils: STENCIL_SIZE a station, then a waterline. levels: SEARCH_LEVEL_SIZE numbers each. centres:
 * station and waterline of each direction. arrays [group][SEARCH_ARRAY_COUNT][nodes], settings
 * [group][SEARCH_SETTING_COUNT], outcome [group][SEARCH_OUTCOME_COUNT], all of real. room: 3 * nodes of
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
	room += group * 3 * nodes;
#endif
	arrays += group * SEARCH_ARRAY_COUNT * nodes;
	settings += group * SEARCH_SETTING_COUNT;
	const search_state s = state_of(stations, waterlines, stencils, arrays, room, lines);
	const real zero = SPREAD(LITERAL(0.0));
	const real one = SPREAD(LITERAL(1.0));
	const real limit = SPREAD((scalar)iteration_limit);
	const real last_step = settings[SEARCH_SETTING_LAST_STEP];
	progress p = { zero, settings[SEARCH_SETTING_FIRST_STEP], zero, zero, zero, zero };
	real start = zero;
	ROLLED
	for (int n = (int)get_local_id(0); n < s.nodes; n += (int)get_local_size(0))
		s.y[n] = arrays[n];
	barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);

	/* Turn 0 only evaluates the start. */
	for (int turn = 0;; turn++) {
		const mask active = (p.step > last_step) & (p.iterations < limit);
		if (turn > 0 && !ANY(active))
			break;
		copy_nodes(&s, s.base, s.y);
		real longest = zero;
		mask going = p.iterations < limit;
		if (turn > 0) {
			real extra = zero;
			longest = sweep(&s, level_count, levels, centres, CHOOSE(active, p.step, zero), &extra);
			gather(gathered, &longest, &extra);
			count_probes(&p, extra);
			going = active & (longest > zero);
			p.moves += CHOOSE(going, one, zero);
		}
		if (ANY(going))
			evaluate_and_extrapolate(&s, going, turn > 0 ? PATTERN_LIMIT : 0, &p);
		if (turn == 0) {
			start = p.objective;
			continue;
		}
		p.step = CHOOSE(active & (longest < p.step), p.step * SPREAD(LITERAL(0.5)), p.step);
		p.iterations += CHOOSE(active, one, zero);
	}

	ROLLED
	for (int n = (int)get_local_id(0); n < s.nodes; n += (int)get_local_size(0))
		arrays[n] = s.y[n];
	store_outcome(outcome + group * SEARCH_OUTCOME_COUNT, start, &p);
}
