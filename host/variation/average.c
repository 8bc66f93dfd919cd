/* Shape averaging (thesis 2.3.6): every vertex the weighted mean of those that correspond to it. */
#include "variation/variation.h"

#include <math.h>
#include <stdio.h>

/* The hulls and their weights, the parent first. */
struct mixture {
	batten_context *context;
	size_t count;
	const batten_hull **hulls;
	double *weights;
	bool by_number; /* vertices correspond by their place in the table */
};

static bool same_extras(const batten_hull *a, const batten_hull *b)
{
	if (a->end_count != b->end_count || a->profile_count != b->profile_count ||
	    a->knuckle_count != b->knuckle_count)
		return false;
	for (size_t i = 0; i < a->end_count; i++)
		if (a->ends[i].on_waterline != b->ends[i].on_waterline ||
		    a->ends[i].line != b->ends[i].line)
			return false;
	for (size_t i = 0; i < a->profile_count; i++)
		if (a->profile[i].kind != b->profile[i].kind)
			return false;
	for (size_t i = 0; i < a->knuckle_count; i++)
		if (a->knuckles[i].on_waterline != b->knuckles[i].on_waterline)
			return false;
	return true;
}

static bool has_extras(const batten_hull *hull)
{
	return hull->end_count > 0 || hull->profile_count > 0 || hull->knuckle_count > 0;
}

static batten_status refuse_extras(const batten_hull *parent, const batten_hull *other)
{
	return batten_fail(
		parent->context, BATTEN_INPUT,
		"%s and %s: line ends, profile points or knuckles that do not correspond; "
		"hulls with the same ones on tables of one size, or without any, are expected",
		parent->name, other->name);
}

static batten_status check_pair(const batten_hull *parent, const batten_hull *other,
                                bool *by_number)
{
	*by_number = parent->station_count == other->station_count &&
	             parent->waterline_count == other->waterline_count;
	return !*by_number || same_extras(parent, other) ? BATTEN_OK : refuse_extras(parent, other);
}

static size_t vertex_count(const batten_hull *hull)
{
	size_t count = 0;
	for (size_t i = 0; i < hull_node_count(hull); i++)
		count += hull->nodes[i] != BATTEN_NODE_OUTSIDE;
	return count;
}

static double mean_of(const struct mixture *mixture, double (*value)(const batten_hull *))
{
	double sum = 0;
	for (size_t k = 0; k < mixture->count; k++)
		sum += mixture->weights[k] * value(mixture->hulls[k]);
	return sum;
}

/* Number of the coordinate nearest to a part of a length. */
static size_t nearest(const double *at, size_t count, double place)
{
	size_t best = 0;
	for (size_t i = 1; i < count; i++)
		if (fabs(at[i] - place) < fabs(at[best] - place))
			best = i;
	return best;
}

/* The vertex of a hull that corresponds to one of the base: the same place in the table, else the
 * nearest in parts of length and draft. Of a table that is along both directions on its own. */
static size_t station_of(const struct mixture *mixture, const batten_hull *base, size_t station,
                         const batten_hull *hull)
{
	return mixture->by_number ? station
	                          : nearest(hull->x_m, hull->station_count,
	                                    base->x_m[station] / base->lbp_m * hull->lbp_m);
}

static size_t waterline_of(const struct mixture *mixture, const batten_hull *base, size_t waterline,
                           const batten_hull *hull)
{
	return mixture->by_number ? waterline
	                          : nearest(hull->z_m, hull->waterline_count,
	                                    base->z_m[waterline] / base->draft_m * hull->draft_m);
}

static void mean_coordinates(const struct mixture *mixture, const batten_hull *base,
                             batten_hull *variant)
{
	for (size_t s = 0; s < base->station_count; s++) {
		variant->x_m[s] = mixture->by_number ? 0 : base->x_m[s] / base->lbp_m * variant->lbp_m;
		for (size_t k = 0; mixture->by_number && k < mixture->count; k++)
			variant->x_m[s] += mixture->weights[k] * mixture->hulls[k]->x_m[s];
	}
	for (size_t w = 0; w < base->waterline_count; w++) {
		variant->z_m[w] = mixture->by_number ? 0 : base->z_m[w] / base->draft_m * variant->draft_m;
		for (size_t k = 0; mixture->by_number && k < mixture->count; k++)
			variant->z_m[w] += mixture->weights[k] * mixture->hulls[k]->z_m[w];
	}
}

/* Points off the grid; only of tables whose vertices correspond by number. */
static void mean_extras(const struct mixture *mixture, batten_hull *variant)
{
	for (size_t i = 0; i < variant->end_count; i++)
		variant->ends[i].along_m = variant->ends[i].y_m = 0;
	for (size_t i = 0; i < variant->profile_count; i++)
		variant->profile[i] = (hull_profile_point){ .kind = variant->profile[i].kind };
	for (size_t i = 0; i < variant->knuckle_count; i++)
		variant->knuckles[i].x_m = variant->knuckles[i].z_m = 0;
	for (size_t k = 0; k < mixture->count; k++) {
		const batten_hull *hull = mixture->hulls[k];
		const double weight = mixture->weights[k];
		for (size_t i = 0; i < variant->end_count; i++) {
			variant->ends[i].along_m += weight * hull->ends[i].along_m;
			variant->ends[i].y_m += weight * hull->ends[i].y_m;
		}
		for (size_t i = 0; i < variant->profile_count; i++) {
			variant->profile[i].x_m += weight * hull->profile[i].x_m;
			variant->profile[i].y_m += weight * hull->profile[i].y_m;
			variant->profile[i].z_m += weight * hull->profile[i].z_m;
		}
		for (size_t i = 0; i < variant->knuckle_count; i++) {
			variant->knuckles[i].x_m += weight * hull->knuckles[i].x_m;
			variant->knuckles[i].z_m += weight * hull->knuckles[i].z_m;
		}
	}
	for (size_t i = 0; i < variant->end_count; i++)
		variant->ends[i].y_m = fmax(variant->ends[i].y_m, 0);
	for (size_t i = 0; i < variant->profile_count; i++)
		variant->profile[i].y_m = fmax(variant->profile[i].y_m, 0);
}

static double mean_offset(const struct mixture *mixture, const batten_hull *base, size_t station,
                          size_t waterline)
{
	double sum = 0;
	for (size_t k = 0; k < mixture->count; k++) {
		const batten_hull *hull = mixture->hulls[k];
		sum += mixture->weights[k] *
		       hull->y_m[waterline_of(mixture, base, waterline, hull) * hull->station_count +
		                 station_of(mixture, base, station, hull)];
	}
	return sum;
}

static batten_status mean_offsets(const struct mixture *mixture, const batten_hull *base,
                                  batten_hull *variant, batten_vary_outcome *outcome)
{
	double *y = batten_allocate(mixture->context, hull_node_count(base), sizeof *y);
	if (!y)
		return BATTEN_MEMORY;
	size_t negative = 0;
	for (size_t i = 0; i < hull_node_count(base); i++) {
		y[i] = mean_offset(mixture, base, i % base->station_count, i / base->station_count);
		negative += y[i] < -1e-12;
	}
	if (negative > 0)
		(void)snprintf(outcome->warning, sizeof outcome->warning,
		               "%zu half-breadths would be below 0 and are 0", negative);
	const batten_status status = variation_set_offsets(variant, y);
	batten_release(mixture->context, y);
	return status;
}

static double length_of(const batten_hull *hull)
{
	return hull->lbp_m;
}

static double draft_of(const batten_hull *hull)
{
	return hull->draft_m;
}

static double depth_of(const batten_hull *hull)
{
	return hull->depth_m;
}

static batten_status mix(const struct mixture *mixture, batten_hull **out,
                         batten_vary_outcome *outcome)
{
	const batten_hull *parent = mixture->hulls[0], *base = parent;
	for (size_t k = 1; k < mixture->count && !mixture->by_number; k++)
		if (vertex_count(mixture->hulls[k]) > vertex_count(base))
			base = mixture->hulls[k];
	batten_hull *variant = NULL;
	batten_status status = batten_hull_clone(mixture->context, base, &variant);
	if (status != BATTEN_OK)
		return status;
	variant->lbp_m = mean_of(mixture, length_of);
	variant->draft_m = mean_of(mixture, draft_of);
	variant->depth_m = mean_of(mixture, depth_of);
	mean_coordinates(mixture, base, variant);
	mean_extras(mixture, variant);
	char *name = batten_copy_text(mixture->context, parent->name);
	if (!name)
		status = BATTEN_MEMORY;
	else
		batten_release(mixture->context, variant->name);
	if (name)
		variant->name = name;
	if (status == BATTEN_OK)
		status = variation_check_size(variant);
	if (status == BATTEN_OK)
		status = mean_offsets(mixture, base, variant, outcome);
	if (status != BATTEN_OK) {
		batten_hull_destroy(variant);
		return status;
	}
	*out = variant;
	return BATTEN_OK;
}

batten_status variation_average(batten_context *context, const batten_hull *parent,
                                const batten_vary_options *options, batten_hull **out,
                                batten_vary_outcome *outcome)
{
	struct mixture mixture = { .context = context,
		                       .count = options->other_count + 1,
		                       .by_number = true };
	mixture.hulls = batten_allocate(context, mixture.count, sizeof(const batten_hull *));
	mixture.weights = batten_allocate(context, mixture.count, sizeof *mixture.weights);
	batten_status status = mixture.hulls && mixture.weights ? BATTEN_OK : BATTEN_MEMORY;
	if (status == BATTEN_OK) {
		mixture.hulls[0] = parent;
		mixture.weights[0] = 1;
	}
	for (size_t k = 1; k < mixture.count && status == BATTEN_OK; k++) {
		bool by_number = true;
		mixture.hulls[k] = options->others[k - 1];
		mixture.weights[k] = options->weights[k - 1];
		mixture.weights[0] -= mixture.weights[k];
		status = check_pair(parent, mixture.hulls[k], &by_number);
		mixture.by_number = mixture.by_number && by_number;
	}
	for (size_t k = 0; k < mixture.count && status == BATTEN_OK && !mixture.by_number; k++)
		if (has_extras(mixture.hulls[k]))
			status = refuse_extras(parent, mixture.hulls[k]);
	if (status == BATTEN_OK)
		status = mix(&mixture, out, outcome);
	batten_release(context, mixture.hulls);
	batten_release(context, mixture.weights);
	return status;
}
