/* batten_hull_fit(): a surface through the offsets of a hull (Letcher 3.6, 4.9). */
#include "geometry/fit.h"

#include <math.h>
#include <string.h>

/* Corrections end after so many rounds that gain less than this part of the deviation. */
static const double least_gain = 1e-3;
enum { PATIENCE = 3 };
/* Deviations below this part of the half-beam are rounding. */
static const double exact = 1e-12;

void batten_fit_options_default(batten_fit_options *options)
{
	*options = (batten_fit_options){
		.struct_size = sizeof *options,
		.order_u = 4,
		.order_v = 4,
		.hold_centreplane = true,
		.correction_limit = 20,
		.stiffness = 1e-6,
	};
}

static batten_status check_options(batten_context *context, const batten_fit_options *options)
{
	const size_t orders[2] = { options->order_u, options->order_v };
	const size_t counts[2] = { options->count_u, options->count_v };
	for (size_t d = 0; d < 2; d++) {
		const char *direction = d == 0 ? "along the hull" : "along the sections";
		if (orders[d] < BSPLINE_ORDER_LEAST || orders[d] > BSPLINE_ORDER_MOST)
			return batten_fail(context, BATTEN_USAGE, "found order %zu %s, expected %d to %d",
			                   orders[d], direction, BSPLINE_ORDER_LEAST, BSPLINE_ORDER_MOST);
		if (counts[d] < orders[d] || counts[d] > BSPLINE_POLES_MOST)
			return batten_fail(context, BATTEN_USAGE,
			                   "found %zu poles %s, expected the order %zu to %d", counts[d],
			                   direction, orders[d], BSPLINE_POLES_MOST);
	}
	if (!(options->stiffness >= 1e-12 && options->stiffness <= 1.0))
		return batten_fail(context, BATTEN_USAGE, "found stiffness %g, expected 1e-12 to 1",
		                   options->stiffness);
	const unsigned known = BATTEN_ROUNDED_KEEL | BATTEN_ROUNDED_STERN | BATTEN_ROUNDED_STEM;
	if (options->rounded & ~known)
		return batten_fail(context, BATTEN_USAGE, "found edge %u to be rounded, which is none",
		                   options->rounded & ~known);
	/* Two rounded ends take two columns each. */
	if ((options->rounded & BATTEN_ROUNDED_KEEL && options->count_v < 3) ||
	    (options->rounded & (BATTEN_ROUNDED_STERN | BATTEN_ROUNDED_STEM) && options->count_u < 4))
		return batten_fail(context, BATTEN_USAGE,
		                   "a rounded edge needs 3 poles along the sections, 4 along the hull");
	return BATTEN_OK;
}

/* An edge lies in the centreplane when all points on it do, and there are any. */
static batten_status choose_edges(batten_context *context, const batten_fit_options *options,
                                  const struct fit_points *points, struct fit_edges *out)
{
	enum { KEEL, STERN, STEM, EDGES };
	static const char *const names[EDGES] = { "keel", "stern", "stem" };
	static const unsigned bits[EDGES] = { BATTEN_ROUNDED_KEEL, BATTEN_ROUNDED_STERN,
		                                  BATTEN_ROUNDED_STEM };
	bool any[EDGES] = { false };
	bool flat[EDGES] = { true, true, true };
	for (size_t p = 0; p < points->count; p++) {
		const struct fit_point *point = &points->point[p];
		const bool on[EDGES] = { point->v == 0.0, point->u == 0.0, point->u == 1.0 };
		for (size_t e = 0; e < EDGES; e++)
			if (on[e]) {
				any[e] = true;
				flat[e] = flat[e] && point->place[1] == 0.0;
			}
	}
	for (size_t e = 0; e < EDGES; e++)
		if (options->rounded & bits[e] && !(any[e] && flat[e]))
			return batten_fail(context, BATTEN_USAGE,
			                   "the %s cannot be rounded: it does not lie in the centreplane",
			                   names[e]);
	const bool hold = options->hold_centreplane;
	*out = (struct fit_edges){
		.keel_flat = any[KEEL] && flat[KEEL] && (hold || options->rounded & bits[KEEL]),
		.stern_flat = any[STERN] && flat[STERN] && (hold || options->rounded & bits[STERN]),
		.stem_flat = any[STEM] && flat[STEM] && (hold || options->rounded & bits[STEM]),
		.rounded = options->rounded,
	};
	return BATTEN_OK;
}

static void measure(const batten_hull *hull, const struct fit_points *points,
                    const struct batten_surface *surface, batten_fit_deviation *out)
{
	const double half_beam = batten_hull_half_beam_m(hull);
	double sum = 0.0;
	*out = (batten_fit_deviation){ .point_count = points->given_count, .max_m = -1.0 };
	for (size_t p = 0; p < points->count; p++) {
		const struct fit_point *point = &points->point[p];
		if (!point->given)
			continue;
		double u = point->u;
		double v = point->v;
		const double distance = fit_nearest(surface, point->place, false, false, &u, &v);
		sum += distance * distance;
		if (distance > out->max_m) {
			out->max_m = distance;
			out->x_m = point->place[0];
			out->y_m = point->place[1];
			out->z_m = point->place[2];
		}
	}
	out->rms_m = sqrt(sum / (double)points->given_count);
	out->rms_pct = 100.0 * out->rms_m / half_beam;
	out->max_pct = 100.0 * out->max_m / half_beam;
}

/* Every point takes the parameters of its nearest point (Hoschek); those on an edge or a crease stay
 * on it, and no point goes over a crease. */
static void correct(struct fit_points *points, const struct batten_surface *surface)
{
	for (size_t p = 0; p < points->count; p++) {
		struct fit_point *point = &points->point[p];
		double u = point->u;
		double v = point->v;
		(void)fit_nearest(surface, point->place, point->on_u, point->on_v, &u, &v);
		if (fit_knuckles_crossed(points, false, point->u, u) ||
		    fit_knuckles_crossed(points, true, point->v, v))
			continue;
		point->u = u;
		point->v = v;
	}
}

static void swap(struct batten_surface **a, struct batten_surface **b)
{
	struct batten_surface *kept = *a;
	*a = *b;
	*b = kept;
}

/* Fits, corrects and fits again as long as that gains; the best stays in *best. *free_pole as
 * fit_net_solve() has it for the points where the table puts them; where corrections leave a pole free,
 * the deviation tells what the net is worth. */
static batten_status improve(const batten_hull *hull, const batten_fit_options *options,
                             const struct fit_edges *edges, struct fit_points *points, bool fill,
                             struct batten_surface **best, batten_fit_deviation *deviation,
                             size_t *free_pole)
{
	struct batten_surface *next = NULL;
	size_t freed = SIZE_MAX;
	batten_status status = fit_net_solve(points, edges, options->stiffness, *best, fill, free_pole);
	if (status != BATTEN_OK || *free_pole != SIZE_MAX)
		return status;
	measure(hull, points, *best, deviation);
	status = batten_surface_clone(hull->context, *best, &next);
	unsigned idle = 0;
	for (unsigned round = 1;
	     status == BATTEN_OK && idle < PATIENCE && round <= options->correction_limit; round++) {
		if (deviation->rms_m <= exact * batten_hull_half_beam_m(hull))
			break;
		batten_fit_deviation found;
		correct(points, idle ? next : *best);
		status = fit_net_solve(points, edges, options->stiffness, next, true, &freed);
		if (status != BATTEN_OK || freed != SIZE_MAX)
			break;
		measure(hull, points, next, &found);
		idle = found.rms_m < (1.0 - least_gain) * deviation->rms_m ? 0 : idle + 1;
		if (found.rms_m < deviation->rms_m) {
			found.corrections = round;
			*deviation = found;
			swap(best, &next);
		}
	}
	batten_surface_destroy(next);
	return status;
}

/* *out stays NULL where the points leave a pole free. */
static batten_status fit_with(const batten_hull *hull, const batten_fit_options *options,
                              const struct fit_outline *outline, enum fit_girth girth, bool fill,
                              struct batten_surface **out, batten_fit_deviation *deviation,
                              size_t *free_pole)
{
	struct fit_points points;
	struct batten_surface *surface = NULL;
	struct fit_edges edges;
	batten_status status = fit_points_create(hull, outline, girth, &points);
	if (status != BATTEN_OK)
		return status;
	status = surface_allocate(hull->context, hull->name, options->order_u, options->order_v,
	                          options->count_u, options->count_v, false, &surface);
	if (status == BATTEN_OK)
		status = fit_points_knots(hull, &points, surface);
	if (status == BATTEN_OK)
		status = choose_edges(hull->context, options, &points, &edges);
	if (status == BATTEN_OK)
		status = improve(hull, options, &edges, &points, fill, &surface, deviation, free_pole);
	fit_points_destroy(&points);
	if (status == BATTEN_OK && *free_pole == SIZE_MAX)
		*out = surface;
	else
		batten_surface_destroy(surface);
	return status;
}

static batten_status fail_free(const batten_hull *hull, const batten_fit_options *options,
                               size_t pole)
{
	return batten_fail(hull->context, BATTEN_INPUT,
	                   "%s: the points do not determine pole %zu of %zu along the hull, %zu of %zu "
	                   "along the sections: too few points there for so many poles",
	                   hull->name, pole % options->count_u + 1, options->count_u,
	                   pole / options->count_u + 1, options->count_v);
}

/* Both ways to spread the points along the sections; the one that comes closer stays. One of them must
 * determine the net: then the table has the points for it, and what the other leaves free goes on
 * straight. */
static batten_status fit_best(const batten_hull *hull, const batten_fit_options *options,
                              struct batten_surface **out, batten_fit_deviation *deviation)
{
	struct fit_outline outline;
	batten_status status = fit_outline_create(hull, &outline);
	if (status != BATTEN_OK)
		return status;
	struct batten_surface *by_chord = NULL;
	batten_fit_deviation found;
	size_t free_pole = SIZE_MAX, free_by_chord = SIZE_MAX;
	status = fit_with(hull, options, &outline, FIT_GIRTH_HEIGHT, false, out, deviation, &free_pole);
	if (status == BATTEN_OK && (!*out || deviation->rms_m > exact * batten_hull_half_beam_m(hull)))
		status = fit_with(hull, options, &outline, FIT_GIRTH_CHORD, *out != NULL, &by_chord, &found,
		                  &free_by_chord);
	if (status == BATTEN_OK && !*out && !by_chord)
		status = fail_free(hull, options, free_pole);
	if (status == BATTEN_OK && by_chord && (!*out || found.rms_m < deviation->rms_m)) {
		swap(out, &by_chord);
		*deviation = found;
	}
	batten_surface_destroy(by_chord);
	fit_outline_destroy(&outline);
	return status;
}

batten_status batten_hull_fit(batten_context *context, const batten_hull *hull,
                              const batten_fit_options *options, batten_surface **out,
                              batten_fit_deviation *deviation)
{
	batten_fit_deviation found;
	batten_surface *surface = NULL;
	batten_hull *copy = NULL;
	batten_status status = check_options(context, options);
	if (status != BATTEN_OK)
		return status;
	/* In memory of this context, with its limit and its errors. */
	status = batten_hull_clone(context, hull, &copy);
	if (status == BATTEN_OK && !(batten_hull_half_beam_m(copy) > 0.0))
		status = batten_fail(context, BATTEN_INPUT, "%s: no half-breadth is above 0",
		                     batten_hull_name(copy));
	if (status == BATTEN_OK)
		status = fit_best(copy, options, &surface, &found);
	batten_hull_destroy(copy);
	if (status != BATTEN_OK) {
		batten_surface_destroy(surface);
		return status;
	}
	*out = surface;
	if (deviation)
		*deviation = found;
	return BATTEN_OK;
}
