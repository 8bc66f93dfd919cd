#include "batch/block_hats.h"

#include <math.h>

#define BATTEN_DIALECT_C
#define BATTEN_DOUBLE 1
#include "shared/dialect.h"
#include "shared/grid_energy.h"

enum { MOST_SPANS = 32, LEAST_NODES = 2 };

/* How much of the closeness of an offset the coupling of lines must be for hats, and for rounds
 * (bench/README.md, what was tried). */
#define COUPLED 1.0
#define SOMEWHAT_COUPLED 0.1
/* From here on hats on cells longer than so many times their width need no rounds. */
#define MUCH_COUPLED 4.0
#define STRETCHED 2.0

/* On larger tables the state of a group leaves the caches, and rounds of lines alone wait for it longer than the
 * iterations take that they save. */
enum { ROUNDS_NODES = 4096 };
enum { ROUNDS = 3, ROUNDS_OF_STRETCHED_HATS = 2 };

static double spacing_across(const search_plan *plan)
{
	return fmax(plan->spacing_x, plan->spacing_z);
}

/* Spans of a line. */
static size_t span_count(const search_plan *plan)
{
	const size_t intervals = block_lines_of(plan).length - 1;
	const double ratio = round(spacing_across(plan) / fmin(plan->spacing_x, plan->spacing_z));
	size_t nodes = ratio < (double)intervals ? (size_t)ratio : intervals;
	if (nodes < LEAST_NODES)
		nodes = LEAST_NODES;
	if (nodes < (intervals + MOST_SPANS - 1) / MOST_SPANS)
		nodes = (intervals + MOST_SPANS - 1) / MOST_SPANS;
	const size_t spans = intervals / nodes;
	return spans > 0 ? spans : 1;
}

size_t block_hat_count(const search_plan *plan)
{
	const size_t hats = span_count(plan) + 2;
	return hats < BLOCK_HATS_MET ? BLOCK_HATS_MET : hats;
}

/* The node at which span `span` of spans, at least one, begins. */
static size_t knot_of(size_t span, size_t spans, size_t intervals)
{
	return spans > 0 ? (span * intervals + spans / 2) / spans : 0;
}

/* The span of a node. */
static size_t span_of(size_t node, size_t spans, size_t intervals)
{
	size_t span = 0;
	while (span + 1 < spans && knot_of(span + 1, spans, intervals) <= node)
		span++;
	return span;
}

/* A line's nodes and spans. */
typedef struct line_spans {
	const double *at; /* coordinates of the nodes */
	size_t intervals, spans;
} line_spans;

/* Knot `number` of the quadratic B-splines, the ends thrice; number 2 is the beginning. */
static double knot_at(const line_spans *line, size_t number)
{
	const size_t span = number < 2 ? 0 : number - 2;
	return line->at[knot_of(span < line->spans ? span : line->spans, line->spans, line->intervals)];
}

/* The three B-splines that are not 0 at a node of a span (the recurrence of Cox and de Boor). */
static void spline_values(const line_spans *line, size_t span, double at, double values[3])
{
	const double t_1 = knot_at(line, span + 1), t_2 = knot_at(line, span + 2);
	const double t_3 = knot_at(line, span + 3), t_4 = knot_at(line, span + 4);
	const double rise = (at - t_2) / (t_3 - t_2);
	const double last = (at - t_2) / (t_4 - t_2);
	const double first = (t_3 - at) / (t_3 - t_1);
	values[0] = first * (1.0 - rise);
	values[2] = last * rise;
	values[1] = 1.0 - values[0] - values[2];
}

/* Values at a node of the hats from `first` on. */
static void values_at(const line_spans *line, size_t node, size_t first,
                      double values[BLOCK_HATS_MET])
{
	const size_t span = span_of(node, line->spans, line->intervals);
	double three[3];
	spline_values(line, span, line->at[node], three);
	for (size_t j = 0; j < BLOCK_HATS_MET; j++)
		values[j] = first + j >= span && first + j - span < 3 ? three[first + j - span] : 0.0;
}

/* The first hat that is not 0 at a node or beside it, in a window that ends with the last hat. */
static size_t first_hat(const line_spans *line, size_t node, size_t hats)
{
	const size_t first = span_of(node > 0 ? node - 1 : 0, line->spans, line->intervals);
	return first > hats - BLOCK_HATS_MET ? hats - BLOCK_HATS_MET : first;
}

/* What the nodes below, at and above a node add to its differences. */
static void difference_values(const line_spans *line, size_t node, const double w[STENCIL_SIZE],
                              double *v)
{
	const size_t first = (size_t)v[BLOCK_HAT_FIRST];
	const double once[3] = { -w[0], w[0] - w[1], w[1] };
	const double twice[3] = { w[2], -(w[2] + w[3]), w[3] };
	for (size_t b = 0; b < 3; b++) {
		double beside[BLOCK_HATS_MET];
		values_at(line, node + b - 1, first, beside);
		for (size_t j = 0; j < BLOCK_HATS_MET; j++) {
			v[BLOCK_HAT_ONCE + b * BLOCK_HATS_MET + j] = once[b] * beside[j];
			v[BLOCK_HAT_TWICE + b * BLOCK_HATS_MET + j] = twice[b] * beside[j];
			if (beside[j] != 0.0)
				v[BLOCK_HAT_COUNT] = fmax(v[BLOCK_HAT_COUNT], (double)(j + 1));
		}
	}
}

void block_hat_values(const search_plan *plan, double *values)
{
	const block_lines_shape shape = block_lines_of(plan);
	const line_spans line = { shape.along_x ? plan->x_m : plan->z_m, shape.length - 1,
		                      span_count(plan) };
	const double *stencils = shape.along_x ? plan->stencil_x : plan->stencil_z;
	const size_t hats = block_hat_count(plan);
	for (size_t k = 0; k < shape.length; k++) {
		double *v = values + k * BLOCK_HAT_SIZE;
		for (size_t j = 0; j < BLOCK_HAT_SIZE; j++)
			v[j] = 0.0;
		v[BLOCK_HAT_FIRST] = (double)first_hat(&line, k, hats);
		values_at(&line, k, (size_t)v[BLOCK_HAT_FIRST], v + BLOCK_HAT_VALUE);
		if (k > 0 && k + 1 < shape.length)
			difference_values(&line, k, stencils + k * STENCIL_SIZE, v);
	}
}

static size_t round_count(const search_plan *plan, double coupling, bool hats)
{
	const double least = fmin(plan->spacing_x, plan->spacing_z);
	if (hats && spacing_across(plan) < STRETCHED * least)
		return ROUNDS;
	if (hats)
		return coupling < MUCH_COUPLED ? ROUNDS_OF_STRETCHED_HATS : 0;
	const bool small = plan->station_count * plan->waterline_count <= ROUNDS_NODES;
	return small && coupling > SOMEWHAT_COUPLED ? ROUNDS : 0;
}

block_course block_course_of(const search_plan *plan, const batten_search_problem *problem)
{
	const double apart = spacing_across(plan) / problem->half_beam_m;
	const double held = problem->w2 * (apart * apart) * (apart * apart);
	const double coupling = held > 0.0 ? problem->w1 / held : HUGE_VAL;
	block_course course;
	course.hats = coupling > COUPLED ? block_hat_count(plan) : 0;
	course.rounds = round_count(plan, coupling, course.hats > 0);
	return course;
}
