#include "geometry/fit_ends.h"

#include <math.h>
#include <string.h>

void fit_sections_release(batten_context *context, struct fit_sections *sections)
{
	batten_release(context, sections->low);
	batten_release(context, sections->low_y);
	batten_release(context, sections->high);
}

static void sections_reach(struct fit_sections *sections, size_t station, double z, double y)
{
	if (!(sections->low[station] <= z)) {
		sections->low[station] = z;
		sections->low_y[station] = y;
	}
	if (!(sections->high[station] >= z))
		sections->high[station] = z;
}

batten_status fit_sections_create(const batten_hull *hull, const struct fit_ends *ends,
                                  struct fit_sections *out)
{
	batten_context *context = hull->context;
	const size_t count = hull->station_count;
	out->low = batten_allocate(context, count, sizeof *out->low);
	out->low_y = batten_allocate(context, count, sizeof *out->low_y);
	out->high = batten_allocate(context, count, sizeof *out->high);
	if (!out->low || !out->low_y || !out->high)
		return BATTEN_MEMORY;
	for (size_t s = 0; s < count; s++)
		out->low[s] = out->low_y[s] = out->high[s] = NAN;
	for (size_t n = 0; n < count * hull->waterline_count; n++)
		if (hull->nodes[n] != BATTEN_NODE_OUTSIDE)
			sections_reach(out, n % count, hull->z_m[n / count], hull->y_m[n]);
	for (size_t i = 0; i < hull->end_count; i++) {
		const hull_line_end *end = &hull->ends[i];
		if (end->on_waterline)
			continue;
		sections_reach(out, end->line, end->along_m, end->y_m);
	}
	for (size_t i = 0; hull->layout == HULL_LAYOUT_LONG_WATERLINES && i < ends->count; i++)
		for (size_t s = 0; s < count; s++)
			if (ends->x[FIT_AFT][i] < hull->x_m[s] && hull->x_m[s] < ends->x[FIT_FORWARD][i])
				sections_reach(out, s, ends->z[i], INFINITY);
	return BATTEN_OK;
}

void fit_ends_release(batten_context *context, struct fit_ends *ends)
{
	batten_release(context, ends->z);
	for (int side = FIT_AFT; side <= FIT_FORWARD; side++) {
		batten_release(context, ends->x[side]);
		batten_release(context, ends->y[side]);
	}
}

/* Makes room for a height in its order, or finds the waterline or section before that had it. */
static size_t ends_insert(struct fit_ends *ends, double z)
{
	size_t i = ends->count;
	while (i > 0 && ends->z[i - 1] > z)
		i--;
	if (i > 0 && ends->z[i - 1] == z)
		return i - 1;
	double *arrays[] = { ends->z, ends->x[FIT_AFT], ends->x[FIT_FORWARD], ends->y[FIT_AFT],
		                 ends->y[FIT_FORWARD] };
	for (size_t a = 0; a < sizeof arrays / sizeof arrays[0]; a++)
		memmove(arrays[a] + i + 1, arrays[a] + i, (ends->count - i) * sizeof **arrays);
	ends->z[i] = z;
	ends->count++;
	return i;
}

/* The first and the last section that reach from below z to above it: the ends there, unless those
 * known lie beyond. */
static void ends_at_height(const batten_hull *hull, const struct fit_sections *sections, double z,
                           struct fit_ends *ends)
{
	size_t station[2] = { SIZE_MAX, SIZE_MAX };
	for (size_t s = 0; s < hull->station_count; s++) {
		if (!(sections->low[s] <= z && z <= sections->high[s]))
			continue;
		station[FIT_AFT] = station[FIT_AFT] == SIZE_MAX ? s : station[FIT_AFT];
		station[FIT_FORWARD] = s;
	}
	if (station[FIT_AFT] == SIZE_MAX)
		return;
	const size_t before = ends->count;
	const size_t i = ends_insert(ends, z);
	for (int side = FIT_AFT; side <= FIT_FORWARD; side++) {
		const size_t s = station[side];
		const double beyond = hull->x_m[s] - ends->x[side][i];
		if (ends->count == before && !(side == FIT_AFT ? beyond < 0.0 : beyond > 0.0))
			continue;
		ends->x[side][i] = hull->x_m[s];
		ends->y[side][i] = sections->low[s] == z ? sections->low_y[s] : NAN;
	}
}

/* Stem or stern at a height between two of its points; NaN elsewhere. */
static double profile_at(const batten_hull *hull, hull_profile_kind kind, double z)
{
	const hull_profile_point *under = NULL, *over = NULL;
	for (size_t i = 0; i < hull->profile_count; i++) {
		const hull_profile_point *at = &hull->profile[i];
		if (at->kind != kind)
			continue;
		if (at->z_m <= z && (!under || at->z_m > under->z_m))
			under = at;
		if (at->z_m >= z && (!over || at->z_m < over->z_m))
			over = at;
	}
	if (!under || !over)
		return NAN;
	return under == over || under->z_m == over->z_m
	           ? under->x_m
	           : under->x_m +
	                 (z - under->z_m) * (over->x_m - under->x_m) / (over->z_m - under->z_m);
}

/* Ends that stem or stern lie beyond. */
static void ends_to_profile(const batten_hull *hull, struct fit_ends *ends)
{
	for (size_t i = 0; i < ends->count; i++) {
		const double stern = profile_at(hull, HULL_PROFILE_STERN, ends->z[i]);
		const double stem = profile_at(hull, HULL_PROFILE_STEM, ends->z[i]);
		if (stern < ends->x[FIT_AFT][i]) {
			ends->x[FIT_AFT][i] = stern;
			ends->y[FIT_AFT][i] = NAN;
		}
		if (stem > ends->x[FIT_FORWARD][i]) {
			ends->x[FIT_FORWARD][i] = stem;
			ends->y[FIT_FORWARD][i] = NAN;
		}
	}
}

batten_status fit_ends_create(const batten_hull *hull, struct fit_ends *ends)
{
	batten_context *context = hull->context;
	double **arrays[] = { &ends->z, &ends->x[FIT_AFT], &ends->x[FIT_FORWARD], &ends->y[FIT_AFT],
		                  &ends->y[FIT_FORWARD] };
	const size_t most = hull->waterline_count + hull->station_count + hull->profile_count;
	for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
		*arrays[i] = batten_allocate(context, most, sizeof **arrays[i]);
		if (!*arrays[i])
			return BATTEN_MEMORY;
	}
	for (size_t w = 0; w < hull->waterline_count; w++) {
		hull_line line;
		const batten_status status = hull_line_collect(hull, true, w, true, &line);
		if (status != BATTEN_OK)
			return status;
		if (line.count > 0) {
			const size_t n = ends->count++;
			ends->z[n] = hull->z_m[w];
			ends->x[FIT_AFT][n] = line.along_m[0];
			ends->y[FIT_AFT][n] = line.value_m[0];
			ends->x[FIT_FORWARD][n] = line.along_m[line.count - 1];
			ends->y[FIT_FORWARD][n] = line.value_m[line.count - 1];
		}
		hull_line_release(hull, &line);
	}
	return BATTEN_OK;
}

void fit_ends_extend(const batten_hull *hull, const struct fit_sections *sections,
                     struct fit_ends *ends)
{
	if (hull->layout != HULL_LAYOUT_LONG_STATIONS)
		return;
	for (size_t i = 0; i < ends->count; i++)
		ends_at_height(hull, sections, ends->z[i], ends);
	for (size_t s = 0; s < hull->station_count; s++)
		if (!isnan(sections->low[s]))
			ends_at_height(hull, sections, sections->low[s], ends);
	for (size_t i = 0; i < hull->profile_count; i++)
		if (hull->profile[i].kind == HULL_PROFILE_STEM ||
		    hull->profile[i].kind == HULL_PROFILE_STERN)
			ends_at_height(hull, sections, hull->profile[i].z_m, ends);
	ends_to_profile(hull, ends);
}
