#include "fairing/net_fit.h"
#include "fairing/noise.h"

#include <math.h>

/* Deviations below this part of the half-beam are rounding. */
static const double exact = 1e-9;
enum { PARTS = 8, FIRST_PART = 4 };

/* Points of the longest line of one direction. */
static batten_status longest_line(const batten_hull *hull, bool waterlines, size_t *out)
{
	const size_t lines = waterlines ? hull->waterline_count : hull->station_count;
	*out = 0;
	for (size_t i = 0; i < lines; i++) {
		hull_line line;
		const batten_status status = hull_line_collect(hull, waterlines, i, false, &line);
		if (status != BATTEN_OK)
			return status;
		if (line.count > *out)
			*out = line.count;
		hull_line_release(hull, &line);
	}
	return BATTEN_OK;
}

static size_t between(size_t value, size_t least, size_t most)
{
	return value < least ? least : value > most ? most : value;
}

static size_t count_points(const batten_hull *hull)
{
	size_t points = hull->end_count + hull->profile_count;
	for (size_t n = 0; n < hull_node_count(hull); n++)
		points += hull->nodes[n] == BATTEN_NODE_GIVEN;
	return points;
}

/* The largest net for the counts that are 0. */
static batten_status choose_largest(const batten_hull *hull, batten_fit_options *fit)
{
	size_t along = 0;
	size_t up = 0;
	batten_status status = longest_line(hull, true, &along);
	if (status == BATTEN_OK)
		status = longest_line(hull, false, &up);
	if (status != BATTEN_OK)
		return status;
	const size_t most = 7 * count_points(hull) / 10;
	const bool choose_u = fit->count_u == 0;
	const bool choose_v = fit->count_v == 0;
	if (choose_u)
		fit->count_u = between((8 * along + 9) / 10, fit->order_u, NET_FIT_POLES_MOST);
	if (choose_v)
		fit->count_v = between((7 * up + 9) / 10, fit->order_v, NET_FIT_POLES_MOST);
	if (choose_v && fit->count_v > 7 * fit->count_u / 6)
		fit->count_v = between(7 * fit->count_u / 6, fit->order_v, NET_FIT_POLES_MOST);
	while (choose_v && fit->count_v > fit->order_v && fit->count_u * fit->count_v > most)
		fit->count_v--;
	while (choose_u && fit->count_u > fit->order_u && fit->count_u * fit->count_v > most)
		fit->count_u--;
	return BATTEN_OK;
}

static size_t part_of(size_t count, size_t order, size_t part)
{
	const size_t reduced = (count * part + PARTS - 1) / PARTS;
	return reduced > order ? reduced : order;
}

batten_status net_fit(const batten_hull *hull, const batten_fit_options *options, double noise_m,
                      batten_surface **out, batten_fit_deviation *deviation)
{
	batten_context *context = hull->context;
	batten_fit_options largest = *options;
	const bool choose = options->count_u == 0 && options->count_v == 0;
	batten_status status = choose_largest(hull, &largest);
	if (status != BATTEN_OK)
		return status;
	const double points = (double)count_points(hull);
	for (size_t part = choose ? FIRST_PART : PARTS;; part++) {
		batten_fit_options fit = largest;
		fit.count_u = choose ? part_of(largest.count_u, fit.order_u, part) : largest.count_u;
		fit.count_v = choose ? part_of(largest.count_v, fit.order_v, part) : largest.count_v;
		status = batten_hull_fit(context, hull, &fit, out, deviation);
		if (status != BATTEN_OK || part == PARTS)
			return status;
		const double poles = (double)(fit.count_u * fit.count_v);
		const double left = noise_m * sqrt(fmax(0.0, 1.0 - poles / points));
		if (deviation->rms_m <= fmax(left, exact * batten_hull_half_beam_m(hull)))
			return BATTEN_OK;
		batten_surface_destroy(*out);
		*out = NULL;
	}
}

batten_status batten_hull_fit_chosen(batten_context *context, const batten_hull *hull,
                                     batten_surface **out, batten_fit_deviation *deviation)
{
	batten_fit_options options;
	batten_fit_options_default(&options);
	batten_fit_deviation ignored;
	double noise_m = 0.0;
	const batten_status status = noise_estimate(context, hull, &noise_m);
	return status == BATTEN_OK
	           ? net_fit(hull, &options, noise_m, out, deviation ? deviation : &ignored)
	           : status;
}
