/* batten_hull_fair: one hull from its input to the faired form (thesis 4.5, 7). */
#include "fairing/box.h"
#include "fairing/fairing.h"
#include "fairing/gross_errors.h"
#include "fairing/kept.h"
#include "fairing/noise.h"

#include <math.h>
#include <stdio.h>

/* More than the fit of a surface alone takes: a net to be faired should be straight where few
 * points hold it, since only y of its poles is searched. */
#define NET_STIFFNESS 1e-3

void batten_fair_options_default(batten_fair_options *options)
{
	*options = (batten_fair_options){ .struct_size = sizeof *options,
		                              .method = BATTEN_METHOD_SEARCH,
		                              .smooth = true,
		                              .iterations = 5,
		                              .max_distance_m = -1.0,
		                              .max_distance_part = 0.01 };
	batten_pass_options_default(&options->pass);
	batten_search_options_default(&options->search);
	batten_fit_options_default(&options->fit);
	options->fit.stiffness = NET_STIFFNESS;
}

/* What belongs to the other variables. */
static batten_status check_variables(batten_context *context, const batten_fair_options *options)
{
	const unsigned edges = BATTEN_EDGE_KEEL | BATTEN_EDGE_STERN | BATTEN_EDGE_STEM |
	                       BATTEN_EDGE_DECK;
	switch (options->variables) {
	case BATTEN_VARIABLES_OFFSETS:
		if (options->search.fairness != BATTEN_FAIRNESS_BENDING)
			return batten_fail(context, BATTEN_USAGE,
			                   "the fairness of a fairing stands beside its search options");
		if (options->net_lock_count > 0 || options->locked_edges || options->fixed_tangents)
			return batten_fail(context, BATTEN_USAGE,
			                   "locks of poles and edges need the net as variables (--variables "
			                   "net)");
		return BATTEN_OK;
	case BATTEN_VARIABLES_NET:
		if (options->lower || options->upper)
			return batten_fail(
				context, BATTEN_USAGE,
				"lower and upper offsets bound the offsets of a table, not the poles "
				"of a net: --variables offsets knows them");
		if ((options->locked_edges | options->fixed_tangents) & ~edges)
			return batten_fail(context, BATTEN_USAGE, "found edge %u, which is none",
			                   (options->locked_edges | options->fixed_tangents) & ~edges);
		return BATTEN_OK;
	}
	return batten_fail(context, BATTEN_USAGE, "found variables %d, which are none",
	                   (int)options->variables);
}

static batten_status check_options(batten_context *context, const batten_fair_options *options)
{
	if (options->struct_size != sizeof *options)
		return batten_fail(context, BATTEN_USAGE, "fair options of another version of batten");
	if (!isfinite(options->max_distance_m) || !(options->max_distance_part >= 0.0) ||
	    !isfinite(options->max_distance_part))
		return batten_fail(context, BATTEN_USAGE,
		                   "a distance limit must be a number, not negative");
	if (options->weights_given &&
	    (!(options->w1 >= 0.0) || !(options->w2 >= 0.0) || options->w1 > 1e100 ||
	     options->w2 > 1e100 || options->w1 + options->w2 == 0.0))
		return batten_fail(context, BATTEN_USAGE,
		                   "weights w1 = %g, w2 = %g: 0 to 1e100, not both 0, are expected",
		                   options->w1, options->w2);
	batten_status status = fair_pass_check(context, options);
	if (status == BATTEN_OK)
		status = check_variables(context, options);
	return status == BATTEN_OK ? fairing_end_check(context, options) : status;
}

/* A faired table must not pass for the one it came from. */
static batten_status mark_source(batten_fairing *fairing)
{
	batten_hull *hull = fairing->faired;
	char source[HULL_TEXT_MOST + 1];
	const int length = snprintf(source, sizeof source, "%s%sfaired by batten %s", hull->source,
	                            hull->source[0] ? "; " : "", batten_version());
	if (length < 0 || (size_t)length >= sizeof source)
		return BATTEN_OK; /* no room left for it */
	char *copy = batten_copy_text(fairing->context, source);
	if (!copy)
		return BATTEN_MEMORY;
	batten_release(fairing->context, hull->source);
	hull->source = copy;
	return BATTEN_OK;
}

/* A '?' is what its line makes of it, so that the faired hull measures the same when its file is
 * read again. */
static batten_status finish(batten_fairing *fairing)
{
	batten_status status = hull_fill_unknown(fairing->faired, &fairing->facts.filled_count);
	if (status == BATTEN_OK)
		status = mark_source(fairing);
	/* A weight that was tried and not taken may have met the limit. */
	if (status == BATTEN_OK && fairing->result.end == BATTEN_SEARCH_LIMIT)
		status = BATTEN_INCOMPLETE;
	return status;
}

static batten_status prepare(batten_fairing *fairing, const batten_hull *hull,
                             const batten_fair_options *options)
{
	batten_context *context = fairing->context;
	batten_status status = fairing_locks_create(context, hull, options, &fairing->locked);
	if (status == BATTEN_OK)
		status = batten_hull_clone(context, hull, &fairing->input);
	if (status == BATTEN_OK)
		status = batten_hull_clone(context, hull, &fairing->smoothed);
	if (status == BATTEN_OK && options->smooth)
		status = gross_errors_replace(fairing->smoothed, fairing->locked, &fairing->replacements,
		                              &fairing->replacement_count);
	if (status == BATTEN_OK)
		status = hull_fill_unknown(fairing->smoothed, &fairing->facts.filled_count);
	if (status == BATTEN_OK)
		status = batten_hull_clone(context, fairing->smoothed, &fairing->faired);
	if (status == BATTEN_OK)
		status = noise_estimate(context, fairing->smoothed, &fairing->facts.noise_m);
	return status;
}

static batten_status check_hull(batten_context *context, const batten_hull *hull)
{
	if (hull->station_count < 3 || hull->waterline_count < 3)
		return batten_fail(
			context, BATTEN_INPUT,
			"%s: %zu stations and %zu waterlines: 3 of each are needed to fair a hull", hull->name,
			hull->station_count, hull->waterline_count);
	if (!(batten_hull_half_beam_m(hull) > 0.0))
		return batten_fail(context, BATTEN_INPUT, "%s: no half-breadth is above 0", hull->name);
	return BATTEN_OK;
}

/* By the method of the options. */
static batten_status work(batten_fairing *fairing, const batten_fair_options *options)
{
	switch (options->method) {
	case BATTEN_METHOD_SMOOTH:
		return BATTEN_OK;
	case BATTEN_METHOD_SEARCH:
		return options->variables == BATTEN_VARIABLES_NET ? fair_net(fairing, options)
		                                                  : fair_offsets(fairing, options);
	default:
		return fair_pass(fairing, options);
	}
}

batten_status fairing_prepare(batten_fairing *fairing, const batten_hull *hull,
                              const batten_fair_options *options)
{
	batten_context *context = fairing->context;
	batten_status status = check_hull(context, hull);
	if (status == BATTEN_OK)
		status = check_options(context, options);
	if (status == BATTEN_OK)
		status = prepare(fairing, hull, options);
	if (status != BATTEN_OK)
		return status;
	fairing->facts.max_distance_m = options->max_distance_m >= 0.0
	                                    ? options->max_distance_m
	                                    : options->max_distance_part *
	                                          batten_hull_half_beam_m(fairing->smoothed);
	return BATTEN_OK;
}

static batten_status run(batten_fairing *fairing, const batten_hull *hull,
                         const batten_fair_options *options)
{
	batten_status status = fairing_prepare(fairing, hull, options);
	if (status != BATTEN_OK)
		return status;
	fairing->facts.weights_by_noise = !options->weights_given;
	status = work(fairing, options);
	return status == BATTEN_OK || status == BATTEN_INCOMPLETE ? finish(fairing) : status;
}

batten_status batten_hull_fair(batten_context *context, const batten_hull *hull,
                               const batten_fair_options *options, batten_fairing **out)
{
	batten_fair_options chosen;
	batten_fair_options_default(&chosen);
	batten_fairing *fairing = batten_allocate(context, 1, sizeof *fairing);
	if (!fairing)
		return BATTEN_MEMORY;
	fairing->context = context;
	const batten_status status = run(fairing, hull, options ? options : &chosen);
	if (status != BATTEN_OK && status != BATTEN_INCOMPLETE) {
		batten_fairing_destroy(fairing);
		return status;
	}
	*out = fairing;
	return status;
}
