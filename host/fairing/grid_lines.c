#include "fairing/grid_lines.h"

#include "core/runs.h"

#include <float.h>
#include <math.h>

/* A piece of a line between two empty cells is a lane; lanes are worked RUN_LENGTH at a time. Points that a
 * piece has fewer of than the longest one repeat its last, so that they change nothing. */
struct grid_lines {
	batten_context *context;
	size_t lane_count, point_count; /* lanes: whole runs; points: of the longest piece */
	size_t *line, *count; /* [lanes]: the line it is of, its points; 0 beyond the last piece */
	double *along_most_m; /* [lanes] */
	size_t *node;         /* [points][lanes], as what follows but for `in_order` */
	uint8_t *in_order;    /* [points][lanes / RUN_LENGTH]: the nodes of a run stand side by side */
	/* For the step to the next point, 1 at the last; for interior points the half span of the second
	 * difference, 1 elsewhere; what makes its rounding, and whether it is one. */
	double *step_m, *half_span_m, *rounding_per_m2, *inside;
	double *value_m, *slope;     /* [points][lanes], of the hull at work */
	double *fn_per_m2, *changes; /* [lanes] */
	double *memory;
};

enum { LANE_ARRAYS = 3, POINT_ARRAYS = 6, NUMBERS_MOST = 1 << 18 };

/* ---- pieces ---- */

struct walk {
	const batten_hull *hull;
	const double *at_m;
	size_t lines, length, line_step, step;
};

static struct walk walk_along(const batten_hull *hull, bool waterlines)
{
	const size_t nx = hull->station_count;
	const size_t nz = hull->waterline_count;
	return waterlines ? (struct walk){ hull, hull->x_m, nz, nx, nx, 1 }
	                  : (struct walk){ hull, hull->z_m, nx, nz, 1, nx };
}

/* The piece of a line that begins at *first or later: its given points, into nodes and along_m where those
 * are not NULL. Returns how many; *first: where the next one begins. */
static size_t next_piece(const struct walk *walk, size_t line, size_t *first, size_t *nodes,
                         double *along_m, size_t stride)
{
	size_t count = 0;
	for (; *first < walk->length; ++*first) {
		const size_t node = line * walk->line_step + *first * walk->step;
		if (walk->hull->nodes[node] == BATTEN_NODE_OUTSIDE && count > 0)
			break;
		if (walk->hull->nodes[node] != BATTEN_NODE_GIVEN)
			continue;
		if (nodes) {
			nodes[count * stride] = node;
			along_m[count * stride] = walk->at_m[*first];
		}
		count++;
	}
	return count;
}

static void count_pieces(const struct walk *walk, size_t *pieces, size_t *longest)
{
	for (size_t line = 0; line < walk->lines; line++)
		for (size_t first = 0, count = 0; first < walk->length;) {
			count = next_piece(walk, line, &first, NULL, NULL, 0);
			*pieces += count > 0;
			*longest = count > *longest ? count : *longest;
		}
}

/* What the differences of a lane take from its coordinates, which stand where its slopes will. */
static void lay_lane(grid_lines *t, size_t lane)
{
	const size_t stride = t->lane_count;
	const size_t count = t->count[lane];
	for (size_t i = 0; i < t->point_count; i++) {
		const size_t at = i * stride + lane;
		const double *here = &t->slope[at];
		t->step_m[at] = t->half_span_m[at] = t->rounding_per_m2[at] = 1.0;
		if (i + 1 < count)
			t->step_m[at] = here[stride] - here[0];
		if (i >= count)
			t->node[at] = count > 0 ? t->node[at - stride] : 0;
		else
			t->along_most_m[lane] = fmax(t->along_most_m[lane], fabs(here[0]));
		if (i == 0 || i + 1 >= count)
			continue;
		const double left = t->step_m[at - stride];
		const double right = t->step_m[at];
		t->half_span_m[at] = 0.5 * (here[stride] - *(here - stride));
		t->rounding_per_m2[at] = (1 / left + 1 / right) / (0.5 * (left + right));
		t->inside[at] = 1.0;
	}
}

/* Runs whose nodes stand side by side are read as vectors, others node by node. */
static void find_order(grid_lines *t)
{
	for (size_t run = 0; run < t->point_count * t->lane_count / RUN_LENGTH; run++) {
		const size_t *node = t->node + run * RUN_LENGTH;
		t->in_order[run] = 1;
		for (size_t l = 1; l < RUN_LENGTH; l++)
			t->in_order[run] &= node[l] == node[0] + l;
	}
}

static void lay_pieces(const struct walk *walk, grid_lines *t)
{
	size_t lane = 0;
	for (size_t line = 0; line < walk->lines; line++)
		for (size_t first = 0; first < walk->length;) {
			const size_t count = next_piece(walk, line, &first, t->node + lane, t->slope + lane,
			                                t->lane_count);
			if (count == 0)
				continue;
			t->line[lane] = line;
			t->count[lane++] = count;
		}
	for (lane = 0; lane < t->lane_count; lane++)
		lay_lane(t, lane);
	find_order(t);
}

/* Lanes are as long as the longest piece: of many short pieces and a long one most would stay empty. Tables
 * of very many nodes are those of single hulls, whose lines need no such memory one by one. */
static bool fits(const grid_lines *table, const batten_hull *hull)
{
	const size_t room = table->lane_count * table->point_count;
	return room <= NUMBERS_MOST &&
	       room <= 4 * (hull_node_count(hull) +
	                    RUN_LENGTH * (hull->station_count + hull->waterline_count));
}

static batten_status take_memory(grid_lines *t)
{
	const size_t lanes = t->lane_count;
	const size_t each = lanes * t->point_count;
	t->line = batten_allocate(t->context, lanes, 2 * sizeof *t->line);
	t->node = batten_allocate(t->context, each, sizeof *t->node);
	t->in_order = batten_allocate(t->context, each / RUN_LENGTH, 1);
	t->memory = batten_allocate(t->context, LANE_ARRAYS * lanes + POINT_ARRAYS * each,
	                            sizeof *t->memory);
	if (!t->line || !t->node || !t->in_order || !t->memory)
		return BATTEN_MEMORY;
	t->count = t->line + lanes;
	double **points[POINT_ARRAYS] = { &t->step_m, &t->half_span_m, &t->rounding_per_m2,
		                              &t->inside, &t->value_m,     &t->slope };
	double **by_lane[LANE_ARRAYS] = { &t->along_most_m, &t->fn_per_m2, &t->changes };
	for (size_t k = 0; k < POINT_ARRAYS; k++)
		*points[k] = t->memory + k * each;
	for (size_t k = 0; k < LANE_ARRAYS; k++)
		*by_lane[k] = t->memory + POINT_ARRAYS * each + k * lanes;
	return BATTEN_OK;
}

batten_status grid_lines_create(batten_context *context, const batten_hull *hull, bool waterlines,
                                grid_lines **out)
{
	grid_lines *table = batten_allocate(context, 1, sizeof *table);
	*out = NULL;
	if (!table)
		return BATTEN_MEMORY;
	const struct walk walk = walk_along(hull, waterlines);
	size_t pieces = 0;
	table->context = context;
	count_pieces(&walk, &pieces, &table->point_count);
	table->lane_count = (pieces + RUN_LENGTH - 1) / RUN_LENGTH * RUN_LENGTH;
	const bool sound = fits(table, hull);
	const batten_status status = sound ? take_memory(table) : BATTEN_OK;
	if (!sound || status != BATTEN_OK) {
		grid_lines_destroy(table);
		return status;
	}
	lay_pieces(&walk, table);
	*out = table;
	return BATTEN_OK;
}

void grid_lines_destroy(grid_lines *table)
{
	if (!table)
		return;
	batten_release(table->context, table->line);
	batten_release(table->context, table->node);
	batten_release(table->context, table->in_order);
	batten_release(table->context, table->memory);
	batten_release(table->context, table);
}

/* ---- a hull ---- */

INLINED void read_run(const double *y_m, const size_t *node, bool in_order, double *value)
{
	if (in_order) {
		const double *first = y_m + node[0];
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++)
			value[l] = first[l];
	} else {
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++)
			value[l] = y_m[node[l]];
	}
}

/* Values and slopes of the lanes from lane on, and what a value may be off by through rounding of its
 * coordinates, as in lines_inflections(). */
INLINED void take_slopes(const grid_lines *t, const double *y_m, size_t lane, double *rounding_m)
{
	const size_t stride = t->lane_count;
	double value_most[RUN_LENGTH] = { 0 }, slope_most[RUN_LENGTH] = { 0 };
	for (size_t i = 0; i < t->point_count; i++) {
		const size_t *node = t->node + i * stride + lane;
		double *value = t->value_m + i * stride + lane;
		read_run(y_m, node, t->in_order[(i * stride + lane) / RUN_LENGTH], value);
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++)
			value_most[l] = fabs(value[l]) > value_most[l] ? fabs(value[l]) : value_most[l];
	}
	for (size_t i = 0; i + 1 < t->point_count; i++) {
		const size_t at = i * stride + lane;
		const double *value = t->value_m + at, *next = value + stride, *step = t->step_m + at;
		double slope[RUN_LENGTH];
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++) {
			slope[l] = (next[l] - value[l]) / step[l];
			slope_most[l] = fabs(slope[l]) > slope_most[l] ? fabs(slope[l]) : slope_most[l];
		}
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++)
			t->slope[at + l] = slope[l];
	}
	RUN_LOOP
	for (size_t l = 0; l < RUN_LENGTH; l++)
		rounding_m[l] = 8 * DBL_EPSILON *
		                (value_most[l] + slope_most[l] * t->along_most_m[lane + l]);
}

INLINED void take_lanes(const grid_lines *t, const double *y_m, size_t lane)
{
	const size_t stride = t->lane_count;
	double rounding[RUN_LENGTH], fn[RUN_LENGTH] = { 0 }, last[RUN_LENGTH] = { 0 };
	double changes[RUN_LENGTH] = { 0 };
	take_slopes(t, y_m, lane, rounding);
	for (size_t i = 1; i + 1 < t->point_count; i++) {
		const size_t at = i * stride + lane;
		const double *right = t->slope + at, *left = right - stride, *inside = t->inside + at;
		const double *half = t->half_span_m + at, *per_m2 = t->rounding_per_m2 + at;
		RUN_LOOP
		for (size_t l = 0; l < RUN_LENGTH; l++) {
			const double d2 = (right[l] - left[l]) / half[l];
			const double least = rounding[l] * per_m2[l];
			const double here = inside[l] > 0 ? d2 : 0.0;
			const double turned = here * last[l] < 0 ? 1.0 : 0.0;
			const double told = fabs(here) > least ? 1.0 : 0.0;
			fn[l] += here * here;
			changes[l] += told * turned;
			last[l] = told > 0 ? (here > 0 ? 1.0 : -1.0) : last[l];
		}
	}
	RUN_LOOP
	for (size_t l = 0; l < RUN_LENGTH; l++) {
		t->fn_per_m2[lane + l] = fn[l];
		t->changes[lane + l] = changes[l];
	}
}

INLINED void take_all(const grid_lines *t, const double *y_m)
{
	for (size_t lane = 0; lane < t->lane_count; lane += RUN_LENGTH)
		take_lanes(t, y_m, lane);
}

RUNS_FUNCTION(work_lanes, take_all, (const grid_lines *t, const double *y_m), (t, y_m))

lines_sum grid_lines_sum(grid_lines *table, const double *y_m)
{
	lines_sum total = { 0 };
	work_lanes(table, y_m);
	for (size_t lane = 0; lane < table->lane_count;) {
		const size_t line = table->line[lane];
		double fn_per_m2 = 0;
		for (; lane < table->lane_count && table->line[lane] == line; lane++) {
			const size_t count = table->count[lane];
			fn_per_m2 += table->fn_per_m2[lane];
			total.interior_count += count > 2 ? count - 2 : 0;
			total.inflections += count > 3 ? (size_t)table->changes[lane] : 0;
		}
		total.fn_per_m2 += fn_per_m2;
	}
	if (total.interior_count == 0)
		total.fn_per_m2 = NAN;
	return total;
}
