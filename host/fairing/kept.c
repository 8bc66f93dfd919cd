/* Volume, areas, centres, coefficients kept (thesis 7.1: constraints). A multiplier of a measure adds to
 * the objective what is linear in the half-breadths, as far as the measure is; closeness to a target that
 * is shifted adds the same. So the searches stay as they are, on every device: multipliers are found by
 * Newton's method over whole searches, each from where the last one ended. */
#include "fairing/kept.h"

#include "fairing/kept_state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Hulls measured in one batch; searches of each way to the multipliers, before these count as not found. */
enum { MEASURED_AT_ONCE = 64, ROUND_LIMIT = 40 };
/* Part of the half-beam that a half-breadth is moved by to see what a measure does. */
#define NUDGE 1e-4
/* So many tolerances from where it is to be, a measure tells no step that goes too far from the unevenness
 * of the searches' ends. */
#define NEAR 30.0
/* An offset that f32 left rounding from a bound. */
#define ROUNDING 0x1p-22
/* No target goes further from its hull than so many half-beams. */
#define FARTHEST 1e6

/* Measures are counted in tolerances from what they are to be: within -1 .. 1. */
typedef struct task {
	batten_fairing *fairing;
	const batten_fair_options *options;
	const fairing_box *box;
	batten_hull *hull; /* scratch */
	size_t nodes;
	double *y, *moved; /* where the search is; MEASURED_AT_ONCE hulls beside it */
	batten_hydrostatics *found;
	double *slopes; /* [count][nodes]: tolerances a metre */
	double *gives;  /* [nodes]: how far closeness alone lets a half-breadth go, a unit of slope */
	kept_state at;
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
	for (size_t i = 0; i < t->at.count && status == BATTEN_OK; i++)
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
	for (size_t i = 0; i < t->at.count && status == BATTEN_OK; i++) {
		t->fairing->kept[i].value = values[i];
		t->at.value[i] = in_tolerances(t, i, values[i]);
	}
	return status;
}

/* What is kept: the measures of the smoothed hull. */
static batten_status want(task *t)
{
	batten_fairing *fairing = t->fairing;
	double values[BATTEN_KEEP_LIMIT];
	const batten_status status = measure(t, fairing->smoothed->y_m, values);
	fairing->kept_count = t->at.count;
	for (size_t i = 0; i < t->at.count && status == BATTEN_OK; i++) {
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
		for (size_t i = 0; i < t->at.count; i++) {
			const double value = in_tolerances(
				t, i, quantity_of(&t->found[v], t->options->keep[i].quantity));
			t->slopes[i * t->nodes + which[v]] = (value - t->at.value[i]) / nudge;
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
	for (size_t i = 0; i < t->at.count; i++)
		for (size_t j = 0; j < t->at.count; j++) {
			double sum = 0.0;
			for (size_t n = 0; n < t->nodes; n++)
				sum += t->slopes[i * t->nodes + n] * t->gives[n] * t->slopes[j * t->nodes + n];
			t->at.response.a[i][j] = sum;
		}
}

/* Whether the bounds of the offsets let every measure, by itself, come within its tolerance. */
static batten_status check_reach(const task *t)
{
	for (size_t i = 0; i < t->at.count; i++) {
		double least = t->at.value[i], most = t->at.value[i];
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

/* Where closeness pulls to with these multipliers; false: beyond all measure. */
static bool aim_at(const task *t, double *target)
{
	const double *start = t->fairing->smoothed->y_m;
	const double farthest = FARTHEST * batten_hull_half_beam_m(t->fairing->smoothed);
	for (size_t n = 0; n < t->nodes; n++) {
		double shift = 0.0;
		for (size_t i = 0; i < t->at.count; i++)
			shift += t->at.multiplier[i] * t->slopes[i * t->nodes + n];
		target[n] = start[n] - t->gives[n] * shift;
		if (!(fabs(target[n]) <= farthest))
			return false;
	}
	return true;
}

static batten_status fail_to_meet(const task *t)
{
	char names[320] = "";
	for (size_t i = 0; i < t->at.count; i++)
		if (t->at.side[i] != 0 || fabs(t->at.value[i]) > 1.0) {
			const size_t used = strlen(names);
			(void)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
			               batten_hydrostatics_name(t->options->keep[i].quantity));
		}
	return batten_fail(t->fairing->context, BATTEN_INPUT,
	                   "%s: these were not met together within the bounds of the offsets, in %u "
	                   "searches: %s",
	                   t->fairing->smoothed->name, t->fairing->kept_rounds, names);
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

/* f32 rounds bounds: offsets that are held stand beside them, where a search in f64 would find them free and
 * in its way. */
static void put_on_bounds(task *t)
{
	for (size_t n = 0; n < t->nodes; n++) {
		const double near = ROUNDING * fabs(t->y[n]);
		if (t->y[n] <= t->box->lower_m[n] + near)
			t->y[n] = t->box->lower_m[n];
		else if (t->y[n] >= t->box->upper_m[n] - near)
			t->y[n] = t->box->upper_m[n];
	}
}

/* One way to the multipliers; `careful`: a step that leads no closer, often to where bounds hold all there
 * is, is halved. *met false: they were not found. nearest: where the measures came nearest. */
static batten_status follow(task *t, bool careful, const batten_search_options *search,
                            const batten_search_problem *shifted, double *target,
                            kept_state *nearest, batten_search_result *result, bool *met)
{
	double change[BATTEN_KEEP_LIMIT];
	kept_state base = t->at;
	bool closer = true;
	for (unsigned round = 1; round <= ROUND_LIMIT; round++) {
		for (size_t i = 0; i < t->at.count && !closer; i++)
			change[i] *= 0.5;
		if (closer) {
			base = t->at;
			if (!kept_choose(&t->at, change))
				break;
		}
		for (size_t i = 0; i < t->at.count; i++)
			t->at.multiplier[i] = base.multiplier[i] + change[i];
		if (!aim_at(t, target))
			break;
		batten_status status = search_again(t, search, shifted, result);
		if (status == BATTEN_OK)
			status = measure_here(t);
		t->fairing->kept_rounds++;
		*met = status == BATTEN_OK && kept_judge(&t->at);
		if (status != BATTEN_OK || *met)
			return status;
		kept_learn(&t->at, base.value, change);
		const double now = kept_distance(&t->at, t->at.value);
		closer = !careful || now < NEAR || now < kept_distance(&t->at, base.value);
		if (now < kept_distance(&t->at, nearest->value))
			*nearest = t->at;
	}
	return BATTEN_OK;
}

/* First by steps as long as they come out, which measures that hang together need; then carefully from where
 * these came nearest. */
static batten_status meet(task *t, const batten_search_options *search, double *target,
                          const batten_search_problem *problem, batten_search_result *result)
{
	batten_search_problem shifted = *problem;
	kept_state nearest = t->at;
	bool met = false;
	shifted.target_m = target;
	for (int careful = 0; careful < 2; careful++) {
		memcpy(t->at.multiplier, nearest.multiplier, sizeof t->at.multiplier);
		memcpy(t->at.value, nearest.value, sizeof t->at.value);
		guess_response(t);
		const batten_status status = follow(t, careful, search, &shifted, target, &nearest, result,
		                                    &met);
		if (status != BATTEN_OK || met)
			return status;
	}
	return fail_to_meet(t);
}

static batten_status keep(task *t, const batten_search_options *search, double *target,
                          batten_search_problem *problem, batten_search_result *result)
{
	/* f32 only screens: it ends so unevenly that measures do not follow multipliers. */
	batten_search_options exact = *search;
	exact.precision = BATTEN_F64;

	batten_status status = want(t);
	if (status == BATTEN_OK)
		status = measure_here(t);
	if (status != BATTEN_OK || kept_judge(&t->at))
		return status;
	status = find_slopes(t);
	if (status == BATTEN_OK)
		status = check_reach(t);
	if (status != BATTEN_OK)
		return status;
	find_gives(t, problem);
	if (search->precision == BATTEN_F32)
		put_on_bounds(t);
	status = meet(t, &exact, target, problem, result);
	for (size_t i = 0; i < t->at.count; i++)
		t->fairing->kept[i].multiplier = t->at.multiplier[i] / t->fairing->kept[i].tolerance;
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
	t.at.count = options->keep_count;
	fairing->kept_rounds = 0;
	batten_status status = batten_hull_clone(context, fairing->smoothed, &t.hull);
	t.moved = batten_allocate(context, MEASURED_AT_ONCE * t.nodes, sizeof *t.moved);
	t.found = batten_allocate(context, MEASURED_AT_ONCE, sizeof *t.found);
	t.slopes = batten_allocate(context, t.at.count * t.nodes, sizeof *t.slopes);
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
