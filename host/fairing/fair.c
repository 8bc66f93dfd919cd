/* batten_hull_fair: one hull from its input to the faired form (thesis 4.5, 7). */
#include "fairing/box.h"
#include "fairing/gross_errors.h"
#include "fairing/noise.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The discrepancy principle: fairing may change the offsets by about their noise and not by more. The
 * weights tried, w2/w1 = 1, 10^(1/4), 10^(1/2) ... and one so stiff that nothing moves, run as one
 * batch; the least whose change stays within NOISE_PART of the noise is taken. */
#define NOISE_PART 0.75
#define STIFFEST_RATIO 1e12
enum { RATIO_COUNT = 32, RATIOS_A_DECADE = 4 };

struct batten_fairing {
	batten_context *context;
	batten_hull *input, *smoothed, *faired;
	uint8_t *locked;
	batten_replacement *replacements;
	size_t replacement_count;
	batten_search_result result;
	batten_run run;
	batten_fairing_facts facts;
};

void batten_fair_options_default(batten_fair_options *options)
{
	*options = (batten_fair_options){ .struct_size = sizeof *options,
		                              .smooth = true,
		                              .max_distance_m = -1.0,
		                              .max_distance_part = 0.01 };
	batten_search_options_default(&options->search);
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
	return BATTEN_OK;
}

static double ratio_of(size_t i)
{
	return i + 1 < RATIO_COUNT ? pow(10.0, (double)i / RATIOS_A_DECADE) : STIFFEST_RATIO;
}

/* Root mean square change over the variables whose half-breadth is given: what happens to a '?' cell
 * is no change of the data. */
static double rms_change(const batten_hull *smoothed, const fairing_box *box, const double *y)
{
	double sum = 0.0;
	size_t count = 0;
	for (size_t n = 0; n < hull_node_count(smoothed); n++)
		if (box->lower_m[n] < box->upper_m[n] && smoothed->nodes[n] == BATTEN_NODE_GIVEN) {
			sum += (y[n] - smoothed->y_m[n]) * (y[n] - smoothed->y_m[n]);
			count++;
		}
	return count > 0 ? sqrt(sum / (double)count) : 0.0;
}

/* Number of the search whose weight is taken. */
static size_t choose(const batten_fairing *fairing, const fairing_box *box, const double *y,
                     size_t count)
{
	const size_t nodes = hull_node_count(fairing->smoothed);
	for (size_t i = 0; i < count; i++)
		if (rms_change(fairing->smoothed, box, y + i * nodes) <=
		    NOISE_PART * fairing->facts.noise_m)
			return i;
	return count - 1;
}

static void keep(batten_fairing *fairing, const fairing_box *box, const double *y)
{
	batten_hull *faired = fairing->faired;
	const size_t nodes = hull_node_count(faired);
	for (size_t n = 0; n < nodes; n++) {
		if (faired->nodes[n] == BATTEN_NODE_OUTSIDE)
			continue;
		faired->y_m[n] = y[n];
		if (box->lower_m[n] < box->upper_m[n] &&
		    (y[n] <= box->lower_m[n] || y[n] >= box->upper_m[n]))
			fairing->facts.at_limit_count++;
	}
	fairing->facts.variable_count = box->variable_count;
	fairing->facts.rms_change_m = rms_change(fairing->smoothed, box, y);
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

static batten_status search(batten_fairing *fairing, const batten_fair_options *options,
                            const fairing_box *box)
{
	batten_context *context = fairing->context;
	const batten_hull *hull = fairing->smoothed;
	const size_t nodes = hull_node_count(hull);
	const size_t count = options->weights_given ? 1 : RATIO_COUNT;
	batten_search_problem problems[RATIO_COUNT];
	batten_search_result results[RATIO_COUNT];
	for (size_t i = 0; i < count; i++)
		problems[i] = (batten_search_problem){
			.nodes = hull->nodes,
			.start_m = hull->y_m,
			.target_m = hull->y_m,
			.lower_m = box->lower_m,
			.upper_m = box->upper_m,
			.closeness_weight = box->closeness_weight,
			.w1 = options->weights_given ? options->w1 : 1.0,
			.w2 = options->weights_given ? options->w2 : ratio_of(i),
			.half_beam_m = batten_hull_half_beam_m(hull),
		};
	double *y = batten_allocate(context, count, nodes * sizeof *y);
	if (!y)
		return BATTEN_MEMORY;
	const batten_grid grid = { hull->station_count, hull->waterline_count, hull->x_m, hull->z_m };
	batten_status status = batten_search_batch(context, &grid, count, problems, &options->search, y,
	                                           results, &fairing->run);
	if (status == BATTEN_OK || status == BATTEN_INCOMPLETE) {
		const size_t chosen = options->weights_given ? 0 : choose(fairing, box, y, count);
		fairing->result = results[chosen];
		fairing->facts.w1 = problems[chosen].w1;
		fairing->facts.w2 = problems[chosen].w2;
		keep(fairing, box, y + chosen * nodes);
		/* A '?' is what its line makes of it, so that the faired hull measures the same when its
		 * file is read again. */
		status = hull_fill_unknown(fairing->faired, &fairing->facts.filled_count);
		if (status == BATTEN_OK)
			status = mark_source(fairing);
		/* A weight that was tried and not taken may have met the limit. */
		if (status == BATTEN_OK && fairing->result.end == BATTEN_SEARCH_LIMIT)
			status = BATTEN_INCOMPLETE;
	}
	batten_release(context, y);
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

static batten_status run(batten_fairing *fairing, const batten_hull *hull,
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
	fairing->facts.weights_by_noise = !options->weights_given;
	fairing->facts.max_distance_m = options->max_distance_m >= 0.0
	                                    ? options->max_distance_m
	                                    : options->max_distance_part *
	                                          batten_hull_half_beam_m(fairing->smoothed);
	fairing_box box = { 0 };
	status = fairing_box_create(context, fairing->smoothed, options, fairing->locked,
	                            fairing->facts.max_distance_m, &box);
	if (status == BATTEN_OK)
		status = search(fairing, options, &box);
	fairing_box_release(context, &box);
	return status;
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

void batten_fairing_destroy(batten_fairing *fairing)
{
	if (!fairing)
		return;
	batten_hull_destroy(fairing->input);
	batten_hull_destroy(fairing->smoothed);
	batten_hull_destroy(fairing->faired);
	batten_release(fairing->context, fairing->locked);
	batten_release(fairing->context, fairing->replacements);
	batten_release(fairing->context, fairing);
}

const batten_hull *batten_fairing_input(const batten_fairing *fairing)
{
	return fairing->input;
}

const batten_hull *batten_fairing_smoothed(const batten_fairing *fairing)
{
	return fairing->smoothed;
}

const batten_hull *batten_fairing_faired(const batten_fairing *fairing)
{
	return fairing->faired;
}

size_t batten_fairing_replacement_count(const batten_fairing *fairing)
{
	return fairing->replacement_count;
}

const batten_replacement *batten_fairing_replacements(const batten_fairing *fairing)
{
	return fairing->replacements;
}

const batten_search_result *batten_fairing_result(const batten_fairing *fairing)
{
	return &fairing->result;
}

const batten_run *batten_fairing_run(const batten_fairing *fairing)
{
	return &fairing->run;
}

batten_fairing_facts batten_fairing_describe(const batten_fairing *fairing)
{
	return fairing->facts;
}
