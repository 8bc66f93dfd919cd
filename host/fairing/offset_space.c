#include "fairing/offset_space.h"

#include "fairing/conclude.h"
#include "fairing/space.h"

#include <string.h>

static batten_grid grid_of(const batten_fairing *fairing)
{
	const batten_hull *hull = fairing->smoothed;
	return (batten_grid){ hull->station_count, hull->waterline_count, hull->x_m, hull->z_m };
}

batten_status offset_space_search(batten_fairing *fairing, size_t count,
                                  const batten_search_problem *problems,
                                  const batten_search_options *how, double *y,
                                  batten_search_result *results)
{
	const batten_grid grid = grid_of(fairing);
	const batten_status status = batten_search_batch(fairing->context, &grid, count, problems, how,
	                                                 y, results, &fairing->run);
	for (size_t i = 0; status == BATTEN_INCOMPLETE && i < count; i++)
		if (results[i].end == BATTEN_SEARCH_REFUSED)
			return batten_fail(fairing->context, BATTEN_INPUT,
			                   "%s: the search with w1 = %g, w2 = %g: %s", fairing->smoothed->name,
			                   problems[i].w1, problems[i].w2, results[i].message);
	return status;
}

static void move(const void *of, double *y, size_t variable, double way_m)
{
	(void)of;
	y[variable] += way_m;
}

/* '?' cells are filled, as the faired hull's will be. */
static batten_status measure(void *of, size_t count, double *y, batten_hydrostatics *found)
{
	const offset_space *s = of;
	const size_t nodes = hull_node_count(s->hull);
	batten_batch_options batch;
	batten_batch_options_default(&batch);
	batch.device = BATTEN_DEVICE_REFERENCE;
	batten_status status = BATTEN_OK;
	for (size_t h = 0; h < count && status == BATTEN_OK; h++) {
		size_t filled = 0;
		memcpy(s->hull->y_m, y + h * nodes, nodes * sizeof *y);
		status = hull_fill_unknown(s->hull, &filled);
		memcpy(y + h * nodes, s->hull->y_m, nodes * sizeof *y);
	}
	if (status != BATTEN_OK)
		return status;
	return batten_hull_hydrostatics_batch(s->fairing->context, s->hull, NULL, &batch, count, y,
	                                      NULL, 1, &s->hull->draft_m, found, NULL);
}

static double half_sum(const double *x, size_t i, size_t count)
{
	return ((i + 1 < count ? x[i + 1] : x[i]) - (i > 0 ? x[i - 1] : x[i])) / 2.0;
}

/* Closeness w2 / h^4 times the sum of cell * (y - start)^2 couples no offset with another. */
static batten_status yield(void *of, size_t count, const double *slopes, double *ways)
{
	const offset_space *s = of;
	const batten_hull *hull = s->hull;
	const size_t nodes = hull_node_count(hull);
	const double h2 = s->problem.half_beam_m * s->problem.half_beam_m;
	for (size_t n = 0; n < nodes; n++) {
		const double cell = half_sum(hull->x_m, n % hull->station_count, hull->station_count) *
		                    half_sum(hull->z_m, n / hull->station_count, hull->waterline_count);
		const double close = s->problem.w2 * s->box->closeness_weight[n] * cell / (h2 * h2);
		const bool varies = s->box->lower_m[n] < s->box->upper_m[n] && close > 0.0;
		for (size_t i = 0; i < count; i++)
			ways[i * nodes + n] = varies ? slopes[i * nodes + n] * (0.5 / close) : 0.0;
	}
	return BATTEN_OK;
}

static batten_status search(void *of, const double *target_m, double *y,
                            batten_search_result *result, batten_run *run)
{
	const offset_space *s = of;
	const batten_grid grid = grid_of(s->fairing);
	batten_search_options exact = *s->search;
	batten_search_problem from = s->problem;
	exact.precision = BATTEN_F64;
	from.target_m = target_m;
	from.start_m = s->hull->y_m;
	memcpy(s->hull->y_m, y, hull_node_count(s->hull) * sizeof *y);
	const batten_status status = batten_search_batch(s->fairing->context, &grid, 1, &from, &exact,
	                                                 y, result, run);
	return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
}

static batten_status certify(void *of, const double *target_m, double gap, double *y,
                             batten_certificate *certificate)
{
	const offset_space *s = of;
	const batten_grid grid = grid_of(s->fairing);
	batten_search_problem problem = s->problem;
	if (target_m)
		problem.target_m = target_m;
	return gap > 0.0 ? batten_search_polish_batch(s->fairing->context, &grid, 1, &problem,
	                                              s->search, gap, y, certificate)
	                 : batten_search_certify_batch(s->fairing->context, &grid, 1, &problem,
	                                               s->search, y, certificate);
}

static batten_status open_space(offset_space *space, fairing_space *out)
{
	const batten_hull *smoothed = space->fairing->smoothed;
	*out = (fairing_space){ .of = space,
		                    .variables = "offsets",
		                    .count = hull_node_count(smoothed),
		                    .start_m = smoothed->y_m,
		                    .lower_m = space->box->lower_m,
		                    .upper_m = space->box->upper_m,
		                    .move = move,
		                    .measure = measure,
		                    .yield = yield,
		                    .search = search,
		                    .certify = certify };
	return batten_hull_clone(space->fairing->context, smoothed, &space->hull);
}

static void close_space(offset_space *space)
{
	batten_hull_destroy(space->hull);
}

batten_status offset_space_conclude(offset_space *space, const batten_fair_options *options,
                                    double *y, batten_search_result *result)
{
	fairing_space seen;
	batten_status status = open_space(space, &seen);
	if (status == BATTEN_OK)
		status = fairing_conclude(space->fairing, options, &seen, y, result);
	close_space(space);
	return status;
}
