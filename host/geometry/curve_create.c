/* Life of a curve, its options and its parameters. */
#include "geometry/curve.h"

#include <math.h>
#include <string.h>

void batten_curve_options_default(batten_curve_options *options)
{
	*options = (batten_curve_options){ .struct_size = sizeof *options,
		                               .form = BATTEN_CURVE_SPLINE,
		                               .parameter = BATTEN_PARAMETER_CHORD,
		                               .order = 4 };
}

static const char *form_word(batten_curve_form form)
{
	static const char *const words[] = {
#define BATTEN_CURVE_FORM_WORD(name, word, text) word,
		BATTEN_CURVE_FORM_LIST(BATTEN_CURVE_FORM_WORD)
#undef BATTEN_CURVE_FORM_WORD
	};
	return words[form];
}

/* ------------------------------------------------------------------------------------------------
 * Parameters
 * --------------------------------------------------------------------------------------------- */

static double chord(const batten_curve *curve, size_t i)
{
	double square = 0;
	for (size_t c = 0; c < curve->dimension; c++) {
		const double *p = curve->points + i * curve->dimension + c;
		square += (p[0] - p[-(ptrdiff_t)curve->dimension]) *
		          (p[0] - p[-(ptrdiff_t)curve->dimension]);
	}
	return sqrt(square);
}

static double parameter_of(const batten_curve *curve, const batten_curve_options *options, size_t i)
{
	switch (options->parameter) {
	case BATTEN_PARAMETER_UNIFORM:
		return (double)i;
	case BATTEN_PARAMETER_X:
		return curve->points[i * curve->dimension];
	case BATTEN_PARAMETER_GIVEN:
		return options->parameters[i];
	case BATTEN_PARAMETER_CHORD:
		break;
	}
	return i == 0 ? 0 : curve->parameters[i - 1] + chord(curve, i);
}

static batten_status find_parameters(batten_curve *curve, const batten_curve_options *options)
{
	bool by_x = options->parameter == BATTEN_PARAMETER_X;
	for (size_t i = 0; i < curve->count; i++) {
		curve->parameters[i] = parameter_of(curve, options, i);
		curve->size += i > 0 ? chord(curve, i) : 0;
		if (!isfinite(curve->parameters[i]) ||
		    (i > 0 && !(curve->parameters[i] > curve->parameters[i - 1])))
			return batten_fail(curve->context, by_x ? BATTEN_INPUT : BATTEN_USAGE,
			                   "found %s %g at point %zu, expected %s",
			                   by_x ? "x" : "the parameter", curve->parameters[i], i + 1,
			                   by_x ? "x to ascend, as y(x) needs it" : "parameters that ascend");
	}
	return BATTEN_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Life
 * --------------------------------------------------------------------------------------------- */

static batten_status check_options(batten_context *context, const batten_curve_options *options)
{
	if (options->struct_size != sizeof *options)
		return batten_fail(context, BATTEN_USAGE,
		                   "options of a curve not made by batten_curve_options_default()");
	if (options->form > BATTEN_CURVE_BSPLINE_FIT || options->parameter > BATTEN_PARAMETER_GIVEN)
		return batten_fail(context, BATTEN_USAGE,
		                   "a form or parameter of a curve of no known kind");
	if (options->parameter == BATTEN_PARAMETER_GIVEN && !options->parameters)
		return batten_fail(context, BATTEN_USAGE, "the parameters of a curve are not given");
	return BATTEN_OK;
}

static batten_status fill(batten_curve *curve, const batten_points *points,
                          const batten_curve_options *options)
{
	const char *word = form_word(options->form);
	bool polygon = options->form == BATTEN_CURVE_BEZIER || options->form == BATTEN_CURVE_BSPLINE;
	curve->label = batten_copy_text(curve->context, options->label ? options->label : word);
	curve->points = batten_allocate(curve->context, points->count * points->dimension,
	                                sizeof *curve->points);
	curve->parameters = batten_allocate(curve->context, points->count, sizeof *curve->parameters);
	if (!curve->label || !curve->points || !curve->parameters)
		return BATTEN_MEMORY;
	memcpy(curve->points, points->m, points->count * points->dimension * sizeof *curve->points);
	batten_status status = find_parameters(curve, options);
	curve->by_x = options->parameter == BATTEN_PARAMETER_X && !polygon;
	if (status == BATTEN_OK)
		status = curve_forms_make(curve, options);
	if (status == BATTEN_OK)
		curve->mean_speed = curve->size /
		                    (curve->breaks[curve->break_count - 1] - curve->breaks[0]);
	return status;
}

batten_status batten_curve_create(batten_context *context, const batten_points *points,
                                  const batten_curve_options *options, batten_curve **out)
{
	batten_curve_options chosen;
	batten_curve_options_default(&chosen);
	*out = NULL;
	if (options) {
		batten_status status = check_options(context, options);
		if (status != BATTEN_OK)
			return status;
		chosen = *options;
	}
	batten_curve *curve = batten_allocate(context, 1, sizeof *curve);
	if (!curve)
		return BATTEN_MEMORY;
	*curve = (batten_curve){ .context = context,
		                     .form = chosen.form,
		                     .dimension = points->dimension,
		                     .count = points->count };
	batten_status status = fill(curve, points, &chosen);
	if (status != BATTEN_OK) {
		batten_curve_destroy(curve);
		return status;
	}
	*out = curve;
	return BATTEN_OK;
}

void batten_curve_destroy(batten_curve *curve)
{
	if (!curve)
		return;
	polynomial_destroy(&curve->polynomial);
	bspline_curve_destroy(&curve->bspline);
	for (size_t c = 0; c < 3; c++)
		spline_destroy(&curve->splines[c]);
	batten_release(curve->context, curve->slopes);
	batten_release(curve->context, curve->breaks);
	batten_release(curve->context, curve->parameters);
	batten_release(curve->context, curve->points);
	batten_release(curve->context, curve->label);
	batten_release(curve->context, curve);
}

/* ------------------------------------------------------------------------------------------------
 * Views
 * --------------------------------------------------------------------------------------------- */

const char *batten_curve_label(const batten_curve *curve)
{
	return curve->label;
}

size_t batten_curve_dimension(const batten_curve *curve)
{
	return curve->dimension;
}

void batten_curve_range(const batten_curve *curve, double *first, double *last)
{
	*first = curve->breaks[0];
	*last = curve->breaks[curve->break_count - 1];
}

size_t batten_curve_break_count(const batten_curve *curve)
{
	return curve->break_count;
}

const double *batten_curve_breaks(const batten_curve *curve)
{
	return curve->breaks;
}
