/* Volume, areas, centres, coefficients kept (thesis 7.1: constraints). A multiplier of a measure adds to
 * the objective what is linear in half-breadths or poles, as far as the measure is; closeness to a target
 * that is shifted adds the same. So the searches stay as they are, on every device: multipliers are found by
 * Newton's method over whole searches, each from where the last one ended. */
#include "fairing/kept.h"

#include "fairing/kept_state.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Hulls or surfaces measured in one batch; searches of each way to the multipliers, before these count as not found. */
enum { MEASURED_AT_ONCE = 64, ROUND_LIMIT = 40 };
/* Part of the half-beam that a half-breadth is moved by to see what a measure does. */
#define NUDGE 1e-4
/* So many tolerances from where it is to be, a measure tells no step that goes too far from the unevenness
 * of the searches' ends. */
#define NEAR 30.0
/* A step of the multipliers is too long where the rise at its end is a fall by more than this part of that at its
 * beginning. */
#define OVERSHOT 0.5
/* What is left of one, at the least. */
#define SHORTEST 0.1
/* A variable that f32 left rounding from a bound. */
#define ROUNDING 0x1p-22
/* No target goes further from the centreplane than so many half-beams. */
#define FARTHEST 1e6

/* Measures are counted in tolerances from what they are to be: within -1 .. 1. */
typedef struct task {
	batten_fairing *fairing;
	const batten_fair_options *options;
	const fairing_space *space;
	double *y, *moved; /* where the search is; MEASURED_AT_ONCE of these beside it */
	batten_hydrostatics *found;
	double *slopes;  /* [count][variables]: tolerances a metre */
	double *ways;    /* [count][variables]: how far closeness alone lets them go for these */
	double *answers; /* [count][variables]: how far the objective lets them, about an end */
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
	if (options->method != BATTEN_METHOD_SEARCH)
		return batten_fail(context, BATTEN_USAGE, "measures are kept by searches only");
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

static batten_status measure(task *t, const double *y, double *values)
{
	const fairing_space *space = t->space;
	memcpy(t->moved, y, space->count * sizeof *y);
	const batten_status status = space->measure(space->of, 1, t->moved, t->found);
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

/* What is kept: the measures of the start. */
static batten_status want(task *t)
{
	batten_fairing *fairing = t->fairing;
	double values[BATTEN_KEEP_LIMIT];
	const batten_status status = measure(t, t->space->start_m, values);
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

/* Slopes along `count` variables. */
static batten_status find_some_slopes(task *t, const size_t *which, size_t count, double nudge)
{
	const fairing_space *space = t->space;
	for (size_t v = 0; v < count; v++) {
		double *moved = t->moved + v * space->count;
		memcpy(moved, t->y, space->count * sizeof *moved);
		space->move(space->of, moved, which[v], nudge);
	}
	const batten_status status = space->measure(space->of, count, t->moved, t->found);
	for (size_t v = 0; v < count && status == BATTEN_OK; v++)
		for (size_t i = 0; i < t->at.count; i++) {
			const double value = in_tolerances(
				t, i, quantity_of(&t->found[v], t->options->keep[i].quantity));
			t->slopes[i * space->count + which[v]] = (value - t->at.value[i]) / nudge;
		}
	return status;
}

static batten_status find_slopes(task *t)
{
	const fairing_space *space = t->space;
	const double nudge = NUDGE * batten_hull_half_beam_m(t->fairing->smoothed);
	size_t which[MEASURED_AT_ONCE], count = 0;
	batten_status status = BATTEN_OK;
	for (size_t n = 0; n < space->count && status == BATTEN_OK; n++) {
		if (space->lower_m[n] < space->upper_m[n])
			which[count++] = n;
		if (count == MEASURED_AT_ONCE || (count > 0 && n + 1 == space->count)) {
			status = find_some_slopes(t, which, count, nudge);
			count = 0;
		}
	}
	return status == BATTEN_OK ? space->yield(space->of, t->at.count, t->slopes, t->ways) : status;
}

/* The response of the measures to their multipliers where variables answer like this. */
static void respond_by(task *t, const double *ways)
{
	const fairing_space *space = t->space;
	for (size_t i = 0; i < t->at.count; i++)
		for (size_t j = 0; j < t->at.count; j++) {
			double sum = 0.0;
			for (size_t n = 0; n < space->count; n++)
				if (space->lower_m[n] < space->upper_m[n])
					sum += t->slopes[i * space->count + n] * ways[j * space->count + n];
			t->at.response.a[i][j] = sum;
		}
}

/* Bending resists little of a change as even as a measure's slopes: closeness alone is the first
 * guess. */
static void guess_response(task *t)
{
	respond_by(t, t->ways);
}

/* Whether the bounds let every measure, by itself, come within its tolerance. */
static batten_status check_reach(const task *t)
{
	const fairing_space *space = t->space;
	for (size_t i = 0; i < t->at.count; i++) {
		double least = t->at.value[i], most = t->at.value[i];
		for (size_t n = 0; n < space->count; n++) {
			const double slope = t->slopes[i * space->count + n];
			const double down = slope * (space->lower_m[n] - t->y[n]);
			const double up = slope * (space->upper_m[n] - t->y[n]);
			least += fmin(down, up);
			most += fmax(down, up);
		}
		const batten_kept *kept = &t->fairing->kept[i];
		if (most < -1.0 || least > 1.0)
			return batten_fail(
				t->fairing->context, BATTEN_INPUT,
				"%s: %s cannot be kept at %.6g within %.3g: the bounds of the %s allow "
				"%.6g to %.6g",
				t->fairing->smoothed->name, batten_hydrostatics_name(kept->quantity), kept->wanted,
				kept->tolerance, space->variables, kept->wanted + least * kept->tolerance,
				kept->wanted + most * kept->tolerance);
	}
	return BATTEN_OK;
}

/* Where closeness pulls to with these multipliers; false: beyond all measure. */
static bool aim_at(const task *t, double *target)
{
	const fairing_space *space = t->space;
	const double farthest = FARTHEST * batten_hull_half_beam_m(t->fairing->smoothed);
	for (size_t n = 0; n < space->count; n++) {
		target[n] = space->start_m[n];
		for (size_t i = 0; i < t->at.count; i++)
			target[n] -= t->at.multiplier[i] * t->ways[i * space->count + n];
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
	                   "%s: these were not met together within the bounds of the %s, in %u "
	                   "searches: %s",
	                   t->fairing->smoothed->name, t->space->variables, t->fairing->kept_rounds,
	                   names);
}

static batten_status search_again(task *t, const double *target, batten_search_result *result)
{
	batten_fairing *fairing = t->fairing;
	const batten_search_result before = *result;
	const double seconds = fairing->run.seconds;
	const batten_status status = t->space->search(t->space->of, target, t->y, result,
	                                              &fairing->run);
	result->iterations += before.iterations;
	result->probes += before.probes;
	fairing->run.seconds += seconds;
	return status;
}

/* f32 rounds bounds: variables that are held stand beside them, where a search in f64 would find them free and
 * in its way. */
static void put_on_bounds(task *t)
{
	const fairing_space *space = t->space;
	for (size_t n = 0; n < space->count; n++) {
		const double near = ROUNDING * fabs(t->y[n]);
		const double down = space->lower_m[n] - t->y[n];
		const double up = space->upper_m[n] - t->y[n];
		if (space->lower_m[n] < space->upper_m[n] && (down >= -near || up <= near))
			space->move(space->of, t->y, n, down >= -near ? down : up);
	}
}

/* A way to the multipliers under way. */
typedef struct way {
	double *target;
	kept_state base;    /* where the last step that was taken led */
	kept_state nearest; /* where measures came nearest to what is aimed at */
	double change[BATTEN_KEEP_LIMIT];
	batten_search_result *result;
	bool met;
	bool told; /* the objective has told how measures answer, at every end */
} way;

/* The search with `change` added to the multipliers of the base. *led false: nowhere, the targets are beyond all
 * measure. */
static batten_status step(task *t, way *w, bool *led)
{
	for (size_t i = 0; i < t->at.count; i++)
		t->at.multiplier[i] = w->base.multiplier[i] + w->change[i];
	*led = aim_at(t, w->target);
	if (!*led)
		return BATTEN_OK;
	batten_status status = search_again(t, w->target, w->result);
	if (status == BATTEN_OK)
		status = measure_here(t);
	t->fairing->kept_rounds++;
	w->met = status == BATTEN_OK && kept_judge(&t->at);
	if (kept_distance(&t->at, t->at.value) < kept_distance(&t->at, w->nearest.value))
		w->nearest = t->at;
	return status;
}

static void shorten(way *w, double part)
{
	for (size_t i = 0; i < w->base.count; i++)
		w->change[i] *= part;
}

/* How measures answer about y, by the second derivatives of the objective there, as far as these tell. */
static batten_status find_response(task *t, const double *target, way *w)
{
	const fairing_space *space = t->space;
	const batten_status status = space->answer(space->of, target, t->y, t->at.count, t->slopes,
	                                           t->answers, &w->told);
	if (status == BATTEN_OK && w->told)
		respond_by(t, t->answers);
	return status;
}

/* A step of climb(), shortened until it does not go too far. */
static batten_status climb_on(task *t, way *w, unsigned *rounds)
{
	const double rise = kept_rise(&t->at, w->change);
	for (double end = -INFINITY; *rounds < ROUND_LIMIT && end < -OVERSHOT * rise;) {
		bool led = true;
		if (end > -INFINITY)
			shorten(w, fmax(SHORTEST, fmin(0.5, rise / (rise - end))));
		const batten_status status = step(t, w, &led);
		if (status != BATTEN_OK || w->met)
			return status;
		++*rounds;
		end = led ? kept_rise(&t->at, w->change) : -DBL_MAX;
	}
	return BATTEN_OK;
}

/* By the response as it is about each end: multipliers climb to where the least of the objective with them is
 * greatest, whose slope the measures are. */
static batten_status climb(task *t, way *w)
{
	batten_status status = find_response(t, NULL, w);
	for (unsigned rounds = 0; rounds < ROUND_LIMIT && status == BATTEN_OK && w->told;) {
		w->told = kept_choose(&t->at, w->change);
		if (!w->told)
			break;
		w->base = t->at;
		status = climb_on(t, w, &rounds);
		if (status != BATTEN_OK || w->met)
			break;
		status = find_response(t, w->target, w);
	}
	return status;
}

/* By a response that is guessed, then learnt; `careful`: a step that leads no closer, often to where bounds hold
 * all there is, is halved. */
static batten_status follow(task *t, bool careful, way *w)
{
	bool closer = true;
	guess_response(t);
	for (unsigned round = 0; round < ROUND_LIMIT; round++) {
		bool led = true;
		if (!closer)
			shorten(w, 0.5);
		else if (kept_choose(&t->at, w->change))
			w->base = t->at;
		else
			break;
		const batten_status status = step(t, w, &led);
		if (status != BATTEN_OK || w->met)
			return status;
		if (!led)
			break;
		kept_learn(&t->at, w->base.value, w->change);
		const double now = kept_distance(&t->at, t->at.value);
		closer = !careful || now < NEAR || now < kept_distance(&t->at, w->base.value);
	}
	return BATTEN_OK;
}

/* By what is known of the objective. Where that tells nothing, by steps as long as they come out, which measures
 * that hang together need, then carefully, each from where measures came nearest. */
static batten_status meet(task *t, double *target, batten_search_result *result)
{
	way w = { .target = target, .nearest = t->at, .result = result };
	batten_status status = t->space->answer ? climb(t, &w) : BATTEN_OK;
	for (int careful = 0; careful < 2 && status == BATTEN_OK && !w.met && !w.told; careful++) {
		memcpy(t->at.multiplier, w.nearest.multiplier, sizeof t->at.multiplier);
		memcpy(t->at.value, w.nearest.value, sizeof t->at.value);
		status = follow(t, careful, &w);
	}
	return status == BATTEN_OK && !w.met ? fail_to_meet(t) : status;
}

static batten_status keep(task *t, double *target, bool *shifted, batten_search_result *result)
{
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
	/* f32 only screens: it ends so unevenly that measures do not follow multipliers. */
	if (t->options->search.precision == BATTEN_F32)
		put_on_bounds(t);
	status = meet(t, target, result);
	for (size_t i = 0; i < t->at.count; i++)
		t->fairing->kept[i].multiplier = t->at.multiplier[i] / t->fairing->kept[i].tolerance;
	*shifted = true;
	return status;
}

batten_status fairing_keep(batten_fairing *fairing, const batten_fair_options *options,
                           const fairing_space *space, double *target_m, bool *shifted, double *y,
                           batten_search_result *result)
{
	batten_context *context = fairing->context;
	task t = { .fairing = fairing, .options = options, .space = space, .y = y };
	t.at.count = options->keep_count;
	fairing->kept_rounds = 0;
	*shifted = false;
	t.moved = batten_allocate(context, MEASURED_AT_ONCE * space->count, sizeof *t.moved);
	t.found = batten_allocate(context, MEASURED_AT_ONCE, sizeof *t.found);
	t.slopes = batten_allocate(context, t.at.count * space->count, sizeof *t.slopes);
	t.ways = batten_allocate(context, t.at.count * space->count, sizeof *t.ways);
	t.answers = batten_allocate(context, t.at.count * space->count, sizeof *t.answers);
	const bool all = t.moved && t.found && t.slopes && t.ways && t.answers;
	batten_status status = all ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK)
		status = keep(&t, target_m, shifted, result);
	batten_release(context, t.moved);
	batten_release(context, t.found);
	batten_release(context, t.slopes);
	batten_release(context, t.ways);
	batten_release(context, t.answers);
	return status;
}
