/* Volume, areas, centres, coefficients kept (thesis 7.1: constraints). A multiplier of a measure adds to
 * the objective what is linear in the half-breadths, as far as the measure is; closeness to a target that
 * is shifted adds the same. So the searches stay as they are, on every device: multipliers are found by
 * Newton's method over whole searches, each from where the last one ended. */
#include "fairing/kept.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Hulls measured in one batch; searches before the measures count as not to be met; the part of a
 * tolerance that is aimed at, and the least that is taken, where a measure lies at the end of it. */
enum { MEASURED_AT_ONCE = 64, ROUND_LIMIT = 40 };
#define AIM 0.95
#define AT_END 0.9
/* Part of the half-beam that a half-breadth is moved by to see what a measure does. */
#define NUDGE 1e-4
/* No target goes further from its hull than so many half-beams. */
#define FARTHEST 1e6

typedef struct matrix {
	double a[BATTEN_KEEP_LIMIT][BATTEN_KEEP_LIMIT];
} matrix;

/* Measures are counted in tolerances from what they are to be: within -1 .. 1. */
typedef struct task {
	batten_fairing *fairing;
	const batten_fair_options *options;
	const fairing_box *box;
	batten_hull *hull; /* scratch */
	size_t nodes, count;
	double *y, *moved; /* where the search is; MEASURED_AT_ONCE hulls beside it */
	batten_hydrostatics *found;
	double *slopes; /* [count][nodes]: tolerances a metre */
	double *gives;  /* [nodes]: how far closeness alone lets a half-breadth go, a unit of slope */
	double value[BATTEN_KEEP_LIMIT], multiplier[BATTEN_KEEP_LIMIT];
	int side[BATTEN_KEEP_LIMIT]; /* which end a measure is held at; 0: none */
	matrix response;             /* how measures fall with the multipliers */
} task;

batten_status fairing_end_check(batten_context *context, const batten_fair_options *options)
{
	if (!(options->polish_gap >= 0.0) || !isfinite(options->polish_gap))
		return batten_fail(context, BATTEN_USAGE,
		                   "found a gap of %g to polish to, expected 0 or more",
		                   options->polish_gap);
	if (options->polish_gap > 0.0 &&
	    (options->method != BATTEN_METHOD_SEARCH || options->keep_count > 0))
		return batten_fail(context, BATTEN_USAGE,
		                   "only a search that keeps no measures is polished");
	if (options->polish_gap > 0.0 && options->search.interior_penalty)
		return batten_fail(
			context, BATTEN_USAGE,
			"an interior penalty ends inside the box: it is not polished, by steps that "
			"end at bounds");
	if (options->keep_count == 0)
		return BATTEN_OK;
	if (options->keep_count > BATTEN_KEEP_LIMIT)
		return batten_fail(context, BATTEN_USAGE, "%zu measures to keep, at most %d are expected",
		                   options->keep_count, BATTEN_KEEP_LIMIT);
	if (options->variables != BATTEN_VARIABLES_OFFSETS || options->method != BATTEN_METHOD_SEARCH)
		return batten_fail(context, BATTEN_USAGE,
		                   "measures are kept by the search over offsets only");
	if (options->weights_given && options->w2 == 0.0)
		return batten_fail(context, BATTEN_USAGE,
		                   "measures are kept by way of closeness: w2 above 0 is expected");
	for (size_t i = 0; i < options->keep_count; i++) {
		const batten_keep *keep = &options->keep[i];
		if (keep->quantity >= BATTEN_HYDROSTATICS_COUNT)
			return batten_fail(context, BATTEN_USAGE, "found quantity %zu to keep, which is none",
			                   keep->quantity);
		if (!(keep->tolerance > 0.0) || !isfinite(keep->tolerance))
			return batten_fail(context, BATTEN_USAGE,
			                   "%s is kept within a tolerance above 0, found %g",
			                   batten_hydrostatics_name(keep->quantity), keep->tolerance);
		for (size_t j = 0; j < i; j++)
			if (options->keep[j].quantity == keep->quantity)
				return batten_fail(context, BATTEN_USAGE, "%s is to be kept twice",
				                   batten_hydrostatics_name(keep->quantity));
	}
	return BATTEN_OK;
}

static double quantity_of(const batten_hydrostatics *found, size_t quantity)
{
	double values[BATTEN_HYDROSTATICS_COUNT];
	memcpy(values, found, sizeof values);
	return values[quantity];
}

/* y as it is measured: with its '?' filled. */
static batten_status fill(task *t, const double *y, double *filled)
{
	size_t count = 0;
	memcpy(t->hull->y_m, y, t->nodes * sizeof *y);
	const batten_status status = hull_fill_unknown(t->hull, &count);
	memcpy(filled, t->hull->y_m, t->nodes * sizeof *y);
	return status;
}

/* The first `count` hulls of moved into found. The C path, whatever searches: the same on all. */
static batten_status measure_moved(task *t, size_t count)
{
	batten_batch_options batch;
	batten_batch_options_default(&batch);
	batch.device = BATTEN_DEVICE_REFERENCE;
	return batten_hull_hydrostatics_batch(t->fairing->context, t->hull, NULL, &batch, count,
	                                      t->moved, NULL, 1, &t->hull->draft_m, t->found, NULL);
}

static batten_status measure(task *t, const double *y, double *values)
{
	batten_status status = fill(t, y, t->moved);
	if (status == BATTEN_OK)
		status = measure_moved(t, 1);
	for (size_t i = 0; i < t->count && status == BATTEN_OK; i++)
		values[i] = quantity_of(&t->found[0], t->options->keep[i].quantity);
	return status;
}

static double in_tolerances(const task *t, size_t i, double value)
{
	const batten_kept *kept = &t->fairing->kept[i];
	return (value - kept->wanted) / kept->tolerance;
}

static batten_status measure_here(task *t)
{
	double values[BATTEN_KEEP_LIMIT];
	const batten_status status = measure(t, t->y, values);
	for (size_t i = 0; i < t->count && status == BATTEN_OK; i++) {
		t->fairing->kept[i].value = values[i];
		t->value[i] = in_tolerances(t, i, values[i]);
	}
	return status;
}

/* What is kept: the measures of the smoothed hull. */
static batten_status want(task *t)
{
	batten_fairing *fairing = t->fairing;
	double values[BATTEN_KEEP_LIMIT];
	const batten_status status = measure(t, fairing->smoothed->y_m, values);
	fairing->kept_count = t->count;
	for (size_t i = 0; i < t->count && status == BATTEN_OK; i++) {
		const batten_keep *keep = &t->options->keep[i];
		const double part = keep->is_part ? fabs(values[i]) : 1.0;
		fairing->kept[i] = (batten_kept){ .quantity = keep->quantity,
			                              .wanted = values[i],
			                              .tolerance = part * keep->tolerance };
		if (!isfinite(values[i]) || !(fairing->kept[i].tolerance > 0.0))
			return batten_fail(fairing->context, BATTEN_INPUT,
			                   "%s: %s is %g: it cannot be kept within such a tolerance",
			                   fairing->smoothed->name, batten_hydrostatics_name(keep->quantity),
			                   values[i]);
	}
	return status;
}

/* Slopes along the variables first to first + count of `which`. */
static batten_status find_some_slopes(task *t, const size_t *which, size_t count, double nudge)
{
	batten_status status = BATTEN_OK;
	for (size_t v = 0; v < count && status == BATTEN_OK; v++) {
		const double old = t->y[which[v]];
		t->y[which[v]] = old + nudge;
		status = fill(t, t->y, t->moved + v * t->nodes);
		t->y[which[v]] = old;
	}
	if (status == BATTEN_OK)
		status = measure_moved(t, count);
	for (size_t v = 0; v < count && status == BATTEN_OK; v++)
		for (size_t i = 0; i < t->count; i++) {
			const double value = in_tolerances(
				t, i, quantity_of(&t->found[v], t->options->keep[i].quantity));
			t->slopes[i * t->nodes + which[v]] = (value - t->value[i]) / nudge;
		}
	return status;
}

static batten_status find_slopes(task *t)
{
	const double nudge = NUDGE * batten_hull_half_beam_m(t->fairing->smoothed);
	size_t which[MEASURED_AT_ONCE], count = 0;
	batten_status status = BATTEN_OK;
	for (size_t n = 0; n < t->nodes && status == BATTEN_OK; n++) {
		if (t->box->lower_m[n] < t->box->upper_m[n])
			which[count++] = n;
		if (count == MEASURED_AT_ONCE || (count > 0 && n + 1 == t->nodes)) {
			status = find_some_slopes(t, which, count, nudge);
			count = 0;
		}
	}
	return status;
}

static double half_sum(const double *x, size_t i, size_t count)
{
	return ((i + 1 < count ? x[i + 1] : x[i]) - (i > 0 ? x[i - 1] : x[i])) / 2.0;
}

/* Of w2 closeness / h^4, 1 / (second derivative) at each variable; 0 where closeness has no say. */
static void find_gives(task *t, const batten_search_problem *problem)
{
	const batten_hull *hull = t->hull;
	const double h2 = problem->half_beam_m * problem->half_beam_m;
	for (size_t k = 0; k < hull->waterline_count; k++)
		for (size_t i = 0; i < hull->station_count; i++) {
			const size_t n = k * hull->station_count + i;
			const double cell = half_sum(hull->x_m, i, hull->station_count) *
			                    half_sum(hull->z_m, k, hull->waterline_count);
			const double close = problem->w2 * t->box->closeness_weight[n] * cell / (h2 * h2);
			const bool varies = t->box->lower_m[n] < t->box->upper_m[n] && close > 0.0;
			t->gives[n] = varies ? 0.5 / close : 0.0;
		}
}

/* Bending resists little of a change as even as a measure's slopes: closeness alone is the first
 * guess. */
static void guess_response(task *t)
{
	for (size_t i = 0; i < t->count; i++)
		for (size_t j = 0; j < t->count; j++) {
			double sum = 0.0;
			for (size_t n = 0; n < t->nodes; n++)
				sum += t->slopes[i * t->nodes + n] * t->gives[n] * t->slopes[j * t->nodes + n];
			t->response.a[i][j] = sum;
		}
}

/* Whether the bounds of the offsets let every measure, by itself, come within its tolerance. */
static batten_status check_reach(const task *t)
{
	for (size_t i = 0; i < t->count; i++) {
		double least = t->value[i], most = t->value[i];
		for (size_t n = 0; n < t->nodes; n++) {
			const double slope = t->slopes[i * t->nodes + n];
			const double down = slope * (t->box->lower_m[n] - t->y[n]);
			const double up = slope * (t->box->upper_m[n] - t->y[n]);
			least += fmin(down, up);
			most += fmax(down, up);
		}
		const batten_kept *kept = &t->fairing->kept[i];
		if (most < -1.0 || least > 1.0)
			return batten_fail(
				t->fairing->context, BATTEN_INPUT,
				"%s: %s cannot be kept at %.6g within %.3g: the bounds of the offsets allow "
				"%.6g to %.6g",
				t->fairing->smoothed->name, batten_hydrostatics_name(kept->quantity), kept->wanted,
				kept->tolerance, kept->wanted + least * kept->tolerance,
				kept->wanted + most * kept->tolerance);
	}
	return BATTEN_OK;
}

/* Measures beyond an end are held there from now on. Returns whether all is as it should be. */
static bool judge(task *t)
{
	bool good = true;
	for (size_t i = 0; i < t->count; i++) {
		if (t->side[i] == 0 && fabs(t->value[i]) > 1.0)
			t->side[i] = t->value[i] > 0.0 ? 1 : -1;
		const double held = t->side[i] * t->value[i];
		good = good && (t->side[i] == 0 ? fabs(t->value[i]) <= 1.0 : held >= AT_END && held <= 1.0);
	}
	return good;
}

/* Solves for the held measures by elimination with the largest pivots; false: they hang together. */
static bool solve(const task *t, double *change)
{
	matrix m = t->response;
	double right[BATTEN_KEEP_LIMIT];
	size_t rows[BATTEN_KEEP_LIMIT], count = 0;
	for (size_t i = 0; i < t->count; i++) {
		change[i] = 0.0;
		right[i] = t->value[i] - AIM * t->side[i];
		if (t->side[i] != 0)
			rows[count++] = i;
	}
	size_t columns[BATTEN_KEEP_LIMIT];
	memcpy(columns, rows, sizeof columns);
	for (size_t p = 0; p < count; p++) {
		size_t best = p;
		for (size_t r = p; r < count; r++)
			if (fabs(m.a[rows[r]][columns[p]]) > fabs(m.a[rows[best]][columns[p]]))
				best = r;
		const size_t row = rows[best];
		rows[best] = rows[p];
		rows[p] = row;
		const double pivot = m.a[row][columns[p]];
		if (!(fabs(pivot) > 1e-12 * fabs(t->response.a[row][row])))
			return false;
		for (size_t r = p + 1; r < count; r++) {
			const double part = m.a[rows[r]][columns[p]] / pivot;
			for (size_t c = p; c < count; c++)
				m.a[rows[r]][columns[c]] -= part * m.a[row][columns[c]];
			right[rows[r]] -= part * right[row];
		}
	}
	for (size_t p = count; p-- > 0;) {
		double sum = right[rows[p]];
		for (size_t c = p + 1; c < count; c++)
			sum -= m.a[rows[p]][columns[c]] * change[columns[c]];
		change[columns[p]] = sum / m.a[rows[p]][columns[p]];
	}
	return true;
}

/* The next multipliers; a measure that would be pulled away from its end is held no more. */
static bool choose(task *t, double *change)
{
	for (size_t tries = 0; tries <= t->count; tries++) {
		bool all = true;
		if (!solve(t, change))
			return false;
		for (size_t i = 0; i < t->count; i++)
			if (t->side[i] != 0 && t->side[i] * (t->multiplier[i] + change[i]) < 0.0) {
				t->side[i] = 0;
				all = false;
			}
		for (size_t i = 0; i < t->count; i++)
			if (t->side[i] == 0)
				change[i] = -t->multiplier[i];
		if (all)
			return true;
	}
	return true;
}

/* Where closeness pulls to with these multipliers; false: beyond all measure. */
static bool aim_at(const task *t, double *target)
{
	const double *start = t->fairing->smoothed->y_m;
	const double farthest = FARTHEST * batten_hull_half_beam_m(t->fairing->smoothed);
	for (size_t n = 0; n < t->nodes; n++) {
		double shift = 0.0;
		for (size_t i = 0; i < t->count; i++)
			shift += t->multiplier[i] * t->slopes[i * t->nodes + n];
		target[n] = start[n] - t->gives[n] * shift;
		if (!(fabs(target[n]) <= farthest))
			return false;
	}
	return true;
}

/* What the last change of the multipliers did, put into the response (Broyden). */
static void learn(task *t, const double *before, const double *change)
{
	double square = 0.0;
	for (size_t j = 0; j < t->count; j++)
		square += change[j] * change[j] * t->response.a[j][j] * t->response.a[j][j];
	if (!(square > 0.0))
		return;
	for (size_t i = 0; i < t->count; i++) {
		double fell = before[i] - t->value[i];
		for (size_t j = 0; j < t->count; j++)
			fell -= t->response.a[i][j] * change[j];
		for (size_t j = 0; j < t->count; j++)
			t->response.a[i][j] += fell * change[j] * t->response.a[j][j] * t->response.a[j][j] /
			                       square;
	}
}

static batten_status fail_to_meet(const task *t)
{
	char names[320] = "";
	for (size_t i = 0; i < t->count; i++)
		if (t->side[i] != 0 || fabs(t->value[i]) > 1.0) {
			const size_t used = strlen(names);
			(void)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
			               batten_hydrostatics_name(t->options->keep[i].quantity));
		}
	return batten_fail(t->fairing->context, BATTEN_INPUT,
	                   "%s: these are not to be kept together within the bounds of the offsets: %s",
	                   t->fairing->smoothed->name, names);
}

static batten_status search_again(task *t, const batten_search_options *search,
                                  const batten_search_problem *problem,
                                  batten_search_result *result)
{
	batten_fairing *fairing = t->fairing;
	const batten_grid grid = { t->hull->station_count, t->hull->waterline_count, t->hull->x_m,
		                       t->hull->z_m };
	const batten_search_result before = *result;
	const double seconds = fairing->run.seconds;
	batten_search_problem from = *problem;
	from.start_m = t->moved;
	memcpy(t->moved, t->y, t->nodes * sizeof *t->y);
	const batten_status status = batten_search_batch(fairing->context, &grid, 1, &from, search,
	                                                 t->y, result, &fairing->run);
	result->iterations += before.iterations;
	result->probes += before.probes;
	fairing->run.seconds += seconds;
	return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
}

static batten_status meet(task *t, const batten_search_options *search, double *target,
                          const batten_search_problem *problem, batten_search_result *result)
{
	batten_search_problem shifted = *problem;
	shifted.target_m = target;
	for (unsigned round = 1; round <= ROUND_LIMIT; round++) {
		double change[BATTEN_KEEP_LIMIT], before[BATTEN_KEEP_LIMIT];
		if (!choose(t, change))
			break;
		memcpy(before, t->value, sizeof before);
		for (size_t i = 0; i < t->count; i++)
			t->multiplier[i] += change[i];
		if (!aim_at(t, target))
			break;
		batten_status status = search_again(t, search, &shifted, result);
		if (status == BATTEN_OK)
			status = measure_here(t);
		t->fairing->kept_rounds = round;
		if (status != BATTEN_OK || judge(t))
			return status;
		learn(t, before, change);
	}
	return fail_to_meet(t);
}

static batten_status keep(task *t, const batten_search_options *search, double *target,
                          batten_search_problem *problem, batten_search_result *result)
{
	batten_status status = want(t);
	if (status == BATTEN_OK)
		status = measure_here(t);
	if (status != BATTEN_OK || judge(t))
		return status;
	status = find_slopes(t);
	if (status == BATTEN_OK)
		status = check_reach(t);
	if (status != BATTEN_OK)
		return status;
	find_gives(t, problem);
	guess_response(t);
	status = meet(t, search, target, problem, result);
	for (size_t i = 0; i < t->count; i++)
		t->fairing->kept[i].multiplier = t->multiplier[i] / t->fairing->kept[i].tolerance;
	problem->target_m = target;
	return status;
}

batten_status fairing_keep(batten_fairing *fairing, const batten_fair_options *options,
                           const fairing_box *box, const batten_search_options *search,
                           double *target_m, batten_search_problem *problem, double *y,
                           batten_search_result *result)
{
	batten_context *context = fairing->context;
	task t = { .fairing = fairing, .options = options, .box = box, .y = y };
	t.nodes = hull_node_count(fairing->smoothed);
	t.count = options->keep_count;
	batten_status status = batten_hull_clone(context, fairing->smoothed, &t.hull);
	t.moved = batten_allocate(context, MEASURED_AT_ONCE * t.nodes, sizeof *t.moved);
	t.found = batten_allocate(context, MEASURED_AT_ONCE, sizeof *t.found);
	t.slopes = batten_allocate(context, t.count * t.nodes, sizeof *t.slopes);
	t.gives = batten_allocate(context, t.nodes, sizeof *t.gives);
	if (status == BATTEN_OK && (!t.moved || !t.found || !t.slopes || !t.gives))
		status = BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = keep(&t, search, target_m, problem, result);
	batten_hull_destroy(t.hull);
	batten_release(context, t.moved);
	batten_release(context, t.found);
	batten_release(context, t.slopes);
	batten_release(context, t.gives);
	return status;
}
