/* One pass of each method. */
#include "variation/three_body.h"
#include "variation/variation.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void note(batten_vary_outcome *outcome, const char *name, double value)
{
	if (outcome->parameter_count < BATTEN_VARY_PARAMETERS_MOST)
		outcome->parameters[outcome->parameter_count++] = (struct batten_vary_parameter){ name,
			                                                                              value };
}

__attribute__((format(printf, 2, 3))) static void warn(batten_vary_outcome *outcome,
                                                       const char *format, ...)
{
	if (outcome->warning[0])
		return;
	va_list arguments;
	va_start(arguments, format);
	(void)vsnprintf(outcome->warning, sizeof outcome->warning, format, arguments);
	va_end(arguments);
}

/* ------------------------------------------------------------------------------------------------
 * Methods that move sections
 * --------------------------------------------------------------------------------------------- */

static void note_halves(batten_vary_outcome *outcome, const batten_vary_options *options,
                        const variation_shift *shift)
{
	note(outcome, "dcp_aft", shift->fullness_aft);
	note(outcome, "dcp_fore", shift->fullness_fore);
	if (options->method == BATTEN_VARY_ONE_MINUS_PRISMATIC) {
		note(outcome, "c_aft", shift->aft.constant);
		note(outcome, "c_fore", shift->fore.constant);
	} else {
		note(outcome, "a_aft", shift->aft.linear);
		note(outcome, "a_fore", shift->fore.linear);
	}
}

/* The shift of the sectional area curve that the first two parameters ask for. */
static batten_status area_shift(const variation_parent *parent, const batten_vary_options *options,
                                const double *p, variation_shift *out, batten_vary_outcome *outcome)
{
	if (options->method == BATTEN_VARY_SWING) {
		*out = variation_shift_swing(&parent->areas, &parent->span, p[0], parent->hull->lbp_m);
		out->without_chord = options->thesis;
		note(outcome, "dx_midship_m", variation_shift_at(out, parent->span.middle_m));
		return BATTEN_OK;
	}
	const variation_change change = { .fullness_pct = p[0],
		                              .centre_pct = p[1],
		                              .centre_used_pct = options->lcb_used_pct,
		                              .parallel_aft_pct = options->dp_aft_pct,
		                              .parallel_fore_pct = options->dp_fore_pct };
	const bool one_minus = options->method == BATTEN_VARY_ONE_MINUS_PRISMATIC;
	const bool good = one_minus
	                      ? variation_shift_one_minus(&parent->areas, &parent->span, &change, out)
	                      : variation_shift_lackenby(&parent->areas, &parent->span, &change, out);
	if (!good)
		return batten_fail(
			parent->context, BATTEN_INPUT,
			"%s: a half of its sectional area curve is full, nothing is left to move",
			parent->hull->name);
	out->body_open = options->thesis;
	note_halves(outcome, options, out);
	return BATTEN_OK;
}

static batten_status build_moor(const variation_parent *parent, const batten_vary_options *options,
                                const double *p, const variation_shift *areas, batten_hull *variant,
                                batten_vary_outcome *outcome)
{
	const variation_change change = { .fullness_pct = p[2],
		                              .centre_pct = p[3],
		                              .centre_used_pct = options->lcf_used_pct };
	variation_shift waterline;
	if (!variation_shift_lackenby(&parent->waterline, &parent->span, &change, &waterline))
		return batten_fail(parent->context, BATTEN_INPUT,
		                   "%s: a half of its load waterline is full, nothing is left to move",
		                   parent->hull->name);
	note(outcome, "a_aft_waterline", waterline.aft.linear);
	note(outcome, "a_fore_waterline", waterline.fore.linear);
	variation_moor moor;
	batten_status status = variation_moor_create(parent, areas, &waterline, &moor);
	if (status != BATTEN_OK)
		return status;
	size_t unmatched = 0;
	status = variation_moor_apply(&moor, variant, &unmatched);
	if (status == BATTEN_OK && unmatched > 0)
		warn(outcome,
		     "%zu stations found no section with the area and breadth asked for; the nearest was "
		     "taken",
		     unmatched);
	variation_moor_destroy(&moor);
	return status;
}

static batten_status build_moved(const variation_parent *parent, const batten_vary_options *options,
                                 const double *p, batten_hull **out, batten_vary_outcome *outcome)
{
	variation_shift shift;
	batten_status status = area_shift(parent, options, p, &shift, outcome);
	if (status != BATTEN_OK)
		return status;
	batten_hull *variant = NULL;
	status = batten_hull_clone(parent->context, parent->hull, &variant);
	if (status != BATTEN_OK)
		return status;
	status = options->method == BATTEN_VARY_MOOR
	             ? build_moor(parent, options, p, &shift, variant, outcome)
	             : variation_move_sections(parent, &shift, variant);
	if (status == BATTEN_OK)
		status = variation_check_size(variant);
	if (status != BATTEN_OK) {
		batten_hull_destroy(variant);
		return status;
	}
	*out = variant;
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Three bodies
 * --------------------------------------------------------------------------------------------- */

static batten_status find_middle(const variation_parent *parent, const batten_vary_options *options,
                                 double *aft_m, double *fore_m)
{
	const variation_span *span = &parent->span;
	*aft_m = isnan(options->middle_aft_m)
	             ? span->middle_m - span->parallel_aft * (span->middle_m - span->aft_m)
	             : options->middle_aft_m;
	*fore_m = isnan(options->middle_fore_m)
	              ? span->middle_m + span->parallel_fore * (span->fore_m - span->middle_m)
	              : options->middle_fore_m;
	if (*aft_m > 0 && *aft_m < *fore_m && *fore_m < parent->hull->lbp_m)
		return BATTEN_OK;
	return batten_fail(parent->context, BATTEN_INPUT,
	                   "%s: middle body from x = %g to %g m, a part of 0 to %g m is expected (a "
	                   "parent without parallel body needs to be told where its middle body is)",
	                   parent->hull->name, *aft_m, *fore_m, parent->hull->lbp_m);
}

static three_body bodies_of(const variation_parent *parent, double aft_m, double fore_m)
{
	const double lbp = parent->hull->lbp_m;
	const struct spline *areas = &parent->areas;
	const double from[3] = { fore_m, aft_m, parent->span.aft_m };
	const double to[3] = { parent->span.fore_m, fore_m, aft_m };
	const double bow[3] = { lbp, fore_m, aft_m };
	three_body body = { .length = { lbp - fore_m, fore_m - aft_m, aft_m },
		                .waterline = { 1, 1, 1 },
		                .section_area = spline_value(areas, parent->span.middle_m) };
	for (size_t i = 0; i < 3; i++) {
		body.volume[i] = spline_integral(areas, from[i], to[i], 0, 1);
		body.centre[i] = (bow[i] - spline_integral(areas, from[i], to[i], 1, 1) / body.volume[i]) /
		                 body.length[i];
	}
	return body;
}

/* What is asked, carried from the parent as it is measured to the parent as three bodies. */
static three_body_target target_of(const variation_parent *parent, const three_body *body,
                                   const double *p)
{
	static const double one[3] = { 1, 1, 1 };
	const batten_measures *measured = &parent->measures;
	three_body_target target = three_body_measure(body, one);
	target.volume *= p[0] / measured->volume_m3;
	target.centre -= (p[1] - measured->lcb_pct_lbp_fwd) / 100;
	target.cp *= p[2] / measured->cp;
	return target;
}

static batten_status build_bodies(const variation_parent *parent,
                                  const batten_vary_options *options, const double *p,
                                  batten_hull **out, batten_vary_outcome *outcome)
{
	double aft = 0, fore = 0, factors[2][3] = { { 0 } };
	size_t rejected = 0;
	batten_status status = find_middle(parent, options, &aft, &fore);
	if (status != BATTEN_OK)
		return status;
	const three_body body = bodies_of(parent, aft, fore);
	const three_body_target target = target_of(parent, &body, p);
	const size_t count = three_body_solve(&body, &target, factors, &rejected);
	if (count == 0)
		return batten_fail(parent->context, BATTEN_INPUT,
		                   rejected > 0 ? "every solution has a body stretched by 0 or less"
		                                : "no lengths of the three bodies give what is asked for");
	if (count > 1)
		warn(outcome,
		     "two solutions: stretched by %.4g, %.4g, %.4g (taken) and by %.4g, %.4g, %.4g",
		     factors[0][0], factors[0][1], factors[0][2], factors[1][0], factors[1][1],
		     factors[1][2]);
	note(outcome, "lambda_fore", factors[0][0]);
	note(outcome, "lambda_middle", factors[0][1]);
	note(outcome, "lambda_aft", factors[0][2]);
	const double length = parent->hull->lbp_m;
	const double from[4] = { 0, aft, fore, length };
	double to[4] = { 0 };
	for (size_t i = 0; i < 3; i++)
		to[i + 1] = to[i] + factors[0][2 - i] * (from[i + 1] - from[i]);
	return variation_stretch_along(parent->context, parent->hull, 4, from, to, true, out);
}

batten_status variation_build(const variation_parent *parent, const batten_vary_options *options,
                              const double *p, batten_hull **out, batten_vary_outcome *outcome)
{
	outcome->parameter_count = 0;
	outcome->warning[0] = '\0';
	outcome->passes++;
	switch (options->method) {
	case BATTEN_VARY_AVERAGE:
		return variation_average(parent->context, parent->hull, options, out, outcome);
	case BATTEN_VARY_AFFINE:
		return variation_affine(parent->context, parent->hull, options, out);
	case BATTEN_VARY_STRETCH:
		return variation_stretch(parent->context, parent->hull, options, out);
	case BATTEN_VARY_NONLINEAR:
		return variation_nonlinear(parent->context, parent->hull, options, out, outcome);
	case BATTEN_VARY_FREE_FORM:
		return variation_free_form(parent->context, parent->hull, options, out, outcome);
	case BATTEN_VARY_THREE_BODY:
		return build_bodies(parent, options, p, out, outcome);
	default:
		return build_moved(parent, options, p, out, outcome);
	}
}
