#include "fairing/net_space.h"

#include "fairing/conclude.h"
#include "fairing/net_problem.h"
#include "fairing/space.h"
#include "geometry/surface.h"

#include <math.h>
#include <string.h>

/* Surfaces measured at once. */
enum { PIECE = 16 };

static size_t poles_of(const net_space *s)
{
	return s->from->count_u * s->from->count_v;
}

static void put_y(double *poles_m, const double *y, size_t poles)
{
	for (size_t p = 0; p < poles; p++)
		poles_m[3 * p + 1] = y[p];
}

static void move(const void *of, double *y, size_t variable, double way_m)
{
	const net_space *s = of;
	for (size_t p = 0; p < poles_of(s); p++)
		if (s->box->leader[p] == variable)
			y[p] += way_m;
}

/* A piece of surfaces. */
static batten_status measure_some(const net_space *s, size_t count, const double *y,
                                  batten_hydrostatics *found)
{
	const batten_hull *hull = s->fairing->smoothed;
	const size_t poles = poles_of(s);
	struct batten_surface made[PIECE];
	const batten_surface *surfaces[PIECE];
	batten_afloat_result results[PIECE];
	batten_batch_options batch;
	batten_hydrostatics_options options;
	batten_batch_options_default(&batch);
	batten_hydrostatics_options_default(&options);
	batch.device = BATTEN_DEVICE_REFERENCE;
	options.lbp_m = hull->lbp_m;
	for (size_t i = 0; i < count; i++) {
		made[i] = *s->from;
		made[i].poles = s->poles_m + i * 3 * poles;
		memcpy(made[i].poles, s->from->poles, 3 * poles * sizeof(double));
		put_y(made[i].poles, y + i * poles, poles);
		surfaces[i] = &made[i];
	}
	const batten_status status = batten_surface_hydrostatics_batch(
		s->fairing->context, count, surfaces, &options, &batch, 1, &hull->draft_m, found, results,
		NULL);
	for (size_t i = 0; i < count && status == BATTEN_OK; i++)
		if (results[i].status != BATTEN_OK)
			return batten_fail(s->fairing->context, BATTEN_INPUT, "%s: the fitted surface: %s",
			                   hull->name, results[i].reason);
	return status;
}

static batten_status measure(void *of, size_t count, double *y, batten_hydrostatics *found)
{
	const net_space *s = of;
	batten_status status = BATTEN_OK;
	for (size_t first = 0; first < count && status == BATTEN_OK; first += PIECE)
		status = measure_some(s, count - first < PIECE ? count - first : PIECE,
		                      y + first * poles_of(s), found + first);
	return status;
}

static batten_status yield(void *of, size_t count, const double *slopes, double *ways)
{
	const net_space *s = of;
	return net_problem_yield(s->fairing->context, &s->problem, s->how, count, slopes, ways);
}

static batten_status answer(void *of, const double *target_m, const double *y, size_t count,
                            const double *slopes, double *ways, bool *known)
{
	const net_space *s = of;
	batten_net_problem problem = s->problem;
	problem.target_y_m = target_m;
	return net_problem_answer(s->fairing->context, &problem, s->how, y, count, slopes, ways, known);
}

static batten_status search(void *of, const double *target_m, double *y,
                            batten_search_result *result, batten_run *run)
{
	const net_space *s = of;
	batten_net_options exact = *s->how;
	batten_net_problem from = s->problem;
	exact.search.precision = BATTEN_F64;
	from.start = s->from;
	from.target_y_m = target_m;
	put_y(s->from->poles, y, poles_of(s));
	const batten_status status = batten_net_search_batch(s->fairing->context, 1, &from, &exact, y,
	                                                     result, run);
	return status == BATTEN_INCOMPLETE ? BATTEN_OK : status;
}

static batten_status certify(void *of, const double *target_m, double gap, double *y,
                             batten_certificate *certificate)
{
	const net_space *s = of;
	batten_net_problem problem = s->problem;
	problem.target_y_m = target_m;
	return gap > 0.0
	           ? batten_net_polish_batch(s->fairing->context, 1, &problem, s->how, gap, y,
	                                     certificate)
	           : batten_net_certify_batch(s->fairing->context, 1, &problem, s->how, y, certificate);
}

/* The bounds of leaders with all that follow them; what follows has none of its own. */
static void find_bounds(net_space *s)
{
	const size_t *leader = s->box->leader;
	for (size_t p = 0; p < poles_of(s); p++) {
		s->start_m[p] = s->from->poles[3 * p + 1];
		s->lower_m[p] = -INFINITY;
		s->upper_m[p] = INFINITY;
	}
	for (size_t p = 0; p < poles_of(s); p++) {
		const size_t l = leader[p];
		const double apart = s->start_m[l] - s->start_m[p];
		s->lower_m[l] = fmax(s->lower_m[l], s->box->lower_m[p] + apart);
		s->upper_m[l] = fmin(s->upper_m[l], s->box->upper_m[p] + apart);
	}
	for (size_t p = 0; p < poles_of(s); p++)
		if (leader[p] != p)
			s->lower_m[p] = s->upper_m[p] = s->start_m[p];
}

static batten_status open_space(net_space *space, fairing_space *out)
{
	batten_context *context = space->fairing->context;
	batten_status status = batten_surface_clone(context, space->problem.start, &space->from);
	if (status != BATTEN_OK)
		return status;
	const size_t poles = poles_of(space);
	space->start_m = batten_allocate(context, poles, sizeof *space->start_m);
	space->lower_m = batten_allocate(context, poles, sizeof *space->lower_m);
	space->upper_m = batten_allocate(context, poles, sizeof *space->upper_m);
	space->poles_m = batten_allocate(context, PIECE * poles, 3 * sizeof *space->poles_m);
	if (!space->start_m || !space->lower_m || !space->upper_m || !space->poles_m)
		return BATTEN_MEMORY;
	find_bounds(space);
	*out = (fairing_space){ .of = space,
		                    .variables = "poles",
		                    .count = poles,
		                    .start_m = space->start_m,
		                    .lower_m = space->lower_m,
		                    .upper_m = space->upper_m,
		                    .move = move,
		                    .measure = measure,
		                    .yield = yield,
		                    .answer = answer,
		                    .search = search,
		                    .certify = certify };
	return BATTEN_OK;
}

static void close_space(net_space *space)
{
	batten_context *context = space->fairing->context;
	batten_surface_destroy(space->from);
	batten_release(context, space->start_m);
	batten_release(context, space->lower_m);
	batten_release(context, space->upper_m);
	batten_release(context, space->poles_m);
}

batten_status net_space_conclude(net_space *space, const batten_fair_options *options, double *y,
                                 batten_search_result *result)
{
	fairing_space seen;
	batten_status status = open_space(space, &seen);
	if (status == BATTEN_OK)
		status = fairing_conclude(space->fairing, options, &seen, y, result);
	close_space(space);
	return status;
}
