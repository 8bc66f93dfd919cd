/* Varying a parent: options, one row, many rows. */
#include "variation/variation.h"

#include <math.h>
#include <stdio.h>

enum { STRETCH_POINTS_MOST = 64, OTHERS_MOST = 64 };

/* A change below the one is a fraction where percent is meant, perhaps; one above the other too. */
#define SMALL_PCT 0.2
#define LARGE_PCT 30.0

static const char *const method_names[] = {
#define METHOD_NAME(symbol, name, text) name,
	BATTEN_VARY_METHOD_LIST(METHOD_NAME)
#undef METHOD_NAME
};
static const char *const method_texts[] = {
#define METHOD_TEXT(symbol, name, text) text,
	BATTEN_VARY_METHOD_LIST(METHOD_TEXT)
#undef METHOD_TEXT
};

const char *batten_vary_method_name(size_t method)
{
	return method < BATTEN_VARY_METHOD_COUNT ? method_names[method] : NULL;
}

const char *batten_vary_method_text(size_t method)
{
	return method < BATTEN_VARY_METHOD_COUNT ? method_texts[method] : NULL;
}

void batten_vary_options_default(batten_vary_options *options)
{
	*options = (batten_vary_options){ .struct_size = sizeof *options,
		                              .lcb_used_pct = NAN,
		                              .lcf_used_pct = NAN,
		                              .scale_x = 1,
		                              .scale_y = 1,
		                              .scale_z = 1,
		                              .volume_m3 = NAN,
		                              .lcb_pct_lbp_fwd = NAN,
		                              .cp = NAN,
		                              .middle_aft_m = NAN,
		                              .middle_fore_m = NAN,
		                              .preset = BATTEN_VARY_PRESET_COUNT };
}

/* ------------------------------------------------------------------------------------------------
 * Options
 * --------------------------------------------------------------------------------------------- */

/* A number of the options, its range, and whether NaN is one of its values. */
struct number {
	const char *name;
	double value, least, most;
	bool may_be_absent;
};

static batten_status check_numbers(batten_context *context, const batten_vary_options *options)
{
	const struct number numbers[] = {
		{ "dcp", options->dcp_pct, -100, 1000, false },
		{ "dlcb", options->dlcb_pct, -100, 100, false },
		{ "dcwp", options->dcwp_pct, -100, 1000, false },
		{ "dlcf", options->dlcf_pct, -100, 100, false },
		{ "dp_fore", options->dp_fore_pct, -100, 100, false },
		{ "dp_aft", options->dp_aft_pct, -100, 100, false },
		{ "lcb_used", options->lcb_used_pct, -50, 50, true },
		{ "lcf_used", options->lcf_used_pct, -50, 50, true },
		{ "scale_x", options->scale_x, 1e-6, 1e6, false },
		{ "scale_y", options->scale_y, 1e-6, 1e6, false },
		{ "scale_z", options->scale_z, 1e-6, 1e6, false },
		{ "volume_m3", options->volume_m3, 1e-12, 1e12, true },
		{ "lcb_pct_lbp_fwd", options->lcb_pct_lbp_fwd, -50, 50, true },
		{ "cp", options->cp, 1e-3, 1, true },
		{ "middle_aft", options->middle_aft_m, 0, HULL_LARGEST_M, true },
		{ "middle_fore", options->middle_fore_m, 0, HULL_LARGEST_M, true },
		{ "amount", options->amount, -10, 10, false },
	};
	for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
		const struct number *number = &numbers[i];
		if (isnan(number->value) ? !number->may_be_absent
		                         : number->value < number->least || number->value > number->most)
			return batten_fail(context, BATTEN_USAGE, "%s is %g, expected %g to %g", number->name,
			                   number->value, number->least, number->most);
	}
	return BATTEN_OK;
}

static batten_status check_average(batten_context *context, const batten_vary_options *options)
{
	if (options->other_count < 1 || options->other_count > OTHERS_MOST || !options->others ||
	    !options->weights)
		return batten_fail(context, BATTEN_USAGE,
		                   "average of the parent and %zu hulls, expected 1 to %d with weights",
		                   options->other_count, OTHERS_MOST);
	for (size_t i = 0; i < options->other_count; i++) {
		if (!options->others[i])
			return batten_fail(context, BATTEN_USAGE, "average: hull %zu is missing", i + 1);
		if (!(fabs(options->weights[i]) <= 100))
			return batten_fail(context, BATTEN_USAGE,
			                   "average: weight %zu is %g, expected -100 to 100", i + 1,
			                   options->weights[i]);
	}
	return BATTEN_OK;
}

static batten_status check_stretch(batten_context *context, const batten_vary_options *options)
{
	const size_t count = options->point_count;
	if (count < 2 || count > STRETCH_POINTS_MOST || !options->from_part || !options->to_part)
		return batten_fail(context, BATTEN_USAGE, "stretch by %zu points, expected 2 to %d", count,
		                   STRETCH_POINTS_MOST);
	for (size_t i = 0; i < count; i++) {
		const double from = options->from_part[i], to = options->to_part[i];
		if (!(fabs(from) <= 100 && fabs(to) <= 100))
			return batten_fail(context, BATTEN_USAGE,
			                   "stretch: point %zu is %g to %g, expected parts of LBP", i + 1, from,
			                   to);
		if (i > 0 &&
		    !(from - options->from_part[i - 1] >= 1e-6 && to - options->to_part[i - 1] >= 1e-6))
			return batten_fail(context, BATTEN_USAGE,
			                   "stretch: point %zu, %g to %g, is not beyond the one before it, the "
			                   "hull would fold",
			                   i + 1, from, to);
	}
	return BATTEN_OK;
}

static batten_status check_factor(batten_context *context, const batten_vary_factor *factor,
                                  size_t number)
{
	bool good = factor->guard_first <= BATTEN_VARY_GUARD_MOST &&
	            factor->guard_last <= BATTEN_VARY_GUARD_MOST;
	for (size_t k = 0; k < BATTEN_VARY_COEFFICIENTS; k++)
		good = good && fabs(factor->coefficients[k]) <= 1e6;
	return good ? BATTEN_OK
	            : batten_fail(context, BATTEN_USAGE,
	                          "nonlinear: function F%zu has a coefficient beyond 1e6 or a guard "
	                          "above %d",
	                          number, BATTEN_VARY_GUARD_MOST);
}

static batten_status check_nonlinear(batten_context *context, const batten_vary_options *options)
{
	if (!options->factors &&
	    ((int)options->preset < 0 || options->preset >= BATTEN_VARY_PRESET_COUNT))
		return batten_fail(context, BATTEN_USAGE,
		                   "nonlinear: neither a preset nor factors, one of them is expected");
	batten_status status = BATTEN_OK;
	for (size_t i = 0; options->factors && i < 9 && status == BATTEN_OK; i++)
		status = check_factor(context, &options->factors->moves[i / 3][i % 3], i + 1);
	return status;
}

batten_status variation_check_options(batten_context *context, const batten_vary_options *options)
{
	if (options->struct_size != sizeof *options)
		return batten_fail(context, BATTEN_USAGE,
		                   "vary options: not filled by batten_vary_options_default()");
	if ((int)options->method < 0 || options->method >= BATTEN_VARY_METHOD_COUNT)
		return batten_fail(context, BATTEN_USAGE, "method %d: no such method",
		                   (int)options->method);
	const batten_status status = check_numbers(context, options);
	if (status != BATTEN_OK)
		return status;
	switch (options->method) {
	case BATTEN_VARY_AVERAGE:
		return check_average(context, options);
	case BATTEN_VARY_STRETCH:
		return check_stretch(context, options);
	case BATTEN_VARY_NONLINEAR:
		return check_nonlinear(context, options);
	case BATTEN_VARY_FREE_FORM:
		return options->lattice
		           ? BATTEN_OK
		           : batten_fail(context, BATTEN_USAGE, "free-form: a lattice is expected");
	default:
		return BATTEN_OK;
	}
}

void variation_warn_of_size(const batten_vary_options *options, batten_vary_outcome *outcome)
{
	const bool both = options->method == BATTEN_VARY_ONE_MINUS_PRISMATIC ||
	                  options->method == BATTEN_VARY_LACKENBY;
	const bool moor = options->method == BATTEN_VARY_MOOR;
	const bool swing = options->method == BATTEN_VARY_SWING;
	const struct {
		const char *name;
		double value;
		bool counts;
	} changes[] = {
		{ "dcp", options->dcp_pct, both || moor },
		{ "dlcb", options->dlcb_pct, both || moor || swing },
		{ "dcwp", options->dcwp_pct, moor },
		{ "dlcf", options->dlcf_pct, moor },
		{ "dp_fore", options->dp_fore_pct, both },
		{ "dp_aft", options->dp_aft_pct, both },
	};
	for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
		const double size = fabs(changes[i].value);
		if (changes[i].counts && !outcome->warning[0] &&
		    ((size > 0 && size < SMALL_PCT) || size > LARGE_PCT))
			(void)snprintf(outcome->warning, sizeof outcome->warning,
			               "%s is %g percent: is percent what is meant?", changes[i].name,
			               changes[i].value);
	}
}

/* ------------------------------------------------------------------------------------------------
 * Rows
 * --------------------------------------------------------------------------------------------- */

static batten_status make_ready(variation_family *family, const batten_vary_options *options,
                                const variation_parent **out)
{
	const bool sections = options->method <= BATTEN_VARY_MOOR ||
	                      options->method == BATTEN_VARY_THREE_BODY;
	const size_t kind = !sections ? 0 : options->thesis ? 2 : 1;
	variation_parent *ready = &family->ready[kind];
	*out = ready;
	if (family->made[kind])
		return BATTEN_OK;
	batten_status status = variation_parent_create(family->context, family->parent, ready);
	if (status == BATTEN_OK && sections)
		status = variation_parent_sections(ready, options->thesis);
	if (status == BATTEN_OK)
		family->made[kind] = true;
	else
		variation_parent_destroy(ready);
	return status;
}

void variation_family_destroy(variation_family *family)
{
	for (size_t k = 0; k < 3; k++)
		if (family->made[k])
			variation_parent_destroy(&family->ready[k]);
}

batten_status variation_family_vary(variation_family *family, const batten_vary_options *options,
                                    batten_hull **out, batten_vary_outcome *outcome)
{
	*outcome = (batten_vary_outcome){ .status = BATTEN_OK };
	const variation_parent *parent = NULL;
	batten_hull *variant = NULL;
	batten_status status = variation_check_options(family->context, options);
	if (status == BATTEN_OK)
		status = make_ready(family, options, &parent);
	if (status == BATTEN_OK)
		status = variation_iterate(parent, options, &variant, outcome);
	if (status == BATTEN_OK)
		status = variation_mark_source(variant);
	variation_warn_of_size(options, outcome);
	outcome->status = status;
	if (status != BATTEN_OK) {
		(void)snprintf(outcome->reason, sizeof outcome->reason, "%s",
		               batten_context_error(family->context));
		batten_hull_destroy(variant);
		return status;
	}
	*out = variant;
	return BATTEN_OK;
}

batten_status batten_hull_vary(batten_context *context, const batten_hull *parent,
                               const batten_vary_options *options, batten_hull **out,
                               batten_vary_outcome *outcome)
{
	*out = NULL;
	variation_family family = { .context = context, .parent = parent };
	batten_vary_outcome ignored;
	const batten_status status = variation_family_vary(&family, options, out,
	                                                   outcome ? outcome : &ignored);
	variation_family_destroy(&family);
	return status;
}

batten_status batten_hull_vary_batch(batten_context *context, const batten_hull *parent,
                                     size_t count, const batten_vary_options *options,
                                     batten_hull **variants, batten_vary_outcome *outcomes)
{
	variation_family family = { .context = context, .parent = parent };
	size_t failed = 0;
	for (size_t i = 0; i < count; i++) {
		variants[i] = NULL;
		failed += variation_family_vary(&family, &options[i], &variants[i], &outcomes[i]) !=
		          BATTEN_OK;
	}
	variation_family_destroy(&family);
	if (failed > 0)
		return batten_fail(context, BATTEN_INCOMPLETE, "%zu of %zu variants failed", failed, count);
	return BATTEN_OK;
}
