#include "fairing/box.h"

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

static batten_status bound_node(batten_context *context, const batten_hull *hull,
                                const batten_fair_options *options, double half_beam,
                                double distance, size_t node, fairing_box *box)
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
	if (lower.value > upper.value)
		return batten_fail(
			context, BATTEN_INPUT,
			"x = %g m, z = %g m: %s ask for at least %g m and %s for at most %g m: no "
			"half-breadth satisfies both",
			hull->x_m[node % hull->station_count], hull->z_m[node / hull->station_count],
			lower.cause, lower.value, upper.cause, upper.value);
	box->lower_m[node] = lower.value;
	box->upper_m[node] = upper.value;
	return BATTEN_OK;
}

static bool is_variable(const batten_hull *hull, size_t node)
{
	/* A '?' that fills to 0 lies on the profile, as a 0 does. */
	return hull->nodes[node] != BATTEN_NODE_OUTSIDE && hull->y_m[node] > 0.0;
}

static void hold(fairing_box *box, const batten_hull *hull, size_t node)
{
	box->lower_m[node] = hull->y_m[node];
	box->upper_m[node] = hull->y_m[node];
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
	const double half_beam = batten_hull_half_beam_m(smoothed);
	box->variable_count = 0;
	batten_status status = check_table(context, smoothed, options->lower, "lower");
	if (status == BATTEN_OK)
		status = check_table(context, smoothed, options->upper, "upper");
	for (size_t n = 0; n < nodes && status == BATTEN_OK; n++) {
		hold(box, smoothed, n);
		box->closeness_weight[n] = smoothed->nodes[n] == BATTEN_NODE_GIVEN ? 1.0 : 0.0;
		if (is_variable(smoothed, n) && !(locked && locked[n]))
			status = bound_node(context, smoothed, options, half_beam, distance_m, n, box);
		box->variable_count += box->lower_m[n] < box->upper_m[n];
	}
	return status;
}

batten_status fairing_box_create(batten_context *context, const batten_hull *smoothed,
                                 const batten_fair_options *options, const uint8_t *locked,
                                 double distance_m, fairing_box *out)
{
	fairing_box box = { 0 };
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
		                            .half_beam_m = batten_hull_half_beam_m(smoothed) };
}

void fairing_box_release(batten_context *context, fairing_box *box)
{
	batten_release(context, box->lower_m);
	batten_release(context, box->upper_m);
	batten_release(context, box->closeness_weight);
	*box = (fairing_box){ 0 };
}
