/* Curves of form, Bonjean's curves and section area curves as charts (Letcher 11). */
#include "core/number.h"
#include "picture/chart.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

static const char *const upright = "upright, moulded \u00b7 frame ap-fwd, m";

static void stretch(double value, double *low, double *high)
{
	if (!isfinite(value))
		return;
	*low = fmin(*low, value);
	*high = fmax(*high, value);
}

/* ------------------------------------------------------------------------------------------------
 * Curves of form
 * --------------------------------------------------------------------------------------------- */

#define QUANTITY(name)                                                                             \
	{                                                                                              \
#name, offsetof(batten_hydrostatics, name)                                                 \
	}
static const struct {
	const char *name;
	size_t offset;
} drawn[] = {
	QUANTITY(displacement_t),
	QUANTITY(waterplane_area_m2),
	QUANTITY(wetted_surface_m2),
	QUANTITY(midship_area_m2),
	QUANTITY(lcb_pct_lbp_fwd),
	QUANTITY(lcf_pct_lbp_fwd),
	QUANTITY(kb_m),
	QUANTITY(kmt_m),
	QUANTITY(kml_m),
	QUANTITY(tpc_t_per_cm),
	QUANTITY(mt1cm_t_m_per_cm),
	QUANTITY(cb),
	QUANTITY(cp),
	QUANTITY(cm),
	QUANTITY(cwp),
};
#undef QUANTITY
enum { DRAWN_COUNT = (int)(sizeof drawn / sizeof drawn[0]) };

static const double *column_of(const batten_hydrostatics *rows, size_t offset)
{
	return (const double *)(const void *)((const char *)rows + offset);
}

/* The power of ten by which the largest size lands in 1 to 10. */
static int power_of(size_t count, const double *values)
{
	double most = 0;
	for (size_t i = 0; i < count; i++) {
		double value = values[i * BATTEN_HYDROSTATICS_COUNT];
		if (isfinite(value))
			most = fmax(most, fabs(value));
	}
	return most > 0 ? (int)floor(log10(most) + 1e-12) : 0;
}

static bool any_finite(size_t count, const double *values)
{
	for (size_t i = 0; i < count; i++)
		if (isfinite(values[i * BATTEN_HYDROSTATICS_COUNT]))
			return true;
	return false;
}

batten_status batten_picture_curves_of_form(batten_context *context, const char *name, size_t count,
                                            const batten_hydrostatics *rows, const char *path)
{
	chart_curve curves[DRAWN_COUNT];
	struct chart chart = {
		.name = name,
		.subtitle = "curves of form \u00b7 upright, moulded \u00b7 frame ap-fwd, m",
		.x_title = "scale; the legend says what one unit of it is",
		.y_title = "draft_m",
		.curves = curves,
		.x_high = 10,
		.y_low = 0
	};
	if (count < 2)
		return batten_fail(context, BATTEN_USAGE, "curves of form over %zu drafts: two at least",
		                   count);
	for (size_t k = 0; k < DRAWN_COUNT; k++) {
		const double *values = column_of(rows, drawn[k].offset);
		int power = power_of(count, values);
		chart_curve *curve = &curves[chart.count];
		if (!any_finite(count, values))
			continue;
		*curve = (chart_curve){ .count = count,
			                    .x = values,
			                    .y = &rows->draft_m,
			                    .x_stride = BATTEN_HYDROSTATICS_COUNT,
			                    .y_stride = BATTEN_HYDROSTATICS_COUNT,
			                    .scale = pow(10, -power) };
		if (power == 0)
			(void)snprintf(curve->label, sizeof curve->label, "%s", drawn[k].name);
		else
			(void)snprintf(curve->label, sizeof curve->label, "%s, unit 1e%d", drawn[k].name,
			               power);
		for (size_t i = 0; i < count; i++)
			stretch(values[i * BATTEN_HYDROSTATICS_COUNT] * curve->scale, &chart.x_low,
			        &chart.x_high);
		chart.count++;
	}
	for (size_t i = 0; i < count; i++)
		stretch(rows[i].draft_m, &chart.y_low, &chart.y_high);
	if (!(chart.y_high > chart.y_low))
		return batten_fail(context, BATTEN_USAGE, "curves of form: every draft is %g m",
		                   rows->draft_m);
	return chart_write(context, &chart, path);
}

/* ------------------------------------------------------------------------------------------------
 * Sections
 * --------------------------------------------------------------------------------------------- */

batten_status batten_picture_bonjean(batten_context *context, const char *name,
                                     size_t section_count, const double *x_m, size_t height_count,
                                     const double *heights_m, const double *areas_m2,
                                     const char *path)
{
	if (section_count < 2 || height_count < 2)
		return batten_fail(context, BATTEN_USAGE,
		                   "Bonjean's curves of %zu sections at %zu heights: two at least",
		                   section_count, height_count);
	double length = x_m[section_count - 1] - x_m[0], most = 0;
	for (size_t i = 0; i < section_count * height_count; i++)
		most = fmax(most, areas_m2[i]);
	chart_curve *curves = batten_allocate(context, section_count, sizeof *curves);
	if (!curves)
		return BATTEN_MEMORY;
	/* the largest area is as wide as three intervals */
	double scale = most > 0 ? 3 * length / ((double)(section_count - 1) * most) : 1;
	char subtitle[160], number[BATTEN_NUMBER_SIZE];
	(void)snprintf(subtitle, sizeof subtitle,
	               "Bonjean's curves \u00b7 area of each section to the right of it, largest %s "
	               "m\u00b2 \u00b7 %s",
	               batten_number_write(number, round(most * 1e4) / 1e4), upright);
	struct chart chart = { .name = name,
		                   .subtitle = subtitle,
		                   .x_title = "x_m, bow to the right",
		                   .y_title = "z_m",
		                   .count = section_count,
		                   .curves = curves,
		                   .x_low = x_m[0],
		                   .x_high = x_m[section_count - 1],
		                   .y_low = heights_m[0],
		                   .y_high = heights_m[height_count - 1] };
	for (size_t i = 0; i < section_count; i++) {
		curves[i] = (chart_curve){ .count = height_count,
			                       .x = areas_m2 + i,
			                       .y = heights_m,
			                       .x_stride = section_count,
			                       .y_stride = 1,
			                       .scale = scale,
			                       .to = x_m[i] };
		for (size_t k = 0; k < height_count; k++)
			stretch(x_m[i] + scale * areas_m2[k * section_count + i], &chart.x_low, &chart.x_high);
	}
	batten_status status = BATTEN_OK;
	if (!(length > 0 && chart.y_high > chart.y_low))
		status = batten_fail(context, BATTEN_USAGE,
		                     "Bonjean's curves: ascending sections and heights were expected");
	if (status == BATTEN_OK)
		status = chart_write(context, &chart, path);
	batten_release(context, curves);
	return status;
}

batten_status batten_picture_section_areas(batten_context *context, const char *name,
                                           size_t curve_count, const double *drafts_m,
                                           const size_t *counts, const double *x_m,
                                           const double *area_m2, const char *path)
{
	chart_curve *curves = batten_allocate(context, curve_count, sizeof *curves);
	if (!curves)
		return BATTEN_MEMORY;
	struct chart chart = {
		.name = name,
		.subtitle = "section area curves \u00b7 upright, moulded \u00b7 frame ap-fwd, m",
		.x_title = "x_m, bow to the right",
		.y_title = "immersed section area, m\u00b2, both sides",
		.count = curve_count,
		.curves = curves,
		.x_low = INFINITY,
		.x_high = -INFINITY
	};
	size_t first = 0;
	for (size_t k = 0; k < curve_count; k++) {
		char number[BATTEN_NUMBER_SIZE];
		curves[k] = (chart_curve){ .count = counts[k],
			                       .x = x_m + first,
			                       .y = area_m2 + first,
			                       .x_stride = 1,
			                       .y_stride = 1,
			                       .scale = 1 };
		(void)snprintf(curves[k].label, sizeof curves[k].label, "draft_m %s",
		               batten_number_write(number, drafts_m[k]));
		for (size_t i = first; i < first + counts[k]; i++) {
			stretch(x_m[i], &chart.x_low, &chart.x_high);
			stretch(area_m2[i], &chart.y_low, &chart.y_high);
		}
		first += counts[k];
	}
	batten_status status = BATTEN_OK;
	if (!(chart.x_high > chart.x_low && chart.y_high > chart.y_low))
		status = batten_fail(context, BATTEN_USAGE, "section area curves: nothing to draw");
	if (status == BATTEN_OK)
		status = chart_write(context, &chart, path);
	batten_release(context, curves);
	return status;
}
