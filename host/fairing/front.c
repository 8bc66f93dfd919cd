/* batten_hull_front: one batch of searches that differ in what closeness counts. */
#include "fairing/box.h"
#include "fairing/conclude.h"
#include "fairing/fairing.h"
#include "fairing/offset_space.h"

#include <math.h>
#include <string.h>

enum { POINTS_MOST = 4096 };

static batten_status check(batten_context *context, const batten_fair_options *options, double low,
                           double high, size_t count)
{
	if (options->variables != BATTEN_VARIABLES_OFFSETS)
		return batten_fail(context, BATTEN_USAGE,
		                   "a front is one of offsets: --variables offsets was expected");
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

/* Memory of the batch. */
typedef struct sweep {
	batten_search_problem *problems;
	batten_search_result *results;
	batten_certificate *certificates;
	double *y_m;
} sweep;

static void release(batten_context *context, sweep *s)
{
	batten_release(context, s->problems);
	batten_release(context, s->results);
	batten_release(context, s->certificates);
	batten_release(context, s->y_m);
}

static batten_status allocate(const batten_fairing *fairing, size_t count, sweep *s)
{
	batten_context *context = fairing->context;
	s->problems = batten_allocate(context, count, sizeof *s->problems);
	s->results = batten_allocate(context, count, sizeof *s->results);
	s->certificates = batten_allocate(context, count, sizeof *s->certificates);
	s->y_m = batten_allocate(context, count, hull_node_count(fairing->smoothed) * sizeof *s->y_m);
	return s->problems && s->results && s->certificates && s->y_m ? BATTEN_OK : BATTEN_MEMORY;
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

/* What each point is to keep, one after the other, with its certificate. */
static batten_status keep(batten_fairing *fairing, const batten_fair_options *options,
                          const fairing_box *box, const batten_search_options *search, size_t count,
                          sweep *s, batten_front_point *points)
{
	batten_status status = BATTEN_OK;
	for (size_t p = 0; p < count && status == BATTEN_OK; p++) {
		offset_space one = { fairing, box, search, s->problems[p], NULL };
		fairing_space space;
		status = offset_space_open(&one, &space);
		if (status == BATTEN_OK)
			status = fairing_conclude(fairing, options, &space, s->y_m + p * space.count,
			                          &s->results[p]);
		offset_space_close(&one);
		s->certificates[p] = fairing->certificate;
		memcpy(points[p].kept, fairing->kept, sizeof points[p].kept);
	}
	return status;
}

static batten_status describe(batten_fairing *fairing, const sweep *s, size_t count,
                              batten_front_point *points)
{
	batten_hull *faired = fairing->faired;
	const size_t nodes = hull_node_count(faired);
	batten_status status = BATTEN_OK;
	for (size_t p = 0; p < count && status == BATTEN_OK; p++) {
		points[p].ratio = s->problems[p].w2;
		points[p].fairness = s->certificates[p].fairness;
		points[p].gap_estimate = s->certificates[p].gap_estimate;
		points[p].result = s->results[p];
		for (size_t n = 0; n < nodes; n++)
			if (faired->nodes[n] != BATTEN_NODE_OUTSIDE)
				faired->y_m[n] = s->y_m[p * nodes + n];
		status = batten_hull_closeness(fairing->context, faired, fairing->smoothed,
		                               &points[p].closeness);
	}
	if (status == BATTEN_OK)
		mark_dominated(count, points);
	return status;
}

static batten_status search(batten_fairing *fairing, const batten_fair_options *options,
                            const fairing_box *box, double low, double high, size_t count, sweep *s,
                            batten_front_point *points)
{
	const batten_hull *hull = fairing->smoothed;
	const batten_grid grid = { hull->station_count, hull->waterline_count, hull->x_m, hull->z_m };
	batten_search_options chosen = options->search;
	chosen.fairness = options->fairness;
	const double factor = log(high / low) / (double)(count - 1);
	for (size_t p = 0; p < count; p++)
		s->problems[p] = fairing_problem(hull, box, 1.0,
		                                 p + 1 < count ? low * exp(factor * (double)p) : high);
	const batten_status ran = batten_search_batch(fairing->context, &grid, count, s->problems,
	                                              &chosen, s->y_m, s->results, &fairing->run);
	batten_status status = ran == BATTEN_INCOMPLETE ? BATTEN_OK : ran;
	memset(points, 0, count * sizeof *points);
	if (status == BATTEN_OK && options->keep_count > 0)
		status = keep(fairing, options, box, &chosen, count, s, points);
	else if (status == BATTEN_OK)
		status = batten_search_certify_batch(fairing->context, &grid, count, s->problems, &chosen,
		                                     s->y_m, s->certificates);
	if (status == BATTEN_OK)
		status = describe(fairing, s, count, points);
	return status == BATTEN_OK ? ran : status;
}

batten_status batten_hull_front(batten_context *context, const batten_hull *hull,
                                const batten_fair_options *options, double ratio_low,
                                double ratio_high, size_t count, batten_front_point *points)
{
	batten_fair_options chosen;
	fairing_box box = { 0 };
	sweep s = { 0 };
	batten_fair_options_default(&chosen);
	if (options)
		chosen = *options;
	batten_status status = check(context, &chosen, ratio_low, ratio_high, count);
	if (status != BATTEN_OK)
		return status;
	batten_fairing *fairing = batten_allocate(context, 1, sizeof *fairing);
	if (!fairing)
		return BATTEN_MEMORY;
	fairing->context = context;
	status = fairing_prepare(fairing, hull, &chosen);
	if (status == BATTEN_OK)
		status = fairing_box_create(context, fairing->smoothed, &chosen, fairing->locked,
		                            fairing->facts.max_distance_m, &box);
	if (status == BATTEN_OK)
		status = allocate(fairing, count, &s);
	if (status == BATTEN_OK)
		status = search(fairing, &chosen, &box, ratio_low, ratio_high, count, &s, points);
	release(context, &s);
	fairing_box_release(context, &box);
	batten_fairing_destroy(fairing);
	return status;
}
