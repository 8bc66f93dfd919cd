#include "fairing/box.h"

#include "core/runs.h"

#include <math.h>

/* A bound and what set it, for the message when two exclude each other. */
typedef struct bound {
	double value;
	const char *cause;
} bound;

static void raise(bound *lower, double value, const char *cause)
{
	if (value > lower->value)
		*lower = (bound){ value, cause };
}

static void reduce(bound *upper, double value, const char *cause)
{
	if (value < upper->value)
		*upper = (bound){ value, cause };
}

/* Says which bounds of a node exclude each other. */
static batten_status explain(batten_context *context, const batten_hull *hull,
                             const batten_fair_options *options, double half_beam, double distance,
                             size_t node)
{
	const double y = hull->y_m[node];
	bound lower = { 0.0, "0" };
	bound upper = { FAIRING_HALF_BEAM_LIMIT * half_beam, "1.2 half-beams" };
	raise(&lower, y - FAIRING_LIMIT_MARGIN * distance, "the distance limit");
	reduce(&upper, y + FAIRING_LIMIT_MARGIN * distance, "the distance limit");
	if (options->lower && options->lower->nodes[node] == BATTEN_NODE_GIVEN)
		raise(&lower, options->lower->y_m[node], "the lower offsets");
	if (options->upper && options->upper->nodes[node] == BATTEN_NODE_GIVEN)
		reduce(&upper, options->upper->y_m[node], "the upper offsets");
	return batten_fail(context, BATTEN_INPUT,
	                   "x = %g m, z = %g m: %s ask for at least %g m and %s for at most %g m: no "
	                   "half-breadth satisfies both",
	                   hull->x_m[node % hull->station_count], hull->z_m[node / hull->station_count],
	                   lower.cause, lower.value, upper.cause, upper.value);
}

/* The bounds that every hull has. A '?' that fills to 0 lies on the profile, as a 0 does: neither moves. */
INLINED void bound_each(size_t count, const uint8_t *restrict nodes, const double *restrict y_m,
                        double distance, double most, double *restrict lower_m,
                        double *restrict upper_m, double *restrict weight)
{
	for (size_t n = 0; n < count; n++) {
		const double y = y_m[n];
		const double moves = nodes[n] != BATTEN_NODE_OUTSIDE ? y : 0.0;
		const double lower = y - distance > 0.0 ? y - distance : 0.0;
		const double upper = y + distance < most ? y + distance : most;
		lower_m[n] = moves > 0.0 ? lower : y;
		upper_m[n] = moves > 0.0 ? upper : y;
	}
	for (size_t n = 0; n < count; n++)
		weight[n] = nodes[n] == BATTEN_NODE_GIVEN ? 1.0 : 0.0;
}

RUNS_FUNCTION(bound_nodes, bound_each,
              (size_t count, const uint8_t *nodes, const double *y_m, double distance, double most,
               double *lower_m, double *upper_m, double *weight),
              (count, nodes, y_m, distance, most, lower_m, upper_m, weight))

/* Those of the options. */
static void tighten(const batten_hull *hull, const batten_fair_options *options,
                    const uint8_t *locked, const fairing_box *box)
{
	const batten_hull *lower = options->lower, *upper = options->upper;
	for (size_t n = 0; n < hull_node_count(hull); n++) {
		const bool moves = hull->nodes[n] != BATTEN_NODE_OUTSIDE && hull->y_m[n] > 0.0;
		if (moves && lower && lower->nodes[n] == BATTEN_NODE_GIVEN)
			box->lower_m[n] = fmax(box->lower_m[n], lower->y_m[n]);
		if (moves && upper && upper->nodes[n] == BATTEN_NODE_GIVEN)
			box->upper_m[n] = fmin(box->upper_m[n], upper->y_m[n]);
		if (locked && locked[n])
			box->lower_m[n] = box->upper_m[n] = hull->y_m[n];
	}
}

static batten_status apply_lock(batten_context *context, const batten_hull *hull,
                                const batten_lock *lock, uint8_t *locked)
{
	const size_t nx = hull->station_count;
	const bool needs_station = lock->kind != BATTEN_LOCK_WATERLINE;
	const bool needs_waterline = lock->kind != BATTEN_LOCK_STATION;
	const size_t station = needs_station ? hull_station_at(hull, lock->x_m) : 0;
	const size_t waterline = needs_waterline ? hull_waterline_at(hull, lock->z_m) : 0;
	if (station == SIZE_MAX)
		return batten_fail(context, BATTEN_USAGE,
		                   "lock: no station of the table stands at x = %g m", lock->x_m);
	if (waterline == SIZE_MAX)
		return batten_fail(context, BATTEN_USAGE,
		                   "lock: no waterline of the table lies at z = %g m", lock->z_m);
	for (size_t k = 0; k < hull->waterline_count; k++)
		for (size_t i = 0; i < nx; i++)
			if ((!needs_station || i == station) && (!needs_waterline || k == waterline))
				locked[k * nx + i] = 1;
	return BATTEN_OK;
}

batten_status fairing_locks_create(batten_context *context, const batten_hull *hull,
                                   const batten_fair_options *options, uint8_t **out)
{
	uint8_t *locked = batten_allocate(context, hull_node_count(hull), sizeof *locked);
	if (!locked)
		return BATTEN_MEMORY;
	batten_status status = BATTEN_OK;
	for (size_t l = 0; l < options->lock_count && status == BATTEN_OK; l++)
		status = apply_lock(context, hull, &options->locks[l], locked);
	if (status != BATTEN_OK) {
		batten_release(context, locked);
		return status;
	}
	*out = locked;
	return BATTEN_OK;
}

static batten_status check_table(batten_context *context, const batten_hull *hull,
                                 const batten_hull *bounds, const char *which)
{
	if (!bounds)
		return BATTEN_OK;
	bool same = bounds->station_count == hull->station_count &&
	            bounds->waterline_count == hull->waterline_count;
	for (size_t i = 0; same && i < hull->station_count; i++)
		same = hull_station_at(hull, bounds->x_m[i]) == i;
	for (size_t k = 0; same && k < hull->waterline_count; k++)
		same = hull_waterline_at(hull, bounds->z_m[k]) == k;
	if (!same)
		return batten_fail(context, BATTEN_USAGE,
		                   "the %s offsets stand on another table of stations and waterlines",
		                   which);
	return BATTEN_OK;
}

batten_status fairing_box_fill(batten_context *context, const batten_hull *smoothed,
                               const batten_fair_options *options, const uint8_t *locked,
                               double distance_m, fairing_box *box)
{
	const size_t nodes = hull_node_count(smoothed);
	box->variable_count = 0;
	batten_status status = check_table(context, smoothed, options->lower, "lower");
	if (status == BATTEN_OK)
		status = check_table(context, smoothed, options->upper, "upper");
	if (status != BATTEN_OK)
		return status;
	bound_nodes(nodes, smoothed->nodes, smoothed->y_m, FAIRING_LIMIT_MARGIN * distance_m,
	            FAIRING_HALF_BEAM_LIMIT * box->half_beam_m, box->lower_m, box->upper_m,
	            box->closeness_weight);
	if (options->lower || options->upper || locked)
		tighten(smoothed, options, locked, box);
	size_t excluded = 0;
	for (size_t n = 0; n < nodes; n++) {
		box->variable_count += box->lower_m[n] < box->upper_m[n];
		excluded += box->lower_m[n] > box->upper_m[n];
	}
	for (size_t n = 0; n < nodes && excluded > 0; n++)
		if (box->lower_m[n] > box->upper_m[n])
			return explain(context, smoothed, options, box->half_beam_m, distance_m, n);
	return BATTEN_OK;
}

batten_status fairing_box_create(batten_context *context, const batten_hull *smoothed,
                                 const batten_fair_options *options, const uint8_t *locked,
                                 double distance_m, fairing_box *out)
{
	fairing_box box = { .half_beam_m = batten_hull_half_beam_m(smoothed) };
	const size_t nodes = hull_node_count(smoothed);
	box.lower_m = batten_allocate(context, nodes, sizeof(double));
	box.upper_m = batten_allocate(context, nodes, sizeof(double));
	box.closeness_weight = batten_allocate(context, nodes, sizeof(double));
	batten_status status = BATTEN_MEMORY;
	if (box.lower_m && box.upper_m && box.closeness_weight)
		status = fairing_box_fill(context, smoothed, options, locked, distance_m, &box);
	if (status != BATTEN_OK) {
		fairing_box_release(context, &box);
		return status;
	}
	*out = box;
	return BATTEN_OK;
}

batten_search_problem fairing_problem(const batten_hull *smoothed, const fairing_box *box,
                                      double w1, double w2)
{
	return (batten_search_problem){ .nodes = smoothed->nodes,
		                            .start_m = smoothed->y_m,
		                            .target_m = smoothed->y_m,
		                            .lower_m = box->lower_m,
		                            .upper_m = box->upper_m,
		                            .closeness_weight = box->closeness_weight,
		                            .w1 = w1,
		                            .w2 = w2,
		                            .half_beam_m = box->half_beam_m };
}

void fairing_box_release(batten_context *context, fairing_box *box)
{
	batten_release(context, box->lower_m);
	batten_release(context, box->upper_m);
	batten_release(context, box->closeness_weight);
	*box = (fairing_box){ 0 };
}
