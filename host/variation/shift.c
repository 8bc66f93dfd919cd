#include "variation/shift.h"

#include <math.h>

/* ------------------------------------------------------------------------------------------------
 * Halves of a curve
 * --------------------------------------------------------------------------------------------- */

static variation_half half_of(const struct spline *curve, const variation_span *span, bool fore)
{
	const double middle = span->middle_m;
	const double from = fore ? middle : span->aft_m;
	const double to = fore ? span->fore_m : middle;
	const double length = to - from;
	const double scale = spline_value(curve, middle) * length;
	const double area = spline_integral(curve, from, to, 0, 1);
	const double first = spline_integral(curve, from, to, 1, 1);
	const double second = spline_integral(curve, from, to, 2, 1);
	const double moment = fore ? first - middle * area : middle * area - first;
	const double about = second - 2 * middle * first + middle * middle * area;
	return (variation_half){ .fullness = area / scale,
		                     .lever = moment / (area * length),
		                     .gyration = about / (area * length * length),
		                     .parallel = fore ? span->parallel_fore : span->parallel_aft };
}

/* A curve is a spline over x; the ordinate amidships must be > 0. */
static variation_halves halves_of(const struct spline *curve, const variation_span *span)
{
	variation_halves halves = { .aft = half_of(curve, span, false),
		                        .fore = half_of(curve, span, true) };
	const double aft = halves.aft.fullness, fore = halves.fore.fullness;
	halves.fullness = 0.5 * (aft + fore);
	halves.centre = (fore * halves.fore.lever - aft * halves.aft.lever) / (aft + fore);
	return halves;
}

/* ------------------------------------------------------------------------------------------------
 * Swing (thesis 2.3.1)
 * --------------------------------------------------------------------------------------------- */

variation_shift variation_shift_swing(const struct spline *curve, const variation_span *span,
                                      double centre_pct, double length_m)
{
	/* ybar = (1/2 integral A^2) / (integral A): dx = dLCB A / ybar keeps the volume and moves its
	 * centre by dLCB, for any size of it. */
	const double area = spline_integral(curve, span->aft_m, span->fore_m, 0, 1);
	const double lever = 0.5 * spline_integral(curve, span->aft_m, span->fore_m, 0, 2) / area;
	const double middle = spline_value(curve, span->middle_m);
	return (variation_shift){ .span = *span,
		                      .swing = curve,
		                      .swing_factor_m = centre_pct / 100 * length_m * middle / lever };
}

static double chord_end(const variation_shift *shift, double x_m)
{
	return shift->without_chord ? 0 : spline_value(shift->swing, x_m);
}

/* The curve over the straight line between its ends, so that the ends stay. */
static double over_chord(const variation_shift *shift, double x_m)
{
	const double aft = chord_end(shift, shift->span.aft_m);
	const double fore = chord_end(shift, shift->span.fore_m);
	const double part = (x_m - shift->span.aft_m) / (shift->span.fore_m - shift->span.aft_m);
	const double middle = spline_value(shift->swing, shift->span.middle_m);
	return (spline_value(shift->swing, x_m) - aft - part * (fore - aft)) / middle;
}

/* By one metre of factor. */
static double unit_slope(const variation_shift *shift, double x_m)
{
	const variation_span *span = &shift->span;
	const double chord = (chord_end(shift, span->fore_m) - chord_end(shift, span->aft_m)) /
	                     (span->fore_m - span->aft_m);
	return (spline_slope(shift->swing, x_m) - chord) / spline_value(shift->swing, span->middle_m);
}

/* Where the slope of the curve may be least or greatest: at the ends of interval i, or where it bends
 * not. */
static void slope_places(const struct spline *curve, size_t i, double places[2])
{
	places[0] = places[1] = curve->x[i];
	if (i + 1 < curve->count && curve->second[i] * curve->second[i + 1] < 0)
		places[1] += (curve->x[i + 1] - curve->x[i]) * curve->second[i] /
		             (curve->second[i] - curve->second[i + 1]);
}

void variation_shift_swing_slopes(const variation_shift *shift, double *least, double *most)
{
	*least = INFINITY;
	*most = -INFINITY;
	for (size_t i = 0; i < shift->swing->count; i++) {
		double places[2];
		slope_places(shift->swing, i, places);
		for (size_t k = 0; k < 2; k++) {
			*least = fmin(*least, unit_slope(shift, places[k]));
			*most = fmax(*most, unit_slope(shift, places[k]));
		}
	}
}

static bool swing_folds(const variation_shift *shift, double *x_m)
{
	const struct spline *curve = shift->swing;
	for (size_t i = 0; i < curve->count; i++) {
		double places[2];
		slope_places(curve, i, places);
		for (size_t k = 0; k < 2; k++)
			if (!(1 + shift->swing_factor_m * unit_slope(shift, places[k]) > 0)) {
				*x_m = places[k];
				return true;
			}
	}
	return false;
}

/* ------------------------------------------------------------------------------------------------
 * One minus prismatic, Lackenby (thesis 2.3.2, 2.3.3; Lackenby 1950)
 * --------------------------------------------------------------------------------------------- */

/* Of the moment that a change of one half's fullness and of its parallel body brings: B dCp - D dp. */
struct lever {
	double b, d;
};

/* What goes to each half so that the whole changes by what is asked for. */
static void split(const variation_halves *halves, const variation_change *change, struct lever aft,
                  struct lever fore, double dp_aft, double dp_fore, variation_shift *out)
{
	const double centre = isnan(change->centre_used_pct) ? halves->centre
	                                                     : change->centre_used_pct / 50;
	const double more = halves->fullness * change->fullness_pct / 100;
	const double moment = change->centre_pct / 50 * (halves->fullness + more);
	const double parallel = fore.d * dp_fore - aft.d * dp_aft;
	out->fullness_fore = (2 * (more * (aft.b + centre) + moment) + parallel) / (fore.b + aft.b);
	out->fullness_aft = (2 * (more * (fore.b - centre) - moment) - parallel) / (fore.b + aft.b);
}

static struct lever one_minus_lever(const variation_half *half)
{
	const double full = half->fullness;
	return (struct lever){ full * (1 - 2 * half->lever) / (1 - full), 0 };
}

/* Where the section amidships stands after the move. Two halves that run into each other have no
 * body, which variation_shift_folds() tells. */
static void find_body(variation_shift *shift)
{
	const variation_span *span = &shift->span;
	const double aft = shift->aft.parallel + (1 - shift->aft.parallel) * shift->aft.constant;
	const double fore = shift->fore.parallel + (1 - shift->fore.parallel) * shift->fore.constant;
	shift->body_from_m = span->middle_m - aft * (span->middle_m - span->aft_m);
	shift->body_to_m = span->middle_m + fore * (span->fore_m - span->middle_m);
	shift->body = span->parallel_aft > 0 || span->parallel_fore > 0 ||
	              fabs(shift->body_to_m - shift->body_from_m) >
	                  VARIATION_BODY_PART * (span->fore_m - span->aft_m);
}

bool variation_shift_one_minus(const struct spline *curve, const variation_span *span,
                               const variation_change *change, variation_shift *out)
{
	const variation_halves halves = halves_of(curve, span);
	if (!(halves.aft.fullness < 1 && halves.fore.fullness < 1))
		return false;
	const struct lever aft = one_minus_lever(&halves.aft), fore = one_minus_lever(&halves.fore);
	variation_shift shift = { .span = *span };
	split(&halves, change, aft, fore, 0, 0, &shift);
	shift.aft = (variation_half_shift){ halves.aft.parallel,
		                                shift.fullness_aft / (1 - halves.aft.fullness), 0 };
	shift.fore = (variation_half_shift){ halves.fore.parallel,
		                                 shift.fullness_fore / (1 - halves.fore.fullness), 0 };
	find_body(&shift);
	*out = shift;
	return true;
}

/* A = Cp (1 - 2 xbar) - p (1 - Cp): what a shift (1 - x)(x - p) adds to the area. */
static double lackenby_room(const variation_half *half)
{
	return half->fullness * (1 - 2 * half->lever) - half->parallel * (1 - half->fullness);
}

static struct lever lackenby_lever(const variation_half *half)
{
	const double full = half->fullness, bar = half->lever, p = half->parallel;
	const double b = full * (2 * bar - 3 * half->gyration - p * (1 - 2 * bar)) /
	                 lackenby_room(half);
	return (struct lever){ b, (b * (1 - full) - full * (1 - 2 * bar)) / (1 - p) };
}

static variation_half_shift lackenby_half(const variation_half *half, double fuller, double dp)
{
	const double constant = dp / (1 - half->parallel);
	return (variation_half_shift){
		half->parallel, constant, (fuller - constant * (1 - half->fullness)) / lackenby_room(half)
	};
}

bool variation_shift_lackenby(const struct spline *curve, const variation_span *span,
                              const variation_change *change, variation_shift *out)
{
	const variation_halves halves = halves_of(curve, span);
	if (!(lackenby_room(&halves.aft) > 1e-9 && lackenby_room(&halves.fore) > 1e-9))
		return false;
	const struct lever aft = lackenby_lever(&halves.aft), fore = lackenby_lever(&halves.fore);
	const double dp_aft = change->parallel_aft_pct / 100;
	const double dp_fore = change->parallel_fore_pct / 100;
	variation_shift shift = { .span = *span };
	split(&halves, change, aft, fore, dp_aft, dp_fore, &shift);
	shift.aft = lackenby_half(&halves.aft, shift.fullness_aft, dp_aft);
	shift.fore = lackenby_half(&halves.fore, shift.fullness_fore, dp_fore);
	find_body(&shift);
	*out = shift;
	return true;
}

static variation_half_numbers half_numbers(const variation_half *half, double length_m,
                                           bool lackenby)
{
	const struct lever lever = lackenby ? lackenby_lever(half) : one_minus_lever(half);
	return (variation_half_numbers){ .parallel = half->parallel,
		                             .length_m = length_m,
		                             .fullness = half->fullness,
		                             .lever = lever.b,
		                             .body_lever = lever.d,
		                             .by_fullness = lackenby ? 0 : 1 / (1 - half->fullness),
		                             .by_body = lackenby ? 1 / (1 - half->parallel) : 0,
		                             .linear = lackenby ? 1 / lackenby_room(half) : 0 };
}

bool variation_shift_numbers(const struct spline *curve, const variation_span *span, bool lackenby,
                             variation_numbers *out)
{
	const variation_halves halves = halves_of(curve, span);
	if (lackenby ? !(lackenby_room(&halves.aft) > 1e-9 && lackenby_room(&halves.fore) > 1e-9)
	             : !(halves.aft.fullness < 1 && halves.fore.fullness < 1))
		return false;
	*out = (variation_numbers){
		.aft = half_numbers(&halves.aft, span->middle_m - span->aft_m, lackenby),
		.fore = half_numbers(&halves.fore, span->fore_m - span->middle_m, lackenby),
		.fullness = halves.fullness,
		.centre = halves.centre,
	};
	return true;
}

/* ------------------------------------------------------------------------------------------------
 * Any shift
 * --------------------------------------------------------------------------------------------- */

double variation_shift_at(const variation_shift *shift, double x_m)
{
	const variation_span *span = &shift->span;
	if (x_m <= span->aft_m || x_m >= span->fore_m)
		return 0;
	if (shift->swing)
		return shift->swing_factor_m * over_chord(shift, x_m);
	/* The section amidships belongs to the fore half. */
	const bool fore = x_m >= span->middle_m;
	const double length = fore ? span->fore_m - span->middle_m : span->middle_m - span->aft_m;
	const variation_half_shift *half = fore ? &shift->fore : &shift->aft;
	/* The parallel body goes with its end. */
	const double x = fmax(fabs(x_m - span->middle_m) / length, half->parallel);
	const double move = (1 - x) * (half->constant + half->linear * (x - half->parallel)) * length;
	return fore ? move : -move;
}

static bool half_folds(const variation_half_shift *half)
{
	const double room = 1 - half->parallel;
	/* The derivative is linear: its ends tell. */
	return !(1 - half->constant + half->linear * room > 0 &&
	         1 - half->constant - half->linear * room > 0);
}

bool variation_shift_folds(const variation_shift *shift, double *x_m)
{
	const variation_span *span = &shift->span;
	if (shift->swing)
		return swing_folds(shift, x_m);
	*x_m = 0.5 * (span->aft_m + span->middle_m);
	if (half_folds(&shift->aft))
		return true;
	*x_m = 0.5 * (span->fore_m + span->middle_m);
	if (half_folds(&shift->fore))
		return true;
	*x_m = span->middle_m;
	return shift->body_to_m - shift->body_from_m <
	       -VARIATION_BODY_PART * (span->fore_m - span->aft_m);
}

batten_status variation_shift_curve(batten_context *context, const variation_shift *shift,
                                    const struct spline *curve, struct spline *out)
{
	*out = (struct spline){ 0 };
	double *moved = batten_allocate(context, curve->count, sizeof *moved);
	if (!moved)
		return BATTEN_MEMORY;
	for (size_t i = 0; i < curve->count; i++)
		moved[i] = curve->x[i] + variation_shift_at(shift, curve->x[i]);
	const batten_status status = spline_create(context, curve->count, moved, curve->y,
	                                           SPLINE_NATURAL, out);
	batten_release(context, moved);
	return status;
}
