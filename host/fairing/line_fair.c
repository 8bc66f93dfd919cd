/* batten_line_fair: the methods on a single line y(x), and the search of thesis 7.3. */
#include "fairing/lines.h"
#include "hull/hull.h"

#include <math.h>
#include <string.h>

enum { SWEEPS_MOST = 1000000 };

void batten_line_options_default(batten_line_options *options)
{
	*options = (batten_line_options){ .struct_size = sizeof *options,
		                              .method = BATTEN_METHOD_FORWARD_APPROXIMATION,
		                              .iterations = 1,
		                              .w1 = 1.0,
		                              .w2 = 1.0,
		                              .last_step = 1e-9 };
	batten_pass_options_default(&options->pass);
}

/* ------------------------------------------------------------------------------------------------
 * The search
 * --------------------------------------------------------------------------------------------- */

/* A line at work: F = w1 FN + w2 CN over the inner points (thesis 7.3). */
typedef struct line_search {
	size_t count;
	const double *x, *given;
	double *y, *base; /* where it is; where the last iteration ended */
	double w1, w2;
} line_search;

static double objective(const line_search *s, const double *y)
{
	double closeness = 0.0;
	for (size_t i = 0; i < s->count; i++)
		closeness += (y[i] - s->given[i]) * (y[i] - s->given[i]);
	return s->w1 * lines_fairness(s->count, s->x, y) + s->w2 * closeness;
}

/* Each inner point by +h, else -h; the objective where that ends. */
static double explore(const line_search *s, double h, double best)
{
	for (size_t i = 1; i + 1 < s->count; i++)
		for (int side = 0; side < 2; side++) {
			const double kept = s->y[i];
			s->y[i] = side == 0 ? kept + h : kept - h;
			const double tried = objective(s, s->y);
			if (tried < best) {
				best = tried;
				break;
			}
			s->y[i] = kept;
		}
	return best;
}

/* Hooke and Jeeves (thesis 7.2): explore; while that gains, go on by as much and explore again; halve
 * the step where nothing gains. */
static unsigned run_search(const line_search *s, double first_step, double last_step)
{
	const size_t size = s->count * sizeof *s->y;
	unsigned sweeps = 0;
	double best = objective(s, s->base);
	for (double h = first_step; h > last_step && sweeps < SWEEPS_MOST;) {
		memcpy(s->y, s->base, size);
		double found = explore(s, h, best);
		sweeps++;
		if (!(found < best)) {
			h *= 0.5;
			continue;
		}
		while (found < best && sweeps < SWEEPS_MOST) {
			best = found;
			for (size_t i = 0; i < s->count; i++) {
				const double here = s->y[i];
				s->y[i] = i == 0 || i + 1 == s->count ? here : 2.0 * here - s->base[i];
				s->base[i] = here;
			}
			found = explore(s, h, objective(s, s->y));
			sweeps++;
		}
	}
	return sweeps;
}

static batten_status search(batten_context *context, size_t count, const double *x,
                            const batten_line_options *o, const double *given, double *y)
{
	double *room = batten_allocate(context, count, sizeof *room);
	if (!room)
		return BATTEN_MEMORY;
	const line_search s = {
		.count = count, .x = x, .given = given, .y = room, .base = y, .w1 = o->w1, .w2 = o->w2
	};
	double low = given[0], high = given[0];
	for (size_t i = 1; i < count; i++) {
		low = fmin(low, given[i]);
		high = fmax(high, given[i]);
	}
	memcpy(y, given, count * sizeof *y);
	const double range = high > low ? high - low : 1.0;
	const unsigned sweeps = run_search(&s, 0.02 * range, o->last_step * range);
	batten_release(context, room);
	return sweeps < SWEEPS_MOST ? BATTEN_OK : BATTEN_INCOMPLETE;
}

/* ------------------------------------------------------------------------------------------------
 * Any method
 * --------------------------------------------------------------------------------------------- */

static batten_status run_pass(batten_context *context, size_t count, const double *x,
                              const batten_line_options *o, const double *given, double *y)
{
	batten_pass_options how = o->pass;
	how.method = o->method;
	if (how.device == BATTEN_DEVICE_AUTO)
		how.device = BATTEN_DEVICE_REFERENCE;
	batten_pass *pass = NULL;
	batten_status status = batten_pass_create_line(context, count, x, &how, &pass);
	if (status == BATTEN_OK)
		status = batten_pass_batch(context, pass, 1, o->iterations, given, y, NULL);
	batten_pass_destroy(pass);
	return status;
}

/* Lines need no name. */
static const char *after_name(const batten_points *points)
{
	return *batten_points_name(points) ? ": " : "";
}

static batten_status check_options(batten_context *context, const batten_points *points,
                                   const batten_line_options *o)
{
	if (o->struct_size != sizeof *o)
		return batten_fail(context, BATTEN_USAGE, "line options of another version of batten");
	if (batten_points_dimension(points) != 2)
		return batten_fail(context, BATTEN_USAGE,
		                   "%s%sa space curve: only lines x,y are faired, as y(x)",
		                   batten_points_name(points), after_name(points));
	if (batten_points_count(points) < 3)
		return batten_fail(
			context, BATTEN_USAGE, "%s%sa line of %zu points, expected 3 or more to fair it",
			batten_points_name(points), after_name(points), batten_points_count(points));
	const bool searched = o->method == BATTEN_METHOD_SEARCH;
	if (!searched && (int)o->method < BATTEN_METHOD_FORWARD_APPROXIMATION)
		return batten_fail(context, BATTEN_USAGE, "gross errors are those of hulls, not of a line");
	if (searched && (!(o->w1 >= 0.0) || !(o->w2 >= 0.0) || !(o->w1 + o->w2 > 0.0) ||
	                 !isfinite(o->w1 + o->w2) || !(o->last_step > 0.0)))
		return batten_fail(context, BATTEN_USAGE,
		                   "weights %g and %g, last step %g: expected weights not negative, not "
		                   "both 0, and a step above 0",
		                   o->w1, o->w2, o->last_step);
	return BATTEN_OK;
}

/* x apart from y; the search needs x to grow, as passes do. */
static batten_status take_apart(batten_context *context, const batten_points *points, double *x,
                                double *y)
{
	const double *m = batten_points_m(points);
	for (size_t i = 0; i < batten_points_count(points); i++) {
		x[i] = m[2 * i];
		y[i] = m[2 * i + 1];
		if (i > 0 && !(x[i] - x[i - 1] >= HULL_SMALLEST_STEP_M))
			return batten_fail(context, BATTEN_INPUT,
			                   "%s%spoints %zu and %zu: x goes from %g to %g m, expected x to "
			                   "grow: a line is faired as y(x)",
			                   batten_points_name(points), after_name(points), i, i + 1, x[i - 1],
			                   x[i]);
	}
	return BATTEN_OK;
}

static void fill_facts(const batten_line_options *o, size_t count, const double *x,
                       const double *given, const double *y, batten_line_facts *facts)
{
	*facts = (batten_line_facts){ .fn_before_per_m2 = lines_fairness(count, x, given),
		                          .fn_after_per_m2 = lines_fairness(count, x, y) };
	for (size_t i = 0; i < count; i++) {
		facts->change_max_m = fmax(facts->change_max_m, fabs(y[i] - given[i]));
		facts->closeness_m2 += (y[i] - given[i]) * (y[i] - given[i]);
	}
	facts->objective = o->method == BATTEN_METHOD_SEARCH
	                       ? o->w1 * facts->fn_after_per_m2 + o->w2 * facts->closeness_m2
	                       : NAN;
}

batten_status batten_line_fair(batten_context *context, const batten_points *points,
                               const batten_line_options *options, double *y_m,
                               batten_line_facts *facts)
{
	batten_line_options chosen;
	batten_line_options_default(&chosen);
	if (options)
		chosen = *options;
	batten_status status = check_options(context, points, &chosen);
	if (status != BATTEN_OK)
		return status;
	const size_t count = batten_points_count(points);
	double *x = batten_allocate(context, count, 3 * sizeof *x);
	if (!x)
		return BATTEN_MEMORY;
	double *given = x + count, *y = x + 2 * count;
	status = take_apart(context, points, x, given);
	if (status == BATTEN_OK)
		status = chosen.method == BATTEN_METHOD_SEARCH
		             ? search(context, count, x, &chosen, given, y)
		             : run_pass(context, count, x, &chosen, given, y);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE) {
		memcpy(y_m, y, count * sizeof *y);
		if (facts)
			fill_facts(&chosen, count, x, given, y, facts);
	}
	batten_release(context, x);
	return status;
}
