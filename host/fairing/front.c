/* batten_hull_front: one batch of searches that differ in what closeness counts. */
#include "fairing/front.h"

#include <math.h>
#include <string.h>

enum { POINTS_MOST = 4096 };

static batten_status check(batten_context *context, const batten_fair_options *options, double low,
                           double high, size_t count)
{
	if (options->method != BATTEN_METHOD_SEARCH)
		return batten_fail(context, BATTEN_USAGE,
		                   "a front is one of searches: --method search was "
		                   "expected");
	if (options->weights_given)
		return batten_fail(context, BATTEN_USAGE,
		                   "a front sweeps its own weights: none are expected");
	if (!(low >= 1e-100) || !(high > low) || !(high <= 1e100))
		return batten_fail(
			context, BATTEN_USAGE,
			"a front from w2/w1 = %g to %g: 1e-100 <= low < high <= 1e100 is expected", low, high);
	if (count < 2 || count > POINTS_MOST)
		return batten_fail(context, BATTEN_USAGE, "a front of %zu points: 2 to %d are expected",
		                   count, POINTS_MOST);
	return BATTEN_OK;
}

bool front_concludes(const front *f)
{
	return f->options->keep_count > 0 || f->options->polish_gap > 0.0;
}

void front_take_concluded(const front *f, size_t point)
{
	f->certificates[point] = f->fairing->certificate;
	memcpy(f->points[point].kept, f->fairing->kept, sizeof f->points[point].kept);
}

/* Smaller is better in both. */
static void mark_dominated(size_t count, batten_front_point *points)
{
	for (size_t a = 0; a < count; a++)
		for (size_t b = 0; b < count; b++) {
			const double fairness = points[b].fairness - points[a].fairness;
			const double closeness = points[b].closeness.closeness_m4 -
			                         points[a].closeness.closeness_m4;
			if (fairness <= 0.0 && closeness <= 0.0 && (fairness < 0.0 || closeness < 0.0))
				points[a].dominated = true;
		}
}

static void take(const front *f)
{
	for (size_t p = 0; p < f->count; p++) {
		f->points[p].fairness = f->certificates[p].fairness;
		f->points[p].gap_estimate = f->certificates[p].gap_estimate;
		f->points[p].result = f->results[p];
	}
	mark_dominated(f->count, f->points);
}

/* Polished or kept measures may have ended what met the limit at first. */
static batten_status judge(const front *f)
{
	for (size_t p = 0; p < f->count; p++)
		if (f->results[p].end == BATTEN_SEARCH_LIMIT)
			return batten_fail(f->fairing->context, BATTEN_INCOMPLETE,
			                   "%s: the point at w2/w1 = %g met its iteration limit",
			                   f->fairing->smoothed->name, f->points[p].ratio);
	return BATTEN_OK;
}

static batten_status sweep(front *f)
{
	batten_context *context = f->fairing->context;
	batten_status status = BATTEN_MEMORY;
	f->results = batten_allocate(context, f->count, sizeof *f->results);
	f->certificates = batten_allocate(context, f->count, sizeof *f->certificates);
	if (f->results && f->certificates)
		status = f->options->variables == BATTEN_VARIABLES_NET ? front_net(f) : front_offsets(f);
	if (status == BATTEN_OK) {
		take(f);
		status = judge(f);
	} else {
		for (size_t p = 0; p < f->count; p++) {
			batten_surface_destroy(f->points[p].surface);
			f->points[p].surface = NULL;
		}
	}
	batten_release(context, f->results);
	batten_release(context, f->certificates);
	return status;
}

batten_status batten_hull_front(batten_context *context, const batten_hull *hull,
                                const batten_fair_options *options, double ratio_low,
                                double ratio_high, size_t count, batten_front_point *points,
                                batten_run *run)
{
	batten_fair_options chosen;
	batten_fair_options_default(&chosen);
	if (options)
		chosen = *options;
	batten_status status = check(context, &chosen, ratio_low, ratio_high, count);
	if (status != BATTEN_OK)
		return status;
	const double factor = log(ratio_high / ratio_low) / (double)(count - 1);
	memset(points, 0, count * sizeof *points);
	for (size_t p = 0; p < count; p++)
		points[p].ratio = p + 1 < count ? ratio_low * exp(factor * (double)p) : ratio_high;
	batten_fairing *fairing = batten_allocate(context, 1, sizeof *fairing);
	if (!fairing)
		return BATTEN_MEMORY;
	fairing->context = context;
	front f = { .fairing = fairing, .options = &chosen, .count = count, .points = points };
	status = fairing_prepare(fairing, hull, &chosen);
	if (status == BATTEN_OK)
		status = sweep(&f);
	if (run)
		*run = fairing->run;
	batten_fairing_destroy(fairing);
	return status;
}
