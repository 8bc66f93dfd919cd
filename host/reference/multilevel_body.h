/* Body of host/reference/multilevel.c, compiled once per precision: the includer defines
 * BATTEN_DOUBLE and MULTILEVEL_FUNCTION. No include guard, on purpose. */

#define BATTEN_DIALECT_C
#include "shared/dialect.h"
#include "shared/grid_energy.h"
#include "shared/multilevel.h"
#include "shared/search_layout.h"

typedef struct search_state {
	int stations, waterlines;
	size_t stride; /* nodes from one waterline to the next */
	size_t nodes;
	const scalar *along_x, *along_z;
	scalar *y;
	const scalar *lower, *upper, *target, *bend, *close;
	int fairness;
	grid_weights weights;
	scalar wide_probes;
} search_state;

/* A direction with a step: 0 everywhere but under the hat. */
typedef struct hat_move {
	int station, waterline; /* centre */
	int width_x, width_z;
	scalar inverse_x, inverse_z;
	scalar step;
} hat_move;

static int larger(int a, int b)
{
	return a > b ? a : b;
}

static int smaller(int a, int b)
{
	return a < b ? a : b;
}

static size_t node_of(const search_state *s, int station, int waterline)
{
	return (size_t)(waterline + 1) * s->stride + (size_t)(station + 1);
}

static node_stencil stencil_of(const search_state *s, int station, int waterline)
{
	const scalar *x = s->along_x + station * STENCIL_SIZE;
	const scalar *z = s->along_z + waterline * STENCIL_SIZE;
	const node_stencil stencil = { { x[0], x[1], x[2], x[3] }, { z[0], z[1], z[2], z[3] } };
	return stencil;
}

static scalar moved_node(const search_state *s, const hat_move *move, int station, int waterline)
{
	const size_t node = node_of(s, station, waterline);
	const scalar height = hat_height(station - move->station, move->inverse_x) *
	                      hat_height(waterline - move->waterline, move->inverse_z);
	/* Most nodes of a direction's stencils lie beside its hat. */
	if (height == LITERAL(0.0))
		return s->y[node];
	return move_clamped(s->y[node], height * move->step, s->lower[node], s->upper[node]);
}

static node_row moved_row(const search_state *s, const hat_move *move, int station, int waterline)
{
	node_row row = { moved_node(s, move, station - 1, waterline),
		             moved_node(s, move, station, waterline),
		             moved_node(s, move, station + 1, waterline) };
	return row;
}

/* The objective over the nodes whose terms a direction can change, after a move along it. */
static scalar local_objective(const search_state *s, const hat_move *move)
{
	const int first_i = larger(move->station - move->width_x, 0);
	const int first_k = larger(move->waterline - move->width_z, 0);
	const int end_i = smaller(move->station + move->width_x, s->stations - 1);
	const int end_k = smaller(move->waterline + move->width_z, s->waterlines - 1);
	scalar sum = LITERAL(0.0);
	for (int i = first_i; i <= end_i; i++) {
		scalar column = LITERAL(0.0);
		node_row below = moved_row(s, move, i, first_k - 1);
		node_row here = moved_row(s, move, i, first_k);
		for (int k = first_k; k <= end_k; k++) {
			const node_row above = moved_row(s, move, i, k + 1);
			const size_t node = node_of(s, i, k);
			column += node_objective(s->fairness, s->weights,
			                         slopes_of(stencil_of(s, i, k), below, here, above),
			                         s->bend[node], s->close[node], here.here, s->target[node]);
			below = here;
			here = above;
		}
		sum += column;
	}
	return sum;
}

/* The whole objective at y: sums of waterlines, added from the keel up. */
static scalar whole_objective(const search_state *s, const scalar *y)
{
	scalar sum = LITERAL(0.0);
	for (int k = 0; k < s->waterlines; k++) {
		scalar line = LITERAL(0.0);
		for (int i = 0; i < s->stations; i++) {
			const size_t node = node_of(s, i, k);
			const scalar *b = y + (node - s->stride);
			const scalar *h = y + node;
			const scalar *a = y + (node + s->stride);
			const node_row below = { b[-1], b[0], b[1] };
			const node_row here = { h[-1], h[0], h[1] };
			const node_row above = { a[-1], a[0], a[1] };
			line += node_objective(s->fairness, s->weights,
			                       slopes_of(stencil_of(s, i, k), below, here, above),
			                       s->bend[node], s->close[node], here.here, s->target[node]);
		}
		sum += line;
	}
	return sum;
}

/* Moves every node under the hat for good. */
static void apply_move(const search_state *s, const hat_move *move)
{
	for (int k = move->waterline - move->width_z + 1; k < move->waterline + move->width_z; k++)
		for (int i = move->station - move->width_x + 1; i < move->station + move->width_x; i++)
			if (k >= 0 && k < s->waterlines && i >= 0 && i < s->stations)
				s->y[node_of(s, i, k)] = moved_node(s, move, i, k);
}

/* Exploratory move along one direction: +h, -h and the bottom of the parabola through them; the best
 * is taken if it is a gain. Returns the length of the step taken. */
static scalar explore(const search_state *s, hat_move *move, scalar h, uint64_t *extra)
{
	scalar sums[4];
	const scalar tried[3] = { LITERAL(0.0), h, -h };
	for (int turn = 0; turn < 3; turn++) {
		move->step = tried[turn];
		sums[turn] = local_objective(s, move);
	}
	const scalar plus = sums[1] - sums[0];
	const scalar minus = sums[2] - sums[0];
	scalar step = h;
	scalar change = plus;
	if (minus < change) {
		step = -h;
		change = minus;
	}
	move->step = parabola_step(h, plus, minus);
	if (move->step != LITERAL(0.0)) {
		(*extra)++;
		sums[3] = local_objective(s, move);
		if (sums[3] - sums[0] < change) {
			step = move->step;
			change = sums[3] - sums[0];
		}
	}
	if (!(change < -(GAIN_FLOOR * sums[0])))
		return LITERAL(0.0);
	move->step = step;
	apply_move(s, move);
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
		hat_move move = { .width_x = level[SEARCH_LEVEL_WIDTH_X],
			              .width_z = level[SEARCH_LEVEL_WIDTH_Z],
			              .inverse_x = LITERAL(1.0) / (scalar)level[SEARCH_LEVEL_WIDTH_X],
			              .inverse_z = LITERAL(1.0) / (scalar)level[SEARCH_LEVEL_WIDTH_Z] };
		for (int32_t d = first[0]; d < first[SEARCH_COLOUR_COUNT]; d++) {
			move.station = plan->centres[2 * d];
			move.waterline = plan->centres[2 * d + 1];
			const scalar length = explore(s, &move, h, extra);
			longest = length > longest ? length : longest;
		}
	}
	return longest;
}

/* y + factor (y - base), kept in the box, into trial. */
static void extrapolate(const search_state *s, const scalar *base, scalar factor, scalar *trial)
{
	for (size_t n = 0; n < s->nodes; n++)
		trial[n] = move_clamped(s->y[n], factor * (s->y[n] - base[n]), s->lower[n], s->upper[n]);
}

/* Pattern move: on along the iteration's way, doubling while the objective falls. */
static scalar pattern(const search_state *s, const scalar *base, scalar objective, scalar *trial,
                      uint64_t *extra)
{
	scalar best = LITERAL(0.0);
	scalar factor = LITERAL(1.0);
	for (int turn = 0; turn < PATTERN_LIMIT; turn++) {
		extrapolate(s, base, factor, trial);
		const scalar found = whole_objective(s, trial);
		(*extra)++;
		if (!(found < objective - GAIN_FLOOR * objective))
			break;
		objective = found;
		best = factor;
		factor *= LITERAL(2.0);
	}
	if (best > LITERAL(0.0)) {
		extrapolate(s, base, best, trial);
		memcpy(s->y, trial, s->nodes * sizeof *trial);
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
                         scalar objective, scalar h, scalar *scratch, uint64_t *extra)
{
	scalar *base = scratch;
	const int wide_levels = search_wide_levels(plan->levels, plan->level_count);
	const int narrow = plan->level_count - wide_levels;
	iteration done = { .objective = objective };
	scalar after_wide = objective;
	memcpy(base, s->y, s->nodes * sizeof *base);
	if (wide_levels > 0 && wide_is_due) {
		done.longest = sweep(plan, s, plan->level_count, narrow, h, extra);
		after_wide = whole_objective(s, s->y);
		*extra += (uint64_t)s->wide_probes;
	}
	const scalar longest = sweep(plan, s, narrow, 0, h, extra);
	done.longest = longest > done.longest ? longest : done.longest;
	if (done.longest > LITERAL(0.0)) {
		done.objective = whole_objective(s, s->y);
		done.objective = pattern(s, base, done.objective, scratch + s->nodes, extra);
	}
	done.wide_pays = objective - after_wide > WIDE_SHARE * (after_wide - done.objective);
	return done;
}

void MULTILEVEL_FUNCTION(const reference_multilevel *plan, const scalar *stencils, scalar *arrays,
                         const scalar *settings, scalar *outcome, scalar *scratch)
{
	const size_t stride = (size_t)plan->stations + 2;
	const size_t nodes = stride * ((size_t)plan->waterlines + 2);
	const search_state s = { .stations = plan->stations,
		                     .waterlines = plan->waterlines,
		                     .stride = stride,
		                     .nodes = nodes,
		                     .along_x = stencils,
		                     .along_z = stencils + plan->stations * STENCIL_SIZE,
		                     .y = arrays + SEARCH_ARRAY_Y * nodes,
		                     .lower = arrays + SEARCH_ARRAY_LOWER * nodes,
		                     .upper = arrays + SEARCH_ARRAY_UPPER * nodes,
		                     .target = arrays + SEARCH_ARRAY_TARGET * nodes,
		                     .bend = arrays + SEARCH_ARRAY_BEND * nodes,
		                     .close = arrays + SEARCH_ARRAY_CLOSE * nodes,
		                     .fairness = plan->fairness,
		                     .weights = { settings[SEARCH_SETTING_ALONG],
		                                  settings[SEARCH_SETTING_ACROSS],
		                                  settings[SEARCH_SETTING_BLUNT] },
		                     .wide_probes = settings[SEARCH_SETTING_WIDE_PROBES] };
	scalar h = settings[SEARCH_SETTING_FIRST_STEP];
	scalar objective = whole_objective(&s, s.y);
	uint64_t extra = 0;
	int iterations = 0;
	int moves = 0;
	bool wide_pays = false;
	outcome[SEARCH_OUTCOME_START] = objective;
	while (h > settings[SEARCH_SETTING_LAST_STEP] && iterations < plan->iteration_limit) {
		iterations++;
		const iteration done = iterate(plan, &s, wide_pays || iterations % WIDE_TURNS == 0,
		                               objective, h, scratch, &extra);
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
