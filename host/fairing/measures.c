/* Every measure of a hull, by name: hydrostatics, fairness, energies, noise; and how far one hull
 * is from another. */
#include "fairing/measures.h"

#include "core/difference.h"
#include "fairing/lines.h"
#include "fairing/noise.h"
#include "geometry/grid_curvature.h"
#include "geometry/grid_variation.h"
#include "hull/hull.h"

#include <math.h>

static const char *const measure_names[] = {
#define MEASURE_NAME(name, text) #name,
	BATTEN_MEASURE_LIST(MEASURE_NAME)
#undef MEASURE_NAME
};
static const char *const measure_texts[] = {
#define MEASURE_TEXT(name, text) text,
	BATTEN_MEASURE_LIST(MEASURE_TEXT)
#undef MEASURE_TEXT
};

const char *batten_measure_name(size_t i)
{
	return i < BATTEN_MEASURE_COUNT ? measure_names[i] : NULL;
}

const char *batten_measure_text(size_t i)
{
	return i < BATTEN_MEASURE_COUNT ? measure_texts[i] : NULL;
}

void batten_measure_options_default(batten_measure_options *options)
{
	*options = (batten_measure_options){ .struct_size = sizeof *options,
		                                 .quadrature = BATTEN_QUADRATURE_SPLINE,
		                                 .density_t_per_m3 = 1.025 };
}

static void take_form(const batten_hydrostatics *from, batten_measures *out)
{
#define TAKE_QUANTITY(name, text) out->name = from->name;
	BATTEN_FORM_LIST(TAKE_QUANTITY)
#undef TAKE_QUANTITY
}

static batten_status take_energies(batten_context *context, const batten_hull *hull,
                                   batten_measures *out)
{
	grid_curvature *grid = NULL;
	batten_status status = grid_curvature_create(context, hull, &grid);
	if (status != BATTEN_OK)
		return status;
	bool any = grid->own_count > 0;
	out->energy_bending = out->energy_mean = out->energy_gauss = any ? 0 : NAN;
	for (size_t i = 0; any && i < hull_node_count(hull); i++) {
		if (grid->origin[i] != GRID_CURVATURE_OWN)
			continue;
		double area = grid->area_m2[i], mean = grid->mean_per_m[i];
		out->energy_bending += grid->bending_per_m2[i] * area;
		out->energy_mean += mean * mean * area;
		out->energy_gauss += fabs(grid->gauss_per_m2[i]) * area;
	}
	status = grid_variation_sum(context, hull, grid, &out->energy_mvc_per_m2);
	grid_curvature_destroy(context, grid);
	return status;
}

static batten_status take_fairness(batten_context *context, const batten_hull *hull,
                                   batten_measures *out)
{
	lines_sum waterlines, sections;
	batten_status status = lines_of_hull(hull, true, &waterlines);
	if (status == BATTEN_OK)
		status = lines_of_hull(hull, false, &sections);
	if (status == BATTEN_OK)
		status = noise_estimate(context, hull, &out->noise_m);
	if (status != BATTEN_OK)
		return status;
	out->fn_per_m2 = waterlines.fn_per_m2;
	out->fn_sections_per_m2 = sections.fn_per_m2;
	out->inflections = (double)(waterlines.inflections + sections.inflections);
	return take_energies(context, hull, out);
}

batten_status measures_complete(batten_context *context, const batten_hull *hull,
                                const batten_hydrostatics *form, batten_measures *out)
{
	batten_measures made = { 0 };
	take_form(form, &made);
	const batten_status status = take_fairness(context, hull, &made);
	if (status == BATTEN_OK)
		*out = made;
	return status;
}

static batten_status check_options(batten_context *context, const batten_measure_options *options)
{
	if (options->struct_size != sizeof *options)
		return batten_fail(context, BATTEN_USAGE,
		                   "measure options: not filled by batten_measure_options_default()");
	if (!isfinite(options->draft_m) || options->draft_m < 0)
		return batten_fail(context, BATTEN_USAGE, "draft %g m: expected a positive number",
		                   options->draft_m);
	return BATTEN_OK;
}

batten_status batten_hull_measure(batten_context *context, const batten_hull *hull,
                                  const batten_measure_options *options, batten_measures *out)
{
	batten_measure_options chosen;
	batten_measure_options_default(&chosen);
	if (options)
		chosen = *options;
	batten_status status = check_options(context, &chosen);
	if (status != BATTEN_OK)
		return status;
	double draft = chosen.draft_m > 0 ? chosen.draft_m : hull->draft_m;
	batten_hydrostatics_options how;
	batten_hydrostatics_options_default(&how);
	how.quadrature = chosen.quadrature;
	how.density_t_per_m3 = chosen.density_t_per_m3;
	batten_hydrostatics body;
	status = batten_hull_hydrostatics(context, hull, &how, 1, &draft, &body);
	/* Nobody asked for this draft: the file is at fault. */
	if (status == BATTEN_USAGE && chosen.draft_m == 0 &&
	    !(draft > hull->z_m[0] && draft <= hull->z_m[hull->waterline_count - 1]))
		return BATTEN_INPUT;
	if (status != BATTEN_OK)
		return status;
	return measures_complete(context, hull, &body, out);
}

static bool same_coordinates(size_t count, const double *a, const double *b)
{
	double near = 1e-9 * (a[count - 1] - a[0]);
	for (size_t i = 0; i < count; i++)
		if (!(fabs(a[i] - b[i]) <= near))
			return false;
	return true;
}

static batten_status check_same_table(batten_context *context, const batten_hull *a,
                                      const batten_hull *b)
{
	if (a->station_count != b->station_count || a->waterline_count != b->waterline_count)
		return batten_fail(context, BATTEN_USAGE,
		                   "%s and %s: tables of %zu x %zu and %zu x %zu, expected the same table",
		                   a->name, b->name, a->station_count, a->waterline_count, b->station_count,
		                   b->waterline_count);
	if (!same_coordinates(a->station_count, a->x_m, b->x_m) ||
	    !same_coordinates(a->waterline_count, a->z_m, b->z_m))
		return batten_fail(context, BATTEN_USAGE,
		                   "%s and %s: other stations or waterlines, expected the same table",
		                   a->name, b->name);
	for (size_t i = 0; i < hull_node_count(a); i++)
		if (a->nodes[i] != b->nodes[i])
			return batten_fail(
				context, BATTEN_USAGE,
				"%s and %s: the cell of station %zu, waterline %zu is not the same in "
				"both, expected the same table",
				a->name, b->name, i % a->station_count, i / a->station_count);
	return BATTEN_OK;
}

batten_status batten_hull_closeness(batten_context *context, const batten_hull *hull,
                                    const batten_hull *reference, batten_closeness *out)
{
	batten_status status = check_same_table(context, hull, reference);
	if (status != BATTEN_OK)
		return status;
	batten_closeness made = { 0 };
	double squares = 0, counted = 0;
	for (size_t i = 0; i < hull_node_count(hull); i++) {
		/* Neither outside, nor a '?': what fills it is no offset that could move. */
		if (hull->nodes[i] != BATTEN_NODE_GIVEN)
			continue;
		double change = hull->y_m[i] - reference->y_m[i];
		made.closeness_m4 += change * change *
		                     difference_cell(hull->x_m, hull->station_count,
		                                     i % hull->station_count) *
		                     difference_cell(hull->z_m, hull->waterline_count,
		                                     i / hull->station_count);
		made.cn_max_m = fmax(made.cn_max_m, fabs(change));
		if (hull->y_m[i] > 0 || reference->y_m[i] > 0) {
			squares += change * change;
			counted += 1;
		}
	}
	made.cn_rms_m = counted > 0 ? sqrt(squares / counted) : 0;
	double half_beam = batten_hull_half_beam_m(reference);
	made.cn_pct = half_beam > 0 ? 100 * made.cn_max_m / half_beam : NAN;
	*out = made;
	return BATTEN_OK;
}
