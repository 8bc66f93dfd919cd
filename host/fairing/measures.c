/* Every measure of a hull, by name: hydrostatics, fairness, energies, noise; and how far one hull
 * is from another. */
#include "fairing/measures.h"

#include "fairing/lines.h"

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

batten_status measures_complete(measure_room *room, const batten_hull *hull,
                                const batten_hydrostatics *form, batten_measures *out)
{
	batten_measures made = { 0 };
	take_form(form, &made);
	const batten_status status = measure_room_fairness(room, hull, &made);
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
	measure_room *room = NULL;
	status = measure_room_create(context, &room);
	if (status == BATTEN_OK)
		status = measures_complete(room, hull, &body, out);
	measure_room_destroy(room);
	return status;
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
	measure_room *room = NULL;
	status = measure_room_create(context, &room);
	if (status == BATTEN_OK)
		status = measure_room_closeness(room, hull, reference, out);
	measure_room_destroy(room);
	return status;
}
